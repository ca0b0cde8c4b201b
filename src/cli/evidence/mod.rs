//! `nbc evidence`: does again what the manual says was done, and compares.

mod claims;
pub(in crate::cli) mod wording;

use std::io;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::time::Instant;

use clap::Args;
use serde::Serialize;

use crate::cli::{Context, Failure, Progress, Status};
use nbc_base::diag::io_words;
use nbc_session::report::Schema;

use claims::{Claim, read_claims, read_page, squeezed};
use wording::EvidenceError;

/// Do again what the manual says was done, and print what differs
#[derive(Args)]
#[command(after_help = "Examples:
  nbc evidence                    what takes at most a minute each
  nbc evidence --most 7200        also what takes at most two hours
  nbc evidence --page docs/waves.md

Claims with `cargo` in their command need Rust.
Exit status: 0 nothing differs, 1 something does, 2 the file cannot be read.")]
pub struct EvidenceArguments {
    /// The list of claims
    #[arg(default_value = "docs/evidence.json")]
    file: PathBuf,
    /// Leave out claims that take longer than this number of seconds
    #[arg(long, value_name = "SECONDS", default_value_t = 60)]
    most: u32,
    /// Only the claims of this page
    #[arg(long, value_name = "FILE")]
    page: Option<String>,
    /// Print the table of all claims as Markdown, and do nothing
    #[arg(long)]
    list: bool,
}

/// What became of a claim.
#[derive(Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
enum Outcome {
    Same,
    Differs,
    /// It takes longer than asked for.
    LeftOut,
}

#[derive(Serialize)]
struct Finding<'a> {
    claim: &'a str,
    page: &'a str,
    command: &'a str,
    outcome: Outcome,
    /// What the page says and the command did not print.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    missing: Vec<String>,
    #[serde(skip_serializing_if = "Option::is_none")]
    seconds: Option<f64>,
}

#[derive(Serialize)]
struct Findings<'a> {
    findings: Vec<Finding<'a>>,
}

impl EvidenceArguments {
    /// Carries out the commands of the claims.
    ///
    /// # Errors
    /// When the list or a page cannot be read, or a command cannot be started.
    pub fn run(self, context: &mut Context) -> Result<Status, Failure> {
        let claims = read_claims(&self.file)?;
        if self.list {
            context.print(claims::table(&claims))?;
            return Ok(Status::Done);
        }
        let chosen: Vec<&Claim> =
            claims.iter().filter(|claim| self.page.as_ref().is_none_or(|page| *page == claim.page)).collect();
        let bar = Progress::new("claims", chosen.len() as u64);
        let mut findings = Vec::new();
        for claim in chosen {
            findings.push(self.find(claim)?);
            bar.add(1);
        }
        drop(bar);
        let differs = findings.iter().any(|finding| finding.outcome == Outcome::Differs);
        let findings = Findings { findings };
        context.print_result(Schema::Evidence, &findings, || describe(&findings))?;
        Ok(if differs { Status::TestFailed } else { Status::Done })
    }

    fn find<'a>(&self, claim: &'a Claim) -> Result<Finding<'a>, Failure> {
        let Claim { claim: text, page, command, .. } = claim;
        let (missing, seconds) = (Vec::new(), None);
        let mut finding = Finding { claim: text, page, command, outcome: Outcome::LeftOut, missing, seconds };
        if claim.seconds > self.most {
            return Ok(finding);
        }
        let folder = self.file.parent().and_then(|docs| docs.parent()).unwrap_or(Path::new(""));
        let page = read_page(&folder.join(page))?;
        let not_started =
            |error: io::Error| EvidenceError::NotStarted { program: command.clone(), reason: io_words(&error) };
        let out = tempfile::tempdir().map_err(not_started)?;
        let mut words = claim.words(out.path()).into_iter();
        let program = words.next().unwrap_or_default();
        let mut child = match program.as_str() {
            "nbc" => Command::new(std::env::current_exe().map_err(not_started)?),
            "cargo" => Command::new("cargo"),
            _ => return Err(EvidenceError::OtherProgram { program }.into()),
        };
        let start = Instant::now();
        let at = if folder.as_os_str().is_empty() { Path::new(".") } else { folder };
        let ran = child.args(words).current_dir(at).stdin(Stdio::null()).output().map_err(not_started)?;
        let printed = String::from_utf8_lossy(&ran.stdout);
        finding.seconds = Some(start.elapsed().as_secs_f64());
        finding.missing = claim.missing(&page, &printed);
        finding.outcome = if finding.missing.is_empty() { Outcome::Same } else { Outcome::Differs };
        Ok(finding)
    }
}

fn describe(findings: &Findings<'_>) -> String {
    let mut text = String::new();
    for Finding { claim, page, outcome, missing, seconds, command } in &findings.findings {
        let (word, time) = match outcome {
            Outcome::Same => ("same", format!(" ({:.1} s)", seconds.unwrap_or(0.0))),
            Outcome::Differs => ("DIFFERS", format!(": {command}")),
            Outcome::LeftOut => ("left out", String::new()),
        };
        text += &format!("{word:8}  {page}: {claim}{time}\n");
        missing.iter().for_each(|line| text += &format!("          missing: {}\n", squeezed(line)));
    }
    let count = |wanted| findings.findings.iter().filter(|finding| finding.outcome == wanted).count();
    let [same, differs, left_out] = [Outcome::Same, Outcome::Differs, Outcome::LeftOut].map(count);
    text + &format!("{same} same, {differs} differ, {left_out} left out\n")
}
