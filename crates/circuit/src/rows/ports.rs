//! The rows of a file, and the ports that its columns are.

use std::collections::{BTreeMap, BTreeSet};

use super::wording;
use nbc_base::diag::{Diagnostic, Suggestion};
use nbc_base::model::{Column, bit_parts};
use nbc_base::source::Span;

pub type RowPorts = (Vec<Column>, Vec<Column>);

#[derive(Clone, Debug, PartialEq, Eq)]
pub struct RowColumn {
    pub name: String,
    pub width: usize,
    pub is_output: Option<bool>,
    pub span: Span,
}

#[derive(Clone, Debug, PartialEq, Eq)]
pub struct FileRow {
    /// The bits of the columns in order, the most significant of a column first; `None` is any.
    pub bits: Vec<Option<bool>>,
    pub span: Span,
}

#[derive(Clone, Debug, PartialEq, Eq)]
pub struct RowFile {
    pub columns: Vec<RowColumn>,
    pub rows: Vec<FileRow>,
}

impl RowFile {
    pub fn starts(&self) -> Vec<usize> {
        let start = |next: &mut usize, column: &RowColumn| {
            *next += column.width;
            Some(*next - column.width)
        };
        self.columns.iter().scan(0, start).collect()
    }

    /// Columns `x[0]`, `x[1]`, … without a gap are one port. By default the format names outputs, or the last is one.
    pub fn ports(&self, outputs: &[String]) -> Result<RowPorts, Diagnostic> {
        let widths = self.bus_widths();
        let (mut ports, mut seen): (Vec<(Column, Option<bool>)>, _) = (Vec::new(), BTreeSet::new());
        for column in &self.columns {
            let bus = bit_parts(&column.name).and_then(|(base, _)| Some((base, *widths.get(base)?)));
            let (name, width) = bus.unwrap_or((&column.name, column.width));
            if seen.insert(name) {
                ports.push((Column::new(name, width), column.is_output));
            }
        }
        let names: Vec<&str> = ports.iter().map(|(port, _)| port.name.as_str()).collect();
        if let Some(output) = outputs.iter().find(|output| !names.contains(&output.as_str())) {
            let meant = Suggestion::of(output, names.iter().copied());
            return Err(wording::no_output(output, &meant));
        }
        let last = ports.len() - 1;
        let is_output = |at: usize, (port, said): &(Column, Option<bool>)| match said {
            _ if !outputs.is_empty() => outputs.contains(&port.name),
            Some(said) => *said,
            None => at == last,
        };
        let (found, inputs): (Vec<_>, Vec<_>) =
            ports.into_iter().enumerate().partition(|(at, port)| is_output(*at, port));
        let columns =
            |ports: Vec<(usize, (Column, Option<bool>))>| ports.into_iter().map(|(_, (port, _))| port).collect();
        if inputs.is_empty() {
            return Err(wording::no_inputs(self.columns[0].span));
        }
        Ok((columns(inputs), columns(found)))
    }

    fn bus_widths(&self) -> BTreeMap<&str, usize> {
        // The number of bits, and the highest. No bit is there twice, because columns have different names.
        let mut buses: BTreeMap<&str, (usize, usize)> = BTreeMap::new();
        for (name, bit) in self.columns.iter().filter_map(|column| bit_parts(&column.name)) {
            let (bits, highest) = buses.entry(name).or_default();
            (*bits, *highest) = (*bits + 1, bit.max(*highest));
        }
        let whole = buses.into_iter().filter(|(_, (bits, highest))| *bits == highest + 1);
        whole.map(|(name, (bits, _))| (name, bits)).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::rows::RowFormat;
    use nbc_base::source::FileId;

    fn check(format: RowFormat, text: &str, outputs: &[&str], expected: Result<&str, &str>) {
        let file = format.parse(text, FileId(0)).unwrap();
        let outputs: Vec<String> = outputs.iter().map(|&output| output.to_owned()).collect();
        let shown = |columns: Vec<Column>| {
            let port = |column: Column| format!("{}[{}]", column.name, column.width);
            columns.into_iter().map(port).collect::<Vec<_>>().join(" ")
        };
        let ports = file.ports(&outputs).map(|(inputs, outputs)| format!("{} | {}", shown(inputs), shown(outputs)));
        assert_eq!(ports.map_err(|fault| fault.message), expected.map(str::to_owned).map_err(str::to_owned));
    }

    #[test]
    fn columns_are_grouped_to_ports() {
        use RowFormat::{Csv, Pla};
        check(Csv, "a[1],b,a[0],q\n0,5,1,9\n", &[], Ok("a[2] b[3] | q[4]"));
        check(Csv, "a[1],b,q,r\n0,1,1,1\n", &["q", "b"], Ok("a[1][1] r[1] | b[1] q[1]"));
        check(Csv, "a,q\n0,1\n", &["p"], Err("the file has no columns for the output `p`"));
        check(Csv, "q\n1\n", &[], Err("no column is an input"));
        check(Pla, ".i 2\n.o 2\n.type fr\n01 11\n", &[], Ok("x[2] | y[2]"));
    }
}
