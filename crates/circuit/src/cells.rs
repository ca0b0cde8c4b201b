//! Cell libraries: the functions for which there are robots, and the cost of each in robots and cycles.

use std::collections::BTreeMap;

use crate::{NetId, Netlist};
use nbc_base::model::Function;

#[derive(Clone, Debug, PartialEq)]
pub struct CellKind {
    pub cost: u32,
    /// Cycles for which its inputs must be held so that its output is correct, for any earlier inputs.
    pub clock: u32,
    /// Smallest displacement in the correct direction at the end of a hold, in voxels per cycle.
    pub margin: f64,
    /// How far a world may differ before it makes errors; 0 if that was not measured.
    pub radius: f64,
    /// Whether its output may change for a while when its inputs switch, although it is to stay.
    pub glitches: bool,
}

impl CellKind {
    pub const fn uniform(clock: u32, margin: f64) -> Self {
        Self { cost: 1, clock, margin, radius: 0.0, glitches: false }
    }
}

#[derive(Clone, Debug, Default, PartialEq)]
pub struct CellLibrary {
    // Functions of two inputs come before those of three.
    kinds: BTreeMap<Function, CellKind>,
}

impl CellLibrary {
    pub fn uniform(functions: impl IntoIterator<Item = Function>) -> Self {
        functions.into_iter().map(|function| (function, CellKind::uniform(1, 1.0))).collect()
    }

    pub fn insert(&mut self, function: Function, kind: CellKind) {
        self.kinds.insert(function, kind);
    }

    pub fn get(&self, function: Function) -> Option<&CellKind> {
        self.kinds.get(&function)
    }

    pub fn kinds_of<'a>(&'a self, netlist: &'a Netlist) -> impl Fn(NetId) -> &'a CellKind {
        const OTHER: CellKind = CellKind::uniform(1, 0.0);
        move |id| netlist.cell(id).and_then(|cell| self.get(cell.function)).unwrap_or(&OTHER)
    }

    pub fn functions(&self) -> impl Iterator<Item = Function> + '_ {
        self.kinds().map(|(function, _)| function)
    }

    pub fn is_wide(&self) -> bool {
        self.kinds.last_key_value().is_some_and(|(function, _)| function.inputs() == 3)
    }

    pub fn kinds(&self) -> impl Iterator<Item = (Function, &CellKind)> {
        self.all().filter(|(function, _)| function.inputs() == 2)
    }

    pub fn all(&self) -> impl Iterator<Item = (Function, &CellKind)> {
        self.kinds.iter().map(|(&function, kind)| (function, kind))
    }

    pub(crate) fn with(&self, quality: fn(&CellKind) -> f64, least: f64) -> Self {
        self.all().filter(|(_, kind)| quality(kind) >= least).map(|(f, kind)| (f, kind.clone())).collect()
    }

    pub fn is_complete(&self) -> bool {
        self.reachable() == u16::MAX
    }

    /// Each of these alone would make the library complete; empty if it is complete or needs more than one.
    pub fn completions(&self) -> Vec<Function> {
        if self.is_complete() {
            return Vec::new();
        }
        let completes = |&function: &Function| {
            let mut more = self.clone();
            more.insert(function, CellKind::uniform(1, 1.0));
            more.is_complete()
        };
        Function::all().filter(completes).collect()
    }

    /// The two-input functions that can be made, bit `f` for the function with bits `f`; constants are free stimuli.
    pub fn reachable(&self) -> u16 {
        let mut set = START;
        loop {
            let made = self.functions().fold(set, |set, function| set | compositions(function, set));
            if made == set {
                return set;
            }
            set = made;
        }
    }
}

const START: u16 = 1 << 0b0000 | 1 << 0b1111 | 1 << 0b1100 | 1 << 0b1010;

fn compositions(function: Function, set: u16) -> u16 {
    let members = || (0..16u8).filter(move |f| set >> f & 1 == 1);
    members().flat_map(|a| members().map(move |b| (a, b))).fold(0, |made, (a, b)| made | 1 << compose(function, a, b))
}

pub(crate) fn compose(function: Function, a: u8, b: u8) -> u8 {
    (0..4).fold(0, |bits, i| bits | u8::from(function.output(a >> i & 1 == 1, b >> i & 1 == 1)) << i)
}

impl FromIterator<(Function, CellKind)> for CellLibrary {
    fn from_iter<I: IntoIterator<Item = (Function, CellKind)>>(kinds: I) -> Self {
        Self { kinds: kinds.into_iter().collect() }
    }
}

#[cfg(test)]
mod tests {
    use crate::example::library;

    #[test]
    fn completeness_counts_constants_as_free() {
        assert!(library("nand").is_complete());
        assert!(library("nor").is_complete());
        assert!(library("a_and_notb").is_complete());
        assert!(library("xor and").is_complete());
        assert!(!library("xor xnor not").is_complete());
        assert!(!library("and or").is_complete());
        assert!(!library("not").is_complete());
    }

    #[test]
    fn functions_that_complete_a_library_are_listed() {
        let names = |cells| library(cells).completions().iter().map(|f| f.name()).collect::<Vec<_>>().join(" ");
        assert_eq!(names("xor not"), "nor nota_and_b a_and_notb nand and nota_or_b a_or_notb or");
        assert_eq!(
            names("and or"),
            "nor nota_and_b nota a_and_notb notb xor nand xnor nota_or_b a_or_notb".replace("nota ", "not ")
        );
        assert_eq!(names("nand"), "");
    }
}
