//! A swarm's run as a table for spreadsheets and programs (CSV, RFC 4180): a row for each cycle.

use std::collections::BTreeSet;

use crate::csv::{cell, line};
use nbc_base::model::{Column, Value};
use nbc_swarm::SwarmTrace;

/// A row has the cycle from 1, the input ports during it, the output ports and every other net at its end, and the
/// distance each robot walked in it, in voxels. A port of one bit is `0` or `1`. A wider one is a number, or quoted
/// digits if it has more than 64 bits.
pub fn cycle_table(trace: &SwarmTrace) -> String {
    let ports: BTreeSet<String> = trace.inputs.iter().chain(&trace.outputs).flat_map(Column::bits).collect();
    let nets: Vec<usize> = (0..trace.robots.len()).filter(|&k| !ports.contains(&trace.robots[k].net)).collect();
    let names = trace.inputs.iter().chain(&trace.outputs).map(|port| port.name.clone());
    let inner = nets.iter().map(|&k| trace.robots[k].net.clone());
    let walks = trace.robots.iter().map(|robot| format!("{}.displacement", robot.net));
    let head = std::iter::once("cycle".to_owned()).chain(names).chain(inner).chain(walks).map(|name| cell(&name));
    let mut text = line(head);
    for (c, cycle) in trace.cycles.iter().enumerate() {
        let (inputs, outputs) = (trace.input_values(c), trace.output_values(c));
        let ports = inputs.iter().chain(&outputs).map(number);
        let inner = nets.iter().map(|&k| u8::from(cycle.bits[k]).to_string());
        let walks = (0..trace.robots.len()).map(|k| trace.displacement(k, c).to_string());
        text += &line(std::iter::once((c + 1).to_string()).chain(ports).chain(inner).chain(walks));
    }
    text
}

fn number(value: &Value) -> String {
    let digits = value.digits();
    u64::from_str_radix(&digits, 2).map_or_else(|_| cell(&value.to_string()), |number| number.to_string())
}
