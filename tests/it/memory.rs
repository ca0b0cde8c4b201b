//! Memory made of cells works for any data and any delays of its cells, also in physics.

use nbc_base::model::{Function, Instance, Program};

use nbc_circuit::{CellLibrary, Delayed, Guarded, Netlist, RegisterForm, Role, elaborate, lower, map, prove};

use proptest::prelude::*;
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

use crate::support::random_program::random_program;
use crate::support::*;

const INPUTS: [&str; 4] = ["a", "b", "clk", "en"];
pub const CLOCK: usize = 2;
pub const ENABLE: usize = 3;

/// The inputs of a memory element; nets are numbered `a` and `b` first, then the elements.
#[derive(Clone, Copy, Debug)]
enum Data {
    Constant(bool),
    Net(usize, bool),
    Xor(usize, usize),
    /// The first net if `en` is on, else the second.
    Choice(usize, usize),
}

#[derive(Clone, Copy, Debug)]
enum Kind {
    /// A register, and whether its clock is inverted.
    Register(bool),
    /// A latch that is open while `en` is that value.
    Latch(bool),
    /// A latch that is always open, or never.
    Fixed(bool),
}

#[derive(Clone, Copy, Debug)]
pub struct Element {
    kind: Kind,
    data: Data,
    pub start: bool,
}

impl Data {
    fn text(self) -> String {
        let name = |net: usize| if net < 2 { INPUTS[net].to_owned() } else { format!("q{}", net - 2) };
        match self {
            Self::Constant(value) => u8::from(value).to_string(),
            Self::Net(net, false) => name(net),
            Self::Net(net, true) => format!("not {}", name(net)),
            Self::Xor(a, b) => format!("{} xor {}", name(a), name(b)),
            Self::Choice(a, b) => format!("if en then {} else {}", name(a), name(b)),
        }
    }

    fn value(self, inputs: &[bool], state: &[bool]) -> bool {
        let net = |net: usize| if net < 2 { inputs[net] } else { state[net - 2] };
        match self {
            Self::Constant(value) => value,
            Self::Net(one, inverted) => net(one) != inverted,
            Self::Xor(a, b) => net(a) != net(b),
            Self::Choice(a, b) => net(if inputs[ENABLE] { a } else { b }),
        }
    }
}

pub fn text(elements: &[Element]) -> String {
    let outputs: Vec<_> = (0..elements.len()).map(|i| format!("q{i}")).collect();
    let mut text = format!("circuit memory({}) -> ({}) {{\n", INPUTS.join(", "), outputs.join(", "));
    for (i, Element { kind, data, start }) in elements.iter().enumerate() {
        let (word, control) = match kind {
            Kind::Register(false) => ("register", "clk"),
            Kind::Register(true) => ("register", "not clk"),
            Kind::Latch(true) => ("latch", "en"),
            Kind::Latch(false) => ("latch", "not en"),
            Kind::Fixed(true) => ("latch", "1"),
            Kind::Fixed(false) => ("latch", "0"),
        };
        text += &format!("    q{i} = {word}[start = {}]({}, {control})\n", u8::from(*start), data.text());
    }
    text + "}\n"
}

/// The state for new inputs: first registers whose clock rose store their data, then latches follow.
pub fn next(elements: &[Element], before: &[bool], inputs: &[bool], state: &mut [bool]) {
    let old = state.to_vec();
    for (i, element) in elements.iter().enumerate() {
        if let Kind::Register(inverted) = element.kind
            && before[CLOCK] == inverted
            && inputs[CLOCK] != inverted
        {
            state[i] = element.data.value(inputs, &old);
        }
    }
    for (i, element) in elements.iter().enumerate() {
        let open = match element.kind {
            Kind::Register(_) => false,
            Kind::Latch(value) => inputs[ENABLE] == value,
            Kind::Fixed(open) => open,
        };
        if open {
            state[i] = element.data.value(inputs, state);
        }
    }
}

/// One to five elements. A register takes any net, itself too; a latch takes inputs and the elements before it, so that
/// none oscillates, and none that changes with the enable that closes it.
pub fn elements() -> impl Strategy<Value = Vec<Element>> {
    let element = (0..9u8, 0..8u8, 0..100usize, 0..100usize, any::<bool>(), any::<bool>());
    proptest::collection::vec(element, 1..6).prop_map(|drawn| {
        let all = drawn.len() + 2;
        let build = |(i, &(kind, data, x, y, inverted, start)): (usize, &(u8, u8, usize, usize, bool, bool))| {
            let kind = match kind {
                0..4 => Kind::Register(false),
                4 => Kind::Register(true),
                5 | 6 => Kind::Latch(inverted),
                _ => Kind::Fixed(kind == 7),
            };
            let nets = if matches!(kind, Kind::Register(_)) { all } else { i + 2 };
            let data = match (data, kind) {
                (0 | 1, _) => Data::Constant(inverted),
                (2 | 3, Kind::Register(_)) => Data::Xor(x % nets, y % nets),
                (4, Kind::Register(_)) => Data::Choice(x % nets, y % nets),
                (_, Kind::Register(_)) => Data::Net(x % nets, inverted),
                _ => Data::Net(x % 2, start),
            };
            Element { kind, data, start }
        };
        drawn.iter().enumerate().map(build).collect()
    })
}

pub fn program(text: &str) -> Program {
    session_of(text).1.program.clone()
}

pub fn mapped(text: &str, cells: &CellLibrary) -> Netlist {
    let source = elaborate(&program(text), &Instance::from("memory")).unwrap();
    let mapped = map(&source, cells).unwrap();
    prove(&source, &mapped).unwrap();
    lower(&mapped, cells, RegisterForm::Nands).unwrap()
}

/// Switches one input after another, holds each until the circuit has settled, and compares every output with the model
/// of the elements.
fn remembers(elements: &[Element], netlist: &Netlist, random: &mut ChaCha8Rng) {
    let guarded = Guarded::of(netlist);
    // One to three cycles. But cells of a clock must be no slower than two other cells, or a register would store the
    // next value of another one.
    let most = |id| if guarded.role(id) == Some(Role::Control) { 2 } else { 3 };
    let mut delayed = Delayed::new(netlist, |id| random.random_range(1..=most(id)));
    let rest = 6 * netlist.cells().count() + 30;
    let mut inputs = [false; 4];
    let mut state: Vec<bool> = elements.iter().map(|element| element.start).collect();
    next(elements, &inputs, &inputs, &mut state);
    assert_eq!(delayed.run(&inputs, rest), state, "at the start\n{}", text(elements));
    for row in 0..16 {
        let before = inputs;
        inputs[random.random_range(0..4)] ^= true;
        next(elements, &before, &inputs, &mut state);
        let found = delayed.run(&inputs, rest);
        assert_eq!(found, state, "row {row}, {before:?} to {inputs:?}\n{}{netlist}", text(elements));
    }
}

pub fn libraries() -> [CellLibrary; 3] {
    let all = Function::all().filter(|function| function.arity() == 2 || *function == Function::NOT);
    [
        CellLibrary::uniform([Function::NAND, Function::NOT]),
        CellLibrary::uniform([Function::AND, Function::OR, Function::NOT]),
        CellLibrary::uniform(all),
    ]
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 32, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn registers_and_latches_work_with_any_data_and_delays(elements in elements(), seed: u64) {
        let mut random = ChaCha8Rng::seed_from_u64(seed);
        for library in libraries() {
            let netlist = mapped(&text(&elements), &library);
            (0..4).for_each(|_| remembers(&elements, &netlist, &mut random));
        }
    }
}

/// A register that stores 1; constants made one of its guards read the clock too early.
/// Its programs have registers whose data and enables depend on themselves, on constants and on outputs.
fn check_random_programs(seeds: std::ops::Range<u64>) {
    let library = CellLibrary::uniform([Function::NAND]);
    for seed in seeds {
        let text = random_program(seed);
        let source = elaborate(&checked(&*text).program, &"main".into()).unwrap();
        let proof = prove(&source, &map(&source, &library).unwrap());
        assert!(proof.is_ok(), "program {seed}: {}\n{text}", proof.unwrap_err());
    }
}

#[test]
fn registers_of_random_programs_are_proved() {
    check_random_programs(0..6);
}

/// `cargo test --test it registers_of_two_thousand -- --ignored`
#[test]
#[ignore = "takes minutes"]
fn registers_of_two_thousand_random_programs_are_proved() {
    check_random_programs(6..2_006);
}

fn run(program: &str) {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("memory.nb");
    fs::write(&path, program).unwrap();
    nbc::run_file(&path, &nbc::CompileOptions::default()).unwrap_or_else(|error| panic!("{error}")).assert_passed();
}

#[test]
fn ones_are_shifted_in_step_by_step_in_physics() {
    run("circuit ones(clk) -> (q[3]) {\n    q = register({q[1], q[0], 1}, clk)\n}\n\
         test ones \"counts rises\" {\n    clk | q\n    0 | 000\n    1 | 001\n    0 | 001\n    1 | 011\n}\n");
}
