//! Broken circuit files: the message of each reader and its place.

use nbc_base::diag::Diagnostic;
use nbc_base::source::Sources;
use nbc_circuit::formats::{bench, blif, pla};

/// The first error as `line:column text: message; label`.
fn first(text: &str, read: impl FnOnce(&str, nbc_base::source::FileId) -> Result<(), Vec<Diagnostic>>) -> String {
    let mut sources = Sources::default();
    let id = sources.add("broken", text);
    let fault = read(&sources.file(id).text, id).expect_err("the file is broken").remove(0);
    let label = &fault.labels[0];
    let place = sources.file(id).line_column(label.span.start as usize);
    format!("{}:{} `{}`: {}; {}", place.line, place.column, sources.text(label.span), fault.message, label.text)
}

/// Models without their first line, each with its message.
#[test]
fn errors_in_blif_have_their_place() {
    let check = |lines: &str, expected: &str| {
        let found = first(&format!(".model m\n{lines}"), |text, file| blif::read(text, file, None).map(drop));
        assert_eq!(found, expected, "{lines}");
    };
    check("x\n", "2:1 `x`: `x` is not a directive; expected a directive such as `.names`, or a row after one");
    check(".foo\n", "2:1 `.foo`: unknown BLIF directive `.foo`; not supported");
    check(".names\n", "2:1 `.names`: `.names` is incomplete; expected the name of a net");
    check(".latch a\n", "2:1 `.latch`: `.latch` is incomplete; expected an input and an output");
    check(".subckt\n", "2:1 `.subckt`: `.subckt` is incomplete; expected the name of a model");
    check(
        ".gate and2 a=b\n",
        "2:1 `.gate`: `.gate` names a cell of a library that is not in the file; expected its function, written with \
         `.names`",
    );
    check(".names a y\n1 1 1\n", "3:1 `1 1 1`: malformed row; expected the digits of the inputs and of the output");
    check(".names a y\n11 1\n", "3:1 `11 1`: row has the wrong width; expected 1 digits `0`, `1` or `-`, found `11`");
    check(".names a y\n2 1\n", "3:1 `2 1`: row has the wrong width; expected 1 digits `0`, `1` or `-`, found `2`");
    check(".names a y\n1 x\n", "3:1 `1 x`: row has an invalid output; expected `0` or `1`, found `x`");
    check(
        ".names a y\n1 1\n0 0\n",
        "4:1 `0 0`: rows have different outputs; expected the same output in all rows of a `.names`",
    );
    check(".names a y\n.attr init 2\n", "3:12 `2`: invalid start value `2` of a net; expected 0 or 1");
    check(".outputs y\n", "2:10 `y`: `y` is used but not defined; used here");
    check(".outputs y\n.names z y\n1 1\n", "3:8 `z y`: `z` is used but not defined; used here");
    check(".outputs y\n.names y y\n1 1\n", "3:8 `y y`: `y` depends on itself; this closes the loop");
    check(
        ".inputs y\n.names y\n1\n",
        "2:9 `y`: `y` is driven twice; an input or a register cannot have another driver",
    );
    check(".names y\n1\n.names y\n", "4:8 `y`: `y` is defined twice; defined again here");
    check(".latch a q re\n", "2:12 `re`: invalid start value `re` of a latch; expected 0, 1, 2 (any) or 3 (unknown)");
    check(".latch a q xe clk 0\n", "2:12 `xe`: invalid kind `xe` of a latch; expected re, fe, ah or al");
    check(
        ".latch a q re clk 7\n",
        "2:19 `7`: invalid start value `7` of a latch; expected 0, 1, 2 (any) or 3 (unknown)",
    );
    check(".inputs a\n.latch a q 0\n", "3:1 `.latch`: latch `q` has no clock; expected a clock");
    check(".subckt gone\n", "2:9 `gone`: model `gone` is missing; expected its `.model` in the file");
    check(".subckt m\n", "2:9 `m`: model `m` contains itself; instantiated here");
    let inner = ".end\n.model n\n.inputs x\n.outputs y\n.names x y\n1 1\n";
    let nested = |line: &str, expected: &str| check(&format!(".inputs a\n{line}\n{inner}"), expected);
    nested(".subckt n x", "3:11 `x`: `x` is not a connection; expected `port=net`");
    nested(".subckt n z=a", "3:11 `z=a`: model `n` has no port `z`; connected here");
    nested(".subckt n x=a x=a", "3:15 `x=a`: port `x` is connected twice; connected again here");
    nested(".subckt n y=a", "3:9 `n`: input `x` of model `n` is not connected; expected `x=net`");
    let gated = ".inputs a clk\n.outputs q\n.names a clk g\n11 1\n.latch a q re g 0\n";
    check(gated, "6:1 `.latch`: the clock `g` of `q` is driven by logic; expected an input or a register as clock");
    let long = format!(".inputs {}\n", "n".repeat(1_001));
    check(&long, "2:9 `nnnnnnnnnnnnnnnnnnnn`: name of 1001 bytes is too long; expected at most 1000");
    let bare = first(".inputs a\n", |text, file| blif::read(text, file, None).map(drop));
    assert_eq!(bare, "1:1 `.inputs`: `.inputs` before `.model`; expected `.model` first");
}

#[test]
fn errors_in_pla_have_their_place() {
    let check = |text: &str, expected: &str| {
        assert_eq!(first(text, |text, file| pla::read(text, file).map(drop)), expected, "{text}");
    };
    let widths = "the numbers of inputs and outputs are missing in this PLA file; expected lines such as `.i 4` and \
                  `.o 1` before this";
    check("", &format!("1:1 ``: {widths}"));
    check(".i 1\n0 1\n", &format!("2:1 `0 1`: {widths}"));
    check(".i none\n", "1:1 `.i`: `.i` has no number of ports; expected a number of at least 1");
    check(".i 0\n", "1:1 `.i`: `.i` has no number of ports; expected a number of at least 1");
    let directives = "unknown PLA directive `.phase`; expected .i, .o, .ilb, .ob, .p, .type, .e or a row";
    check(".phase 1\n", &format!("1:1 `.phase`: {directives}"));
    check(".type dr\n", "1:7 `dr`: unknown type `dr` of a PLA; expected f, fd, fr or fdr");
    let two = |line: &str, expected: &str| check(&format!(".i 2\n.o 1\n{line}"), expected);
    two(".ilb a\n", "3:6 `a`: 1 name for 2 ports; expected a name for each port");
    let width = "row has the wrong width; expected 2 digits of inputs and 1 of outputs, found 2 digits";
    two("0 1\n", &format!("3:1 `0 1`: {width}"));
    two("0x 1\n", "3:1 `0x 1`: `x` is not a digit of an input; expected `0`, `1` or `-`");
    two("00 x\n", "3:1 `00 x`: `x` is not a digit of an output; expected `0`, `1`, `-` or `~`");
    two(".ilb a a\n", "3:8 `a`: `a` is driven twice; an input or a register cannot have another driver");
    two(".ilb a b\n.ob a\n", "3:6 `a`: `a` is driven twice; an input or a register cannot have another driver");
    let long = format!(".ilb {}\n", "n".repeat(1_001));
    two(&long, "3:6 `nnnnnnnnnnnnnnnnnnnn`: name of 1001 bytes is too long; expected at most 1000");
}

#[test]
fn errors_in_bench_have_their_place() {
    let check = |text: &str, expected: &str| {
        assert_eq!(first(text, |text, file| bench::read(text, file, None).map(drop)), expected, "{text}");
    };
    let gates = "expected AND, NAND, OR, NOR, XOR or XNOR of any nets, NOT, BUFF or DFF of one";
    let statement = "not a statement of .bench; expected `INPUT(a)`, `OUTPUT(b)` or `b = NAND(a, c)`";
    check("", "1:1 ``: no `OUTPUT` in this .bench file; expected `OUTPUT(net)`");
    check("hello\n", &format!("1:1 `hello`: {statement}"));
    check("INPUT(a)\n  b = NAND(a, a\n", &format!("2:3 `b = NAND(a, a`: {statement}"));
    check("b = MUX(a, c)\n", &format!("1:1 `b = MUX(a, c)`: .bench has no gate `MUX` of 2 nets; {gates}"));
    check("b = NOT(a, c)\n", &format!("1:1 `b = NOT(a, c)`: .bench has no gate `NOT` of 2 nets; {gates}"));
    check("b = MUX(a)\n", &format!("1:1 `b = MUX(a)`: .bench has no gate `MUX` of 1 net; {gates}"));
    check("INPUT(a, b)\n", "1:1 `INPUT(a, b)`: `INPUT` names 2 nets; expected `INPUT(net)` for each net");
    check("AND(a, b)\n", "1:1 `AND(a, b)`: the value of `AND` is not assigned to a net; expected `net = AND(…)`");
    check("q = AND(a,)\n", "1:1 `q = AND(a,)`: net has no name; expected a name between the commas");
    check(" = AND(a, b)\n", "1:2 `= AND(a, b)`: net has no name; expected a name between the commas");
    check("q = AND(a b)\n", "1:1 `q = AND(a b)`: name contains a space; expected a comma between names");
    check("OUTPUT(q)\n", "1:1 `OUTPUT(q)`: `q` is used but not defined; used here");
    check("OUTPUT(q)\nq = AND(q, q)\n", "2:1 `q = AND(q, q)`: `q` depends on itself; this closes the loop");
    check(
        "INPUT(a)\nOUTPUT(a)\na = NOT(a)\n",
        "1:1 `INPUT(a)`: `a` is driven twice; an input or a register cannot have another driver",
    );
}
