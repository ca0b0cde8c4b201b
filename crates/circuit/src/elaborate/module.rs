//! A circuit with values for its parameters, built: bits with their drivers, and the circuits inside it.

use std::collections::BTreeMap;
use std::ops::Range;

use crate::index::ListIndex;
use crate::register::{Forcing, RegisterKind, RegisterNode};
use nbc_base::budget::Limit;
use nbc_base::model::{CircuitId, ExpressionId, Function, Target};
use nbc_base::source::Span;

#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct ModuleId(pub(super) u32);

impl ModuleId {
    pub(super) fn new(at: usize) -> Self {
        Self(u32::try_from(at).expect("fewer than 2^32 modules"))
    }
}

#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct ModuleKey {
    pub(super) circuit: CircuitId,
    pub(super) arguments: Vec<i128>,
    pub(super) absent: Vec<u32>,
}

/// How a module was built, so that the next check can take it.
#[derive(Clone, Debug)]
pub(super) struct Making {
    pub(super) key: ModuleKey,
    /// Of the circuit's name.
    pub(super) place: Span,
    /// For it alone, without those inside.
    pub(super) spent: Vec<(Limit, u64)>,
    pub(super) has_faults: bool,
    /// Levels of modules inside, and its own.
    pub(super) height: usize,
    /// One that was taken from the last check may be of no use in this one.
    pub(super) is_used: bool,
}

/// For each module, and each of its output bits, the input bits that reach it.
pub(super) type Passes = BTreeMap<ModuleId, Vec<Vec<u32>>>;

pub(super) type Bit = u32;

#[derive(Clone, Copy, Debug)]
pub(super) enum ModuleSignal {
    /// An input bit of the module, counted over the ports in order, the lowest bit of a port first.
    Input(u32),
    Constant(bool),
    /// A gate; of one input, both pins are the same.
    Gate {
        function: Function,
        pins: [Bit; 2],
        span: Span,
    },
    /// A register that reads its data, its clock, a set and a reset.
    Register {
        kind: RegisterKind,
        forcing: Forcing,
        start: bool,
        pins: [Bit; 4],
    },
    /// A bit of a net, and the bit that drives it, once the statement `by` does.
    Net {
        net: u32,
        bit: u32,
        driver: Option<ListIndex>,
        by: u32,
    },
    Output {
        site: u32,
        bit: u32,
    },
}

pub(super) struct Site {
    pub(super) module: ModuleId,
    pub(super) inputs: Vec<Bit>,
    pub(super) name: String,
}

pub(super) struct ModuleNet {
    pub(super) name: String,
    pub(super) span: Span,
    pub(super) width: Option<u32>,
    pub(super) words: Option<u32>,
    /// The signal of its lowest bit, once its width is known.
    pub(super) first: Bit,
}

#[derive(Clone, Debug)]
pub(super) struct ModulePort {
    /// The net among those of the module; ports have the same place in the circuit.
    pub(super) net: u32,
    pub(super) name: String,
    pub(super) first: Bit,
    pub(super) width: u32,
}

#[derive(Default)]
pub(super) struct Module {
    pub(super) circuit: CircuitId,
    pub(super) inputs: Vec<ModulePort>,
    pub(super) outputs: Vec<ModulePort>,
    pub(super) signals: Vec<ModuleSignal>,
    /// The nets: input ports, output ports, others.
    pub(super) nets: Vec<ModuleNet>,
    pub(super) sites: Vec<Site>,
    pub(super) starts: Vec<(Bit, bool)>,
    /// The output bits, over the ports in order, the lowest bit of a port first.
    pub(super) output_bits: Vec<Bit>,
    pub(super) memories: Vec<MemoryPorts>,
    pub(super) sum: Sum,
}

impl Module {
    pub(super) fn start(&self, bit: Bit) -> Option<bool> {
        let at = self.starts.binary_search_by_key(&bit, |(bit, _)| *bit).ok()?;
        Some(self.starts[at].1)
    }

    pub(super) fn move_spans(&mut self, from: Span, to: Span) {
        self.nets.iter_mut().for_each(|net| net.span = net.span.moved(from, to));
        for signal in &mut self.signals {
            if let ModuleSignal::Gate { span, .. } = signal {
                *span = span.moved(from, to);
            }
        }
    }

    pub(super) fn port(&self, net: usize) -> ModulePort {
        let ModuleNet { name, width, first, .. } = &self.nets[net];
        ModulePort { net: net as u32, name: name.clone(), first: *first, width: width.expect("a port has a width") }
    }

    pub(super) fn watch(&mut self, declared: Span) {
        for net in (0..self.nets.len()).filter(|&net| self.nets[net].span == declared).collect::<Vec<_>>() {
            let port = self.port(net);
            self.output_bits.extend(port.first..port.first + port.width);
            self.outputs.push(port);
        }
    }

    pub(super) fn show(&mut self, declared: Span) {
        let shown: Vec<usize> = (0..self.nets.len()).filter(|&net| self.nets[net].span == declared).collect();
        let bits = shown.iter().map(|&net| &self.nets[net]);
        let bits = bits.flat_map(|net| net.first..net.first + net.width.unwrap_or_default());
        self.output_bits = bits.collect();
        let port = self.outputs.first().cloned();
        self.outputs =
            port.map(|port| ModulePort { width: self.output_bits.len() as u32, ..port }).into_iter().collect();
    }
}

/// Sums over a module and all that it contains. Each is at most the largest number.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Sum {
    cells: u64,
    nets: u64,
    instances: u64,
    named: u64,
    name_bytes: u64,
}

/// The most digits and brackets after the name of a net.
const BIT_BYTES: u64 = 9;

impl Sum {
    pub(super) fn of(module: &Module, modules: &[Module], circuit_bytes: usize) -> Self {
        let mut sum = Self { nets: module.signals.len() as u64, instances: 1, ..Self::default() };
        sum.name_bytes = circuit_bytes as u64;
        for signal in &module.signals {
            match signal {
                ModuleSignal::Gate { .. } => sum.cells += 1,
                ModuleSignal::Register { .. } => sum.cells += RegisterNode::CELLS as u64,
                ModuleSignal::Net { net, .. } => {
                    sum.named += 1;
                    sum.name_bytes += module.nets[*net as usize].name.len() as u64 + BIT_BYTES;
                }
                _ => {}
            }
        }
        for site in &module.sites {
            let inside = &modules[site.module.0 as usize].sum;
            // The name of a call begins the names of all that is inside.
            let before = (site.name.len() as u64 + 1).saturating_mul(inside.named.saturating_add(inside.instances));
            sum.cells = sum.cells.saturating_add(inside.cells);
            sum.nets = sum.nets.saturating_add(inside.nets);
            sum.instances = sum.instances.saturating_add(inside.instances);
            sum.named = sum.named.saturating_add(inside.named);
            sum.name_bytes = sum.name_bytes.saturating_add(inside.name_bytes).saturating_add(before);
        }
        sum
    }

    pub(super) fn counts(&self) -> [(Limit, u64); 4] {
        [
            (Limit::Cells, self.cells),
            (Limit::Nets, self.nets),
            (Limit::Instances, self.instances),
            (Limit::NetNameBytes, self.name_bytes),
        ]
    }
}

/// Counted over the bits of the inputs and outputs of the environment; the highest bit of a port comes first.
#[derive(Clone, Debug)]
pub struct MemoryPorts {
    pub memory: usize,
    pub words: usize,
    pub width: usize,
    /// The output bits of the address, and the input bits of the word.
    pub reads: Vec<[Range<usize>; 2]>,
    /// The output bits of the address, the word, the enable and the clock.
    pub writes: Vec<[Range<usize>; 4]>,
}

/// A block of statements in one turn of the loops around it, with its nets.
pub(super) struct Scope {
    pub(super) parent: Option<u32>,
    /// The first slot of the block's nets, and the net it is in this turn.
    pub(super) first_slot: u32,
    pub(super) first_net: u32,
    pub(super) nets: u32,
    pub(super) variables: Vec<i128>,
    pub(super) turn: String,
}

impl Scope {
    /// The first slot of the block's nets, its net in this iteration, and the number of slots.
    pub(super) fn nets(&self) -> (u32, u32, u32) {
        (self.first_slot, self.first_net, self.nets)
    }
}

#[derive(Clone, Copy)]
pub(super) struct Item<'a> {
    pub(super) frame: u32,
    pub(super) targets: &'a [Target],
    pub(super) joined: bool,
    pub(super) value: ExpressionId,
}
