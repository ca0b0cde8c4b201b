//! `nbc library verify`: every robot simulated again and compared with its file.

use std::sync::Arc;

use crate::cli::documents::RobotList;
use crate::cli::in_order::in_order;
use crate::cli::options::device::DeviceArguments;
use crate::cli::options::queue::QueueArguments;
use crate::cli::task_executor::TaskExecutor;
use crate::cli::{Context, Failure, Interrupt, OutputFormat, Progress, Status};
use nbc_base::diag::counted;
use nbc_base::model::{Library, Robot};
use nbc_session::Verified;
use nbc_session::report::Schema;

/// A robot fails if its file has another value.
pub fn verify(
    library: &Library,
    device: DeviceArguments,
    queue: &QueueArguments,
    context: &mut Context,
) -> Result<Status, Failure> {
    let bar = Arc::new(Progress::new("verifying", library.robots.len() as u64));
    // Without workers a signal ends the program at once.
    let interrupt = if queue.is_given() { Interrupt::watch()? } else { Interrupt::default() };
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
    in_order(tasks.threads(), &robots, |place, robot| Verified::of(executor, place, robot), keep)?;
    drop(bar);
    let stopped = tasks.is_stopped();
    tasks.end(context)?;
    if stopped {
        return Ok(Status::Interrupted);
    }
    let failed = findings.iter().filter(|finding| !finding.verified).count();
    match context.format {
        OutputFormat::Json => context.print_json(Schema::Verify, &RobotList { robots: findings })?,
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
