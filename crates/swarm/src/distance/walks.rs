//! What bodies did in the simulations of the distance objective, remembered while a program runs.

use std::collections::BTreeMap;
use std::sync::{Mutex, MutexGuard, PoisonError};

use crate::evaluation::EvaluationProtocol;
use crate::evolve::CandidateOutcome;
use nbc_base::model::{Body, Fault, FaultKind, Pattern};

/// Bodies in each half. Searches of small boxes draw a body again after thousands of others. Both halves take some tens
/// of megabytes.
const HALF: usize = 50_000;

/// What is known of a body. It depends on the protocol and the body alone.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Walks {
    /// The displacement under each constant pattern that was simulated, in voxels, or the fault.
    pub fixed: BTreeMap<Pattern, Result<f64, Fault>>,
    pub long: Option<LongWalk>,
}

#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct LongWalk {
    /// The sum of distances, or why the body has none.
    pub walked: Result<f64, CandidateOutcome>,
    /// Its env steps, besides those of the fixed simulation with which it begins.
    pub env_steps: u32,
}

impl Walks {
    /// Whether nothing ended a simulation from outside.
    fn is_whole(&self) -> bool {
        let is_stopped = |fault: &Fault| fault.kind == FaultKind::Stopped;
        let long = self.long.map(|long| long.walked);
        !self.fixed.values().any(|walked| walked.as_ref().is_err_and(is_stopped))
            && !matches!(long, Some(Err(CandidateOutcome::Faulty(fault))) if is_stopped(&fault))
    }
}

/// The simulations of recently evaluated bodies. Results do not depend on it.
#[derive(Debug, Default)]
pub struct WalkMemory(Mutex<Remembered>);

/// When the recent half is full, it takes the place of the other one.
#[derive(Debug, Default)]
struct Remembered {
    protocols: Vec<EvaluationProtocol>,
    recent: BTreeMap<(usize, Body), Walks>,
    older: BTreeMap<(usize, Body), Walks>,
}

impl WalkMemory {
    pub(crate) fn recall<'a>(
        &self,
        protocol: &EvaluationProtocol,
        bodies: impl Iterator<Item = (&'a Body, &'a mut Walks)>,
    ) {
        let mut memory = self.lock();
        let number = memory.number(protocol);
        for (body, walks) in bodies {
            let key = (number, body.clone());
            if let Some(known) = memory.recent.get(&key).or_else(|| memory.older.get(&key)) {
                walks.clone_from(known);
            }
        }
    }

    pub(crate) fn keep<'a>(&self, protocol: &EvaluationProtocol, bodies: impl Iterator<Item = (&'a Body, &'a Walks)>) {
        let mut memory = self.lock();
        let number = memory.number(protocol);
        for (body, walks) in bodies.filter(|(_, walks)| walks.is_whole()) {
            if memory.recent.len() >= HALF {
                memory.older = std::mem::take(&mut memory.recent);
            }
            memory.recent.insert((number, body.clone()), walks.clone());
        }
    }

    #[cfg(test)]
    pub(crate) fn len(&self) -> usize {
        let memory = self.lock();
        memory.recent.len() + memory.older.len()
    }

    fn lock(&self) -> MutexGuard<'_, Remembered> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

impl Remembered {
    fn number(&mut self, protocol: &EvaluationProtocol) -> usize {
        let known = self.protocols.iter().position(|known| known == protocol);
        known.unwrap_or_else(|| {
            self.protocols.push(protocol.clone());
            self.protocols.len() - 1
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use nbc_base::model::Palette;

    #[test]
    fn the_memory_is_bounded_and_keeps_protocols_apart() {
        let memory = WalkMemory::default();
        let protocol = EvaluationProtocol::of(&crate::evolve::tests::evolution());
        let other = EvaluationProtocol { fixed_steps: 1, ..protocol.clone() };
        let body =
            |number: usize| Body::new(6, 1, (0..6).map(|i| (number >> (3 * i) & 7) as u8).collect(), Palette::paper());
        let walks = Walks { fixed: BTreeMap::from([(Pattern::default(), Ok(1.0))]), long: None };
        let recalled = |protocol: &EvaluationProtocol, number: usize| {
            let mut found = Walks::default();
            memory.recall(protocol, std::iter::once((&body(number), &mut found)));
            found
        };
        for number in 0..2 * HALF + 2 {
            memory.keep(&protocol, std::iter::once((&body(number), &walks)));
            assert_eq!(recalled(&protocol, number), walks);
        }
        assert!(memory.len() <= 2 * HALF);
        assert_eq!(recalled(&protocol, 2 * HALF), walks);
        assert_eq!(recalled(&protocol, 0), Walks::default(), "forgotten");
        assert_eq!(recalled(&other, 2 * HALF), Walks::default());
    }
}
