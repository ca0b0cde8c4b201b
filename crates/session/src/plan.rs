//! The plans of a circuit's swarms, and their robots: those of the program, of a folder, or of an evolution's run.

use crate::checked::Checked;
use crate::choice::{check_swarm_is_clear, declared_swarm, swarms_of};
use crate::compiled::Plan;
use crate::options::CompileOptions;
use crate::store;
use crate::wording;
use nbc_base::diag::{Diagnostic, Diagnostics};
use nbc_base::model::{
    Behavior, Hold, Instance, Library, LibrarySource, NamedWorld, Origin, Program, RegisterStyle, Swarm, WaveTimes,
};
use nbc_base::source::SourceWorld;
use nbc_lang::check::DEFAULT_LIBRARY;

impl Checked {
    /// The robots of a declared library or the default one, best first for each function.
    pub fn robots(&self, library: Option<&str>, options: &CompileOptions) -> Result<Library, Diagnostics> {
        self.diagnosed(self.preferred(library, options))
    }

    pub(super) fn plans(&self, circuit: &Instance, options: &CompileOptions) -> Result<Vec<Plan>, Vec<Diagnostic>> {
        let swarms = match &options.swarm {
            Some(name) => vec![chosen(&self.program, circuit, name).map_err(|fault| vec![fault])?],
            None => swarms_of(&self.program, circuit),
        };
        if swarms.is_empty() {
            return Ok(vec![self.plan_of(circuit, None, options)?]);
        }
        swarms.into_iter().map(|swarm| self.plan_of(circuit, Some(swarm), options)).collect()
    }

    pub(super) fn plan(&self, circuit: &Instance, options: &CompileOptions) -> Result<Plan, Vec<Diagnostic>> {
        let clear = check_swarm_is_clear(&self.program, circuit, options.swarm.as_deref());
        clear.map_err(|fault| vec![fault])?;
        Ok(self.plans(circuit, options)?.remove(0))
    }

    pub(super) fn plan_of(
        &self,
        circuit: &Instance,
        declaration: Option<&Swarm>,
        options: &CompileOptions,
    ) -> Result<Plan, Vec<Diagnostic>> {
        let plan = Plan {
            circuit: circuit.clone(),
            swarm: declaration.map(|swarm| swarm.name.clone()),
            library: self.preferred(declaration.map(|swarm| swarm.library.as_str()), options)?,
            hold: declaration.map_or(Hold::Auto, |swarm| swarm.hold),
            window: declaration.map_or(1, |swarm| swarm.window),
            registers: declaration.map_or(RegisterStyle::default(), |swarm| swarm.registers),
            waves: declaration.map_or(WaveTimes::default(), |swarm| swarm.waves),
            world: NamedWorld::default(),
        };
        Ok(plan.in_world(declaration.map_or_else(|| self.program.default_world(), |swarm| swarm.world.clone())))
    }

    fn preferred(&self, library: Option<&str>, options: &CompileOptions) -> Result<Library, Vec<Diagnostic>> {
        let mut library = match (&options.robots, self.program.library(library.unwrap_or(DEFAULT_LIBRARY))) {
            (Some(robots), _) => robots.clone(),
            (None, Some(declared)) => self.library(declared, &options.runs)?,
            (None, None) => self.context.built_in.shipped().clone(),
        };
        library.robots.retain(|robot| !options.without.contains(&robot.name));
        Ok(nbc_swarm::prefer(library, options.objective))
    }

    pub(super) fn library(&self, declared: &LibrarySource, runs: &str) -> Result<Library, Vec<Diagnostic>> {
        let mut library = match &declared.from {
            Origin::Shipped => self.context.built_in.shipped().clone(),
            Origin::Three => self.context.built_in.three().clone(),
            Origin::Folder(folder) => self.folder(folder, declared, None)?,
            Origin::Evolution(name) => {
                let (folder, file) = (robots_of_run(runs, name), &self.path);
                let evolve = format!("nbc evolve {file} --run {name} --out {runs}");
                let help = format!("`{evolve}`, then `nbc library add {runs}/{name} --into {folder}`");
                self.folder(&folder, declared, Some(&help))?
            }
        };
        if let Some(behaviors) = &declared.behaviors {
            // What an evolution will find is not known.
            let absent = |behavior: &&Behavior| library.robots.iter().all(|robot| robot.behavior != **behavior);
            let absent: Vec<Behavior> = behaviors.iter().filter(absent).copied().collect();
            if !absent.is_empty() && !matches!(declared.from, Origin::Evolution(_)) {
                return Err(vec![wording::no_behavior(&declared.name, &absent, declared.span)]);
            }
            library.robots.retain(|robot| behaviors.contains(&robot.behavior));
        }
        let names = || library.robots.iter().map(|robot| robot.name.as_str());
        let unknown = declared.without.iter().filter(|(name, _)| names().all(|known| known != name));
        let faults: Vec<_> = unknown.map(|(name, place)| wording::unknown_robot(name, names(), *place)).collect();
        if !faults.is_empty() {
            return Err(faults);
        }
        library.robots.retain(|robot| declared.without.iter().all(|(name, _)| robot.name != *name));
        Ok(library)
    }

    pub(super) fn has_run(&self, declared: &LibrarySource, runs: &str) -> bool {
        match &declared.from {
            Origin::Evolution(name) => self.context.world.list(&robots_of_run(runs, name)).is_ok(),
            Origin::Shipped | Origin::Three | Origin::Folder(_) => true,
        }
    }

    fn folder(&self, folder: &str, declared: &LibrarySource, help: Option<&str>) -> Result<Library, Vec<Diagnostic>> {
        let placed = |fault: Diagnostic| wording::of_library(fault, declared.span, help);
        store::read_library(&self.context.world, folder).map_err(|faults| faults.into_iter().map(placed).collect())
    }
}

fn robots_of_run(runs: &str, name: &str) -> String {
    format!("{runs}/{name}/robots")
}

fn chosen<'p>(program: &'p Program, circuit: &Instance, name: &str) -> Result<&'p Swarm, Diagnostic> {
    let swarm = declared_swarm(program, name)?;
    if swarms_of(program, circuit).iter().any(|one| one.name == swarm.name) {
        return Ok(swarm);
    }
    Err(wording::swarm_of_other_circuit(name, &swarm.circuit.to_string(), &circuit.to_string()))
}
