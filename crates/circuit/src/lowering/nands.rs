//! Registers as loops of NAND cells, safe for every delay of one to three cycles if the inverter of a clock is no
//! slower than two other cells (docs/timing.md, "Registers as cells").

use crate::lowering::Lowering;
use crate::register::{Forcing, RegisterKind};
use crate::{NetId, RegisterNode};
use nbc_base::model::Function;

/// Nets that force a latch without reaching its guards, so that it closes as one without them does.
#[derive(Clone, Copy, Default)]
struct Forces {
    /// 0 where the latch is to be 0.
    go: Option<NetId>,
    /// 0 where it is to be 1.
    stay: Option<NetId>,
}

/// The cells that let data into a latch.
#[derive(Clone, Copy)]
struct Guard {
    enable: NetId,
    function: Function,
    /// The value of `enable` that lets them in.
    open: bool,
}

impl Lowering<'_> {
    /// The net that shows the register. An edge takes two latches: the second one is open where the register shows
    /// what the first one has kept since the clock had its other value.
    pub(super) fn nands(&mut self, register: &RegisterNode, name: &str, pins: &[NetId]) -> NetId {
        let [data, clock] = [pins[0], pins[1]];
        let start = register.starts_at();
        let forces = self.forces(register, &pins[2..]);
        let on = Guard { enable: clock, function: Function::NAND, open: true };
        if register.kind == RegisterKind::High {
            return self.latch(name, data, on, start, forces);
        }
        let off = self.guard_at_zero(clock);
        let (first, second) = match register.kind {
            RegisterKind::High | RegisterKind::Low => return self.latch(name, data, off, start, forces),
            RegisterKind::Rising => (off, on),
            RegisterKind::Falling => (on, off),
        };
        let held = self.latch(&format!("{name}.held"), data, first, start, forces);
        self.latch(name, held, second, start, forces)
    }

    /// The guard of a latch that is open while a clock is 0. Where one cell does it, it reads the clock itself, so that
    /// both latches of an edge see it at once.
    fn guard_at_zero(&mut self, clock: NetId) -> Guard {
        let function = Function::NAND.with_input_inverted(1);
        if self.is_one_cell(function) {
            return Guard { enable: clock, function, open: false };
        }
        Guard { enable: self.inverse(clock), function: Function::NAND, open: true }
    }

    fn forces(&mut self, register: &RegisterNode, nets: &[NetId]) -> Forces {
        match (register.forcing, nets) {
            (Forcing::ToStart, &[reset]) if register.starts_at() => {
                Forces { go: None, stay: Some(self.inverse(reset)) }
            }
            (Forcing::ToStart, &[reset]) => Forces { go: Some(self.inverse(reset)), stay: None },
            (Forcing::SetReset, &[set, reset]) => {
                let go = self.inverse(reset);
                Forces { go: Some(go), stay: Some(self.gate(Function::NAND, &[set, go])) }
            }
            _ => Forces::default(),
        }
    }

    /// Four cells and one for each force, and the net that follows the data. The reset branch reads the set branch, so
    /// no inverter races it.
    fn latch(&mut self, name: &str, data: NetId, guard: Guard, start: bool, forces: Forces) -> NetId {
        let set = self.gate(guard.function, &[data, guard.enable]);
        let clear = self.gate(guard.function, &[set, guard.enable]);
        self.made.clear();
        let opposite = self.kept(format!("{name}.n"), !start);
        let back = self.passed(format!("{name}.down"), !start, opposite, forces.stay);
        let shown = self.gate(Function::NAND, &[set, back]);
        let own = self.kept(name.to_owned(), start);
        self.netlist.connect(own, 0, shown);
        let kept = self.passed(format!("{name}.kept"), start, own, forces.go);
        let other = self.gate(Function::NAND, &[clear, kept]);
        self.netlist.connect(opposite, 0, other);
        // What forces a latch reaches it while it is closed.
        if forces.go.is_none() && forces.stay.is_none() {
            self.note(shown, guard.enable, guard.open);
        }
        own
    }

    fn passed(&mut self, name: String, start: bool, net: NetId, force: Option<NetId>) -> NetId {
        let Some(force) = force else { return net };
        let own = self.kept(name, start);
        let cell = self.gate(Function::AND, &[net, force]);
        self.netlist.connect(own, 0, cell);
        own
    }
}
