//! When changes arrive, along the updates of a phase.

use crate::cells::CellKind;
use crate::timing::phase::Phase;
use crate::timing::update::NetUpdate;
use crate::{NetId, Netlist, Node};

#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Delays {
    /// The robot's clock, for any transition. The resulting hold is safe; `hold: auto` never exceeds it.
    #[default]
    Clock,
    Transition,
}

/// An event: an update falls (0) or rises (1).
pub(super) type Event = (usize, usize);

pub(super) struct Delay<'a, F> {
    pub netlist: &'a Netlist,
    pub delays: Delays,
    pub kind: &'a F,
}

impl<'k, F: Fn(NetId) -> &'k CellKind> Delay<'_, F> {
    /// Cycles from a change of a pin to `value` until a net stays at `output`; none if that cannot follow.
    fn cycles(&self, net: NetId, pin: u8, value: usize, output: usize) -> Option<u32> {
        let Some(cell) = self.netlist.cell(net) else { return (value == output).then_some(0) };
        let kind = (self.kind)(net);
        match self.delays {
            Delays::Clock => Some(kind.clock),
            Delays::Transition => kind.settle_time(cell.function, usize::from(pin), value == 1, output == 1),
        }
    }

    /// When an update that nothing drives changes: inputs and constants at once, a cell of a loop after its clock.
    pub fn launch(&self, phase: &Phase, update: &NetUpdate) -> Option<u32> {
        let net = phase.net(update);
        match self.netlist.node(net) {
            Node::Input(_) | Node::Constant(_) => Some(0),
            Node::Cell(_) if update.pins.is_empty() && !phase.is_silent(update) && phase.is_real(update) => {
                Some((self.kind)(net).clock)
            }
            _ => None,
        }
    }
}

pub(super) struct Arrivals {
    /// The latest fall and rise of each update; `None` if it does not change.
    pub times: Vec<[Option<u32>; 2]>,
    before: Vec<[Option<Event>; 2]>,
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
            let mut times = [start(update); 2];
            let mut causes = [None; 2];
            // What a closed latch may still change is in its start.
            let pins = if phase.is_silent(update) { &[][..] } else { &update.pins };
            for &(pin, driver) in pins {
                for (value, output) in [(0, 0), (0, 1), (1, 0), (1, 1)] {
                    let Some(launched) = arrivals.times[driver][value] else { continue };
                    let Some(cycles) = delay.cycles(phase.net(update), pin, value, output) else { continue };
                    let time = Some(launched + cycles);
                    if time > times[output] || causes[output].is_none() && time == times[output] {
                        times[output] = time;
                        causes[output] = Some((driver, value));
                    }
                }
            }
            arrivals.times.push(times);
            arrivals.before.push(causes);
        }
        arrivals
    }

    pub fn latest(&self, update: usize) -> Option<u32> {
        self.times[update][0].max(self.times[update][1])
    }

    /// The latest event of all, the earliest update of several.
    pub fn last(&self, counts: impl Fn(usize) -> bool) -> Option<(u32, Event)> {
        let events =
            (0..self.times.len()).filter(|&update| counts(update)).flat_map(|update| [(update, 0), (update, 1)]);
        let timed = events.filter_map(|event: Event| Some((self.times[event.0][event.1]?, event)));
        timed.max_by_key(|&(time, event)| (time, std::cmp::Reverse(event)))
    }

    /// The slack of each update, if all must have changed after `hold` cycles.
    pub fn slack<'k>(&self, delay: &Delay<'_, impl Fn(NetId) -> &'k CellKind>, phase: &Phase, hold: u32) -> Vec<u32> {
        let mut required = vec![[hold; 2]; phase.updates.len()];
        for (i, update) in phase.updates.iter().enumerate().rev() {
            for &(pin, driver) in &update.pins {
                for (value, output) in [(0, 0), (0, 1), (1, 0), (1, 1)] {
                    if let Some(cycles) = delay.cycles(phase.net(update), pin, value, output) {
                        let before = required[i][output].saturating_sub(cycles);
                        required[driver][value] = required[driver][value].min(before);
                    }
                }
            }
        }
        let slack = |(required, times): (&[u32; 2], &[Option<u32>; 2])| {
            let slack = |value: usize| required[value].saturating_sub(times[value].unwrap_or(0));
            slack(0).min(slack(1))
        };
        required.iter().zip(&self.times).map(slack).collect()
    }

    pub fn path(&self, phase: &Phase, event: Event) -> Vec<NetId> {
        let steps = std::iter::successors(Some(event), |&(update, value)| self.before[update][value]);
        let mut nets: Vec<_> = steps.map(|(update, _)| phase.net(&phase.updates[update])).collect();
        nets.reverse();
        nets
    }
}
