//! What a circuit keeps: its registers, and the table that says what it does with them.

use std::collections::BTreeMap;

use crate::message::{ListingRow, ShownClock, ShownListing, ShownRegister, WaveBit, WaveRegister};
use nbc_base::model::{Circuit, Column, ExpressionKind, TablePattern};
use nbc_circuit::waves::WaveMachine;
use nbc_circuit::{BlockId, Cell, NetId, Netlist, Node, RegisterNode};
use nbc_session::report::SwarmTiming;
use nbc_session::{Checked, Mapping};
use nbc_swarm::StimulusSource;

/// A change has passed the slowest path before the clock has changed twice.
pub(super) fn clocks(timing: &SwarmTiming, inputs: &[Column]) -> Vec<ShownClock> {
    let bits: Vec<String> = inputs.iter().flat_map(Column::bits).collect();
    let clocks = timing.phases.clocks.iter().filter_map(|clock| {
        let slowest = clock.paths.iter().map(|path| path.cycles).max().unwrap_or(0);
        let half = clock.half.max(slowest.div_ceil(2)).min(timing.hold);
        Some(ShownClock { bit: bits.iter().position(|bit| *bit == clock.clock)?, half })
    });
    clocks.collect()
}

/// The registers of a swarm's netlist, whose cells are its robots in order, with the names of their nets in the source.
/// Registers whose bits were merged or left out are missing.
pub(super) fn registers(netlist: &Netlist) -> Vec<ShownRegister> {
    let bits = netlist.cells().enumerate().map(|(robot, (id, _))| (id, robot));
    named(netlist, bits).into_iter().map(|(name, robots)| ShownRegister { name, robots }).collect()
}

/// The registers of a wave machine with the names of their nets in the source. Its cells are the swarm's robots in
/// order. Registers with a bit on an input that no robot reads are missing.
pub(super) fn wave_registers(mapping: &Mapping, machine: &WaveMachine) -> Vec<WaveRegister> {
    let source = &mapping.source;
    let states = source.cells().map(|(id, _)| id).chain(source.registers().map(|(id, _)| id));
    let shows: BTreeMap<String, NetId> = states.map(|id| (source.net_name(id), id)).collect();
    let robots: BTreeMap<NetId, usize> = machine.netlist.cells().enumerate().map(|(at, (id, _))| (id, at)).collect();
    let bits = mapping.proof.cuts.iter().zip(&machine.state).filter_map(|(name, bit)| {
        let (source, phase) = match bit.net {
            Err(value) => (StimulusSource::Constant(value), 0),
            Ok(net) => match robots.get(&net) {
                Some(&robot) => (StimulusSource::Robot(robot), machine.phase[&net]),
                None => {
                    let port = machine.netlist.inputs().iter().position(|input| *input == net)?;
                    (StimulusSource::Input(port), machine.inputs[port]?)
                }
            },
        };
        let beats = phase + 1 - bit.later * i64::from(machine.period);
        let seen = WaveBit { source, after: beats * i64::from(machine.beat) - 1, starts: bit.starts.clone() };
        Some((*shows.get(name)?, seen))
    });
    named(source, bits).into_iter().map(|(name, bits)| WaveRegister { name, bits }).collect()
}

/// Bits by their cells as registers with names; the most significant bit comes first.
fn named<T>(netlist: &Netlist, bits: impl Iterator<Item = (NetId, T)>) -> Vec<(String, Vec<T>)> {
    let blocks = netlist.blocks();
    let mut found: BTreeMap<(BlockId, &str), BTreeMap<usize, T>> = BTreeMap::new();
    for (id, bit) in bits {
        let around = blocks.around(netlist.block(id));
        let Some(at) = around.iter().position(|&block| nbc_circuit::keeps_state(blocks.circuit(block))) else {
            continue;
        };
        // A register that is the output of a circuit has the name of its call.
        let calls = around[..=at].iter().map(|&block| blocks.name(block));
        if let Some((bus, place)) = place(netlist, id).filter(|(bus, _)| calls.into_iter().any(|call| call == *bus)) {
            found.entry((around[at], bus)).or_default().insert(place, bit);
        }
    }
    found.retain(|_, bits| bits.keys().copied().eq(0..bits.len()));
    let mut same: BTreeMap<&str, usize> = BTreeMap::new();
    found.keys().for_each(|(_, bus)| *same.entry(bus).or_default() += 1);
    let path = |block| blocks.around(block).into_iter().map(|block| blocks.name(block)).collect::<Vec<_>>().join("/");
    let register = |((block, bus), bits): ((BlockId, &str), BTreeMap<usize, T>)| {
        (if same[bus] == 1 { bus.to_owned() } else { path(block) }, bits.into_values().rev().collect())
    };
    found.into_iter().map(register).collect()
}

/// The bus of a cell's net, which may be inside calls, and its place in it.
fn place(netlist: &Netlist, id: NetId) -> Option<(&str, usize)> {
    let (Node::Cell(Cell { name, .. }) | Node::Register(RegisterNode { name, .. })) = netlist.node(id) else {
        return None;
    };
    let name = name.as_deref()?;
    let own = name.rsplit('/').next().unwrap_or(name);
    match own.strip_suffix(']').and_then(|bit| bit.split_once('[')) {
        Some((bus, place)) => Some((bus, place.parse().ok()?)),
        None => Some((own, 0)),
    }
}

/// The first table of a circuit over one of its outputs: the program of a machine, or its transitions.
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

    fn compiled(text: &str, circuit: &str) -> (Arc<Checked>, Compiled) {
        let mut session = Session::new(MemoryWorld::default());
        session.update("a.nb", 1, text);
        let checked = session.open("a.nb").unwrap();
        let choice = Choice { circuit: Some(circuit.to_owned()), ..Choice::default() };
        let circuit = checked.circuit(&choice).unwrap();
        let swarm = checked.program.swarms.last().map(|swarm| swarm.name.clone());
        let compiled = checked.compile(&circuit, &CompileOptions { swarm, ..CompileOptions::default() }).unwrap();
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
    fn the_clock_of_a_machine_may_change_before_all_has_settled() {
        let text = format!("{COMPUTER}\nswarm few {{ circuit: product, library: three, registers: mux }}");
        let compiled = compiled(&text, "product").1;
        let timing = compiled.swarm_timing();
        let clocks = clocks(&timing, &compiled.assembly.inputs);
        assert!(clocks.len() == 1 && clocks[0].bit == 0, "{clocks:?}");
        assert!(clocks[0].half < timing.hold && 2 * clocks[0].half >= timing.phases.clocks[0].period, "{clocks:?}");
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

    const WAVES: &str = "circuit count(clk) -> (n[3]) { n = register(n + 1, clk) }
        swarm wave { circuit: count, registers: waves }";

    #[test]
    fn the_registers_of_a_wave_machine_have_their_values_after_each_step_in_every_thread() {
        let compiled = compiled(WAVES, "count").1;
        let machine = compiled.mapping.waves.as_ref().unwrap();
        let registers = wave_registers(&compiled.mapping, machine);
        assert_eq!(registers.iter().map(|one| (one.name.as_str(), one.bits.len())).collect::<Vec<_>>(), [("n", 3)]);
        let (steps, beat, threads) = (12, i64::from(machine.beat), i64::from(machine.period));
        let mut swarm = Session::new(MemoryWorld::default()).swarm(&compiled);
        let cycles = machine.cycles(steps + 2);
        let seen: Vec<Vec<bool>> = (0..cycles).map(|_| swarm.step(&[false]).unwrap().bits.clone()).collect();
        let bit = |bit: &WaveBit, thread: i64, step: usize| {
            let begins = (machine.beginning() + step as i64 * threads + thread) * beat;
            bit.starts.get(step).copied().unwrap_or_else(|| match bit.source {
                StimulusSource::Robot(robot) => seen[(begins + bit.after) as usize][robot],
                StimulusSource::Constant(value) => value,
                StimulusSource::Input(_) => panic!("{bit:?}"),
            })
        };
        for thread in 0..threads {
            let value = |step| registers[0].bits.iter().fold(0, |n, one| n << 1 | u8::from(bit(one, thread, step)));
            let values: Vec<u8> = (0..steps).map(value).collect();
            assert_eq!(values, [0, 1, 2, 3, 4, 5, 6, 7, 0, 1, 2, 3], "thread {thread}");
        }
    }
}
