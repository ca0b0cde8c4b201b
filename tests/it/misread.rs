//! Verilog that Yosys reads otherwise than a simulator does, and what stands between a file and its translation.

use crate::support::*;

/// The modules `m` of these texts in one file, called `m0`, `m1` and so on, pass the rows beside them; what is said.
#[track_caller]
fn passes(modules: &[(String, &str)]) -> String {
    let (mut verilog, mut tests) = (String::new(), "use \"m.v\"\n".to_owned());
    for (at, (text, rows)) in modules.iter().enumerate() {
        verilog += &text.replacen("module m(", &format!("module m{at}("), 1);
        tests += &format!("\ntest m{at} {{\n    {}\n}}\n", rows.replace(", ", "\n    "));
    }
    let bench = Bench::with("m.v", verilog);
    bench.file("m.nb", tests);
    bench.ok("test m.nb --logic --effort fast").err
}

#[track_caller]
fn is_refused(verilog: &str, expected: &[&str]) {
    let ran = Bench::with("m.v", verilog).run("synth m.v --cells nand,not");
    ran.expect_fault(expected);
    assert!(!ran.err.contains('$'), "{}", ran.err);
}

/// What a simulator computes: the module's text after its head, and its rows.
const SAME: &[(&str, &str)] = &[
    // The variable of two loops is not a net that anything depends on.
    (
        "[1:0] a, b, input c, output reg [1:0] x, y);\ninteger i;\n\
         always @* for (i = 0; i < 2; i = i + 1) x[i] = a[i];\n\
         always @(posedge c) if (a) for (i = 0; i < 2; i = i + 1) y[i] <= b[1 - i];",
        "a b c | x y, 01 10 0 | 01 00, 01 10 1 | 01 01",
    ),
    // Wide amounts of shifts shift everything out.
    (
        "[7:0] s, output [7:0] a, b, c, d, output signed [7:0] e);\n\
         assign a = s >> 33'h0ffffffff;\nassign b = s << 32'hffffffff;\nassign c = s >>> 40'd2;\n\
         assign d = s >> {s[7], 34'd1};\nassign e = $signed(s) >>> 35'h7ffffffff;",
        "s | a b c d e, 8'h83 | 8'h00 8'h00 8'h20 8'h00 8'hff, 8'h43 | 8'h00 8'h00 8'h10 8'h21 8'h00",
    ),
    // Parts that are partly outside, and their signs.
    (
        "[1:0] x, output reg [6:0] y);\nalways @* begin y = 0; y[x +: 4] = 3'sb111; end",
        "x | y, 00 | 0001111, 01 | 0011110, 10 | 0111100, 11 | 1111000",
    ),
    // Downward from a place without a sign, with a lowest bit that is not 0, and in a block that sets only parts.
    (
        "[1:0] x, output reg [5:0] d, output reg [7:2] o, output [5:0] r);\n\
         always @* begin d = 6'b101010; d[x -: 3] = 3'b101; end\n\
         always @* begin o[7:4] = 0; o[3:2] = 0; o[{x, 1'b1} +: 3] = 7; end\nassign r = {6{1'b1}} & 6'b110010 >> x;",
        "x | d o r, 00 | 101011 000011 110010, 01 | 101010 001110 011001, 10 | 101101 111000 001100, \
         11 | 101010 100000 000110",
    ),
    // The variables of loops keep their sign and width: -3 < -2, -1, 0, 1; without a sign, 13 is not below 0, 1, 2, 3.
    (
        "signed [3:0] x, output reg [3:0] a, b, output reg [7:0] c);\ninteger i;\nreg [3:0] j;\nreg [1:0] k;\n\
         always @* begin a = 0; for (i = 4'd0; i < 4'd4; i = i + 4'd1) a[i] = x < i - 2; end\n\
         always @* begin b = 0; for (j = 0; j < 4; j = j + 1) b[j] = x < j; end\n\
         always @* begin c = 0; for (k = 2; k != 1; k = k + 1) c[k] = 1; end",
        "x | a b c, 1101 | 1111 0000 00001101, 0000 | 1000 1110 00001101, 1111 | 1100 0000 00001101",
    ),
    // Of labels that match, the first counts, whatever hints say.
    ("[1:0] s, output reg [1:0] z);\nalways @* casez (s) // synopsys parallel_case\n", FIRST),
    ("[1:0] s, output reg [1:0] z);\nalways @* (* parallel_case *) casez (s)\n", FIRST),
    ("[1:0] s, output reg [1:0] z);\nalways @* unique casez (s)\n", FIRST),
    // What prints is not in the way.
    (
        "c, x, output reg q);\nwire `CAT(t, 1) = x;\ninitial $display(\"%b\", q);\n\
         always @(posedge c) begin\n  if (x) $display(\"x\"); else q <= t1;\n  if (t1) q <= t1;\nend",
        "c x | q, 0 1 | 0, 1 1 | 1, 0 0 | 1, 1 0 | 0",
    ),
    // A choice of all cases is no latch.
    (
        "a, b, p, q, r, s, output reg o);\nalways @* if (!a && !b) o = p; else if (!a && b) o = q;\n\
         else if (a && !b) o = r; else if (a && b) o = s;",
        "a b p q r s | o, 0 0 1 0 0 0 | 1, 0 1 1 0 1 1 | 0, 1 0 0 0 1 0 | 1, 1 1 1 1 1 0 | 0, 1 1 0 0 0 1 | 1",
    ),
];
const FIRST: &str = "s  | z, 00 | 00, 01 | 10, 10 | 01, 11 | 01";

#[test]
fn modules_compute_what_a_simulator_computes() {
    let Some(_) = SLANG.find() else { return };
    let labels = |rows: &str| if rows == FIRST { "2'b1?: z = 1;\n2'b?1: z = 2;\ndefault: z = 0;\nendcase" } else { "" };
    let module = |text, rows| format!("module m(input {text}{}\nendmodule\n", labels(rows));
    let mut modules: Vec<_> = SAME.iter().map(|&(text, rows)| (module(text, rows), rows)).collect();
    // Yosys reads no more of them at once.
    modules.chunks_mut(5).for_each(|some| {
        some[0].0.insert_str(0, "`define CAT(a, b) a``b\n");
        passes(some);
    });
}

#[test]
fn a_net_with_two_drivers_is_refused_with_both() {
    let Some(_) = SLANG.find() else { return };
    let ports = "input c, a, b, output y, output [3:0] z";
    for (ports, body, expected) in [
        (
            ports,
            "assign z = {a, b, a, b};\nassign y = a & b;\nassign y = 1'b0;",
            &["`y` is driven twice: by logic and by the constant 0", "m.v:1:"][..],
        ),
        (
            ports,
            "assign y = a;\nassign z = 0;\nassign z[2] = b;",
            &["`z[2]` is driven twice: by the constant 0", "`b`"],
        ),
        (
            ports,
            "wire w;\nassign w = a;\nassign w = ~b;\nassign y = w, z = w;",
            &["`w` is driven twice: by `a` and by logic", "m.v:2:"],
        ),
        (ports, "assign y = a, z = 0;\nassign a = b;", &["`a` is driven twice: by the input port", "`b`"]),
        ("input a, b, output reg y", "always @* y = a;\nalways @* if (b) y = 0;", &["`y` is driven twice"]),
        (
            "input c, a, b, output reg y",
            "always @(posedge c) y <= a;\nalways @(posedge c) y <= b;",
            &["`y` is driven twice", "a register (line 2)", "a register (line 3)"],
        ),
    ] {
        is_refused(&format!("module m({ports});\n{body}\nendmodule\n"), expected);
    }
}

#[test]
fn labels_that_never_match_are_told() {
    let Some(_) = SLANG.find() else { return };
    let module = |word: &str, label: &str| {
        format!(
            "module m(input [1:0] a, output reg y);\nlocalparam L = 2'b0x;\nalways @* {word} (a)\n{label}: y = 1;\n\
             default: y = 0;\nendcase\nendmodule\n"
        )
    };
    let labels = ["2'b1x", "2'bx1", "L", "{1'bx, 1'b0}"];
    let said = passes(&labels.map(|label| (module("case", label), "a | y, 10 | 0, 11 | 0")));
    for told in ["2'b1x", "2'bx1", "2'b0x", "2'bx0"] {
        assert!(said.contains(&format!("the label `{told}` never matches")), "{told}: {said}");
    }
    // In `casex` it is a wildcard.
    let said = passes(&[(module("casex", "2'b1x"), "a | y, 00 | 0, 01 | 0, 10 | 1, 11 | 1")]);
    assert!(!said.contains("never matches"), "{said}");
}

#[test]
fn an_unknown_value_and_a_latch_are_refused() {
    let Some(_) = SLANG.find() else { return };
    for sign in ["===", "!=="] {
        let text = format!("module m(input a, output y);\nassign y = a {sign} 1'bx;\nendmodule\n");
        is_refused(&text, &["with an unknown bit", "m.v:2:12"]);
    }
    is_refused("module m(input a, e, output y);\nbufif1(y, a, e);\nendmodule\n", &["`y` can be `z`", "m.v:2:"]);
    let latch = "module m(input a, b, p, output reg o);\nalways @* if (a && b) o = p;\nendmodule\n";
    is_refused(latch, &["`o` is a latch", "m.v:"]);
}

#[test]
fn what_is_not_as_in_a_simulator_is_told() {
    let Some(_) = SLANG.find() else { return };
    let module = |body: &str| format!("module m(input c, l, d, output reg q);\ninitial q = 0;\n{body}\nendmodule\n");
    let rows = "c l d | q, 0 0 0 | 0";
    let cases = [
        ("always @(posedge c or posedge l) if (l) q <= d; else q <= ~q;", "`q` loads a value without its clock"),
        ("function f(input a); f = a & l; endfunction\nalways @* q = f(d);", "`q` also depends on `l`"),
        ("wire [1:0] v = {l, d};\nalways @(v[0]) q = ^v;", "`q` also depends on `v`"),
        ("function f(input a); if (a) f = 1; endfunction\nalways @* q = f(d);", "a value can be `x`"),
        ("reg t;\nalways @* begin q = l & t; t = d; end", "`t` is read before it is set"),
    ];
    let said = passes(&cases.map(|(body, _)| (module(body), rows)));
    assert!(cases.iter().all(|(_, told)| said.contains(told)), "{said}");
    // Both calls write the arguments of the function.
    let plain = "function f(input a, b); f = a & b; endfunction\nreg p;\n\
        integer i;\nalways @* begin q = f(d, l); for (i = 0; i < 1; i = i + 1) q = q & d; end\n\
        always @* p = f(c, l);";
    assert!(!passes(&[(module(plain), rows)]).contains("warning"));
}

#[test]
fn parameters_are_as_if_their_defaults_had_been_edited() {
    let Some(_) = SLANG.find() else { return };
    let text = "module p #(parameter P = 3) (input signed [3:0] x, output k, output signed [5:0] y);\n\
        assign k = x < P;\nassign y = x * P;\nendmodule\n";
    let bench = Bench::with("p.v", text);
    for (value, rows) in [
        ("11", "1111 | 1 110101\n    0101 | 1 110111"),
        ("-2", "1111 | 0 000010\n    1100 | 1 001000"),
        ("4'd11", "1111 | 0 100101\n    0101 | 1 110111"),
    ] {
        bench.ok(&["synth", "p.v", "--param", &format!("P={value}"), "--cells", "all", "-o", "out.nb"]);
        let made = bench.read("out.nb");
        bench.file("test.nb", format!("{made}\ntest p {{\n    x | k y\n    {rows}\n}}\n"));
        bench.ok("test test.nb --logic");
    }
}

#[test]
fn several_files_are_one_design() {
    let Some(_) = SLANG.find() else { return };
    let alu = "`ifdef WIDE\nmodule alu(input a, output q);\nassign q = ~a;\nendmodule\n`endif\n";
    let bench = Bench::with("parts/alu.v", alu);
    bench.file("parts/a_top.v", "`define WIDE\nmodule top(input a, output q);\nalu u(a, q);\nendmodule\n");
    bench.ok("synth --cells nand,not parts/a_top.v parts/alu.v");
    bench.run("synth --cells nand,not parts/a_top.v").expect_fault(&["alu"]);
    bench.run("synth --cells nand,not parts/a_top.v x.blif").expect_fault(&["only Verilog"]);
    for path in ["parts", "parts/"] {
        bench.file("m.nb", format!("use \"{path}\"\n\ntest top {{\n    a | q\n    0 | 1\n    1 | 0\n}}\n"));
        bench.ok("test m.nb --logic");
    }
    // A fault is at its line of its file.
    bench.file("parts/alu.v", "module alu(input a, output q);\n\nassign q = ~;\nendmodule\n");
    for line in ["check m.nb", "synth parts/a_top.v parts/alu.v --cells nand,not"] {
        bench.run(line).expect_fault(&["parts/alu.v:3:"]);
    }
}
