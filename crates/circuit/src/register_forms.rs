//! Proof that registers of another form store the same: latches of one cell, and registers as cells.
//!
//! The latches of a netlist are recognized by what their cells do and taken out of it. What is left is a design: logic,
//! and for each latch when it is open, its data and its start. Two netlists are equal in every step from their start if
//! their designs are (`proof/relation.rs`). What races is for timing to say.

use std::collections::{BTreeMap, BTreeSet};

use crate::cells::CellKind;
use crate::formats::{Design, Forcing, Register, RegisterKind};
use crate::network::View;
use crate::passes::{dissolve_wires, sweep};
use crate::proof::{self, Counterpart};
use crate::storage::{Follower, Inverters};
use crate::{Latch, Logic, NetId, Netlist, Node, Proof, ProofError, Storage};
use nbc_base::model::Function;

/// The cells of memory do not glitch: whether those of robots do is for timing to say.
const KIND: CellKind = CellKind::uniform(1, 1.0);

/// `None` if latches of one of the two are not recognized, such as some whose data depend on what opens them.
pub fn prove_forms(before: &Netlist, after: &Netlist) -> Option<Result<Proof, ProofError>> {
    let made = Bits::of(after).taken(|_| Some(false));
    let names: BTreeSet<&str> = made.registers.iter().map(|one| one.name.as_str()).collect();
    prove(&Bits::of(before).taken(|name| names.contains(name).then_some(false)), &made)
}

/// `None` if a register is set or reset without its clock, the logic has feedback, or latches are not recognized.
pub fn prove_expanded(design: &Design, netlist: &Netlist) -> Option<Result<Proof, ProofError>> {
    let is_forced = design.registers.iter().any(|register| register.forcing != Forcing::Never);
    if is_forced || View::of(&design.logic, &[]).is_err() {
        return None;
    }
    let mut read = design.clone();
    for register in &mut read.registers {
        (register.clock, register.start) = (Some(register.clock_name().to_owned()), Some(register.starts_at()));
    }
    let edges: BTreeMap<&str, bool> = read.registers.iter().map(|one| (one.name.as_str(), is_edge(one))).collect();
    let mut plain = netlist.clone();
    if let Err(error) = dissolve_wires(&mut plain) {
        return Some(Err(error.into()));
    }
    let mut made = Bits::of(&plain).taken(|name| edges.get(name).copied());
    let clocks = made.logic.inputs()[design.inputs()..made.inputs()].iter().copied();
    let unread: Vec<NetId> = clocks.filter(|&clock| made.logic.fanout(clock).is_empty()).collect();
    unread.into_iter().for_each(|clock| made.logic.remove(clock));
    prove(&read, &made)
}

/// Registers of the same name correspond. `None` if one has loops or registers that the other does not have.
fn prove(read: &Design, made: &Design) -> Option<Result<Proof, ProofError>> {
    let (read, made) = (&while_taken(read), &while_taken(made));
    let numbers = made.registers.iter().enumerate().map(|(at, register)| (register.name.as_str(), at));
    let places: BTreeMap<&str, usize> = numbers.collect();
    let counterpart =
        |register: &Register| places.get(&*register.name).map_or(Counterpart::Unused, |&at| Counterpart::Same(at));
    let proof = proof::prove_design(read, made, read.registers.iter().map(counterpart).collect());
    let is_open = matches!(proof, Err(ProofError::Port(_) | ProofError::NewLoop(_)));
    (!is_open).then_some(proof)
}

/// The data of each register while it takes them; at other values of its clock nobody sees how they differ.
fn while_taken(design: &Design) -> Design {
    let mut logic = design.logic.clone();
    let states = logic.inputs()[design.inputs()..].to_vec();
    for (number, (register, state)) in design.registers.iter().zip(states).enumerate() {
        let is_clock = |&&net: &&NetId| logic.net_name(net) == register.clock_name();
        let input = logic.inputs().iter().find(is_clock).copied();
        let Some(clock) = input.or_else(|| Some(logic.pins(*logic.outputs().iter().find(is_clock)?)[0])) else {
            continue;
        };
        let output = logic.outputs()[design.outputs() + number];
        let data = logic.pins(output)[0];
        let [high, low] = match register.kind {
            RegisterKind::High | RegisterKind::Falling => [data, state],
            RegisterKind::Low | RegisterKind::Rising => [state, data],
        };
        let taken = logic.add_gate(Function::MUX, &[clock, high, low]);
        logic.drive(output, 0, taken);
    }
    Design::new(logic, design.registers.clone())
}

fn is_edge(register: &Register) -> bool {
    matches!(register.kind, RegisterKind::Rising | RegisterKind::Falling)
}

struct Bit {
    latch: Latch,
    follower: Follower,
}

struct Bits<'n> {
    netlist: &'n Netlist,
    start: Logic,
    bits: Vec<Bit>,
}

struct Element<'b> {
    bit: &'b Bit,
    /// The cell that shows what it stores, and whether that is the opposite of what the follower says.
    shown: (NetId, bool),
    /// What it stores, and whether that is the opposite of the net.
    data: (NetId, bool),
    root: NetId,
    kind: RegisterKind,
}

impl<'n> Bits<'n> {
    fn of(netlist: &'n Netlist) -> Self {
        let storage = Storage::of(netlist, |_| &KIND);
        let inverters = Inverters::of(netlist);
        let bit = |latch: Latch| Some(Bit { follower: Follower::of(netlist, &inverters, &latch)?, latch });
        Self { netlist, start: Logic::new(netlist), bits: storage.latches.into_iter().filter_map(bit).collect() }
    }

    /// `wanted` says of a cell whether its latch is the second of a flip-flop; registers have the names of these cells.
    fn taken(&self, wanted: impl Fn(&str) -> Option<bool>) -> Design {
        let mut named = BTreeMap::new();
        for bit in &self.bits {
            let of_cell = |&shown: &(NetId, bool)| {
                let name = self.netlist.net_name(shown.0);
                Some((self.element(bit, shown, wanted(&name)?)?, name))
            };
            if let Some((element, name)) = bit.follower.cells.iter().find_map(of_cell) {
                named.insert(name, element);
            }
        }
        self.without(&named)
    }

    fn element<'b>(&'b self, bit: &'b Bit, shown: (NetId, bool), is_edge: bool) -> Option<Element<'b>> {
        let Bit { latch, follower } = bit;
        let edge = |rises: bool| if rises { RegisterKind::Rising } else { RegisterKind::Falling };
        let element = |data, root, kind| Some(Element { bit, shown, data, root, kind });
        let (data, root) = ((follower.data, shown.1), latch.root);
        if !is_edge {
            return element(data, root, if latch.open { RegisterKind::High } else { RegisterKind::Low });
        }
        let is_first = |other: &&Bit| other.latch.root == root && other.latch.open != latch.open;
        self.bits.iter().filter(is_first).find_map(|first| {
            let &(held, inverted) = first.follower.cells.iter().find(|(cell, _)| *cell == follower.data)?;
            // The first latch may be seen before the first edge.
            let starts_alike = self.start.value(held) == (self.start.value(shown.0) != shown.1);
            starts_alike.then_some(())?;
            element((first.follower.data, shown.1 != inverted), root, edge(latch.open))
        })
    }

    fn without(&self, elements: &BTreeMap<String, Element<'_>>) -> Design {
        let mut logic = self.netlist.clone();
        // What each cell that shows a bit becomes: the bit, or its opposite.
        let mut bits: BTreeMap<NetId, (&str, bool)> = BTreeMap::new();
        let mut now: BTreeMap<NetId, NetId> = BTreeMap::new();
        for (name, element) in elements {
            let state = logic.add_input(name);
            for &(cell, inverted) in &element.bit.follower.cells {
                let is_opposite = inverted != element.shown.1;
                let net = if is_opposite { logic.add_gate(Function::NOT, &[state]) } else { state };
                bits.insert(cell, (name, is_opposite));
                now.insert(cell, net);
            }
        }
        for (&cell, &net) in &now {
            logic.move_listeners(cell, net);
        }
        let now = |net: NetId| now.get(&net).copied().unwrap_or(net);
        let mut registers = Vec::new();
        for (name, &Element { shown: (cell, _), root, kind, .. }) in elements {
            let (clock, is_opposite) = match self.netlist.node(root) {
                Node::Input(clock) => (clock.clone(), false),
                _ => match bits.get(&root) {
                    Some(&(register, is_opposite)) => (register.to_owned(), is_opposite),
                    None => {
                        let opens = format!("{name} opens");
                        logic.add_output(&opens, root);
                        (opens, false)
                    }
                },
            };
            let kind = if is_opposite { opposite(kind) } else { kind };
            let start = Some(self.start.value(cell));
            registers.push(Register { name: name.clone(), kind, clock: Some(clock), start, forcing: Forcing::Never });
        }
        for (name, &Element { data: (net, inverted), .. }) in elements {
            let net = now(net);
            let data = if inverted { logic.add_gate(Function::NOT, &[net]) } else { net };
            logic.add_output(format!("{name}_next"), data);
        }
        sweep(&mut logic);
        Design::new(logic, registers)
    }
}

fn opposite(kind: RegisterKind) -> RegisterKind {
    match kind {
        RegisterKind::Rising => RegisterKind::Falling,
        RegisterKind::Falling => RegisterKind::Rising,
        RegisterKind::High => RegisterKind::Low,
        RegisterKind::Low => RegisterKind::High,
    }
}

#[cfg(test)]
mod tests {
    use rand::{Rng, SeedableRng};
    use rand_chacha::ChaCha8Rng;

    use super::*;
    use crate::example::{latch, multiplexer_library, random_machine};
    use crate::map::map;
    use crate::registers::expand;
    use crate::timing::Held;

    fn forms(source: &Netlist) -> [Netlist; 2] {
        let mapped = map(source, &multiplexer_library()).unwrap();
        let held = Held::of(&mapped, &multiplexer_library()).unwrap().netlist;
        [mapped, held]
    }

    fn started_otherwise(netlist: &Netlist, cell: NetId) -> Netlist {
        let mut other = netlist.clone();
        let start = &mut other.cell_mut(cell).unwrap().start;
        *start = start.map(|value| !value);
        other
    }

    #[test]
    fn latches_of_one_cell_are_proved_and_other_starts_and_data_are_found() {
        let mut random = ChaCha8Rng::seed_from_u64(70);
        let (mut starts, mut data) = (0, 0);
        for _ in 0..100 {
            let [mapped, made] = forms(&random_machine(&mut random));
            let found = prove_forms(&mapped, &made);
            assert!(matches!(found, Some(Ok(_))), "{found:?}:\n{mapped}{made}");
            for register in &Bits::of(&made).taken(|_| Some(false)).registers {
                let cell = made.ids().find(|&id| made.net_name(id) == register.name).unwrap();
                let found = prove_forms(&mapped, &started_otherwise(&made, cell));
                assert_eq!(found, Some(Err(ProofError::Start(register.name.clone()))));
                starts += 1;
            }
            let mut wrong = made.clone();
            let logic: Vec<NetId> = made.cells().filter(|(_, cell)| cell.start.is_none()).map(|(id, _)| id).collect();
            if let Some(&cell) = logic.get(random.next_u32() as usize % logic.len().max(1)) {
                let function = &mut wrong.cell_mut(cell).unwrap().function;
                *function = function.inverted();
                data += usize::from(matches!(prove_forms(&mapped, &wrong), Some(Err(_))));
            }
        }
        assert!(starts > 50 && data > 30, "{starts} starts, {data} wrong cells");
    }

    #[test]
    fn latches_of_one_cell_that_open_otherwise_are_found() {
        let [mapped, made] = forms(&latch());
        assert_eq!(prove_forms(&mapped, &made).unwrap().unwrap().cuts, [""; 0]);
        let mut wrong = made.clone();
        let (cell, _) = made.cells().find(|(_, cell)| cell.function == Function::MUX).unwrap();
        let [data, own] = [made.pins(cell)[1], made.pins(cell)[2]];
        wrong.drive(cell, 1, own);
        wrong.drive(cell, 2, data);
        assert_eq!(prove_forms(&mapped, &wrong), Some(Err(ProofError::Start("q".to_owned()))));
    }

    /// A design in which `a` toggles, `b` is clocked by `a`, and `c` is a latch that stores `a` while `d` is 0.
    fn design(starts: [bool; 3]) -> Design {
        let mut logic = Netlist::new("design");
        let d = logic.add_input("d");
        let states = ["a", "b", "c"].map(|name| logic.add_input(name));
        let [a, b, _] = states;
        let nexts = [logic.add_gate(Function::NOT, &[a]), logic.add_gate(Function::XOR, &[b, d]), a];
        states.into_iter().zip(["x", "y", "z"]).for_each(|(state, name)| _ = logic.add_output(name, state));
        nexts.into_iter().for_each(|net| _ = logic.add_output("next", net));
        let kinds = [(RegisterKind::Falling, None), (RegisterKind::Rising, Some("a")), (RegisterKind::Low, Some("d"))];
        let register = |((name, (kind, clock)), start): ((&str, (RegisterKind, Option<&str>)), bool)| Register {
            name: name.to_owned(),
            kind,
            clock: clock.map(str::to_owned),
            start: Some(start),
            forcing: Forcing::Never,
        };
        Design::new(logic, ["a", "b", "c"].into_iter().zip(kinds).zip(starts).map(register).collect())
    }

    #[test]
    fn registers_as_cells_are_proved_and_other_starts_edges_and_data_are_found() {
        for number in 0..8 {
            let starts = [0, 1, 2].map(|bit| number >> bit & 1 == 1);
            let (read, cells) = (design(starts), expand(&design(starts)));
            assert!(matches!(prove_expanded(&read, &cells), Some(Ok(_))));
            for (at, start) in starts.into_iter().enumerate() {
                let name = read.registers[at].name.clone();
                let mut other = read.clone();
                other.registers[at].start = Some(!start);
                assert_eq!(prove_expanded(&other, &cells), Some(Err(ProofError::Start(name.clone()))));
                let mut other = read.clone();
                other.registers[at].kind = opposite(other.registers[at].kind);
                assert_eq!(prove_expanded(&other, &cells), Some(Err(ProofError::Start(name))));
            }
        }
        let mut other = design([false; 3]);
        let next = *other.logic.outputs().last().unwrap();
        other.logic.drive(next, 0, other.logic.inputs()[2]);
        let found = prove_expanded(&other, &expand(&design([false; 3])));
        assert!(matches!(found, Some(Err(ProofError::Different { .. }))), "{found:?}");
    }
}
