//! Random machines: registers of every kind, set and reset, enabled, of two clocks and of each other, that store clocks
//! too, beside loops of gates. Each compiles in each form, which proves it, and does what a simulation of the machine
//! does. They are written in each format that has words for them.

use std::collections::BTreeMap;
use std::fmt::Write as _;

use nbc_base::model::Instance;
use nbc_base::source::{
    FileError, FileId, MemoryWorld, SourceWorld, VerilogError, VerilogFile, VerilogFiles, VerilogModules,
};
use nbc_circuit::formats::{aiger, blif};
use nbc_circuit::waves::ClockStep;
use nbc_circuit::{Logic, Netlist};
use nbc_session::store::DiskWorld;
use nbc_session::{CompileOptions, Mapping, Session};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

use crate::support::*;

const INPUTS: [&str; 7] = ["a", "b", "c", "set", "reset", "clk", "clk2"];
const SET: usize = 3;
const RESET: usize = 4;
const CLOCK: usize = 5;
const OTHER: usize = 6;
/// The inputs that say what is stored, and when a register is enabled.
const DATA: usize = 3;
const OPERATORS: [&str; 5] = ["and", "or", "xor", "nand", "nor"];
const STEPS: usize = 200;

/// Nets are the inputs, the registers, and the loop.
#[derive(Clone, Debug)]
struct Stored {
    is_edge: bool,
    /// Whether it is open, or takes its data, when its clock becomes 1.
    is_high: bool,
    clock: usize,
    operator: usize,
    operands: [usize; 2],
    is_enabled: bool,
    /// 1 for a reset to the start value, 2 for a set and a reset.
    forcing: usize,
    start: bool,
}

#[derive(Debug)]
struct RandomMachine {
    registers: Vec<Stored>,
    has_loop: bool,
}

#[derive(Clone)]
struct Values {
    inputs: [bool; 7],
    registers: Vec<bool>,
    pair: [bool; 2],
}

impl RandomMachine {
    fn of(seed: u64) -> Self {
        let random = &mut ChaCha8Rng::seed_from_u64(seed);
        let count = random.random_range(1..6);
        let (is_plain, has_loop) = (random.random_range(0..4) == 0, random.random_range(0..3) == 0);
        let mut registers: Vec<Stored> = Vec::new();
        for at in 0..count {
            let is_edge = is_plain || random.random_range(0..3) > 0;
            let is_rising = |register: &Stored| register.is_edge && register.clock < INPUTS.len();
            let first = registers.iter().position(is_rising).filter(|_| !is_plain && random.random_range(0..5) == 0);
            let input = if is_plain || random.random_range(0..3) > 0 { CLOCK } else { OTHER };
            let clock = first.map_or(input, |first| INPUTS.len() + first);
            // What follows its clock late reads inputs only, so that no change races it. Nor does the end of a reset,
            // which may set its clock. Latches read what is before them, so that none drives itself while it is open.
            let is_clock_forced = first.is_some_and(|first| registers[first].forcing == 2);
            let known = match is_edge {
                _ if first.is_some() => (0..DATA).collect::<Vec<_>>(),
                true => (0..DATA).chain(CLOCK..if is_plain { CLOCK } else { INPUTS.len() + count }).collect(),
                false => (0..DATA).chain(CLOCK..INPUTS.len() + at).collect(),
            };
            let mut any = || known[random.random_range(0..known.len())];
            let operands = [any(), any()];
            registers.push(Stored {
                is_edge,
                is_high: is_plain || random.random_range(0..3) > 0,
                clock,
                operator: random.random_range(0..OPERATORS.len()),
                operands,
                is_enabled: random.random_range(0..4) == 0 && is_edge,
                forcing: if is_plain { 0 } else { random.random_range(0..3) * usize::from(!is_clock_forced) },
                start: random.random_range(0..2) == 1,
            });
        }
        Self { registers, has_loop: has_loop && !is_plain }
    }

    fn is_step(&self) -> bool {
        !self.has_loop
            && self.registers.iter().all(|one| one.is_edge && one.is_high && one.clock == CLOCK && one.forcing == 0)
            && self.registers.iter().all(|one| one.operands.iter().all(|&net| net < DATA || net >= INPUTS.len()))
    }

    fn start(&self) -> Values {
        let registers = self.registers.iter().map(|register| register.start).collect();
        let mut values = Values { inputs: [false; 7], registers, pair: [true; 2] };
        self.settle(&values.clone(), &mut values);
        values
    }

    fn data(&self, register: usize, values: &Values) -> bool {
        let Stored { operator, operands, is_enabled, .. } = self.registers[register];
        let [x, y] = operands.map(|net| values.net(net));
        let data = match OPERATORS[operator] {
            "and" => x && y,
            "or" => x || y,
            "xor" => x != y,
            "nand" => !(x && y),
            _ => !(x || y),
        };
        if is_enabled && !values.inputs[2] { values.registers[register] } else { data }
    }

    /// Lets everything follow `before`, in which other inputs were there.
    fn settle(&self, before: &Values, values: &mut Values) {
        let mut before = before.clone();
        loop {
            let last = values.clone();
            let [a, b] = [values.inputs[0], values.inputs[1]];
            for _ in 0..2 {
                values.pair = [!(a && values.pair[1]), !(b && !(a && values.pair[1]))];
            }
            for (at, register) in self.registers.iter().enumerate() {
                let [was_on, is_on] = [&before, &last].map(|values| values.net(register.clock) == register.is_high);
                let taken = match register.is_edge {
                    true => (is_on && !was_on).then(|| self.data(at, &before)),
                    false => is_on.then(|| self.data(at, values)),
                };
                values.registers[at] = match (register.forcing, values.inputs[SET], values.inputs[RESET]) {
                    (1, _, true) => register.start,
                    (2, _, true) => false,
                    (2, true, false) => true,
                    _ => taken.unwrap_or(values.registers[at]),
                };
            }
            before = last.clone();
            if values.registers == last.registers && values.pair == last.pair {
                return;
            }
        }
    }

    fn name(&self, net: usize) -> String {
        INPUTS.get(net).map_or_else(|| format!("q{}", net - INPUTS.len()), |&name| name.to_owned())
    }

    fn outputs(&self) -> Vec<String> {
        let own = (0..self.registers.len()).map(|at| format!("q{at}"));
        own.chain(self.has_loop.then(|| "x".to_owned())).collect()
    }

    fn program(&self) -> String {
        let mut text = format!("circuit m({}) -> ({}) {{\n", INPUTS.join(", "), self.outputs().join(", "));
        for (at, one) in self.registers.iter().enumerate() {
            let word = if one.is_edge { "register" } else { "latch" };
            let (before, after) = [("", ""), ("async_", ", reset"), ("set_reset_", ", set, reset")][one.forcing];
            let clock = format!("{}{}", if one.is_high { "" } else { "not " }, self.name(one.clock));
            let [x, y] = one.operands.map(|net| self.name(net));
            let mut data = format!("{x} {} {y}", OPERATORS[one.operator]);
            let mut enable = "";
            match (one.is_enabled, one.forcing) {
                (true, 0) => enable = ", enable: c",
                (true, _) => data = format!("if c then {data} else q{at}"),
                (false, _) => {}
            }
            let start = u8::from(one.start);
            let _ = writeln!(text, "    q{at} = {before}{word}[start = {start}]({data}, {clock}{after}{enable})");
        }
        if self.has_loop {
            text += "    x init 1 = a nand y\n    y init 1 = b nand x\n";
        }
        text + "}\n"
    }

    /// Without the loop, which this format has no words for.
    fn blif(&self) -> String {
        let outputs: Vec<String> = (0..self.registers.len()).map(|at| format!("q{at}")).collect();
        let mut text = format!(".model m\n.inputs {}\n.outputs {}\n", INPUTS.join(" "), outputs.join(" "));
        for (at, one) in self.registers.iter().enumerate() {
            let [x, y] = one.operands.map(|net| self.name(net));
            let rows = ["11 1", "1- 1\n-1 1", "10 1\n01 1", "0- 1\n-0 1", "00 1"][one.operator];
            let _ = writeln!(text, ".names {x} {y} f{at}\n{rows}");
            match one.is_enabled {
                true => _ = writeln!(text, ".names c f{at} q{at} d{at}\n11- 1\n0-1 1"),
                false => _ = writeln!(text, ".names f{at} d{at}\n1 1"),
            }
            let (clock, start) = (self.name(one.clock), u8::from(one.start));
            let (kind, edge, family, port) = match (one.is_edge, one.is_high) {
                (true, true) => ("re", "P", "DFF", "C"),
                (true, false) => ("fe", "N", "DFF", "C"),
                (false, true) => ("ah", "P", "DLATCH", "E"),
                (false, false) => ("al", "N", "DLATCH", "E"),
            };
            let _ = match one.forcing {
                0 => writeln!(text, ".latch d{at} q{at} {kind} {clock} {start}"),
                1 => {
                    writeln!(text, ".subckt $_{family}_{edge}P{start}_ {port}={clock} D=d{at} R=reset Q=q{at}")
                }
                _ => writeln!(
                    text,
                    ".subckt $_{family}SR_{edge}PP_ {port}={clock} D=d{at} R=reset S=set Q=q{at}\n.attr init {start}"
                ),
            };
        }
        text + ".end\n"
    }

    /// Without the loop, and not for registers of an edge that are set and reset, which the reader of Verilog refuses.
    fn verilog(&self, name: &str) -> Option<String> {
        if self.has_loop || self.registers.iter().any(|one| one.is_edge && one.forcing == 2) {
            return None;
        }
        let outputs: Vec<String> = (0..self.registers.len()).map(|at| format!("output reg q{at}")).collect();
        let mut text = format!("module {name}(input {}, {});\n", INPUTS.join(", input "), outputs.join(", "));
        for (at, one) in self.registers.iter().enumerate() {
            let [x, y] = one.operands.map(|net| self.name(net));
            let (not, sign) = [("", "&"), ("", "|"), ("", "^"), ("~", "&"), ("~", "|")][one.operator];
            let data = format!("{not}({x} {sign} {y})");
            let data = if one.is_enabled { format!("c ? {data} : q{at}") } else { data };
            let (clock, start) = (self.name(one.clock), u8::from(one.start));
            let forced = ["".to_owned(), format!("if (reset) q{at} <= {start}; else ")];
            let _ = writeln!(text, "  initial q{at} = {start};");
            let _ = match one.is_edge {
                true => {
                    let edge = if one.is_high { "posedge" } else { "negedge" };
                    let events = ["", ", posedge reset"][one.forcing];
                    writeln!(text, "  always @({edge} {clock}{events}) {}q{at} <= {data};", forced[one.forcing])
                }
                false => {
                    let open = if one.is_high { "" } else { "!" };
                    let set = format!("if (reset) q{at} = 0; else if (set) q{at} = 1; else ");
                    let forced = [String::new(), forced[1].replace("<=", "="), set];
                    writeln!(text, "  always @* {}if ({open}{clock}) q{at} = {data};", forced[one.forcing])
                }
            };
        }
        Some(text + "endmodule\n")
    }
}

impl Values {
    fn net(&self, net: usize) -> bool {
        self.inputs.get(net).copied().unwrap_or_else(|| self.registers[net - INPUTS.len()])
    }
}

/// How many compilations of each format and form were proved, by the method; and how many were refused, by the reason.
type Tally = BTreeMap<String, usize>;

const FORMS: [&str; 3] = ["registers: master_slave", "library: three, registers: mux", "registers: waves"];

/// Compiles a circuit of a file in a form, or says why it has no such form.
fn mapped(world: impl SourceWorld + Send + Sync + 'static, program: &str, circuit: &str) -> Result<Mapping, String> {
    let mut session = Session::new(world);
    let checked = session.checked(program);
    if let Some(fault) = checked.diagnostics.iter().find(|fault| fault.is_error()) {
        return Err(fault.message.clone());
    }
    let options = CompileOptions { swarm: Some("form".to_owned()), ..CompileOptions::default() };
    let mapping = checked.map(&Instance::from(circuit), &options);
    mapping.map_err(|faults| faults.list[0].message.clone())
}

fn in_memory(file: (&str, &str), form: &str) -> Result<Mapping, String> {
    let mut world = MemoryWorld::default();
    world.insert(file.0, file.1);
    world.insert("p.nb", format!("use \"{}\"\nswarm form {{ circuit: m, {form} }}\n", file.0));
    mapped(world, "p.nb", "m")
}

fn does_the_same(machine: &RandomMachine, netlist: &Netlist, what: &str) {
    let random = &mut ChaCha8Rng::seed_from_u64(7);
    let names: Vec<String> = netlist.inputs().iter().map(|&id| netlist.net_name(id)).collect();
    let shown: Vec<String> = netlist.outputs().iter().map(|&id| netlist.net_name(id)).collect();
    let mut logic = Logic::new(netlist);
    let mut values = machine.start();
    for step in 0..STEPS {
        let bit = |name: &String| INPUTS.iter().position(|known| known == name).is_some_and(|at| values.inputs[at]);
        let found = logic.settle(&names.iter().map(bit).collect::<Vec<_>>());
        let found = found.unwrap_or_else(|_| panic!("{what}, step {step} of\n{}\n{netlist}", machine.program()));
        let expected: Vec<bool> = shown
            .iter()
            .map(|name| match name.strip_prefix('q') {
                Some(at) => values.registers[at.parse::<usize>().unwrap()],
                None => values.pair[0],
            })
            .collect();
        assert_eq!(found, expected, "{what}, step {step} of\n{}{machine:?}\n{netlist}", machine.program());
        let before = values.clone();
        values.inputs[random.random_range(0..INPUTS.len())] ^= true;
        machine.settle(&before, &mut values);
    }
}

/// The steps of a machine whose registers store at one edge of one clock.
fn steps_the_same(machine: &RandomMachine, step: &ClockStep, what: &str) {
    let random = &mut ChaCha8Rng::seed_from_u64(8);
    let mut values = machine.start();
    let mut state: Vec<bool> = step.state.iter().map(|bit| bit.start).collect();
    let clock = step.clock.and_then(|at| INPUTS.iter().position(|&known| known == step.inputs[at]));
    for at in 0..STEPS {
        (0..DATA).for_each(|input| values.inputs[input] = random.random_range(0..2) == 1);
        let bit = |name: &String| INPUTS.iter().position(|known| known == name).is_some_and(|at| values.inputs[at]);
        let inputs: Vec<bool> = step.inputs.iter().map(bit).collect();
        let (shown, next) = step.run(&inputs, &state);
        let expected: Vec<bool> =
            step.outputs.iter().map(|name| values.registers[name[1..].parse::<usize>().unwrap()]).collect();
        assert_eq!(shown, expected, "{what}, step {at} of\n{}", machine.program());
        state = next;
        for value in [true, false] {
            let before = values.clone();
            clock.iter().for_each(|&clock| values.inputs[clock] = value);
            machine.settle(&before, &mut values);
        }
    }
}

fn check(machine: &RandomMachine, compile: impl Fn(&str) -> Result<Mapping, String>, what: &str, tally: &mut Tally) {
    for form in FORMS {
        let what = format!("{what}, {form}");
        let format = what.split(", ").nth(1).unwrap_or_default();
        let result = match compile(form) {
            Ok(Mapping { source, waves: Some(_), .. }) => {
                let step = ClockStep::of(&source).expect("wave machines have steps");
                steps_the_same(machine, &step, &what);
                "proved"
            }
            Ok(mapping) => {
                does_the_same(machine, &mapping.netlist, &what);
                "proved"
            }
            Err(why) => {
                let known = why.contains("has no effect").then_some("no register is left");
                let known = known.or((form == FORMS[2] && !machine.is_step()).then_some("no step"));
                known.unwrap_or_else(|| panic!("{what}: {why}\n{}", machine.program()))
            }
        };
        *tally.entry(format!("{format}, {form}: {result}")).or_default() += 1;
    }
}

fn check_texts(seed: u64, tally: &mut Tally) {
    let machine = RandomMachine::of(seed);
    let (program, blif) = (machine.program(), machine.blif());
    let mut files = vec![("m.nb", program)];
    if !machine.has_loop {
        files.push(("m.blif", blif.clone()));
    }
    if machine.is_step() {
        let design = blif::read(&blif, FileId(0), None).unwrap();
        files.push(("m.aag", String::from_utf8(aiger::write(&design, false)).unwrap()));
    }
    for (file, text) in &files {
        check(&machine, |form| in_memory((file, text), form), &format!("seed {seed}, {file}"), tally);
    }
}

/// A file of Verilog with what its reader made of a module.
struct Translated {
    files: MemoryWorld,
    modules: VerilogModules,
}

impl SourceWorld for Translated {
    fn read(&self, path: &str) -> Result<String, FileError> {
        self.files.read(path)
    }

    fn read_verilog(&self, _: &VerilogFiles) -> Result<VerilogModules, VerilogError> {
        Ok(self.modules.clone())
    }

    fn list(&self, folder: &str) -> Result<Vec<String>, FileError> {
        self.files.list(folder)
    }
}

/// The reader starts once for all machines.
fn check_verilog(seeds: std::ops::Range<u64>, tally: &mut Tally) {
    let name = |seed: u64| format!("m{seed}");
    let text: String = seeds.clone().filter_map(|seed| RandomMachine::of(seed).verilog(&name(seed))).collect();
    let file = VerilogFile { path: "m.v".to_owned(), text: text.clone() };
    let read = DiskWorld.read_verilog(&VerilogFiles { files: vec![file], others: BTreeMap::new() });
    let read = read.unwrap_or_else(|error| panic!("{error:?}\n{text}"));
    for seed in seeds {
        let machine = RandomMachine::of(seed);
        let Some(module) = read.modules.iter().find(|module| module.name == name(seed)) else { continue };
        let compile = |form: &str| {
            let mut files = MemoryWorld::default();
            files.insert("m.v", text.as_str());
            files.insert("p.nb", format!("use \"m.v\"\nswarm form {{ circuit: m{seed}, {form} }}\n"));
            let modules = VerilogModules { modules: vec![module.clone()], ..read.clone() };
            mapped(Translated { files, modules }, "p.nb", &name(seed))
        };
        check(&machine, compile, &format!("seed {seed}, m.v"), tally);
    }
}

#[test]
fn random_machines_compile_in_each_form_and_do_the_same() {
    let mut tally = Tally::new();
    (0..12).for_each(|seed| check_texts(seed, &mut tally));
    let proved: usize = tally.iter().filter(|(what, _)| what.ends_with("proved")).map(|(_, count)| count).sum();
    assert!(proved > 30, "{tally:#?}");
}

#[test]
fn random_machines_of_verilog_compile_in_each_form_and_do_the_same() {
    let Some(_) = SLANG.find() else { return };
    let mut tally = Tally::new();
    check_verilog(0..6, &mut tally);
    assert!(tally.keys().any(|what| what.ends_with("proved")), "{tally:#?}");
}

// cargo test --test it many_random_machines -- --ignored --nocapture
#[test]
#[ignore = "takes minutes"]
fn many_random_machines_compile_in_each_form_and_do_the_same() {
    let mut tally = Tally::new();
    (0..500).for_each(|seed| check_texts(seed, &mut tally));
    println!("500 machines {tally:#?}");
}

#[test]
#[ignore = "takes minutes"]
fn many_random_machines_of_verilog_compile_in_each_form_and_do_the_same() {
    let Some(_) = SLANG.find() else { return };
    let mut tally = Tally::new();
    for first in (0..500).step_by(10) {
        check_verilog(first..first + 10, &mut tally);
        println!("{} machines {tally:#?}", first + 10);
    }
}
