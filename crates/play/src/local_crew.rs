//! Others that simulate parts of a cycle, as whoever has a [`LocalShell`](crate::LocalShell) sees them: parts to be
//! taken to them, and what they bring back.

use std::collections::VecDeque;
use std::sync::Mutex;

use crate::lock::lock;
use crate::shell::Crew;
use nbc_swarm::{CyclePart, PartStates};

/// None at first.
#[derive(Default)]
pub struct LocalCrew {
    state: Mutex<State>,
}

#[derive(Default)]
struct State {
    size: usize,
    /// The number of the first part of the present cycle. Numbers go on from cycle to cycle.
    first: usize,
    /// Parts that nobody has yet.
    waiting: VecDeque<(usize, CyclePart)>,
    /// The states of the parts of the present cycle.
    done: Vec<Option<PartStates>>,
}

impl LocalCrew {
    /// Sets how many there are. What is not there when there are none will not come.
    pub fn set_size(&self, size: usize) {
        lock(&self.state).size = size;
    }

    /// The next part that nobody has yet, with its number.
    pub fn next_part(&self) -> Option<(usize, CyclePart)> {
        lock(&self.state).waiting.pop_front()
    }

    /// Takes the states of a part. Those of an earlier cycle are of no use.
    pub fn receive(&self, number: usize, states: PartStates) {
        let state = &mut *lock(&self.state);
        if let Some(place) = number.checked_sub(state.first).and_then(|at| state.done.get_mut(at)) {
            *place = Some(states);
        }
    }
}

impl Crew for LocalCrew {
    fn size(&self) -> usize {
        lock(&self.state).size
    }

    fn give(&self, parts: Vec<CyclePart>) {
        let state = &mut *lock(&self.state);
        state.first += state.done.len();
        state.done = vec![None; parts.len()];
        state.waiting = (state.first..).zip(parts).collect();
    }

    fn take(&self) -> Option<Vec<PartStates>> {
        let done = &mut lock(&self.state).done;
        let are_all_there = !done.is_empty() && done.iter().all(Option::is_some);
        are_all_there.then(|| done.iter_mut().filter_map(Option::take).collect())
    }
}
