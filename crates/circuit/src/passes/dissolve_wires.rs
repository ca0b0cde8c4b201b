//! Replaces wires by their drivers.

use std::collections::BTreeMap;

use crate::{Cell, NetId, Netlist, NetlistError, Node, RegisterNode};

/// Connects the receivers of wires to their drivers; names and start values of wires move to the driving cells.
pub fn dissolve_wires(netlist: &mut Netlist) -> Result<(), NetlistError> {
    check_drivers(netlist)?;
    let wires: Vec<_> = netlist.ids().filter(|&id| matches!(netlist.node(id), Node::Wire { .. })).collect();
    let drivers: BTreeMap<_, _> =
        wires.iter().map(|&wire| Ok((wire, driver(netlist, wire)?))).collect::<Result<_, NetlistError>>()?;
    for &wire in &wires {
        let driver = drivers[&wire];
        for (listener, pin) in netlist.fanout(wire) {
            if !drivers.contains_key(&listener) {
                netlist.drive(listener, pin, driver);
            }
        }
        inherit(netlist, wire, driver);
    }
    wires.into_iter().for_each(|wire| netlist.remove(wire));
    Ok(())
}

pub fn check_drivers(netlist: &Netlist) -> Result<(), NetlistError> {
    for id in netlist.ids() {
        let wanted = match netlist.node(id) {
            Node::Input(_) | Node::Constant(_) => 0,
            Node::Output(_) | Node::Wire { .. } => 1,
            Node::Register(register) => register.pins(),
            Node::Cell(cell) => {
                1 + (1..cell.function.inputs()).rfind(|&input| cell.function.depends_on(input)).unwrap_or(0)
            }
        };
        if netlist.pins(id).len() < wanted {
            return Err(NetlistError::Undriven(netlist.net_name(id)));
        }
    }
    Ok(())
}

fn driver(netlist: &Netlist, wire: NetId) -> Result<NetId, NetlistError> {
    let mut id = wire;
    for _ in 0..netlist.graph().node_count() {
        id = netlist.pins(id)[0];
        if !matches!(netlist.node(id), Node::Wire { .. }) {
            return Ok(id);
        }
    }
    Err(NetlistError::WireLoop(netlist.net_name(wire)))
}

fn inherit(netlist: &mut Netlist, wire: NetId, driver: NetId) {
    let Node::Wire { name, start, span } = netlist.node(wire).clone() else {
        return;
    };
    let (Node::Cell(Cell { name: own, start: own_start, span: own_span, .. })
    | Node::Register(RegisterNode { name: own, start: own_start, span: own_span, .. })) = netlist.node_mut(driver)
    else {
        return;
    };
    if !name.is_empty() {
        own.get_or_insert(name);
    }
    *own_start = own_start.or(start);
    *own_span = own_span.or(span);
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::example::latch;
    use nbc_base::model::Function;

    #[test]
    fn a_latch_loses_its_wires_and_keeps_its_names_and_start_values() {
        let mut netlist = latch();
        dissolve_wires(&mut netlist).unwrap();
        let named: Vec<_> = netlist.cells().filter_map(|(_, cell)| Some((cell.name.clone()?, cell.start))).collect();
        assert_eq!(named, [("q".to_owned(), Some(false)), ("nq".to_owned(), Some(true))]);
        assert!(netlist.ids().all(|id| !matches!(netlist.node(id), Node::Wire { .. })));
    }

    #[test]
    fn undriven_wires_are_errors() {
        let mut netlist = Netlist::new("open");
        let wire = netlist.add_wire("w", None, None);
        netlist.add_output("q", wire);
        assert_eq!(dissolve_wires(&mut netlist), Err(NetlistError::Undriven("w".to_owned())));
    }

    #[test]
    fn wires_that_drive_each_other_are_errors() {
        let mut netlist = Netlist::new("idle");
        let one = netlist.add_wire("one", None, None);
        let two = netlist.add_wire("two", None, None);
        netlist.drive(one, 0, two);
        netlist.drive(two, 0, one);
        let listener = netlist.add_wire("listener", None, None);
        netlist.drive(listener, 0, one);
        assert!(matches!(dissolve_wires(&mut netlist), Err(NetlistError::WireLoop(_))));
    }

    #[test]
    fn chains_of_wires_end_at_a_cell() {
        let mut netlist = Netlist::new("chain");
        let a = netlist.add_input("a");
        let first = netlist.add_wire("first", None, None);
        let second = netlist.add_wire("second", None, None);
        netlist.drive(first, 0, second);
        netlist.drive(second, 0, a);
        let gate = netlist.add_gate(Function::NOT, &[first]);
        netlist.add_output("q", gate);
        dissolve_wires(&mut netlist).unwrap();
        assert_eq!(netlist.pins(gate), [a]);
    }
}
