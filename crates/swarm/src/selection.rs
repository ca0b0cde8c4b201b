//! Selects the best robot of a behavior among the elites of evolution runs: many are screened in short sequences, few
//! measured in full.

use std::cmp::Ordering;

use crate::evolve::Elite;
use crate::{Executor, Measurement, Task, TaskResult};
use nbc_base::model::{Behavior, Fault, Provenance, Robot};

/// The longest clock of a gate that is measured in full, in cycles.
const LONGEST_CLOCK: u32 = 4;
pub const MEASUREMENT_COST: u64 = 4;

#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Selection {
    pub tries: usize,
    pub finalists: usize,
    pub max_error: f64,
    /// The margin in voxels per cycle from which on a robot is better than all below it, whatever their clocks.
    pub wide_margin: f64,
}

#[derive(Clone, Debug, PartialEq)]
pub struct RobotCandidate {
    pub elite: Elite,
    pub provenance: Provenance,
}

#[derive(Clone, Debug, PartialEq)]
pub enum Selected {
    Robot(Box<Robot>),
    Erring(Box<Robot>),
    /// The best elite walks otherwise in the paper's fixed simulations.
    Other(Behavior),
    Faulty(Fault),
    Missing,
}

impl Selection {
    pub fn candidates_of(&self, mut candidates: Vec<RobotCandidate>) -> Vec<RobotCandidate> {
        candidates.sort_by(|a, b| worth(&b.elite).total_cmp(&worth(&a.elite)));
        let mut chosen: Vec<RobotCandidate> = Vec::new();
        for candidate in candidates {
            if chosen.len() < self.tries && chosen.iter().all(|known| known.elite.body != candidate.elite.body) {
                chosen.push(candidate);
            }
        }
        chosen
    }

    pub fn cost(&self, candidates: usize) -> u64 {
        candidates as u64 + MEASUREMENT_COST * candidates.min(self.finalists) as u64
    }

    /// Reports the work done to `observe`. `None` if it was stopped; `run` is the number that the executor asks for.
    pub fn select(
        &self,
        executor: &dyn Executor,
        run: usize,
        behavior: Behavior,
        candidates: &[RobotCandidate],
        observe: &dyn Fn(u64),
    ) -> Option<Selected> {
        let screening = |candidate: &RobotCandidate| {
            let body = candidate.elite.body.clone();
            Task::Screening { body, behavior, most: LONGEST_CLOCK }
        };
        let screenings: Vec<Task> = candidates.iter().map(screening).collect();
        let screened = executor.perform(run, &screenings, &|| observe(1))?;
        let rank = |(result, candidate)| (Rank::of(result, candidate, self.wide_margin), candidate);
        let ranks = screened.into_iter().zip(candidates).map(rank);
        let mut ranked: Vec<(Rank, &RobotCandidate)> = ranks.collect();
        ranked.sort_by(|(a, _), (b, _)| a.compare(b));
        let finalists: Vec<&RobotCandidate> =
            ranked.into_iter().take(self.finalists).map(|(_, candidate)| candidate).collect();
        let measurements: Vec<Task> =
            finalists.iter().map(|candidate| Task::Measurement(candidate.elite.body.clone())).collect();
        let measured = executor.perform(run, &measurements, &|| observe(MEASUREMENT_COST))?;
        let judged =
            measured.into_iter().zip(finalists).map(|(result, candidate)| self.judge(result, behavior, candidate));
        Some(judged.min_by(|a, b| a.compare(b, self.wide_margin)).unwrap_or(Selected::Missing))
    }

    fn judge(&self, result: TaskResult, behavior: Behavior, candidate: &RobotCandidate) -> Selected {
        let measurement = match result.measured() {
            Ok(measurement) => measurement,
            Err(fault) => return Selected::Faulty(fault),
        };
        if measurement.behavior != behavior {
            return Selected::Other(measurement.behavior);
        }
        let robot = Box::new(robot(candidate, measurement));
        if robot.character.error_rate <= self.max_error { Selected::Robot(robot) } else { Selected::Erring(robot) }
    }
}

impl Selected {
    fn compare(&self, other: &Self, wide_margin: f64) -> Ordering {
        let place = |found: &Self| match found {
            Self::Robot(_) => 0,
            Self::Erring(_) => 1,
            Self::Other(_) => 2,
            Self::Faulty(_) => 3,
            Self::Missing => 4,
        };
        match (self, other) {
            (Self::Robot(a) | Self::Erring(a), Self::Robot(b) | Self::Erring(b)) => {
                let is_thin = |robot: &Robot| robot.character.margin < wide_margin;
                is_thin(a).cmp(&is_thin(b)).then(a.character.compare(&b.character))
            }
            _ => place(self).cmp(&place(other)),
        }
    }
}

/// The result of a candidate in short sequences: its clock and margin, or its fitness if no clock was without errors.
struct Rank {
    is_thin: bool,
    clock: u32,
    margin: f64,
}

impl Rank {
    fn of(result: TaskResult, candidate: &RobotCandidate, wide_margin: f64) -> Self {
        match result.screened() {
            Ok(Some((clock, margin))) => Self { is_thin: margin < wide_margin, clock, margin },
            // A fault or errors at every clock: ranked last.
            Ok(None) | Err(_) => Self { is_thin: true, clock: LONGEST_CLOCK + 1, margin: worth(&candidate.elite) },
        }
    }

    fn compare(&self, other: &Self) -> Ordering {
        (self.is_thin.cmp(&other.is_thin)).then(self.clock.cmp(&other.clock)).then(other.margin.total_cmp(&self.margin))
    }
}

fn worth(elite: &Elite) -> f64 {
    elite.fitness[0] + elite.fitness[1]
}

fn robot(candidate: &RobotCandidate, measurement: Measurement) -> Robot {
    let Measurement { displacement, behavior, character } = measurement;
    let (body, function) = (&candidate.elite.body, behavior.function());
    Robot {
        name: format!("{function}_{}x{}", body.width(), body.height()),
        behavior,
        body: body.clone(),
        displacement,
        character,
        provenance: candidate.provenance.clone(),
        genotype: candidate.elite.genotype.clone(),
    }
}

#[cfg(test)]
mod tests {
    use std::cell::Cell;

    use super::*;
    use crate::{LocalExecutor, measure};
    use nbc_base::model::{Body, Displacements, Palette};
    use nbc_sim::Simulator;

    const SELECTION: Selection = Selection { tries: 3, finalists: 2, max_error: 0.0, wide_margin: f64::NEG_INFINITY };

    fn candidate(rows: &[&str], fitness: f64) -> RobotCandidate {
        let elite = Elite {
            fitness: [fitness, 0.0],
            behavior: "RRRR".parse().unwrap(),
            displacement: Displacements::zero(2),
            body: Body::parse(rows, &Palette::paper()).unwrap(),
            genotype: None,
            generation: 1,
            evaluations: 1,
        };
        RobotCandidate { elite, provenance: Provenance::default() }
    }

    #[test]
    fn the_fittest_are_screened_each_body_once() {
        let candidates = [(["33"], 1.0), (["34"], 3.0), (["34"], 2.0), (["43"], 2.5), (["44"], 0.5)];
        let chosen = SELECTION.candidates_of(candidates.map(|(rows, fitness)| candidate(&rows, fitness)).to_vec());
        let fitnesses: Vec<f64> = chosen.iter().map(|candidate| candidate.elite.fitness[0]).collect();
        assert_eq!(fitnesses, [3.0, 2.5, 1.0]);
    }

    #[test]
    fn the_work_reported_is_the_work_announced() {
        // Without errors at the first clock, which takes the shortest time.
        let selection = Selection { finalists: 1, ..SELECTION };
        let candidates = [&["33", "34"], &["33", "43"]].map(|rows| candidate(rows, 1.0));
        let done = Cell::new(0);
        let observe = |more| done.set(done.get() + more);
        selection.select(&LocalExecutor::default(), 0, "RRRR".parse().unwrap(), &candidates, &observe);
        assert_eq!(done.get(), selection.cost(candidates.len()));
        let found = selection
            .select(&LocalExecutor::default(), 0, "RRRR".parse().unwrap(), &[], &|_| panic!("there is no work"));
        assert_eq!((found, selection.cost(0)), (Some(Selected::Missing), 0));
    }

    #[test]
    fn a_slower_robot_with_a_wide_margin_is_better_than_a_quick_thin_one() {
        let rank = |clock, margin, wide| {
            let result = TaskResult::Screening(Ok(Some((clock, margin))));
            Rank::of(result, &candidate(&["34"], 1.0), wide)
        };
        let order = |wide| rank(1, 0.001, wide).compare(&rank(2, 0.4, wide));
        assert_eq!((order(0.0), order(0.1)), (Ordering::Less, Ordering::Greater));
    }

    #[test]
    fn a_robot_that_errs_is_left_out_unless_it_is_allowed_to() {
        let body = Body::parse(&["33", "34"], &Palette::paper()).unwrap();
        let measured = measure(&Simulator::default(), &body).unwrap();
        let judge = |behavior, max_error| {
            let result = TaskResult::Measurement(Ok(measured.clone()));
            Selection { max_error, ..SELECTION }.judge(result, behavior, &candidate(&["34"], 1.0))
        };
        let own = measured.behavior;
        assert!(matches!(judge(own, measured.character.error_rate), Selected::Robot(_)));
        assert!(matches!(judge(own, -1.0), Selected::Erring(robot) if robot.behavior == own));
        let other = ["RRRR", "LLLL"].map(|word| word.parse().unwrap()).into_iter().find(|&other| other != own).unwrap();
        assert_eq!(judge(other, 1.0), Selected::Other(own));
    }
}
