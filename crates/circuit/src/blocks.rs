//! Blocks: the calls that cells come from, as a tree.

#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
pub struct BlockId(u32);

impl BlockId {
    pub const TOP: Self = Self(0);
}

#[derive(Clone, Debug, PartialEq, Eq)]
struct Block {
    name: String,
    circuit: String,
    outer: BlockId,
}

#[derive(Clone, Debug, Default)]
pub struct Blocks {
    /// All but the outermost, each after the one around it.
    inner: Vec<Block>,
    of: Vec<BlockId>,
}

pub fn keeps_state(circuit: &str) -> bool {
    ["register", "latch"].contains(&circuit)
}

impl Blocks {
    pub fn add(&mut self, name: impl Into<String>, circuit: impl Into<String>, outer: BlockId) -> BlockId {
        self.inner.push(Block { name: name.into(), circuit: circuit.into(), outer });
        BlockId(self.inner.len() as u32)
    }

    /// The blocks from the outermost call to this one; empty for the circuit itself.
    pub fn around(&self, block: BlockId) -> Vec<BlockId> {
        let mut around: Vec<BlockId> =
            std::iter::successors(Some(block), |&block| Some(self.block(block)?.outer)).collect();
        around.pop();
        around.reverse();
        around
    }

    pub fn name(&self, block: BlockId) -> &str {
        self.block(block).map_or("", |block| &block.name)
    }

    pub fn circuit(&self, block: BlockId) -> &str {
        self.block(block).map_or("", |block| &block.circuit)
    }

    fn block(&self, block: BlockId) -> Option<&Block> {
        (block.0 as usize).checked_sub(1).map(|at| &self.inner[at])
    }

    pub(crate) fn of(&self, node: usize) -> BlockId {
        self.of.get(node).copied().unwrap_or_default()
    }

    pub(crate) fn put(&mut self, node: usize, block: BlockId) {
        if block != BlockId::TOP || node < self.of.len() {
            self.of.resize(self.of.len().max(node + 1), BlockId::TOP);
            self.of[node] = block;
        }
    }

    pub(crate) fn without_nodes(&self) -> Self {
        Self { inner: self.inner.clone(), of: Vec::new() }
    }
}
