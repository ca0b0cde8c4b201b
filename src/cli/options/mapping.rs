//! How a circuit is mapped: the goal, and the cells of `nbc build` and `nbc synth`, which need not be robots.

use clap::{Args, ValueEnum};

use crate::cli::options::robots::RobotsArguments;
use crate::cli::{Failure, robots};
use nbc_circuit::{CellLibrary, Effort, MapOptions, MappingObjective};
use nbc_session::CompileOptions;
use nbc_session::store;

/// The available cells and the goal of mapping, for circuits that no program declares.
#[derive(Args)]
pub(in crate::cli) struct MappingArguments {
    #[command(flatten)]
    cells: CellsArguments,
    #[command(flatten)]
    library: RobotsArguments,
    #[command(flatten)]
    goal: GoalArguments,
}

/// Cells that need not be robots.
#[derive(Args)]
pub(in crate::cli) struct CellsArguments {
    /// The functions of the cells, such as `nand,not` or `xor,maj`, or `all` of two inputs, or `all3` of two and three;
    /// by default those of the robots
    #[arg(long, value_name = "FUNCTIONS", value_delimiter = ',', conflicts_with = "library")]
    cells: Vec<String>,
}

/// The goal of mapping.
#[derive(Args)]
pub(in crate::cli) struct GoalArguments {
    /// What to optimize; of several robots for a function, the one that suits it best is used [default: area]
    #[arg(long, value_enum)]
    objective: Option<ObjectiveWord>,
    /// The amount of search [default: normal]
    #[arg(long, value_enum)]
    effort: Option<EffortWord>,
}

impl GoalArguments {
    /// How to map.
    pub(in crate::cli) fn options(&self) -> MapOptions {
        let (objective, effort) = (self.objective.unwrap_or_default(), self.effort.unwrap_or_default());
        MapOptions { objective: objective.into(), effort: effort.into(), ..MapOptions::default() }
    }

    /// The first of its options that the user gave.
    pub(in crate::cli) fn given(&self) -> Option<&'static str> {
        let objective = self.objective.map(|_| "--objective");
        objective.or_else(|| self.effort.map(|_| "--effort"))
    }

    /// These options with the goal.
    pub(in crate::cli) fn with(&self, options: CompileOptions) -> CompileOptions {
        let MapOptions { objective, effort, .. } = self.options();
        CompileOptions { objective, effort, ..options }
    }
}

impl CellsArguments {
    /// The cells that the user chose.
    pub(in crate::cli) fn chosen(&self) -> Result<Option<CellLibrary>, Failure> {
        let chosen = (!self.cells.is_empty()).then(|| nbc_session::cell_library(&self.cells));
        chosen.transpose().map_err(Failure::plain)
    }
}

impl MappingArguments {
    /// The cells that the user chose, else those of the robots.
    pub(in crate::cli) fn library(&self) -> Result<CellLibrary, Failure> {
        if let Some(cells) = self.cells.chosen()? {
            return Ok(cells);
        }
        let robots = self.library.library.as_deref().map(robots::robots_of).transpose()?;
        let robots = robots.unwrap_or_else(store::shipped_library);
        Ok(nbc_session::robot_cells(robots, self.options().objective))
    }

    /// How to map.
    pub(in crate::cli) fn options(&self) -> MapOptions {
        self.goal.options()
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
        }
    }
}
