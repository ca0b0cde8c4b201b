//! The holds of rows: no longer than needed, and long enough whatever robots do before they have settled.

use nbc_base::model::{Function, Hears, Library, PhysicsWorld};
use nbc_circuit::{CellLibrary, Delays, Timing};
use nbc_session::store::DiskWorld;
use nbc_session::{Session, TestOptions};
use nbc_swarm::{Assembly, Level, Settling, StimulusSource, assemble, cells};
use proptest::prelude::*;
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

use crate::memory::{elements, mapped, text};
use crate::page::robot;
use crate::support::*;

/// Robots of a swarm with random outputs until they have settled.
struct RandomSwarm<'a> {
    assembly: &'a Assembly,
    sensed: Vec<(Vec<bool>, usize)>,
    /// The output, and whether it is certain: it has been correct since the robot settled.
    bits: Vec<(bool, bool)>,
    cycles: usize,
}

impl<'a> RandomSwarm<'a> {
    fn new(assembly: &'a Assembly) -> Self {
        let members = &assembly.members;
        let bits = members.iter().map(|member| (member.start, false)).collect();
        Self { assembly, sensed: vec![(Vec::new(), 0); members.len()], bits, cycles: 0 }
    }

    fn cycle(&mut self, inputs: &[bool], random: &mut ChaCha8Rng) {
        let starting = self.cycles < self.assembly.start_cycles();
        let before = self.bits.clone();
        for (i, member) in self.assembly.members.iter().enumerate() {
            let sense = |signal: &StimulusSource| match *signal {
                StimulusSource::Input(input) => inputs[input],
                StimulusSource::Robot(other) if starting => self.assembly.members[other].start,
                StimulusSource::Robot(other) => before[other].0,
                StimulusSource::Constant(value) => value,
            };
            let sensed: Vec<bool> = member.senses.iter().map(sense).collect();
            let held = if self.cycles > 0 && sensed == self.sensed[i].0 { self.sensed[i].1 + 1 } else { 1 };
            let right = member.robot.function().at(sensed.iter().copied());
            self.sensed[i] = (sensed, held);
            let character = &member.robot.character;
            let keeps = before[i] == (right, true) && character.glitch_rate == 0.0;
            let is_certain =
                (held >= character.clock as usize || keeps) && self.cycles + 1 >= self.assembly.start_cycles();
            self.bits[i] = if is_certain { (right, true) } else { (random.random_range(0..2) == 1, false) };
        }
        self.cycles += 1;
    }

    fn values(&self) -> Vec<bool> {
        self.bits.iter().map(|bit| bit.0).collect()
    }
}

/// Robots of all functions with clocks of one to `most` cycles; every other one of the slow ones glitches.
fn robots(most: u32, random: &mut ChaCha8Rng) -> Library {
    let with_character = |function: Function| {
        let mut robot = robot(function.name(), function);
        robot.character.clock = random.random_range(1..=most);
        robot.character.glitch_rate = if random.random_range(0..2) == 0 { 0.0 } else { 0.1 };
        robot
    };
    Library { robots: Function::all().map(with_character).collect() }
}

/// Switches the inputs at random, and holds each row until it has settled, with random outputs before. No row takes
/// longer than `bound` cycles.
fn check(assembly: &Assembly, bound: u32, random: &mut ChaCha8Rng) -> usize {
    let mut settling = Settling::new(assembly, 1);
    let mut swarms: Vec<RandomSwarm> = (0..4).map(|_| RandomSwarm::new(assembly)).collect();
    let mut settled = 0;
    for row in 0..12 {
        let inputs: Vec<bool> = assembly.inputs.iter().map(|_| random.random_range(0..2) == 1).collect();
        let cycles = settling.cycles_to_settle(&inputs, 200);
        settled += usize::from(cycles.is_some());
        let bound = bound as usize + if row == 0 { assembly.start_cycles() } else { 0 };
        assert!(cycles.is_none_or(|cycles| cycles <= bound), "{cycles:?}, at most {bound} by static timing");
        for _ in 0..cycles.unwrap_or_else(|| random.random_range(1..9)) {
            settling.hold(&inputs, 1);
            for swarm in &mut swarms {
                swarm.cycle(&inputs, random);
                let agree = |(known, value): (&Option<bool>, bool)| known.is_none_or(|known| known == value);
                assert!(settling.bits().iter().zip(swarm.values()).all(agree), "a known output is correct");
            }
        }
        if cycles.is_some() {
            assert!(settling.bits().iter().all(Option::is_some), "every output is known once the row has settled");
            let end = settling.bits().to_vec();
            settling.clone().hold(&inputs, 20);
            assert_eq!(settling.bits(), end, "and none changes");
        }
    }
    settled
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 64, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn a_settled_row_has_the_same_outputs_for_any_behavior_before(elements in elements(), seed: u64, most in 1..4u32) {
        let mut random = ChaCha8Rng::seed_from_u64(seed);
        let netlist = mapped(&text(&elements), &CellLibrary::uniform(Function::all().filter(|f| f.arity() == 2)));
        let library = robots(most, &mut random);
        let bound = Timing::of(&netlist, &cells(&library), Delays::Clock).hold;
        check(&assemble(&netlist, &library), bound, &mut random);
    }
}

#[test]
fn registers_of_quick_robots_settle_in_every_row() {
    let mut random = ChaCha8Rng::seed_from_u64(1);
    let netlist = mapped(
        "circuit memory(a, clk) -> (q, r) {\n    q = register[start = 0](a, clk)\n    r = register[start = 1](q xor \
         a, clk)\n}\n",
        &CellLibrary::uniform([Function::NAND, Function::NOT]),
    );
    let library = robots(1, &mut random);
    let bound = Timing::of(&netlist, &cells(&library), Delays::Clock).hold;
    assert_eq!(check(&assemble(&netlist, &library), bound, &mut random), 12);
}

fn holds(file: &str) -> (f64, usize) {
    let path = root().join("circuits").join(file);
    let mut session = Session::new(DiskWorld);
    let checked = session.checked(path.to_str().unwrap());
    let options = TestOptions { level: Some(Level::Physics), ..TestOptions::default() };
    let of_test = |test| session.cases(&checked, test, &options).unwrap();
    let holds: Vec<usize> = checked
        .program
        .tests
        .iter()
        .flat_map(of_test)
        .flat_map(|case| case.row_holds().iter().map(|row_hold| row_hold.hold).collect::<Vec<_>>())
        .collect();
    (holds.iter().sum::<usize>() as f64 / holds.len() as f64, holds.into_iter().max().unwrap())
}

#[test]
fn the_rows_of_the_gallery_are_short() {
    let most = "comparator 8.0, counter 7.5, d_flip_flop 8.0, decoder 4.0, full_adder 5.0, half_adder 4.0, \
        latch 5.0, lfsr 8.0, majority 4.5, multiplexer 6.0, parity 7.0, ripple_adder 10.0, \
        rule_110 4.0, sequence_detector 9.0, seven_segment 13.0, sr_latch 5.0, t_flip_flop 8.0";
    for (circuit, most) in most.split(", ").map(|one| one.split_once(' ').unwrap()) {
        let (mean, longest) = holds(&format!("{circuit}.nb"));
        println!("{circuit}: {mean:.1} cycles a row on average, {longest} at most");
        assert!(mean <= most.parse().unwrap(), "{circuit}: {mean} cycles a row on average, expected {most} at most");
    }
}

#[test]
fn slow_robots_that_drive_each_other_keep_their_start_values() {
    let mut random = ChaCha8Rng::seed_from_u64(1);
    let netlist = mapped(
        "circuit memory(a, clk) -> (q) {\n    q = register[start = 0](a, clk)\n}\n",
        &CellLibrary::uniform([Function::NAND, Function::NOT]),
    );
    let mut library = robots(1, &mut random);
    library.robots.iter_mut().for_each(|robot| robot.character.clock = 4);
    let assembly = assemble(&netlist, &library);
    assert_eq!(assembly.start_cycles(), 4);
    let mut settling = Settling::new(&assembly, 1);
    let start: Vec<Option<bool>> = assembly.members.iter().map(|member| Some(member.start)).collect();
    assert_eq!(settling.cycles_to_settle(&[false, false], 100), Some(4));
    settling.hold(&[false, false], 4);
    assert_eq!(settling.bits(), start);
}

#[test]
fn an_exclusive_or_settles_anew_where_stimuli_change_within_its_cycle() {
    let text = "circuit memory(a, b) -> (q) {\n    q = a xor b\n}\n";
    let netlist = mapped(text, &CellLibrary::uniform([Function::XOR]));
    let mut xor = robot("xor", Function::XOR);
    xor.character.clock = 2;
    let library = Library { robots: vec![xor] };
    let settles = |hears: Hears| {
        let assembly = assemble(&netlist, &library).in_world(PhysicsWorld { hears, ..PhysicsWorld::default() });
        let mut settling = Settling::new(&assembly, 1);
        settling.hold(&[false, false], 6);
        settling.cycles_to_settle(&[true, true], 9)
    };
    assert_eq!((settles(Hears::Cycle), settles(Hears::Always)), (Some(1), Some(2)));
}
