//! Works out what constants, repeated pins and double inversion make of a cell.

use crate::circuit::loops::Loops;
use crate::circuit::passes::Pass;
use crate::circuit::{Cell, NetId, Netlist, NetlistError, Node};
use crate::model::Function;

/// Cells outside memory that constants or repeated pins decide become constants, inverters or nothing.
#[derive(Clone, Copy, Debug)]
pub struct FoldConstants;

/// What a cell comes to.
enum Folded {
    Constant(bool),
    Net(NetId),
    Cell(Function, Vec<NetId>),
}

impl Pass for FoldConstants {
    fn name(&self) -> &'static str {
        "fold-constants"
    }

    fn description(&self) -> &'static str {
        "simplify cells whose pins are constant, equal or ignored, and double inversion, outside memory"
    }

    fn run(&self, netlist: &mut Netlist) -> Result<(), NetlistError> {
        let loops = Loops::memory(netlist);
        for &id in loops.order() {
            let Some(cell) = netlist.cell(id).filter(|_| !loops.contains(id)) else {
                continue;
            };
            match fold(netlist, cell.function, &netlist.pins(id)) {
                Folded::Cell(function, pins) => rewrite(netlist, id, function, &pins),
                Folded::Net(net) => replace(netlist, id, net),
                Folded::Constant(value) => {
                    let net = netlist.add_constant(value);
                    replace(netlist, id, net);
                }
            }
        }
        Ok(())
    }
}

fn fold(netlist: &Netlist, function: Function, pins: &[NetId]) -> Folded {
    let a = pins[0];
    let b = pins.get(1).copied().unwrap_or(a);
    let outputs = [(false, false), (false, true), (true, false), (true, true)]
        .map(|(x, y)| possible(netlist, a, b, x, y).then(|| function.output(x, y)));
    let reachable = |value| outputs.contains(&Some(value));
    if !reachable(true) || !reachable(false) {
        return Folded::Constant(reachable(true));
    }
    for (pin, net) in [(0, a), (1, b)] {
        let follows = |invert| {
            outputs.iter().enumerate().all(|(i, &output)| {
                let input = if pin == 0 { i >> 1 == 1 } else { i & 1 == 1 };
                output.is_none_or(|output| output == (input != invert))
            })
        };
        if follows(false) {
            return Folded::Net(net);
        }
        if follows(true) {
            return inverted(netlist, net);
        }
    }
    Folded::Cell(function, vec![a, b])
}

/// Whether nets `a` and `b` can have the values `x` and `y`, as far as constants and equality tell.
fn possible(netlist: &Netlist, a: NetId, b: NetId, x: bool, y: bool) -> bool {
    let allowed = |id, value| !matches!(netlist.node(id), Node::Constant(constant) if *constant != value);
    allowed(a, x) && allowed(b, y) && (a != b || x == y)
}

/// The opposite of a net: of an inverter, what it inverts.
fn inverted(netlist: &Netlist, net: NetId) -> Folded {
    match netlist.cell(net) {
        Some(Cell { function: Function::NOT, .. }) => Folded::Net(netlist.pins(net)[0]),
        _ => Folded::Cell(Function::NOT, vec![net]),
    }
}

fn rewrite(netlist: &mut Netlist, id: NetId, function: Function, pins: &[NetId]) {
    let same = netlist.cell(id).is_some_and(|cell| cell.function == function);
    if same && netlist.pins(id) == pins {
        return;
    }
    let Some(cell) = netlist.cell(id).cloned() else {
        return;
    };
    let new = netlist.add_cell(Cell { function, ..cell }, pins);
    replace(netlist, id, new);
}

fn replace(netlist: &mut Netlist, id: NetId, net: NetId) {
    for (listener, pin) in netlist.fanout(id) {
        netlist.drive(listener, pin, net);
    }
    netlist.remove(id);
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::circuit::passes::Sweep;

    /// Folds `function(a, b)` where each pin is `a`, `b`, `0`, `1` or `!` (not a), and prints the result.
    fn check(function: &str, pins: &str, expected: &str) {
        let mut netlist = Netlist::new("f");
        let a = netlist.add_input("a");
        let b = netlist.add_input("b");
        let pins: Vec<_> = pins
            .chars()
            .map(|pin| match pin {
                'a' => a,
                'b' => b,
                '!' => netlist.add_gate(Function::NOT, &[a]),
                _ => netlist.add_constant(pin == '1'),
            })
            .collect();
        let gate = netlist.add_gate(Function::parse(function).unwrap(), &pins);
        let output = netlist.add_output("q", gate);
        FoldConstants.run(&mut netlist).unwrap();
        Sweep.run(&mut netlist).unwrap();
        let driver = netlist.pins(output)[0];
        let found = match netlist.cell(driver) {
            Some(cell) => {
                let pins: Vec<_> = netlist.pins(driver).into_iter().map(|pin| netlist.net_name(pin)).collect();
                format!("{}({})", cell.function, pins.join(", "))
            }
            None => netlist.net_name(driver),
        };
        assert_eq!(found, expected);
    }

    #[test]
    fn constants_and_repeated_pins_fold() {
        check("nand", "ab", "nand(a, b)");
        check("nand", "a1", "not(a)");
        check("nand", "0b", "1");
        check("nand", "aa", "not(a)");
        check("and", "aa", "a");
        check("xor", "aa", "0");
        check("xor", "1b", "not(b)");
        check("xnor", "1b", "b");
        check("b", "ab", "b");
        check("notb", "ab", "not(b)");
        check("zero", "ab", "0");
        check("not", "!", "a");
        check("nor", "!0", "a");
    }
}
