//! Verilog that Yosys reads otherwise than a simulator does, and what stands between a file and its translation.

use crate::support::bench::Bench;
use crate::support::tools::SLANG;

/// Checks that a module passes a test, whose rows are as a simulator computes them.
#[track_caller]
fn passes(verilog: &str, test: &str) -> String {
    let bench = Bench::new();
    bench.file("m.v", verilog);
    bench.file("m.nb", format!("use \"m.v\"\n\n{test}"));
    let ran = bench.run(&["test", "m.nb", "--logic", "--effort", "fast"]);
    assert_eq!(ran.status, 0, "{verilog}\n{}{}", ran.out, ran.err);
    ran.err
}

/// Checks that every command refuses a module with these words.
#[track_caller]
fn is_refused(verilog: &str, expected: &[&str]) {
    let bench = Bench::new();
    bench.file("m.v", verilog);
    bench.file("m.nb", "use \"m.v\"\n");
    for arguments in [&["synth", "m.v", "--cells", "nand,not"][..], &["check", "m.nb"]] {
        let ran = bench.run(arguments);
        ran.expect_fault(expected);
        assert!(!ran.err.contains('$'), "{}", ran.err);
    }
}

#[test]
fn a_net_with_two_drivers_is_refused_with_both() {
    if !SLANG.is_there() {
        return;
    }
    let module = |body: &str| format!("module m(input a, b, output y, output [3:0] z);\n{body}\nendmodule\n");
    for (body, expected) in [
        (
            "assign z = {a, b, a, b};\nassign y = a & b;\nassign y = 1'b0;",
            ["`y` is driven twice: by logic and by the constant 0", "m.v:1:"],
        ),
        ("assign y = a;\nassign z = 0;\nassign z[2] = b;", ["`z[2]` is driven twice: by the constant 0", "`b`"]),
        (
            "wire w;\nassign w = a;\nassign w = ~b;\nassign y = w, z = w;",
            ["`w` is driven twice: by `a` and by logic", "m.v:2:"],
        ),
        ("assign y = a, z = 0;\nassign a = b;", ["`a` is driven twice: by the input port", "`b`"]),
    ] {
        is_refused(&module(body), &expected);
    }
    is_refused(
        "module m(input a, b, output reg y);\nalways @* y = a;\nalways @* if (b) y = 0;\nendmodule\n",
        &["`y` is driven twice"],
    );
    is_refused(
        "module m(input c, a, b, output reg y);\nalways @(posedge c) y <= a;\nalways @(posedge c) y <= b;\nendmodule\n",
        &["`y` is driven twice", "a register (line 2)", "a register (line 3)"],
    );
    // The variable of two loops is not a net that anything depends on.
    let loops = "module m(input [1:0] a, b, input c, output reg [1:0] x, y);\ninteger i;\n\
        always @* for (i = 0; i < 2; i = i + 1) x[i] = a[i];\n\
        always @(posedge c) if (a) for (i = 0; i < 2; i = i + 1) y[i] <= b[1 - i];\nendmodule\n";
    passes(loops, "test m {\n    a b c | x y\n    01 10 0 | 01 00\n    01 10 1 | 01 01\n}\n");
}

#[test]
fn labels_that_never_match_are_told() {
    if !SLANG.is_there() {
        return;
    }
    let module = |label: &str| {
        format!(
            "module m(input [1:0] a, output reg y);\nlocalparam L = 2'b1x;\nalways @* case (a)\n{label}: y = 1;\n\
             default: y = 0;\nendcase\nendmodule\n"
        )
    };
    let never = "test m {\n    a  | y\n    10 | 0\n    11 | 0\n}\n";
    for (label, told) in [("2'b1x", "2'b1x"), ("2'bx1", "2'bx1"), ("L", "2'b1x"), ("{1'bx, 1'b0}", "2'bx0")] {
        let said = passes(&module(label), never);
        assert!(said.contains(&format!("the label `{told}` never matches")), "{label}: {said}");
    }
    // In `casex` it is a wildcard.
    let wild = module("2'b1x").replace("case (a)", "casex (a)");
    let said = passes(&wild, "test m {\n    a  | y\n    00 | 0\n    01 | 0\n    10 | 1\n    11 | 1\n}\n");
    assert!(!said.contains("never matches"), "{said}");
}

#[test]
fn a_comparison_with_an_unknown_bit_is_refused() {
    if !SLANG.is_there() {
        return;
    }
    for sign in ["===", "!=="] {
        let text = format!("module m(input a, output y);\nassign y = a {sign} 1'bx;\nendmodule\n");
        is_refused(&text, &["with an unknown bit", "m.v:2:12"]);
    }
    is_refused("module m(input a, e, output y);\nbufif1(y, a, e);\nendmodule\n", &["`y` can be `z`", "m.v:2:"]);
}

#[test]
fn what_is_not_as_in_a_simulator_is_told() {
    if !SLANG.is_there() {
        return;
    }
    let test = "test m {\n    c l d | q\n    0 0 0 | 0\n}\n";
    let module = |body: &str| format!("module m(input c, l, d, output reg q);\ninitial q = 0;\n{body}\nendmodule\n");
    for (body, told) in [
        ("always @(posedge c or posedge l) if (l) q <= d; else q <= ~q;", "`q` loads a value without its clock"),
        ("function f(input a); f = a & l; endfunction\nalways @* q = f(d);", "`q` also depends on `l`"),
        ("wire [1:0] v = {l, d};\nalways @(v[0]) q = ^v;", "`q` also depends on `v`"),
        ("function f(input a); if (a) f = 1; endfunction\nalways @* q = f(d);", "a value can be `x`"),
        ("reg t;\nalways @* begin q = l & t; t = d; end", "`t` is read before it is set"),
    ] {
        let said = passes(&module(body), test);
        assert!(said.contains(told), "{body}: {said}");
    }
    // Both calls write the arguments of the function.
    let plain = "function f(input a, b); f = a & b; endfunction\nreg p;\n\
        integer i;\nalways @* begin q = f(d, l); for (i = 0; i < 1; i = i + 1) q = q & d; end\n\
        always @* p = f(c, l);";
    assert!(!passes(&module(plain), test).contains("warning"));
}

#[test]
fn wide_shift_amounts_shift_everything_out() {
    if !SLANG.is_there() {
        return;
    }
    let text = "module m(input [7:0] s, output [7:0] a, b, c, d, output signed [7:0] e);\n\
        assign a = s >> 33'h0ffffffff;\nassign b = s << 32'hffffffff;\nassign c = s >>> 40'd2;\n\
        assign d = s >> {s[7], 34'd1};\nassign e = $signed(s) >>> 35'h7ffffffff;\nendmodule\n";
    let rows = "test m {\n    s | a b c d e\n    8'h83 | 8'h00 8'h00 8'h20 8'h00 8'hff\n    \
        8'h43 | 8'h00 8'h00 8'h10 8'h21 8'h00\n}\n";
    passes(text, rows);
}

#[test]
fn parts_that_are_partly_outside_and_their_signs_are_right() {
    if !SLANG.is_there() {
        return;
    }
    let sign = "module m(input [1:0] x, output reg [6:0] y);\n\
        always @* begin y = 0; y[x +: 4] = 3'sb111; end\nendmodule\n";
    passes(sign, "test m {\n    x | y\n    00 | 0001111\n    01 | 0011110\n    10 | 0111100\n    11 | 1111000\n}\n");
    // Downward from a place without a sign, with a lowest bit that is not 0, and in a block that sets only parts.
    let parts = "module m(input [1:0] x, output reg [5:0] d, output reg [7:2] o, output [5:0] r);\n\
        always @* begin d = 6'b101010; d[x -: 3] = 3'b101; end\n\
        always @* begin o[7:4] = 0; o[3:2] = 0; o[{x, 1'b1} +: 3] = 7; end\n\
        assign r = {6{1'b1}} & 6'b110010 >> x;\nendmodule\n";
    let rows = "test m {\n    x | d o r\n    00 | 101011 000011 110010\n    01 | 101010 001110 011001\n    \
        10 | 101101 111000 001100\n    11 | 101010 100000 000110\n}\n";
    passes(parts, rows);
}

#[test]
fn variables_of_loops_keep_their_sign_and_width() {
    if !SLANG.is_there() {
        return;
    }
    let text = "module m(input signed [3:0] x, output reg [3:0] a, b, output reg [7:0] c);\n\
        integer i;\nreg [3:0] j;\nreg [1:0] k;\n\
        always @* begin a = 0; for (i = 4'd0; i < 4'd4; i = i + 4'd1) a[i] = x < i - 2; end\n\
        always @* begin b = 0; for (j = 0; j < 4; j = j + 1) b[j] = x < j; end\n\
        always @* begin c = 0; for (k = 2; k != 1; k = k + 1) c[k] = 1; end\nendmodule\n";
    // -3 < -2, -1, 0, 1; as a number without a sign, 13 is not below 0, 1, 2, 3.
    let rows = "test m {\n    x | a b c\n    1101 | 1111 0000 00001101\n    0000 | 1000 1110 00001101\n    \
        1111 | 1100 0000 00001101\n}\n";
    passes(text, rows);
}

#[test]
fn parameters_are_as_if_their_defaults_had_been_edited() {
    if !SLANG.is_there() {
        return;
    }
    let text = "module p #(parameter P = 3) (input signed [3:0] x, output k, output signed [5:0] y);\n\
        assign k = x < P;\nassign y = x * P;\nendmodule\n";
    let bench = Bench::new();
    bench.file("p.v", text);
    for (value, rows) in [
        ("11", "1111 | 1 110101\n    0101 | 1 110111"),
        ("-2", "1111 | 0 000010\n    1100 | 1 001000"),
        ("4'd11", "1111 | 0 100101\n    0101 | 1 110111"),
    ] {
        let ran = bench.run(&["synth", "p.v", "--param", &format!("P={value}"), "--cells", "all", "-o", "out.nb"]);
        assert_eq!(ran.status, 0, "{}", ran.err);
        let made = std::fs::read_to_string(bench.path().join("out.nb")).unwrap();
        bench.file("test.nb", format!("{made}\ntest p {{\n    x | k y\n    {rows}\n}}\n"));
        let ran = bench.run(&["test", "test.nb", "--logic"]);
        assert_eq!(ran.status, 0, "{value}: {}{}", ran.out, ran.err);
    }
}

#[test]
fn of_labels_that_match_the_first_counts_whatever_hints_say() {
    if !SLANG.is_there() {
        return;
    }
    for (before, hint) in [("", " // synopsys parallel_case"), ("(* parallel_case *) ", ""), ("unique ", "")] {
        let text = format!(
            "module m(input [1:0] s, output reg [1:0] z);\nalways @* {before}casez (s){hint}\n2'b1?: z = 1;\n\
             2'b?1: z = 2;\ndefault: z = 0;\nendcase\nendmodule\n"
        );
        passes(&text, "test m {\n    s  | z\n    00 | 00\n    01 | 10\n    10 | 01\n    11 | 01\n}\n");
    }
}

#[test]
fn what_prints_is_not_in_the_way() {
    if !SLANG.is_there() {
        return;
    }
    let text = "`define CAT(a, b) a``b\nmodule m(input c, x, output reg q);\nwire `CAT(t, 1) = x;\n\
        initial $display(\"%b\", q);\n\
        always @(posedge c) begin\n  if (x) $display(\"x\"); else q <= t1;\n  if (t1) q <= t1;\nend\nendmodule\n";
    passes(text, "test m {\n    c x | q\n    0 1 | 0\n    1 1 | 1\n    0 0 | 1\n    1 0 | 0\n}\n");
}

#[test]
fn a_choice_of_all_cases_is_no_latch_and_a_latch_is_called_one() {
    if !SLANG.is_there() {
        return;
    }
    let text = "module m(input a, b, p, q, r, s, output reg o);\n\
        always @* if (!a && !b) o = p; else if (!a && b) o = q;\n\
        else if (a && !b) o = r; else if (a && b) o = s;\nendmodule\n";
    let rows = "test m {\n    a b p q r s | o\n    0 0 1 0 0 0 | 1\n    0 1 1 0 1 1 | 0\n    1 0 0 0 1 0 | 1\n    \
        1 1 1 1 1 0 | 0\n    1 1 0 0 0 1 | 1\n}\n";
    passes(text, rows);
    let latch = "module m(input a, b, p, output reg o);\nalways @* if (a && b) o = p;\nendmodule\n";
    is_refused(latch, &["`o` is a latch", "m.v:"]);
}

#[test]
fn several_files_are_one_design() {
    if !SLANG.is_there() {
        return;
    }
    let bench = Bench::new();
    std::fs::create_dir(bench.path().join("parts")).unwrap();
    bench.file("parts/alu.v", "`ifdef WIDE\nmodule alu(input a, output q);\nassign q = ~a;\nendmodule\n`endif\n");
    bench.file("parts/a_top.v", "`define WIDE\nmodule top(input a, output q);\nalu u(a, q);\nendmodule\n");
    let synth = |files: &[&str]| bench.run(&[&["synth", "--cells", "nand,not"], files].concat());
    assert_eq!(synth(&["parts/a_top.v", "parts/alu.v"]).status, 0);
    synth(&["parts/a_top.v"]).expect_fault(&["alu"]);
    synth(&["parts/a_top.v", "x.blif"]).expect_fault(&["only Verilog"]);
    for path in ["parts", "parts/"] {
        bench.file("m.nb", format!("use \"{path}\"\n\ntest top {{\n    a | q\n    0 | 1\n    1 | 0\n}}\n"));
        let ran = bench.run(&["test", "m.nb", "--logic"]);
        assert_eq!(ran.status, 0, "{}{}", ran.out, ran.err);
    }
    // A fault is at its line of its file.
    bench.file("parts/alu.v", "module alu(input a, output q);\n\nassign q = ~;\nendmodule\n");
    for arguments in [&["check", "m.nb"][..], &["synth", "parts/a_top.v", "parts/alu.v", "--cells", "nand,not"]] {
        bench.run(arguments).expect_fault(&["parts/alu.v:3:"]);
    }
}
