//! Tests: columns are ports, rows are bits.

use crate::check::cell::{RowCell, cell, input_cell};
use crate::check::constant;
use crate::check::quantity;
use crate::check::wording;
use crate::syntax::tree::{self, NameSyntax, TestItem, TestTable, UntilSyntax};
use nbc_base::budget::{Limit, OverBudget, WorkBudget};
use nbc_base::diag::{Diagnostic, Suggestion};
use nbc_base::model::{Base, Column, ScriptStep, TestRow, Until};
use nbc_base::source::{SourceFile, Sources, Span};
use nbc_circuit::rows::{PortRow, RowFormat};

pub(crate) struct Ports<'a> {
    pub(crate) circuit: &'a str,
    pub(crate) inputs: &'a [Column],
    pub(crate) outputs: &'a [Column],
    /// Inputs that an environment gives, which have no columns.
    pub(crate) given: Vec<String>,
}

/// Rows are counted before they are repeated.
pub(crate) fn steps(
    table: &TestTable,
    ports: &Ports<'_>,
    (budget, worlds): (&mut WorkBudget, usize),
    sources: &Sources,
    faults: &mut Vec<Diagnostic>,
) -> Vec<ScriptStep> {
    let before = faults.len();
    let inputs = ports.places(&table.inputs, true, faults);
    let outputs = ports.places(&table.outputs, false, faults);
    missing_inputs(table, ports, faults);
    if table.rows.is_empty() {
        faults.push(wording::empty_test(table.header));
    }
    if faults.len() > before {
        return Vec::new();
    }
    let bits = ports.inputs.iter().chain(ports.outputs).map(|column| column.width as u64 + 1).sum();
    if let Err(over) = take_rows(budget, count(&table.rows).saturating_mul(worlds as u64), bits) {
        faults.push(over.at(table.header));
        return Vec::new();
    }
    let columns = Columns { ports, inputs: &inputs, outputs: &outputs, sources };
    let (mut steps, mut number) = (Vec::new(), 0);
    columns.items(&table.rows, &mut number, &mut steps, faults);
    steps
}

pub(crate) fn take_rows(budget: &mut WorkBudget, rows: u64, bits: u64) -> Result<(), OverBudget> {
    budget.take(Limit::Rows, rows)?;
    budget.take(Limit::RowBits, rows.saturating_mul(bits))
}

/// A repeated row counts each time, and one with a pulse is two rows.
fn count(items: &[TestItem]) -> u64 {
    let rows = items.iter().map(|item| match item {
        TestItem::Row(row) => 1 + u64::from(row.inputs.iter().any(|word| word.text == "^")),
        TestItem::Repeat { times, rows, .. } => {
            // What is no number has an error of its own.
            constant::integer(&times.text).map_or(1, |times: u64| times.saturating_mul(count(rows)))
        }
    });
    rows.fold(0, u64::saturating_add)
}

pub(crate) fn file_rows(
    source: &SourceFile,
    circuit: &str,
    inputs: &[Column],
    outputs: &[Column],
    (budget, worlds): (&mut WorkBudget, usize),
    path: Span,
) -> Result<Vec<TestRow>, Vec<Diagnostic>> {
    let format = RowFormat::of_path(&source.name).expect("other files are not read");
    let rows = format.read(source)?.bind(circuit, inputs, outputs)?;
    let bits = inputs.iter().chain(outputs).map(|column| column.width as u64 + 1).sum();
    take_rows(budget, (rows.len() as u64).saturating_mul(worlds as u64), bits).map_err(|over| vec![over.at(path)])?;
    let base = |port: &Column| match (format, port.width) {
        (RowFormat::Pla, _) | (_, 1) => Base::Bits,
        (RowFormat::Csv, width) => {
            if width > FEW_BITS {
                Base::Hexadecimal
            } else {
                Base::Plain
            }
        }
    };
    let bases: Vec<Base> = inputs.iter().chain(outputs).map(base).collect();
    let row = |(at, PortRow { inputs, outputs, span }): (usize, PortRow)| TestRow {
        inputs,
        expected: outputs,
        bases: bases.clone(),
        hold: None,
        span,
        line: source.line_column(span.start as usize).line,
        row: at + 1,
        is_half: false,
        given_up: None,
    };
    Ok(rows.into_iter().enumerate().map(row).collect())
}

const FEW_BITS: usize = 16;

impl Ports<'_> {
    fn places(&self, names: &[NameSyntax], inputs: bool, faults: &mut Vec<Diagnostic>) -> Vec<usize> {
        let own = if inputs { self.inputs } else { self.outputs };
        let mut places = Vec::new();
        for (at, name) in names.iter().enumerate() {
            if let Some(first) = names[..at].iter().find(|first| first.text == name.text) {
                faults.push(wording::duplicate("column", name, first.span));
            }
            match own.iter().position(|column| column.name == name.text) {
                Some(_) if inputs && self.given.contains(&name.text) => {
                    faults.push(wording::given_input(name));
                }
                Some(place) => places.push(place),
                None => faults.push(self.no_port(name, inputs)),
            }
        }
        places
    }

    fn no_port(&self, name: &NameSyntax, is_input: bool) -> Diagnostic {
        let (own, others) = if is_input { (self.inputs, self.outputs) } else { (self.outputs, self.inputs) };
        let [kind, other] = if is_input { ["input", "output"] } else { ["output", "input"] };
        if others.iter().any(|column| column.name == name.text) {
            return wording::port_beside_bar(self.circuit, kind, name, other);
        }
        let meant = Suggestion::of(&name.text, own.iter().map(|column| column.name.as_str()));
        wording::unknown_port(self.circuit, kind, name, &meant)
    }
}

fn missing_inputs(table: &TestTable, ports: &Ports<'_>, faults: &mut Vec<Diagnostic>) {
    let missing: Vec<_> = ports
        .inputs
        .iter()
        .map(|column| column.name.as_str())
        .filter(|input| !ports.given.iter().any(|given| given == input))
        .filter(|input| !table.inputs.iter().any(|name| name.text == *input))
        .collect();
    if !missing.is_empty() {
        faults.push(wording::missing_inputs(&missing, ports.circuit, table.header));
    }
}

struct Columns<'a> {
    ports: &'a Ports<'a>,
    inputs: &'a [usize],
    outputs: &'a [usize],
    sources: &'a Sources,
}

impl Columns<'_> {
    /// `number` is that of the last row.
    fn items(&self, items: &[TestItem], number: &mut usize, steps: &mut Vec<ScriptStep>, faults: &mut Vec<Diagnostic>) {
        for item in items {
            match item {
                TestItem::Row(row) => {
                    *number += 1;
                    let rows = self.row(*number, row, faults);
                    let until = row.until.as_ref().map(|until| self.until(until));
                    let until = until.map(|until| until.map_err(|fault| faults.push(fault)).ok());
                    if !rows.is_empty() {
                        steps.push(ScriptStep { rows, until: until.flatten() });
                    }
                }
                TestItem::Repeat { times, rows, .. } => {
                    let Some(times) = constant::integer::<usize>(&times.text).filter(|times| *times > 0) else {
                        faults.push(wording::no_times(&times.text, times.span));
                        continue;
                    };
                    let mut once = Vec::new();
                    self.items(rows, number, &mut once, faults);
                    steps.extend(std::iter::repeat_n(once, times).flatten());
                }
            }
        }
    }

    fn until(&self, source: &UntilSyntax) -> Result<Until, Diagnostic> {
        let name = &source.output;
        let place = self.ports.outputs.iter().position(|column| column.name == name.text);
        let place = place.ok_or_else(|| self.ports.no_port(name, false))?;
        let column = &self.ports.outputs[place];
        let bits = match &source.value {
            None if column.width == 1 => vec![Some(true)],
            None => return Err(wording::until_without_value(name)),
            Some(word) => match cell(word, column)? {
                RowCell::Bits(bits, _) => bits,
                RowCell::Pulse => return Err(wording::pulsed_output(word.span)),
            },
        };
        let most = constant::integer::<u64>(&source.most.text).filter(|most| *most > 0);
        let most = most.filter(|most| Limit::Repetitions.permit(*most).is_ok());
        let most = most.ok_or_else(|| wording::many_rows(Limit::Repetitions.most(), source.most.span))?;
        let most = most as usize;
        let first = self.ports.outputs[..place].iter().map(|column| column.width).sum();
        Ok(Until { first, bits, most, output: name.text.clone(), span: name.span })
    }

    /// A rising edge of a clock takes two rows.
    fn row(&self, number: usize, row: &tree::TestRowSyntax, faults: &mut Vec<Diagnostic>) -> Vec<TestRow> {
        if let Some(fault) = self.shape_fault(row) {
            faults.push(fault);
            return Vec::new();
        }
        let mut found = Vec::new();
        let mut inputs = cells(&row.inputs, self.inputs, self.ports.inputs, input_cell, &mut found);
        for (input, port) in inputs.iter_mut().zip(self.ports.inputs) {
            if self.ports.given.contains(&port.name) {
                *input = Some(RowCell::Bits(vec![Some(false); port.width], Base::of_port(port)));
            }
        }
        let outputs = cells(&row.outputs, self.outputs, self.ports.outputs, cell, &mut found);
        let hold = row.hold.as_ref().and_then(|hold| quantity::cycles(hold).map_err(|fault| found.push(fault)).ok());
        let expected = output_bits(&outputs, &row.outputs, &mut found);
        let bases: Vec<Base> = inputs.iter().chain(&outputs).map(base).collect();
        let line = self.sources.file(row.span.file).line_column(row.span.start as usize).line;
        let turns = if inputs.contains(&Some(RowCell::Pulse)) { 2 } else { 1 };
        let mut rows = Vec::new();
        for turn in (0..turns).rev() {
            let inputs = input_bits(&inputs, self.ports.inputs, turn == 0, row.span, &mut found);
            let expected = if turn == 0 { expected.clone() } else { vec![None; expected.len()] };
            let (bases, span, is_half, given_up) = (bases.clone(), row.span, turn != 0, None);
            rows.push(TestRow { inputs, expected, bases, hold, span, line, row: number, is_half, given_up });
        }
        if !found.is_empty() {
            rows.clear();
        }
        faults.extend(found);
        rows
    }

    fn shape_fault(&self, row: &tree::TestRowSyntax) -> Option<Diagnostic> {
        let values = row.inputs.len() + row.outputs.len();
        let columns = self.inputs.len() + self.outputs.len();
        if row.bars.len() > 1 {
            return Some(wording::two_bars(row.bars[1]));
        }
        if values != columns {
            return Some(wording::row_width(values, columns, row.span));
        }
        let Some(&bar) = row.bars.first() else { return Some(wording::no_bar(row.span)) };
        let inputs = self.inputs.len();
        (row.inputs.len() != inputs).then(|| wording::bar_elsewhere(inputs, bar))
    }
}

fn cells(
    words: &[NameSyntax],
    places: &[usize],
    ports: &[Column],
    read: fn(&NameSyntax, &Column) -> Result<RowCell, Diagnostic>,
    faults: &mut Vec<Diagnostic>,
) -> Vec<Option<RowCell>> {
    let mut cells: Vec<_> =
        ports.iter().map(|port| Some(RowCell::Bits(vec![None; port.width], Base::of_port(port)))).collect();
    for (word, &place) in words.iter().zip(places) {
        cells[place] = read(word, &ports[place]).map_err(|fault| faults.push(fault)).ok();
    }
    cells
}

fn output_bits(cells: &[Option<RowCell>], words: &[NameSyntax], faults: &mut Vec<Diagnostic>) -> Vec<Option<bool>> {
    if let Some(word) = words.iter().find(|word| word.text == "^") {
        faults.push(wording::pulsed_output(word.span));
    }
    let bits = |cell: &Option<RowCell>| match cell {
        Some(RowCell::Bits(bits, _)) => bits.clone(),
        _ => Vec::new(),
    };
    cells.iter().flat_map(bits).collect()
}

fn base(cell: &Option<RowCell>) -> Base {
    match cell {
        Some(RowCell::Bits(_, base)) => *base,
        _ => Base::Bits,
    }
}

fn input_bits(
    cells: &[Option<RowCell>],
    ports: &[Column],
    high: bool,
    row: Span,
    faults: &mut Vec<Diagnostic>,
) -> Vec<bool> {
    let mut all = Vec::new();
    for (cell, port) in cells.iter().zip(ports) {
        match cell {
            Some(RowCell::Pulse) => all.push(high),
            Some(RowCell::Bits(bits, _)) => match bits.iter().copied().collect::<Option<Vec<bool>>>() {
                Some(bits) => all.extend(bits),
                None => {
                    let fault = wording::input_without_value(&port.name, row);
                    if !faults.contains(&fault) {
                        faults.push(fault);
                    }
                }
            },
            None => {}
        }
    }
    all
}
