//! Robots that are asked for: the best of a behavior among the elites of runs, or a body that somebody wrote.

#[cfg(feature = "disk")]
use std::collections::BTreeMap;

#[cfg(feature = "disk")]
use crate::store::Checkpoint;
use nbc_base::diag::suggest::nearest;
#[cfg(feature = "disk")]
use nbc_base::model::Axis;
use nbc_base::model::{Behavior, Body, Function, Genotype, Provenance, Robot};
#[cfg(feature = "disk")]
use nbc_swarm::evolve::images;
use nbc_swarm::{Executor, MEASUREMENT_COST, Measurement, RobotCandidate, Selected, Selection, Task};

/// A robot that is asked for.
#[derive(Clone, Debug)]
pub enum RobotRequest {
    Behavior(Behavior, Vec<RobotCandidate>),
    Own(Box<OwnBody>),
}

/// A body that is to become a robot.
#[derive(Clone, Debug)]
pub struct OwnBody {
    pub name: String,
    pub body: Body,
    pub provenance: Provenance,
    pub genotype: Option<Genotype>,
    pub max_error: f64,
}

impl RobotRequest {
    /// An elite in an archive of classes stands for all behaviors of its class.
    #[cfg(feature = "disk")]
    pub fn of_runs<'a>(
        runs: impl IntoIterator<Item = &'a Checkpoint>,
        behaviors: &[Behavior],
        selection: &Selection,
    ) -> Vec<Self> {
        let mut candidates: BTreeMap<Behavior, Vec<RobotCandidate>> =
            behaviors.iter().map(|&behavior| (behavior, Vec::new())).collect();
        for run in runs {
            if behaviors.is_empty() {
                for behavior in Behavior::all(run.declared.palette.inputs()).filter(|one| is_usual(*one)) {
                    candidates.entry(behavior).or_default();
                }
            }
            let has_classes = run.declared.descriptors.contains(&Axis::Class);
            for elite in run.state.niches.iter().flat_map(|(_, elites)| elites) {
                let shown = if has_classes { images(elite) } else { vec![elite.clone()] };
                for elite in shown {
                    if let Some(found) = candidates.get_mut(&elite.behavior) {
                        let provenance = Provenance {
                            program: nbc_base::PROGRAM.to_owned(),
                            version: run.version.clone(),
                            evolution: run.declared.name.clone(),
                            seed: run.state.seed,
                            generation: elite.generation,
                            evaluations: elite.evaluations,
                        };
                        found.push(RobotCandidate { elite, provenance });
                    }
                }
            }
        }
        let mut requests: Vec<_> =
            candidates.into_iter().map(|(behavior, found)| (behavior, selection.candidates_of(found))).collect();
        requests.sort_by_key(|(behavior, _)| behavior.function());
        requests.into_iter().map(|(behavior, found)| Self::Behavior(behavior, found)).collect()
    }

    pub fn cost(&self, selection: &Selection) -> u64 {
        match self {
            Self::Behavior(_, candidates) => selection.cost(candidates.len()),
            Self::Own(_) => MEASUREMENT_COST,
        }
    }

    /// `observe` receives the work done; `run` is passed to the executor. `None` if the work was stopped.
    pub fn select(
        &self,
        selection: &Selection,
        executor: &dyn Executor,
        run: usize,
        observe: &dyn Fn(u64),
    ) -> Option<Selected> {
        let own = match self {
            Self::Behavior(behavior, candidates) => {
                return selection.select(executor, run, *behavior, candidates, observe);
            }
            Self::Own(own) => own,
        };
        let task = Task::Measurement(own.body.clone());
        let measured = executor.perform(run, &[task], &|| observe(MEASUREMENT_COST))?.pop()?.measured();
        Some(match measured {
            Err(fault) => Selected::Faulty(fault),
            Ok(Measurement { displacement, behavior, character }) => {
                let OwnBody { name, body, provenance, genotype, max_error } = (**own).clone();
                let is_right = character.error_rate <= max_error;
                let robot = Box::new(Robot { name, behavior, body, displacement, character, provenance, genotype });
                if is_right { Selected::Robot(robot) } else { Selected::Erring(robot) }
            }
        })
    }

    /// `None` if the simulation of a body failed.
    pub fn behavior(&self, selected: &Selected) -> Option<Behavior> {
        match (self, selected) {
            (Self::Behavior(behavior, _), _) => Some(*behavior),
            (_, Selected::Robot(robot) | Selected::Erring(robot)) => Some(robot.behavior),
            _ => None,
        }
    }
}

/// A behavior by its letters such as `RRRL`, or by its function such as `nand`.
pub fn behavior(word: &str) -> Result<Behavior, String> {
    let function = || Function::parse(word).map(Behavior::from);
    let expected = || {
        let near = nearest(word, Function::named().map(Function::name));
        let near = near.map_or(String::new(), |near| format!("; did you mean `{near}`?"));
        format!("expected four or eight letters such as `RRRL`, or a function such as `nand`{near}")
    };
    word.parse().ok().or_else(function).ok_or_else(expected)
}

impl OwnBody {
    pub fn by_hand(name: String, body: Body) -> Self {
        Self { name, body, provenance: Provenance::unevolved("by hand"), genotype: None, max_error: 1.0 }
    }
}

/// All behaviors of two stimuli; of three, those that depend on all, one for each arrangement of the stimuli.
#[cfg(feature = "disk")]
fn is_usual(behavior: Behavior) -> bool {
    let function = behavior.function();
    behavior.stimuli() == 2 || function.arity() == 3 && function.arranged() == function
}
