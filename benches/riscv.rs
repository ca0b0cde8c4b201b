//! The processor in each form of its registers: robots, cycles of a clock, and clocks that are simulated in a second at
//! the level of logic: `cargo bench --bench riscv`.

// Files of the tests have more than this needs.
#![allow(dead_code)]

use std::process::ExitCode;
use std::time::Instant;

use nbc_base::model::CircuitTest;
use nbc_base::source::MemoryWorld;
use nbc_circuit::{Effort, MappingObjective};
use nbc_session::{CompileOptions, Session, TestOptions};
use nbc_swarm::Level;

use aims::Aims;
use machine::{Machine, with_clocks};

mod aims;
#[path = "../tests/it/riscv/machine.rs"]
mod machine;
#[path = "../tests/it/riscv/reference.rs"]
mod reference;

/// Instructions whose clocks are measured: add immediate, shift, store, load, compare, branch, jump.
const PROGRAM: [u32; 8] =
    [0xff90_0093, 0x4030_d113, 0x0020_2423, 0x0080_1183, 0x0030_b233, 0xfe20_9ee3, 0x00c0_02ef, 0x0000_0073];

/// The clocks of the program, with those before it.
const CLOCKS: usize = 600;

/// Clocks a second of one processor at the level of logic.
const SPEED: f64 = 100_000.0;

/// The program with one swarm, and with the libraries that it uses.
fn with_swarm(text: &str, fields: &str) -> String {
    let is_used = |line: &str| match line.split(' ').collect::<Vec<_>>()[..] {
        ["swarm", ..] => false,
        ["library", name, ..] => fields.contains(&format!("library: {name}")),
        _ => true,
    };
    let own = text.lines().filter(|line| is_used(line)).collect::<Vec<_>>().join("\n");
    format!("{own}\nswarm measured {{ circuit: riscv, {fields} }}\n")
}

/// The processor with latches in one of their forms.
fn measure(text: &str, fields: &str, objective: MappingObjective) -> Result<(usize, f64, usize), String> {
    let mut world = MemoryWorld::default();
    world.insert("m.nb", with_swarm(text, fields));
    let mut session = Session::new(world);
    let checked = session.open("m.nb").map_err(|error| error.list[0].message.clone())?;
    let test: &CircuitTest = &checked.program.tests[0];
    let compile = CompileOptions { effort: Effort::Normal, objective, ..CompileOptions::default() };
    let options = TestOptions { level: Some(Level::Physics), compile };
    let case = checked.cases(test, &options).map_err(|error| error.list[0].message.clone())?.remove(0);
    let holds: Vec<usize> = case.row_holds().iter().map(|row| row.hold).collect();
    let clocks: Vec<usize> = holds.chunks(2).skip(1).map(|pair| pair.iter().sum()).collect();
    let mean = clocks.iter().sum::<usize>() as f64 / clocks.len() as f64;
    Ok((case.robots(), mean, clocks.into_iter().max().unwrap_or(0)))
}

/// The processor as a wave machine: robots, cycles of a step and threads.
fn measure_waves(text: &str, fields: &str) -> Result<(usize, usize, u32), String> {
    let mut world = MemoryWorld::default();
    world.insert("m.nb", with_swarm(text, &format!("registers: waves, {fields}")));
    let mut session = Session::new(world);
    let checked = session.open("m.nb").map_err(|error| error.list[0].message.clone())?;
    let compiled = checked.compile(&"riscv".into(), &CompileOptions::default());
    let compiled = compiled.map_err(|error| error.list[0].message.clone())?;
    let machine = compiled.mapping.waves.as_ref().ok_or("no wave machine")?;
    Ok((compiled.assembly.members.len(), machine.cycles_per_step(), machine.period))
}

fn main() -> ExitCode {
    let mut aims = Aims::default();
    let text = with_clocks(&PROGRAM, 0, CLOCKS);
    println!("| registers | objective | robots | cycles of a clock: mean, most |");
    println!("|---|---|---|---|");
    for fields in ["library: sturdy", "library: shipped", "library: three, registers: mux"] {
        for objective in [MappingObjective::Area, MappingObjective::Delay] {
            match measure(&text, fields, objective) {
                Ok((robots, mean, most)) => println!("| {fields} | {objective:?} | {robots} | {mean:.1}, {most} |"),
                Err(error) => aims.check(false, format!("{fields} by {objective:?} is built: {error}")),
            }
        }
    }
    println!("\n| waves | robots | cycles of a step | threads |");
    println!("|---|---|---|---|");
    for fields in ["beat: 1 cycle", "beat: 1 cycle, step: 14 cycles", "beat: 2 cycles"] {
        match measure_waves(&text, fields) {
            Ok((robots, cycles, threads)) => println!("| {fields} | {robots} | {cycles} | {threads} |"),
            Err(error) => aims.check(false, format!("waves with {fields} are built: {error}")),
        }
    }
    let mut machine = Machine::new();
    let (start, clocks) = (Instant::now(), 100_000);
    (0..clocks).for_each(|_| machine.clock(1));
    let speed = f64::from(clocks) / start.elapsed().as_secs_f64();
    println!("{speed:.0} clocks a second at the level of logic");
    aims.check(speed >= SPEED, format!("{SPEED:.0} clocks a second at least"));
    aims.end()
}
