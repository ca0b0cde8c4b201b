//! Tables for spreadsheets and programs: CSV as in RFC 4180, with a header; a swarm's run is one.

use std::collections::BTreeSet;

use nbc_base::model::{Column, Value};
use nbc_swarm::SwarmTrace;

pub(super) fn line(cells: impl IntoIterator<Item = String>) -> String {
    cells.into_iter().collect::<Vec<_>>().join(",") + "\n"
}

/// A text that begins like a formula gets an apostrophe in front, which spreadsheets read as "this is text".
pub(super) fn cell(text: &str) -> String {
    let is_formula =
        text.trim_start().starts_with(['=', '+', '-', '@', '\u{ff1d}', '\u{ff0b}', '\u{ff0d}', '\u{ff20}']);
    let guard = if is_formula || text.starts_with(['\t', '\r', '\n']) { "'" } else { "" };
    let plain = !text.contains([',', '"', '\n', '\r']);
    if plain { format!("{guard}{text}") } else { format!("\"{guard}{}\"", text.replace('"', "\"\"")) }
}

/// Columns: the cycle from 1, inputs during it, outputs and all other nets at its end, voxels walked by each robot.
/// A port of one bit is `0` or `1`, a wider one a number, or quoted digits if it has more than 64 bits.
pub fn cycle_table(trace: &SwarmTrace) -> String {
    let ports: BTreeSet<String> = trace.inputs.iter().chain(&trace.outputs).flat_map(Column::bits).collect();
    let nets: Vec<usize> = (0..trace.robots.len()).filter(|&k| !ports.contains(&trace.robots[k].net)).collect();
    let names = trace.inputs.iter().chain(&trace.outputs).map(|port| port.name.clone());
    let inner = nets.iter().map(|&k| trace.robots[k].net.clone());
    let walks = trace.robots.iter().map(|robot| format!("{}.displacement", robot.net));
    let head = std::iter::once("cycle".to_owned()).chain(names).chain(inner).chain(walks).map(|name| cell(&name));
    let mut text = line(head);
    for (c, cycle) in trace.cycles.iter().enumerate() {
        let (inputs, outputs) = (trace.input_values(c), trace.output_values(c));
        let ports = inputs.iter().chain(&outputs).map(number);
        let inner = nets.iter().map(|&k| u8::from(cycle.bits[k]).to_string());
        let walks = (0..trace.robots.len()).map(|k| trace.displacement(k, c).to_string());
        text += &line(std::iter::once((c + 1).to_string()).chain(ports).chain(inner).chain(walks));
    }
    text
}

fn number(value: &Value) -> String {
    let digits = value.digits();
    u64::from_str_radix(&digits, 2).map_or_else(|_| cell(&value.to_string()), |number| number.to_string())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn separators_in_cells_are_quoted() {
        let cells = ["plain", "a,b", "say \"x\"", "two\nlines", ""].map(cell);
        assert_eq!(line(cells), "plain,\"a,b\",\"say \"\"x\"\"\",\"two\nlines\",\n");
    }

    #[test]
    fn texts_that_a_spreadsheet_would_compute_are_guarded() {
        let cells = ["=1+1", "+1", "-x", "@SUM(A1)", " =1", "\tx", "=\"a\",2", "\u{ff1d}1", "a=1", "1-2"].map(cell);
        let guarded = "'=1+1,'+1,'-x,'@SUM(A1),' =1,'\tx,\"'=\"\"a\"\",2\",'\u{ff1d}1,a=1,1-2\n";
        assert_eq!(line(cells), guarded);
    }
}
