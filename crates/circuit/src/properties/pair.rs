//! Two machines with the same inputs as one transition system: a step violates its property if an output differs.

use crate::Netlist;
use crate::and_graph::{AndGraph, AndLiteral};
use crate::network::Network;
use crate::properties::machine::{Machine, StepClock};
use crate::properties::monitor::Monitored;
use crate::properties::system::{SystemRegister, TransitionSystem};
use crate::properties::wording::NoSteps;
use nbc_base::model::Function;
use nbc_base::source::CancelFlag;

impl Monitored {
    /// # Panics
    /// When the circuits have different numbers of ports.
    pub fn of_two(circuits: [&Netlist; 2], cancel: &CancelFlag) -> Result<Self, (usize, NoSteps)> {
        let [one, two] = circuits;
        assert_eq!(one.inputs().len(), two.inputs().len(), "they have the same inputs");
        assert_eq!(one.outputs().len(), two.outputs().len(), "they have the same outputs");
        let any = Network::new(one.inputs().len());
        let machine = |at: usize| Machine::of(circuits[at], &any, cancel).map_err(|why| (at, why));
        let machines = [machine(0)?, machine(1)?];
        let clock = common_clock(&machines).ok_or((1, NoSteps::OtherSteps))?;
        let ports: Vec<usize> =
            (0..one.inputs().len()).filter(|&port| clock.is_none_or(|clock| clock.input != port)).collect();
        let own = usize::from(clock.is_some());
        let count: usize = machines.iter().map(|machine| machine.state.len()).sum();
        let mut graph = AndGraph::new(ports.len() + own + count);
        let mut sources = (0..ports.len() + own + count).map(|at| graph.source(at)).collect::<Vec<_>>().into_iter();
        let mut inputs = vec![0; one.inputs().len()];
        ports.iter().zip(&mut sources).for_each(|(&port, source)| inputs[port] = source);
        let mut registers: Vec<SystemRegister> = Vec::new();
        let mut register = |name: &str, start: bool, next: AndLiteral| {
            registers.push(SystemRegister { name: name.to_owned(), start: Some(start), next });
        };
        let mut first = 0;
        if clock.is_some() {
            first = sources.next().expect("a source for each register");
            register("the first step", true, 0);
        }
        let shown = machines.each_ref().map(|machine| {
            let state: Vec<AndLiteral> = sources.by_ref().take(machine.state.len()).collect();
            let (shown, after) = machine.step(&mut graph, &inputs, &state, first);
            machine.state.iter().zip(after).for_each(|(bit, next)| register(&bit.name, bit.start, next));
            shown
        });
        let differs = shown[0].iter().zip(&shown[1]).fold(0, |any, (&a, &b)| {
            let differs = graph.function(Function::XOR, [a, b]);
            graph.or(any, differs)
        });
        let system = TransitionSystem {
            inputs: ports.iter().map(|&port| one.net_name(one.inputs()[port])).collect(),
            registers,
            ands: graph.ands.items,
            bad: vec![differs],
            ..TransitionSystem::default()
        };
        let given = (0..ports.len()).map(|at| 2 * (at + 1)).collect();
        Ok(Self { system, checks: TransitionSystem::default(), ports, given, clock })
    }
}

/// The clock whose edges are the steps of both machines; `None` if their steps are different events.
fn common_clock([one, two]: &[Machine; 2]) -> Option<Option<StepClock>> {
    match (one.clock, two.clock) {
        (one, two) if one == two => Some(one),
        (Some(clock), None) => two.ignores(clock.input).then_some(Some(clock)),
        (None, Some(clock)) => one.ignores(clock.input).then_some(Some(clock)),
        _ => None,
    }
}
