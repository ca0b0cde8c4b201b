//! The circuit while it is learned: gates that are shared if they are equal, with inverted connections.

use std::ops::Not;

use crate::bits::Bits;
use nbc_base::model::Function;
use nbc_circuit::interned::Interned;
use nbc_circuit::{NetId, Netlist};

#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Literal(u32);

impl Literal {
    pub const FALSE: Self = Self(0);
    pub const TRUE: Self = Self(1);

    fn of(node: usize) -> Self {
        Self((node as u32) << 1)
    }

    fn node(self) -> usize {
        (self.0 >> 1) as usize
    }

    fn is_inverted(self) -> bool {
        self.0 & 1 == 1
    }

    #[must_use]
    pub fn inverted_if(self, invert: bool) -> Self {
        Self(self.0 ^ u32::from(invert))
    }

    pub fn constant(value: bool) -> Self {
        Self::FALSE.inverted_if(value)
    }
}

impl Not for Literal {
    type Output = Self;

    fn not(self) -> Self {
        Self(self.0 ^ 1)
    }
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
enum Gate {
    And(Literal, Literal),
    Xor(Literal, Literal),
    Mux(Literal, Literal, Literal),
    Majority(Literal, Literal, Literal),
    /// A function of three nets, none of them inverted: bit `4a + 2b + c` is its value.
    Table([Literal; 3], u8),
}

impl Gate {
    fn pins(self) -> Vec<Literal> {
        match self {
            Self::And(a, b) | Self::Xor(a, b) => vec![a, b],
            Self::Mux(a, b, c) | Self::Majority(a, b, c) | Self::Table([a, b, c], _) => vec![a, b, c],
        }
    }

    fn ands(self) -> usize {
        match self {
            Self::And(..) => 1,
            Self::Xor(..) | Self::Mux(..) => 3,
            Self::Majority(..) => 4,
            Self::Table(_, bits) => {
                // A multiplexer of two functions of two nets, which are an exclusive or, an AND or none.
                let half = |bits: u8| match bits {
                    0b0110 | 0b1001 => 3,
                    _ if bits.count_ones() % 2 == 1 => 1,
                    _ => 0,
                };
                3 + half(bits >> 4) + half(bits & 15)
            }
        }
    }
}

/// Gates over input bits, drivers first. The node of a net is 0 for the constant, then the inputs, then the gates.
#[derive(Clone, Debug, Default)]
pub struct GateGraph {
    gates: Interned<Gate>,
    inputs: usize,
}

impl GateGraph {
    pub fn new(inputs: usize) -> Self {
        Self { gates: Interned::default(), inputs }
    }

    pub fn input(&self, at: usize) -> Literal {
        Literal::of(at + 1)
    }

    pub fn inputs(&self) -> Vec<Literal> {
        (0..self.inputs).map(|at| self.input(at)).collect()
    }

    fn gate(&mut self, gate: Gate) -> Literal {
        Literal::of(1 + self.inputs + self.gates.number(gate))
    }

    pub fn and(&mut self, a: Literal, b: Literal) -> Literal {
        let (a, b) = (a.min(b), a.max(b));
        match (a, b) {
            (Literal::FALSE, _) => Literal::FALSE,
            (Literal::TRUE, other) => other,
            _ if a == b => a,
            _ if a == b.not() => Literal::FALSE,
            _ => self.gate(Gate::And(a, b)),
        }
    }

    pub fn or(&mut self, a: Literal, b: Literal) -> Literal {
        self.and(a.not(), b.not()).not()
    }

    pub fn xor(&mut self, a: Literal, b: Literal) -> Literal {
        let invert = a.is_inverted() != b.is_inverted();
        let (a, b) = (a.inverted_if(a.is_inverted()), b.inverted_if(b.is_inverted()));
        let (a, b) = (a.min(b), a.max(b));
        let xor = match a {
            Literal::FALSE => b,
            _ if a == b => Literal::FALSE,
            _ => self.gate(Gate::Xor(a, b)),
        };
        xor.inverted_if(invert)
    }

    pub fn mux(&mut self, select: Literal, yes: Literal, no: Literal) -> Literal {
        let (select, yes, no) = if select.is_inverted() { (select.not(), no, yes) } else { (select, yes, no) };
        if yes == no || select == Literal::FALSE {
            return no;
        }
        if yes == no.not() {
            return self.xor(select, no);
        }
        if yes == Literal::TRUE || yes == select {
            return self.or(select, no);
        }
        if yes == Literal::FALSE || yes == select.not() {
            return self.and(select.not(), no);
        }
        if no == Literal::TRUE || no == select.not() {
            return self.or(select.not(), yes);
        }
        if no == Literal::FALSE || no == select {
            return self.and(select, yes);
        }
        if yes.is_inverted() {
            return self.gate(Gate::Mux(select, yes.not(), no.not())).not();
        }
        self.gate(Gate::Mux(select, yes, no))
    }

    pub fn majority(&mut self, a: Literal, b: Literal, c: Literal) -> Literal {
        let mut pins = [a, b, c];
        pins.sort_unstable();
        let [a, b, c] = pins;
        if a == b || b == c {
            return b;
        }
        if a == b.not() {
            return c;
        }
        if b == c.not() {
            return a;
        }
        match a {
            Literal::FALSE => self.and(b, c),
            Literal::TRUE => self.or(b, c),
            _ => {
                let invert = pins.iter().filter(|pin| pin.is_inverted()).count() >= 2;
                let [a, b, c] = pins.map(|pin| pin.inverted_if(invert));
                self.gate(Gate::Majority(a, b, c)).inverted_if(invert)
            }
        }
    }

    pub fn table(&mut self, pins: [Literal; 3], bits: u8) -> Literal {
        let entry = |row: usize| bits >> row & 1 == 1;
        let flip = pins.iter().fold(0, |flip, pin| flip << 1 | usize::from(pin.is_inverted()));
        let plain = (0..8).fold(0, |plain, row| plain | u8::from(entry(row ^ flip)) << row);
        let depends = |place: usize| (0..8).any(|row| entry(row) != entry(row ^ (4 >> place)));
        let is_table = (0..3).all(depends) && pins.iter().all(|pin| pin.node() > 0);
        let nodes = pins.map(Literal::node);
        if is_table && nodes[0] != nodes[1] && nodes[1] != nodes[2] && nodes[0] != nodes[2] {
            return self.gate(Gate::Table(pins.map(|pin| pin.inverted_if(pin.is_inverted())), plain));
        }
        let [a, b, c] = pins;
        let pairs: [Literal; 4] = std::array::from_fn(|at| {
            self.mux(c, Literal::constant(entry(2 * at + 1)), Literal::constant(entry(2 * at)))
        });
        let [no, yes] = [0, 2].map(|at| self.mux(b, pairs[at + 1], pairs[at]));
        self.mux(a, yes, no)
    }

    pub fn any(&mut self, mut terms: Vec<Literal>) -> Literal {
        while terms.len() > 1 {
            terms = terms.chunks(2).map(|pair| if let [a, b] = *pair { self.or(a, b) } else { pair[0] }).collect();
        }
        terms.first().copied().unwrap_or(Literal::FALSE)
    }

    pub fn every(&mut self, terms: Vec<Literal>) -> Literal {
        self.any(terms.into_iter().map(Literal::not).collect()).not()
    }

    fn cone(&self, outputs: &[Literal]) -> Vec<bool> {
        let first = 1 + self.inputs;
        let mut needed = vec![false; first + self.gates.items.len()];
        outputs.iter().for_each(|output| needed[output.node()] = true);
        for (at, gate) in self.gates.items.iter().enumerate().rev() {
            if needed[first + at] {
                gate.pins().iter().for_each(|pin| needed[pin.node()] = true);
            }
        }
        needed
    }

    /// The AND gates of these nets, inverters not counted: 1 for an AND, 3 for an exclusive or and for a multiplexer, 4
    /// for a majority of three.
    pub fn ands(&self, outputs: &[Literal]) -> usize {
        let needed = self.cone(outputs).split_off(1 + self.inputs);
        self.gates.items.iter().zip(needed).filter(|(_, needed)| *needed).map(|(gate, _)| gate.ands()).sum()
    }

    pub fn adopt(&mut self, other: &Self, literal: Literal) -> Literal {
        let needed = other.cone(&[literal]);
        let mut here = vec![Literal::FALSE];
        here.extend(self.inputs());
        for &gate in &other.gates.items {
            let pin = |pin: Literal| here[pin.node()].inverted_if(pin.is_inverted());
            here.push(match gate {
                _ if !needed[here.len()] => Literal::FALSE,
                Gate::And(a, b) => self.and(pin(a), pin(b)),
                Gate::Xor(a, b) => self.xor(pin(a), pin(b)),
                Gate::Mux(a, b, c) => self.mux(pin(a), pin(b), pin(c)),
                Gate::Majority(a, b, c) => self.majority(pin(a), pin(b), pin(c)),
                Gate::Table(pins, bits) => self.table(pins.map(pin), bits),
            });
        }
        here[literal.node()].inverted_if(literal.is_inverted())
    }

    /// The bits of nets in all rows, from those of the inputs.
    ///
    /// # Panics
    /// When there are no inputs.
    pub fn values(&self, inputs: &[Bits], outputs: &[Literal]) -> Vec<Bits> {
        let rows = inputs[0].rows();
        let needed = self.cone(outputs);
        let mut values = vec![Some(Bits::all(rows, false))];
        values.extend(inputs.iter().cloned().map(Some));
        let read = |values: &[Option<Bits>], literal: Literal| {
            let value = values[literal.node()].as_ref().expect("drivers come first");
            if literal.is_inverted() { value.not() } else { value.clone() }
        };
        for gate in &self.gates.items {
            if !needed[values.len()] {
                values.push(None);
                continue;
            }
            let pins: Vec<Bits> = gate.pins().into_iter().map(|pin| read(&values, pin)).collect();
            values.push(Some(match gate {
                Gate::And(..) => pins[0].and(&pins[1]),
                Gate::Xor(..) => pins[0].xor(&pins[1]),
                Gate::Mux(..) => pins[0].and(&pins[1]).or(&pins[2].and_not(&pins[0])),
                Gate::Majority(..) => pins[0].and(&pins[1]).or(&pins[2].and(&pins[0].or(&pins[1]))),
                Gate::Table(_, bits) => {
                    let at = |row: usize| pins.iter().fold(0, |at, pin| at << 1 | usize::from(pin.get(row)));
                    Bits::of((0..rows).map(|row| bits >> at(row) & 1 == 1))
                }
            }));
        }
        outputs.iter().map(|&output| read(&values, output)).collect()
    }

    pub fn netlist(&self, name: &str, inputs: &[String], outputs: &[(String, Literal)]) -> Netlist {
        let mut netlist = Netlist::new(name);
        let literals: Vec<Literal> = outputs.iter().map(|(_, literal)| *literal).collect();
        let needed = self.cone(&literals);
        let mut nets: Vec<Option<NetId>> = vec![None];
        nets.extend(inputs.iter().map(|input| Some(netlist.add_input(input))));
        for &gate in &self.gates.items {
            nets.push(needed[nets.len()].then(|| {
                let pins = gate.pins();
                let drivers: Vec<NetId> =
                    pins.iter().map(|pin| nets[pin.node()].expect("drivers come first")).collect();
                netlist.add_gate(function(gate, &pins), &drivers)
            }));
        }
        for (name, literal) in outputs {
            let net = match nets[literal.node()] {
                None => netlist.add_constant(literal.is_inverted()),
                Some(net) if literal.is_inverted() => netlist.add_gate(Function::NOT, &[net]),
                Some(net) => net,
            };
            netlist.add_output(name, net);
        }
        netlist
    }
}

fn function(gate: Gate, pins: &[Literal]) -> Function {
    let width = pins.len();
    let bits = (0..1u8 << width).filter(|row| {
        let pin = |at: usize| (row >> (width - 1 - at) & 1 == 1) != pins[at].is_inverted();
        match gate {
            Gate::And(..) => pin(0) && pin(1),
            Gate::Xor(..) => pin(0) != pin(1),
            Gate::Mux(..) => {
                if pin(0) {
                    pin(1)
                } else {
                    pin(2)
                }
            }
            Gate::Majority(..) => u8::from(pin(0)) + u8::from(pin(1)) + u8::from(pin(2)) >= 2,
            Gate::Table(_, bits) => bits >> row & 1 == 1,
        }
    });
    Function::of(width, bits.fold(0, |bits, row| bits | 1 << row))
}

#[cfg(test)]
mod tests {
    use super::*;
    use nbc_circuit::Logic;

    #[test]
    fn gates_are_simplified_shared_and_computed_as_the_netlist_does() {
        let mut graph = GateGraph::new(3);
        let inputs = graph.inputs();
        let signed = |pick: usize| match pick / 2 {
            0 => Literal::FALSE.inverted_if(pick % 2 == 1),
            at => inputs[at - 1].inverted_if(pick % 2 == 1),
        };
        let mut outputs = Vec::new();
        let mut expected: Vec<Box<dyn Fn([bool; 3]) -> bool>> = Vec::new();
        let value = |pick: usize, bits: [bool; 3]| match pick / 2 {
            0 => pick % 2 == 1,
            at => bits[at - 1] != (pick % 2 == 1),
        };
        for pick in 0..512 {
            let [a, b, c] = [pick / 64, pick / 8 % 8, pick % 8];
            outputs.push(graph.mux(signed(a), signed(b), signed(c)));
            expected.push(Box::new(move |bits| if value(a, bits) { value(b, bits) } else { value(c, bits) }));
            outputs.push(graph.majority(signed(a), signed(b), signed(c)));
            expected.push(Box::new(move |bits| [a, b, c].iter().filter(|&&pick| value(pick, bits)).count() >= 2));
            let bits = (pick * 37 % 256) as u8;
            outputs.push(graph.table([signed(a), signed(b), signed(c)], bits));
            expected.push(Box::new(move |row| {
                let at = [a, b, c].iter().fold(0, |at, &pick| at << 1 | usize::from(value(pick, row)));
                bits >> at & 1 == 1
            }));
            outputs.push(graph.xor(signed(a), signed(b)));
            expected.push(Box::new(move |bits| value(a, bits) != value(b, bits)));
        }
        let rows: Vec<[bool; 3]> = (0..8).map(|row| [row & 4 != 0, row & 2 != 0, row & 1 != 0]).collect();
        let columns: Vec<Bits> = (0..3).map(|at| Bits::of(rows.iter().map(|row| row[at]))).collect();
        let values = graph.values(&columns, &outputs);
        let named: Vec<_> = outputs.iter().enumerate().map(|(at, &output)| (format!("q{at}"), output)).collect();
        let netlist = graph.netlist("f", &["a", "b", "c"].map(str::to_owned), &named);
        let mut logic = Logic::new(&netlist);
        for (row, &bits) in rows.iter().enumerate() {
            let found = logic.settle(&bits).unwrap();
            for (at, expected) in expected.iter().enumerate() {
                assert_eq!((values[at].get(row), found[at]), (expected(bits), expected(bits)), "{at} {bits:?}");
            }
        }
        assert!(graph.gates.items.len() < 200, "equal gates are one, not {}", graph.gates.items.len());
    }

    #[test]
    fn and_gates_are_counted_once() {
        let mut graph = GateGraph::new(3);
        let [a, b, c] = [0, 1, 2].map(|at| graph.input(at));
        let sum = graph.xor(a, b);
        let both = graph.and(sum, c);
        assert_eq!(graph.ands(&[sum, both]), 4);
        assert_eq!(graph.ands(&[a, Literal::TRUE]), 0);
    }
}
