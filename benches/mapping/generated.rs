//! Generated control logic to measure the compiler with: priority encoders, arbiters, PLAs, routers, one-hot state
//! machines and random control with planted redundancy. A generator with the same arguments gives the same circuit.

use nbc_base::model::Function;
use nbc_circuit::{NetId, Netlist};
use rand::{Rng, SeedableRng};
use rand_chacha::ChaCha8Rng;

/// All generated circuits with their names.
pub fn generated() -> Vec<Netlist> {
    let mut all: Vec<Netlist> = [8, 16, 32, 64, 128].map(priority_encoder).into();
    all.extend([4, 8, 16].map(arbiter));
    all.extend([[6, 20, 4], [8, 32, 6], [10, 48, 8], [12, 64, 8], [16, 80, 12]].map(pla));
    all.extend([2, 4, 8].map(router));
    all.extend([[6, 4], [12, 6], [24, 8]].map(one_hot_machine));
    all.extend([[10, 60], [16, 150], [24, 400], [40, 1000]].map(random_control));
    all
}

/// A circuit in the making.
struct Sketch {
    netlist: Netlist,
    random: ChaCha8Rng,
}

impl Sketch {
    fn new(name: &str, arguments: &[usize]) -> Self {
        let parts: Vec<String> = arguments.iter().map(usize::to_string).collect();
        let name = format!("{name}_{}", parts.join("_"));
        let seed = name.bytes().fold(7, |seed: u64, byte| seed.wrapping_mul(31).wrapping_add(byte.into()));
        Self { netlist: Netlist::new(name), random: ChaCha8Rng::seed_from_u64(seed) }
    }

    fn inputs(&mut self, prefix: &str, count: usize) -> Vec<NetId> {
        (0..count).map(|i| self.netlist.add_input(format!("{prefix}{i}"))).collect()
    }

    fn outputs(&mut self, prefix: &str, nets: &[NetId]) {
        for (i, &net) in nets.iter().enumerate() {
            self.netlist.add_output(format!("{prefix}{i}"), net);
        }
    }

    fn gate(&mut self, function: Function, pins: &[NetId]) -> NetId {
        self.netlist.add_gate(function, pins)
    }

    fn not(&mut self, net: NetId) -> NetId {
        self.gate(Function::NOT, &[net])
    }

    /// A chain of one function; the constant for no nets.
    fn chain(&mut self, function: Function, nets: &[NetId]) -> NetId {
        match nets.split_first() {
            None => self.netlist.add_constant(function == Function::AND),
            Some((&first, rest)) => rest.iter().fold(first, |sum, &net| self.gate(function, &[sum, net])),
        }
    }

    fn below(&mut self, bound: usize) -> usize {
        ((u64::from(self.random.next_u32()) * bound as u64) >> 32) as usize
    }

    fn pick(&mut self, nets: &[NetId]) -> NetId {
        nets[self.below(nets.len())]
    }

    /// The AND of a random literal of each net, the net left out where the draw says so.
    fn product(&mut self, nets: &[NetId], kept: usize) -> NetId {
        let mut literals = Vec::new();
        for &net in nets {
            if self.below(100) < kept {
                let literal = if self.below(2) == 0 { net } else { self.not(net) };
                literals.push(literal);
            }
        }
        self.chain(Function::AND, &literals)
    }
}

/// The number of the first input that is 1, and whether there is one.
fn priority_encoder(inputs: usize) -> Netlist {
    let mut sketch = Sketch::new("priority", &[inputs]);
    let requests = sketch.inputs("r", inputs);
    let mut grants = Vec::new();
    let mut none = sketch.netlist.add_constant(true);
    for &request in &requests {
        grants.push(sketch.gate(Function::AND, &[none, request]));
        let absent = sketch.not(request);
        none = sketch.gate(Function::AND, &[none, absent]);
    }
    for bit in 0..inputs.ilog2() {
        let with: Vec<NetId> = (0..inputs).filter(|i| i >> bit & 1 == 1).map(|i| grants[i]).collect();
        let number = sketch.chain(Function::OR, &with);
        sketch.outputs(&format!("n{bit}_"), &[number]);
    }
    let any = sketch.not(none);
    sketch.outputs("any", &[any]);
    sketch.netlist
}

/// A round-robin arbiter: the first request from the one-hot pointer on, in a circle, is granted.
fn arbiter(inputs: usize) -> Netlist {
    let mut sketch = Sketch::new("arbiter", &[inputs]);
    let requests = sketch.inputs("r", inputs);
    let pointer = sketch.inputs("p", inputs);
    let mut grants = vec![Vec::new(); inputs];
    for (start, &first) in pointer.iter().enumerate() {
        let mut open = first;
        for step in 0..inputs {
            let at = (start + step) % inputs;
            grants[at].push(sketch.gate(Function::AND, &[open, requests[at]]));
            let absent = sketch.not(requests[at]);
            open = sketch.gate(Function::AND, &[open, absent]);
        }
    }
    let grants: Vec<NetId> = grants.iter().map(|terms| sketch.chain(Function::OR, terms)).collect();
    sketch.outputs("g", &grants);
    sketch.netlist
}

/// Sums of random products: inputs, products, outputs.
fn pla([inputs, products, outputs]: [usize; 3]) -> Netlist {
    let mut sketch = Sketch::new("pla", &[inputs, products, outputs]);
    let nets = sketch.inputs("x", inputs);
    let products: Vec<NetId> = (0..products).map(|_| sketch.product(&nets, 45)).collect();
    for i in 0..outputs {
        let mut used = Vec::new();
        for &product in &products {
            if sketch.below(100) < 25 {
                used.push(product);
            }
        }
        let sum = sketch.chain(Function::OR, &used);
        sketch.outputs(&format!("f{i}_"), &[sum]);
    }
    sketch.netlist
}

/// A router of a mesh: compares a packet's place with its own, and opens one of five ways if that is free.
fn router(bits: usize) -> Netlist {
    let mut sketch = Sketch::new("router", &[bits]);
    let mut ways = Vec::new();
    for axis in ["x", "y"] {
        let there = sketch.inputs(&format!("{axis}to"), bits);
        let here = sketch.inputs(&format!("{axis}at"), bits);
        let mut less = sketch.netlist.add_constant(false);
        let mut equal = sketch.netlist.add_constant(true);
        for i in (0..bits).rev() {
            let same = sketch.gate(Function::XNOR, &[there[i], here[i]]);
            let absent = sketch.not(there[i]);
            let below = sketch.gate(Function::AND, &[absent, here[i]]);
            let first = sketch.gate(Function::AND, &[equal, below]);
            less = sketch.gate(Function::OR, &[less, first]);
            equal = sketch.gate(Function::AND, &[equal, same]);
        }
        let either = sketch.gate(Function::OR, &[less, equal]);
        ways.push([less, sketch.not(either), equal]);
    }
    let valid = sketch.inputs("valid", 1)[0];
    let free = sketch.inputs("free", 5);
    let [[west, east, column], [south, north, row]] = [ways[0], ways[1]];
    let chosen = [vec![west], vec![east], vec![column, south], vec![column, north], vec![column, row]];
    let mut opened = Vec::new();
    for (way, conditions) in chosen.into_iter().enumerate() {
        let wanted = sketch.chain(Function::AND, &[conditions, vec![valid]].concat());
        opened.push(sketch.gate(Function::AND, &[wanted, free[way]]));
    }
    sketch.outputs("open", &opened);
    let any = sketch.chain(Function::OR, &opened);
    let stalled = sketch.not(any);
    let stalled = sketch.gate(Function::AND, &[valid, stalled]);
    sketch.outputs("stall", &[stalled]);
    sketch.netlist
}

/// The logic of a one-hot state machine: each state has guarded transitions, of which the first that applies is taken.
fn one_hot_machine([states, inputs]: [usize; 2]) -> Netlist {
    let mut sketch = Sketch::new("onehot", &[states, inputs]);
    let state = sketch.inputs("s", states);
    let conditions = sketch.inputs("x", inputs);
    let mut next = vec![Vec::new(); states];
    let mut shown = vec![Vec::new(); 4];
    for &from in &state {
        let mut still = from;
        for _ in 0..3 {
            let guard = sketch.product(&conditions, 30);
            let taken = sketch.gate(Function::AND, &[still, guard]);
            let to = sketch.below(states);
            next[to].push(taken);
            let output = sketch.below(4);
            shown[output].push(taken);
            let otherwise = sketch.not(guard);
            still = sketch.gate(Function::AND, &[still, otherwise]);
        }
        let to = sketch.below(states);
        next[to].push(still);
    }
    let next: Vec<NetId> = next.iter().map(|terms| sketch.chain(Function::OR, terms)).collect();
    sketch.outputs("next", &next);
    let shown: Vec<NetId> = shown.iter().map(|terms| sketch.chain(Function::OR, terms)).collect();
    sketch.outputs("z", &shown);
    sketch.netlist
}

/// Random gates with planted redundancy: copies in another form, absorbed terms, and terms implied by others.
fn random_control([inputs, gates]: [usize; 2]) -> Netlist {
    let mut sketch = Sketch::new("random", &[inputs, gates]);
    let mut nets = sketch.inputs("x", inputs);
    let functions = [Function::AND, Function::OR, Function::NAND, Function::NOR, Function::AND, Function::OR];
    while nets.len() < inputs + gates {
        let recent = nets.len().saturating_sub(3 * inputs);
        let near = &nets[recent..].to_vec();
        let [a, b, c] = [0; 3].map(|_| sketch.pick(near));
        let function = functions[sketch.below(functions.len())];
        let net = match sketch.below(10) {
            0 => multiplexer(&mut sketch, a, b, c),
            1 => redundant_or(&mut sketch, a, b),
            2 => consensus(&mut sketch, a, b, c),
            3 => distributed(&mut sketch, a, b, c),
            4 => sketch.gate(Function::XOR, &[a, b]),
            _ => sketch.gate(function, &[a, b]),
        };
        nets.push(net);
    }
    let shown: Vec<NetId> = nets[nets.len() - (gates / 8).max(4)..].to_vec();
    sketch.outputs("y", &shown);
    sketch.netlist
}

fn multiplexer(sketch: &mut Sketch, a: NetId, b: NetId, c: NetId) -> NetId {
    let opposite = sketch.not(a);
    let one = sketch.gate(Function::AND, &[a, b]);
    let two = sketch.gate(Function::AND, &[opposite, c]);
    sketch.gate(Function::OR, &[one, two])
}

/// `a or (a and b)`, which is `a`.
fn redundant_or(sketch: &mut Sketch, a: NetId, b: NetId) -> NetId {
    let both = sketch.gate(Function::AND, &[a, b]);
    sketch.gate(Function::OR, &[a, both])
}

/// A multiplexer with the term that its other two imply.
fn consensus(sketch: &mut Sketch, a: NetId, b: NetId, c: NetId) -> NetId {
    let chosen = multiplexer(sketch, a, b, c);
    let implied = sketch.gate(Function::AND, &[b, c]);
    sketch.gate(Function::OR, &[chosen, implied])
}

/// `a and (b or c)` as a sum of products.
fn distributed(sketch: &mut Sketch, a: NetId, b: NetId, c: NetId) -> NetId {
    let one = sketch.gate(Function::AND, &[a, b]);
    let two = sketch.gate(Function::AND, &[a, c]);
    sketch.gate(Function::OR, &[one, two])
}
