//! Logic that is right in the reachable states only: in all others, outputs and next values may be anything.
//!
//! The registers are flip-flops that start at their start values. What holds in all their reachable states is proved by
//! induction (`invariant.rs`). Under it a search replaces gates, and SAT proves every result equal to the original.

mod cycle;
mod invariant;

use std::fmt;

use crate::cells::CellLibrary;
use crate::clause::Clause;
use crate::formats::{Design, Forcing, RegisterKind};
use crate::network::{Network, Signal, View};
use crate::options::MapOptions;
use crate::proof::Comparison;
use crate::reachable::cycle::Cycle;
use crate::reachable::invariant::Invariant;
use crate::synth::{CareSet, reduce_within};
use crate::{NetId, Netlist};

#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Reachable {
    /// The numbers of reachable states and of all states, if the reachable ones were enumerated.
    pub states: Option<(u64, u64)>,
    /// In every reachable state, for each of these lists, a register of it has the given value.
    pub relations: Vec<Vec<(String, bool)>>,
}

/// A design with simpler logic that is equal in every reachable state, and what was assumed. Registers without a start
/// value get the start value 0.
///
/// # Panics
/// When SAT does not prove the simpler logic equal, which would be a bug of the search.
pub fn simplify(
    design: &Design,
    library: &CellLibrary,
    options: &MapOptions,
) -> Result<(Design, Reachable), WhyEveryState> {
    if design.registers.is_empty() {
        return Err(WhyEveryState::NoRegisters);
    }
    let is_latch = |kind| matches!(kind, RegisterKind::High | RegisterKind::Low);
    if let Some(latch) = design.registers.iter().find(|register| is_latch(register.kind)) {
        return Err(WhyEveryState::Latch(latch.name.clone()));
    }
    if let Some(forced) = design.registers.iter().find(|register| register.forcing != Forcing::Never) {
        return Err(WhyEveryState::Forced(forced.name.clone()));
    }
    let network = View::of(&design.logic, &[]).map_err(|_| WhyEveryState::Loop)?.network;
    let cycle = Cycle::of(design, &network);
    let words = invariant::simulate(&cycle);
    let Invariant { clauses, states } = Invariant::of(&cycle, &words[cycle.ports..][..design.registers.len()]);
    let care = care_set(&cycle, &clauses, words, network.inputs);
    let simpler = reduce_within(&network, library, &care, options);
    let equal = Comparison::within(&network, &care.clauses).compare(&simpler).is_ok();
    assert!(equal, "the simpler logic is equal in every reachable state");
    let named =
        |clause: &Clause| clause.iter().map(|&(at, value)| (design.registers[at].name.clone(), value)).collect();
    let reachable = Reachable {
        states: states.map(|reached| (reached, 1 << design.registers.len())),
        relations: clauses.iter().map(named).collect(),
    };
    Ok((with_logic(design, &simpler), reachable))
}

/// The clauses as conditions on the inputs of the logic, with patterns that fulfill them.
fn care_set(cycle: &Cycle, clauses: &[Clause], mut words: Vec<Vec<u64>>, inputs: usize) -> CareSet {
    words.truncate(inputs);
    let moved = |clause: &Clause| clause.iter().map(|&(at, value)| (cycle.register(at), value)).collect();
    CareSet { clauses: clauses.iter().map(moved).collect(), words }
}

fn with_logic(design: &Design, network: &Network) -> Design {
    let source = &design.logic;
    let mut logic = Netlist::new(&source.name);
    let mut constants: [Option<NetId>; 2] = [None; 2];
    let mut nets: Vec<Option<NetId>> = vec![None; 2];
    nets.extend(source.inputs().iter().map(|&id| Some(logic.add_input(source.net_name(id)))));
    let mut net = |logic: &mut Netlist, nets: &[Option<NetId>], signal: Signal| {
        let constant = || *constants[signal as usize].get_or_insert_with(|| logic.add_constant(signal == 1));
        nets[signal as usize].unwrap_or_else(constant)
    };
    for gate in &network.gates {
        let pins = gate.pins.map(|pin| net(&mut logic, &nets, pin));
        let used = if gate.function.depends_on(1) { 2 } else { 1 };
        nets.push(Some(logic.add_gate(gate.function, &pins[..used])));
    }
    for (&id, &output) in source.outputs().iter().zip(&network.outputs) {
        let driver = net(&mut logic, &nets, output);
        logic.add_output(source.net_name(id), driver);
    }
    let mut registers = design.registers.clone();
    registers.iter_mut().for_each(|register| register.start = Some(register.starts_at()));
    Design { logic, registers, ascending: design.ascending.clone() }
}

#[derive(Clone, Debug, PartialEq, Eq)]
pub enum WhyEveryState {
    NoRegisters,
    Latch(String),
    Forced(String),
    Loop,
}

impl fmt::Display for WhyEveryState {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NoRegisters => f.write_str("the design has no registers"),
            Self::Latch(name) => write!(f, "`{name}` is a level-sensitive latch"),
            Self::Forced(name) => write!(f, "`{name}` has an asynchronous set or reset"),
            Self::Loop => f.write_str("the logic has feedback"),
        }
    }
}
