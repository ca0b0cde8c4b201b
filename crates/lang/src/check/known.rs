//! What a check leaves for the next one: the circuits that are written as before, among the same names.

use std::collections::BTreeMap;

use crate::check::circuit::{CheckedCircuit, Header};
use crate::check::names::{Home, Names};
use crate::syntax::KnownTexts;
use nbc_base::source::{Sources, Span};
use nbc_circuit::elaborate::KeptModules;

/// Parts of the last checks that the next one may need again.
#[derive(Default)]
pub struct LastChecks {
    pub(crate) texts: KnownTexts,
    /// Of the prelude, which knows only its own names.
    pub(crate) prelude: BTreeMap<String, KnownCircuit>,
    /// By the names of the checked files.
    pub(crate) files: BTreeMap<String, KnownCircuits>,
}

/// By their own text.
#[derive(Default)]
pub(crate) struct KnownCircuits {
    headers: Vec<(Home, Header)>,
    /// Of what is not a circuit.
    names: Vec<String>,
    pub(crate) circuits: BTreeMap<String, KnownCircuit>,
    pub(crate) modules: KeptModules,
}

impl KnownCircuits {
    pub(crate) fn is_empty(&self) -> bool {
        self.headers.is_empty()
    }

    /// Forgets everything if a circuit could name something else now.
    pub(crate) fn begin(&mut self, homes: &[Home], headers: &[Header], names: Vec<String>) {
        let now = || homes.iter().zip(headers);
        let is_same = |((home, header), (known, before)): ((&Home, &Header), &(Home, Header))| {
            home == known && header.face() == before.face()
        };
        if self.names != names || self.headers.len() != headers.len() || !now().zip(&self.headers).all(is_same) {
            let headers = now().map(|(home, header)| (*home, header.clone())).collect();
            *self = Self { headers, names, ..Self::default() };
        }
    }
}

/// A circuit without faults that names only its own nets and numbers, and circuits.
pub(crate) struct KnownCircuit {
    pub(crate) home: Home,
    /// Of its declaration.
    span: Span,
    checked: CheckedCircuit,
    /// The names of circuits in it.
    called: Vec<Span>,
}

impl KnownCircuit {
    /// `before` are the numbers of uses before the check.
    pub(crate) fn of(
        home: Home,
        span: Span,
        checked: &CheckedCircuit,
        names: &Names,
        (circuits, others): (usize, usize),
    ) -> Option<Self> {
        let is_own = checked.uses.iter().all(|found| found.place.is_in(span) && found.declared.is_in(span));
        let is_known = checked.diagnostics.is_empty() && is_own && names.counts().1 == others;
        let called = || names.circuits.places_from(circuits);
        is_known.then(|| Self { home, span, checked: checked.clone(), called: called() })
    }

    /// The same circuit, declared at another place.
    pub(crate) fn at(&self, span: Span, names: &Names, sources: &Sources) -> CheckedCircuit {
        let moved = |place: Span| place.moved(self.span, span);
        let mut checked = self.checked.clone();
        checked.circuit.each_span(&mut |place| *place = moved(*place));
        checked.calls.iter_mut().for_each(|(_, place)| *place = moved(*place));
        for found in &mut checked.uses {
            (found.place, found.declared) = (moved(found.place), moved(found.declared));
        }
        for place in self.called.iter().map(|&place| moved(place)) {
            names.circuits.refer_to(sources.text(place), place, self.home);
        }
        checked
    }
}
