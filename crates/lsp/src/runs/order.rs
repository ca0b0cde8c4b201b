//! The arguments of a command: what it should run.

use gen_lsp_types::{ExecuteCommandParams, Uri};
use serde_json::Value;

use crate::runs::command::{PROVE, RUN, SCHEMATIC, TEST, TIMING};
use nbc_session::{Checked, Choice};
use nbc_swarm::Level;

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

#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) enum OrderError {
    Command(String),
    Arguments,
    Closed(String),
    /// The client does not see the folder of the results.
    NoPlace,
}

impl RunOrder {
    pub(crate) fn read(asked: &ExecuteCommandParams) -> Result<Self, OrderError> {
        let argument = asked.arguments.as_deref().and_then(<[Value]>::first).ok_or(OrderError::Arguments)?;
        let text = |name: &str| argument.get(name).and_then(Value::as_str).map(str::to_owned);
        let number = |name: &str| argument.get(name).and_then(Value::as_u64).map(|number| number as usize);
        let uri = Uri(text("uri").ok_or(OrderError::Arguments)?);
        let choice = Choice { circuit: text("circuit"), swarm: text("swarm") };
        let run = |level| RunTask::Run { level, test: number("test"), simulation: number("simulation") };
        let task = match asked.command.as_str() {
            RUN => run(Level::Physics),
            TEST => run(Level::Logic),
            PROVE => RunTask::Prove(number("claim")),
            SCHEMATIC => RunTask::Schematic(choice),
            TIMING => RunTask::Timing(choice),
            other => return Err(OrderError::Command(other.to_owned())),
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
