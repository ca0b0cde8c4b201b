//! Buses: the bits `x[0]`, `x[1]`, … of a file that has single bits only.

use std::collections::{BTreeMap, BTreeSet};

use nbc_base::model::bit_parts;

/// A port or a net of one bit or several, made of the bits of a list.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Bus {
    /// The name, without the number of a bit.
    pub name: String,
    /// The places of its bits in the list, the lowest bit first.
    pub bits: Vec<usize>,
}

/// The buses of bits with these names, in the order of their first bits. Bits are one bus if their numbers have no gap;
/// the lowest need not be 0. Every other name is a bus of one bit.
pub fn buses(names: &[String]) -> Vec<Bus> {
    let mut numbered: BTreeMap<&str, BTreeMap<usize, usize>> = BTreeMap::new();
    let mut apart: BTreeSet<&str> = BTreeSet::new();
    for (place, name) in names.iter().enumerate() {
        let Some((base, bit)) = bit_parts(name) else { continue };
        if numbered.entry(base).or_default().insert(bit, place).is_some() {
            apart.insert(base);
        }
    }
    let whole = |base: &str| {
        let bits = &numbered[base];
        let (first, last) = (bits.keys().next()?, bits.keys().last()?);
        let is_bus = last - first + 1 == bits.len() && (bits.len() > 1 || *first == 0) && !apart.contains(base);
        is_bus.then(|| bits.values().copied().collect::<Vec<_>>())
    };
    let mut done = BTreeSet::new();
    let mut all = Vec::new();
    for (place, name) in names.iter().enumerate() {
        let bus = bit_parts(name).and_then(|(base, _)| Some((base, whole(base)?)));
        match bus {
            Some((base, _)) if !done.insert(base) => {}
            Some((base, bits)) => all.push(Bus { name: base.to_owned(), bits }),
            None => all.push(Bus { name: name.clone(), bits: vec![place] }),
        }
    }
    all
}

#[cfg(test)]
mod tests {
    use super::*;

    fn check(names: &[&str], expected: &[(&str, &[usize])]) {
        let names: Vec<String> = names.iter().map(|&name| name.to_owned()).collect();
        let found = buses(&names);
        let found: Vec<_> = found.iter().map(|bus| (bus.name.as_str(), &bus.bits[..])).collect();
        assert_eq!(found, expected, "{names:?}");
    }

    #[test]
    fn bits_with_all_their_numbers_are_a_bus() {
        check(&["a[0]", "a[1]", "b"], &[("a", &[0, 1]), ("b", &[2])]);
        check(&["a[1]", "b[0]", "a[0]"], &[("a", &[2, 0]), ("b", &[1])]);
        check(&["a[5]", "a[4]"], &[("a", &[1, 0])]);
    }

    #[test]
    fn bits_with_gaps_or_twice_are_apart() {
        check(&["a[0]", "a[2]"], &[("a[0]", &[0]), ("a[2]", &[1])]);
        check(&["a[0]", "a[1]", "a[0]"], &[("a[0]", &[0]), ("a[1]", &[1]), ("a[0]", &[2])]);
        check(&["a[3]", "a[x]", "a[]", "[-1]"], &[("a[3]", &[0]), ("a[x]", &[1]), ("a[]", &[2]), ("[-1]", &[3])]);
    }
}
