//! Tasks and their results as plain data, so that they can be done on any machine.

use std::sync::Arc;

use serde::{Deserialize, Serialize};

use crate::{Evaluated, EvaluationProtocol, EvaluationTask, Measurement, SwarmBits, SwarmTask};
use nbc_base::model::{Behavior, Body, Fault};

/// Work whose result depends on it alone.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub enum Task {
    Evaluation(Arc<EvaluationProtocol>, EvaluationTask),
    /// In short sequences, as a gate with a behavior (see [`screen`](crate::screen)).
    Screening {
        body: Body,
        behavior: Behavior,
        /// The slowest clock that is of use, in cycles.
        most: u32,
    },
    /// All measurements of a body for its robot file (see [`measure`](crate::measure)).
    Measurement(Body),
    Swarm(Box<SwarmTask>),
}

/// The result of a task of the same kind.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub enum TaskResult {
    Evaluation(Evaluated),
    /// The clock and the margin, if there is a clock without errors.
    Screening(Result<Option<(u32, f64)>, Fault>),
    Measurement(Result<Measurement, Fault>),
    Swarm(SwarmBits),
}

impl TaskResult {
    /// The result of an evaluation. Panics if it is of another task, as all methods here do.
    pub fn evaluated(self) -> Evaluated {
        match self {
            Self::Evaluation(evaluated) => evaluated,
            other => panic!("{other:?} is not of an evaluation"),
        }
    }

    pub fn screened(self) -> Result<Option<(u32, f64)>, Fault> {
        match self {
            Self::Screening(screened) => screened,
            other => panic!("{other:?} is not of a screening"),
        }
    }

    pub fn measured(self) -> Result<Measurement, Fault> {
        match self {
            Self::Measurement(measured) => measured,
            other => panic!("{other:?} is not of a measurement"),
        }
    }

    pub fn bits(self) -> SwarmBits {
        match self {
            Self::Swarm(bits) => bits,
            other => panic!("{other:?} is not of a swarm"),
        }
    }
}
