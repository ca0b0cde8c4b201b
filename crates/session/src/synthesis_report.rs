//! The result of a synthesis as text and as data.

use std::collections::BTreeMap;
use std::fmt::Write;

use serde::Serialize;

use crate::synthesis::Synthesis;
use nbc_base::diag::counted;
use nbc_base::source::{ProofOrigin, SecondReading};
use nbc_circuit::correspondence::Removed;
use nbc_circuit::levels;

/// The most registers named in a line.
const SHOWN: usize = 8;

/// The result of a synthesis.
#[derive(Debug, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct SynthesisReport {
    cells: usize,
    by_function: BTreeMap<&'static str, usize>,
    /// Cells on the longest path.
    depth: u32,
    inputs: usize,
    outputs: usize,
    /// Registers.
    latches: usize,
    removed: Removed,
    proved: bool,
    proof: ProofReport,
    seconds: f64,
    /// Cells that each of these functions would save.
    #[serde(skip_serializing_if = "BTreeMap::is_empty")]
    what_if: BTreeMap<String, i64>,
}

#[derive(Debug, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
struct ProofReport {
    /// `file`, or `slang` for what it reads of Verilog.
    #[cfg_attr(feature = "schema", schemars(extend("enum" = ["file", "slang"])))]
    from: &'static str,
    /// Version of Yosys, in which slang reads.
    #[serde(skip_serializing_if = "Option::is_none")]
    version: Option<String>,
    /// What Yosys' own reader makes of the file: the same, which is proved (`alike`); the same in `steps` random steps
    /// (`equal`); something else (`different`); a circuit with feedback (`not compared`); or nothing (`unread`).
    #[serde(skip_serializing_if = "Option::is_none")]
    #[cfg_attr(
        feature = "schema",
        schemars(extend("enum" = ["alike", "equal", "different", "not compared", "unread"]))
    )]
    second: Option<&'static str>,
    /// Random steps in which both readings are equal, if more is not known.
    #[serde(skip_serializing_if = "Option::is_none")]
    steps: Option<usize>,
    #[serde(skip)]
    words: String,
}

impl SynthesisReport {
    /// `origin` is what the proof begins with.
    pub fn of(synthesis: &Synthesis, origin: ProofOrigin, seconds: f64) -> Self {
        let Synthesis { design, result, removed, what_if } = synthesis;
        Self {
            cells: synthesis.cells(),
            by_function: result.netlist.by_function(),
            depth: levels::depth(&result.netlist),
            inputs: design.ports().len(),
            outputs: design.netlist.outputs().len(),
            latches: design.netlist.registers().count(),
            removed: removed.clone(),
            // A circuit whose logic is not proved is never reported.
            proved: true,
            proof: ProofReport::of(origin),
            seconds,
            what_if: what_if.iter().map(|&(function, saved)| (function.name().to_owned(), saved)).collect(),
        }
    }

    pub fn text(&self) -> String {
        let parts: Vec<_> = self.by_function.iter().map(|(name, count)| format!("{count} {name}")).collect();
        let latches = if self.latches > 0 { format!(", {}", counted(self.latches, "register")) } else { String::new() };
        let mut text = format!(
            "{} ({}), {}{latches}, proved from {}, {:.2} s\n",
            counted(self.cells, "cell"),
            parts.join(", "),
            counted(self.depth as usize, "level"),
            self.proof.words,
            self.seconds
        );
        text.extend(self.proof.version.iter().map(|version| format!("read by Yosys {version}\n")));
        text.push_str(&describe_removed(&self.removed));
        for (name, saved) in &self.what_if {
            let cells = counted(saved.unsigned_abs() as usize, "cell");
            let _ = writeln!(text, "with `{name}`: {cells} {}", if *saved < 0 { "more" } else { "fewer" });
        }
        text
    }
}

impl ProofReport {
    fn of(origin: ProofOrigin) -> Self {
        let words = origin.to_string();
        let ProofOrigin::Slang { version, second } = origin else {
            return Self { from: "file", version: None, second: None, steps: None, words };
        };
        let (second, steps) = match second {
            SecondReading::Alike => ("alike", None),
            SecondReading::Equal(steps) => ("equal", Some(steps)),
            SecondReading::Different => ("different", None),
            SecondReading::NoSteps => ("not compared", None),
            SecondReading::None => ("unread", None),
        };
        Self { from: "slang", version: Some(version), second: Some(second), steps, words }
    }
}

fn describe_removed(removed: &Removed) -> String {
    let constant: Vec<_> = removed.constant.iter().map(|(name, value)| format!("{name} = {value}")).collect();
    let equal: Vec<_> = removed.equal.iter().map(|(name, other)| format!("{name} = {other}")).collect();
    let line = |(what, names): (&str, &[String])| match names.len() {
        0 => String::new(),
        _ => format!("{what}: {}\n", listed(names)),
    };
    [
        ("registers that never change", &constant[..]),
        ("registers that equal another", &equal),
        ("registers that no output needs", &removed.unused),
    ]
    .map(line)
    .concat()
}

fn listed(names: &[String]) -> String {
    let shown = names[..names.len().min(SHOWN)].join(", ");
    if names.len() > SHOWN { format!("{shown} and {} more", names.len() - SHOWN) } else { shown }
}
