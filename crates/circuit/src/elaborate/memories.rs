//! Memories of environments: what reads and writes them becomes ports of the module, after those that are declared. The
//! words read are inputs; the addresses, and the words written, are outputs.

use std::ops::Range;

use crate::elaborate::build::ModuleBuilder;
use nbc_base::budget::Limit;
use nbc_base::model::NetSlot;

/// The ports of a memory, counted over the bits of the inputs and outputs of its environment; the highest bit of a port
/// comes first.
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

impl ModuleBuilder<'_, '_> {
    pub(super) fn memory_ports(&mut self) {
        let circuit = self.circuit;
        for (at, memory) in circuit.memories.iter().enumerate() {
            let (Some(words), Some(width)) = (self.width(memory.words, 0), self.width(memory.width, 0)) else {
                self.failed = true;
                return;
            };
            if self.take(Limit::MemoryWords, u64::from(words)).is_none() {
                return;
            }
            let (words, width) = (words as usize, width as usize);
            let mut ports = MemoryPorts { memory: at, words, width, reads: Vec::new(), writes: Vec::new() };
            for frame in 0..self.frames.len() as u32 {
                let (first, _, nets) = self.frames[frame as usize].nets();
                let is_here = |slot: NetSlot| (first..first + nets).contains(&slot.0);
                for read in memory.reads.iter().filter(|read| is_here(read.address)) {
                    let Some(address) = self.access(read.address, frame, false) else { return };
                    let Some(data) = self.access(read.data, frame, true) else { return };
                    ports.reads.push([address, data]);
                }
                for write in memory.writes.iter().filter(|write| is_here(write.address)) {
                    let nets = [write.address, write.data, write.enable, write.clk];
                    let [Some(address), Some(data), Some(enable), Some(clk)] =
                        nets.map(|net| self.access(net, frame, false))
                    else {
                        return;
                    };
                    ports.writes.push([address, data, enable, clk]);
                }
            }
            self.module.memories.push(ports);
        }
    }

    fn access(&mut self, slot: NetSlot, frame: u32, is_input: bool) -> Option<Range<usize>> {
        let net = self.net(slot, frame);
        let Some(width) = self.declared_width(slot, frame) else {
            self.failed = true;
            return None;
        };
        self.give_width(net, width);
        self.module.nets[net].width?;
        let ports = if is_input { &self.module.inputs } else { &self.module.outputs };
        let first = ports.iter().map(|port| port.width as usize).sum();
        if is_input {
            self.input(net);
        } else {
            self.output(net);
        }
        Some(first..first + width as usize)
    }
}
