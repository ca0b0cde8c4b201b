//! Names of the divisions of a circuit, from the nets and calls of its source.

use std::cmp::Reverse;
use std::collections::btree_map::Entry;
use std::collections::{BTreeMap, VecDeque};

use nbc_circuit::{NetId, Netlist};

const LETTERS: usize = 16;

/// The name of a circuit in the source. A shipped circuit is renamed if the source declares one of that name.
pub fn written(circuit: &str) -> &str {
    circuit.strip_prefix("prelude.").unwrap_or(circuit)
}

/// The name of a call. An unnamed call gets the name of its circuit.
pub fn call_name<'a>(name: &'a str, circuit: &'a str) -> &'a str {
    let number = name.strip_prefix(circuit).and_then(|rest| rest.strip_prefix('_'));
    let is_numbered = number.is_some_and(|number| !number.is_empty() && number.bytes().all(|c| c.is_ascii_digit()));
    if is_numbered { written(circuit) } else { name }
}

pub struct NetNames<'a> {
    netlist: &'a Netlist,
    named: BTreeMap<NetId, String>,
    reached: BTreeMap<NetId, String>,
}

impl<'a> NetNames<'a> {
    pub fn of(netlist: &'a Netlist) -> Self {
        let shown = netlist.outputs().iter().flat_map(|&output| {
            let name = netlist.net_name(output);
            netlist.pins(output).into_iter().map(move |driver| (driver, name.clone()))
        });
        let named = netlist.cells().filter_map(|(id, cell)| Some((id, cell.name.clone()?)));
        let named: BTreeMap<NetId, String> = shown.chain(named).collect();
        let mut reached: BTreeMap<NetId, String> = BTreeMap::new();
        let mut open: VecDeque<(NetId, String)> = named.iter().map(|(&id, name)| (id, name.clone())).collect();
        while let Some((id, name)) = open.pop_front() {
            for pin in netlist.pins(id).into_iter().filter(|pin| netlist.cell(*pin).is_some()) {
                if let (false, Entry::Vacant(place)) = (named.contains_key(&pin), reached.entry(pin)) {
                    place.insert(name.clone());
                    open.push_back((pin, name.clone()));
                }
            }
        }
        Self { netlist, named, reached }
    }

    /// By the cell's bus, or else the call around it, the bus to which it leads, or its function.
    pub fn within(&self, cell: NetId, calls: &[&str]) -> (String, Option<usize>) {
        let bus = |name: &str| name.split(['[', '/', '.']).next().unwrap_or(name).to_owned();
        if let Some(name) = self.named.get(&cell) {
            let own = name.strip_prefix(&(calls.join("/") + "/")).unwrap_or(name);
            let place = own.trim_end_matches(']').rsplit(['[', '.']).next().and_then(|place| place.parse().ok());
            return (bus(own), place);
        }
        let blocks = self.netlist.blocks();
        let around = blocks.around(self.netlist.block(cell));
        let inside = match calls.last() {
            Some(&last) => around.iter().rposition(|&block| blocks.name(block) == last).map_or(0, |at| at + 1),
            None => 0,
        };
        if let Some(&call) = around.get(inside) {
            return (call_name(blocks.name(call), blocks.circuit(call)).to_owned(), None);
        }
        let function = || self.netlist.cell(cell).map_or(String::new(), |cell| cell.function.to_string());
        (self.reached.get(&cell).map_or_else(function, |name| format!("to {}", bus(name))), None)
    }
}

#[derive(Clone, Debug)]
pub struct Word {
    name: String,
    robots: usize,
    places: Option<(usize, usize)>,
}

impl Word {
    pub fn new(name: String) -> Self {
        Self { name, robots: 0, places: None }
    }

    pub fn count(&mut self, robots: usize, place: Option<usize>) {
        self.robots += robots;
        let (least, greatest) = self.places.unwrap_or((usize::MAX, 0));
        self.places = place.map(|place| (least.min(place), greatest.max(place))).or(self.places);
    }

    pub fn order(&self) -> (bool, Reverse<usize>) {
        (self.name.starts_with("to "), Reverse(self.robots))
    }

    fn with_places(&self) -> String {
        match self.places {
            Some((least, greatest)) if least < greatest => format!("{}[{greatest}..{least}]", self.name),
            Some((place, _)) => format!("{}[{place}]", self.name),
            None => self.name.clone(),
        }
    }
}

/// Equal names get their places in the bus, then the second word, then a number.
pub fn distinct_names(divisions: &[Vec<Word>]) -> Vec<String> {
    let joined = |words: &[Word], first: String| {
        words.get(1).map_or(first.clone(), |second| format!("{first}, {}", second.with_places()))
    };
    let brief = |words: &Vec<Word>| {
        let first = words.first().map_or(String::new(), |word| word.name.clone());
        let both = words.get(1).map(|second| format!("{first}, {}", second.name));
        both.filter(|both| both.chars().count() <= LETTERS).unwrap_or(first)
    };
    let with_places = |words: &[Word]| words.first().map_or(String::new(), Word::with_places);
    let mut names: Vec<String> = divisions.iter().map(brief).collect();
    for longer in [&with_places, &|words: &[Word]| joined(words, with_places(words))] as [&dyn Fn(&[Word]) -> String; 2]
    {
        let before = names.clone();
        for (name, words) in names.iter_mut().zip(divisions) {
            if before.iter().filter(|other| *other == name).count() > 1 {
                *name = longer(words);
            }
        }
    }
    let before = names.clone();
    for (at, name) in names.iter_mut().enumerate() {
        if before.iter().filter(|other| *other == name).count() > 1 {
            let number = before[..=at].iter().filter(|other| *other == name).count();
            *name += &format!(" ({number})");
        }
    }
    names
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_say_as_much_as_tells_them_apart() {
        let word = |name: &str, places: &[usize]| {
            let mut word = Word::new(name.to_owned());
            places.iter().for_each(|&place| word.count(1, Some(place)));
            word
        };
        let divisions = [
            vec![word("sum", &[1, 0]), word("carry", &[0])],
            vec![word("next", &[0, 4])],
            vec![word("next", &[7, 5])],
            vec![word("to data", &[])],
            vec![word("to data", &[]), word("and", &[])],
            vec![word("to data", &[])],
        ];
        let expected = ["sum, carry", "next[4..0]", "next[7..5]", "to data (1)", "to data, and", "to data (2)"];
        assert_eq!(distinct_names(&divisions), expected);
    }

    #[test]
    fn a_call_without_a_name_is_called_as_its_circuit() {
        let names = [("equal_11", "equal"), ("part_a", "part"), ("prelude.add_2", "prelude.add")];
        assert_eq!(names.map(|(name, circuit)| call_name(name, circuit)), ["equal", "part_a", "add"]);
    }
}
