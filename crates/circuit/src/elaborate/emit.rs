//! From expressions to gates, bit by bit; the lowest bit of a value comes first.

use crate::elaborate::build::ModuleBuilder;
use crate::elaborate::module::{Bit, ModuleId, ModuleSignal, Site};
use crate::elaborate::table::TableValues;
use crate::elaborate::wording::{ElaborateError, OperandText, RangeError, Wide, WidthError};
use crate::index::ListIndex;
use nbc_base::model::{CircuitId, ExpressionId, ExpressionKind, Function, NetSlot, Operator, SizeId, Target};
use nbc_base::source::Span;

/// `a` without `b`.
const A_WITHOUT_B: u8 = 0b0100;

/// An expression that calls a circuit.
struct Call<'c> {
    callee: CircuitId,
    /// Its parameters; `None` if not given.
    arguments: &'c [Option<SizeId>],
    operands: &'c [ExpressionId],
    /// The turns of the loops around it.
    frame: u32,
    span: Span,
}

impl ModuleBuilder<'_, '_> {
    /// Builds one statement.
    pub(super) fn item(&mut self, at: u32) {
        let item = self.items[at as usize];
        let name = item.targets.first().and_then(|target| self.target_name(target, item.frame));
        let Some(values) = self.values(item.value, item.frame, name) else {
            self.failed = true;
            return;
        };
        let span = self.span(item.value);
        for (target, value) in item.targets.iter().zip(values) {
            self.drive(target, &value, item.frame, at, span);
        }
    }

    /// A target as the name of a circuit inside.
    fn target_name(&self, target: &Target, frame: u32) -> Option<String> {
        let net = &self.module.nets[self.net(target.net?, frame)];
        let bit = target.bits.and_then(|(high, _)| {
            super::size::value(&self.circuit.sizes, high, &self.frames[frame as usize].variables).ok()
        });
        Some(bit.map_or_else(|| net.name.clone(), |bit| format!("{}[{bit}]", net.name)))
    }

    /// Lets a value drive a target.
    fn drive(&mut self, target: &Target, value: &[Bit], frame: u32, by: u32, span: Span) {
        let Some(slot) = target.net else { return };
        let net = self.net(slot, frame);
        let Some(width) = self.module.nets[net].width else { return };
        let name = self.module.nets[net].name.clone();
        let Some((low, count)) = target.bits.map_or(Some((0, width)), |bits| self.slice(bits, width, &name, frame))
        else {
            return;
        };
        if value.len() as u32 != count {
            let found = OperandText { span, ..self.operand(self.items[by as usize].value, value) };
            let what = Wide::Value { net: name, target: target.span };
            self.fault(WidthError::Wrong { what, expected: count, found }.into());
            return;
        }
        let first = self.module.nets[net].first + low;
        for (at, &driver) in value.iter().enumerate() {
            self.drive_bit(first + at as u32, driver, by, target.span);
        }
        if let Some(start) = target.start {
            self.start(start, first, count, frame);
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
        let first = self.items[first as usize].targets.iter().map(|target| target.span).next().unwrap_or(span);
        let net = self.module.nets[net as usize].name.clone();
        self.fault(ElaborateError::DrivenAgain { net, first: (first != span).then_some(first) }.at(span));
    }

    fn start(&mut self, start: SizeId, first: Bit, width: u32, frame: u32) {
        let Some(value) = self.size(start, frame) else { return };
        if value < 0 || (width < 63 && value >= 1 << width) {
            let span = self.circuit.sizes[start.0 as usize].span;
            self.fault(RangeError::StartValue { value, width }.at(span));
            return;
        }
        let bit = |at: u32| at < 63 && value >> at & 1 == 1;
        self.module.starts.extend((0..width).map(|at| (first + at, bit(at))));
    }

    /// The values of an expression, from its leaves to its root without recursion; `None` after an error.
    fn values(&mut self, root: ExpressionId, frame: u32, name: Option<String>) -> Option<Vec<Vec<Bit>>> {
        let circuit = self.circuit;
        let mut done: Vec<Vec<Bit>> = Vec::new();
        for at in circuit.first_leaf(root).0..root.0 {
            let value = self.value(ExpressionId(at), frame, None, &mut done)?;
            done.push(value.into_iter().next().expect("an expression inside has one value"));
        }
        self.value(root, frame, name, &mut done)
    }

    fn value(
        &mut self,
        id: ExpressionId,
        frame: u32,
        name: Option<String>,
        done: &mut Vec<Vec<Bit>>,
    ) -> Option<Vec<Vec<Bit>>> {
        let circuit = self.circuit;
        let span = self.span(id);
        let mut take = |count: usize| done.split_off(done.len() - count);
        let value = match &circuit.expressions[id.0 as usize].kind {
            ExpressionKind::Bits(bits) => bits.iter().rev().map(|&bit| self.constant(bit)).collect(),
            ExpressionKind::Number { width, value } => self.number(*width, *value, frame, span)?,
            ExpressionKind::Computed { width, value } => {
                let value = self.size(*value, frame)?;
                let Ok(value) = u128::try_from(value) else {
                    self.fault(RangeError::NegativeConstant { value }.at(span));
                    return None;
                };
                self.number(*width, value, frame, span)?
            }
            ExpressionKind::Net(slot) => self.bits(*slot, None, frame)?,
            ExpressionKind::Slice { net, high, low } => self.bits(*net, Some((*high, *low)), frame)?,
            ExpressionKind::Concatenation(parts) => take(parts.len()).into_iter().rev().flatten().collect(),
            ExpressionKind::Repetition { count, .. } => self.repetition(*count, &take(1)[0], frame)?,
            ExpressionKind::Operation { operator, operands } => {
                self.operation(*operator, operands, take(operands.len()), span)?
            }
            ExpressionKind::Choice { condition, then, otherwise } => {
                self.choice([*condition, *then, *otherwise], take(3), span)?
            }
            ExpressionKind::Table { inputs, outputs, table } => {
                let values = take(outputs.len());
                let inputs: Vec<Bit> = take(inputs.len()).into_iter().rev().flatten().collect();
                let values = TableValues { expressions: outputs, bits: &values };
                self.table(&circuit.tables[*table], &inputs, values)?
            }
            ExpressionKind::Call { circuit, arguments, operands } => {
                let values = take(operands.len());
                return self.call(Call { callee: *circuit, arguments, operands, frame, span }, values, name);
            }
        };
        Some(vec![value])
    }

    /// The constant 0 or 1.
    pub(super) fn constant(&mut self, value: bool) -> Bit {
        if let Some(known) = self.constants[usize::from(value)] {
            return known;
        }
        let made = self.signal(ModuleSignal::Constant(value));
        self.constants[usize::from(value)] = Some(made);
        made
    }

    /// Whether a net is this constant.
    pub(super) fn is_constant(&self, bit: Bit, value: bool) -> bool {
        self.constants[usize::from(value)] == Some(bit)
    }

    fn signal(&mut self, signal: ModuleSignal) -> Bit {
        self.module.signals.push(signal);
        self.module.signals.len() as Bit - 1
    }

    pub(super) fn gate(&mut self, function: Function, pins: [Bit; 2], span: Span) -> Bit {
        self.signal(ModuleSignal::Gate { function, pins, span })
    }

    fn number(&mut self, width: SizeId, value: u128, frame: u32, span: Span) -> Option<Vec<Bit>> {
        let width = self.width(width, frame)?;
        if width < 128 && value >> width != 0 {
            self.fault(RangeError::ConstantWidth { value, width }.at(span));
            return None;
        }
        Some((0..width).map(|bit| self.constant(bit < 128 && value >> bit & 1 == 1)).collect())
    }

    fn bits(&mut self, slot: NetSlot, bits: Option<(SizeId, SizeId)>, frame: u32) -> Option<Vec<Bit>> {
        let net = self.net(slot, frame);
        let width = self.module.nets[net].width?;
        let first = self.module.nets[net].first;
        let (low, count) = match bits {
            Some(bits) => self.slice(bits, width, &self.module.nets[net].name.clone(), frame)?,
            None => (0, width),
        };
        Some((first + low..first + low + count).collect())
    }

    fn repetition(&mut self, count: SizeId, value: &[Bit], frame: u32) -> Option<Vec<Bit>> {
        let times = self.size(count, frame)?;
        if times < 0 || times.saturating_mul(value.len() as i64) > super::MAX_WIDTH {
            let span = self.circuit.sizes[count.0 as usize].span;
            self.fault(RangeError::Repetitions { times, most: super::MAX_WIDTH }.at(span));
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
            self.fault(WidthError::Operands { operator: operator.word(), first, second }.into());
            return None;
        }
        Some((0..width).map(|bit| self.operation_bit(operator, values.iter().map(|value| value[bit]), span)).collect())
    }

    /// One bit of an operation: of more than two operands, all but the last are combined without the final inversion.
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
            self.fault(WidthError::Wrong { what: Wide::Condition, expected: 1, found }.into());
            return None;
        }
        if then.len() != otherwise.len() {
            let (first, second) = (self.operand(parts[1], then), self.operand(parts[2], otherwise));
            self.fault(WidthError::Branches { first, second }.into());
            return None;
        }
        Some(
            then.iter()
                .zip(otherwise)
                .map(|(&then, &otherwise)| self.select(condition[0], then, otherwise, span))
                .collect(),
        )
    }

    /// `then` if the condition is 1, else `otherwise`.
    pub(super) fn select(&mut self, condition: Bit, then: Bit, otherwise: Bit, span: Span) -> Bit {
        let chosen = self.gate(Function::AND, [condition, then], span);
        let other = self.gate(Function::new(A_WITHOUT_B), [otherwise, condition], span);
        self.gate(Function::OR, [chosen, other], span)
    }

    /// Instantiates a circuit; `values` are the operands.
    fn call(&mut self, call: Call, values: Vec<Vec<Bit>>, name: Option<String>) -> Option<Vec<Vec<Bit>>> {
        let id = self.callee(&call, &values)?;
        let name = name.unwrap_or_else(|| {
            self.unnamed += 1;
            format!("{}_{}", self.builder.circuit(call.callee).name, self.unnamed)
        });
        let site = self.module.sites.len() as u32;
        self.module.sites.push(Site { module: id, inputs: values.concat(), name });
        let mut bits = 0..;
        let outputs = self.builder.module(id).outputs.clone();
        let mut output = |width| {
            bits.by_ref().take(width as usize).map(|bit| self.signal(ModuleSignal::Output { site, bit })).collect()
        };
        Some(outputs.into_iter().map(&mut output).collect())
    }

    /// A value with the name that advice calls it by.
    pub(super) fn operand(&self, id: ExpressionId, value: &[Bit]) -> OperandText {
        let kind = &self.circuit.expressions[id.0 as usize].kind;
        let net = match kind {
            ExpressionKind::Net(slot) => Some(self.circuit.nets[slot.0 as usize].name.clone()),
            _ => None,
        };
        let constant = match kind {
            ExpressionKind::Number { value, .. } => Some(*value),
            ExpressionKind::Bits(bits) if bits.len() == 1 => Some(u128::from(bits[0])),
            _ => None,
        };
        OperandText { width: value.len() as u32, span: self.span(id), net, constant }
    }

    /// The module of a called circuit, if its parameters and the widths of the operands fit.
    fn callee(&mut self, call: &Call, values: &[Vec<Bit>]) -> Option<ModuleId> {
        let mut arguments = Vec::new();
        for size in call.arguments {
            arguments.push(match size {
                Some(size) => Some(self.size(*size, call.frame)?),
                None => None,
            });
        }
        let widths: Vec<_> = values.iter().map(|value| Some(value.len() as u32)).collect();
        let known = self.builder.diagnostics.len();
        let arguments = self.builder.arguments(call.callee, arguments, &widths, call.span);
        let id = arguments.and_then(|arguments| self.builder.build(call.callee, arguments));
        self.builder.show_at(call.span, known);
        let id = id?;
        let inputs = self.builder.module(id).inputs.clone();
        for (port, (value, expected)) in values.iter().zip(inputs).enumerate() {
            if value.len() as u32 != expected {
                let found = self.operand(call.operands[port], value);
                let circuit = self.builder.circuit(call.callee);
                let what = Wide::Operand { port: circuit.nets[port].name.clone(), circuit: circuit.name.clone() };
                self.fault(WidthError::Wrong { what, expected, found }.into());
                return None;
            }
        }
        Some(id)
    }
}
