//! The results of the evolution runs of one declaration: each seed's elites and progress, and the best elite of each
//! niche over all seeds.

use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;

use serde::Serialize;

use crate::discovery::Discovery;
use crate::groups::{DIFFICULTIES, group_of};
use crate::history::ProgressLine;
use crate::progress::{Course, Series};
use nbc_base::model::{Axis, Behavior, CYCLE_STEPS, Function, Image, Pattern, Schedule, SearchObjective, Spell};
use nbc_swarm::evolve::{Champion, Elite, NicheKey};

#[derive(Clone, Debug, PartialEq)]
pub struct EvolutionResults {
    pub name: String,
    pub axes: Vec<Axis>,
    pub stimuli: usize,
    /// The first image of each set that their bodies saw; empty for other objectives.
    pub images: Vec<Arc<Image>>,
    pub objective: SearchObjective,
    /// The runs by their seeds: a seed is one run, however often it was read.
    pub runs: BTreeMap<u64, SeedRun>,
}

#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct ArchiveAxis {
    pub name: &'static str,
    pub bins: usize,
}

impl ArchiveAxis {
    pub fn all(axes: &[Axis], stimuli: usize) -> Vec<Self> {
        axes.iter().map(|axis| Self { name: axis.word(), bins: axis.bins(stimuli) }).collect()
    }
}

#[derive(Clone, Debug, PartialEq)]
pub struct SeedRun {
    pub niches: Vec<(NicheKey, Vec<Elite>)>,
    pub progress: Vec<ProgressLine>,
}

impl SeedRun {
    pub fn champion(&self, behavior: Behavior) -> Option<&Elite> {
        let own = self.niches.iter().flat_map(|(_, elites)| elites).filter(|elite| elite.behavior == behavior);
        fittest(own)
    }

    pub fn champions(&self) -> Vec<Champion> {
        let champion = |behavior| {
            let fitness = self.champion(behavior)?.fitness;
            let holds = |elites: &[Elite]| elites.iter().any(|elite| elite.behavior == behavior);
            let niches = self.niches.iter().filter(|(_, elites)| holds(elites)).count();
            Some(Champion { behavior, fitness, niches })
        };
        self.behaviors().into_iter().filter_map(champion).collect()
    }

    fn behaviors(&self) -> BTreeSet<Behavior> {
        self.niches.iter().flat_map(|(_, elites)| elites).map(|elite| elite.behavior).collect()
    }
}

fn fittest<'a>(elites: impl Iterator<Item = &'a Elite>) -> Option<&'a Elite> {
    elites.fold(None, |best: Option<&Elite>, elite| match best {
        Some(best) if best.fitness[0] >= elite.fitness[0] => Some(best),
        _ => Some(elite),
    })
}

impl EvolutionResults {
    pub fn best(&self) -> BTreeMap<&NicheKey, (u64, &Elite)> {
        let mut best: BTreeMap<&NicheKey, (u64, &Elite)> = BTreeMap::new();
        for (&seed, run) in &self.runs {
            for (key, elites) in &run.niches {
                let Some(elite) = fittest(elites.iter()) else { continue };
                let held = best.entry(key).or_insert((seed, elite));
                if elite.fitness[0] > held.1.fitness[0] {
                    *held = (seed, elite);
                }
            }
        }
        best
    }

    pub fn champion(&self, behavior: Behavior) -> Option<&Elite> {
        fittest(self.runs.values().filter_map(|run| run.champion(behavior)))
    }

    pub fn shown(&self, cycles: u32) -> Schedule {
        let spell = |pattern| Spell::of(pattern, cycles * CYCLE_STEPS);
        let seen = |(set, image): (usize, &Arc<Image>)| Spell {
            image: Some(Arc::clone(image)),
            ..spell(Schedule::of_set(set))
        };
        let spells = match self.images[..] {
            [] => Pattern::all(self.stimuli).map(spell).collect(),
            [..] => self.images.iter().enumerate().map(seen).collect(),
        };
        Schedule { spells }
    }

    pub fn named_axes(&self) -> Vec<ArchiveAxis> {
        ArchiveAxis::all(&self.axes, self.stimuli)
    }

    pub fn niche_count(&self) -> usize {
        self.axes.iter().map(|axis| axis.bins(self.stimuli)).product()
    }

    pub fn behaviors(&self) -> BTreeSet<Behavior> {
        self.runs.values().flat_map(SeedRun::behaviors).collect()
    }

    /// Coverage and QD-score; of two stimuli also the champions by difficulty, where a missing behavior counts as 0.
    pub fn courses(&self) -> Vec<Course> {
        let runs = |value: &dyn Fn(&ProgressLine) -> f64| {
            let points = |run: &SeedRun| {
                run.progress.iter().map(|line| (f64::from(line.generation), value(line))).collect::<Vec<_>>()
            };
            self.runs.values().map(points).collect::<Vec<_>>()
        };
        let mut courses = vec![
            Course::of("coverage", "filled niches (%)", runs(&|line| 100.0 * line.coverage)),
            Course::of("QD-score", format!("sum of {}", self.unit()), runs(&|line| line.qd_score)),
        ];
        if self.stimuli == 2 {
            let series = |(difficulty, name): (usize, &&str)| {
                let runs = runs(&|line| line.mean_fitness(difficulty));
                Series { name: (*name).to_owned(), runs }
            };
            courses.push(Course {
                title: "champions by the stimuli that they follow".to_owned(),
                unit: format!("mean {}", self.unit()),
                series: DIFFICULTIES.iter().enumerate().map(series).collect(),
            });
        }
        courses
    }

    /// Two stimuli: in order of the paper's groups. Three: only the behaviors that were found, by inputs and classes.
    pub fn discoveries(&self) -> Vec<Discovery> {
        let first = |run: &SeedRun, behavior| {
            run.progress.iter().find(|line| line.best.contains_key(&behavior)).map(|line| line.generation)
        };
        let discovery = |behavior| {
            let generations = self.runs.values().filter_map(|run| first(run, behavior)).collect();
            Discovery { behavior, generations }
        };
        let mut discoveries: Vec<Discovery> = Behavior::all(self.stimuli).map(discovery).collect();
        if self.stimuli == 2 {
            discoveries.sort_by_key(|discovery| group_of(discovery.behavior));
        } else {
            discoveries.retain(|discovery| !discovery.generations.is_empty());
            let class = |function: Function| (function.arity(), function.class()[0]);
            discoveries.sort_by_cached_key(|discovery| class(discovery.behavior.function()));
        }
        discoveries
    }

    pub fn unit(&self) -> &'static str {
        self.objective.meaning()
    }
}
