//! The width of a net and what it depends on.

use std::collections::{BTreeMap, BTreeSet};

use crate::figures::Subject;
use crate::files::Files;
use crate::hover::circuit::{instance, width};
use nbc_base::model::{Block, Circuit, ExpressionId, ExpressionKind, NetSlot, Statement};
use nbc_base::source::Span;

pub(super) fn text(files: &Files<'_>, declared: Span) -> (Option<String>, Option<Subject>) {
    let mut lines: Vec<String> = Vec::new();
    lines.extend(width(files, declared).map(|bits| format!("- width: {bits}")));
    let circuits = &files.checked.program.circuits;
    let found = circuits.iter().find_map(|circuit| {
        let slot = circuit.nets.iter().position(|net| net.span == declared)?;
        Some((circuit, NetSlot(slot as u32)))
    });
    let Some((circuit, slot)) = found else { return (some(lines), None) };
    if (slot.0 as usize) < circuit.inputs {
        lines.push(format!("- an input of `{}`", circuit.name));
        return (some(lines), None);
    }
    lines.extend(dependence(circuit, slot));
    (some(lines), instance(files, circuit).map(|instance| Subject::Net(instance, declared)))
}

fn some(lines: Vec<String>) -> Option<String> {
    (!lines.is_empty()).then(|| lines.join("\n"))
}

fn dependence(circuit: &Circuit, slot: NetSlot) -> Vec<String> {
    let direct = drivers(circuit);
    let mut all: BTreeSet<NetSlot> = BTreeSet::new();
    let mut open = vec![slot];
    while let Some(next) = open.pop() {
        open.extend(direct.get(&next).into_iter().flatten().filter(|driver| all.insert(**driver)));
    }
    let is_memory = all.remove(&slot);
    let names = |wanted: &dyn Fn(usize) -> bool| {
        let nets = all.iter().filter(|slot| wanted(slot.0 as usize));
        nets.map(|slot| format!("`{}`", circuit.nets[slot.0 as usize].name)).collect::<Vec<_>>().join(", ")
    };
    let (inputs, between) = (names(&|slot| slot < circuit.inputs), names(&|slot| slot >= circuit.inputs));
    let inputs = if inputs.is_empty() { "no input".to_owned() } else { inputs };
    let through = if between.is_empty() { String::new() } else { format!(", through {between}") };
    let memory = is_memory.then(|| "- part of a loop, which is memory".to_owned());
    [Some(format!("- depends on {inputs}{through}")), memory].into_iter().flatten().collect()
}

fn drivers(circuit: &Circuit) -> BTreeMap<NetSlot, BTreeSet<NetSlot>> {
    let mut direct = BTreeMap::new();
    let mut blocks: Vec<&Block> = vec![&circuit.body];
    while let Some(block) = blocks.pop() {
        for statement in &block.statements {
            match statement {
                Statement::For { body, .. } => blocks.push(body),
                Statement::If { then, otherwise, .. } => blocks.extend([then, otherwise]),
                Statement::Scope(block) => blocks.push(block),
                Statement::Let { .. } => {}
                Statement::Drive { targets, value, .. } => {
                    for net in targets.iter().filter_map(|target| target.net) {
                        direct.entry(net).or_insert_with(BTreeSet::new).extend(nets(circuit, *value));
                    }
                }
            }
        }
    }
    direct
}

fn nets(circuit: &Circuit, root: ExpressionId) -> impl Iterator<Item = NetSlot> + '_ {
    let parts = circuit.first_leaf(root).0 as usize..=root.0 as usize;
    circuit.expressions[parts].iter().filter_map(|part| match part.kind {
        ExpressionKind::Net(net) | ExpressionKind::Slice { net, .. } | ExpressionKind::Element { net, .. } => Some(net),
        _ => None,
    })
}
