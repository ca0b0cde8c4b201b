//! When changes arrive, along the updates of a phase.

use crate::cells::CellKind;
use crate::timing::phase::Phase;
use crate::timing::update::NetUpdate;
use crate::{NetId, Netlist, Node};

pub(super) struct Delay<'a, F> {
    pub netlist: &'a Netlist,
    pub kind: &'a F,
}

impl<'k, F: Fn(NetId) -> &'k CellKind> Delay<'_, F> {
    /// Cycles from a change of a pin until a net is right, for any transition.
    fn cycles(&self, net: NetId) -> u32 {
        self.netlist.cell(net).map_or(0, |_| (self.kind)(net).clock)
    }

    /// When an update that nothing drives changes: inputs and constants at once, a cell of a loop after its clock.
    pub fn launch(&self, phase: &Phase, update: &NetUpdate) -> Option<u32> {
        let net = phase.net(update);
        match self.netlist.node(net) {
            Node::Input(_) | Node::Constant(_) => Some(0),
            Node::Cell(_) if update.drivers.is_empty() && !phase.is_silent(update) && phase.is_real(update) => {
                Some(self.cycles(net))
            }
            _ => None,
        }
    }
}

pub(super) struct Arrivals {
    /// The latest change of each update; `None` if it does not change.
    pub times: Vec<Option<u32>>,
    before: Vec<Option<usize>>,
}

impl Arrivals {
    /// The changes after those of the updates for which `start` gives a time.
    pub fn from<'k>(
        delay: &Delay<'_, impl Fn(NetId) -> &'k CellKind>,
        phase: &Phase,
        start: impl Fn(&NetUpdate) -> Option<u32>,
    ) -> Self {
        let mut arrivals = Self { times: Vec::with_capacity(phase.updates.len()), before: Vec::new() };
        for update in &phase.updates {
            let (mut latest, mut cause) = (start(update), None);
            let cycles = delay.cycles(phase.net(update));
            // What a closed latch may still change is in its start.
            let drivers = if phase.is_silent(update) { &[][..] } else { &update.drivers };
            for &driver in drivers {
                let time = arrivals.times[driver].map(|launched| launched + cycles);
                if time > latest || cause.is_none() && time.is_some() && time == latest {
                    (latest, cause) = (time, Some(driver));
                }
            }
            arrivals.times.push(latest);
            arrivals.before.push(cause);
        }
        arrivals
    }

    /// The latest change of all, of the earliest update of several.
    pub fn last(&self, counts: impl Fn(usize) -> bool) -> Option<(u32, usize)> {
        let timed = (0..self.times.len()).filter(|&update| counts(update));
        let timed = timed.filter_map(|update| Some((self.times[update]?, update)));
        timed.max_by_key(|&(time, update)| (time, std::cmp::Reverse(update)))
    }

    /// The slack of each update, if all must have changed after `hold` cycles.
    pub fn slack<'k>(&self, delay: &Delay<'_, impl Fn(NetId) -> &'k CellKind>, phase: &Phase, hold: u32) -> Vec<u32> {
        let mut required = vec![hold; phase.updates.len()];
        for (i, update) in phase.updates.iter().enumerate().rev() {
            let before = required[i].saturating_sub(delay.cycles(phase.net(update)));
            update.drivers.iter().for_each(|&driver| required[driver] = required[driver].min(before));
        }
        let slack = |(required, time): (&u32, &Option<u32>)| required.saturating_sub(time.unwrap_or(0));
        required.iter().zip(&self.times).map(slack).collect()
    }

    pub fn path(&self, phase: &Phase, update: usize) -> Vec<NetId> {
        let steps = std::iter::successors(Some(update), |&update| self.before[update]);
        let mut nets: Vec<_> = steps.map(|update| phase.net(&phase.updates[update])).collect();
        nets.reverse();
        nets
    }
}
