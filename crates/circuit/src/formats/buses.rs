//! Buses: the bits `x[0]`, `x[1]`, … of a file that has single bits only.

use std::collections::{BTreeMap, BTreeSet};

use crate::NetId;
use crate::formats::Design;

#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Bus {
    /// Without the number of a bit.
    pub name: String,
    /// The places of its bits in the list, the rightmost bit first.
    pub bits: Vec<usize>,
}

/// Bits are one bus if their numbers have no gap, from any number on. The rightmost bit is the lowest, or the highest
/// of an `ascending` bus. Every other name is a bus of one bit.
pub fn buses(names: &[String], ascending: &BTreeSet<String>) -> Vec<Bus> {
    let mut numbered: BTreeMap<&str, BTreeMap<i64, usize>> = BTreeMap::new();
    let mut apart: BTreeSet<&str> = BTreeSet::new();
    for (place, name) in names.iter().enumerate() {
        let Some((base, bit)) = bit_number(name) else { continue };
        if numbered.entry(base).or_default().insert(bit, place).is_some() {
            apart.insert(base);
        }
    }
    let whole = |base: &str| {
        let bits = &numbered[base];
        let (first, last) = (bits.keys().next()?, bits.keys().last()?);
        let is_whole = last.abs_diff(*first) + 1 == bits.len() as u64;
        let is_bus = is_whole && (bits.len() > 1 || *first == 0) && !apart.contains(base);
        let places = || bits.values().copied();
        is_bus.then(|| if ascending.contains(base) { places().rev().collect() } else { places().collect::<Vec<_>>() })
    };
    let mut done = BTreeSet::new();
    let mut all = Vec::new();
    for (place, name) in names.iter().enumerate() {
        let bus = bit_number(name).and_then(|(base, _)| Some((base, whole(base)?)));
        match bus {
            Some((base, _)) if !done.insert(base) => {}
            Some((base, bits)) => all.push(Bus { name: base.to_owned(), bits }),
            None => all.push(Bus { name: name.clone(), bits: vec![place] }),
        }
    }
    all
}

/// The ports whose bits are not numbered from 0 at the right, as the language numbers them.
pub fn renumbered(design: &Design) -> Vec<String> {
    let names = |ids: &[NetId]| design.netlist.net_names(ids);
    let ports = [names(design.ports()), names(design.netlist.outputs())];
    let of_ports = |names: &Vec<String>| {
        let is_other = |bus: &Bus| bit_number(&names[bus.bits[0]]).is_some_and(|(_, number)| number != 0);
        let found = buses(names, &design.ascending).into_iter().filter(|bus| bus.bits.len() > 1 && is_other(bus));
        found.map(|bus| bus.name).collect::<Vec<_>>()
    };
    ports.iter().flat_map(of_ports).collect()
}

/// `a` and -1 for `a[-1]`; `None` for other names.
pub(super) fn bit_number(bit: &str) -> Option<(&str, i64)> {
    let (name, number) = bit.strip_suffix(']')?.rsplit_once('[')?;
    let digits = number.strip_prefix('-').unwrap_or(number);
    let is_plain = !digits.is_empty() && digits.bytes().all(|digit| digit.is_ascii_digit());
    Some((name, number.parse().ok().filter(|_| is_plain)?))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn check(names: &[&str], expected: &[(&str, &[usize])]) {
        let names: Vec<String> = names.iter().map(|&name| name.to_owned()).collect();
        let found = buses(&names, &BTreeSet::from(["up".to_owned()]));
        let found: Vec<_> = found.iter().map(|bus| (bus.name.as_str(), &bus.bits[..])).collect();
        assert_eq!(found, expected, "{names:?}");
    }

    #[test]
    fn bits_with_all_their_numbers_are_a_bus() {
        check(&["a[0]", "a[1]", "b"], &[("a", &[0, 1]), ("b", &[2])]);
        check(&["a[1]", "b[0]", "a[0]"], &[("a", &[2, 0]), ("b", &[1])]);
        check(&["a[5]", "a[4]"], &[("a", &[1, 0])]);
        check(&["a[-1]", "a[0]", "a[1]"], &[("a", &[0, 1, 2])]);
    }

    #[test]
    fn the_rightmost_bit_is_first() {
        check(&["up[-1]", "up[0]", "down[0]", "down[1]"], &[("up", &[1, 0]), ("down", &[2, 3])]);
    }

    #[test]
    fn bits_with_gaps_or_twice_are_apart() {
        check(&["a[0]", "a[2]"], &[("a[0]", &[0]), ("a[2]", &[1])]);
        check(&["a[0]", "a[1]", "a[0]"], &[("a[0]", &[0]), ("a[1]", &[1]), ("a[0]", &[2])]);
        check(&["a[3]", "a[x]", "a[]", "[-1]"], &[("a[3]", &[0]), ("a[x]", &[1]), ("a[]", &[2]), ("[-1]", &[3])]);
    }
}
