//! `nbc synth` and `nbc build` in the real program: what they read, write, prove and reject.

use crate::support::*;

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
fn a_full_adder_needs_nine_nand_cells() {
    let bench = Bench::with("fa.blif", FULL_ADDER);
    let ran = bench.ok("synth fa.blif -o out.blif --cells nand,not --format json");
    let report: Value = serde_json::from_str(&ran.out).unwrap();
    assert_eq!((&report["cells"], &report["proved"]), (&9.into(), &true.into()));
    assert_eq!((&report["inputs"], &report["outputs"], &report["latches"]), (&3.into(), &2.into(), &0.into()));
}

#[test]
fn every_format_reads_back() {
    let bench = Bench::with("fa.blif", FULL_ADDER);
    for ending in ["blif", "aig", "aag"] {
        let out = format!("out.{ending}");
        bench.ok(&["synth", "fa.blif", "-o", &out, "--cells", "all"]);
        let again = bench.run(&["synth", &out, "--cells", "all", "--format", "json"]);
        let report: Value = serde_json::from_str(&again.out).unwrap();
        assert_eq!(report["cells"], 5, "{ending}");
        // ABC reads the binary form only.
        if ending != "aag" {
            equivalent(&bench, "fa.blif", &out);
        }
    }
    for ending in ["v", "dot", "nb"] {
        bench.ok(&["synth", "fa.blif", "-o", &format!("out.{ending}"), "--cells", "all"]);
    }
    bench.ok("build out.nb --cells nand,not --emit blif -o again.blif");
    equivalent(&bench, "fa.blif", "again.blif");
}

#[test]
fn registers_are_kept_or_made_of_cells() {
    let bench = Bench::with("counter.bench", COUNTER);
    let ran = bench.run("synth counter.bench -o kept.blif --cells nand,not --format json");
    let report: Value = serde_json::from_str(&ran.out).unwrap();
    assert_eq!(report["latches"], 2);
    abc_agrees(&bench, "dsec", "counter.bench", "kept.blif");
    let arguments = ["synth", "counter.bench", "-o", "cells.nb", "--cells", "nand,not", "--format", "json"];
    let kept = bench.run(&arguments).expect_json();
    assert_eq!(kept["cells"], report["cells"]);
    let written = bench.read("cells.nb");
    assert!(written.starts_with("circuit main(en, clk) -> (q1) {\n") && written.contains(" = register("), "{written}");
    bench.ok("build cells.nb --cells nand,not");
    let expanded = bench.run(&[&arguments[..], &["--registers", "expand"]].concat()).expect_json();
    // Eight cells a flip-flop, and one inverter for the clock of both.
    assert_eq!(expanded["cells"].as_u64().unwrap(), report["cells"].as_u64().unwrap() + 17);
    bench.ok("build cells.nb --cells nand,not");
}

#[test]
fn what_if_reports_the_cells_saved() {
    let bench = Bench::with("fa.blif", FULL_ADDER);
    let arguments = ["synth", "fa.blif", "--cells", "nand,not", "--what-if", "xor,and", "--format", "json"];
    let report = bench.run(&arguments).expect_json();
    assert_eq!(report["what_if"], json!({ "xor": 4, "and": 0 }));
    let told = bench.run(&arguments[..6]);
    assert!(told.out.contains("with `xor`: 4 cells fewer\n"), "{}", told.out);
}

#[test]
fn timing_memory_and_fan_out_are_reported() {
    let bench = Bench::new();
    let latch = fs::read_to_string("circuits/latch.nb").unwrap();
    bench.file("latch.nb", latch);
    let report = bench.run("build latch.nb --cells nand,not --emit json").expect_json();
    // Two cells on the way in, and the pair.
    assert_eq!(report["hold"], 4);
    let latches = json!([{ "nets": ["q", "nq"], "enable": "e", "open": true }]);
    assert_eq!(report["phases"]["latches"], latches);
    assert_eq!(report["memory"], json!([{ "nets": ["q", "nq"], "pulse": 2, "setup": 3, "hold": 1 }]));
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
    let bench = Bench::with("fa.blif", FULL_ADDER);
    for objective in ["area", "delay", "margin", "sturdy"] {
        let written = ["one.blif", "two.blif"].map(|out| {
            bench.ok(&["synth", "fa.blif", "-o", out, "--objective", objective]);
            bench.read(out)
        });
        assert_eq!(written[0], written[1]);
    }
}

/// A name that ends the string of a script and begins a command.
const HOSTILE_NAME: &str = "a.v\"; exec -- touch PWNED; read_verilog -sv \"a.v";

#[cfg(unix)]
#[test]
fn a_file_name_is_not_part_of_a_script_and_includes_are_found() {
    let Some(_) = SLANG.find() else { return };
    let bench = Bench::with("width.vh", "`define WIDTH 2\n");
    let text = "`include \"width.vh\"\nmodule m(input [`WIDTH-1:0] a, output y); assign y = ^a; endmodule\n";
    for name in ["fa.v", HOSTILE_NAME, "$(touch PWNED).v", "-s.v", "new\nline.v"] {
        bench.file(name, text);
        let report = bench.run(&["synth", "--cells", "all", "--format", "json", "--", name]).expect_json();
        assert_eq!((&report["cells"], &report["inputs"]), (&1.into(), &2.into()));
    }
    assert!(!bench.has("PWNED"));
    bench.file("broken.v", "module broken(input a);\nassign = a;\nendmodule\n");
    bench.run("synth broken.v --cells all").expect_fault(&["expected", "broken.v:2:"]);
}

const REGISTERS: &str = "\
module registers(input clk, en, input [1:0] a, output reg [1:0] sum, output reg held);
always @(posedge clk) sum <= sum + a;
always @(*) if (en) held = ^a;
endmodule
";

#[test]
fn latches_and_flip_flops_of_verilog_are_registers() {
    let Some(_) = SLANG.find() else { return };
    let bench = Bench::with("registers.v", REGISTERS);
    let report = bench.run("synth registers.v -o out.blif --cells all --format json");
    let report = report.expect_json();
    assert_eq!((&report["latches"], &report["proved"]), (&3.into(), &true.into()));
    let written = bench.read("out.blif");
    let kinds = |kind: &str| written.lines().filter(|line| line.starts_with(".latch") && line.contains(kind)).count();
    assert_eq!((kinds(" re "), kinds(" ah ")), (2, 1), "{written}");
    bench.file("broken.v", "module broken(input a; endmodule\n");
    bench.run("synth broken.v --cells all").expect_fault(&["expected", "broken.v:1:"]);
}

fn refused(name: &str, text: &str, expected: &str) {
    let bench = Bench::with(name, text);
    let ran = bench.run(&["synth", name, "-o", "out.blif", "--cells", "nand"]);
    assert_eq!(ran.status, 2, "{}", ran.err);
    // Long messages are broken into lines, with a bar before all but the first.
    let said = ran.err.split_whitespace().filter(|word| *word != "│").collect::<Vec<_>>().join(" ");
    assert!(said.contains(expected), "expected `{expected}`, found\n{}", ran.err);
    assert!(!bench.has("out.blif"));
}

#[test]
fn damaged_files_are_rejected_with_a_reason() {
    refused("a.blif", "", "no `.model` in this BLIF file");
    refused("a.aag", "aag 1 1 0 1", "unexpected end of file");
    refused("a.aig", "aig 9 1 0 1 8\n2\n", "unexpected end of file");
    refused("a.xyz", "", "unrecognized circuit format of `a.xyz`; expected .blif, .pla, .aig, .aag, .bench, .v or .sv");
}

#[test]
fn errors_in_an_aiger_file_have_their_line() {
    let told = |text: &str, message: &str, line: usize| {
        refused("a.aag", text, &format!("{message}, line {line} of the AIGER file"));
    };
    told("aag 1 1 0\n", "expected five to nine numbers in the header, found 3", 1);
    told("aag a 1 0 0 0\n", "expected a header such as `aag 3 2 0 1 1`, found `aag a 1 0 0 0`", 1);
    told("blif\n", "expected `aag` or `aig`, found `blif`", 1);
    told("aag 1 2 0 0 0\n2\n4\n", "2 inputs, 0 latches and 0 gates exceed the 1 variable of the header", 1);
    told("aag 2 1 0 1 1\n2 4\n4\n4 2 2\n", "expected one literal for an input, found 2", 2);
    told("aag 2 2 0 1 0\n2\n2\n4\n", "literal 2 cannot be an input or a latch", 3);
    told("aag 2 1 1 1 0\n2\n4 2 7\n4\n", "expected the start value 0, 1 or 4 (any) of a latch, found 7", 3);
    told("aag 3 1 0 1 1\n2\n6\n4 2 2\n", "nothing drives literal 6", 3);
    told("aag 3 1 0 1 2\n2\n6\n4 6 2\n6 4 2\n", "literal 6 depends on itself", 5);
    told("aag 2 1 0 1 1\n2\n4\n4 2\n", "expected three literals of a gate, found 2", 4);
    told("aag 2 1 0 1 1\n2\n4\n4 2 9\n", "literal 9 is larger than the header allows", 4);
    told("aag 2 1 0 1 1\n2\n4\n4 2 2\nx0 q\n", "`x0 q` names no input, output or latch", 5);
}

fn equivalent(bench: &Bench, one: &str, two: &str) {
    abc_agrees(bench, "cec", one, two);
}

fn written(text: &str, file: &str, out: &str) -> String {
    let bench = Bench::with(file, text);
    bench.ok(&["synth", file, "--cells", "nand,not,and", "-o", out]);
    bench.read(out)
}

#[test]
fn an_output_that_is_an_input_keeps_its_name() {
    let text = ".model io\n.inputs a b\n.outputs a y b\n.names a b y\n11 1\n.end\n";
    let blif = written(text, "io.blif", "out.blif");
    assert!(blif.contains(".outputs a y b\n") && !blif.contains(".names a a\n"), "{blif}");
    let aiger = written(text, "io.blif", "out.aag");
    assert!(aiger.contains("o0 a\no1 y\no2 b\n"), "{aiger}");
    // A module has each name once.
    let verilog = written(text, "io.blif", "out.v");
    assert!(verilog.starts_with("module io(input a, input b, output a_1, output y, output b_1);\n"), "{verilog}");
    // An output of that name which is another net is numbered.
    let other = written(".model io\n.inputs a b\n.outputs a\n.end\n", "io.blif", "out.blif");
    assert!(other.contains(".outputs a\n"), "{other}");
}

#[test]
fn extra_counts_of_aiger_that_are_zero_are_read() {
    for extra in ["", " 0", " 0 0", " 0 0 0", " 0 0 0 0"] {
        let text = format!("aag 3 2 0 1 1{extra}\n2\n4\n6\n6 4 2\n");
        assert!(written(&text, "a.aag", "out.blif").contains(".outputs o0\n"), "{extra}");
    }
    let head = |extra: &str| format!("aag 3 2 0 1 1{extra}\n2\n4\n6\n6 4 2\n");
    refused("a.aag", &head(" 1"), "bad-state properties are not part of a circuit, and the header has 1");
    refused("a.aag", &head(" 0 2"), "invariant constraints are not part of a circuit, and the header has 2");
    refused("a.aag", &head(" 0 0 3"), "justice properties are not supported, and the header has 3");
    refused("a.aag", &head(" 0 0 0 4"), "fairness constraints are not supported, and the header has 4");
    refused("a.aag", &head(" 0 0 0 0 0"), "expected five to nine numbers in the header, found 10");
}

#[test]
fn external_dont_cares_are_ignored_with_a_warning() {
    let bench = Bench::new();
    let text = ".model m\n.inputs a b\n.outputs y\n.names a b y\n11 1\n.exdc\n.inputs a b\n.outputs y\n\
                .names a b y\n0- 1\n.end\n.model other\n.inputs x\n.outputs z\n.names x z\n0 1\n.end\n";
    bench.file("m.blif", text);
    for (top, cells) in [("m", "1 and"), ("other", "1 not")] {
        let ran = bench.run(&["synth", "m.blif", "--top", top, "--cells", "nand,not,and"]);
        assert!(ran.status == 0 && ran.out.contains(cells), "{}{}", ran.out, ran.err);
        assert!(ran.err.contains("external don't-cares are ignored") && ran.err.contains("m.blif:6:1"), "{}", ran.err);
    }
    bench.file("m.nb", "use \"m.blif\"\n\ntest m {\n    a b | y\n    0 1 | 0\n    1 1 | 1\n}\n");
    let ran = bench.run("test m.nb --logic");
    assert!(ran.status == 0 && ran.err.contains("external don't-cares are ignored"), "{}{}", ran.out, ran.err);
}

#[test]
fn a_clock_without_effect_is_refused() {
    let bench = Bench::new();
    let latch = |rest: &str| format!(".model m\n.inputs d clk\n.outputs q\n.latch d q{rest}\n.end\n");
    for (file, text, is_refused) in [
        ("m.blif", FULL_ADDER.to_owned(), true),
        ("m.blif", latch(" re clk 0"), true),
        ("m.blif", latch(" 0"), false),
        ("m.aag", "aag 1 1 0 1 0\n2\n2\n".to_owned(), true),
        ("m.aag", "aag 2 1 1 1 0\n2\n4 2\n4\n".to_owned(), false),
        ("m.bench", "INPUT(a)\nOUTPUT(y)\ny = NOT(a)\n".to_owned(), true),
        ("m.bench", "INPUT(a)\nOUTPUT(y)\ny = DFF(a)\n".to_owned(), false),
        ("m.v", "module m(input clk, d, output reg q); always @(posedge clk) q <= d; endmodule\n".to_owned(), true),
    ] {
        bench.file(file, &text);
        let ran = bench.run(&["synth", file, "--cells", "nand,not", "--clock", "tick"]);
        let told = format!("`{file}` has no registers without a clock, which `--clock tick` is for");
        assert_eq!((ran.status == 2, ran.err.contains(&told)), (is_refused, is_refused), "{text}{}", ran.err);
    }
}
