//! How a circuit is mapped: the goal, and the cells of `nbc build` and `nbc synth`, which need not be robots.

use clap::Args;
use clap::builder::{PossibleValue, PossibleValuesParser, TypedValueParser};

use crate::cli::options::robots::RobotsArguments;
use crate::cli::{Failure, robots};
use nbc_circuit::{CellLibrary, Effort, MapOptions, MappingObjective};
use nbc_session::store;

#[derive(Args)]
pub(in crate::cli) struct MappingArguments {
    #[command(flatten)]
    cells: CellsArguments,
    #[command(flatten)]
    library: RobotsArguments,
    #[command(flatten)]
    goal: GoalArguments,
}

#[derive(Args)]
pub(in crate::cli) struct CellsArguments {
    /// The functions of the cells, such as `nand,not` or `xor,maj`, or `all` of two inputs, or `all3` of two and three;
    /// by default those of the robots
    #[arg(long, value_name = "FUNCTIONS", value_delimiter = ',', conflicts_with = "library")]
    cells: Vec<String>,
}

#[derive(Args)]
pub(in crate::cli) struct GoalArguments {
    /// What to optimize; of several robots for a function, the one that suits it best is used [default: area]
    #[arg(long, value_parser = choice(OBJECTIVES))]
    objective: Option<MappingObjective>,
    /// The amount of search [default: normal]
    #[arg(long, value_parser = choice(EFFORTS))]
    effort: Option<Effort>,
}

/// Words with their help and their values.
type Words<T> = &'static [(&'static str, &'static str, T)];

const OBJECTIVES: Words<MappingObjective> = &[
    ("area", "Few robots", MappingObjective::Area),
    ("delay", "Few cycles", MappingObjective::Delay),
    ("margin", "Wide noise margins", MappingObjective::Margin),
    (
        "sturdy",
        "Robots that bear the largest changes of the world, by the radius in their files",
        MappingObjective::Sturdy,
    ),
];

const EFFORTS: Words<Effort> = &[
    ("fast", "A quick look", Effort::Fast),
    ("normal", "Seconds for circuits of a few hundred cells", Effort::Normal),
    ("high", "As good as it gets in minutes", Effort::High),
];

fn choice<T: Copy + Send + Sync + 'static>(words: Words<T>) -> impl TypedValueParser<Value = T> {
    let values = words.iter().map(|(word, help, _)| PossibleValue::new(*word).help(*help));
    PossibleValuesParser::new(values).try_map(move |found| {
        let known = words.iter().find(|(word, ..)| *word == found);
        known.map(|(.., value)| *value).ok_or("not one of the words")
    })
}

impl GoalArguments {
    pub(in crate::cli) fn objective(&self) -> MappingObjective {
        self.objective.unwrap_or(MappingObjective::Area)
    }

    pub(in crate::cli) fn effort(&self) -> Effort {
        self.effort.unwrap_or(Effort::Normal)
    }

    /// The first of its options that the user gave.
    pub(in crate::cli) fn given(&self) -> Option<&'static str> {
        let objective = self.objective.map(|_| "--objective");
        objective.or_else(|| self.effort.map(|_| "--effort"))
    }
}

impl CellsArguments {
    /// The cells that the user chose.
    pub(in crate::cli) fn chosen(&self) -> Result<Option<CellLibrary>, Failure> {
        if self.cells.is_empty() { Ok(None) } else { Ok(Some(nbc_session::cell_library(&self.cells)?)) }
    }
}

impl MappingArguments {
    /// The cells that the user chose, else those of the robots.
    pub(in crate::cli) fn library(&self) -> Result<CellLibrary, Failure> {
        if let Some(cells) = self.cells.chosen()? {
            return Ok(cells);
        }
        let robots = self.library.library.as_deref().map_or_else(|| Ok(store::shipped_library()), robots::robots_of)?;
        Ok(nbc_session::robot_cells(robots, self.goal.objective()))
    }

    pub(in crate::cli) fn options(&self) -> MapOptions {
        MapOptions { objective: self.goal.objective(), effort: self.goal.effort(), ..MapOptions::default() }
    }
}
