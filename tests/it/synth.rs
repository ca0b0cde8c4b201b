//! `nbc synth` and `nbc build` through the real program: what they read, write, prove and refuse.

use std::process::Command;

use crate::cli::Bench;
use crate::language::root;

const FULL_ADDER: &str = "\
.model fa
.inputs a b c
.outputs s co
.names a b c s
100 1
010 1
001 1
111 1
.names a b c co
11- 1
1-1 1
-11 1
.end
";

/// Two bits that count, with one clock.
const COUNTER: &str = "\
INPUT(en)
OUTPUT(q1)
q0 = DFF(n0)
q1 = DFF(n1)
n0 = XOR(q0, en)
c = AND(q0, en)
n1 = XOR(q1, c)
";

#[test]
fn a_full_adder_takes_nine_nand_cells() {
    let bench = Bench::new();
    bench.file("fa.blif", FULL_ADDER);
    let ran = bench.run(&["synth", "fa.blif", "-o", "out.blif", "--cells", "nand,not", "--format", "json"]);
    assert_eq!(ran.status, 0, "{}", ran.err);
    let report: serde_json::Value = serde_json::from_str(&ran.out).unwrap();
    assert_eq!((&report["cells"], &report["proved"]), (&9.into(), &true.into()));
    assert_eq!((&report["inputs"], &report["outputs"], &report["latches"]), (&3.into(), &2.into(), &0.into()));
}

#[test]
fn what_is_written_reads_back_in_every_format() {
    let bench = Bench::new();
    bench.file("fa.blif", FULL_ADDER);
    for ending in ["blif", "aig", "aag"] {
        let out = format!("out.{ending}");
        assert_eq!(bench.run(&["synth", "fa.blif", "-o", &out, "--cells", "all"]).status, 0);
        let again = bench.run(&["synth", &out, "--cells", "all", "--format", "json"]);
        let report: serde_json::Value = serde_json::from_str(&again.out).unwrap();
        assert_eq!(report["cells"], 5, "{ending}");
        // ABC reads the binary form only.
        if ending != "aag" {
            equivalent(&bench, "fa.blif", &out);
        }
    }
    for ending in ["v", "dot", "nb"] {
        assert_eq!(bench.run(&["synth", "fa.blif", "-o", &format!("out.{ending}"), "--cells", "all"]).status, 0);
    }
    assert_eq!(bench.run(&["build", "out.nb", "--cells", "nand,not", "--emit", "blif", "-o", "again.blif"]).status, 0);
    equivalent(&bench, "fa.blif", "again.blif");
}

#[test]
fn registers_are_kept_or_made_of_cells() {
    let bench = Bench::new();
    bench.file("counter.bench", COUNTER);
    let ran = bench.run(&["synth", "counter.bench", "-o", "kept.blif", "--cells", "nand,not", "--format", "json"]);
    let report: serde_json::Value = serde_json::from_str(&ran.out).unwrap();
    assert_eq!(report["latches"], 2);
    abc_agrees(&bench, "dsec", "counter.bench", "kept.blif");
    let ran = bench.run(&["synth", "counter.bench", "-o", "cells.nb", "--cells", "nand,not", "--format", "json"]);
    let expanded: serde_json::Value = serde_json::from_str(&ran.out).unwrap();
    // Eight cells a flip-flop, and one inverter for the clock of both.
    assert_eq!(expanded["cells"].as_u64().unwrap(), report["cells"].as_u64().unwrap() + 17);
    assert_eq!(bench.run(&["build", "cells.nb", "--cells", "nand,not"]).status, 0);
}

#[test]
fn a_missing_gate_is_valued() {
    let bench = Bench::new();
    bench.file("fa.blif", FULL_ADDER);
    let arguments = ["synth", "fa.blif", "--cells", "nand,not", "--what-if", "xor,and", "--format", "json"];
    let report = bench.run(&arguments).expect_json();
    assert_eq!(report["what_if"], serde_json::json!({ "xor": 4, "and": 0 }));
    let told = bench.run(&arguments[..6]);
    assert!(told.out.contains("with `xor`: 4 cells fewer\n"), "{}", told.out);
}

#[test]
fn timing_memory_and_fan_out_are_reported() {
    let bench = Bench::new();
    let latch = std::fs::read_to_string("circuits/latch.nb").unwrap();
    bench.file("latch.nb", latch);
    let report = bench.run(&["build", "latch.nb", "--cells", "nand,not", "--emit", "json"]).expect_json();
    // Two cells on the way in, twice through the pair less where it was entered.
    assert_eq!((&report["hold"], &report["races"]), (&5.into(), &serde_json::json!([])));
    assert_eq!(report["memory"], serde_json::json!([{ "nets": ["q", "nq"], "pulse": 2, "setup": 3, "hold": 1 }]));
    let q = report["cells"].as_array().unwrap().iter().find(|cell| cell["name"] == "q").unwrap();
    let number = |key: &str| q[key].as_u64().unwrap();
    assert_eq!(number("required") - number("arrival"), number("slack"));
    assert_eq!(number("fan_out"), 2);
}

#[test]
fn the_delay_objective_makes_fewer_levels() {
    let folder = root().join("tests/benchmarks/pop8.blif");
    let depth = |objective: &str| {
        let bench = Bench::new();
        let source = folder.to_str().unwrap();
        let ran = bench.run(&["synth", source, "--cells", "nand,not", "--objective", objective, "--format", "json"]);
        ran.expect_json()["depth"].as_u64().unwrap()
    };
    let (area, delay) = (depth("area"), depth("delay"));
    assert!(delay < area, "{delay} levels by delay, {area} by area");
}

#[test]
fn the_same_source_gives_the_same_cells() {
    let bench = Bench::new();
    bench.file("fa.blif", FULL_ADDER);
    for objective in ["area", "delay", "margin"] {
        let written = ["one.blif", "two.blif"].map(|out| {
            let ran = bench.run(&["synth", "fa.blif", "-o", out, "--objective", objective]);
            assert_eq!(ran.status, 0, "{}", ran.err);
            std::fs::read_to_string(bench.path().join(out)).unwrap()
        });
        assert_eq!(written[0], written[1]);
    }
}

/// A Yosys that writes `flat.blif`, whatever it is given.
const FAKE_YOSYS: &str = "#!/bin/sh
out=$(echo \"$3\" | sed 's/.*write_blif \"\\(.*\\)\"/\\1/')
cp flat.blif \"$out\"
";

#[cfg(unix)]
#[test]
fn verilog_is_read_through_yosys() {
    use std::os::unix::fs::PermissionsExt;
    let bench = Bench::new();
    bench.file("fa.v", "module fa(input a, b, c, output s, co); assign {co, s} = a + b + c; endmodule\n");
    bench.file("flat.blif", FULL_ADDER);
    let synth = |path: String| {
        let mut command = bench.command(&["synth", "fa.v", "--cells", "all", "--format", "json"]);
        command.env("PATH", path).output().unwrap()
    };
    let missing = synth("/nowhere".to_owned());
    assert_eq!(missing.status.code(), Some(2));
    let said = String::from_utf8(missing.stderr).unwrap();
    assert!(said.contains("not installed") && said.contains("apt-get install yosys"), "{said}");
    let fake = bench.file("yosys", FAKE_YOSYS);
    std::fs::set_permissions(fake, std::fs::Permissions::from_mode(0o755)).unwrap();
    let found = synth(format!("{}:/usr/bin:/bin", bench.path().display()));
    let report: serde_json::Value = serde_json::from_slice(&found.stdout).expect("a report in JSON");
    assert_eq!(report["cells"], 5);
}

/// A latch, and a flip-flop behind an adder.
const REGISTERS: &str = "\
module registers(input clk, en, input [1:0] a, output reg [1:0] sum, output reg held);
always @(posedge clk) sum <= sum + a;
always @(*) if (en) held = ^a;
endmodule
";

#[test]
fn yosys_keeps_latches_and_flip_flops() {
    if Command::new("yosys").arg("-V").output().is_err() {
        assert!(std::env::var_os("CI").is_none(), "CI must have yosys");
        eprintln!("yosys is not installed, so Verilog is not read");
        return;
    }
    let bench = Bench::new();
    bench.file("registers.v", REGISTERS);
    let report = bench.run(&["synth", "registers.v", "-o", "out.blif", "--cells", "all", "--format", "json"]);
    let report = report.expect_json();
    assert_eq!((&report["latches"], &report["proved"]), (&3.into(), &true.into()));
    let written = std::fs::read_to_string(bench.path().join("out.blif")).unwrap();
    let kinds = |kind: &str| written.lines().filter(|line| line.starts_with(".latch") && line.contains(kind)).count();
    assert_eq!((kinds(" re "), kinds(" ah ")), (2, 1), "{written}");
    bench.file("broken.v", "module broken(input a; endmodule\n");
    bench.run(&["synth", "broken.v", "--cells", "all"]).expect_fault(&["yosys cannot read"]);
}

/// Runs `nbc synth` on a text that is at fault, and compares the first line of the message.
fn refused(name: &str, text: &str, expected: &str) {
    let bench = Bench::new();
    bench.file(name, text);
    let ran = bench.run(&["synth", name, "-o", "out.blif", "--cells", "nand"]);
    assert_eq!(ran.status, 2, "{}", ran.err);
    assert!(ran.err.contains(expected), "expected `{expected}`, found\n{}", ran.err);
    assert!(!bench.path().join("out.blif").exists());
}

#[test]
fn damaged_files_are_refused_with_a_reason() {
    refused("a.blif", "", "no `.model` in this BLIF file");
    refused("a.blif", ".model a\n.inputs x\n.outputs y\n.names z y\n1 1\n", "`z` is used and not defined");
    refused("a.blif", ".model a\n.outputs y\n.names y y\n1 1\n", "`y` depends on itself");
    refused("a.blif", ".model a\n.inputs x\n.outputs y\n.names x y\n11 1\n", "a row of the wrong width");
    refused("a.blif", ".model a\n.inputs x\n.outputs y\n.subckt gone a=x b=y\n", "model `gone` is missing");
    refused("a.blif", ".model a\n.inputs x\n.outputs y\n.latch x y 0\n", "latch `y` has no clock");
    refused("a.bench", "OUTPUT(y)\ny = MUX(a, b)\n", "`MUX` of 2 nets is no gate of .bench");
    refused("a.aag", "aag 1 1 0 1", "the file ends too early");
    refused("a.aag", "aag 3 1 0 1 2\n2\n6\n4 6 2\n6 4 2\n", "depends on itself");
    refused("a.aig", "aig 9 1 0 1 8\n2\n", "the file ends too early");
}

#[test]
fn an_incomplete_library_says_what_would_complete_it() {
    let bench = Bench::new();
    bench.file("fa.blif", FULL_ADDER);
    let ran = bench.run(&["synth", "fa.blif", "--cells", "xor,not"]);
    assert_eq!(ran.status, 2);
    assert!(ran.err.contains("cannot be made of `not` and `xor`"), "{}", ran.err);
}

/// Lets ABC prove two files without registers equal.
fn equivalent(bench: &Bench, one: &str, two: &str) {
    abc_agrees(bench, "cec", one, two);
}

/// Lets ABC prove two files equal, where it is installed; under CI it must be.
fn abc_agrees(bench: &Bench, command: &str, one: &str, two: &str) {
    let script = format!("{command} {one} {two}");
    let Ok(output) = Command::new("berkeley-abc").args(["-c", &script]).current_dir(bench.path()).output() else {
        assert!(std::env::var_os("CI").is_none(), "CI must have berkeley-abc");
        eprintln!("berkeley-abc is not installed, so {two} is not compared by it");
        return;
    };
    let said = String::from_utf8_lossy(&output.stdout).into_owned();
    assert!(said.contains("Networks are equivalent"), "{said}");
}
