//! How a circuit is mapped: the arguments that `nbc build` and `nbc synth` share.

use std::path::PathBuf;

use clap::{Args, ValueEnum};

use crate::cli::wording::UsageError;
use crate::cli::{Failure, robots};
use nbc_base::model::{Function, Library};
use nbc_circuit::{CellLibrary, Effort, MapOptions, MappingObjective};
use nbc_session::CompileOptions;
use nbc_session::store;

/// The available cells and the options of mapping.
#[derive(Args)]
pub(in crate::cli) struct MappingArguments {
    /// The functions of the cells, such as `nand,not` or `xor,maj`, or `all` of two inputs, or `all3` of two and three;
    /// by default those of the built-in robots
    #[arg(long, value_name = "FUNCTIONS", value_delimiter = ',', conflicts_with = "library")]
    cells: Vec<String>,
    /// A robot file, a folder of them, or `three`, whose functions are the cells
    #[arg(long, value_name = "FILE")]
    library: Option<PathBuf>,
    #[command(flatten)]
    goal: GoalArguments,
}

/// The goal of mapping.
#[derive(Args)]
pub(in crate::cli) struct GoalArguments {
    /// What to optimize; of several robots for a function, the one that suits it best is used
    #[arg(long, value_enum, default_value_t)]
    objective: ObjectiveWord,
    /// The amount of search
    #[arg(long, value_enum, default_value_t)]
    effort: EffortWord,
}

impl GoalArguments {
    /// How to map.
    pub(in crate::cli) fn options(&self) -> MapOptions {
        MapOptions { objective: self.objective.into(), effort: self.effort.into(), ..MapOptions::default() }
    }

    /// These options with the goal.
    pub(in crate::cli) fn with(&self, options: CompileOptions) -> CompileOptions {
        let MapOptions { objective, effort, .. } = self.options();
        CompileOptions { objective, effort, ..options }
    }
}

impl MappingArguments {
    /// The library that the user chose, else that of the built-in robots.
    pub(in crate::cli) fn library(&self) -> Result<CellLibrary, Failure> {
        Ok(self.chosen()?.unwrap_or_else(|| self.cells_of(store::shipped_library())))
    }

    fn cells_of(&self, robots: Library) -> CellLibrary {
        nbc_swarm::cells(&nbc_swarm::prefer(robots, self.goal.options().objective))
    }

    /// The library that the user chose.
    pub(in crate::cli) fn chosen(&self) -> Result<Option<CellLibrary>, Failure> {
        Ok(Some(match (&self.library, &self.cells[..]) {
            (Some(path), _) => self.cells_of(robots::robots_of(path)?),
            (None, []) => return Ok(None),
            (None, [all]) if all == "all" => CellLibrary::uniform(every_gate()),
            (None, [all]) if all == "all3" => {
                CellLibrary::uniform(every_gate().chain(Function::all_of(3).filter(|function| function.arity() == 3)))
            }
            // A robot of three stimuli can be wired in any order.
            (None, names) => {
                let arranged = |one: Function| if one.inputs() == 3 { one.arrangements() } else { vec![one] };
                CellLibrary::uniform(functions(names)?.into_iter().flat_map(arranged))
            }
        }))
    }

    /// How to map.
    pub(in crate::cli) fn options(&self) -> MapOptions {
        self.goal.options()
    }

    /// These options with the goal.
    pub(in crate::cli) fn with(&self, options: CompileOptions) -> CompileOptions {
        self.goal.with(options)
    }
}

#[derive(Clone, Copy, Default, ValueEnum)]
enum ObjectiveWord {
    /// Few robots
    #[default]
    Area,
    /// Few cycles
    Delay,
    /// Wide noise margins
    Margin,
    /// Robots that bear the largest changes of the world, by the radius in their files
    Sturdy,
}

#[derive(Clone, Copy, Default, ValueEnum)]
enum EffortWord {
    /// A quick look
    Fast,
    /// Seconds for circuits of a few hundred cells
    #[default]
    Normal,
    /// As good as it gets in minutes
    High,
}

impl From<ObjectiveWord> for MappingObjective {
    fn from(word: ObjectiveWord) -> Self {
        match word {
            ObjectiveWord::Area => Self::Area,
            ObjectiveWord::Delay => Self::Delay,
            ObjectiveWord::Margin => Self::Margin,
            ObjectiveWord::Sturdy => Self::Sturdy,
        }
    }
}

impl From<EffortWord> for Effort {
    fn from(word: EffortWord) -> Self {
        match word {
            EffortWord::Fast => Self::Fast,
            EffortWord::Normal => Self::Normal,
            EffortWord::High => Self::High,
        }
    }
}

/// The functions of two inputs, and the inverter.
fn every_gate() -> impl Iterator<Item = Function> {
    Function::all().filter(|function| function.arity() == 2 || *function == Function::NOT)
}

/// The functions of these names.
pub(in crate::cli) fn functions(names: &[String]) -> Result<Vec<Function>, Failure> {
    let parse = |name: &String| {
        Function::parse(name.trim()).ok_or_else(|| {
            UsageError::UnknownFunction { name: name.clone(), known: Function::named().map(Function::name).collect() }
                .into()
        })
    };
    names.iter().map(parse).collect()
}
