//! `nbc library verify`: every robot simulated again and compared with its file.

use rayon::prelude::*;
use serde::Serialize;

use crate::cli::{Context, Failure, OutputFormat, Progress, Status};
use crate::diag::counted;
use crate::model::{Library, Robot};
use crate::report::Schema;
use crate::sim::Simulator;
use crate::swarm::{self, Measurement};

/// The result for one robot.
#[derive(Serialize)]
struct Finding<'a> {
    name: &'a str,
    verified: bool,
    /// The differences from the file.
    differs: Vec<&'static str>,
}

impl<'a> Finding<'a> {
    /// Measures a robot again.
    fn of(robot: &'a Robot) -> Self {
        let differs = differences(robot);
        Self { name: &robot.name, verified: differs.is_empty(), differs }
    }
}

/// Measures every robot again; a robot fails if its file has another value.
///
/// # Errors
/// When the output cannot be written.
pub fn verify(library: &Library, context: &mut Context) -> Result<Status, Failure> {
    let bar = Progress::new("verifying", library.robots.len() as u64);
    let find = |robot| {
        let finding = Finding::of(robot);
        bar.add(1);
        finding
    };
    let findings: Vec<_> = library.robots.par_iter().map(find).collect();
    drop(bar);
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

/// The differences between a new measurement and the file.
fn differences(robot: &Robot) -> Vec<&'static str> {
    let Ok(Measurement { displacement, behavior, character }) = swarm::measure(&Simulator::default(), &robot.body)
    else {
        return vec!["the simulation has a fault"];
    };
    let same = [
        ("displacement", displacement == robot.displacement),
        ("behavior", behavior == robot.behavior),
        ("character", character == robot.character),
    ];
    same.into_iter().filter(|(_, same)| !same).map(|(name, _)| name).collect()
}
