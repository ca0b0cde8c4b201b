//! The arguments of a command: what it should run.

use gen_lsp_types::{ExecuteCommandParams, Uri};
use serde_json::Value;

use crate::wording::{self, RequestError};
use nbc_session::{Checked, Choice};
use nbc_swarm::Level;

pub(crate) const RUN: &str = "nbc.run";
pub(crate) const TEST: &str = "nbc.test";
pub(crate) const PROVE: &str = "nbc.prove";
pub(crate) const SCHEMATIC: &str = "nbc.schematic";
pub(crate) const TIMING: &str = "nbc.timing";

pub(crate) const COMMANDS: [&str; 5] = [RUN, TEST, PROVE, SCHEMATIC, TIMING];

#[derive(Clone, Debug)]
pub(crate) struct RunOrder {
    pub(crate) uri: Uri,
    pub(super) task: RunTask,
}

#[derive(Clone, Debug)]
pub(super) enum RunTask {
    /// By number; all tests, and in physics all simulations, if there are none.
    Run {
        level: Level,
        test: Option<usize>,
        simulation: Option<usize>,
    },
    /// By number; all if there is none.
    Prove(Option<usize>),
    Schematic(Choice),
    Timing(Choice),
}

impl RunOrder {
    pub(crate) fn read(asked: &ExecuteCommandParams) -> Result<Self, RequestError> {
        let argument = asked.arguments.as_deref().and_then(<[Value]>::first).ok_or_else(wording::command_arguments)?;
        let text = |name: &str| argument.get(name).and_then(Value::as_str).map(str::to_owned);
        let number = |name: &str| argument.get(name).and_then(Value::as_u64).map(|number| number as usize);
        let uri = Uri(text("uri").ok_or_else(wording::command_arguments)?);
        let choice = Choice { circuit: text("circuit"), swarm: text("swarm") };
        let run = |level| RunTask::Run { level, test: number("test"), simulation: number("simulation") };
        let task = match asked.command.as_str() {
            RUN => run(Level::Physics),
            TEST => run(Level::Logic),
            PROVE => RunTask::Prove(number("claim")),
            SCHEMATIC => RunTask::Schematic(choice),
            TIMING => RunTask::Timing(choice),
            other => return Err(wording::unknown_command(other, &COMMANDS)),
        };
        Ok(Self { uri, task })
    }

    pub(crate) fn title(&self, checked: &Checked) -> String {
        let file = checked.path.rsplit('/').next().unwrap_or_default();
        match &self.task {
            RunTask::Run { level: Level::Physics, .. } => format!("simulating {file}"),
            RunTask::Run { .. } => format!("testing {file}"),
            RunTask::Prove(_) => format!("proving {file}"),
            RunTask::Schematic(_) | RunTask::Timing(_) => format!("compiling {file}"),
        }
    }
}
