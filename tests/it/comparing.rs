//! Verilog as two readers read it, and what a result says of its proof.

use crate::support::*;

/// A counter with a reset, which starts at 5, and a register without a start value.
const COUNTER: &str = "\
module counter(input clk, input rst_n, input en, input [2:0] step, output reg [5:0] count, output reg odd);
  initial count = 5;
  always @(posedge clk or negedge rst_n) if (!rst_n) count <= 0; else if (en) count <= count + step;
  always @(negedge clk) odd <= count[0];
endmodule
";

/// What `nbc synth` says on standard error of a text, and the proof of its report.
fn read(text: &str) -> (String, Value) {
    let ran = Bench::with("m.sv", text).ok("synth m.sv --cells nand,not --format json");
    (ran.err.clone(), ran.expect_json()["proof"].clone())
}

#[test]
fn a_result_says_what_both_readers_make_of_a_file() {
    let Some(_) = SLANG.find() else { return };
    let bench = Bench::with("m.sv", COUNTER);
    // Yosys does not read `timeunit`.
    bench.file("t.sv", "module m(input logic a, output logic q);\n  timeunit 1ns;\n  assign q = ~a;\nendmodule\n");
    bench.file("and.blif", ".model m\n.inputs a b\n.outputs y\n.names a b y\n11 1\n.end\n");
    let proof = bench.ok("synth m.sv --cells nand,not --format json").expect_json()["proof"].clone();
    let version = proof["version"].as_str().unwrap();
    assert_eq!(proof, json!({ "from": "slang", "version": version, "second": "alike" }));
    for (file, says) in [
        ("m.sv", "proved from the file, read alike by slang and by yosys,"),
        ("m.sv", &format!("read by Yosys {version}\n")),
        ("t.sv", "proved from slang's reading of the file, which yosys cannot read,"),
        ("and.blif", "proved from the file,"),
    ] {
        let ran = bench.ok(&["synth", file, "--cells", "nand,not"]);
        assert!(ran.out.contains(says) || ran.err.contains(says), "{says}: {}{}", ran.out, ran.err);
    }
}

/// Yosys drops the part in the concatenation; the difference shows at once, at one key of 2^32, and after 2^20 edges.
const DROPPED: [(&str, &str, &str); 3] = [
    ("", "read module `m` differently", "`y` is "),
    ("if (key == 32'hdeadbeef)", "read module `m` differently", "key = 11011110101011011011111011101111"),
    (
        "if (n[20])",
        "may read module `m` differently",
        "in the state n = 100000000000000000000, which may never be reached",
    ),
];

#[test]
fn a_difference_between_both_readers_is_told_with_a_run() {
    let Some(_) = SLANG.find() else { return };
    for (condition, message, run) in DROPPED {
        let (said, proof) = read(&format!(
            "module m(input clk, input [31:0] key, input [2:0] x, input [4:0] s, output reg [7:0] y);\n\
             reg [20:0] n = 0; reg [7:0] t; reg u;\nalways @(posedge clk) if (!n[20]) n <= n + 1;\n\
             always @* begin t = 0; {{u, t[x +: 4]}} = s; end\n\
             always @* begin y = 0; {condition} y = t; end\nendmodule\n"
        ));
        let is_told = ["slang and yosys ", message, run, "slang's reading is used", "m.sv:1:8"];
        assert!(is_told.iter().all(|words| said.contains(words)), "{condition}: {said}");
        let is_sure = !message.contains("may");
        assert_eq!(proof["second"], if is_sure { "different" } else { "equal" }, "{said}");
        assert_eq!(proof["steps"].as_u64().is_some(), !is_sure);
    }
}

#[test]
fn programs_say_what_their_used_circuits_were_proved_from() {
    let Some(_) = SLANG.find() else { return };
    let bench = Bench::new();
    let module = |name: &str| format!("module {name}(input a, output y); assign y = ~a; endmodule\n");
    bench.file("m.v", module("one") + &module("two"));
    bench.file("both.blif", ".model both\n.inputs a b\n.outputs y\n.names a b y\n11 1\n.end\n");
    bench.file("p.nb", "use \"m.v\"\nuse \"both.blif\"\n\ntest one { a | y\n    0 | 1 }\n");
    let version = bench.run("synth m.v --top one --format json").expect_json()["proof"]["version"].clone();
    let verilog = format!(
        "m.v: `one` and `two` proved from the file, read alike by slang and by yosys (Yosys {})\n",
        version.as_str().unwrap()
    );
    for arguments in [&["test", "p.nb", "--logic"][..], &["build", "p.nb", "--circuit", "one"]] {
        let ran = bench.ok(arguments);
        let lines = format!("{verilog}both.blif: `both` proved from the file\n");
        assert!(ran.err.contains(&lines) && !ran.out.contains("proved from"), "{arguments:?}: {}", ran.err);
    }
}

#[test]
fn an_incomplete_list_of_events_is_told_and_a_complete_one_is_not() {
    let Some(_) = SLANG.find() else { return };
    let module = |(at, events): (usize, &str)| {
        format!(
            "module m{at}(input a, b, input [3:0] c, output reg y);\ninteger i;\n\
             always @({events}) begin y = a & b; for (i = 0; i < 4; i = i + 1) y = y ^ c[i]; end\nendmodule\n"
        )
    };
    let lacking = read(&module((0, "a or c"))).0;
    assert!(lacking.contains("`y` also depends on `b`, which its list of events lacks"), "{lacking}");
    let complete: String = ["a or b or c", "a, b, c", "*"].into_iter().enumerate().map(module).collect();
    let bench = Bench::with("m.v", complete);
    bench.file("m.nb", "use \"m.v\"\n");
    let said = bench.ok("check m.nb").err;
    assert!(!said.contains("events"), "{said}");
}

/// Modules that leave values open: registers without a start, `x`, and outputs that depend on them by an `if`.
const OPEN: [&str; 5] = [
    "module m(input clk, d, output reg q, output n); always @(posedge clk) q <= d; assign n = ~q; endmodule",
    "module m(input [1:0] s, output reg [1:0] y); always @* case (s) 0: y = 1; 1: y = 2; default: y = 2'bx; endcase \
     endmodule",
    "module m(input [1:0] s, output reg y); reg t; always @* begin t = 1'bx; if (s == 1) t = 0; if (s == 2) t = 1; \
     if (t) y = 1; else y = 0; end endmodule",
    "module m(input clk, go, output reg [1:0] s, output busy); always @(posedge clk) if (s == 0) s <= {go, go}; \
     else s <= s - 1; assign busy = s != 0; endmodule",
    "module m(input clk, input [1:0] a, input w, d, output q); reg [3:0] t [0:3]; always @(posedge clk) \
     if (w) t[a] <= {d, 3'b101}; assign q = ^t[a]; endmodule",
];

#[test]
fn what_a_source_leaves_open_is_no_difference() {
    let Some(_) = SLANG.find() else { return };
    let named = |(at, text): (usize, &&str)| text.replacen("module m(", &format!("module m{at}("), 1) + "\n";
    let bench = Bench::with("m.v", OPEN.iter().enumerate().map(named).collect::<String>());
    bench.file("m.nb", "use \"m.v\"\n\ntest m0 {\n    clk d | q\n    0 0 | -\n}\n");
    let said = bench.ok("test m.nb --logic").err;
    let alike = "`m0`, `m1`, `m2`, `m3` and `m4` proved from the file, read alike by slang and by yosys";
    assert!(said.contains(alike), "{said}");
}

/// Both directions of ranges, and numbers below 0.
const RANGES: &str = "\
module ranges(input clk, input [0:3] a, input [7:4] b, input [-1:2] c, output [0:3] y, output [4:7] z,
              output [1:-2] w, output reg [0:3] s);
  assign y = a + 4'd1;
  assign z = b;
  assign w = {c[-1], c[0], c[1], c[2]};
  always @(posedge clk) s <= a;
endmodule
";

#[test]
fn ranges_that_count_upwards_keep_their_direction() {
    let Some(_) = SLANG.find() else { return };
    let bench = Bench::with("ranges.v", RANGES);
    let ran = bench.ok("synth ranges.v --cells nand,not -o out.v");
    let written = bench.read("out.v");
    let head = "module ranges(input clk, input [0:3] a, input [7:4] b, input [-1:2] c, output [0:3] y, \
                output [4:7] z, output [1:-2] w, output [0:3] s);\n";
    assert!(written.starts_with(head), "{written}");
    // The leftmost bit is the highest.
    let rows = "test ranges {\n    clk a b c | y z w s\n    0 4'd1 4'd2 4'd3 | 4'd2 4'd2 4'd3 4'd0\n    \
                1 4'd1 4'd2 4'd3 | 4'd2 4'd2 4'd3 4'd1\n}\n";
    let note = "are numbered from 0 at the right in .nb";
    assert!(!ran.err.contains(note), "{}", ran.err);
    let ran = bench.run("synth ranges.v --cells nand,not -o made.nb");
    assert!(ran.err.contains(&format!("the bits of `a`, `b`, `c`, `y`, `z`, `w` and `s` {note}")), "{}", ran.err);
    for file in ["ranges.v", "out.v", "made.nb"] {
        bench.file("used.nb", format!("use \"{file}\"\n\n{rows}"));
        bench.ok("test used.nb --logic");
    }
}

/// Registers that start otherwise than their reset, and without a start.
const STARTS: &str = "\
module starts(input clk, input s, input d, output reg q, output reg p, output reg c);
  initial q = 0;
  initial p = 1;
  always @(posedge clk or posedge s) if (s) q <= 1; else q <= d;
  always @(posedge clk or posedge d) if (d) p <= 0; else p <= ~s;
  always @(posedge clk) c <= c ^ d;
endmodule
";

#[test]
fn start_values_are_written_whatever_a_reset_does() {
    let Some(_) = SLANG.find() else { return };
    let bench = Bench::with("starts.v", STARTS);
    let rows = "test starts {\n    clk s d | q p c\n    0 0 0 | 0 1 0\n    0 1 0 | 1 1 0\n    0 0 1 | 1 0 0\n    \
                1 0 1 | 1 0 1\n    0 0 0 | 1 0 1\n    1 0 0 | 0 1 1\n}\n";
    for out in ["out.v", "out.blif"] {
        bench.ok(&["synth", "starts.v", "-o", out, "--cells", "nand,not"]);
    }
    let written = bench.read("out.v");
    let registers: Vec<&str> = written.lines().filter(|line| line.starts_with("    reg ")).collect();
    assert!(registers.len() == 3 && registers.iter().all(|line| line.ends_with(" = 1'b0;")), "{written}");
    for file in ["starts.v", "out.v", "out.blif"] {
        bench.file("used.nb", format!("use \"{file}\"\n\n{rows}"));
        bench.ok("test used.nb --logic");
    }
    bench.ok("synth starts.v -o made.nb --cells nand,not");
    bench.file("used.nb", format!("use \"made.nb\"\n\n{rows}"));
    bench.ok("test used.nb --logic");
}
