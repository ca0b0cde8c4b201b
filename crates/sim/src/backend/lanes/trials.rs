//! Trials: simulations from a fresh start, many at once. A lane whose run is done takes the next one.

use std::sync::{Mutex, PoisonError};

use crate::backend::lanes::group::LaneGroup;
use crate::backend::lanes::threads;
use crate::backend::lanes::world::World;
use crate::backend::run::{Run, runs};
use nbc_base::model::{Setting, Trajectory, Trial};

struct Waiting<'a> {
    run: Run,
    trajectory: &'a mut Trajectory,
}

pub fn run_trials(world: &World, setting: &Setting, trials: &[Trial]) -> Vec<Trajectory> {
    let mut trajectories = vec![Trajectory::default(); trials.len()];
    let runs = runs(&world.constants, setting, trials.iter().map(|trial| &trial.body));
    let mut waiting: Vec<Waiting<'_>> = Vec::with_capacity(trials.len());
    for ((mut run, trial), trajectory) in runs.into_iter().zip(trials).zip(&mut trajectories) {
        run.assign(&trial.schedule);
        trajectory.push(run.center);
        if !run.is_done() {
            waiting.push(Waiting { run, trajectory });
        }
    }
    waiting.sort_by_key(|waiting| (waiting.run.lattice.size(), waiting.run.body));
    let mut boxes: Vec<Vec<Waiting<'_>>> = Vec::new();
    for next in waiting {
        match boxes.last_mut() {
            Some(same) if same[0].run.lattice.size() == next.run.lattice.size() => same.push(next),
            _ => boxes.push(vec![next]),
        }
    }
    threads::for_each(&mut boxes, |same_box| run_box(std::mem::take(same_box), world));
    trajectories
}

fn run_box(waiting: Vec<Waiting<'_>>, world: &World) {
    let lanes = threads::lanes_for(waiting.len(), world.kernel.lanes());
    let workers = waiting.len().div_ceil(lanes).min(threads::count());
    let queue = Mutex::new(waiting.into_iter());
    threads::for_each(&mut vec![(); workers], |()| {
        let (mut runs, mut trajectories) = (Vec::with_capacity(lanes), Vec::with_capacity(lanes));
        loop {
            let room = lanes - runs.len();
            for Waiting { run, trajectory } in queue.lock().unwrap_or_else(PoisonError::into_inner).by_ref().take(room)
            {
                runs.push(run);
                trajectories.push(trajectory);
            }
            if runs.is_empty() {
                break;
            }
            let mut group = LaneGroup::new(runs);
            group.advance(world, |run, at| trajectories[run].push(at.center));
            (runs, trajectories) = keep_going(group.take(), trajectories);
        }
    });
}

fn keep_going(runs: Vec<Run>, trajectories: Vec<&mut Trajectory>) -> (Vec<Run>, Vec<&mut Trajectory>) {
    let mut going = (Vec::with_capacity(runs.len()), Vec::with_capacity(runs.len()));
    for (run, trajectory) in runs.into_iter().zip(trajectories) {
        if run.is_done() {
            trajectory.fault = run.fault;
        } else {
            going.0.push(run);
            going.1.push(trajectory);
        }
    }
    going
}
