//! Numbers without a width: each takes the width that the expression around it has or needs.

use crate::elaborate::build::ModuleBuilder;
use crate::elaborate::instance;
use crate::elaborate::size;
use crate::elaborate::width::ExpressionWidths;
use crate::elaborate::wording;
use nbc_base::budget::Limit;
use nbc_base::model::{CircuitId, ExpressionId, ExpressionKind, FreeNumber, OutputValue, SizeId, SizeKind, Table};

pub(super) struct NeededWidths {
    first: u32,
    widths: Vec<Option<u32>>,
}

impl NeededWidths {
    pub(super) fn of(&self, part: ExpressionId) -> Option<u32> {
        self.widths.get((part.0 - self.first) as usize).copied().flatten()
    }
}

fn is_free(kind: &ExpressionKind, tables: &[Table]) -> bool {
    match kind {
        ExpressionKind::Unsized(_) => true,
        ExpressionKind::Table { table, .. } => {
            tables[*table].outputs().any(|output| matches!(output.value, OutputValue::Number(_)))
        }
        _ => false,
    }
}

impl ModuleBuilder<'_, '_> {
    pub(super) fn needed_widths(&mut self, root: ExpressionId, frame: u32, expected: Option<u32>) -> NeededWidths {
        let circuit = self.circuit;
        let first = circuit.first_leaf(root);
        let range = first.0 as usize..=root.0 as usize;
        if !circuit.expressions[range].iter().any(|part| is_free(&part.kind, &circuit.tables)) {
            return NeededWidths { first: first.0, widths: Vec::new() };
        }
        let found = self.widths(root, frame);
        let mut needed = NeededWidths { first: first.0, widths: vec![None; (root.0 - first.0 + 1) as usize] };
        needed.widths[(root.0 - first.0) as usize] = expected;
        // The parts of an expression stand before it.
        for at in (first.0..=root.0).rev() {
            let id = ExpressionId(at);
            let own = found.of(id).or(needed.of(id));
            needed.widths[(at - first.0) as usize] = own;
            self.pass_on(id, own, frame, &found, &mut needed);
        }
        needed
    }

    fn pass_on(
        &mut self,
        id: ExpressionId,
        own: Option<u32>,
        frame: u32,
        found: &ExpressionWidths,
        needed: &mut NeededWidths,
    ) {
        let circuit = self.circuit;
        let first = needed.first;
        let mut set = |part: ExpressionId, width: Option<u32>| needed.widths[(part.0 - first) as usize] = width;
        match &circuit.expressions[id.0 as usize].kind {
            ExpressionKind::Operation { operands, .. } => operands.iter().for_each(|&part| set(part, own)),
            ExpressionKind::Choice { condition, then, otherwise } => {
                set(*condition, Some(1));
                set(*then, own);
                set(*otherwise, own);
            }
            ExpressionKind::Table { outputs, .. } => outputs.iter().for_each(|&part| set(part, own)),
            ExpressionKind::Element { net, index, .. } => {
                let net = &self.module.nets[self.net(*net, frame)];
                let places = net.words.or(net.width).map_or(0, |places| SizeKind::log2(places.into()));
                set(*index, Some(places.max(1) as u32));
            }
            ExpressionKind::Call { circuit: callee, arguments, operands } => {
                let widths = operands.iter().map(|part| part.and_then(|part| found.of(part))).collect::<Vec<_>>();
                if operands.iter().flatten().all(|part| found.of(*part).is_some()) {
                    return;
                }
                let ports = self.port_widths(*callee, arguments, &widths, own, frame);
                for (part, port) in operands.iter().zip(ports) {
                    if let Some(part) = part {
                        set(*part, port);
                    }
                }
            }
            _ => {}
        }
    }

    fn port_widths(
        &mut self,
        callee: CircuitId,
        arguments: &[Option<SizeId>],
        operands: &[Option<u32>],
        own: Option<u32>,
        frame: u32,
    ) -> Vec<Option<u32>> {
        let mut given: Vec<Option<i128>> =
            arguments.iter().map(|size| size.and_then(|size| self.size(size, frame))).collect();
        let callee = self.builder.circuit(callee);
        if self.take(Limit::Steps, instance::cost(callee)).is_none() {
            return Vec::new();
        }
        let slot_of = |net: usize| match callee.sizes.get(callee.nets[net].width?.0 as usize)?.kind {
            SizeKind::Variable(slot) => Some(slot as usize),
            _ => None,
        };
        for (net, width) in operands.iter().enumerate() {
            if let (Some(slot), Some(width)) = (slot_of(net), width) {
                given[slot].get_or_insert(i128::from(*width));
            }
        }
        if let (1, Some(slot), Some(own)) = (callee.outputs, slot_of(callee.inputs), own) {
            given[slot].get_or_insert(i128::from(own));
        }
        let mut values = Vec::new();
        for (parameter, given) in callee.parameters.iter().zip(given) {
            let default = |size| size::value(&callee.sizes, size, &values).ok();
            // A parameter that nothing tells is that of a number of one bit.
            values.push(given.or_else(|| parameter.default.and_then(default)).unwrap_or(1));
        }
        (0..operands.len()).map(|net| instance::port_width(callee, net, &values)).collect()
    }

    pub(super) fn free_number(
        &mut self,
        id: ExpressionId,
        number: FreeNumber,
        needed: Option<u32>,
        frame: u32,
    ) -> Option<(u128, u32)> {
        let span = self.span(id);
        let value = match number {
            FreeNumber::Literal(value) => value,
            FreeNumber::Size(size) => self.unsigned(size, frame, span)?,
        };
        match needed {
            Some(width) => Some((value, width)),
            None if value <= 1 => Some((value, 1)),
            None => {
                self.fault(wording::number_without_width(value, span));
                None
            }
        }
    }

    /// Reports the first number of an expression that has no width and is no bit; returns whether there is one.
    pub(super) fn wide_number(&mut self, root: ExpressionId) -> bool {
        let circuit = self.circuit;
        let range = circuit.first_leaf(root).0..=root.0;
        let wide = range.map(ExpressionId).find_map(|id| match circuit.expressions[id.0 as usize].kind {
            ExpressionKind::Unsized(FreeNumber::Literal(value)) if value > 1 => Some((id, value)),
            _ => None,
        });
        if let Some((id, value)) = wide {
            let span = self.span(id);
            self.fault(wording::number_without_width(value, span));
        }
        wide.is_some()
    }
}
