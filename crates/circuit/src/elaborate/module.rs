//! A circuit with values for its parameters, built: bits with their drivers, and the circuits inside it.

use crate::elaborate::memory_ports::MemoryPorts;
use crate::index::ListIndex;
use nbc_base::model::{CircuitId, Function};
use nbc_base::source::Span;

/// The place of a module in the builder.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct ModuleId(pub(super) u32);

impl ModuleId {
    /// The identity of the module at this index.
    pub(super) fn new(at: usize) -> Self {
        Self(u32::try_from(at).expect("fewer than 2^32 modules"))
    }
}

/// One bit inside a module: the place of its signal.
pub(super) type Bit = u32;

/// The source of a bit.
#[derive(Clone, Copy, Debug)]
pub(super) enum ModuleSignal {
    /// An input bit of the module, counted over the ports in order, the lowest bit of a port first.
    Input(u32),
    /// Always the same.
    Constant(bool),
    /// A gate; of one input, both pins are the same.
    Gate { function: Function, pins: [Bit; 2], span: Span },
    /// A bit of a net, and the bit that drives it, once the statement `by` does.
    Net { net: u32, bit: u32, driver: Option<ListIndex>, by: u32 },
    /// An output bit of a circuit inside.
    Output { site: u32, bit: u32 },
}

/// A circuit inside a module.
#[derive(Clone, Debug)]
pub(super) struct Site {
    pub(super) module: ModuleId,
    /// Its input bits, as [`ModuleSignal::Input`] counts them.
    pub(super) inputs: Vec<Bit>,
    pub(super) name: String,
}

/// A net of a module.
#[derive(Clone, Debug)]
pub(super) struct ModuleNet {
    pub(super) name: String,
    pub(super) span: Span,
    /// Its bits; `None` until its width is known.
    pub(super) width: Option<u32>,
    /// The number of words of an array, once its width is known.
    pub(super) words: Option<u32>,
    /// The signal of its lowest bit, once its width is known.
    pub(super) first: Bit,
}

/// A port of a module.
#[derive(Clone, Debug)]
pub(super) struct ModulePort {
    /// The net among those of the module; ports have the same place in the circuit.
    pub(super) net: u32,
    pub(super) name: String,
    /// The signal of its lowest bit.
    pub(super) first: Bit,
    pub(super) width: u32,
}

/// A circuit with values for its parameters.
#[derive(Clone, Debug)]
pub(super) struct Module {
    pub(super) circuit: CircuitId,
    pub(super) inputs: Vec<ModulePort>,
    pub(super) outputs: Vec<ModulePort>,
    pub(super) signals: Vec<ModuleSignal>,
    /// The nets: input ports, output ports, others.
    pub(super) nets: Vec<ModuleNet>,
    pub(super) sites: Vec<Site>,
    /// Values before the first cycle, in order of the bits.
    pub(super) starts: Vec<(Bit, bool)>,
    /// The output bits, over the ports in order, the lowest bit of a port first.
    pub(super) output_bits: Vec<Bit>,
    /// The ports of the memories, if it is an environment.
    pub(super) memories: Vec<MemoryPorts>,
    /// Gates, including those of the circuits inside.
    pub(super) cells: u64,
    /// Signals, including those of the circuits inside.
    pub(super) size: u64,
}

impl Module {
    /// The value of a bit before the first cycle, if it is given.
    pub(super) fn start(&self, bit: Bit) -> Option<bool> {
        let at = self.starts.binary_search_by_key(&bit, |(bit, _)| *bit).ok()?;
        Some(self.starts[at].1)
    }

    /// A net with a width as a port.
    pub(super) fn port(&self, net: usize) -> ModulePort {
        let ModuleNet { name, width, first, .. } = &self.nets[net];
        ModulePort { net: net as u32, name: name.clone(), first: *first, width: width.expect("a port has a width") }
    }

    /// Makes the nets declared at a place its output.
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
