//! Where the values of a simulation are open: `x` or `z` in the dump that a simulator writes (VCD).

use std::collections::{BTreeMap, BTreeSet};

/// Where values are open.
#[derive(Debug)]
pub(super) struct OpenValues {
    /// The first step after which a register is open.
    pub(super) registers: Option<usize>,
    /// Whether a net is open, after each step.
    pub(super) nets: Vec<bool>,
}

impl OpenValues {
    /// What a dump says of `steps` steps that take `time` each, the start included. `registers` are bits of registers,
    /// such as `u.count[1]`.
    pub(super) fn of(dump: &str, registers: &BTreeSet<&str>, steps: usize, time: u64) -> Self {
        let registers: BTreeSet<&str> = registers.iter().map(|name| whole(name)).collect();
        let mut scopes: Vec<(&str, bool)> = Vec::new();
        // Whether each variable is a register; the others that count are nets.
        let mut known: BTreeMap<&str, bool> = BTreeMap::new();
        let mut open: BTreeSet<&str> = BTreeSet::new();
        let mut values = Self { registers: None, nets: Vec::new() };
        let mut settle = |open: &BTreeSet<&str>, known: &BTreeMap<&str, bool>, until: usize| {
            while values.nets.len() < until.min(steps) {
                let step = values.nets.len();
                values.nets.push(!open.is_empty());
                if values.registers.is_none() && open.iter().any(|name| known[name]) {
                    values.registers = Some(step);
                }
            }
        };
        for line in dump.lines() {
            let words: Vec<&str> = line.split_whitespace().collect();
            match words[..] {
                ["$scope", kind, name, ..] => scopes.push((name, matches!(kind, "module" | "begin"))),
                ["$upscope", ..] => _ = scopes.pop(),
                ["$var", kind, _, id, name, ..] => {
                    // Below the bench and the instance in it.
                    let path: Vec<&str> = scopes.iter().skip(2).map(|(name, _)| *name).chain([name]).collect();
                    let is_register = registers.contains(whole(&path.join(".")));
                    let counts = matches!(kind, "reg" | "wire" | "logic") && scopes.iter().all(|(_, counts)| *counts);
                    if counts {
                        *known.entry(id).or_default() |= is_register;
                    }
                }
                [now] if now.starts_with('#') => {
                    // Step 0 is seen when two steps are over, before anything changes then.
                    let now: u64 = now[1..].parse().unwrap_or(u64::MAX);
                    let until = (now / time).saturating_sub(1);
                    settle(&open, &known, usize::try_from(until).unwrap_or(usize::MAX));
                }
                [value] if value.starts_with(['0', '1', 'x', 'z']) => mark(&mut open, &known, &value[1..], &value[..1]),
                [value, id] if value.starts_with('b') => mark(&mut open, &known, id, &value[1..]),
                _ => {}
            }
        }
        settle(&open, &known, steps);
        values
    }
}

/// The net of a bit.
fn whole(bit: &str) -> &str {
    let mut name = bit;
    while let Some((net, _)) = name.strip_suffix(']').and_then(|name| name.rsplit_once('[')) {
        name = net;
    }
    name
}

/// Notes whether a variable is open.
fn mark<'d>(open: &mut BTreeSet<&'d str>, known: &BTreeMap<&'d str, bool>, id: &'d str, value: &str) {
    if known.contains_key(id) && value.contains(['x', 'z']) {
        open.insert(id);
    } else {
        open.remove(id);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn open_values_are_found_after_their_steps() {
        let dump = "$scope module nbc_bench $end\n$scope module dut $end\n$var reg 2 ! s [1:0] $end\n\
            $var wire 1 # w $end\n$scope module gen[0] $end\n$var reg 1 % q $end\n$upscope $end\n\
            $scope function f $end\n$var reg 1 & a $end\n$upscope $end\n$var integer 32 ' i $end\n\
            $enddefinitions $end\n#0\n$dumpvars\nbxx !\nx#\nx%\nx&\nbx '\n$end\n#1000000\nb00 !\n0%\n0#\n\
            #2000000\nx#\n#3000000\n1#\n#3000005\nx%\n#5000000\n1%\n";
        let registers = BTreeSet::from(["s[0]", "s[1]", "gen[0].q"]);
        let open = OpenValues::of(dump, &registers, 5, 1_000_000);
        // Step 1 begins at 2,000,000, when step 0 is seen.
        assert_eq!((open.nets, open.registers), (vec![false, true, true, true, false], Some(2)));
    }
}
