//! What a circuit keeps: its registers, and the table that says what it does with them.

use std::collections::BTreeMap;

use crate::message::{ListingRow, ShownListing, ShownRegister};
use nbc_base::model::{Circuit, Column, ExpressionKind, TablePattern};
use nbc_circuit::{BlockId, NetId, Netlist};
use nbc_session::Checked;

/// The registers of a swarm's netlist, whose cells are its robots in order, with the names of their nets in the source.
/// Those whose bits were merged or left out are not among them.
pub(super) fn registers(netlist: &Netlist) -> Vec<ShownRegister> {
    let blocks = netlist.blocks();
    let mut found: BTreeMap<(BlockId, &str), BTreeMap<usize, usize>> = BTreeMap::new();
    for (robot, (id, _)) in netlist.cells().enumerate() {
        let around = blocks.around(netlist.block(id));
        let Some(at) = around.iter().position(|&block| nbc_circuit::keeps_state(blocks.circuit(block))) else {
            continue;
        };
        // A register that is the output of a circuit has the name of its call.
        let calls = around[..=at].iter().map(|&block| blocks.name(block));
        if let Some((bus, place)) = bit(netlist, id).filter(|(bus, _)| calls.into_iter().any(|call| call == *bus)) {
            found.entry((around[at], bus)).or_default().insert(place, robot);
        }
    }
    found.retain(|_, bits| bits.keys().copied().eq(0..bits.len()));
    let named = |bus: &str| found.keys().filter(|(_, other)| *other == bus).count();
    let path = |block| blocks.around(block).into_iter().map(|block| blocks.name(block)).collect::<Vec<_>>().join("/");
    let shown = |(&(block, bus), bits): (&(BlockId, &str), &BTreeMap<usize, usize>)| ShownRegister {
        name: if named(bus) == 1 { bus.to_owned() } else { path(block) },
        robots: bits.values().rev().copied().collect(),
    };
    found.iter().map(shown).collect()
}

/// The bus of a cell's net, which may be inside calls, and its place in it.
fn bit(netlist: &Netlist, id: NetId) -> Option<(&str, usize)> {
    let name = netlist.cell(id)?.name.as_deref()?;
    let own = name.rsplit('/').next().unwrap_or(name);
    match own.strip_suffix(']').and_then(|bit| bit.split_once('[')) {
        Some((bus, place)) => Some((bus, place.parse().ok()?)),
        None => Some((own, 0)),
    }
}

/// The first table of a circuit over one of its outputs: the program of a machine, or the transitions of one.
pub(super) fn listing(checked: &Checked, circuit: &Circuit, outputs: &[Column]) -> Option<ShownListing> {
    let over = |kind: &ExpressionKind| {
        let ExpressionKind::Table { inputs, table, .. } = kind else { return None };
        let [input] = inputs[..] else { return None };
        let ExpressionKind::Net(net) = circuit.expressions[input.0 as usize].kind else { return None };
        let name = &circuit.nets[net.0 as usize].name;
        Some((outputs.iter().find(|port| port.name == *name)?, &circuit.tables[*table]))
    };
    let (port, table) = circuit.expressions.iter().find_map(|expression| over(&expression.kind))?;
    let text = |span| checked.sources.text(span).split_whitespace().collect::<Vec<_>>().join(" ");
    let line = |span: nbc_base::source::Span| checked.sources.file(span.file).lines().line(span.start as usize) + 1;
    let mut rows: Vec<ListingRow> = Vec::new();
    for row in &table.rows {
        let bits = match &row.pattern {
            TablePattern::Bits(bits) => {
                bits.iter().map(|bit| bit.map_or('-', |bit| if bit { '1' } else { '0' })).collect()
            }
            TablePattern::Number(number) => format!("{number:0width$b}", width = port.width),
        };
        rows.push(ListingRow { bits, at: text(row.span), text: text(row.output.span), line: line(row.span) });
    }
    if let Some(other) = &table.otherwise {
        let bits = "-".repeat(port.width);
        rows.push(ListingRow { bits, at: "else".to_owned(), text: text(other.span), line: line(other.span) });
    }
    Some(ShownListing { port: port.name.clone(), rows })
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use super::*;
    use nbc_base::source::MemoryWorld;
    use nbc_session::{Choice, CompileOptions, Compiled, Session};

    const COMPUTER: &str = include_str!("../circuits/computer.nb");

    /// The checked program, and its circuit of that name as a swarm.
    fn compiled(text: &str, circuit: &str) -> (Arc<Checked>, Compiled) {
        let mut session = Session::new(MemoryWorld::default());
        session.update("a.nb", 1, text);
        let checked = session.open("a.nb").unwrap();
        let choice = Choice { circuit: Some(circuit.to_owned()), ..Choice::default() };
        let circuit = checked.circuit(&choice).unwrap();
        let compiled = session.compile(&checked, &circuit, &CompileOptions::default()).unwrap();
        (checked, compiled)
    }

    fn widths(registers: &[ShownRegister]) -> Vec<(&str, usize)> {
        registers.iter().map(|register| (register.name.as_str(), register.robots.len())).collect()
    }

    #[test]
    fn a_machine_has_its_registers_by_name_and_its_program() {
        let (checked, compiled) = compiled(COMPUTER, "product");
        let netlist = &compiled.mapping.netlist;
        let registers = registers(netlist);
        assert_eq!(widths(&registers), [("a", 4), ("b", 4), ("pc", 3)]);
        let nets: Vec<String> = netlist.cells().map(|(cell, _)| netlist.net_name(cell)).collect();
        let bits: Vec<&str> = registers[2].robots.iter().map(|&robot| nets[robot].as_str()).collect();
        assert_eq!(bits, ["pc[2]", "pc[1]", "pc[0]"]);
        let source = checked.program.circuit("product").unwrap();
        let listing = listing(&checked, source, &compiled.assembly.outputs).unwrap();
        assert_eq!((listing.port.as_str(), listing.rows.len()), ("pc", 8));
        let ListingRow { bits, at, text, line } = &listing.rows[3];
        assert_eq!((bits.as_str(), at.as_str(), text.as_str()), ("011", "011", "add(3'd5)"));
        assert_eq!(COMPUTER.lines().nth(line - 1).unwrap().trim(), "011: add(3'd5)");
    }

    #[test]
    fn registers_inside_calls_have_the_names_of_the_calls_that_they_are_the_outputs_of() {
        let text = "circuit part[n](d, clk) -> (q[n]) { q = register({d, q[n - 1..1]}, clk) }
            circuit two(d, clk) -> (a[2], b[3]) {
                a = part[2](d, clk)
                b = part[3](a[0], clk)
            }";
        assert_eq!(widths(&registers(&compiled(text, "two").1.mapping.netlist)), [("a", 2), ("b", 3)]);
    }
}
