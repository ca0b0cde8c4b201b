//! From expressions to gates, bit by bit; the lowest bit of a value comes first.

use std::ops::Range;

use crate::elaborate::build::ModuleBuilder;
use crate::elaborate::module::{Bit, Item, ModuleId, ModuleKey, ModuleSignal, Site};
use crate::elaborate::table::TableValues;
use crate::elaborate::wording::{self, OperandText};
use crate::index::ListIndex;
use nbc_base::budget::Limit;
use nbc_base::model::{
    CircuitId, ExpressionId, ExpressionKind, FreeNumber, Function, NetSlot, Operator, SizeId, SizeKind, Target,
};
use nbc_base::source::Span;

const A_WITHOUT_B: Function = Function::new(0b0100);

struct Call<'c> {
    callee: CircuitId,
    arguments: &'c [Option<SizeId>],
    operands: &'c [Option<ExpressionId>],
    frame: u32,
    span: Span,
}

const PART_STEPS: u64 = 12;

type NetPart = (Option<SizeId>, Option<(SizeId, SizeId)>);

struct Parts {
    first: u32,
    values: Vec<Vec<Bit>>,
}

impl Parts {
    fn take(&mut self, part: ExpressionId) -> Vec<Bit> {
        std::mem::take(&mut self.values[(part.0 - self.first) as usize])
    }

    fn take_all(&mut self, parts: &[ExpressionId]) -> Vec<Vec<Bit>> {
        parts.iter().map(|&part| self.take(part)).collect()
    }
}

impl ModuleBuilder<'_, '_> {
    pub(super) fn item(&mut self, at: u32) {
        let item = self.items[at as usize];
        self.place = self.span(item.value);
        let name = item.targets.first().and_then(|target| self.target_name(target, item.frame));
        let expected = self.targets_width(&item);
        let Some(values) = self.values(item.value, item.frame, name, expected) else {
            self.failed = true;
            return;
        };
        let span = self.span(item.value);
        if item.joined {
            self.drive_parts(&item, &values[0], at, span);
            return;
        }
        for (target, value) in item.targets.iter().zip(values) {
            self.drive(target, &value, item.frame, at, span);
        }
    }

    fn targets_width(&mut self, item: &Item<'_>) -> Option<u32> {
        if item.targets.len() != 1 && !item.joined {
            return None;
        }
        let widths: Vec<Option<u32>> = item.targets.iter().map(|target| self.target_bits(target, item.frame)).collect();
        widths.into_iter().try_fold(0u32, |sum, width| sum.checked_add(width?))
    }

    fn target_bits(&mut self, target: &Target, frame: u32) -> Option<u32> {
        let Some(slot) = target.net else { return Some(1) };
        let (_, bits) = self.target_range(slot, target, frame)?;
        Some(bits.len() as u32)
    }

    fn target_range(&mut self, slot: NetSlot, target: &Target, frame: u32) -> Option<(usize, Range<u32>)> {
        let net = self.net(slot, frame);
        self.module.nets[net].width?;
        Some((net, self.range(net, target.word, target.bits, frame)?))
    }

    /// Lets the parts of a value drive targets, the highest first.
    fn drive_parts(&mut self, item: &Item<'_>, value: &[Bit], by: u32, span: Span) -> Option<()> {
        let mut widths = Vec::new();
        for target in item.targets {
            widths.push(self.target_bits(target, item.frame)?);
        }
        let total: u32 = widths.iter().sum();
        if value.len() as u32 != total {
            let found = OperandText { span, ..self.operand(item.value, value) };
            let (first, last) = (item.targets[0].span, item.targets[item.targets.len() - 1].span);
            let what = "the value whose parts are named";
            self.fault(wording::wrong_width(what, total, &found, Some(first.to(last))));
            return None;
        }
        let mut high = value.len();
        for (target, width) in item.targets.iter().zip(widths) {
            let low = high - width as usize;
            self.drive(target, &value[low..high], item.frame, by, span);
            high = low;
        }
        Some(())
    }

    fn target_name(&self, target: &Target, frame: u32) -> Option<String> {
        let net = &self.module.nets[self.net(target.net?, frame)];
        let size = target.word.or(target.bits.map(|(high, _)| high));
        let bit = size.and_then(|size| {
            super::size::value(&self.circuit.sizes, size, &self.frames[frame as usize].variables).ok()
        });
        Some(bit.map_or_else(|| net.name.clone(), |bit| format!("{}[{bit}]", net.name)))
    }

    fn drive(&mut self, target: &Target, value: &[Bit], frame: u32, by: u32, span: Span) {
        let Some(slot) = target.net else { return };
        let Some((net, bits)) = self.target_range(slot, target, frame) else { return };
        let name = self.module.nets[net].name.clone();
        if value.len() != bits.len() {
            let found = OperandText { span, ..self.operand(self.items[by as usize].value, value) };
            let what = format!("the value of `{name}`");
            self.fault(wording::wrong_width(&what, bits.len() as u32, &found, Some(target.span)));
            return;
        }
        if let Some(array) = self.circuit.nets[slot.0 as usize].selects
            && let Some(words) = self.words_of(array, frame)
        {
            let (name, index) = (&self.circuit.nets[array.0 as usize].name, self.items[by as usize].value);
            self.look_outside(name, (words, true), index, value);
        }
        let first = self.module.nets[net].first;
        for (bit, &driver) in bits.clone().zip(value) {
            self.drive_bit(first + bit, driver, by, target.span);
        }
        if let Some(start) = target.start {
            self.start(start, first + bits.start, bits.len() as u32, frame);
        }
    }

    fn drive_bit(&mut self, bit: Bit, value: Bit, item: u32, span: Span) {
        let ModuleSignal::Net { driver, by, net, .. } = &mut self.module.signals[bit as usize] else {
            unreachable!("inputs are no targets")
        };
        if driver.is_none() {
            (*driver, *by) = (Some(ListIndex::new(value)), item);
            return;
        }
        let (first, net) = (*by, *net);
        let first = self.items[first as usize].targets.first().map_or(span, |target| target.span);
        let net = &self.module.nets[net as usize].name;
        self.fault(wording::driven_again(net, (first != span).then_some(first), span));
    }

    fn start(&mut self, start: SizeId, first: Bit, width: u32, frame: u32) {
        let Some(value) = self.size(start, frame) else { return };
        if value < 0 || (width < 63 && value >= 1 << width) {
            let span = self.circuit.sizes[start.0 as usize].span;
            self.fault(wording::start_value(value, width, span));
            return;
        }
        let bit = |at: u32| at < 63 && value >> at & 1 == 1;
        self.module.starts.extend((0..width).map(|at| (first + at, bit(at))));
    }

    /// From the leaves to the root, without recursion; `None` after an error.
    fn values(
        &mut self,
        root: ExpressionId,
        frame: u32,
        name: Option<String>,
        expected: Option<u32>,
    ) -> Option<Vec<Vec<Bit>>> {
        let needed = self.needed_widths(root, frame, expected);
        let first = self.circuit.first_leaf(root);
        let mut parts = Parts { first: first.0, values: Vec::new() };
        for at in first.0..root.0 {
            let id = ExpressionId(at);
            let value = self.value(id, frame, None, needed.of(id), &mut parts)?;
            parts.values.push(value.into_iter().next().expect("an expression inside has one value"));
        }
        self.value(root, frame, name, needed.of(root), &mut parts)
    }

    fn value(
        &mut self,
        id: ExpressionId,
        frame: u32,
        name: Option<String>,
        needed: Option<u32>,
        parts: &mut Parts,
    ) -> Option<Vec<Vec<Bit>>> {
        let circuit = self.circuit;
        let span = self.span(id);
        let value = match &circuit.expressions[id.0 as usize].kind {
            ExpressionKind::Bits(bits) => bits.iter().rev().map(|&bit| self.constant(bit)).collect(),
            ExpressionKind::Unsized(number) => {
                let (value, width) = self.free_number(id, *number, needed, frame)?;
                self.number_bits(width, value, span)?
            }
            ExpressionKind::Number { width, value } => self.number(*width, *value, frame, span)?,
            ExpressionKind::Computed { width, value } => {
                let value = self.unsigned(*value, frame, span)?;
                self.number(*width, value, frame, span)?
            }
            ExpressionKind::Net(slot) => self.bits(*slot, (None, None), frame)?,
            ExpressionKind::Slice { net, word, bits } => self.bits(*net, (*word, *bits), frame)?,
            ExpressionKind::Element { net, index, bits } => {
                let index = (*index, parts.take(*index));
                self.element(*net, index, *bits, frame)?
            }
            ExpressionKind::Concatenation(list) => list.iter().rev().flat_map(|&part| parts.take(part)).collect(),
            ExpressionKind::Repetition { count, value } => self.repetition(*count, &parts.take(*value), frame)?,
            ExpressionKind::Operation { operator, operands } => {
                self.operation(*operator, operands, parts.take_all(operands), span)?
            }
            ExpressionKind::Choice { condition, then, otherwise } => {
                let list = [*condition, *then, *otherwise];
                self.choice(list, parts.take_all(&list), span)?
            }
            ExpressionKind::Table { inputs, outputs, table } => {
                let values = parts.take_all(outputs);
                let inputs: Vec<Bit> = inputs.iter().rev().flat_map(|&part| parts.take(part)).collect();
                let values = TableValues { expressions: outputs, bits: &values, width: needed };
                self.table(&circuit.tables[*table], &inputs, values)?
            }
            ExpressionKind::Call { circuit, arguments, operands } => {
                let values = operands.iter().map(|part| part.map(|part| parts.take(part))).collect();
                return self.call(Call { callee: *circuit, arguments, operands, frame, span }, values, name);
            }
        };
        self.take(Limit::Steps, PART_STEPS + value.len() as u64)?;
        Some(vec![value])
    }

    pub(super) fn constant(&mut self, value: bool) -> Bit {
        if let Some(known) = self.constants[usize::from(value)] {
            return known;
        }
        let made = self.signal(ModuleSignal::Constant(value));
        self.constants[usize::from(value)] = Some(made);
        made
    }

    pub(super) fn constant_of(&self, bit: Bit) -> Option<bool> {
        [false, true].into_iter().find(|&value| self.constants[usize::from(value)] == Some(bit))
    }

    /// Any other signal if there is no room: the module has failed.
    pub(super) fn signal(&mut self, signal: ModuleSignal) -> Bit {
        if self.take(Limit::Nets, 1).is_none() {
            return 0;
        }
        self.module.signals.push(signal);
        self.module.signals.len() as Bit - 1
    }

    pub(super) fn gate(&mut self, function: Function, pins: [Bit; 2], span: Span) -> Bit {
        self.signal(ModuleSignal::Gate { function, pins, span })
    }

    fn number(&mut self, width: SizeId, value: u128, frame: u32, span: Span) -> Option<Vec<Bit>> {
        let width = self.width(width, frame)?;
        self.number_bits(width, value, span)
    }

    fn number_bits(&mut self, width: u32, value: u128, span: Span) -> Option<Vec<Bit>> {
        let bits = self.fitting_bits(value, width, span)?;
        Some(bits.into_iter().map(|bit| self.constant(bit)).collect())
    }

    /// The bits of a number, the lowest first; reports a number that does not fit into the width.
    pub(super) fn fitting_bits(&mut self, value: u128, width: u32, span: Span) -> Option<Vec<bool>> {
        if width < u128::BITS && value >> width != 0 {
            self.fault(wording::constant_width(value, width, span));
            return None;
        }
        Some((0..width).map(|bit| bit < u128::BITS && value >> bit & 1 == 1).collect())
    }

    fn bits(&mut self, slot: NetSlot, part: NetPart, frame: u32) -> Option<Vec<Bit>> {
        let net = self.net(slot, frame);
        self.module.nets[net].width?;
        let first = self.module.nets[net].first;
        let bits = self.range(net, part.0, part.1, frame)?;
        Some(bits.map(|bit| self.known(first + bit)).collect())
    }

    fn known(&mut self, bit: Bit) -> Bit {
        match self.module.signals[bit as usize] {
            ModuleSignal::Constant(value) => self.constant(value),
            _ => bit,
        }
    }

    fn range(
        &mut self,
        net: usize,
        word: Option<SizeId>,
        bits: Option<(SizeId, SizeId)>,
        frame: u32,
    ) -> Option<Range<u32>> {
        let (width, words) = (self.module.nets[net].width?, self.module.nets[net].words.unwrap_or(1));
        let name = self.module.nets[net].name.clone();
        let (base, width) = match word {
            Some(word) => {
                let at = self.size(word, frame)?;
                let Some(at) = u32::try_from(at).ok().filter(|at| *at < words) else {
                    let span = self.circuit.sizes[word.0 as usize].span;
                    self.fault(wording::no_such_word(&name, at, words, span));
                    return None;
                };
                (at * (width / words), width / words)
            }
            None => (0, width),
        };
        match bits {
            Some(bits) => self.slice(bits, width, &name, frame).map(|bits| base + bits.start..base + bits.end),
            None => Some(base..base + width),
        }
    }

    /// A tree of choices; a place that does not exist shows 0.
    fn element(
        &mut self,
        slot: NetSlot,
        (index, value): (ExpressionId, Vec<Bit>),
        bits: Option<(SizeId, SizeId)>,
        frame: u32,
    ) -> Option<Vec<Bit>> {
        let net = self.net(slot, frame);
        let width = self.module.nets[net].width?;
        let words = self.module.nets[net].words.unwrap_or(width);
        let name = self.module.nets[net].name.clone();
        let places = SizeKind::log2(words.into()).max(1) as u32;
        if value.len() as u32 != places {
            let found = self.operand(index, &value);
            let what = format!("the value that selects one of {words} of `{name}`");
            self.fault(wording::wrong_width(&what, places, &found, None));
            return None;
        }
        let is_word = self.module.nets[net].words.is_some();
        self.look_outside(&name, (words, is_word), index, &value);
        let word = width / words;
        let bits = match bits {
            Some(bits) => self.slice(bits, word, &name, frame)?,
            None => 0..word,
        };
        let first = self.module.nets[net].first;
        let span = self.span(index);
        self.take(Limit::Steps, u64::from(words) * bits.len() as u64)?;
        let column = |builder: &mut Self, bit: u32| {
            let mut level: Vec<Bit> = (0..words).map(|place| builder.known(first + place * word + bit)).collect();
            for &selected in &value {
                level = level
                    .chunks(2)
                    .map(|pair| match *pair {
                        [zero, one] => builder.select(selected, one, zero, span),
                        _ => builder.unless(selected, pair[0], span),
                    })
                    .collect();
            }
            level[0]
        };
        Some(bits.map(|bit| column(self, bit)).collect())
    }

    fn repetition(&mut self, count: SizeId, value: &[Bit], frame: u32) -> Option<Vec<Bit>> {
        let times = self.size(count, frame)?;
        let bits = u64::try_from(times).ok().map(|times| times.saturating_mul(value.len() as u64));
        if bits.is_none_or(|bits| Limit::Width.permit(bits).is_err()) {
            let span = self.circuit.sizes[count.0 as usize].span;
            self.fault(wording::repetitions(times, span));
            return None;
        }
        Some(value.repeat(times as usize))
    }

    fn operation(
        &mut self,
        operator: Operator,
        operands: &[ExpressionId],
        values: Vec<Vec<Bit>>,
        span: Span,
    ) -> Option<Vec<Bit>> {
        let width = values[0].len();
        if let Some(at) = values.iter().position(|value| value.len() != width) {
            let [first, second] = [0, at].map(|at| self.operand(operands[at], &values[at]));
            self.fault(wording::unequal(&format!("the operands of `{}`", operator.word()), &first, &second));
            return None;
        }
        Some((0..width).map(|bit| self.operation_bit(operator, values.iter().map(|value| value[bit]), span)).collect())
    }

    /// All operands but the last are combined without the final inversion.
    fn operation_bit(&mut self, operator: Operator, mut operands: impl Iterator<Item = Bit>, span: Span) -> Bit {
        let first = operands.next().expect("an operation has operands");
        let (inner, last) = match operator {
            Operator::Not => return self.gate(Function::NOT, [first; 2], span),
            Operator::And => (Function::AND, Function::AND),
            Operator::Or => (Function::OR, Function::OR),
            Operator::Xor => (Function::XOR, Function::XOR),
            Operator::Nand => (Function::AND, Function::NAND),
            Operator::Nor => (Function::OR, Function::NOR),
            Operator::Xnor => (Function::XOR, Function::XNOR),
        };
        let mut operands = operands.peekable();
        let mut value = first;
        while let Some(operand) = operands.next() {
            let function = if operands.peek().is_some() { inner } else { last };
            value = self.gate(function, [value, operand], span);
        }
        value
    }

    fn choice(&mut self, parts: [ExpressionId; 3], values: Vec<Vec<Bit>>, span: Span) -> Option<Vec<Bit>> {
        let [condition, then, otherwise] = &values[..] else { unreachable!("a choice has three parts") };
        if condition.len() != 1 {
            let found = self.operand(parts[0], condition);
            self.fault(wording::wide_condition(&found));
            return None;
        }
        if then.len() != otherwise.len() {
            let (first, second) = (self.operand(parts[1], then), self.operand(parts[2], otherwise));
            self.fault(wording::unequal("the branches", &first, &second));
            return None;
        }
        let pairs = then.iter().zip(otherwise);
        Some(pairs.map(|(&then, &otherwise)| self.select(condition[0], then, otherwise, span)).collect())
    }

    pub(super) fn select(&mut self, condition: Bit, then: Bit, otherwise: Bit, span: Span) -> Bit {
        if let Some(value) = self.constant_of(condition) {
            return if value { then } else { otherwise };
        }
        let chosen = self.gate(Function::AND, [condition, then], span);
        let other = self.gate(A_WITHOUT_B, [otherwise, condition], span);
        self.gate(Function::OR, [chosen, other], span)
    }

    fn unless(&mut self, condition: Bit, value: Bit, span: Span) -> Bit {
        match self.constant_of(condition) {
            Some(false) => value,
            Some(true) => self.constant(false),
            None => self.gate(A_WITHOUT_B, [value, condition], span),
        }
    }

    fn call(&mut self, call: Call, values: Vec<Option<Vec<Bit>>>, name: Option<String>) -> Option<Vec<Vec<Bit>>> {
        let id = self.callee(&call, &values)?;
        let name = name.unwrap_or_else(|| {
            self.unnamed += 1;
            format!("{}_{}", self.builder.circuit(call.callee).name, self.unnamed)
        });
        self.take(Limit::Instances, 1)?;
        self.take(Limit::NetNameBytes, name.len() as u64)?;
        let site = self.module.sites.len() as u32;
        let inputs = values.into_iter().flatten().flatten().collect();
        self.module.sites.push(Site { module: id, inputs, name });
        let outputs: Vec<u32> = self.builder.module(id).outputs.iter().map(|port| port.width).collect();
        let mut bit = 0;
        let mut output = |width: u32| {
            let bits = bit..bit + width;
            bit += width;
            bits.map(|bit| self.signal(ModuleSignal::Output { site, bit })).collect()
        };
        Some(outputs.into_iter().map(&mut output).collect())
    }

    pub(super) fn operand(&self, id: ExpressionId, value: &[Bit]) -> OperandText {
        let kind = &self.circuit.expressions[id.0 as usize].kind;
        let net = match kind {
            ExpressionKind::Net(slot) => Some(self.circuit.nets[slot.0 as usize].name.clone()),
            _ => None,
        };
        let constant = match kind {
            ExpressionKind::Number { value, .. } | ExpressionKind::Unsized(FreeNumber::Literal(value)) => Some(*value),
            ExpressionKind::Bits(bits) if bits.len() == 1 => Some(u128::from(bits[0])),
            _ => None,
        };
        OperandText { width: value.len() as u32, span: self.span(id), net, constant }
    }

    fn callee(&mut self, call: &Call, values: &[Option<Vec<Bit>>]) -> Option<ModuleId> {
        let mut arguments = Vec::new();
        for size in call.arguments {
            arguments.push(match size {
                Some(size) => Some(self.size(*size, call.frame)?),
                None => None,
            });
        }
        let widths: Vec<_> = values.iter().map(|value| value.as_ref().map(|value| value.len() as u32)).collect();
        let absent = values.iter().zip(0..).filter(|(value, _)| value.is_none()).map(|(_, port)| port).collect();
        let known = self.builder.diagnostics.len();
        let arguments = self.builder.arguments(call.callee, arguments, &widths, call.span);
        let key = |arguments| ModuleKey { circuit: call.callee, arguments, absent };
        let id = arguments.and_then(|arguments| self.builder.build(key(arguments)));
        self.builder.show_at(call.span, known);
        let id = id?;
        let inputs: Vec<u32> = self.builder.module(id).inputs.iter().map(|port| port.width).collect();
        let given = values.iter().zip(call.operands).enumerate();
        let given = given.filter_map(|(port, (value, operand))| Some((port, value.as_ref()?, (*operand)?)));
        for ((port, value, operand), expected) in given.zip(inputs) {
            if value.len() as u32 != expected {
                let found = self.operand(operand, value);
                let circuit = self.builder.circuit(call.callee);
                let what = format!("the operand `{}` of `{}`", circuit.nets[port].name, circuit.name);
                self.fault(wording::wrong_width(&what, expected, &found, None));
                return None;
            }
        }
        if self.builder.program.selector == Some(call.callee) {
            self.look_selected(call.operands, values);
        }
        Some(id)
    }
}
