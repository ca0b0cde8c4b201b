//! Infers the widths of undeclared nets from their drivers.

use std::collections::VecDeque;

use crate::elaborate::build::ModuleBuilder;
use crate::elaborate::instance;
use crate::elaborate::wording;
use nbc_base::budget::Limit;
use nbc_base::model::{CircuitId, ExpressionId, ExpressionKind, NetSlot, OutputValue, SizeId, TableOutput};

const WIDTH_STEPS: u64 = 4;

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum PartWidth {
    Known(u32),
    /// As many bits as its context needs: it has only numbers without a width.
    Free,
    Unknown,
}

impl PartWidth {
    fn known(width: Option<u32>) -> Self {
        width.map_or(Self::Unknown, Self::Known)
    }

    fn bits(self) -> Option<u32> {
        match self {
            Self::Known(width) => Some(width),
            _ => None,
        }
    }

    /// The width as a part of a longer value, where numbers alone are bits.
    fn joined(self) -> Option<u32> {
        if self == Self::Free { Some(1) } else { self.bits() }
    }

    fn common(parts: impl Iterator<Item = Self>) -> Self {
        parts.fold(Self::Free, |common, part| match (common, part) {
            (Self::Known(_), _) | (_, Self::Free) => common,
            _ => part,
        })
    }
}

pub(super) struct ExpressionWidths {
    first: u32,
    parts: Vec<PartWidth>,
    pub(super) values: Vec<PartWidth>,
    missing: Option<usize>,
}

impl ExpressionWidths {
    fn part(&self, id: ExpressionId) -> PartWidth {
        self.parts[(id.0 - self.first) as usize]
    }

    pub(super) fn of(&self, id: ExpressionId) -> Option<u32> {
        match self.parts.get((id.0 - self.first) as usize) {
            Some(part) => part.bits(),
            None => self.values.first().and_then(|value| value.bits()),
        }
    }
}

impl ModuleBuilder<'_, '_> {
    pub(super) fn infer_widths(&mut self) {
        self.give_declared_widths();
        let mut open: VecDeque<u32> = (0..self.items.len() as u32).filter(|&item| self.is_open(item)).collect();
        // Each pass uses the results of the previous one; a pass without a result leaves only loops of nets without a
        // width, in which numbers are bits.
        while !open.is_empty() && !self.failed {
            let before = open.len();
            open = self.settle(open);
            if open.len() < before || self.builder.over.is_some() {
                self.only_loops = false;
            } else if self.only_loops {
                self.unknown_widths(&open);
            } else {
                self.only_loops = true;
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
                    let words = self.declared_words(NetSlot(first_slot + at), frame);
                    self.give_array(net, width, words);
                }
            }
        }
    }

    fn is_open(&self, item: u32) -> bool {
        let item = self.items[item as usize];
        item.targets.iter().any(|target| {
            let whole = target.bits.is_none() && target.word.is_none() && !item.joined;
            whole && target.net.is_some_and(|slot| self.module.nets[self.net(slot, item.frame)].width.is_none())
        })
    }

    /// A statement that waits for a net is processed again when that net has its width.
    fn settle(&mut self, mut open: VecDeque<u32>) -> VecDeque<u32> {
        let mut waiting: std::collections::BTreeMap<usize, Vec<u32>> = std::collections::BTreeMap::new();
        let mut stuck = VecDeque::new();
        while let Some(item) = open.pop_front().filter(|_| self.builder.over.is_none()) {
            let missing = self.settle_item(item);
            if let Some(missing) = missing.filter(|_| self.is_open(item)) {
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
        let item = self.items[item as usize];
        let found = self.widths(item.value, item.frame);
        // A call with several outputs tells their widths.
        let of_numbers = found.values == [PartWidth::Free];
        for (target, width) in item.targets.iter().zip(found.values) {
            let (Some(slot), None, None, false) = (target.net, target.bits, target.word, item.joined) else { continue };
            let net = self.net(slot, item.frame);
            if self.module.nets[net].width.is_some() {
                continue;
            }
            match width {
                PartWidth::Known(width) => self.give_width(net, width),
                PartWidth::Free if of_numbers && !self.wide_number(item.value) => self.give_width(net, 1),
                _ => {}
            }
        }
        found.missing
    }

    fn unknown_widths(&mut self, open: &VecDeque<u32>) {
        for &item in open {
            for net in self.driven_nets(item) {
                if self.module.nets[net].width.is_none() {
                    let (net, span) = (self.module.nets[net].name.clone(), self.module.nets[net].span);
                    self.fault(wording::unknown_width(&net, span));
                }
            }
        }
        self.failed = true;
    }

    pub(super) fn widths(&mut self, root: ExpressionId, frame: u32) -> ExpressionWidths {
        let first = self.circuit.first_leaf(root).0;
        let mut found = ExpressionWidths { first, parts: Vec::new(), values: Vec::new(), missing: None };
        if self.take(Limit::Steps, WIDTH_STEPS * (u64::from(root.0 - first) + 1)).is_none() {
            return found;
        }
        for at in first..root.0 {
            let width = self.width_of(ExpressionId(at), frame, &mut found);
            found.parts.push(width.first().copied().unwrap_or(PartWidth::Unknown));
        }
        found.values = self.width_of(root, frame, &mut found);
        if found.values.iter().all(|value| matches!(value, PartWidth::Known(_))) {
            found.missing = None;
        }
        found
    }

    fn width_of(&mut self, id: ExpressionId, frame: u32, found: &mut ExpressionWidths) -> Vec<PartWidth> {
        let circuit = self.circuit;
        let one = |width| vec![PartWidth::known(width)];
        match &circuit.expressions[id.0 as usize].kind {
            ExpressionKind::Bits(bits) => one(Some(bits.len() as u32)),
            ExpressionKind::Unsized(_) => vec![PartWidth::Free],
            ExpressionKind::Number { width, .. } | ExpressionKind::Computed { width, .. } => {
                one(self.width(*width, frame))
            }
            ExpressionKind::Net(slot) => one(self.net_width(*slot, frame, found)),
            ExpressionKind::Slice { bits: Some((high, low)), .. }
            | ExpressionKind::Element { bits: Some((high, low)), .. } => {
                let (high, low) = (self.size(*high, frame), self.size(*low, frame));
                one(high.zip(low).and_then(|(high, low)| u32::try_from(high.checked_sub(low)?.checked_add(1)?).ok()))
            }
            ExpressionKind::Slice { net, .. } | ExpressionKind::Element { net, .. } => {
                let width = self.net_width(*net, frame, found);
                let words = self.module.nets[self.net(*net, frame)].words;
                one(width.map(|width| words.map_or(1, |words| width / words)))
            }
            ExpressionKind::Concatenation(parts) => {
                one(parts.iter().try_fold(0u32, |sum, part| sum.checked_add(found.part(*part).joined()?)))
            }
            ExpressionKind::Repetition { count, value } => {
                let value = found.part(*value).joined();
                let count = self.size(*count, frame);
                one(count.zip(value).and_then(|(count, value)| u32::try_from(count).ok()?.checked_mul(value)))
            }
            ExpressionKind::Operation { operands, .. } => {
                vec![PartWidth::common(operands.iter().map(|part| found.part(*part)))]
            }
            ExpressionKind::Choice { then, otherwise, .. } => {
                vec![PartWidth::common([*then, *otherwise].map(|part| found.part(part)).into_iter())]
            }
            ExpressionKind::Table { outputs, table, .. } => {
                let width = |output: &TableOutput| match &output.value {
                    OutputValue::Bits(bits) => PartWidth::Known(bits.len() as u32),
                    OutputValue::Number(_) => PartWidth::Free,
                    OutputValue::Expression(index) => found.part(outputs[*index]),
                };
                vec![PartWidth::common(circuit.tables[*table].outputs().map(width))]
            }
            ExpressionKind::Call { circuit: callee, arguments, operands } => {
                let parts: Vec<_> = operands.iter().map(|part| part.map(|part| found.part(part))).collect();
                self.call_widths(id, *callee, arguments, &parts, frame)
            }
        }
    }

    fn net_width(&self, slot: NetSlot, frame: u32, found: &mut ExpressionWidths) -> Option<u32> {
        let net = self.net(slot, frame);
        let width = self.module.nets[net].width;
        if width.is_none() {
            found.missing.get_or_insert(net);
        }
        width
    }

    fn is_number(&self, operands: &[Option<PartWidth>]) -> bool {
        let has = |width| operands.contains(&Some(width));
        has(PartWidth::Free) && (self.only_loops || !has(PartWidth::Unknown))
    }

    /// Where only a number tells a parameter, the outputs are as free as the number.
    fn call_widths(
        &mut self,
        id: ExpressionId,
        callee: CircuitId,
        arguments: &[Option<SizeId>],
        operands: &[Option<PartWidth>],
        frame: u32,
    ) -> Vec<PartWidth> {
        let given: Vec<_> = arguments.iter().map(|size| size.and_then(|size| self.size(size, frame))).collect();
        let (callee, span) = (self.builder.circuit(callee), self.span(id));
        if self.take(Limit::Steps, instance::cost(callee)).is_none() {
            return vec![PartWidth::Unknown; callee.outputs];
        }
        let widths: Vec<_> = operands.iter().map(|part| part.and_then(PartWidth::bits)).collect();
        let known = instance::arguments(callee, given, &widths, span).ok();
        match known.and_then(|arguments| instance::output_widths(callee, &arguments)) {
            Some(widths) => widths.into_iter().map(PartWidth::Known).collect(),
            None if callee.outputs == 1 && self.is_number(operands) => vec![PartWidth::Free],
            None => vec![PartWidth::Unknown; callee.outputs],
        }
    }
}
