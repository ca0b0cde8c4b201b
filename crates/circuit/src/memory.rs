//! Timing requirements of memory elements: the pulse that sets one, and the time for which its inputs must be stable
//! before and after it closes.

use std::collections::{BTreeMap, VecDeque};

use serde::Serialize;

use crate::guarded::elements;
use crate::loops::Loops;
use crate::{NetId, Netlist, Node, Timing};

/// The times of a memory element, in cycles. They hold for robots with delays between one cycle and their clock.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Memory {
    pub nets: Vec<String>,
    /// The length of the pulse that sets the element, at its input: the change passes every cell of the element once.
    pub pulse: u32,
    /// The time for which all other inputs must be stable before an input closes the element: the slowest path to it
    /// plus the pulse, minus the fastest path by which it closes.
    pub setup: u32,
    /// The time for which they must stay stable afterwards, because the closing path may be slow and the next change
    /// fast.
    pub hold: u32,
}

impl Memory {
    /// The memory elements of a mapped netlist; `clock` is the largest delay of each cell.
    pub fn all(netlist: &Netlist, timing: &Timing, clock: impl Fn(NetId) -> u32) -> Vec<Self> {
        let fastest = fastest(netlist);
        let element = |nets: &Vec<NetId>| {
            let listened = nets.iter().flat_map(|&net| netlist.pins(net));
            let entered: Vec<NetId> = listened.filter(|pin| !nets.contains(pin)).collect();
            let slow = entered.iter().map(|&net| timing.arrival(net)).max().unwrap_or(0);
            let fast = entered.iter().filter_map(|net| fastest.get(net)).copied().min().unwrap_or(0);
            let pulse = nets.iter().map(|&net| clock(net)).sum();
            Self {
                nets: netlist.net_names(nets),
                pulse,
                setup: (slow + pulse).saturating_sub(fast),
                hold: slow.saturating_sub(fast),
            }
        };
        Loops::memory(netlist)
            .cores()
            .iter()
            .filter(|core| !core.is_empty())
            .flat_map(|core| elements(netlist, core))
            .map(|nets| element(&nets))
            .collect()
    }
}

/// The fewest cycles after which a switch of an input can be noticed at each net: one for each cell on the way.
fn fastest(netlist: &Netlist) -> BTreeMap<NetId, u32> {
    let mut fastest: BTreeMap<NetId, u32> = netlist.inputs().iter().map(|&input| (input, 0)).collect();
    let mut pending: VecDeque<NetId> = netlist.inputs().iter().copied().collect();
    while let Some(net) = pending.pop_front() {
        for (listener, _) in netlist.fanout(net) {
            if matches!(netlist.node(listener), Node::Cell(_)) && !fastest.contains_key(&listener) {
                fastest.insert(listener, fastest[&net] + 1);
                pending.push_back(listener);
            }
        }
    }
    fastest
}

#[cfg(test)]
mod tests {
    use rand::SeedableRng;

    use super::*;
    use crate::cells::{CellKind, CellLibrary};
    use crate::example::{flip_flop, latch};
    use crate::map::map;
    use crate::{Delayed, RegisterForm, lower};
    use nbc_base::model::Function;

    const CLOCK: u32 = 3;

    fn library() -> CellLibrary {
        [(Function::NAND, CellKind::uniform(CLOCK, 1.0))].into_iter().collect()
    }

    fn memory(netlist: &Netlist) -> Vec<Memory> {
        Memory::all(netlist, &Timing::of(netlist, &library()), |_| CLOCK)
    }

    /// In how many of 300 random assignments of delays a latch loses the value `data`.
    fn forgets(netlist: &Netlist, setup: u32, hold: u32, data: bool) -> usize {
        let mut random = rand_chacha::ChaCha8Rng::seed_from_u64(5);
        let mut forgets = || {
            let mut draw = || 1 + (rand::Rng::next_u32(&mut random) % CLOCK) as usize;
            let mut latch = Delayed::new(netlist, |_| draw());
            latch.run(&[!data, true], 60);
            latch.run(&[data, true], setup as usize);
            latch.run(&[data, false], hold as usize);
            latch.run(&[!data, false], 60)[0] != data
        };
        (0..300).filter(|_| forgets()).count()
    }

    #[test]
    fn a_latch_with_its_required_times_works_for_any_delays() {
        let mapped = map(&latch(), &library()).unwrap();
        let [times] = &memory(&mapped)[..] else {
            panic!("a latch is one memory element");
        };
        assert_eq!((times.nets.len(), times.pulse, times.setup, times.hold), (2, 6, 6 + 6 - 1, 6 - 1));
        for data in [false, true] {
            assert_eq!(forgets(&mapped, times.setup, times.hold, data), 0);
            assert!(forgets(&mapped, 2, times.hold, data) > 0, "a short set-up is a risk");
        }
    }

    #[test]
    fn a_flip_flop_has_two_memory_elements() {
        let mut netlist = Netlist::new("flip_flop");
        let [d, clk] = ["d", "clk"].map(|name| netlist.add_input(name));
        let q = flip_flop(&mut netlist, "q", d, clk, false);
        netlist.add_output("q", q);
        let mapped = map(&netlist, &library()).unwrap();
        let mapped = lower(&mapped, &library(), RegisterForm::Nands).unwrap();
        let sizes: Vec<usize> = memory(&mapped).iter().map(|memory| memory.nets.len()).collect();
        assert_eq!(sizes, [2, 2]);
    }
}
