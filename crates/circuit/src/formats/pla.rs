//! PLA files, as espresso writes them: cubes of input digits with the outputs that they set.

use std::fmt::Write;

use crate::formats::design::Design;
use crate::formats::draft::{Definition, Draft, MOST_ERRORS};
use crate::formats::names::{FileNames, visible};
use crate::formats::wording::{pla as wording, text};
use crate::interned::Interned;
use crate::two_level;
use crate::{NetId, Settled};
use nbc_base::budget::Limit;
use nbc_base::diag::Diagnostic;
use nbc_base::source::{FileId, Span};

/// What the digits of an output mean, and what an output is where no cube sets it.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum PlaType {
    /// `f`: cubes set outputs to 1, and they are 0 elsewhere.
    Ones,
    /// `fd`: cubes set outputs to 1 or leave them open, and they are 0 elsewhere.
    #[default]
    OnesOrOpen,
    /// `fr`: cubes set outputs to 1 or 0, and they are open elsewhere.
    OnesOrZeros,
    /// `fdr`: cubes set outputs to 1 or 0 or leave them open.
    All,
}

impl PlaType {
    pub fn is_listed(self) -> bool {
        matches!(self, Self::OnesOrZeros | Self::All)
    }

    fn meaning(self, digit: u8) -> Option<Option<bool>> {
        match digit {
            b'1' | b'4' => Some(Some(true)),
            b'0' if self.is_listed() => Some(Some(false)),
            b'-' | b'2' if matches!(self, Self::OnesOrOpen | Self::All) => Some(None),
            _ => None,
        }
    }
}

pub struct PlaCube {
    pub inputs: Vec<u8>,
    /// For each output, what the cube says of it: a value, open, or nothing.
    pub outputs: Vec<Option<Option<bool>>>,
    pub span: Span,
}

pub struct Pla {
    pub inputs: Vec<(String, Span)>,
    pub outputs: Vec<(String, Span)>,
    pub kind: PlaType,
    pub kind_span: Span,
    pub cubes: Vec<PlaCube>,
}

/// An output is 1 where a cube sets it to 1, and 0 elsewhere, also where it is open.
pub fn read(text: &str, file: FileId) -> Result<Design, Vec<Diagnostic>> {
    let pla = parse(text, file)?;
    let mut draft = Draft::default();
    let mut port = |(name, span): &(String, Span)| (draft.name(name), *span);
    let inputs: Vec<_> = pla.inputs.iter().map(&mut port).collect();
    let outputs: Vec<_> = pla.outputs.iter().map(&mut port).collect();
    let sets = |cube: &&PlaCube, output: usize| cube.outputs[output] == Some(Some(true));
    let ones = |output: usize| pla.cubes.iter().filter(move |cube| sets(cube, output));
    // All covers are counted before one is copied.
    let pins: u64 = (0..outputs.len()).map(|output| (inputs.len() * ones(output).count().max(1)) as u64).sum();
    if Limit::FilePins.permit(pins).is_err() {
        return Err(vec![text::too_many_pins(pla.kind_span)]);
    }
    for (at, &(name, span)) in outputs.iter().enumerate() {
        let cubes = ones(at).map(|cube| cube.inputs.clone()).collect();
        let pins = inputs.iter().map(|&(name, _)| name).collect();
        draft.define(name, Definition::Cover { pins, cubes, value: true }, span);
    }
    (draft.inputs, draft.outputs) = (inputs, outputs);
    draft.finish()
}

pub fn opened(text: &str, file: FileId) -> Vec<Diagnostic> {
    let Ok(pla) = parse(text, file) else { return Vec::new() };
    let open = pla.cubes.iter().find(|cube| cube.outputs.contains(&Some(None))).map(|cube| cube.span);
    let place = if pla.kind.is_listed() { Some(pla.kind_span) } else { open };
    place.map(wording::open_outputs).into_iter().collect()
}

pub fn parse(text: &str, file: FileId) -> Result<Pla, Vec<Diagnostic>> {
    let mut reader = Reader::new(file);
    let mut start = 0;
    for line in text.split_inclusive('\n') {
        let code = line.split('#').next().unwrap_or("");
        let words: Vec<(&str, Span)> = code
            .split_whitespace()
            .map(|word| {
                let at = start + (word.as_ptr() as usize - line.as_ptr() as usize);
                (word, Span::new(file, at, at + word.len()))
            })
            .collect();
        if !words.is_empty() && !reader.line(&words) {
            break;
        }
        start += line.len();
    }
    reader.finish()
}

struct Reader {
    file: FileId,
    widths: [Option<usize>; 2],
    labels: [Option<Vec<(String, Span)>>; 2],
    kind: PlaType,
    kind_span: Span,
    cubes: Vec<PlaCube>,
    digits: u64,
    errors: Vec<Diagnostic>,
}

impl Reader {
    fn new(file: FileId) -> Self {
        Self {
            file,
            widths: [None; 2],
            labels: [None, None],
            kind: PlaType::default(),
            kind_span: Span::new(file, 0, 0),
            cubes: Vec::new(),
            digits: 0,
            errors: Vec::new(),
        }
    }

    fn fault(&mut self, error: Diagnostic) {
        if self.errors.len() < MOST_ERRORS {
            self.errors.push(error);
        }
    }

    fn line(&mut self, words: &[(&str, Span)]) -> bool {
        let (first, span) = words[0];
        match first {
            ".i" | ".o" => self.width(usize::from(first == ".o"), words),
            ".ilb" | ".ob" => self.names(usize::from(first == ".ob"), words),
            ".type" => self.kind(words),
            // The number of cubes is counted, and not believed.
            ".p" => {}
            ".e" | ".end" => return false,
            _ if first.starts_with('.') => self.fault(wording::unknown_directive(first, span)),
            _ => return self.cube(words),
        }
        self.errors.len() < MOST_ERRORS
    }

    fn width(&mut self, side: usize, words: &[(&str, Span)]) {
        let span = words[0].1;
        let read = words.get(1).and_then(|(number, _)| number.parse::<u64>().ok()).filter(|number| *number > 0);
        match read {
            Some(width) if Limit::Width.permit(width).is_ok() => self.widths[side] = Some(width as usize),
            Some(_) => self.fault(text::too_many("ports on a side", Limit::Width.most(), span)),
            None => self.fault(wording::no_count(words[0].0, span)),
        }
    }

    fn names(&mut self, side: usize, words: &[(&str, Span)]) {
        let is_long = |name: &str| Limit::FileNameBytes.permit(name.len() as u64).is_err();
        if let Some(&(name, span)) = words.iter().find(|(name, _)| is_long(name)) {
            return self.fault(text::long_name(name.len(), span));
        }
        self.labels[side] = Some(words[1..].iter().map(|&(name, span)| (name.to_owned(), span)).collect());
    }

    fn kind(&mut self, words: &[(&str, Span)]) {
        let &(word, span) = words.get(1).unwrap_or(&words[0]);
        self.kind = match word {
            "f" => PlaType::Ones,
            "fd" => PlaType::OnesOrOpen,
            "fr" => PlaType::OnesOrZeros,
            "fdr" => PlaType::All,
            _ => return self.fault(wording::unknown_type(word, span)),
        };
        self.kind_span = span;
    }

    fn cube(&mut self, words: &[(&str, Span)]) -> bool {
        let span = words[0].1.to(words[words.len() - 1].1);
        let digits: Vec<u8> = words.iter().flat_map(|(word, _)| word.bytes()).filter(|&digit| digit != b'|').collect();
        self.digits += digits.len() as u64;
        if Limit::RowBits.permit(self.digits).is_err() {
            self.fault(text::too_many("digits", Limit::RowBits.most(), span));
            return false;
        }
        match self.read_cube(&digits, span) {
            Ok(cube) => self.cubes.push(cube),
            Err(error) => self.fault(error),
        }
        self.errors.len() < MOST_ERRORS
    }

    fn read_cube(&self, digits: &[u8], span: Span) -> Result<PlaCube, Diagnostic> {
        let [Some(inputs), Some(outputs)] = self.widths else { return Err(wording::no_widths(span)) };
        if digits.len() != inputs + outputs {
            return Err(wording::cube_width(inputs, outputs, digits.len(), span));
        }
        let (left, right) = digits.split_at(inputs);
        let other = |digits: &[u8], known: &[u8]| digits.iter().copied().find(|digit| !known.contains(digit));
        if let Some(found) = other(left, b"01-2") {
            return Err(wording::input_digit(found, span));
        }
        if let Some(found) = other(right, b"01-2~34") {
            return Err(wording::output_digit(found, span));
        }
        let inputs = left.iter().map(|&digit| if digit == b'2' { b'-' } else { digit }).collect();
        let outputs = right.iter().map(|&digit| self.kind.meaning(digit)).collect();
        Ok(PlaCube { inputs, outputs, span })
    }

    fn finish(mut self) -> Result<Pla, Vec<Diagnostic>> {
        let start = Span::new(self.file, 0, 0);
        let [Some(inputs), Some(outputs)] = self.widths else {
            if self.errors.is_empty() {
                self.fault(wording::no_widths(start));
            }
            return Err(self.errors);
        };
        let mut named = |side: usize, width: usize, letter: &str| {
            let Some(names) = self.labels[side].take() else { return numbered(letter, width, start) };
            if names.len() != width {
                let span = names.last().map_or(start, |(_, span)| *span);
                self.errors.push(wording::port_names(width, names.len(), span));
            }
            names
        };
        let (inputs, outputs) = (named(0, inputs, "x"), named(1, outputs, "y"));
        if !self.errors.is_empty() {
            return Err(self.errors);
        }
        let (kind, kind_span, cubes) = (self.kind, self.kind_span, self.cubes);
        Ok(Pla { inputs, outputs, kind, kind_span, cubes })
    }
}

fn numbered(letter: &str, width: usize, span: Span) -> Vec<(String, Span)> {
    match width {
        1 => vec![(letter.to_owned(), span)],
        _ => (0..width).rev().map(|bit| (format!("{letter}[{bit}]"), span)).collect(),
    }
}

/// The design has no registers and no loops, and so few inputs that its truth table can be written.
pub fn write(design: &Design) -> String {
    let netlist = &design.netlist;
    let (inputs, outputs) = (netlist.inputs(), netlist.outputs());
    let names = FileNames::new(design, &[], true, |name| visible(name, &['#']));
    let list = |ids: &[NetId]| ids.iter().map(|&id| format!(" {}", names.net(id))).collect::<String>();
    let (mut cubes, mut cube_outputs) = (Interned::default(), Vec::new());
    for (output, table) in tables(design).into_iter().enumerate() {
        for cube in two_level::cover(&table, &table) {
            let place = cubes.number(cube);
            cube_outputs.resize(cubes.items.len(), vec![b'0'; outputs.len()]);
            cube_outputs[place][output] = b'1';
        }
    }
    let mut text = format!(".i {}\n.o {}\n", inputs.len(), outputs.len());
    let _ = write!(text, ".ilb{}\n.ob{}\n.p {}\n", list(inputs), list(outputs), cubes.items.len());
    for (cube, outputs) in cubes.items.iter().zip(&cube_outputs) {
        let digits = |digits: &[u8]| String::from_utf8_lossy(digits).into_owned();
        let _ = writeln!(text, "{} {}", digits(cube), digits(outputs));
    }
    text.push_str(".e\n");
    text
}

fn tables(design: &Design) -> Vec<Vec<bool>> {
    let bits = design.netlist.inputs().len();
    let mut tables = vec![Vec::with_capacity(1 << bits); design.netlist.outputs().len()];
    let mut settled = Settled::new(&design.netlist);
    let inputs = |pattern: usize| (0..bits).rev().map(|bit| pattern >> bit & 1 == 1).collect();
    for first in (0..1usize << bits).step_by(Settled::ROWS) {
        let block: Vec<Vec<bool>> = (first..(first + Settled::ROWS).min(1 << bits)).map(inputs).collect();
        for end in settled.apply(&block.iter().map(Vec::as_slice).collect::<Vec<_>>()) {
            tables.iter_mut().zip(end.outputs).for_each(|(table, bit)| table.push(bit));
        }
    }
    tables
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Logic;

    fn check(text: &str, expected: &[&str]) {
        let design = read(text, FileId(0)).unwrap_or_else(|faults| panic!("{faults:?}"));
        let inputs = design.netlist.inputs().len();
        let mut logic = Logic::new(&design.netlist);
        let found: Vec<String> = (0..1usize << inputs)
            .map(|row| {
                let bits: Vec<bool> = (0..inputs).rev().map(|bit| row >> bit & 1 == 1).collect();
                logic.settle(&bits).expect("no loops").iter().map(|&bit| if bit { '1' } else { '0' }).collect()
            })
            .collect();
        assert_eq!(found, expected, "{text}");
    }

    #[test]
    fn an_output_is_1_where_a_cube_says_so() {
        check(".i 2\n.o 2\n1- 10\n-1 11 # both\n.e\nnothing is read here", &["00", "11", "10", "11"]);
        check(".i 2\n.o 1\n.type fr\n.p 9\n11|1\n0- 0\n", &["0", "0", "0", "1"]);
        check(".i 1\n.o 3\n.ilb a\n.ob p q r\n.type fdr\n1 1-0\n0 ~01\n", &["001", "100"]);
    }

    #[test]
    fn ports_are_named_from_the_highest_bit() {
        let names = |text: &str| {
            let pla = parse(text, FileId(0)).unwrap();
            let name = |(name, _): (String, Span)| name;
            (
                pla.inputs.into_iter().map(name).collect::<Vec<_>>(),
                pla.outputs.into_iter().map(name).collect::<Vec<_>>(),
            )
        };
        assert_eq!(names(".i 2\n.o 1\n"), (vec!["x[1]".to_owned(), "x[0]".to_owned()], vec!["y".to_owned()]));
        assert_eq!(names(".i 1\n.o 1\n.ilb a\n.ob b\n"), (vec!["a".to_owned()], vec!["b".to_owned()]));
    }

    #[test]
    fn open_outputs_are_warned_of() {
        let count = |text: &str| opened(text, FileId(0)).len();
        assert_eq!(count(".i 1\n.o 1\n1 1\n"), 0);
        assert_eq!(count(".i 1\n.o 1\n1 -\n"), 1);
        assert_eq!(count(".i 1\n.o 1\n.type f\n1 -\n"), 0, "it says nothing there");
        assert_eq!(count(".i 1\n.o 1\n.type fr\n1 1\n"), 1);
    }
}
