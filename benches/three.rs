//! Circuits of robots with three senses beside those with two, and the benchmark circuits in cells of three inputs:
//! `cargo bench --bench three`. It takes some minutes. Each result is proved.

// Files of the tests have more than this needs.
#![allow(dead_code, unused_imports)]

use std::fs;
use std::process::ExitCode;

use nbc_base::diag::Diagnostics;
use nbc_base::source::MemoryWorld;
use nbc_circuit::CellLibrary;
use nbc_session::{Choice, CompileOptions, Session, Synthesis, SynthesisOptions, store};

use aims::Aims;
use designs::{files, read};

mod aims;
#[path = "../tests/it/designs.rs"]
mod designs;
#[path = "../tests/it/support/mod.rs"]
mod support;

/// A circuit of the gallery: its file, its name, and the most robots that it is to have.
type Circuit = (&'static str, &'static str, Option<usize>);

const CIRCUITS: [Circuit; 9] = [
    ("full_adder.nb", "full_adder", Some(4)),
    ("ripple_adder.nb", "ripple_adder[4]", Some(16)),
    ("latch.nb", "d_latch", Some(2)),
    ("counter.nb", "counter", Some(18)),
    ("multiplexer.nb", "", None),
    ("majority.nb", "", None),
    ("seven_segment.nb", "", None),
    ("comparator.nb", "", None),
    ("computer.nb", "product", Some(80)),
];

const WITH_STATE: [&str; 3] = ["d_latch", "counter", "product"];

/// The benchmark circuits are to have fewer cells, together, by this share.
const SAVED: f64 = 0.2;

/// The robots of a circuit with these fields of its swarm.
fn robots(file: &str, circuit: &str, fields: &str) -> Result<usize, String> {
    let text = fs::read_to_string(format!("circuits/{file}")).unwrap();
    let own = text.lines().filter(|line| !line.starts_with("swarm ")).collect::<Vec<_>>().join("\n");
    let mut world = MemoryWorld::default();
    for used in ["full_adder.nb", "half_adder.nb", "multiplexer.nb"] {
        world.insert(used, fs::read_to_string(format!("circuits/{used}")).unwrap());
    }
    world.insert("m.nb", format!("{own}\nswarm measured {{ circuit: {circuit}, {fields} }}\n"));
    let mut session = Session::new(world);
    let told = |error: Diagnostics| error.list[0].message.clone();
    let checked = session.open("m.nb").map_err(told)?;
    let choice = Choice { swarm: Some("measured".to_owned()), ..Choice::default() };
    let circuit = checked.circuit(&choice).map_err(told)?;
    let options = CompileOptions { swarm: choice.swarm, ..CompileOptions::default() };
    Ok(checked.compile(&circuit, &options).map_err(told)?.assembly.members.len())
}

/// The cells of each benchmark circuit in two libraries, as `nbc synth --library` finds them.
fn benchmarks(libraries: [&CellLibrary; 2]) -> Vec<(String, [usize; 2])> {
    let cells = |path: &std::path::PathBuf| {
        let design = read(path);
        let mapped = libraries.map(|library| {
            let made = Synthesis::of(&design, &SynthesisOptions::onto(library.clone()));
            made.expect("the library is complete").cells()
        });
        (path.file_stem().unwrap().display().to_string(), mapped)
    };
    files().iter().map(cells).collect()
}

fn main() -> ExitCode {
    let mut aims = Aims::default();
    println!("| circuit | robots with two senses | with three senses |\n|---|---|---|");
    for (file, circuit, aim) in CIRCUITS {
        let circuit = if circuit.is_empty() { file.strip_suffix(".nb").unwrap() } else { circuit };
        let told = |found: &Result<usize, String>| found.as_ref().map_or_else(Clone::clone, usize::to_string);
        let two = robots(file, circuit, "library: shipped");
        let registers = if WITH_STATE.contains(&circuit) { ", registers: mux" } else { "" };
        let three = robots(file, circuit, &format!("library: three{registers}"));
        println!("| `{circuit}` | {} | {} |", told(&two), told(&three));
        if let Some(most) = aim {
            aims.check(three.is_ok_and(|robots| robots <= most), format!("{circuit} in {most} robots at most"));
        }
    }
    let [two, three] =
        ["shipped", "three"].map(|name| nbc_swarm::cells(&store::built_in(name).expect("it is built in")));
    println!("\n| circuit | cells of two inputs | of two and three | saved |\n|---|---|---|---|");
    let mut sums = [0; 2];
    for (name, cells) in benchmarks([&two, &three]) {
        println!("| `{name}` | {} | {} | {:.0} % |", cells[0], cells[1], saved(cells));
        sums = [sums[0] + cells[0], sums[1] + cells[1]];
    }
    println!("| all | {} | {} | {:.0} % |", sums[0], sums[1], saved(sums));
    aims.check(saved(sums) >= 100.0 * SAVED, format!("{:.0} % fewer cells at least", 100.0 * SAVED));
    aims.end()
}

/// The share of cells that the second library saves, in percent.
fn saved([two, three]: [usize; 2]) -> f64 {
    100.0 * (1.0 - three as f64 / two.max(1) as f64)
}
