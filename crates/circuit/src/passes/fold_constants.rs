//! Simplifies cells with constant pins, repeated pins or double inversion.

use crate::guarded::{Guarded, Role};
use crate::{Cell, NetId, Netlist, Node};
use nbc_base::model::Function;

enum Folded {
    Constant(bool),
    Net(NetId),
    Cell(Function, Vec<NetId>),
}

/// Memory and its guards stay as written even with constant pins; from the cells of an enable, only constants go.
pub fn fold_constants(netlist: &mut Netlist) {
    let mut guarded = Guarded::of(netlist);
    for id in guarded.memory().order().to_vec() {
        let role = guarded.role(id);
        let Some(cell) = netlist.cell(id).filter(|_| matches!(role, None | Some(Role::Control))) else {
            continue;
        };
        // The inverter of a control net is later than the net, and its receivers may rely on this.
        let free = |net: NetId| role.is_none() && guarded.role(net).is_none();
        match fold(netlist, cell.function, &netlist.pins(id), free) {
            Folded::Cell(function, pins) => {
                let new = rewrite(netlist, id, function, &pins);
                guarded.replace(id, new);
            }
            Folded::Net(net) => replace(netlist, id, net),
            Folded::Constant(value) => {
                let net = netlist.add_constant(value);
                replace(netlist, id, net);
            }
        }
    }
}

fn fold(netlist: &Netlist, function: Function, pins: &[NetId], free: impl Fn(NetId) -> bool) -> Folded {
    if function.inputs() > 2 {
        return Folded::Cell(function, pins.to_vec());
    }
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
            return inverted(netlist, net, free(net));
        }
    }
    Folded::Cell(function, vec![a, b])
}

fn possible(netlist: &Netlist, a: NetId, b: NetId, x: bool, y: bool) -> bool {
    let allowed = |id, value| !matches!(netlist.node(id), Node::Constant(constant) if *constant != value);
    allowed(a, x) && allowed(b, y) && (a != b || x == y)
}

fn inverted(netlist: &Netlist, net: NetId, free: bool) -> Folded {
    match netlist.cell(net) {
        Some(Cell { function: Function::NOT, .. }) if free => Folded::Net(netlist.pins(net)[0]),
        _ => Folded::Cell(Function::NOT, vec![net]),
    }
}

fn rewrite(netlist: &mut Netlist, id: NetId, function: Function, pins: &[NetId]) -> NetId {
    let cell = netlist.cell(id).cloned().expect("only cells are folded");
    if cell.function == function && netlist.pins(id) == pins {
        return id;
    }
    let new = netlist.add_cell(Cell { function, ..cell }, pins);
    replace(netlist, id, new);
    new
}

fn replace(netlist: &mut Netlist, id: NetId, net: NetId) {
    netlist.move_listeners(id, net);
    netlist.remove(id);
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::passes::sweep;

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
        fold_constants(&mut netlist);
        sweep(&mut netlist);
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
