//! Lists without duplicates, such as gates of which equal ones are shared.

use std::collections::BTreeMap;

#[derive(Clone, Debug)]
pub struct Interned<T> {
    pub items: Vec<T>,
    known: BTreeMap<T, usize>,
}

impl<T> Default for Interned<T> {
    fn default() -> Self {
        Self { items: Vec::new(), known: BTreeMap::new() }
    }
}

impl<T: Clone + Ord> Interned<T> {
    /// The number of an item; adds it unless an equal one exists.
    pub fn number(&mut self, item: T) -> usize {
        *self.known.entry(item).or_insert_with_key(|item| {
            self.items.push(item.clone());
            self.items.len() - 1
        })
    }
}
