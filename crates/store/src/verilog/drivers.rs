//! What drives each net of a flat module in Yosys' own text (RTLIL), before Yosys chooses between several drivers.

use std::collections::{BTreeMap, BTreeSet};

use crate::verilog::rtlil::source_line;

/// A bit of a module that has two drivers.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct DrivenTwice {
    pub(super) module: String,
    pub(super) net: String,
    /// The bit, if the net has several.
    pub(super) bit: Option<usize>,
    pub(super) drivers: [NetDriver; 2],
}

/// What drives a bit.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) enum NetDriver {
    /// The module's own input.
    Input,
    Constant(char),
    /// Another net with a name in the source.
    Net(String),
    /// Logic or a register, with its line.
    Logic {
        is_register: bool,
        line: Option<usize>,
    },
}

/// A wire, and the numbers of its bits.
struct Wire<'t> {
    name: &'t str,
    first: usize,
    width: usize,
    /// The number of its lowest bit, if they count upward.
    lowest: Option<usize>,
}

/// A bit: a number, or a constant.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Bit {
    Net(usize),
    Constant(char),
}

#[derive(Clone, Copy, PartialEq, Eq)]
enum Source {
    Input,
    Bit(Bit),
    Cell(usize),
}

struct Cell<'t> {
    kind: &'t str,
    line: Option<usize>,
    reads: Vec<Bit>,
}

/// The bits of some modules that have two drivers and that their outputs depend on.
pub(super) fn driven_twice(rtlil: &str, modules: &[String]) -> Vec<DrivenTwice> {
    // What follows the end of a module may be one with a name of Yosys.
    let whole = rtlil.split("\nmodule \\").skip(1).filter_map(|text| text.split("\nend").next());
    let texts: BTreeMap<&str, &str> = whole.map(|text| (text.lines().next().unwrap_or_default(), text)).collect();
    let outputs: BTreeMap<&str, BTreeSet<&str>> = texts.iter().map(|(name, text)| (*name, outputs(text))).collect();
    let found = modules.iter().filter_map(|name| Some((name, texts.get(name.as_str())?)));
    found.flat_map(|(name, text)| Module::of(text, &outputs).driven_twice(name)).collect()
}

/// The names of the output ports of a module.
fn outputs(text: &str) -> BTreeSet<&str> {
    let wires = text.lines().filter_map(|line| line.trim_start().strip_prefix("wire "));
    wires.filter(|wire| wire.contains(" output ") || wire.starts_with("output ")).filter_map(name).collect()
}

/// The name at the end of the declaration of a wire.
fn name(wire: &str) -> Option<&str> {
    wire.split(' ').next_back()
}

/// A module, as far as its nets are concerned.
#[derive(Default)]
struct Module<'t> {
    wires: Vec<Wire<'t>>,
    numbers: BTreeMap<&'t str, usize>,
    bits: usize,
    cells: Vec<Cell<'t>>,
    /// The drivers of each bit.
    drivers: Vec<Vec<Source>>,
    /// The bits that are read by name: outputs.
    roots: Vec<usize>,
}

impl<'t> Module<'t> {
    fn of(text: &'t str, outputs: &BTreeMap<&str, BTreeSet<&str>>) -> Self {
        let mut module = Self::default();
        let lines = || text.lines().skip(1).map(str::trim);
        for wire in lines().filter_map(|line| line.strip_prefix("wire ")) {
            module.wire(wire);
        }
        let (mut line, mut cell) = (None, None);
        for text in lines() {
            if let Some(place) = text.strip_prefix("attribute \\src ") {
                line = source_line(place);
            } else if let Some(kind) = text.strip_prefix("cell ").and_then(|cell| cell.split(' ').next()) {
                cell = Some(module.cells.len());
                module.cells.push(Cell { kind, line: line.take(), reads: Vec::new() });
            } else if text == "end" {
                cell = None;
            } else if let Some(text) = text.strip_prefix("connect ") {
                let mut words = Words(text);
                match cell {
                    None => {
                        let (to, from) = (module.signal(&mut words), module.signal(&mut words));
                        for (to, from) in to.into_iter().zip(from) {
                            module.drive(to, Source::Bit(from));
                        }
                    }
                    Some(cell) => {
                        let port = words.next().unwrap_or_default();
                        let bits = module.signal(&mut words);
                        let kind = module.cells[cell].kind;
                        let is_output = match kind.strip_prefix('\\').and_then(|kind| outputs.get(kind)) {
                            Some(outputs) => outputs.contains(port),
                            None => is_output(kind, port.trim_start_matches('\\')),
                        };
                        match is_output {
                            true => bits.into_iter().for_each(|bit| module.drive(bit, Source::Cell(cell))),
                            false => module.cells[cell].reads.extend(bits),
                        }
                    }
                }
            }
        }
        module
    }

    fn wire(&mut self, wire: &'t str) {
        let Some(name) = name(wire) else { return };
        let words: Vec<&str> = wire.split(' ').collect();
        let number = |of: &str| words.windows(2).find(|pair| pair[0] == of).and_then(|pair| pair[1].parse().ok());
        let width = number("width").unwrap_or(1);
        let lowest = (!words.contains(&"upto")).then(|| number("offset").unwrap_or(0));
        let first = self.bits;
        self.numbers.insert(name, self.wires.len());
        self.wires.push(Wire { name, first, width, lowest });
        self.bits += width;
        self.drivers.resize(self.bits, Vec::new());
        if words.contains(&"output") {
            self.roots.extend(first..self.bits);
        } else if words.contains(&"input") {
            (first..self.bits).for_each(|bit| self.drivers[bit].push(Source::Input));
        }
    }

    fn drive(&mut self, bit: Bit, source: Source) {
        let Bit::Net(number) = bit else { return };
        if source != Source::Bit(bit) && self.drivers[number].len() < 2 {
            self.drivers[number].push(source);
        }
    }

    /// The bits of the next signal, lowest first.
    fn signal(&self, words: &mut Words<'t>) -> Vec<Bit> {
        let Some(word) = words.next() else { return Vec::new() };
        if word == "{" {
            let mut parts = Vec::new();
            while !words.at("}") && !words.0.is_empty() {
                parts.push(self.signal(words));
            }
            words.next();
            return parts.into_iter().rev().flatten().collect();
        }
        if let Some((_, digits)) = word.split_once('\'').filter(|_| word.starts_with(|c: char| c.is_ascii_digit())) {
            return digits.chars().rev().map(Bit::Constant).collect();
        }
        let Some(wire) = self.numbers.get(word).map(|&at| &self.wires[at]) else { return Vec::new() };
        let mut range = 0..wire.width;
        while words.0.starts_with('[') {
            let part = words.next().unwrap_or_default().trim_matches(['[', ']']);
            let (high, low) = part.split_once(':').unwrap_or((part, part));
            if let (Ok(high), Ok(low)) = (high.parse::<usize>(), low.parse::<usize>()) {
                range = range.start + low..(range.start + high + 1).min(wire.width);
            }
        }
        range.map(|bit| Bit::Net(wire.first + bit)).collect()
    }

    /// The bits that outputs depend on.
    fn live(&self) -> Vec<bool> {
        let mut live = vec![false; self.bits];
        let mut is_done = vec![false; self.cells.len()];
        let mut open = self.roots.clone();
        let read = |bits: &[Bit], open: &mut Vec<usize>| {
            open.extend(bits.iter().filter_map(|bit| if let Bit::Net(number) = bit { Some(*number) } else { None }));
        };
        // What writes to a memory has no output.
        for cell in self.cells.iter().filter(|cell| cell.kind.starts_with("$mem")) {
            read(&cell.reads, &mut open);
        }
        while let Some(bit) = open.pop() {
            if std::mem::replace(&mut live[bit], true) {
                continue;
            }
            for source in &self.drivers[bit] {
                match *source {
                    Source::Input => {}
                    Source::Bit(bit) => read(&[bit], &mut open),
                    Source::Cell(cell) if !std::mem::replace(&mut is_done[cell], true) => {
                        read(&self.cells[cell].reads, &mut open);
                    }
                    Source::Cell(_) => {}
                }
            }
        }
        live
    }

    /// The first bit with two drivers of each net with a name.
    fn driven_twice(&self, module: &str) -> Vec<DrivenTwice> {
        let live = self.live();
        let is_twice = |bit: &usize| live[*bit] && self.drivers[*bit].len() > 1;
        let named = self.wires.iter().filter_map(|wire| Some((wire, wire.name.strip_prefix('\\')?)));
        named
            .filter_map(|(wire, net)| {
                let bit = (wire.first..wire.first + wire.width).find(is_twice)?;
                let drivers = [0, 1].map(|at| self.driver(self.drivers[bit][at]));
                let (module, net) = (module.to_owned(), net.to_owned());
                let bit = wire.lowest.filter(|_| wire.width > 1).map(|lowest| bit - wire.first + lowest);
                Some(DrivenTwice { module, net, bit, drivers })
            })
            .collect()
    }

    /// A driver, followed through nets without a name in the source.
    fn driver(&self, source: Source) -> NetDriver {
        let mut source = source;
        for _ in 0..self.bits {
            source = match source {
                Source::Input => return NetDriver::Input,
                Source::Bit(Bit::Constant(digit)) => return NetDriver::Constant(digit),
                Source::Cell(cell) => {
                    let Cell { kind, line, .. } = self.cells[cell];
                    let is_register = kind.contains("dff") || kind.contains("latch") || kind.contains("DFF");
                    return NetDriver::Logic { is_register, line };
                }
                Source::Bit(Bit::Net(bit)) => {
                    let at = self.wires.partition_point(|wire| wire.first <= bit) - 1;
                    match (self.wires[at].name.strip_prefix('\\'), self.drivers[bit].first()) {
                        (Some(name), _) => return NetDriver::Net(name.to_owned()),
                        (None, Some(&next)) => next,
                        (None, None) => break,
                    }
                }
            };
        }
        NetDriver::Logic { is_register: false, line: None }
    }
}

/// Whether a port of a cell of Yosys is an output.
fn is_output(kind: &str, port: &str) -> bool {
    match port {
        "Y" | "Q" | "RD_DATA" => true,
        "X" | "CO" => matches!(kind, "$alu" | "$fa" | "$lcu"),
        "DATA" => kind.starts_with("$memrd"),
        _ => false,
    }
}

/// The words of a line. A range is a word.
struct Words<'t>(&'t str);

impl<'t> Words<'t> {
    fn next(&mut self) -> Option<&'t str> {
        let (word, rest) = self.0.split_once(' ').unwrap_or((self.0, ""));
        self.0 = rest;
        (!word.is_empty()).then_some(word)
    }

    fn at(&self, word: &str) -> bool {
        self.0.split(' ').next() == Some(word)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bits_with_two_drivers_are_found() {
        let rtlil = "autoidx 1\nattribute \\src \"source.v:1.1-1.2\"\n\
                     module \\m\n  wire input 1 \\a\n  wire width 4 output 2 \
                     \\y\n  wire $n\n  wire \\i\n  wire \\x\n  attribute \\src \"source.v:3.1-3.4\"\n  \
                     cell $and $c\n    \
                     connect \\A \\a\n    connect \\B \\x\n    connect \\Y $n\n  end\n  connect \\y [2] $n\n  \
                     connect { \\y [3:2] \\y [0] } 3'0x1\n  connect \\y [1] \\x\n  connect \\i $n\n  \
                     connect \\i \\a\n  \
                     connect \\x \\a\n  connect \\a \\i\nend\n";
        let of = |net: &str, bit, drivers| DrivenTwice { module: "m".to_owned(), net: net.to_owned(), bit, drivers };
        let logic = NetDriver::Logic { is_register: false, line: Some(3) };
        let expected = [
            of("a", None, [NetDriver::Input, NetDriver::Net("i".to_owned())]),
            of("y", Some(2), [logic.clone(), NetDriver::Constant('x')]),
            of("i", None, [logic, NetDriver::Net("a".to_owned())]),
        ];
        assert_eq!(driven_twice(rtlil, &["m".to_owned()]), expected);
        // A module with a name of Yosys follows.
        let derived = format!("{rtlil}module $paramod\\d\n  wire output 1 \\y\n  connect \\y \\a\nend\n");
        assert_eq!(driven_twice(&derived, &["m".to_owned()]), expected);
        // What no output depends on does not count, such as the variable of two loops.
        let unread = rtlil.replace("  connect \\a \\i\n", "");
        assert_eq!(driven_twice(&unread, &["m".to_owned()]), expected[1..2]);
    }
}
