//! Latches of one cell: a multiplexer that reads itself shows its data while it is open, and else what it showed before
//! (docs/timing.md, "Latches of one robot").
//!
//! A latch of one bit, whatever its cells, becomes one such cell, and a flip-flop two of them, which read the clock
//! itself. This is safe because the multiplexer does not glitch: when its enable closes it, it shows the same before
//! and after, and both latches of a flip-flop see the edge in the same cycle.

use std::collections::{BTreeMap, BTreeSet};

use serde::Serialize;

use crate::cells::CellLibrary;
use crate::passes::sweep;
use crate::storage::{Follower, Inverters, Latch};
use crate::timing::wording;
use crate::{Cell, FlipFlop, NetId, Netlist, Storage};
use nbc_base::model::Function;

#[derive(Clone, Debug)]
pub struct Held {
    pub netlist: Netlist,
    pub latches: Vec<NetId>,
    pub kept: Vec<KeptLatch>,
}

/// A latch that stays as it is.
#[derive(Clone, Debug, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct KeptLatch {
    pub net: String,
    pub why: &'static str,
}

/// The multiplexer that shows its second input while the first is 1, and else the third; and that for the opposite.
const OPEN_HIGH: Function = Function::MUX;
const OPEN_LOW: Function = Function::three(0xac);

impl Held {
    /// Whether a library has the multiplexers without glitches that latches of one cell need.
    pub fn is_possible(library: &CellLibrary) -> bool {
        let is_steady = |function| library.get(function).is_some_and(|kind| !kind.glitches);
        [OPEN_HIGH, OPEN_LOW].into_iter().all(is_steady)
    }

    /// A netlist of cells of a library with latches of one cell; `None` if the library has no multiplexer without
    /// glitches.
    pub fn of(netlist: &Netlist, library: &CellLibrary) -> Option<Self> {
        if !Self::is_possible(library) {
            return None;
        }
        let storage = Storage::of(netlist, library.kinds_of(netlist));
        let inverters = Inverters::of(netlist);
        let mut kept: Vec<(NetId, &str)> =
            storage.unphased.iter().map(|unphased| (unphased.nets[0], wording::NOT_ONE_BIT)).collect();
        let mut plans = Vec::new();
        for (number, latch) in storage.latches.iter().enumerate() {
            match Plan::of(netlist, &inverters, latch) {
                Some(plan) => plans.push((number, plan)),
                None => kept.push((latch.cells[0], wording::NOT_ONE_BIT)),
            }
        }
        loop {
            let (made, latches) = make(netlist, &plans, library);
            let is_used = |net: NetId| made.graph().contains_node(net);
            let recognized = recognized(&made, library);
            let lost: Vec<usize> = (plans.iter().zip(&latches))
                .filter(|&(_, &latch)| is_used(latch) && !recognized.contains(&latch))
                .map(|((number, _), _)| *number)
                .collect();
            if lost.is_empty() {
                let latches = latches.into_iter().filter(|&latch| is_used(latch)).collect();
                kept.sort_by_key(|(net, _)| *net);
                let kept = kept.iter().map(|&(net, why)| KeptLatch { net: made.net_name(net), why }).collect();
                return Some(Self { netlist: made, latches, kept });
            }
            // Both latches of a flip-flop stay.
            let is_lost = |number: usize| {
                let pair = |pair: &&FlipFlop| [pair.first, pair.second].contains(&number);
                let with = |pair: &FlipFlop| lost.contains(&pair.first) || lost.contains(&pair.second);
                lost.contains(&number) || storage.flip_flops.iter().filter(pair).any(with)
            };
            for (number, _) in plans.extract_if(.., |(number, _)| is_lost(*number)) {
                kept.push((storage.latches[number].cells[0], wording::NOT_RECOGNIZED));
            }
        }
    }
}

fn recognized(netlist: &Netlist, library: &CellLibrary) -> BTreeSet<NetId> {
    let storage = Storage::of(netlist, library.kinds_of(netlist));
    let inverters = Inverters::of(netlist);
    let is_one = |latch: &&Latch| latch.cells.len() == 1 && Follower::of(netlist, &inverters, latch).is_some();
    storage.latches.iter().filter(is_one).map(|latch| latch.cells[0]).collect()
}

struct Plan {
    root: NetId,
    open: bool,
    data: NetId,
    /// The cells that show the bit, and those that show its opposite.
    shown: Vec<NetId>,
    opposite: Vec<NetId>,
}

impl Plan {
    fn of(netlist: &Netlist, inverters: &Inverters, latch: &Latch) -> Option<Self> {
        let follower = Follower::of(netlist, inverters, latch)?;
        let of = |inverted: bool| follower.cells.iter().filter(move |cell| cell.1 == inverted).map(|cell| cell.0);
        let (shown, opposite) = (of(false).collect::<Vec<_>>(), of(true).collect());
        (!shown.is_empty()).then_some(Self { root: latch.root, open: latch.open, data: follower.data, shown, opposite })
    }
}

/// The netlist with these latches as one cell each, and these cells. One that nothing reads is not in it.
fn make(netlist: &Netlist, plans: &[(usize, Plan)], library: &CellLibrary) -> (Netlist, Vec<NetId>) {
    let mut made = netlist.clone();
    let mut new: BTreeMap<NetId, NetId> = BTreeMap::new();
    let mut latches = Vec::with_capacity(plans.len());
    for (_, Plan { open, shown, .. }) in plans {
        let first = made.cell(shown[0]).expect("a latch is made of cells").clone();
        let function = if *open { OPEN_HIGH } else { OPEN_LOW };
        let block = made.block(shown[0]);
        let latch = made.add_loose_cell(Cell { function, ..first });
        made.put_into(latch, block);
        new.extend(shown.iter().map(|&cell| (cell, latch)));
        latches.push(latch);
    }
    let is_old = |net: NetId| plans.iter().any(|(_, plan)| plan.shown.contains(&net) || plan.opposite.contains(&net));
    for ((_, Plan { opposite, .. }), &latch) in plans.iter().zip(&latches) {
        for &cell in opposite {
            let name = made.cell(cell).and_then(|cell| cell.name.clone());
            let inverter = Cell { function: inverter(library), name, start: None, span: None };
            let pins = [latch; 2];
            let net = made.add_cell(inverter.clone(), &pins[..inverter.function.arity()]);
            let block = made.block(cell);
            made.put_into(net, block);
            new.insert(cell, net);
        }
    }
    for (&cell, &net) in &new {
        for (listener, pin) in made.fanout(cell) {
            if !is_old(listener) {
                made.drive(listener, pin, net);
            }
        }
    }
    let now = |net: NetId| new.get(&net).copied().unwrap_or(net);
    for ((_, plan), &latch) in plans.iter().zip(&latches) {
        for (pin, net) in (0..).zip([now(plan.root), now(plan.data), latch]) {
            made.connect(latch, pin, net);
        }
    }
    sweep(&mut made);
    (made, latches)
}

fn inverter(library: &CellLibrary) -> Function {
    if library.get(Function::NOT).is_some() { Function::NOT } else { Function::NAND }
}

#[cfg(test)]
mod tests {
    use rand::SeedableRng;
    use rand_chacha::ChaCha8Rng;

    use super::*;
    use crate::cells::CellKind;
    use crate::example::{latch, multiplexer_library};
    use crate::map::map;
    use crate::passes::dissolve_wires;
    use crate::{Delayed, Delays, Timing, registers};

    fn held(source: &Netlist) -> Held {
        let held = Held::of(&map(source, &multiplexer_library()).unwrap(), &multiplexer_library()).unwrap();
        assert!(held.kept.is_empty(), "{:?}", held.kept);
        held
    }

    #[test]
    fn the_papers_latch_is_two_cells_and_one_if_its_opposite_is_not_shown() {
        let both = held(&latch());
        assert_eq!((both.netlist.cells().count(), both.latches.len()), (2, 1), "{}", both.netlist);
        let mut alone = latch();
        let shown = alone.outputs()[1];
        alone.remove(shown);
        let one = held(&alone);
        assert_eq!(one.netlist.cells().count(), 1, "{}", one.netlist);
        let (_, cell) = one.netlist.cells().next().unwrap();
        assert_eq!((cell.function, cell.start, cell.name.as_deref()), (Function::MUX, Some(false), Some("q")));
    }

    #[test]
    fn a_library_whose_multiplexer_glitches_makes_none() {
        let mut glitching = multiplexer_library();
        glitching.insert(Function::MUX, CellKind { glitches: true, ..CellKind::uniform(1, 1.0) });
        let mapped = map(&latch(), &multiplexer_library()).unwrap();
        assert!(Held::of(&mapped, &glitching).is_none());
    }

    /// A flip-flop of two cells takes its data at a rise of the clock for any delays.
    #[test]
    fn a_flip_flop_is_two_cells_and_works_for_all_delays() {
        let mut source = Netlist::new("register");
        let [data, clock] = ["d", "clk"].map(|name| source.add_input(name));
        let q = registers::flip_flop(&mut source, "q", data, clock, false);
        source.add_output("q", q);
        dissolve_wires(&mut source).unwrap();
        let Held { netlist, latches, .. } = held(&source);
        assert_eq!((netlist.cells().count(), latches.len()), (2, 2), "{netlist}");
        let timing = Timing::of(&netlist, &multiplexer_library(), Delays::Clock);
        assert_eq!((timing.storage.flip_flops.len(), timing.storage.unphased.len()), (1, 0));
        let mut random = ChaCha8Rng::seed_from_u64(1);
        let mut draw = |bound: u32| (rand::Rng::next_u32(&mut random) % bound) as usize;
        for _ in 0..100 {
            let mut delayed = Delayed::new(&netlist, |_| 1 + draw(3));
            let (mut data, mut clock, mut q) = (false, false, false);
            delayed.run(&[data, clock], 20);
            for _ in 0..40 {
                let before = clock;
                if draw(2) == 0 {
                    data = !data
                } else {
                    clock = !clock
                }
                q = if clock && !before { data } else { q };
                assert_eq!(delayed.run(&[data, clock], 20), [q]);
            }
        }
    }
}
