//! The columns of a file as the ports of a circuit.

use std::collections::BTreeMap;

use super::ports::{FileRow, RowFile};
use super::wording::{self, MOST_ERRORS};
use nbc_base::diag::{Diagnostic, Suggestion};
use nbc_base::model::Column;
use nbc_base::source::Span;

#[derive(Clone, Debug, PartialEq, Eq)]
pub struct PortRow {
    /// The input bits in order of the ports, the most significant bit of a port first.
    pub inputs: Vec<bool>,
    /// The output bits likewise; `None` is any value.
    pub outputs: Vec<Option<bool>>,
    pub span: Span,
}

impl RowFile {
    /// A column is a port or a bit of one. Every input has columns, and at least one output; others may be anything.
    pub fn bind(&self, circuit: &str, inputs: &[Column], outputs: &[Column]) -> Result<Vec<PortRow>, Vec<Diagnostic>> {
        let (inputs, outputs) = self.places(circuit, inputs, outputs)?;
        let mut errors = Vec::new();
        let mut rows = Vec::with_capacity(self.rows.len());
        for row in &self.rows {
            match port_row(row, &inputs, &outputs) {
                Ok(row) => rows.push(row),
                Err(error) => errors.push(error),
            }
            if errors.len() == MOST_ERRORS {
                break;
            }
        }
        if errors.is_empty() { Ok(rows) } else { Err(errors) }
    }

    fn places<'p>(
        &self,
        circuit: &str,
        inputs: &'p [Column],
        outputs: &'p [Column],
    ) -> Result<(Vec<Place<'p>>, Vec<Place<'p>>), Vec<Diagnostic>> {
        let starts = self.starts();
        let mut known: BTreeMap<&str, usize> =
            self.columns.iter().enumerate().map(|(at, column)| (column.name.as_str(), at)).collect();
        let (mut errors, header) = (Vec::new(), self.columns[0].span);
        let mut place = |port: &'p Column| {
            let bits: Vec<String> = (0..port.width).rev().map(|bit| format!("{}[{bit}]", port.name)).collect();
            let part = |at: usize, wanted| Part { start: starts[at], width: self.columns[at].width, wanted };
            let whole = known.remove(port.name.as_str());
            if let Some(at) = whole {
                if let Some(bit) = bits.iter().find(|bit| known.contains_key(bit.as_str())) {
                    let span = self.columns[known[bit.as_str()]].span;
                    errors.push(wording::bit_and_port(&port.name, span));
                }
                return Some(Place { port, parts: vec![part(at, port.width)] });
            }
            if !bits.iter().all(|bit| known.contains_key(bit.as_str())) {
                return None;
            }
            let parts = bits.iter().map(|bit| part(known.remove(bit.as_str()).expect("all bits are there"), 1));
            Some(Place { port, parts: parts.collect() })
        };
        let mut missing = Vec::new();
        let mut side = |ports: &'p [Column]| {
            let mut found = Vec::new();
            for port in ports {
                match place(port) {
                    Some(place) => found.push(place),
                    None => {
                        missing.push(port.name.clone());
                        found.push(Place { port, parts: Vec::new() });
                    }
                }
            }
            found
        };
        let found = (side(inputs), side(outputs));
        let is_input = |port: &String| inputs.iter().any(|input| input.name == *port);
        let needed = if found.1.iter().all(|place| place.parts.is_empty()) { missing.len() } else { 0 };
        let needed =
            missing.iter().enumerate().filter(|(at, port)| is_input(port) || *at < needed).map(|(_, port)| port);
        for port in needed.take(MOST_ERRORS) {
            errors.push(wording::no_column(port, circuit, header));
        }
        let ports = || inputs.iter().chain(outputs).map(|port| port.name.as_str());
        let mut strange: Vec<usize> = known.into_values().collect();
        strange.sort_unstable();
        for column in strange.into_iter().map(|at| &self.columns[at]).take(MOST_ERRORS) {
            let meant = Suggestion::of(&column.name, ports());
            errors.push(wording::no_port(&column.name, circuit, &meant, column.span));
        }
        if errors.is_empty() { Ok(found) } else { Err(errors) }
    }
}

/// A port with its columns, the most significant bits first; none if it has none.
struct Place<'p> {
    port: &'p Column,
    parts: Vec<Part>,
}

struct Part {
    start: usize,
    width: usize,
    wanted: usize,
}

impl Place<'_> {
    /// The bits of the port in a row; `None` if a value does not fit.
    fn bits(&self, row: &FileRow) -> Option<Vec<Option<bool>>> {
        if self.parts.is_empty() {
            return Some(vec![None; self.port.width]);
        }
        let mut bits = Vec::with_capacity(self.port.width);
        for part in &self.parts {
            let own = &row.bits[part.start..part.start + part.width];
            if own.iter().all(Option::is_none) {
                bits.extend(std::iter::repeat_n(None, part.wanted));
                continue;
            }
            let (over, low) = own.split_at(part.width.saturating_sub(part.wanted));
            if over.iter().any(|&bit| bit != Some(false)) {
                return None;
            }
            bits.extend(std::iter::repeat_n(Some(false), part.wanted - low.len()));
            bits.extend(low);
        }
        Some(bits)
    }
}

fn port_row(row: &FileRow, inputs: &[Place<'_>], outputs: &[Place<'_>]) -> Result<PortRow, Diagnostic> {
    let value = |place: &Place<'_>| {
        let (port, width) = (&place.port.name, place.port.width);
        place.bits(row).ok_or_else(|| wording::unfitting(port, width, row.span))
    };
    let mut given = Vec::new();
    for place in inputs {
        let bits: Option<Vec<bool>> = value(place)?.into_iter().collect();
        given.extend(bits.ok_or_else(|| wording::open_input(&place.port.name, row.span))?);
    }
    let mut expected = Vec::new();
    for place in outputs {
        expected.extend(value(place)?);
    }
    Ok(PortRow { inputs: given, outputs: expected, span: row.span })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::rows::RowFormat;
    use nbc_base::source::FileId;

    /// The rows of a file for a circuit with the inputs `a` and `b[3]` and the outputs `q` and `r[2]`.
    fn check(text: &str, expected: Result<&[&str], &str>) {
        let file = RowFormat::Csv.parse(text, FileId(0)).unwrap();
        let inputs = [Column::new("a", 1), Column::new("b", 3)];
        let rows = file.bind("f", &inputs, &[Column::new("q", 1), Column::new("r", 2)]);
        let digit = |bit: Option<bool>| bit.map_or('-', |bit| if bit { '1' } else { '0' });
        let shown = rows.map(|rows| {
            let row = |row: PortRow| row.inputs.into_iter().map(Some).chain(row.outputs).map(digit).collect();
            rows.into_iter().map(row).collect::<Vec<String>>()
        });
        let shown = shown.map_err(|faults| faults[0].message.clone());
        assert_eq!(shown, expected.map(|rows| rows.iter().map(|&row| row.to_owned()).collect()).map_err(str::to_owned));
    }

    #[test]
    fn columns_are_ports_or_their_bits() {
        check("a,b,q,r\n1,5,0,2\n0,2,1,-\n", Ok(&["1101010", "00101--"]));
        check("r,b[0],b[2],b[1],a\n3,1,0,0,1\n", Ok(&["1001-11"]));
        check("a,b,q\n1,0x07,1\n", Ok(&["11111--"]));
    }

    #[test]
    fn what_does_not_fit_is_refused() {
        check("a,b,s\n1,1,1\n", Err("file has no column for `q` of `f`"));
        check("a,q\n1,1\n", Err("file has no column for `b` of `f`"));
        check("a,b[0],b[1],q\n1,1,1,1\n", Err("file has no column for `b` of `f`"));
        check("a,b,c,q\n1,1,1,1\n", Err("`f` has no port for the column `c`"));
        check("a,b,b[0],q\n1,1,1,1\n", Err("columns have `b` and its bits"));
        check("a,b,q\n1,8,1\n", Err("row has a value that does not fit into `b`"));
        check("a,b,q\n-,7,1\n", Err("row has no value for the input `a`"));
    }
}
