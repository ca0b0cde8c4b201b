//! Verilog as it comes: asynchronous resets, test benches beside modules, wires that nothing drives, powers,
//! parameters, and ports of several bits.

use std::process::Command;

use crate::support::*;

/// A counter with the commonest reset, and its test bench, which Yosys could not read.
const COUNTER: &str = "\
module counter #(parameter N = 4, START = 5) (input clk, input rst_n, input en, output reg [N-1:0] count, output odd);
  always @(posedge clk or negedge rst_n)
    if (!rst_n) count <= START;
    else if (en) count <= count + 1;
  assign odd = count[0];
endmodule

";

const BENCH: &str = "\
(* keep *)
module bench;
  reg clk = 0, rst_n = 1, en = 1;
  wire [3:0] count;
  wire odd;
  counter dut(clk, rst_n, en, count, odd);
  task tick; begin #50 clk = 1; #50 clk = 0; end endtask
  initial begin
    #50 rst_n = 0; #50 if (count !== 5 || odd !== 1) $fatal(1, \"reset\");
    tick; if (count !== 5) $fatal(1, \"held\");
    #50 rst_n = 1; tick; if (count !== 6 || odd !== 0) $fatal(1, \"counts\");
    en = 0;
  end
  initial @(posedge clk) @(negedge clk) if (count !== 5) $fatal(1, \"edge\");
  initial begin
    #600 tick; if (count !== 6) $fatal(1, \"stays\");
    #50 clk = 1; #50 rst_n = 0; #50 if (count !== 5) $fatal(1, \"reset at 1\");
    #50 rst_n = 1; #50 if (count !== 5) $fatal(1, \"after reset\");
    $finish;
  end
endmodule
";

#[track_caller]
fn passes_its_bench(bench: &Bench, module: &str) {
    let made = Command::new("iverilog")
        .args(["-g2012", "-o", "bench.vvp", "-s", "bench", "bench.v", module])
        .current_dir(bench.path())
        .output_in_time();
    assert!(made.status.success(), "{}", String::from_utf8_lossy(&made.stderr));
    let ran = Command::new("vvp").arg("bench.vvp").current_dir(bench.path()).output_in_time();
    assert!(ran.status.success(), "{module}: {}", String::from_utf8_lossy(&ran.stdout));
}

#[test]
fn a_module_without_content_or_outputs_is_named() {
    let Some(_) = SLANG.find() else { return };
    let bench = Bench::with("empty.v", "\nmodule e(input a, output q);\nendmodule\n");
    bench.file(
        "inside.v",
        "module e(input a, output q);\nendmodule\nmodule m(input a, output q);\n  e u(a, q);\nendmodule\n",
    );
    let help = "write its logic, or give the file that has it";
    for (file, place) in [("empty.v", "empty.v:2:1"), ("inside.v", "inside.v:1:1")] {
        bench.file("p.nb", format!("use \"{file}\"\n"));
        for arguments in [&["synth", file][..], &["check", "p.nb"]] {
            bench.run(arguments).expect_fault(&["the module `e` has no content", place, help]);
        }
    }
    bench.file("none.v", "module bench;\n  reg a = 1;\nendmodule\n");
    bench.run("synth none.v -o none.nb").expect_fault(&["the files have no module with outputs"]);
    bench.file("none.blif", ".model b\n.inputs a\n.end\n");
    bench.run("synth none.blif").expect_fault(&["`b` has no outputs"]);
    assert!(!bench.has("none.nb"));
}

const ASSERTED: &str = "\
module m(input clk, a, b, output reg q);
  property p; @(posedge clk) a |-> ##1 q; endproperty
  always @(posedge clk) begin
    l: assert (a == b) else $error(\"differ\");
    if (b) assert (a) q <= 0; else q <= 1; else q <= a;
    cover (q);
  end
  c: assert property (p) else begin $display(\"no\"); end
  assume property (@(posedge clk) disable iff (b) a);
endmodule
";

#[test]
fn assertions_are_left_out_with_a_warning() {
    let Some(_) = SLANG.find() else { return };
    let bench = Bench::with("m.v", ASSERTED);
    let rows = "test m {\n    clk a b | q\n    ^   1 0 | 1\n    ^   0 1 | 1\n    ^   0 0 | 0\n}\n";
    bench.file("m.nb", format!("use \"m.v\"\n\n{rows}"));
    bench.ok("test m.nb --logic");
    let ran = bench.run("synth m.v --cells nand,not");
    assert!(ran.status == 0 && ran.err.contains("assertions are ignored"), "{}", ran.err);
}

#[test]
fn the_original_bench_fits_what_is_written() {
    let (Some(_), Some(_)) = (SLANG.find(), IVERILOG.find()) else { return };
    let bench = Bench::with("counter.v", COUNTER);
    bench.file("bench.v", BENCH);
    passes_its_bench(&bench, "counter.v");
    bench.ok("synth counter.v --cells nand,not -o out.v");
    let written = bench.read("out.v");
    let head = "module counter(input clk, input rst_n, input en, output [3:0] count, output odd);\n";
    assert!(written.starts_with(head), "{written}");
    passes_its_bench(&bench, "out.v");
    // And what is written can be read again.
    bench.ok("synth out.v --cells nand,not -o again.v");
    passes_its_bench(&bench, "again.v");
}

/// A reset that acts without the clock, and stays when it ends at a high clock.
const RESET_ROWS: &str = "
test counter {
    clk rst_n en | count
    0   0     1  | 4'd5
    1   0     1  | 4'd5
    1   1     1  | 4'd5
    0   1     1  | 4'd5
    1   1     1  | 4'd6
    0   1     1  | 4'd6
    1   1     1  | 4'd7
    1   0     1  | 4'd5
    1   1     1  | 4'd5
}
";

#[test]
fn an_asynchronous_reset_needs_no_edge_of_the_clock() {
    let Some(_) = SLANG.find() else { return };
    let bench = Bench::with("counter.v", COUNTER);
    bench.file("used.nb", format!("use \"counter.v\"\n{RESET_ROWS}"));
    bench.ok("test used.nb --logic");
    // Every format that keeps registers, and cells.
    for (out, more) in [("a.nb", &[][..]), ("a.blif", &[]), ("b.nb", &["--registers", "expand"])] {
        bench.ok(&[&["synth", "counter.v", "--cells", "nand,not", "-o", out], more].concat());
        let name = format!("test_{out}.nb");
        match out.strip_suffix(".nb") {
            Some(_) => {
                let written = bench.read(out);
                bench.file(&name, format!("{written}{RESET_ROWS}"));
            }
            None => _ = bench.file(&name, format!("use \"{out}\"\n{RESET_ROWS}")),
        }
        bench.ok(&["test", &name, "--logic"]);
    }
    let written = bench.read("a.nb");
    assert!(written.contains(" = async_register[start = 5]("), "{written}");
    let refused = bench.run("synth counter.v --cells nand,not -o a.aig");
    refused.expect_fault(&["AIGER has no asynchronous set or reset"]);
}

#[test]
fn a_reset_acts_after_mapping_to_robots() {
    let Some(_) = SLANG.find() else { return };
    let bench = Bench::new();
    let text = "module one_bit(input clk, input r, input d, output reg q);\n  \
        always @(posedge clk, posedge r) if (r) q <= 1; else q <= d;\nendmodule\n";
    bench.file("one_bit.v", text);
    let rows = "test one_bit {\n    clk r d | q\n    0 1 0 | 1\n    0 0 0 | 1\n    \
        1 0 0 | 0\n    1 1 0 | 1\n    1 0 0 | 1\n}\n";
    bench.file("bit.nb", format!("use \"one_bit.v\"\n\n{rows}"));
    bench.ok("test bit.nb --physics");
}

#[test]
fn a_register_may_load_without_its_clock_and_set_and_reset_are_refused() {
    let Some(_) = SLANG.find() else { return };
    let bench = Bench::new();
    let text = "module load(input clk, s, d, r, output reg [1:0] l);\n  \
        always @(negedge clk, posedge s) if (s) l <= {d, r}; else l <= l + 1;\nendmodule\n";
    bench.file("load.v", text);
    let rows = "test load {\n    clk s r d | l\n    0 1 0 1 | 10\n    0 1 1 1 | 11\n    0 0 1 1 | 11\n    \
        1 0 0 1 | 11\n    0 0 0 1 | 00\n}\n";
    for file in ["load.v", "out.blif", "out.nb"] {
        if file != "load.v" {
            bench.ok(&["synth", "load.v", "-o", file, "--cells", "nand,not"]);
        }
        bench.file("again.nb", format!("use \"{file}\"\n\n{rows}"));
        bench.ok("test again.nb --logic");
    }
    let both = "module both(input clk, s, r, d, output reg q);\n  \
        always @(posedge clk, posedge s, posedge r) if (r) q <= 0; else if (s) q <= 1; else q <= d;\nendmodule\n";
    bench.file("both.v", both);
    bench.run("synth both.v").expect_fault(&["multiple asynchronous loads unsupported", "both.v:2:"]);
}

#[test]
fn a_module_without_outputs_is_left_out_with_a_word() {
    let Some(_) = SLANG.find() else { return };
    let bench = Bench::with("all.v", format!("{BENCH}{COUNTER}"));
    let ran = bench.ok("synth all.v --cells nand,not");
    assert!(ran.err.contains("module `bench` is left out") && ran.err.contains("all.v:2:1"), "{}", ran.err);
    bench.file("used.nb", format!("use \"all.v\"\n{RESET_ROWS}"));
    bench.ok("test used.nb --logic");
    bench.file("none.v", "module none(input a);\nendmodule\n");
    bench.file("used.nb", "use \"none.v\"\n");
    bench.run("check used.nb").expect_fault(&["have no module with outputs"]);
    // A fault counts in each module.
    let files =
        "module m(input a, output q); assign q = a; endmodule\nmodule b; initial $readmemh(\"x\", m); endmodule\n";
    bench.file("b.v", files);
    bench.run("synth b.v --cells nand,not").expect_fault(&["'m' cannot be used", "b.v:2:"]);
}

#[test]
fn wires_that_nothing_drives_are_zero_with_a_warning() {
    let Some(_) = SLANG.find() else { return };
    let bench = Bench::new();
    let text = "module inner(input x, output y);\n  assign y = ~x;\nendmodule\n\
        module open(input a, output q, output r, output z);\n  wire t;\n  assign q = a | t;\n  \
        inner u(.y(z));\nendmodule\n";
    bench.file("open.v", text);
    bench.file("p.nb", "use \"open.v\"\n\ntest open {\n    a | q r z\n    1 | 1 0 1\n    0 | 0 0 1\n}\n");
    for arguments in [&["synth", "open.v", "--cells", "nand,not"][..], &["test", "p.nb", "--logic"]] {
        let ran = bench.ok(arguments);
        for (wire, line) in [("t", 5), ("r", 4), ("u.x", 1)] {
            let is_told = ran.err.contains(&format!("nothing drives `{wire}`"));
            assert!(is_told && ran.err.contains(&format!("open.v:{line}:")), "{wire}: {}", ran.err);
        }
    }
}

#[test]
fn errors_of_the_translation_are_at_lines_of_verilog() {
    let Some(_) = SLANG.find() else { return };
    let bench = Bench::new();
    for (body, expected) in [
        ("assign q = ~(d & ~(c & q));", ["`q` depends on itself", "m.v:1:"]),
        (
            "wire g;\nassign g = c & d;\nreg s;\nalways @(posedge g) s <= d;\nassign q = s;",
            ["driven by logic", "m.v:4:5"],
        ),
        (
            "wire w;\nassign w = ~c;\nassign w = ~d;\nassign q = w;",
            ["`w` is driven twice: by logic and by logic", "m.v:2:6"],
        ),
    ] {
        bench.file("m.v", format!("module m(input c, d, output q);\n{body}\nendmodule\n"));
        bench.file("m.nb", "use \"m.v\"\n");
        bench.run("synth m.v --cells nand,not").expect_fault(&expected);
        bench.run("check m.nb").expect_fault(&[expected[0], expected[1], "m.nb:1:5"]);
    }
}

#[test]
fn powers_are_products() {
    let Some(_) = SLANG.find() else { return };
    let bench = Bench::new();
    let text = "module power(input [2:0] a, input [1:0] b, input signed [2:0] s, e, \
        output [7:0] cube, two, any, output signed [7:0] signs);\n  \
        assign cube = a ** 3;\n  assign two = 2 ** a;\n  assign any = a ** b;\n  assign signs = s ** e;\nendmodule\n";
    bench.file("power.v", text);
    let mut rows = String::from("use \"power.v\"\n\ntest power {\n    a b s e | cube two any signs\n");
    for a in 0..8u32 {
        for b in 0..4u32 {
            let (s, e) = ((a * 3 + b) as i32 % 8 - 4, (a + b * 5) as i32 % 8 - 4);
            let signs = match (s, e) {
                (s, e) if e >= 0 => s.pow(e as u32),
                (1, _) => 1,
                (-1, e) => 1 - 2 * (e & 1),
                _ => 0,
            };
            let byte = |value: i64| value & 255;
            let bits = |value: i32| value & 7;
            rows += &format!(
                "    3'd{a} 2'd{b} 3'd{} 3'd{} | 8'd{} 8'd{} 8'd{} 8'd{}\n",
                bits(s),
                bits(e),
                byte(a.pow(3).into()),
                byte(1 << a),
                byte(a.pow(b).into()),
                byte(signs.into()),
            );
        }
    }
    bench.file("power.nb", rows + "}\n");
    bench.ok("test power.nb --logic --effort fast");
}

#[test]
fn a_module_and_its_parameters_can_be_chosen() {
    let Some(_) = SLANG.find() else { return };
    let bench = Bench::new();
    let other = "module other(input a, output q, output r);\n  assign q = ~a;\n  assign r = a;\nendmodule\n";
    bench.file("two.v", format!("{COUNTER}{other}"));
    let synth = |more: &[&str]| bench.run(&[&["synth", "two.v", "--cells", "nand,not"], more].concat());
    let outputs =
        |more: &[&str]| synth(&[more, &["--format", "json"]].concat()).expect_json()["outputs"].as_u64().unwrap();
    assert_eq!(outputs(&["--top", "other"]), 2);
    assert_eq!(outputs(&["--top", "counter"]), 5);
    assert_eq!(outputs(&["--top", "counter", "--param", "N=6", "--param", "START=9"]), 7);
    synth(&["--top", "counte"]).expect_fault(&["has no module `counte`", "did you mean `counter`?"]);
    synth(&["--top", "a;b"]).expect_fault(&["has no module `a;b`"]);
    synth(&["--param", "N=6"]).expect_fault(&["several modules", "choose one with `--top`: `counter` or `other`"]);
    synth(&["--top", "counter", "--param", "STRAT=6"]).expect_fault(&["no parameter `STRAT`", "did you mean `START`?"]);
    synth(&["--param", "N=x"]).expect_fault(&["expected a name and a number"]);
    bench.file(
        "one.blif",
        ".model one\n.inputs a\n.outputs q\n.names a q\n1 1\n.end\n.model two\n.outputs r\n.names r\n.end\n",
    );
    let blif = |more: &[&str]| bench.run(&[&["synth", "one.blif", "--cells", "nand,not"], more].concat());
    assert_eq!(blif(&["--top", "two", "--format", "json"]).expect_json()["inputs"], 0);
    blif(&["--param", "N=1"]).expect_fault(&["`one.blif` has no parameters"]);
    bench.file("one.bench", "INPUT(a)\nOUTPUT(q)\nq = NOT(a)\n");
    bench.run("synth one.bench --top m --cells nand").expect_fault(&["one circuit, which has no name"]);
}

#[test]
fn yosys_proves_what_is_written_equal_port_by_port() {
    let Some(yosys) = SLANG.find() else { return };
    let bench = Bench::new();
    let text = "module alu(input [1:0] op, input [5:2] a, input [3:0] b, output reg [3:0] q, output zero);\n  \
        always @* case (op) 0: q = a + b; 1: q = a - b; 2: q = a & b; default: q = a ^ b; endcase\n  \
        assign zero = q == 0;\nendmodule\n";
    bench.file("alu.v", text);
    bench.ok("synth alu.v --cells nand,not -o out.v");
    let written = bench.read("out.v");
    let head = "module alu(input [1:0] op, input [5:2] a, input [3:0] b, output [3:0] q, output zero);\n";
    assert!(written.starts_with(head), "{written}");
    let script = "read_verilog -sv alu.v; proc; opt_clean; rename alu gold; read_verilog out.v; \
        rename alu gate; miter -equiv -flatten gold gate both; sat -verify -prove trigger 0 both";
    let ran = Command::new(yosys).args(["-q", "-p", script]).current_dir(bench.path()).output_in_time();
    assert!(ran.status.success(), "{}", String::from_utf8_lossy(&ran.stderr));
}
