//! Registers made of cells, in forms that are safe for every delay of one to three cycles if the inverter of a clock is
//! no slower than two other cells (docs/timing.md, "Registers as cells").

use std::collections::BTreeMap;

use crate::formats::{Design, Forcing, Register, RegisterKind};
use crate::{Cell, NetId, Netlist, Node};
use nbc_base::model::Function;

/// A clock that is not an input of the design becomes an additional input.
pub fn expand(design: &Design) -> Netlist {
    let mut netlist = Netlist::new(&design.logic.name);
    let logic = &design.logic;
    let mut net: BTreeMap<NetId, NetId> = BTreeMap::new();
    let (ports, states) = logic.inputs().split_at(design.inputs());
    let (outputs, nexts) = logic.outputs().split_at(design.outputs());
    for &id in ports {
        net.insert(id, netlist.add_input(logic.net_name(id)));
    }
    for (&id, register) in states.iter().zip(&design.registers) {
        net.insert(id, netlist.add_wire(&register.name, Some(register.starts_at()), None));
    }
    copy(logic, &mut netlist, &mut net);
    let mut clocks = Clocks { by_name: BTreeMap::new() };
    for id in logic.ids() {
        if !matches!(logic.node(id), Node::Output(_) | Node::Constant(_)) {
            clocks.by_name.entry(logic.net_name(id)).or_insert(net[&id]);
        }
    }
    for (((&state, &next), register), forcing) in
        states.iter().zip(nexts).zip(&design.registers).zip(design.forcing_nets())
    {
        let clock = clocks.net(&mut netlist, register);
        let data = net[&logic.pins(next)[0]];
        let start = register.starts_at();
        let name = &register.name;
        let is_latch = matches!(register.kind, RegisterKind::High | RegisterKind::Low);
        let q = match register.forcing {
            Forcing::Never if is_latch => latch(&mut netlist, name, data, clock, start),
            Forcing::Never => flip_flop(&mut netlist, name, data, clock, start),
            _ => {
                let nets: Vec<NetId> = forcing.iter().map(|pin| net[pin]).collect();
                Forced::new(&mut netlist, register.forcing, &nets, start).register(name, data, clock, is_latch)
            }
        };
        netlist.drive(net[&state], 0, q);
    }
    for &id in outputs {
        netlist.add_output(logic.net_name(id), net[&logic.pins(id)[0]]);
    }
    netlist
}

fn copy(logic: &Netlist, netlist: &mut Netlist, net: &mut BTreeMap<NetId, NetId>) {
    let loops = crate::Loops::of(logic);
    let mut made = Vec::new();
    for &id in loops.order() {
        let copy = match logic.node(id) {
            Node::Constant(value) => netlist.add_constant(*value),
            Node::Cell(cell) => netlist.add_loose_cell(cell.clone()),
            Node::Wire { name, start, span } => netlist.add_wire(name, *start, *span),
            Node::Input(_) | Node::Output(_) => continue,
        };
        net.insert(id, copy);
        made.push((id, copy));
    }
    for (id, copy) in made {
        for (pin, driver) in (0..).zip(logic.pins(id)) {
            netlist.connect(copy, pin, net[&driver]);
        }
    }
}

struct Clocks {
    by_name: BTreeMap<String, NetId>,
}

impl Clocks {
    fn net(&mut self, netlist: &mut Netlist, register: &Register) -> NetId {
        let name = register.clock_name();
        let clock = *self.by_name.entry(name.to_owned()).or_insert_with(|| netlist.add_input(name));
        match register.kind {
            RegisterKind::Rising | RegisterKind::High => clock,
            RegisterKind::Falling | RegisterKind::Low => netlist.add_gate(Function::NOT, &[clock]),
        }
    }
}

/// Four NAND cells. The reset branch reads the set branch, so no inverter races it.
pub fn latch(netlist: &mut Netlist, name: &str, data: NetId, enable: NetId, start: bool) -> NetId {
    let set = netlist.add_gate(Function::NAND, &[data, enable]);
    let reset = netlist.add_gate(Function::NAND, &[set, enable]);
    pair(netlist, name, set, reset, start)
}

/// Two cross-coupled NAND cells; returns the one that `set` pulls up.
fn pair(netlist: &mut Netlist, name: &str, set: NetId, reset: NetId, start: bool) -> NetId {
    let q = core_cell(netlist, name.to_owned(), start, [set, set]);
    let nq = core_cell(netlist, format!("{name}.n"), !start, [reset, q]);
    netlist.drive(q, 1, nq);
    q
}

fn core_cell(netlist: &mut Netlist, name: String, start: bool, pins: [NetId; 2]) -> NetId {
    netlist.add_cell(Cell { function: Function::NAND, name: Some(name), start: Some(start), span: None }, &pins)
}

/// Two latches: the first is open while the clock is 0, the second while it is 1.
pub fn flip_flop(netlist: &mut Netlist, name: &str, data: NetId, clock: NetId, start: bool) -> NetId {
    let low = netlist.add_gate(Function::NOT, &[clock]);
    let held = latch(netlist, &format!("{name}.held"), data, low, start);
    latch(netlist, name, held, clock, start)
}

/// Latches that change without their clock. A third cell of the loop, and a fourth if there are a set and a reset,
/// force it: they do not reach the guards, so a latch closes as one without them does.
struct Forced<'n> {
    netlist: &'n mut Netlist,
    /// The net that sets the latch, and one that is 0 where it sets a latch that is not reset.
    set: Option<[NetId; 2]>,
    reset: [NetId; 2],
    /// Whether the loop holds the opposite of the value that it shows: a reset makes the loop 0.
    is_inverted: bool,
    start: bool,
}

impl<'n> Forced<'n> {
    fn new(netlist: &'n mut Netlist, forcing: Forcing, nets: &[NetId], start: bool) -> Self {
        let (&reset, sets) = nets.split_last().expect("a forced register has a reset");
        let go = netlist.add_gate(Function::NOT, &[reset]);
        let set = sets.first().map(|&set| [set, netlist.add_gate(Function::NAND, &[set, go])]);
        Self { netlist, set, reset: [reset, go], is_inverted: forcing == Forcing::ToStart && start, start }
    }

    fn register(mut self, name: &str, data: NetId, clock: NetId, is_latch: bool) -> NetId {
        let data = self.data(data);
        let shown = usize::from(self.is_inverted);
        if is_latch {
            return self.latch(name, data, clock)[shown];
        }
        let low = self.netlist.add_gate(Function::NOT, &[clock]);
        let [held, _] = self.latch(&format!("{name}.held"), data, low);
        self.latch(name, held, clock)[shown]
    }

    fn data(&mut self, data: NetId) -> NetId {
        let [reset, go] = self.reset;
        if self.is_inverted {
            return self.netlist.add_gate(Function::NOR, &[data, reset]);
        }
        let data = match self.set {
            Some([set, _]) => self.netlist.add_gate(Function::OR, &[data, set]),
            None => data,
        };
        self.netlist.add_gate(Function::AND, &[data, go])
    }

    /// A latch that is transparent while `enable` is 1; returns the net that follows `data`, and its opposite.
    fn latch(&mut self, name: &str, data: NetId, enable: NetId) -> [NetId; 2] {
        let start = self.start != self.is_inverted;
        let opposite = format!("{name}.n");
        let names = if self.is_inverted { [opposite, name.to_owned()] } else { [name.to_owned(), opposite] };
        let [own, other] = names;
        let set = self.netlist.add_gate(Function::NAND, &[data, enable]);
        let clear = self.netlist.add_gate(Function::NAND, &[set, enable]);
        let q = core_cell(self.netlist, own, start, [set, set]);
        let kept = self.passed(format!("{name}.kept"), start, [q, self.reset[1]]);
        let nq = core_cell(self.netlist, other, !start, [clear, kept]);
        let back = match self.set {
            Some([_, stay]) => self.passed(format!("{name}.down"), !start, [nq, stay]),
            None => nq,
        };
        self.netlist.drive(q, 1, back);
        [q, nq]
    }

    fn passed(&mut self, name: String, start: bool, pins: [NetId; 2]) -> NetId {
        self.netlist.add_cell(Cell { function: Function::AND, name: Some(name), start: Some(start), span: None }, &pins)
    }
}

#[cfg(test)]
mod tests {
    use rand::SeedableRng;

    use super::*;
    use crate::Delayed;
    use crate::passes::{dissolve_wires, sweep};

    /// Random rows of (data, clock) with random delays of 1 to 3 cycles; `model` gives the expected q.
    fn check(
        build: impl Fn(&mut Netlist, NetId, NetId) -> NetId,
        cells: usize,
        mut model: impl FnMut(bool, bool, bool, bool) -> bool,
    ) {
        let mut random = rand_chacha::ChaCha8Rng::seed_from_u64(1);
        for _ in 0..100 {
            let mut netlist = Netlist::new("register");
            let data = netlist.add_input("d");
            let clock = netlist.add_input("clk");
            let q = build(&mut netlist, data, clock);
            netlist.add_output("q", q);
            dissolve_wires(&mut netlist).unwrap();
            sweep(&mut netlist);
            assert_eq!(netlist.cells().count(), cells);
            let mut draw = |bound: u32| (rand::Rng::next_u32(&mut random) % bound) as usize;
            let mut delayed = Delayed::new(&netlist, |_| 1 + draw(3));
            let (mut data, mut clock) = (false, false);
            delayed.run(&[data, clock], 40);
            // Any start value is valid after settling; a first full row sets it.
            delayed.run(&[data, true], 40);
            let mut q = delayed.run(&[data, clock], 40)[0];
            for _ in 0..30 {
                let before = clock;
                // One input changes at a time, as set-up and hold times require.
                if draw(2) == 0 {
                    data = !data
                } else {
                    clock = !clock
                }
                q = model(q, data, before, clock);
                assert_eq!(delayed.run(&[data, clock], 40), [q]);
            }
        }
    }

    #[test]
    fn the_latch_works_for_all_delays() {
        check(|netlist, d, e| latch(netlist, "q", d, e, false), 4, |q, data, _, enable| if enable { data } else { q });
    }

    #[test]
    fn the_flip_flop_works_for_all_delays() {
        let model = |q: bool, data: bool, before: bool, clock: bool| if clock && !before { data } else { q };
        check(|netlist, d, clk| flip_flop(netlist, "q", d, clk, false), 9, model);
    }

    fn check_forced(forcing: Forcing, kind: RegisterKind, start: bool, cells: usize) {
        let mut logic = Netlist::new("forced");
        let [data, _] = ["d", "clk"].map(|name| logic.add_input(name));
        let nets: Vec<NetId> = forcing.nets().iter().map(|&name| logic.add_input(name)).collect();
        let q = logic.add_input("q");
        logic.add_output("out", q);
        [data].iter().chain(&nets).for_each(|&net| _ = logic.add_output("next", net));
        let clock = Some("clk".to_owned());
        let register = Register { name: "q".to_owned(), kind, clock, start: Some(start), forcing };
        let mut netlist = expand(&Design::new(logic, vec![register]));
        dissolve_wires(&mut netlist).unwrap();
        crate::passes::share(&mut netlist);
        sweep(&mut netlist);
        assert_eq!(netlist.cells().count(), cells, "{forcing:?} {kind:?} {start}");
        let mut random = rand_chacha::ChaCha8Rng::seed_from_u64(2);
        for _ in 0..100 {
            let mut draw = |bound: u32| (rand::Rng::next_u32(&mut random) % bound) as usize;
            let mut delayed = Delayed::new(&netlist, |_| 1 + draw(3));
            let mut inputs = vec![false; netlist.inputs().len()];
            // The reset makes it known.
            *inputs.last_mut().unwrap() = true;
            let reset_value = forcing == Forcing::ToStart && start;
            let mut q = reset_value;
            assert_eq!(delayed.run(&inputs, 40), [q]);
            for _ in 0..60 {
                let at = draw(inputs.len() as u32);
                let rises = at == 1 && !inputs[1];
                inputs[at] = !inputs[at];
                if (kind == RegisterKind::Rising && rises) || (kind == RegisterKind::High && inputs[1]) {
                    q = inputs[0];
                }
                match inputs[2..] {
                    [_, true] | [true] => q = reset_value,
                    [true, false] => q = true,
                    _ => {}
                }
                assert_eq!(delayed.run(&inputs, 40), [q], "{forcing:?} {kind:?} {start} {inputs:?}");
            }
        }
    }

    #[test]
    fn forced_registers_work_for_all_delays() {
        for start in [false, true] {
            check_forced(Forcing::ToStart, RegisterKind::High, start, 7);
            check_forced(Forcing::ToStart, RegisterKind::Rising, start, 13);
            check_forced(Forcing::SetReset, RegisterKind::High, start, 10);
            check_forced(Forcing::SetReset, RegisterKind::Rising, start, 17);
        }
    }
}
