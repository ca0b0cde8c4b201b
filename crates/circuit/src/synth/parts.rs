//! Parts: a large network is searched in pieces that follow each other in order, so that the time grows with its size
//! only.

use crate::network::{Network, Signal};

/// The first piece has `first` gates. The search sees a piece as a network of its own, with the stage of each input.
pub fn in_parts(
    network: &Network,
    stages: &[u32],
    first: usize,
    size: usize,
    mut search: impl FnMut(&Network, &[u32]) -> Network,
) -> Network {
    let mut parts = Parts::new(network, stages);
    let mut start = 0;
    let mut end = first.clamp(1, size);
    while start < network.gates.len() {
        end = end.min(network.gates.len());
        parts.search(start, end, &mut search);
        (start, end) = (end, end + size);
    }
    parts.finish()
}

struct Parts<'a> {
    source: &'a Network,
    /// The last gate that reads each signal of the source, counted from 1; outputs are read after all gates.
    last_read: Vec<usize>,
    result: Network,
    stages: Vec<u32>,
    made: Vec<Signal>,
}

impl<'a> Parts<'a> {
    fn new(source: &'a Network, stages: &[u32]) -> Self {
        let mut last_read = vec![0; source.signals()];
        for (i, gate) in source.gates.iter().enumerate() {
            gate.pins.iter().for_each(|&pin| last_read[pin as usize] = i + 1);
        }
        source.outputs.iter().for_each(|&output| last_read[output as usize] = source.gates.len() + 1);
        let known = 2 + source.inputs;
        let mut all = vec![0; known];
        (0..source.inputs).for_each(|i| all[2 + i] = stages.get(i).copied().unwrap_or(0));
        let made = (0..known as Signal).collect();
        Self { source, last_read, result: Network::new(source.inputs), stages: all, made }
    }

    fn search(&mut self, start: usize, end: usize, search: &mut impl FnMut(&Network, &[u32]) -> Network) {
        let base = 2 + self.source.inputs;
        let gates = &self.source.gates[start..end];
        let first = (base + start) as Signal;
        let mut inputs: Vec<Signal> = gates.iter().flat_map(|gate| gate.pins).collect();
        inputs.retain(|&pin| pin > 1 && pin < first);
        inputs.sort_unstable();
        inputs.dedup();
        let mut part = Network::new(inputs.len());
        let place = |pin: Signal| match pin {
            0 | 1 => pin,
            _ if pin < first => 2 + inputs.binary_search(&pin).expect("every pin is known") as Signal,
            _ => pin - first + 2 + inputs.len() as Signal,
        };
        for gate in gates {
            part.add(gate.function, gate.pins.map(place));
        }
        let shown: Vec<Signal> =
            (base + start..base + end).filter(|&s| self.last_read[s] > end).map(|s| s as Signal).collect();
        part.outputs = shown.iter().map(|&signal| place(signal)).collect();
        let stages: Vec<u32> = inputs.iter().map(|&input| self.stages[self.made[input as usize] as usize]).collect();
        let better = search(&part, &stages);
        self.append(&better, &inputs, &shown, base + end);
    }

    fn append(&mut self, part: &Network, inputs: &[Signal], shown: &[Signal], end: usize) {
        let mut signal: Vec<Signal> = vec![0, 1];
        signal.extend(inputs.iter().map(|&input| self.made[input as usize]));
        for gate in &part.gates {
            let pins = gate.pins.map(|pin| signal[pin as usize]);
            self.stages.push(pins.map(|pin| self.stages[pin as usize]).into_iter().max().unwrap_or(0));
            signal.push(self.result.add(gate.function, pins));
        }
        self.made.resize(end, 0);
        for (&old, &new) in shown.iter().zip(&part.outputs) {
            self.made[old as usize] = signal[new as usize];
        }
    }

    fn finish(mut self) -> Network {
        self.result.outputs = self.source.outputs.iter().map(|&output| self.made[output as usize]).collect();
        self.result
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::proof::equal;
    use nbc_base::model::Function;

    #[test]
    fn pieces_are_put_together_again() {
        let mut network = Network::new(3);
        for i in 0..20 {
            let pins = [2 + i % 5, 2 + (7 * i) % (i + 3)];
            network.add([Function::NAND, Function::XOR, Function::OR][i as usize % 3], pins);
        }
        network.outputs = vec![10, 24, 24, 3];
        for (first, size) in [(1, 1), (3, 4), (20, 50)] {
            let mut seen = 0;
            let same = in_parts(&network, &[0, 1, 2], first, size, |part, stages| {
                seen += part.gates.len();
                assert_eq!(part.inputs, stages.len());
                part.clone()
            });
            assert_eq!(seen, 20);
            assert!(equal(&network, &same).is_ok());
        }
    }
}
