//! The ports of the memories of an environment.

/// The ports of a memory, counted over the bits of the inputs and outputs of its environment; the highest bit of a port
/// comes first.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct MemoryPorts {
    /// The memory among those of the environment.
    pub memory: usize,
    /// The number of words.
    pub words: usize,
    /// The width of a word in bits.
    pub width: usize,
    /// The reads: the output bits of the address, and the input bits of the word.
    pub reads: Vec<[std::ops::Range<usize>; 2]>,
    /// The writes: the output bits of the address, the word, the enable and the clock.
    pub writes: Vec<[std::ops::Range<usize>; 4]>,
}
