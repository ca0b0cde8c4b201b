//! A machine with its properties as one transition system. What is said of a step is a circuit, too, the monitor: its
//! inputs are the ports of the machine and a clock, its registers remember what was there in the step before, and its
//! outputs are the expressions of the properties.

use crate::Netlist;
use crate::and_graph::{AndGraph, AndLiteral};
use crate::network::{Network, Signal};
use crate::properties::beside::EnvironmentStep;
use crate::properties::machine::{Machine, StepClock, reads};
use crate::properties::system::{SystemRegister, TransitionSystem};
use crate::properties::wording::NoSteps;
use crate::waves::{ClockStep, StateBit};
use nbc_base::model::{Function, Property, PropertyKind};
use nbc_base::source::CancelFlag;

#[derive(Clone, Debug)]
pub struct Monitored {
    /// The system. Its properties are those that are no assumptions, in order.
    pub system: TransitionSystem,
    /// The same, where each property is violated in every step in which it could be.
    pub checks: TransitionSystem,
    /// The input ports of the circuit but for the clock.
    pub ports: Vec<usize>,
    /// The literal of the system for each of `ports`.
    pub given: Vec<AndLiteral>,
    pub clock: Option<StepClock>,
}

impl Monitored {
    /// The monitor has an output for each property, and one before it for what a property with a condition depends on.
    ///
    /// # Panics
    /// When the monitor does not have these ports, or has other memory than registers of its clock.
    pub fn of(
        circuit: &Netlist,
        monitor: &Netlist,
        properties: &[Property],
        environment: Option<&EnvironmentStep>,
        cancel: &CancelFlag,
    ) -> Result<Self, NoSteps> {
        let monitor = ClockStep::of(monitor).expect("a monitor has registers of one clock");
        let machine = &Machine::of(circuit, &allowed(&monitor, properties, circuit.inputs().len()), cancel)?;
        if let Some(clock) = machine.clock.filter(|clock| reads(&monitor.logic, clock.input)) {
            return Err(NoSteps::ClockHasNoValue { clock: monitor.inputs[clock.input].clone() });
        }
        if let Some(EnvironmentStep { step, .. }) = environment {
            let own = machine.clock.filter(|clock| clock.rises);
            let own = own.map(|clock| circuit.net_name(circuit.inputs()[clock.input]));
            let is_same = step.clock.is_none_or(|at| own.as_ref() == Some(&step.inputs[at]));
            if own.is_none() || !is_same {
                return Err(NoSteps::EnvironmentClock);
            }
        }
        let assemble = |checks| Assembly::of((circuit, machine), environment, &monitor, properties, checks);
        Ok(Self { checks: assemble(true)?.system, ..assemble(false)? })
    }
}

fn allowed(monitor: &ClockStep, properties: &[Property], ports: usize) -> Network {
    let mut made = Network::new(ports);
    let input = |signal: usize| (signal < 2 + ports).then_some(signal as Signal);
    let mut known: Vec<Option<Signal>> = (0..2 + monitor.logic.inputs).map(input).collect();
    for gate in &monitor.logic.gates {
        let pin = |pin: usize| if gate.function.depends_on(pin) { known[gate.pins[pin] as usize] } else { Some(0) };
        let pins = pin(0).zip(pin(1));
        known.push(pins.map(|(a, b)| made.add(gate.function, [a, b])));
    }
    let mut said = monitor.logic.outputs.iter().map(|&output| known[output as usize]);
    for property in properties {
        let own: Vec<Option<Signal>> = said.by_ref().take(property.outputs()).collect();
        let allows = match own[..] {
            _ if property.kind != PropertyKind::Assume => None,
            [Some(condition), Some(value)] => Some(made.add(Function::OR.with_input_inverted(0), [condition, value])),
            [Some(value)] => Some(value),
            _ => None,
        };
        made.outputs.extend(allows);
    }
    made
}

struct Assembly {
    graph: AndGraph,
    registers: Vec<SystemRegister>,
    first: usize,
}

impl Assembly {
    fn of(
        (circuit, machine): (&Netlist, &Machine),
        environment: Option<&EnvironmentStep>,
        monitor: &ClockStep,
        properties: &[Property],
        checks: bool,
    ) -> Result<Monitored, NoSteps> {
        let clock = machine.clock.map(|clock| clock.input);
        let ports: Vec<usize> = (0..machine.inputs).filter(|&port| Some(port) != clock).collect();
        let answered: Vec<usize> =
            environment.map_or(Vec::new(), |beside| beside.gives(circuit)).into_iter().map(|(port, _)| port).collect();
        let free: Vec<usize> = ports.iter().copied().filter(|port| !answered.contains(port)).collect();
        let mut names: Vec<String> = free.iter().map(|&port| monitor.inputs[port].clone()).collect();
        names.extend(environment.map_or(Vec::new(), EnvironmentStep::words));
        let beside = environment.map_or(Vec::new(), EnvironmentStep::registers);
        let depth = properties.iter().map(|property| property.before).max().unwrap_or(0);
        let wanted = || properties.iter().filter(|property| property.kind != PropertyKind::Assume);
        let waits: usize = wanted().filter_map(|property| property.within).sum();
        let once = environment.map_or(0, |_| wanted().count());
        let own = usize::from(machine.is_clocked());
        let count = machine.state.len() + own + monitor.state.len() + depth + beside.len() + waits + once;
        let graph = AndGraph::new(names.len() + count);
        let mut assembly = Self { graph, registers: Vec::new(), first: names.len() };
        let state = assembly.state(&machine.state);
        let first = if machine.is_clocked() { assembly.register("the first step", Some(true)) } else { 0 };
        let remembered = assembly.state(&monitor.state);
        let started: Vec<AndLiteral> =
            (1..=depth).map(|step| assembly.register(&format!("step {step}"), Some(false))).collect();
        let beside: Vec<AndLiteral> = beside.into_iter().map(|(name, start)| assembly.register(&name, start)).collect();
        let sources: Vec<AndLiteral> = (0..names.len()).map(|at| assembly.graph.source(at)).collect();
        let (sources, words) = sources.split_at(free.len());
        let mut inputs = vec![Some(0); machine.inputs];
        answered.iter().for_each(|&port| inputs[port] = None);
        free.iter().zip(sources).for_each(|(&port, &source)| inputs[port] = Some(source));
        let (inputs, beside_after, reads_known) = match environment {
            Some(environment) => {
                let graph = &mut assembly.graph;
                let answer = environment.answer(graph, (circuit, machine), inputs, (&state, &beside, words))?;
                let after = beside.iter().zip(answer.after);
                let after = after.map(|(&before, after)| graph.choice(first, before, after)).collect();
                (answer.inputs, after, answer.reads_known)
            }
            None => (inputs.into_iter().map(|input| input.expect("all are free")).collect(), Vec::new(), 1),
        };
        let (shown, after) = machine.step(&mut assembly.graph, &inputs, &state, first);
        let seen = [&inputs[..], &shown, &[0], &remembered].concat();
        let mut said = assembly.graph.outputs(&monitor.logic, &seen);
        let kept = said.split_off(monitor.outputs.len());

        let mut nexts = after;
        nexts.extend((machine.is_clocked()).then_some(0));
        nexts.extend(kept);
        nexts.extend([1].iter().chain(&started).take(depth));
        nexts.extend(beside_after);
        let (mut bad, mut constraints) = (Vec::new(), Vec::new());
        let mut said = said.into_iter();
        let mut next = || said.next().expect("an output for each property");
        for property in properties {
            let begins = property.before.checked_sub(1).map_or(1, |last| started[last]);
            let condition = if property.has_condition { next() } else { 1 };
            let is_never = property.kind == PropertyKind::Never;
            let mut value = next();
            if checks && property.kind != PropertyKind::Assume {
                value = usize::from(is_never);
            }
            let active = assembly.graph.and(begins, condition);
            let wrong = assembly.graph.and(active, value ^ usize::from(!is_never));
            if property.kind == PropertyKind::Assume {
                constraints.push(wrong ^ 1);
                continue;
            }
            let mut waiting = wrong;
            for step in 1..=property.within.unwrap_or(0) {
                let before = assembly.register(&format!("waiting[{step}]"), Some(false));
                nexts.push(waiting);
                waiting = assembly.graph.and(before, value ^ 1);
            }
            if environment.is_some() {
                // The words are known in the first step that violates the property.
                let before = assembly.register("violated", Some(false));
                nexts.push(assembly.graph.or(before, waiting));
                waiting = assembly.graph.and(waiting, before ^ 1);
                waiting = assembly.graph.and(waiting, reads_known);
            }
            bad.push(waiting);
        }
        let Self { graph, mut registers, .. } = assembly;
        registers.iter_mut().zip(nexts).for_each(|(register, next)| register.next = next);
        let given = ports.iter().map(|&port| inputs[port]).collect();
        let ands = graph.ands.items;
        let system = TransitionSystem { inputs: names, registers, ands, bad, constraints };
        Ok(Monitored { system, checks: TransitionSystem::default(), ports, given, clock: machine.clock })
    }

    fn register(&mut self, name: &str, start: Option<bool>) -> AndLiteral {
        self.registers.push(SystemRegister { name: name.to_owned(), start, next: 0 });
        self.graph.source(self.first + self.registers.len() - 1)
    }

    fn state(&mut self, bits: &[StateBit]) -> Vec<AndLiteral> {
        bits.iter().map(|bit| self.register(&bit.name, Some(bit.start))).collect()
    }
}
