//! Static timing over actuation cycles: the arrival time of each net, the slowest path, and the hold of a row.
//!
//! A robot's output is correct some cycles after its last input switched: its settle time. A loop core is passed twice,
//! once by the change and once by the response to it, until the change has reached every net of the core
//! (docs/compiler.md, "Time").

use std::collections::BTreeMap;

use crate::circuit::cells::{CellKind, CellLibrary};
use crate::circuit::loops::Loops;
use crate::circuit::{NetId, Netlist, Node};

/// Which delay a cell has.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Delays {
    /// The robot's clock, for any transition. The resulting hold is safe; `hold: auto` never exceeds it.
    #[default]
    Clock,
    /// The settle time measured for each transition of the inputs.
    Transition,
}

/// Arrival and required times in cycles after the inputs switched.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Timing {
    arrival: BTreeMap<NetId, u32>,
    required: BTreeMap<NetId, u32>,
    /// Cycles to hold a row so that every net is correct at its end.
    pub hold: u32,
    /// The nets of the slowest path, input first.
    pub critical_path: Vec<NetId>,
}

/// A net's turn: nets on a loop have two.
struct Turn {
    net: NetId,
    pins: Vec<(u8, usize)>,
}

/// An event: a turn falls (0) or rises (1).
type Event = (usize, usize);

impl Timing {
    /// Times a mapped netlist with each cell's delay from the library.
    pub fn of(netlist: &Netlist, library: &CellLibrary, delays: Delays) -> Self {
        let fallback = CellKind::uniform(1, 0.0);
        Self::with(netlist, delays, |id| {
            netlist.cell(id).and_then(|cell| library.get(cell.function)).unwrap_or(&fallback)
        })
    }

    /// Times a mapped netlist with the delay of each cell's own robot.
    pub fn with<'k>(netlist: &Netlist, delays: Delays, kind: impl Fn(NetId) -> &'k CellKind) -> Self {
        let turns = unroll(netlist);
        let delay = |turn: &Turn, pin: u8, value: usize, output: usize| -> Option<u32> {
            let cell = netlist.cell(turn.net)?;
            let kind = kind(turn.net);
            match delays {
                Delays::Clock => Some(kind.clock),
                Delays::Transition => kind.settle_time(cell.function, usize::from(pin), value == 1, output == 1),
            }
        };
        let (arrivals, before) = forward(netlist, &turns, &delay, &kind);
        let latest = (0..turns.len())
            .flat_map(|turn| [(turn, 0), (turn, 1)])
            .max_by_key(|&(t, v)| (arrivals[t][v], std::cmp::Reverse((t, v))));
        let hold = latest.map_or(0, |(turn, value)| arrivals[turn][value]);
        let slack = backward(&turns, &delay, &arrivals, hold);
        let mut arrival = BTreeMap::new();
        let mut required = BTreeMap::new();
        for (i, turn) in turns.iter().enumerate() {
            let time = arrivals[i][0].max(arrivals[i][1]);
            arrival.insert(turn.net, time);
            let least = required.entry(turn.net).or_insert((slack[i], time));
            *least = (slack[i].min(least.0), time);
        }
        let required = required.into_iter().map(|(net, (slack, time))| (net, time + slack)).collect();
        Self { arrival, required, hold, critical_path: latest.map_or(Vec::new(), |event| path(&turns, &before, event)) }
    }

    /// Cycles after which the net is correct and stays correct.
    pub fn arrival(&self, net: NetId) -> u32 {
        self.arrival.get(&net).copied().unwrap_or(0)
    }

    /// Cycles after which the net must be correct so that every row is correct after [`Timing::hold`] cycles.
    pub fn required(&self, net: NetId) -> u32 {
        self.required.get(&net).copied().unwrap_or(self.hold)
    }

    /// Cycles by which the net could be later without a longer hold.
    pub fn slack(&self, net: NetId) -> u32 {
        self.required(net) - self.arrival(net).min(self.required(net))
    }
}

/// The nets in an order with pins first. Loop cores occur twice; the second time they read the first.
fn unroll(netlist: &Netlist) -> Vec<Turn> {
    let loops = Loops::of(netlist);
    let mut turns: Vec<Turn> = Vec::new();
    let mut last: BTreeMap<NetId, usize> = BTreeMap::new();
    let mut take = |turns: &mut Vec<Turn>, net: NetId| {
        let listens = netlist.pins(net);
        let pins = (0..).zip(&listens).filter_map(|(pin, driver)| Some((pin, *last.get(driver)?))).collect();
        last.insert(net, turns.len());
        turns.push(Turn { net, pins });
    };
    let mut done = 0;
    for &net in loops.order() {
        match loops.core_of(net) {
            None => take(&mut turns, net),
            Some(core) if core >= done => {
                done = core + 1;
                let order = along(netlist, &loops.cores()[core]);
                order.iter().chain(&order).for_each(|&member| take(&mut turns, member));
            }
            Some(_) => {}
        }
    }
    turns
}

/// A loop core in depth-first order from the cells that listen to something outside.
fn along(netlist: &Netlist, core: &[NetId]) -> Vec<NetId> {
    let entered = |&&net: &&NetId| netlist.pins(net).iter().any(|pin| core.binary_search(pin).is_err());
    let mut seen = std::collections::BTreeSet::new();
    let mut finished = Vec::with_capacity(core.len());
    for &root in core.iter().filter(entered).chain(core) {
        let mut stack = vec![(root, false)];
        while let Some((net, leaving)) = stack.pop() {
            if leaving {
                finished.push(net);
            } else if seen.insert(net) {
                stack.push((net, true));
                let listeners = netlist.fanout(net).into_iter().map(|(listener, _)| listener);
                stack.extend(listeners.filter(|id| core.binary_search(id).is_ok()).map(|id| (id, false)));
            }
        }
    }
    finished.reverse();
    finished
}

/// The latest fall and rise of each turn, and the event each waits for.
fn forward<'k>(
    netlist: &Netlist,
    turns: &[Turn],
    delay: &impl Fn(&Turn, u8, usize, usize) -> Option<u32>,
    kind: &impl Fn(NetId) -> &'k CellKind,
) -> (Vec<[u32; 2]>, Vec<[Option<Event>; 2]>) {
    let mut arrivals: Vec<[u32; 2]> = Vec::with_capacity(turns.len());
    let mut before: Vec<[Option<Event>; 2]> = Vec::with_capacity(turns.len());
    for turn in turns {
        let base = if netlist.cell(turn.net).is_some() && turn.pins.is_empty() { kind(turn.net).clock } else { 0 };
        let mut times = [base; 2];
        let mut causes = [None; 2];
        for &(pin, driver) in &turn.pins {
            for (value, output) in [(0, 0), (0, 1), (1, 0), (1, 1)] {
                let cycles = match netlist.node(turn.net) {
                    Node::Cell(_) => delay(turn, pin, value, output),
                    _ => (value == output).then_some(0),
                };
                let time = cycles.map(|cycles| arrivals[driver][value] + cycles);
                if time.is_some_and(|time| time > times[output] || causes[output].is_none() && time == times[output]) {
                    times[output] = time.unwrap_or(0);
                    causes[output] = Some((driver, value));
                }
            }
        }
        arrivals.push(times);
        before.push(causes);
    }
    (arrivals, before)
}

/// The slack of each visit.
fn backward(
    turns: &[Turn],
    delay: &impl Fn(&Turn, u8, usize, usize) -> Option<u32>,
    arrivals: &[[u32; 2]],
    hold: u32,
) -> Vec<u32> {
    let mut required = vec![[hold; 2]; turns.len()];
    for (i, turn) in turns.iter().enumerate().rev() {
        for &(pin, driver) in &turn.pins {
            for (value, output) in [(0, 0), (0, 1), (1, 0), (1, 1)] {
                if let Some(cycles) = delay(turn, pin, value, output) {
                    required[driver][value] = required[driver][value].min(required[i][output].saturating_sub(cycles));
                } else if value == output && turn.pins.len() == 1 {
                    required[driver][value] = required[driver][value].min(required[i][output]);
                }
            }
        }
    }
    let slack = |(required, arrival): (&[u32; 2], &[u32; 2])| {
        (0..2).map(|value| required[value].saturating_sub(arrival[value])).min().unwrap_or(0)
    };
    required.iter().zip(arrivals).map(slack).collect()
}

/// The nets from an input to an event.
fn path(turns: &[Turn], before: &[[Option<Event>; 2]], event: Event) -> Vec<NetId> {
    let steps = std::iter::successors(Some(event), |&(turn, value)| before[turn][value]);
    let mut nets: Vec<_> = steps.map(|(turn, _)| turns[turn].net).collect();
    nets.reverse();
    nets
}

/// The number of pins that read each cell or input, largest first. Any number of robots can sense one robot's motion.
pub fn fan_out(netlist: &Netlist) -> Vec<(NetId, usize)> {
    let drives = |&id: &NetId| matches!(netlist.node(id), Node::Input(_) | Node::Cell(_));
    let mut counts: Vec<_> = netlist.ids().filter(drives).map(|id| (id, netlist.fanout(id).len())).collect();
    counts.sort_by_key(|&(id, count)| (std::cmp::Reverse(count), id));
    counts
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::circuit::example::{full_adder, latch};
    use crate::circuit::map::map;
    use crate::model::Function;

    fn names(netlist: &Netlist, path: &[NetId]) -> String {
        path.iter().map(|&id| netlist.net_name(id)).collect::<Vec<_>>().join(" ")
    }

    #[test]
    fn a_full_adder_settles_after_its_longest_path() {
        let mut library = CellLibrary::uniform([Function::XOR, Function::AND, Function::OR]);
        library.insert(Function::XOR, CellKind::uniform(4, 1.0));
        let mapped = map(&full_adder(), &library).unwrap();
        let timing = Timing::of(&mapped, &library, Delays::Clock);
        assert_eq!(timing.hold, 8);
        assert!(timing.critical_path.iter().all(|&id| timing.slack(id) == 0));
        let carry = mapped.outputs()[1];
        assert_eq!((timing.arrival(carry), timing.required(carry), timing.slack(carry)), (6, 8, 2));
    }

    #[test]
    fn the_hold_of_a_latch_covers_its_guards_and_two_passes_of_its_loop() {
        let library = CellLibrary::uniform([Function::NAND, Function::NOT]);
        let mapped = map(&latch(), &library).unwrap();
        let timing = Timing::of(&mapped, &library, Delays::Clock);
        assert_eq!(timing.hold, 2 + 3);
        assert_eq!(timing.critical_path.len(), 1 + 2 + 3);
        assert!(names(&mapped, &timing.critical_path).starts_with("d "));
    }

    #[test]
    fn settle_times_of_transitions_are_used() {
        let mut library = CellLibrary::uniform([Function::NAND]);
        let mut slow_rise = CellKind::uniform(9, 1.0);
        slow_rise.settle = [[1; 4]; 4];
        (0..3).for_each(|to| slow_rise.settle[3][to] = 3);
        library.insert(Function::NAND, slow_rise);
        let mut netlist = Netlist::new("chain");
        let a = netlist.add_input("a");
        let b = netlist.add_input("b");
        let one = netlist.add_gate(Function::NAND, &[a, b]);
        let two = netlist.add_gate(Function::NAND, &[one, b]);
        netlist.add_output("q", two);
        // Rises take three cycles and falls one, and they alternate.
        assert_eq!(Timing::of(&netlist, &library, Delays::Transition).hold, 4);
        assert_eq!(Timing::of(&netlist, &library, Delays::Clock).hold, 18);
    }

    #[test]
    fn fan_out_is_counted() {
        let netlist = full_adder();
        assert_eq!(fan_out(&netlist)[0].1, 2);
    }
}
