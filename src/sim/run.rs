//! A simulation on its way, and how a batch of them is carried forward.

use std::collections::BTreeMap;
use std::sync::Arc;

use crate::model::{Body, Fault, FaultKind, Palette, Pattern, Schedule, Setting};
use crate::sim::batch::Batch;
use crate::sim::constants::Constants;
use crate::sim::lattice::Lattice;
use crate::sim::probe::{Part, Probe};
use crate::sim::real::Real;
use crate::sim::signal::Signals;
use crate::sim::simulator::Simulator;
use crate::sim::state::State;
use crate::sim::stiffness::Stiffness;

/// What all simulations of a setting share.
#[derive(Clone, Debug)]
pub struct World {
    /// The physics' numbers.
    pub constants: Constants,
    /// Ground voxels.
    pub width: usize,
    /// Told where time goes.
    pub probe: Option<Probe>,
}

/// One simulation: a robot, its clock and what it has yet to do.
#[derive(Clone, Debug)]
pub struct Run {
    /// The body.
    pub lattice: Arc<Lattice>,
    /// The body's number: runs of one number share a body.
    pub body: usize,
    /// What its materials ask for.
    signals: Arc<Signals>,
    /// Where it is.
    pub state: State,
    /// Env steps behind it.
    pub clock: u32,
    /// What stopped it, if anything did.
    pub fault: Option<Fault>,
    /// Spells yet to come, the next one last.
    spells: Vec<(Pattern, u32)>,
    /// The center of mass after each env step, in voxels.
    pub centers: Vec<[f64; 2]>,
}

impl Run {
    /// A body at its start with nothing to do.
    fn new(stock: &Stock, start: usize, constants: &Constants) -> Self {
        let Stock { body, lattice, signals } = stock.clone();
        let state = State::start(&lattice, start, constants);
        Self { lattice, body, signals, state, clock: 0, fault: None, spells: Vec::new(), centers: Vec::new() }
    }

    /// Gives it a schedule to go through.
    pub fn assign(&mut self, schedule: &Schedule) {
        let spells = schedule.spells.iter().rev().filter(|spell| spell.steps > 0);
        self.spells = spells.map(|spell| (spell.pattern, spell.steps)).collect();
    }

    /// Whether there is nothing left to do.
    pub fn is_done(&self) -> bool {
        self.fault.is_some() || self.spells.is_empty()
    }

    fn pattern(&self) -> Pattern {
        self.spells.last().expect("a run that is not done has a spell").0
    }

    fn tick(&mut self, center: [f64; 2]) {
        self.clock += 1;
        self.centers.push(center);
        let spell = self.spells.last_mut().expect("a run that is not done has a spell");
        spell.1 -= 1;
        if spell.1 == 0 {
            self.spells.pop();
        }
    }
}

impl World {
    /// The world of a setting.
    pub fn new(simulator: &Simulator, setting: &Setting) -> Self {
        let constants = simulator.constants;
        Self { constants, width: setting.world_width, probe: simulator.probe }
    }
}

/// What runs of equal bodies share.
#[derive(Clone)]
struct Stock {
    body: usize,
    lattice: Arc<Lattice>,
    signals: Arc<Signals>,
}

/// A run for each body, at its start with nothing to do; equal bodies share their lattice, equal palettes their signals.
pub fn runs<'a>(world: &World, setting: &Setting, bodies: impl IntoIterator<Item = &'a Body>) -> Vec<Run> {
    let mut palettes: BTreeMap<&Palette, Arc<Signals>> = BTreeMap::new();
    let mut known: BTreeMap<&Body, Stock> = BTreeMap::new();
    let run = |body: &'a Body| {
        let number = known.len();
        let mut signals = || {
            let fresh = || Arc::new(Signals::new(body.palette(), &world.constants));
            Arc::clone(palettes.entry(body.palette()).or_insert_with(fresh))
        };
        let stock = known.entry(body).or_insert_with(|| Stock {
            body: number,
            lattice: Arc::new(Lattice::with_constants(body, &world.constants)),
            signals: signals(),
        });
        Run::new(stock, setting.start_column(body.width()), &world.constants)
    };
    bodies.into_iter().map(run).collect()
}

/// Carries runs of one box forward side by side, until the first of them is done.
///
/// `env_step` is the kernel compiled for `R`; `K` is for one body or for different ones.
pub fn carry<R: Real, K: Stiffness<R>>(runs: &mut [&mut Run], world: &World, env_step: impl Fn(&mut Batch<R, K>)) {
    if let Some(probe) = world.probe {
        probe(Part::Elsewhere, runs.len());
    }
    let robots: Vec<_> = runs.iter().map(|run| (&*run.lattice, &run.state)).collect();
    let mut batch = Batch::<R, K>::new(&robots, world.width, &world.constants);
    batch.probe = world.probe;
    let mut targets = Vec::new();
    while !runs.iter().any(|run| run.is_done()) {
        for (lane, run) in runs.iter().enumerate() {
            targets.clear();
            targets.extend(run.signals.targets(run.clock, run.pattern()));
            batch.set_targets(lane, &targets);
        }
        env_step(&mut batch);
        for (lane, run) in runs.iter_mut().enumerate() {
            finish_env_step(lane, run, &batch);
        }
        if runs.iter().all(|run| run.fault.is_none()) {
            batch.save();
        }
    }
    for (lane, run) in runs.iter_mut().enumerate() {
        match run.fault {
            None => batch.unload(lane, &mut run.state),
            Some(_) => batch.unload_saved(lane, &mut run.state),
        }
    }
    batch.tell(Part::Bookkeeping);
}

/// Books an env step of one lane: its center of mass, or its fault.
fn finish_env_step<R: Real, K: Stiffness<R>>(lane: usize, run: &mut Run, batch: &Batch<R, K>) {
    let center = batch.center(lane);
    let fault = |kind| Some(Fault { env_step: run.clock + 1, kind });
    if batch.unstable >> lane & 1 == 1 {
        run.fault = fault(FaultKind::Unstable);
    } else if !center.iter().all(|axis| axis.is_finite()) {
        run.fault = fault(FaultKind::NonFinite);
    } else {
        run.tick(center);
    }
}
