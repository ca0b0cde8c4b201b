//! Infers the widths of undeclared nets from their drivers.

use std::collections::VecDeque;

use crate::elaborate::build::ModuleBuilder;
use crate::elaborate::instance;
use crate::elaborate::wording::ElaborateError;
use nbc_base::model::{ExpressionId, ExpressionKind, NetSlot, OutputValue, TableOutput};

/// The widths of an expression's values, if known, and the first net whose width is missing.
struct Widths {
    values: Vec<Option<u32>>,
    missing: Option<usize>,
}

impl ModuleBuilder<'_, '_> {
    /// Infers the width of every net. A net that depends on others comes after them.
    pub(super) fn infer_widths(&mut self) {
        self.give_declared_widths();
        let mut open: VecDeque<u32> = (0..self.items.len() as u32).filter(|&item| self.is_open(item)).collect();
        // Each pass uses the results of the previous one; a pass without a result leaves only loops of nets without a
        // width.
        while !open.is_empty() && !self.failed {
            let before = open.len();
            open = self.settle(open);
            if open.len() == before {
                self.unknown_widths(&open);
            }
        }
    }

    fn give_declared_widths(&mut self) {
        for frame in 0..self.frames.len() as u32 {
            let (first_slot, first_net, nets) = self.frames[frame as usize].nets();
            for at in 0..nets {
                let net = (first_net + at) as usize;
                if self.module.nets[net].width.is_none()
                    && let Some(width) = self.declared_width(NetSlot(first_slot + at), frame)
                {
                    self.give_width(net, width);
                }
            }
        }
    }

    /// Whether a statement drives a whole net without a width.
    fn is_open(&self, item: u32) -> bool {
        let item = self.items[item as usize];
        item.targets.iter().any(|target| {
            target.bits.is_none()
                && target.net.is_some_and(|slot| self.module.nets[self.net(slot, item.frame)].width.is_none())
        })
    }

    /// Infers what is possible. A statement that waits for a net is processed again when that net has its width.
    fn settle(&mut self, mut open: VecDeque<u32>) -> VecDeque<u32> {
        let mut waiting: std::collections::BTreeMap<usize, Vec<u32>> = std::collections::BTreeMap::new();
        let mut stuck = VecDeque::new();
        while let Some(item) = open.pop_front() {
            if let Some(missing) = self.settle_item(item) {
                waiting.entry(missing).or_default().push(item);
                continue;
            }
            for net in self.driven_nets(item) {
                open.extend(waiting.remove(&net).unwrap_or_default());
            }
            if self.is_open(item) {
                stuck.push_back(item);
            }
        }
        stuck.extend(waiting.into_values().flatten());
        stuck
    }

    fn driven_nets(&self, item: u32) -> Vec<usize> {
        let item = self.items[item as usize];
        item.targets.iter().filter_map(|target| Some(self.net(target.net?, item.frame))).collect()
    }

    /// Sets the widths of a statement's targets, or returns the net it waits for.
    fn settle_item(&mut self, item: u32) -> Option<usize> {
        let Widths { values, missing } = self.widths(self.items[item as usize].value, self.items[item as usize].frame);
        let item = self.items[item as usize];
        for (target, width) in item.targets.iter().zip(values) {
            let (Some(slot), None, Some(width)) = (target.net, target.bits, width) else { continue };
            let net = self.net(slot, item.frame);
            if self.module.nets[net].width.is_none() {
                self.give_width(net, width);
            }
        }
        missing
    }

    fn unknown_widths(&mut self, open: &VecDeque<u32>) {
        for &item in open {
            for net in self.driven_nets(item) {
                if self.module.nets[net].width.is_none() {
                    let (net, span) = (self.module.nets[net].name.clone(), self.module.nets[net].span);
                    self.fault(ElaborateError::UnknownWidth { net }.at(span));
                }
            }
        }
        self.failed = true;
    }

    /// The widths of an expression, from its leaves to its root without recursion.
    fn widths(&mut self, root: ExpressionId, frame: u32) -> Widths {
        let circuit = self.circuit;
        let mut done: Vec<Option<u32>> = Vec::new();
        let mut missing = None;
        for at in circuit.first_leaf(root).0..root.0 {
            let width = self.width_of(ExpressionId(at), frame, &mut done, &mut missing)[..].first().copied().flatten();
            done.push(width);
        }
        let values = self.width_of(root, frame, &mut done, &mut missing);
        let known = values.iter().all(Option::is_some);
        Widths { values, missing: missing.filter(|_| !known) }
    }

    fn width_of(
        &mut self,
        id: ExpressionId,
        frame: u32,
        done: &mut Vec<Option<u32>>,
        missing: &mut Option<usize>,
    ) -> Vec<Option<u32>> {
        let circuit = self.circuit;
        let mut take = |count: usize| done.split_off(done.len() - count);
        let one = |width| vec![width];
        match &circuit.expressions[id.0 as usize].kind {
            ExpressionKind::Bits(bits) => one(Some(bits.len() as u32)),
            ExpressionKind::Number { width, .. } | ExpressionKind::Computed { width, .. } => {
                one(self.width(*width, frame))
            }
            ExpressionKind::Net(slot) => {
                let net = self.net(*slot, frame);
                let width = self.module.nets[net].width;
                if width.is_none() {
                    missing.get_or_insert(net);
                }
                one(width)
            }
            ExpressionKind::Slice { high, low, .. } => {
                let (high, low) = (self.size(*high, frame), self.size(*low, frame));
                one(high.zip(low).and_then(|(high, low)| u32::try_from(high.checked_sub(low)?.checked_add(1)?).ok()))
            }
            ExpressionKind::Concatenation(parts) => {
                one(take(parts.len()).into_iter().try_fold(0u32, |sum, part| sum.checked_add(part?)))
            }
            ExpressionKind::Repetition { count, .. } => {
                let value = take(1)[0];
                let count = self.size(*count, frame);
                one(count.zip(value).and_then(|(count, value)| u32::try_from(count).ok()?.checked_mul(value)))
            }
            ExpressionKind::Operation { operands, .. } => one(take(operands.len()).into_iter().flatten().next()),
            ExpressionKind::Choice { .. } => {
                let branches = take(3);
                one(branches[1].or(branches[2]))
            }
            ExpressionKind::Table { inputs, outputs, table } => {
                let expressions = take(outputs.len());
                take(inputs.len());
                let width = |output: &TableOutput| match &output.value {
                    OutputValue::Bits(bits) => Some(bits.len() as u32),
                    OutputValue::Expression(index) => expressions[*index],
                };
                one(circuit.tables[*table].outputs().find_map(width))
            }
            ExpressionKind::Call { circuit: callee, arguments, operands } => {
                let operands = take(operands.len());
                let given = arguments.iter().map(|size| size.and_then(|size| self.size(size, frame))).collect();
                let callee = self.builder.circuit(*callee);
                let arguments = instance::arguments(callee, given, &operands, self.span(id)).ok();
                match arguments.and_then(|arguments| instance::output_widths(callee, &arguments)) {
                    Some(widths) => widths.into_iter().map(Some).collect(),
                    None => vec![None; callee.outputs],
                }
            }
        }
    }
}
