//! Wave machines: programs that cannot be one, with their exact messages, and random machines in full physics.

use std::fmt::Write;

use nbc_circuit::waves::{ClockStep, Reading};
use nbc_session::store::DiskWorld;
use nbc_session::{Choice, CompileOptions, Compiled, Session};
use nbc_sim::Simulator;
use nbc_swarm::SwarmConditions;
use rand::{Rng, SeedableRng};
use rand_chacha::ChaCha8Rng;

use crate::support::*;

/// The steps of each random machine in physics.
const STEPS: usize = 10;

#[test]
fn every_program_that_is_no_wave_machine_says_why() {
    let update = std::env::var_os("NBC_UPDATE_UI").is_some();
    let bench = Bench::new();
    for path in programs("tests/ui/waves") {
        let file = path.file_name().unwrap().to_str().unwrap();
        bench.file(file, fs::read(&path).unwrap());
        let ran = bench.run(&["test", file, "--physics"]);
        assert_eq!(ran.status, 2, "{file}: {}{}", ran.out, ran.err);
        let recorded = path.with_extension("stderr");
        if update {
            fs::write(&recorded, &ran.err).unwrap();
        }
        assert_eq!(ran.err, fs::read_to_string(&recorded).unwrap_or_default(), "{file}");
    }
}

/// A random program with registers, as a user would write it.
fn program(random: &mut ChaCha8Rng) -> String {
    let mut draw = |bound: usize| (random.next_u32() as usize) % bound;
    let (ports, bits) = (draw(3), 1 + draw(4));
    let mut nets: Vec<String> = (0..ports).map(|at| format!("i{at}")).collect();
    let mut inputs = nets.clone();
    inputs.push("clk".to_owned());
    nets.extend((0..bits).map(|at| format!("q{at}")));
    let mut text: String = (0..bits).map(|at| format!("    net q{at}\n")).collect();
    for at in 0..2 + draw(8) {
        let operator = ["and", "or", "nand", "nor", "xor", "xnor"][draw(6)];
        let [one, two] = [0, 1].map(|_| nets[draw(nets.len())].clone());
        writeln!(text, "    n{at} = {one} {operator} {two}").unwrap();
        nets.push(format!("n{at}"));
    }
    for at in 0..bits {
        writeln!(text, "    q{at} = register[start = {}]({}, clk)", draw(2), nets[draw(nets.len())]).unwrap();
    }
    let outputs: Vec<String> = (0..1 + draw(3)).map(|at| format!("o{at}")).collect();
    for output in &outputs {
        writeln!(text, "    {output} = {}", nets[draw(nets.len())]).unwrap();
    }
    let (inputs, outputs) = (inputs.join(", "), outputs.join(", "));
    format!("circuit m({inputs}) -> ({outputs}) {{\n{text}}}\nswarm w {{ circuit: m, registers: waves }}\n")
}

/// Runs random machines in physics; the number of robots and of wrong outputs.
fn wrong_outputs(machines: usize, seed: u64) -> (usize, usize) {
    let mut random = ChaCha8Rng::seed_from_u64(seed);
    let (mut robots, mut wrong) = (0, 0);
    for _ in 0..machines {
        let text = program(&mut random);
        let (_, checked) = session_of(text);
        let compiled = checked.compile(&"m".into(), &CompileOptions::default()).unwrap();
        let ports = compiled.assembly.inputs.len();
        robots += compiled.assembly.members.len();
        let bits = |_| (0..ports).map(|_| random.next_u32() & 1 == 1).collect();
        let rows: Vec<Vec<bool>> = (0..=STEPS).map(bits).collect();
        wrong += wrong_in_rows(&compiled, &rows);
    }
    (robots, wrong)
}

/// The number of wrong outputs of a wave machine in physics through these rows, over all its threads.
fn wrong_in_rows(compiled: &Compiled, rows: &[Vec<bool>]) -> usize {
    let machine = compiled.mapping.waves.as_ref().unwrap();
    let step = ClockStep::of(&compiled.mapping.source).unwrap();
    let bit = |port: usize, cycle: usize| rows[machine.row_at(port, cycle, rows.len())][port];
    let cycles = 0..machine.cycles(rows.len());
    let inputs = cycles.map(|cycle| (0..step.inputs.len()).map(|port| bit(port, cycle)).collect()).collect();
    let conditions = SwarmConditions { inputs, window: 1, poses: None };
    let trace = nbc_swarm::simulate(&Simulator::default(), &compiled.assembly, &conditions, &mut |_| ());
    let mut state: Vec<bool> = step.state.iter().map(|bit| bit.start).collect();
    let mut wrong = 0;
    for (at, row) in rows.iter().enumerate() {
        if at > 0 {
            state = step.run(row, &state).1;
        }
        let expected = step.run(row, &state).0;
        for thread in 0..machine.period as usize {
            let shown = (0..expected.len()).map(|output| match machine.reading(output, at, thread) {
                Reading::Start(start) => start,
                Reading::Cycle(cycle) => trace.cycles[cycle].outputs[output],
            });
            wrong += shown.zip(&expected).filter(|(shown, expected)| shown != *expected).count();
        }
    }
    wrong
}

#[test]
fn random_machines_run_in_physics_in_every_thread() {
    let (robots, wrong) = wrong_outputs(3, 1);
    assert!(robots > 5, "{robots} robots");
    assert_eq!(wrong, 0);
}

#[test]
#[ignore = "takes minutes"]
fn three_hundred_random_machines_run_in_physics_in_every_thread() {
    let (robots, wrong) = wrong_outputs(300, 2);
    println!("{robots} robots of 300 machines, {wrong} wrong outputs");
    assert_eq!(wrong, 0);
}

/// The number of wrong outputs of a circuit of the gallery in so many steps, over all its threads.
fn wrong_in(file: &str, swarm: &str, steps: usize) -> usize {
    let mut session = Session::new(DiskWorld);
    let checked = session.open(root().join("circuits").join(file).to_str().unwrap()).unwrap();
    let choice = Choice { swarm: Some(swarm.to_owned()), ..Choice::default() };
    let circuit = checked.circuit(&choice).unwrap();
    let options = CompileOptions { swarm: choice.swarm, ..CompileOptions::default() };
    let compiled = checked.compile(&circuit, &options).unwrap();
    let rows = vec![vec![false; compiled.assembly.inputs.len()]; steps + 1];
    wrong_in_rows(&compiled, &rows)
}

#[test]
#[ignore = "takes minutes"]
fn ten_thousand_steps_of_the_gallery_are_right() {
    let machines = [("wave_lfsr.nb", "wave"), ("wave_counter.nb", "quick_wave"), ("wave_counter.nb", "sturdy_wave")];
    let wrong = machines.map(|(file, swarm)| {
        let wrong = wrong_in(file, swarm, 10_000);
        println!("{file} as {swarm}: {wrong} wrong outputs in 10000 steps");
        wrong
    });
    assert_eq!(wrong, [0; 3]);
}
