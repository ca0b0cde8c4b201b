//! Static timing over actuation cycles: the arrival time of each net, the slowest path, and the hold of a row.
//!
//! A robot's output is correct some cycles after its last input switched: its settle time. A path ends at a latch that
//! is closed in the phase that a row ends in. A loop of other cells is passed twice, once by the change and once by the
//! response to it, until the change has reached every net of the loop (docs/timing.md, "Static timing").

mod arrivals;
mod clock;
mod phase;
mod phase_timing;
mod update;

use petgraph::visit::NodeIndexable;

use crate::cells::{CellKind, CellLibrary};
use crate::timing::arrivals::{Arrivals, Delay};
use crate::timing::phase::{MOST_ROOTS, Phase, passages, phases};
use crate::{NetId, Netlist, Node, Storage, Unphased, WhyUnphased};

pub use clock::{ClockPath, ClockTimes, InputTimes};
pub use phase_timing::{PhaseTiming, TimedFlipFlop, TimedLatch, UnphasedLoop};

#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Timing {
    /// The latest change of each net and its slack, by number; `None` for nets that never change.
    times: Vec<Option<NetTime>>,
    /// Cycles to hold a row so that every net is correct at its end.
    pub hold: u32,
    pub critical_path: Vec<NetId>,
    pub storage: Storage,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
struct NetTime {
    arrival: u32,
    slack: u32,
}

impl Timing {
    pub fn of(netlist: &Netlist, library: &CellLibrary) -> Self {
        Self::with(netlist, library.kinds_of(netlist))
    }

    /// The timing of a wave machine, in which a row is a step of so many cycles and no path is longer than another.
    pub fn of_steps(cycles: u32) -> Self {
        Self { times: Vec::new(), hold: cycles, critical_path: Vec::new(), storage: Storage::default() }
    }

    pub fn with<'k>(netlist: &Netlist, kind: impl Fn(NetId) -> &'k CellKind) -> Self {
        let mut storage = Storage::of(netlist, &kind);
        let phases = timed_phases(netlist, &mut storage, &kind);
        let delay = Delay { netlist, kind: &kind };
        let timed: Vec<(Phase, Arrivals)> = phases
            .into_iter()
            .map(|phase| {
                let arrivals = Arrivals::from(&delay, &phase, |update| delay.launch(&phase, update));
                (phase, arrivals)
            })
            .collect();
        let mut hold = 0;
        let mut critical_path = Vec::new();
        for (phase, arrivals) in &timed {
            if let Some((time, event)) = arrivals.last(|_| true)
                && (time > hold || critical_path.is_empty())
            {
                (hold, critical_path) = (time, arrivals.path(phase, event));
            }
        }
        let mut times: Vec<Option<NetTime>> = vec![None; netlist.graph().node_bound()];
        for (phase, arrivals) in &timed {
            let slack = arrivals.slack(&delay, phase, hold);
            for (i, update) in phase.updates.iter().enumerate().filter(|(_, update)| phase.is_real(update)) {
                let time = &mut times[update.node.index()];
                let old = time.unwrap_or(NetTime { arrival: 0, slack: hold });
                let arrival = old.arrival.max(arrivals.times[i].unwrap_or(0));
                *time = Some(NetTime { arrival, slack: old.slack.min(slack[i]) });
            }
        }
        Self { times, hold, critical_path, storage }
    }

    /// Cycles after which the net is correct and stays correct.
    pub fn arrival(&self, net: NetId) -> u32 {
        self.time(net).map_or(0, |time| time.arrival)
    }

    /// Cycles after which the net must be correct so that every row is correct after [`Timing::hold`] cycles.
    pub fn required(&self, net: NetId) -> u32 {
        self.time(net).map_or(self.hold, |time| time.arrival + time.slack)
    }

    /// Cycles by which the net could be later without a longer hold.
    pub fn slack(&self, net: NetId) -> u32 {
        self.required(net) - self.arrival(net)
    }

    fn time(&self, net: NetId) -> Option<NetTime> {
        self.times.get(net.index()).copied().flatten()
    }
}

/// The phases that rows may end in. Latches of too many enables, and loops that stay open in a phase, are noted.
fn timed_phases<'k>(netlist: &Netlist, storage: &mut Storage, kind: &impl Fn(NetId) -> &'k CellKind) -> Vec<Phase> {
    let roots: Vec<NetId> = storage.roots().into_iter().map(|(root, _)| root).collect();
    let (tried, untried) = roots.split_at(roots.len().min(MOST_ROOTS));
    let phase = |values| Phase::new(netlist, storage, &passages(netlist, storage, &values, netlist.inputs(), kind));
    let phases: Vec<Phase> = phases(netlist, tried).into_iter().map(phase).collect();
    let mut unphased: Vec<Unphased> = Vec::new();
    for latch in &storage.latches {
        let stays_open = |phase: &Phase| phase.loops.iter().any(|core| core.binary_search(&latch.cells[0]).is_ok());
        let why = match untried.contains(&latch.root) {
            true => WhyUnphased::ManyEnables,
            false if phases.iter().any(stays_open) => WhyUnphased::StaysOpen,
            false => continue,
        };
        unphased.push(Unphased { nets: latch.cells.clone(), why });
    }
    storage.unphased.extend(unphased);
    phases
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
    use crate::example::{full_adder, latch};
    use crate::map::map;
    use nbc_base::model::Function;

    fn names(netlist: &Netlist, path: &[NetId]) -> String {
        path.iter().map(|&id| netlist.net_name(id)).collect::<Vec<_>>().join(" ")
    }

    #[test]
    fn a_full_adder_settles_after_its_longest_path() {
        let mut library = CellLibrary::uniform([Function::XOR, Function::AND, Function::OR]);
        library.insert(Function::XOR, CellKind::uniform(4, 1.0));
        let mapped = map(&full_adder(), &library).unwrap();
        let timing = Timing::of(&mapped, &library);
        assert_eq!(timing.hold, 8);
        assert!(timing.critical_path.iter().all(|&id| timing.slack(id) == 0));
        let carry = mapped.outputs()[1];
        assert_eq!((timing.arrival(carry), timing.required(carry), timing.slack(carry)), (6, 8, 2));
    }

    #[test]
    fn the_hold_of_a_latch_covers_its_guards_and_its_pair() {
        let library = CellLibrary::uniform([Function::NAND, Function::NOT]);
        let mapped = map(&latch(), &library).unwrap();
        let timing = Timing::of(&mapped, &library);
        assert_eq!(timing.hold, 2 + 2);
        assert_eq!(timing.critical_path.len(), 1 + 2 + 2);
        assert!(names(&mapped, &timing.critical_path).starts_with("d "));
    }

    #[test]
    fn fan_out_is_counted() {
        let netlist = full_adder();
        assert_eq!(fan_out(&netlist)[0].1, 2);
    }
}
