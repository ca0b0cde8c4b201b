//! `nbc library verify`: every robot simulated again and compared with its file.

use std::sync::Arc;

use serde::Serialize;

use crate::cli::in_order::in_order;
use crate::cli::options::device::DeviceArguments;
use crate::cli::options::queue::QueueArguments;
use crate::cli::task_executor::TaskExecutor;
use crate::cli::{Context, Failure, Interrupt, OutputFormat, Progress, Status};
use nbc_base::diag::counted;
use nbc_base::model::{Character, Fault, Library, Robot};
use nbc_session::report::Schema;
use nbc_swarm::{Executor, Measurement, Task};

/// The result for one robot.
#[derive(Serialize)]
struct Finding<'a> {
    name: &'a str,
    verified: bool,
    /// The differences from the file.
    differs: Vec<String>,
}

impl<'a> Finding<'a> {
    /// Measures a robot again; `None` if the work was stopped.
    fn of(executor: &dyn Executor, place: usize, robot: &'a Robot) -> Option<Self> {
        let differs = differences(executor, place, robot)?;
        Some(Self { name: &robot.name, verified: differs.is_empty(), differs })
    }
}

/// Measures every robot again; a robot fails if its file has another value.
///
/// # Errors
/// When the device or the server cannot be used, or the output cannot be written.
pub fn verify(
    library: &Library,
    device: DeviceArguments,
    queue: &QueueArguments,
    context: &mut Context,
) -> Result<Status, Failure> {
    let bar = Arc::new(Progress::new("verifying", library.robots.len() as u64));
    // Without workers a signal ends the program at once.
    let interrupt = if queue.nats.is_some() { Interrupt::watch()? } else { Interrupt::default() };
    let tasks = TaskExecutor::choose(device, queue, &interrupt, &bar, context)?;
    let robots: Vec<&Robot> = library.robots.iter().collect();
    let mut findings = Vec::new();
    let keep = |finding| {
        bar.add(1);
        if let Some(finding) = finding {
            findings.push(finding);
        }
        Ok::<(), Failure>(())
    };
    let executor = tasks.executor();
    in_order(tasks.threads(), &robots, |place, robot| Finding::of(executor, place, robot), keep)?;
    drop(bar);
    let stopped = tasks.is_stopped();
    tasks.end(context)?;
    if stopped {
        return Ok(Status::Interrupted);
    }
    let failed = findings.iter().filter(|finding| !finding.verified).count();
    match context.format {
        OutputFormat::Json => context.print_json(Schema::Verify, &serde_json::json!({ "robots": findings }))?,
        OutputFormat::Text => {
            for finding in &findings {
                let verdict =
                    if finding.verified { "ok".to_owned() } else { format!("differs: {}", finding.differs.join(", ")) };
                context.print(format_args!("{:<24} {verdict}\n", finding.name))?;
            }
            context
                .print(format_args!("{}, {failed} different from their files\n", counted(findings.len(), "robot")))?;
        }
    }
    Ok(if failed == 0 { Status::Done } else { Status::TestFailed })
}

/// The differences between a new measurement and the file; `None` if the work was stopped.
fn differences(executor: &dyn Executor, place: usize, robot: &Robot) -> Option<Vec<String>> {
    let task = Task::Measurement(robot.body.clone());
    let measured = executor.perform(place, &[task], &|| ())?.remove(0).measured();
    let Measurement { displacement, behavior, character } = match measured {
        Ok(measurement) => measurement,
        Err(Fault { env_step, kind }) => return Some(vec![format!("the robot {kind} in env step {env_step}")]),
    };
    let same = [
        ("displacement", displacement == robot.displacement),
        ("behavior", behavior == robot.behavior),
        ("character", character == Character { radius: None, ..robot.character.clone() }),
    ];
    Some(same.into_iter().filter(|(_, same)| !same).map(|(name, _)| name.to_owned()).collect())
}
