//! Two designs that should be the same, such as two readings of one text: whether they are equal for ever.
//!
//! Both make the same random steps first. Then they are one machine with common inputs, in which registers that agree
//! are found and proved to agree by induction ([`RegisterClasses`]); outputs are compared where they do.

use std::collections::{BTreeMap, BTreeSet};

use crate::correspondence::{ClassLimits, RegisterClasses};
use crate::formats::Design;
use crate::formats::buses::buses;
use crate::network::{Network, Signal, View};
use crate::proof::Compared;
use crate::random_run::DesignRun;
use crate::{CancelFlag, NetId, RegisterNode};

/// The most and the fewest random steps, and the gates that are evaluated in all of them, roughly.
const MOST_STEPS: usize = 4_096;
const FEWEST_STEPS: usize = 64;
const MOST_GATES: usize = 20_000_000;

const MOST_TRIES: usize = 400;

/// The most clauses that the solver learns to compare two signals.
const PORTION: u64 = 2_000;

const SEED: u64 = 0x6e62_6369_7665_7269;

#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Likeness {
    Proved,
    /// They are equal in so many random steps.
    Open(usize),
    /// They may differ, but only in a state of the first that may never be reached.
    Doubtful {
        steps: usize,
        inputs: Vec<bool>,
        state: Vec<bool>,
        outputs: [Vec<bool>; 2],
    },
    Different([DesignRun; 2]),
    Port(String),
    /// One of them has feedback, or does not settle, so that it has no steps.
    NoSteps,
}

pub fn likeness(one: &Design, two: &Design, cancel: &CancelFlag) -> Likeness {
    let order = match PortOrder::of(one, two) {
        Ok(order) => order,
        Err(port) => return Likeness::Port(port),
    };
    let gates = one.netlist.cells().count().max(1);
    let steps = (MOST_GATES / gates).clamp(FEWEST_STEPS, MOST_STEPS);
    let names = one.netlist.net_names(one.netlist.inputs());
    let ports: Vec<Vec<usize>> = buses(&names, &one.ascending).into_iter().map(|bus| bus.bits).collect();
    let random = DesignRun::random(&one.netlist, &ports, steps, SEED);
    let Some((run, other)) = random.and_then(|run| Some((order.run(two, &run.inputs)?, run))) else {
        return Likeness::NoSteps;
    };
    let mut outputs = run.outputs.iter().zip(&other.outputs);
    if let Some(last) = outputs.position(|(run, other)| run != other) {
        return Likeness::Different(shortened(one, two, &order, other.inputs[..=last].to_vec()));
    }
    let steps = run.outputs.len();
    let product = match Product::of(one, two, &order) {
        Some(product) => product,
        None => return Likeness::NoSteps,
    };
    match product.compared(cancel) {
        Compared::Equal => Likeness::Proved,
        Compared::Open => Likeness::Open(steps),
        Compared::Different(values) if product.registers.is_empty() => {
            Likeness::Different(shortened(one, two, &order, vec![values]))
        }
        Compared::Different(values) => product.doubtful(steps, &values),
    }
}

/// The ports of one design in another: for each of the first, its place in the second.
struct PortOrder {
    inputs: Vec<usize>,
    outputs: Vec<usize>,
}

impl PortOrder {
    fn of(one: &Design, two: &Design) -> Result<Self, String> {
        let names = |design: &Design| {
            [design.netlist.inputs(), design.netlist.outputs()].map(|ids| design.netlist.net_names(ids))
        };
        let places = |first: &[String], second: &[String]| -> Result<Vec<usize>, String> {
            let known: BTreeMap<&String, usize> = second.iter().enumerate().map(|(at, name)| (name, at)).collect();
            if let Some(more) = second.iter().find(|name| !first.contains(name)) {
                return Err(more.clone());
            }
            first.iter().map(|name| known.get(name).copied().ok_or_else(|| name.clone())).collect()
        };
        let ([inputs, outputs], [others, other_outputs]) = (names(one), names(two));
        Ok(Self { inputs: places(&inputs, &others)?, outputs: places(&outputs, &other_outputs)? })
    }

    fn run(&self, two: &Design, inputs: &[Vec<bool>]) -> Option<DesignRun> {
        let mut moved = vec![vec![false; self.inputs.len()]; inputs.len()];
        for (step, moved) in inputs.iter().zip(&mut moved) {
            self.inputs.iter().zip(step).for_each(|(&place, &value)| moved[place] = value);
        }
        let run = DesignRun::with(&two.netlist, moved)?;
        let shown = |outputs: &Vec<bool>| self.outputs.iter().map(|&place| outputs[place]).collect();
        Some(DesignRun { inputs: inputs.to_vec(), outputs: run.outputs.iter().map(shown).collect() })
    }
}

/// Runs with the last of these inputs in which both designs differ, with as few of the others as are needed.
fn shortened(one: &Design, two: &Design, order: &PortOrder, mut inputs: Vec<Vec<bool>>) -> [DesignRun; 2] {
    let runs = |inputs: &[Vec<bool>]| Some([DesignRun::with(&one.netlist, inputs.to_vec())?, order.run(two, inputs)?]);
    let mut best = runs(&inputs).expect("both have run with these inputs");
    let (mut size, mut tries) = (inputs.len() / 2, MOST_TRIES);
    while size > 0 {
        let mut at = 0;
        while at + size < inputs.len() && tries > 0 {
            tries -= 1;
            let fewer = [&inputs[..at], &inputs[at + size..]].concat();
            match runs(&fewer).filter(|[one, two]| one.outputs.last() != two.outputs.last()) {
                Some(shorter) => (best, inputs) = (shorter, fewer),
                None => at += size,
            }
        }
        size /= 2;
    }
    best
}

/// Two designs as one machine: its outputs are those of the first and of the second, then the pins of the registers of
/// both.
struct Product {
    network: Network,
    registers: Vec<RegisterNode>,
    /// The numbers of inputs and of outputs of a design, and of the registers of the first.
    ports: [usize; 2],
    own: usize,
    /// Registers that clock others, each with that of the first which it must equal.
    clocks: BTreeSet<[usize; 2]>,
}

impl Product {
    fn of(one: &Design, two: &Design, order: &PortOrder) -> Option<Self> {
        let ids = [one, two].map(|design| design.netlist.registers().map(|(id, _)| id).collect::<Vec<NetId>>());
        let first = View::of(&one.netlist, &ids[0]).ok()?.network;
        let second = View::of(&two.netlist, &ids[1]).ok()?.network;
        let [ports, shown] = [one.netlist.inputs().len(), one.netlist.outputs().len()];
        let own = ids[0].len();
        let mut network = Network::new(ports + own + ids[1].len());
        let inputs: Vec<Signal> = (0..network.inputs).map(|at| network.input(at)).collect();
        let outputs = network.include(&first, &inputs[..ports + own]);
        let mut others = vec![0; ports];
        order.inputs.iter().zip(&inputs).for_each(|(&place, &input)| others[place] = input);
        others.extend(&inputs[ports + own..]);
        let others = network.include(&second, &others);
        network.outputs = outputs[..shown].to_vec();
        network.outputs.extend(order.outputs.iter().map(|&place| others[place]));
        network.outputs.extend(&outputs[shown..]);
        network.outputs.extend(&others[shown..]);
        let registers =
            [one, two].into_iter().flat_map(|design| design.netlist.registers().map(|(_, register)| register.clone()));
        let mut product =
            Self { network, registers: registers.collect(), ports: [ports, shown], own, clocks: BTreeSet::new() };
        product.share_clocks();
        Some(product)
    }

    /// A register that clocks others stands for that of the first with its name, if they are proved equal.
    fn share_clocks(&mut self) {
        let (first, second) = self.registers.split_at(self.own);
        let known: BTreeMap<&Option<String>, usize> = first.iter().zip(0..).map(|(one, at)| (&one.name, at)).collect();
        let mut place = 2 * self.ports[1] + first.iter().map(RegisterNode::pins).sum::<usize>();
        for register in second {
            let clock = &mut self.network.outputs[place + usize::from(RegisterNode::CLOCK)];
            place += register.pins();
            let at = (*clock as usize).checked_sub(2 + self.ports[0]).filter(|&at| at < self.registers.len());
            if let Some(at) = at
                && let Some(&same) = known.get(&self.registers[at].name)
            {
                self.clocks.insert([same, at]);
                *clock = (2 + self.ports[0] + same) as Signal;
            }
        }
    }

    fn compared(&self, cancel: &CancelFlag) -> Compared {
        let [inputs, shown] = self.ports;
        let limits = ClassLimits { portion: Some(PORTION), cancel: cancel.clone(), follows_clocks: true };
        let classes = RegisterClasses::of(&self.registers, &self.network, [inputs, 2 * shown], limits);
        if !self.clocks.iter().all(|&[one, two]| classes.are_equal(one, two)) {
            return Compared::Open;
        }
        let pairs: Vec<[usize; 2]> = (0..shown).map(|at| [at, shown + at]).collect();
        classes.compared(&pairs)
    }

    fn doubtful(&self, steps: usize, values: &[bool]) -> Likeness {
        let [inputs, shown] = self.ports;
        let found = self.network.run(values.iter().copied());
        Likeness::Doubtful {
            steps,
            inputs: values[..inputs].to_vec(),
            state: values[inputs..inputs + self.own].to_vec(),
            outputs: [found[..shown].to_vec(), found[shown..2 * shown].to_vec()],
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::formats::blif;
    use nbc_base::source::FileId;

    fn design(text: &str) -> Design {
        blif::read(text, FileId(0), None).unwrap()
    }

    fn compared(one: &str, two: &str) -> Likeness {
        likeness(&design(one), &design(two), &CancelFlag::default())
    }

    fn counter(low: &str, high: &str, next: &str) -> String {
        format!(
            ".model c\n.inputs clk\n.outputs q\n.latch l {low} re clk 0\n.latch h {high} re clk 0\n\
             .names {low} l\n0 1\n\
             .names {low} {high} h\n{next}\n.names {high} q\n1 1\n.end\n"
        )
    }

    #[test]
    fn machines_are_equal_for_ever_whatever_their_registers_are_called() {
        let right = "10 1\n01 1";
        assert_eq!(compared(&counter("a", "b", right), &counter("c", "d", right)), Likeness::Proved);
        let Likeness::Different([one, two]) = compared(&counter("a", "b", right), &counter("a", "b", "10 1")) else {
            panic!("they differ");
        };
        assert_eq!(one.inputs, two.inputs);
        assert_eq!(
            (one.outputs.last(), two.outputs.last(), one.inputs.len()),
            (Some(&vec![true]), Some(&vec![false]), 6)
        );
    }

    #[test]
    fn ports_are_found_by_name() {
        let one = ".model m\n.inputs a b\n.outputs p q\n.names a b p\n10 1\n.names b q\n1 1\n.end\n";
        let two = ".model m\n.inputs b a\n.outputs q p\n.names b q\n1 1\n.names b a p\n01 1\n.end\n";
        assert_eq!(compared(one, two), Likeness::Proved);
        assert_eq!(compared(one, &two.replace(" q", " r")), Likeness::Port("r".to_owned()));
    }

    #[test]
    fn rare_differences_of_logic_are_found_and_of_states_doubted() {
        let inputs: Vec<String> = (0..40).map(|at| format!("i{at}")).collect();
        let all = inputs.join(" ");
        let rare = |row: &str| format!(".model m\n.inputs {all}\n.outputs q\n.names {all} q\n{row} 1\n.end\n");
        let ones = "1".repeat(38);
        let compared_rows = compared(&rare(&format!("{ones}11")), &rare(&format!("{ones}00")));
        let Likeness::Different([first, _]) = compared_rows else { panic!("they differ") };
        assert!(first.inputs.last().is_some_and(|inputs| inputs[..38].iter().all(|&value| value)));
        // The state in which they differ is never reached.
        let stuck = |cover: &str| {
            format!(
                ".model m\n.inputs clk a\n.outputs q\n.latch n s re clk 0\n.names s a n\n11 1\n\
                 .names s a q\n{cover} 1\n.end\n"
            )
        };
        assert_eq!(compared(&stuck("1-"), &stuck("11")), Likeness::Proved);
        let chain = |cover: &str| {
            let latches: String = (0..12).map(|at| format!(".latch n{at} s{at} re clk 0\n")).collect();
            let names: String = (1..12).map(|at| format!(".names s{} n{at}\n1 1\n", at - 1)).collect();
            format!(
                ".model m\n.inputs clk a\n.outputs q\n{latches}.names a s11 n0\n10 1\n{names}\
                     .names s0 s1 s2 s3 s4 s5 s6 s7 s8 s9 s10 s11 q\n{cover} 1\n.end\n"
            )
        };
        let doubtful = compared(&chain("111111111111"), &chain("111111111110"));
        assert!(matches!(doubtful, Likeness::Different(_) | Likeness::Doubtful { .. }), "{doubtful:?}");
    }
}
