//! A latch: one net closes it, whatever its other inputs do, and it then keeps its state.

use std::collections::BTreeMap;

use crate::cells::CellKind;
use crate::known::TernaryBit;
use crate::storage::cone::{Cone, Inverters, Values, constant};
use crate::{NetId, Netlist};

/// The most inputs of a latch whose values are all tried.
const MOST_DATA: usize = 6;

#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Latch {
    pub cells: Vec<NetId>,
    pub guards: Vec<NetId>,
    pub enable: NetId,
    /// The net of which the enable is a copy or the opposite.
    pub root: NetId,
    /// The inverters and buffers between the root and the enable; the last of them drives the enable.
    pub chain: Vec<NetId>,
    /// The value of the root for which the latch is open.
    pub open: bool,
    pub data: Vec<NetId>,
    /// How many cells one after the other a change passes in `cells` until the bit is stored.
    pub rounds: usize,
}

impl Latch {
    /// The cycles by which data change too early if the latch closes after `closed`; `earliest` has first changes.
    pub fn needed<'k>(
        &self,
        netlist: &Netlist,
        kind: &impl Fn(NetId) -> &'k CellKind,
        closed: u32,
        earliest: &[Option<u32>],
    ) -> Option<u32> {
        let clocks = |cells: &[NetId]| cells.iter().map(|&id| kind(id).clock).sum::<u32>();
        let missing = |&cell: &NetId| {
            let pins = netlist.pins(cell);
            let is_guarded = pins.contains(&self.enable);
            let stable = if is_guarded { closed } else { closed + clocks(&self.guards) };
            let changes = pins.into_iter().filter(|pin| self.data.contains(pin));
            changes.filter_map(|pin| stable.checked_sub(earliest[pin.index()]?)).filter(|&missing| missing > 0).max()
        };
        self.guards.iter().chain(&self.cells).filter_map(missing).max()
    }
}

#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Follower {
    /// The one net that its data are copies or opposites of.
    pub data: NetId,
    /// Its cells, each with whether it shows the opposite of that net.
    pub cells: Vec<(NetId, bool)>,
}

impl Follower {
    /// A latch of one bit of data; `None` if it has more, or a cell that shows neither it nor its opposite.
    pub fn of(netlist: &Netlist, inverters: &Inverters, latch: &Latch) -> Option<Self> {
        let cone = Cone::new(netlist, &latch.cells);
        let closed = latch.open == inverters.root(latch.enable).1;
        let trial = Trial { cone: &cone, enable: latch.enable, closed, guards: &latch.guards };
        // Data that are constant are taken for a net, unless there are others.
        let mut roots: Vec<NetId> = latch.data.iter().map(|&net| inverters.root(net).0).collect();
        roots.sort_by_key(|&root| constant(netlist, root).is_some());
        let root = *roots.first()?;
        let shown = |value: bool| {
            let of_root = |net: &NetId| {
                let (own, inverted) = inverters.root(*net);
                let value = if own == root { Some(value) } else { constant(netlist, own) };
                Some((*net, Some(value? != inverted)))
            };
            trial.opened(&latch.data.iter().map(of_root).collect::<Option<Values>>()?)
        };
        let [(low, _), (high, _)] = [shown(false)?, shown(true)?];
        let cell = |&id: &NetId| match (low[&id], high[&id]) {
            (Some(low), Some(high)) if low != high => Some((id, low)),
            _ => None,
        };
        Some(Self { data: root, cells: latch.cells.iter().map(cell).collect::<Option<_>>()? })
    }
}

#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Unphased {
    pub nets: Vec<NetId>,
    pub why: WhyUnphased,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum WhyUnphased {
    NoEnable,
    Race,
    Glitch(NetId),
    ManyInputs,
    ManyEnables,
    StaysOpen,
}

/// `known` is the net that closes it, and at which value, of a latch that lowering has made.
pub(super) fn latch<'k>(
    netlist: &Netlist,
    inverters: &Inverters,
    element: &[NetId],
    known: Option<(NetId, bool)>,
    kind: &impl Fn(NetId) -> &'k CellKind,
) -> Result<Latch, WhyUnphased> {
    let cone = Cone::new(netlist, element);
    let (enable, closed) = known.or_else(|| closing(&cone)).ok_or(WhyUnphased::NoEnable)?;
    let guards = cone.guards(enable);
    if let Some(&cell) = element.iter().chain(&guards).find(|&&id| kind(id).glitches) {
        return Err(WhyUnphased::Glitch(cell));
    }
    let mut data: Vec<NetId> = guards.iter().chain(element).flat_map(|&id| netlist.pins(id)).collect();
    data.sort_unstable();
    data.dedup();
    data.retain(|net| *net != enable && !guards.contains(net) && !element.contains(net));
    let trial = Trial { cone: &cone, enable, closed, guards: &guards };
    let varying: Vec<NetId> = data.iter().copied().filter(|&net| constant(netlist, net).is_none()).collect();
    let rounds = trial.run(inverters, &varying)?;
    let mut chain: Vec<NetId> = inverters.steps(enable).map(|(net, _)| net).collect();
    chain.pop();
    chain.reverse();
    let (root, inverted) = inverters.root(enable);
    Ok(Latch { cells: element.to_vec(), guards, enable, root, chain, open: closed == inverted, data, rounds })
}

/// The nearest net of which one value determines all nets that enter the element, but not its state, and that value.
fn closing(cone: &Cone) -> Option<(NetId, bool)> {
    let closes = |net: NetId, value: bool| {
        let values = BTreeMap::from([(net, Some(value))]);
        let implied = cone.implied(&values);
        let is_known = |entering: &NetId| cone.value(&implied, *entering).is_some();
        cone.entering.iter().all(is_known) && cone.stored(&values).is_none()
    };
    let candidates = cone.near().filter(|net| !cone.entering.contains(net));
    let both = candidates.flat_map(|net| [(net, false), (net, true)]);
    both.into_iter().find(|&(net, value)| closes(net, value) && !closes(net, !value)).or_else(|| holding(cone))
}

/// The input and its value at which a cell of three inputs keeps its output.
fn holding(cone: &Cone) -> Option<(NetId, bool)> {
    let &[cell] = cone.element else { return None };
    let holds = |net: NetId, value: bool| {
        let kept = |state: bool| cone.answer(&BTreeMap::from([(net, Some(value)), (cell, Some(state))]), cell);
        [false, true].iter().all(|&state| kept(state) == Some(state))
    };
    let both = cone.entering.iter().flat_map(|&net| [(net, false), (net, true)]);
    let mut both = both.filter(|_| cone.entering.len() == 2);
    both.find(|&(net, value)| holds(net, value) && !holds(net, !value))
}

struct Trial<'a> {
    cone: &'a Cone<'a>,
    enable: NetId,
    closed: bool,
    guards: &'a [NetId],
}

impl Trial<'_> {
    /// Opens and closes the element with each of its data, and returns the longest time to settle, in cells.
    fn run(&self, inverters: &Inverters, data: &[NetId]) -> Result<usize, WhyUnphased> {
        let mut roots: Vec<NetId> = data.iter().map(|&net| inverters.root(net).0).collect();
        roots.sort_unstable();
        roots.dedup();
        if roots.len() > MOST_DATA {
            return Err(WhyUnphased::ManyInputs);
        }
        let mut rounds = None;
        for pattern in 0..1 << roots.len() {
            let value = |net: NetId| {
                let (root, inverted) = inverters.root(net);
                let bit = roots.binary_search(&root).expect("all roots are listed");
                Some((pattern >> bit & 1 == 1) != inverted)
            };
            let data: Values = data.iter().map(|&net| (net, value(net))).collect();
            if let Some((stored, taken)) = self.opened(&data) {
                rounds = rounds.max(Some(taken));
                if !self.keeps(&stored, &data) {
                    return Err(WhyUnphased::Race);
                }
            }
        }
        rounds.ok_or(WhyUnphased::NoEnable)
    }

    /// The values, and the rounds after which its cells have them; `None` if it keeps its state with these data.
    fn opened(&self, data: &Values) -> Option<(Values, usize)> {
        let mut values = data.clone();
        values.insert(self.enable, Some(!self.closed));
        self.cone.stored(&values)
    }

    /// Whether the element keeps its state for any delays when it closes: every cell that may change is unknown, and
    /// then each takes the value that is determined (Eichelberger 1965).
    fn keeps(&self, stored: &Values, data: &Values) -> bool {
        let mut values = stored.clone();
        values.extend(data);
        values.insert(self.enable, Some(self.closed));
        self.settle(&mut values, |old, new| if old == new { new } else { None });
        self.settle(&mut values, |_, new| new);
        self.cone.element.iter().all(|id| values[id] == stored[id])
    }

    fn settle(&self, values: &mut Values, merge: impl Fn(TernaryBit, TernaryBit) -> TernaryBit) {
        let mut changed = true;
        while changed {
            changed = false;
            for &id in self.guards.iter().chain(self.cone.element) {
                let old = values[&id];
                let new = merge(old, self.cone.answer(values, id));
                changed |= old != new;
                values.insert(id, new);
            }
        }
    }
}
