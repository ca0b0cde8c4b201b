//! Who is simulated beside whom: many runs over the lanes of a kernel and the threads of the machine.

use std::sync::{Mutex, PoisonError};

use rayon::prelude::*;

use crate::sim::kernel::Kernel;
use crate::sim::run::{Run, World};

/// Fewer runs than this side by side leave a kernel's lanes idle; threads do not split them further.
const WORTHWHILE: usize = 4;

/// Carries all runs forward until each is done. Runs of one body come together, then runs of one box; a lane whose run is done takes the
/// next one.
pub fn carry_all(runs: &mut [Run], world: &World, kernel: Kernel) {
    let mut waiting: Vec<&mut Run> = runs.iter_mut().filter(|run| !run.is_done()).collect();
    waiting.sort_by_key(|run| (run.lattice.size(), run.body));
    let boxes: Vec<Vec<&mut Run>> = split_by_box(waiting);
    boxes.into_par_iter().for_each(|same_box| carry_box(same_box, world, kernel));
}

fn split_by_box(waiting: Vec<&mut Run>) -> Vec<Vec<&mut Run>> {
    let mut boxes: Vec<Vec<&mut Run>> = Vec::new();
    for run in waiting {
        match boxes.last_mut() {
            Some(same) if same[0].lattice.size() == run.lattice.size() => same.push(run),
            _ => boxes.push(vec![run]),
        }
    }
    boxes
}

/// Runs of one box: each thread fills its lanes from one queue, and again when a run is done.
fn carry_box(waiting: Vec<&mut Run>, world: &World, kernel: Kernel) {
    let threads = rayon::current_num_threads();
    let lanes = waiting.len().div_ceil(threads).max(WORTHWHILE).min(kernel.lanes());
    let workers = waiting.len().div_ceil(lanes).min(threads);
    let queue = Mutex::new(waiting.into_iter());
    (0..workers).into_par_iter().for_each(|_| {
        let mut aboard: Vec<&mut Run> = Vec::with_capacity(lanes);
        loop {
            let room = lanes - aboard.len();
            aboard.extend(queue.lock().unwrap_or_else(PoisonError::into_inner).by_ref().take(room));
            if aboard.is_empty() {
                break;
            }
            kernel.carry(&mut aboard, world);
            aboard.retain(|run| !run.is_done());
        }
    });
}
