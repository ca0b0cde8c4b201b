//! The rows of a test or of a simulation as a table, as text and for pages.

use crate::html::escape;
use crate::{Align, TextTable};
use nbc_base::model::Column;
use nbc_swarm::{RowVerdict, SimulationResult, TestVerdict};

pub(super) struct TruthTable<'a> {
    groups: Vec<TableGroup<'a>>,
    rows: Vec<TableRow>,
}

/// The columns of ports, or one column with a heading alone.
struct TableGroup<'a> {
    heading: &'static str,
    ports: Option<&'a [Column]>,
}

struct TableRow {
    line: usize,
    /// The words in the columns of each group.
    cells: Vec<Vec<String>>,
    passed: Option<bool>,
}

impl<'a> TruthTable<'a> {
    /// Each row comes with whether it passed.
    pub(super) fn of_test<'r>(verdict: &'a TestVerdict, rows: impl Iterator<Item = (&'r RowVerdict, bool)>) -> Self {
        let (inputs, outputs) = (&verdict.inputs[..], &verdict.outputs[..]);
        let row = |(row, passed): (&RowVerdict, bool)| TableRow {
            line: row.line,
            cells: vec![
                words(&row.inputs),
                words(&row.expected),
                words(&row.observed),
                vec![row.cycles.map_or(String::new(), |cycles| cycles.to_string())],
            ],
            passed: Some(passed),
        };
        Self {
            groups: vec![
                TableGroup { heading: "inputs", ports: Some(inputs) },
                TableGroup { heading: "expected", ports: Some(outputs) },
                TableGroup { heading: "observed", ports: Some(outputs) },
                TableGroup { heading: "cycles", ports: None },
            ],
            rows: rows.map(row).collect(),
        }
    }

    pub(super) fn of_simulation(result: &'a SimulationResult) -> Self {
        let (inputs, outputs) = (&result.inputs[..], &result.outputs[..]);
        let rows = result.rows.iter().map(|row| TableRow {
            line: row.line,
            cells: vec![words(&row.inputs), words(&[row.cycles]), words(&row.observed), words(&row.changes)],
            passed: None,
        });
        Self {
            groups: vec![
                TableGroup { heading: "inputs", ports: Some(inputs) },
                TableGroup { heading: "cycles", ports: None },
                TableGroup { heading: "at the end", ports: Some(outputs) },
                TableGroup { heading: "changes", ports: Some(outputs) },
            ],
            rows: rows.collect(),
        }
    }

    fn has_verdicts(&self) -> bool {
        self.rows.iter().any(|row| row.passed.is_some())
    }

    pub(super) fn text(&self) -> String {
        let mut columns: Vec<(&str, Align)> = self.groups.iter().map(TableGroup::column).collect();
        columns.extend(self.has_verdicts().then_some(("", Align::Left)));
        let mut table = TextTable::new(&columns);
        let names = TableRow { line: 0, cells: self.groups.iter().map(TableGroup::names).collect(), passed: None };
        let rows = || [&names].into_iter().chain(&self.rows);
        let width = |group: usize, column: usize| {
            let words = rows().filter_map(|row| row.cells[group].get(column));
            words.map(|word| word.chars().count()).max().unwrap_or(0)
        };
        let widths: Vec<Vec<usize>> = names
            .cells
            .iter()
            .enumerate()
            .map(|(group, names)| (0..names.len()).map(|column| width(group, column)).collect())
            .collect();
        for row in rows() {
            let mut cells: Vec<String> =
                row.cells.iter().zip(&widths).map(|(words, widths)| padded(words, widths)).collect();
            cells.resize(columns.len(), row.passed.map_or("", pass_word).to_owned());
            table.push(cells);
        }
        table.to_string().lines().map(|line| format!("    {line}\n")).collect()
    }

    pub(super) fn html(&self) -> String {
        let last = if self.has_verdicts() { "<th></th>" } else { "" };
        let groups: String = self.groups.iter().map(TableGroup::html_heading).collect();
        let names: String = self.groups.iter().map(TableGroup::html_names).collect();
        let rows: String = self.rows.iter().map(TableRow::html).collect();
        format!(
            "<div class=\"scroll\" tabindex=\"0\"><table>\n<tr><th></th>{groups}{last}</tr>\n\
             <tr><th>line</th>{names}{last}</tr>\n{rows}</table></div>\n"
        )
    }
}

impl TableGroup<'_> {
    fn column(&self) -> (&'static str, Align) {
        (self.heading, if self.ports.is_some() { Align::Left } else { Align::Right })
    }

    fn names(&self) -> Vec<String> {
        self.ports.map_or(vec![String::new()], |ports| ports.iter().map(|port| port.name.clone()).collect())
    }

    fn html_heading(&self) -> String {
        match self.ports {
            None => "<th></th>".to_owned(),
            Some([]) => String::new(),
            Some(ports) => format!("<th colspan=\"{}\">{}</th>", ports.len(), self.heading),
        }
    }

    fn html_names(&self) -> String {
        match self.ports {
            None => format!("<th>{}</th>", self.heading),
            Some(ports) => ports.iter().map(|port| format!("<th>{}</th>", escape(&port.name))).collect(),
        }
    }
}

impl TableRow {
    fn html(&self) -> String {
        let cells: String = self.cells.iter().flatten().map(|word| format!("<td>{}</td>", escape(word))).collect();
        let verdict = self.passed.map_or(String::new(), |passed| {
            let word = if passed { "pass" } else { "fail" };
            format!("<td class=\"{word}\">{word}</td>")
        });
        format!("<tr><td>{}</td>{cells}{verdict}</tr>\n", self.line)
    }
}

/// Words as one text, each as wide as its column.
fn padded(words: &[String], widths: &[usize]) -> String {
    let padded = words.iter().zip(widths).map(|(word, &width)| format!("{word:<width$}"));
    padded.collect::<Vec<_>>().join(" ").trim_end().to_owned()
}

fn words(values: &[impl ToString]) -> Vec<String> {
    values.iter().map(ToString::to_string).collect()
}

pub(super) fn pass_word(passed: bool) -> &'static str {
    if passed { "pass" } else { "FAIL" }
}
