//! Workers that simulate parts for a [`LocalShell`](crate::LocalShell).

use std::collections::VecDeque;
use std::sync::{Arc, Mutex, Weak};

use crate::crew_part::{CrewPart, CrewResult, GivenParts};
use crate::lock::lock;
use crate::shell::Crew;

#[derive(Default)]
pub struct LocalCrew {
    state: Mutex<State>,
}

#[derive(Default)]
struct State {
    size: usize,
    next: usize,
    waiting: VecDeque<(usize, CrewPart)>,
    /// Parts with awaited results: the number of the first, and how many there are.
    given: Vec<(usize, usize, Weak<GivenParts>)>,
}

impl State {
    fn home(&self, number: usize) -> Option<(Arc<GivenParts>, usize)> {
        let around = |(first, count, _): &&(usize, usize, _)| (*first..first + count).contains(&number);
        let (first, _, given) = self.given.iter().find(around)?;
        Some((given.upgrade()?, number - first))
    }
}

impl LocalCrew {
    /// With no workers, missing results will not come.
    pub fn set_size(&self, size: usize) {
        lock(&self.state).size = size;
    }

    pub fn next_part(&self) -> Option<(usize, CrewPart)> {
        let state = &mut *lock(&self.state);
        loop {
            let (number, part) = state.waiting.pop_front()?;
            if state.home(number).is_some() {
                return Some((number, part));
            }
        }
    }

    pub fn receive(&self, number: usize, result: CrewResult) {
        let state = &mut *lock(&self.state);
        if let Some((given, place)) = state.home(number) {
            given.put(place, result);
        }
        state.given.retain(|(.., given)| given.strong_count() > 0);
    }
}

impl Crew for LocalCrew {
    fn size(&self) -> usize {
        lock(&self.state).size
    }

    fn give(&self, parts: Vec<CrewPart>) -> Arc<GivenParts> {
        let state = &mut *lock(&self.state);
        let (first, given) = (state.next, Arc::new(GivenParts::new(parts.len())));
        state.next += parts.len();
        state.given.push((first, parts.len(), Arc::downgrade(&given)));
        state.waiting.extend((first..).zip(parts));
        given
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn results_go_to_those_who_wait_for_them_and_others_are_dropped() {
        let trials = nbc_session::BodySearch::new(None, [2, 2], 1, 1).ask(|_| false);
        let parts = |count| vec![CrewPart::Bodies(Box::new(trials.clone())); count];
        let crew = LocalCrew::default();
        let (first, second) = (crew.give(parts(2)), crew.give(parts(1)));
        drop(crew.give(parts(3)));
        let numbers: Vec<usize> = std::iter::from_fn(|| crew.next_part()).map(|(number, _)| number).collect();
        assert_eq!(numbers, [0, 1, 2], "nobody waits for the last three");
        let result = CrewResult::Bodies(vec![None]);
        crew.receive(1, result.clone());
        crew.receive(2, result.clone());
        crew.receive(4, result.clone());
        assert_eq!((first.take(), second.take()), (None, Some(vec![result.clone()])));
        crew.receive(0, result.clone());
        assert_eq!(first.take(), Some(vec![result; 2]));
        assert_eq!(first.take(), None, "results are taken once");
    }
}
