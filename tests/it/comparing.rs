//! Verilog beside its translation in Icarus Verilog, and what a result says of its proof.

use std::path::PathBuf;

use crate::support::bench::Bench;
use crate::support::limits::InTime;
use crate::support::tools::{IVERILOG, YOSYS};

/// A counter with a reset, which starts at 5, and a register without a start value.
const COUNTER: &str = "\
module counter(input clk, input rst_n, input en, input [2:0] step, output reg [5:0] count, output reg odd);
  initial count = 5;
  always @(posedge clk or negedge rst_n) if (!rst_n) count <= 0; else if (en) count <= count + step;
  always @(negedge clk) odd <= count[0];
endmodule
";

/// A folder of programs with some tools and no others.
#[cfg(unix)]
fn only(bench: &Bench, tools: &[PathBuf]) -> PathBuf {
    let folder = bench.path().join("tools");
    std::fs::create_dir_all(&folder).unwrap();
    for tool in tools {
        let link = folder.join(tool.file_name().unwrap());
        let _ = std::fs::remove_file(&link);
        std::os::unix::fs::symlink(std::fs::canonicalize(tool).unwrap(), link).unwrap();
    }
    folder
}

/// What `nbc synth` says with programs of these folders only.
fn synth(bench: &Bench, file: &str, path: &str) -> (bool, String) {
    let ran = bench.command(&["synth", file, "--cells", "nand,not"]).env("PATH", path).output_in_time();
    let said = [ran.stdout, ran.stderr].map(|bytes| String::from_utf8(bytes).unwrap()).concat();
    (ran.status.success(), said)
}

#[cfg(unix)]
#[test]
fn a_result_says_what_it_was_proved_from() {
    let (Some(yosys), Some(_)) = (YOSYS.find(), IVERILOG.find()) else { return };
    let bench = Bench::new();
    bench.file("counter.v", COUNTER);
    let ran = bench.run(&["synth", "counter.v", "--cells", "nand,not"]);
    assert!(ran.out.contains("proved from yosys' netlist, 4,096 steps equal in iverilog,"), "{}{}", ran.out, ran.err);
    let report = bench.run(&["synth", "counter.v", "--cells", "nand,not", "--format", "json"]).expect_json();
    let version = report["proof"]["version"].as_str().unwrap();
    let expected = serde_json::json!({"from": "yosys", "version": version, "simulator": "iverilog", "steps": 4096});
    assert_eq!(report["proof"], expected);
    assert!(ran.out.contains(&format!("read by Yosys {version}\n")), "{}", ran.out);
    let without = only(&bench, &[yosys]);
    let (is_done, said) = synth(&bench, "counter.v", without.to_str().unwrap());
    let words = "proved from yosys' netlist, which was not simulated: iverilog is not installed";
    assert!(is_done && said.contains(words), "{said}");
    bench.file("and.blif", ".model m\n.inputs a b\n.outputs y\n.names a b y\n11 1\n.end\n");
    let ran = bench.run(&["synth", "and.blif", "--cells", "nand,not"]);
    assert!(ran.out.contains("proved from the file,"), "{}", ran.out);
}

#[test]
fn programs_say_what_their_used_circuits_were_proved_from() {
    if !YOSYS.is_there() || !IVERILOG.is_there() {
        return;
    }
    let bench = Bench::new();
    let module = |name: &str| format!("module {name}(input a, output y); assign y = ~a; endmodule\n");
    bench.file("m.v", module("one") + &module("two"));
    bench.file("both.blif", ".model both\n.inputs a b\n.outputs y\n.names a b y\n11 1\n.end\n");
    bench.file("p.nb", "use \"m.v\"\nuse \"both.blif\"\n\ntest one { a | y\n    0 | 1 }\n");
    let version =
        bench.run(&["synth", "m.v", "--top", "one", "--format", "json"]).expect_json()["proof"]["version"].clone();
    let verilog = format!(
        "m.v: `one` and `two` proved from yosys' netlist, 4,096 steps equal in iverilog (Yosys {})\n",
        version.as_str().unwrap()
    );
    for arguments in [&["test", "p.nb", "--logic"][..], &["build", "p.nb", "--circuit", "one"]] {
        let ran = bench.run(arguments);
        assert_eq!(ran.status, 0, "{}", ran.err);
        let lines = format!("{verilog}both.blif: `both` proved from the file\n");
        assert!(ran.err.contains(&lines) && !ran.out.contains("proved from"), "{arguments:?}: {}", ran.err);
    }
    // An old version is told once, at its first use.
    let minor = version.as_str().unwrap().split_once('.').and_then(|(_, minor)| minor.parse::<u32>().ok());
    let is_old = minor.is_some_and(|minor| minor < 60);
    bench.file("q.nb", "use \"m.v\"\nuse \"n.v\"\n");
    bench.file("n.v", module("n"));
    let said = bench.run(&["check", "q.nb"]).err;
    assert_eq!(said.matches("which is old").count(), usize::from(is_old), "{said}");
}

/// A program that takes the place of Yosys and gives this netlist for every text.
#[cfg(unix)]
fn with_netlist(bench: &Bench, blif: &str) -> String {
    use std::os::unix::fs::PermissionsExt;
    bench.file("flat.blif", blif);
    bench.file("written.il", "\nmodule \\m\n  wire output 1 \\y\nend\n");
    let fake = "#!/bin/sh\nhere=$(dirname \"$0\")\ncp \"$here/flat.blif\" \"$here/written.il\" .\n\
                touch chosen.il flat.il undriven.txt\n";
    std::fs::set_permissions(bench.file("yosys", fake), std::fs::Permissions::from_mode(0o755)).unwrap();
    format!("{}:{}", bench.path().display(), std::env::var("PATH").unwrap())
}

/// Modules with a wrong netlist for each, and the output that differs.
const MISREAD: [(&str, &str, &str); 3] = [
    (
        "module m(input a, b, output y); assign y = a & b; endmodule\n",
        ".model m\n.inputs a b\n.outputs y\n.names a b y\n1- 1\n.end\n",
        "`y` is 0 in iverilog, and 1 in yosys' netlist",
    ),
    // A register with another start value shows it at the start.
    (
        "module m(input clk, d, output reg q); initial q = 1; always @(posedge clk) q <= d; endmodule\n",
        ".model m\n.inputs clk d\n.outputs q\n.latch d q re clk 0\n.end\n",
        "step 0: `q` is 1 in iverilog, and 0 in yosys' netlist",
    ),
    // A register of the other edge.
    (
        "module m(input clk, d, output reg q); always @(posedge clk) q <= d; endmodule\n",
        ".model m\n.inputs clk d\n.outputs q\n.latch d q fe clk 0\n.end\n",
        " in iverilog, and ",
    ),
];

#[cfg(unix)]
#[test]
fn a_netlist_that_differs_from_its_source_is_an_error_with_the_step() {
    if !IVERILOG.is_there() {
        return;
    }
    for (source, blif, expected) in MISREAD {
        let bench = Bench::new();
        let path = with_netlist(&bench, blif);
        bench.file("m.v", source);
        bench.file("m.nb", "use \"m.v\"\n");
        let check = bench.command(&["check", "m.nb"]).env("PATH", &path).output_in_time();
        let check = (check.status.success(), String::from_utf8(check.stderr).unwrap());
        for (is_done, said) in [synth(&bench, "m.v", &path), check] {
            let told = said.contains("yosys misreads module `m` of `m.v`") && said.contains("step ");
            assert!(!is_done && told && said.contains(expected), "{source}: {said}");
        }
    }
}

#[test]
fn an_incomplete_sensitivity_list_is_told() {
    if !YOSYS.is_there() || !IVERILOG.is_there() {
        return;
    }
    let bench = Bench::new();
    bench.file("m.v", "module m(input a, b, output reg y);\nalways @(a) y = a & b;\nendmodule\n");
    bench.run(&["synth", "m.v", "--cells", "nand,not"]).expect_fault(&["misreads module `m`", "sensitivity", "m.v:1:"]);
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
    if !YOSYS.is_there() || !IVERILOG.is_there() {
        return;
    }
    let bench = Bench::new();
    for (at, source) in OPEN.into_iter().enumerate() {
        bench.file("m.v", format!("{source}\n"));
        let ran = bench.run(&["synth", "m.v", "--cells", "nand,not"]);
        let compared = ran.out.contains(" steps equal in iverilog");
        assert!(ran.status == 0 && compared, "{at}: {}{}", ran.out, ran.err);
    }
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
    if !YOSYS.is_there() {
        return;
    }
    let bench = Bench::new();
    bench.file("ranges.v", RANGES);
    let ran = bench.run(&["synth", "ranges.v", "--cells", "nand,not", "-o", "out.v"]);
    assert_eq!(ran.status, 0, "{}", ran.err);
    let written = std::fs::read_to_string(bench.path().join("out.v")).unwrap();
    let head = "module ranges(input clk, input [0:3] a, input [7:4] b, input [-1:2] c, output [0:3] y, \
                output [4:7] z, output [1:-2] w, output [0:3] s);\n";
    assert!(written.starts_with(head), "{written}");
    // The leftmost bit is the highest.
    let rows = "test ranges {\n    clk a b c | y z w s\n    0 4'd1 4'd2 4'd3 | 4'd2 4'd2 4'd3 4'd0\n    \
                1 4'd1 4'd2 4'd3 | 4'd2 4'd2 4'd3 4'd1\n}\n";
    let note = "are numbered from 0 at the right in .nb";
    assert!(!ran.err.contains(note), "{}", ran.err);
    let ran = bench.run(&["synth", "ranges.v", "--cells", "nand,not", "-o", "made.nb"]);
    assert!(ran.err.contains(&format!("the bits of `a`, `b`, `c`, `y`, `z`, `w` and `s` {note}")), "{}", ran.err);
    for file in ["ranges.v", "out.v", "made.nb"] {
        bench.file("used.nb", format!("use \"{file}\"\n\n{rows}"));
        let ran = bench.run(&["test", "used.nb", "--logic"]);
        assert_eq!(ran.status, 0, "{file}: {}{}", ran.out, ran.err);
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
    if !YOSYS.is_there() {
        return;
    }
    let bench = Bench::new();
    bench.file("starts.v", STARTS);
    let rows = "test starts {\n    clk s d | q p c\n    0 0 0 | 0 1 0\n    0 1 0 | 1 1 0\n    0 0 1 | 1 0 0\n    \
                1 0 1 | 1 0 1\n    0 0 0 | 1 0 1\n    1 0 0 | 0 1 1\n}\n";
    for out in ["out.v", "out.blif"] {
        assert_eq!(bench.run(&["synth", "starts.v", "-o", out, "--cells", "nand,not"]).status, 0, "{out}");
    }
    let written = std::fs::read_to_string(bench.path().join("out.v")).unwrap();
    let registers: Vec<&str> = written.lines().filter(|line| line.starts_with("    reg ")).collect();
    assert!(registers.len() == 3 && registers.iter().all(|line| line.ends_with(" = 1'b0;")), "{written}");
    for file in ["starts.v", "out.v", "out.blif"] {
        bench.file("used.nb", format!("use \"{file}\"\n\n{rows}"));
        let ran = bench.run(&["test", "used.nb", "--logic"]);
        assert_eq!(ran.status, 0, "{file}: {}{}\n{written}", ran.out, ran.err);
    }
    assert_eq!(bench.run(&["synth", "starts.v", "-o", "made.nb", "--cells", "nand,not"]).status, 0);
    bench.file("used.nb", format!("use \"made.nb\"\n\n{rows}"));
    let ran = bench.run(&["test", "used.nb", "--logic"]);
    assert_eq!(ran.status, 0, "{}{}", ran.out, ran.err);
}
