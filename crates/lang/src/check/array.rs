//! Bits of nets and words of arrays: those that integers select, and those that the values of nets select. An array in
//! an environment is a memory.

use crate::check::circuit::{Binding, CircuitChecker};
use crate::check::constant;
use crate::check::names::Home;
use crate::check::wording;
use crate::syntax::tree::{
    self, ExpressionSyntaxId, ExpressionSyntaxKind, Index, IndexKind, Infix, SizeSyntaxId, SizeSyntaxKind,
};
use nbc_base::model::{
    Block, CircuitId, ExpressionId, ExpressionKind, FreeNumber, MemoryArray, MemoryRead, MemoryWrite, NetSlot,
    Operator, Relation, SizeId, SizeKind, SizeOperator, Statement, Target,
};
use nbc_base::source::Span;

pub(crate) struct WrittenWord {
    net: NetSlot,
    index: Index,
    span: Span,
}

type SelectedPart = (Option<SizeId>, Option<(SizeId, SizeId)>);

const REGISTER: &str = "register";

impl CircuitChecker<'_> {
    fn is_array(&self, net: NetSlot) -> bool {
        self.circuit.nets[net.0 as usize].words.is_some() || self.memory_of(net).is_some()
    }

    fn memory_of(&self, net: NetSlot) -> Option<usize> {
        self.circuit.memories.iter().position(|memory| memory.net == net)
    }

    fn is_value(&self, index: &Index) -> bool {
        match index.kind {
            IndexKind::Value(_) => true,
            IndexKind::Slice(..) => false,
            IndexKind::One(size) => self.names_a_net(size),
        }
    }

    fn names_a_net(&self, size: SizeSyntaxId) -> bool {
        let sizes = &self.body.sizes;
        (super::size::first_leaf(sizes, size) as usize..=size.0 as usize).any(|at| match &sizes[at].kind {
            SizeSyntaxKind::Name(name) => matches!(self.lookup(name), Some(Binding::Net(_))),
            _ => false,
        })
    }

    pub(crate) fn constant_bits(&mut self, net: NetSlot, [first, second]: [Option<&Index>; 2]) -> Option<SelectedPart> {
        let name = self.circuit.nets[net.0 as usize].name.clone();
        let Some(first) = first else { return Some((None, None)) };
        if !self.is_array(net) {
            if let Some(second) = second {
                self.diagnostics.push(wording::no_array(&name, second.span));
                return None;
            }
            return Some((None, Some(self.bits_of(first)?)));
        }
        match first.kind {
            IndexKind::One(word) => {
                let word = self.size(word);
                Some((Some(word), self.second_bits(second)?))
            }
            _ => {
                self.diagnostics.push(wording::several_words(&name, first.span));
                None
            }
        }
    }

    fn second_bits(&mut self, second: Option<&Index>) -> Option<Option<(SizeId, SizeId)>> {
        second.map_or(Some(None), |second| self.bits_of(second).map(Some))
    }

    fn bits_of(&mut self, index: &Index) -> Option<(SizeId, SizeId)> {
        match index.kind {
            IndexKind::One(bit) => {
                let bit = self.size(bit);
                Some((bit, bit))
            }
            IndexKind::Slice(high, low) => {
                let high = self.size(high);
                Some((high, self.size(low)))
            }
            IndexKind::Value(_) => {
                self.diagnostics.push(wording::value_for_bits(index.span));
                None
            }
        }
    }

    /// The values in its brackets are the last of `done`.
    pub(crate) fn reference(
        &mut self,
        name: &tree::NameSyntax,
        indices: [Option<&Index>; 2],
        done: &mut Vec<ExpressionId>,
    ) -> ExpressionKind {
        let values = indices.into_iter().flatten().filter(|index| matches!(index.kind, IndexKind::Value(_))).count();
        let values = done.split_off(done.len() - values);
        let nothing = ExpressionKind::Bits(vec![false]);
        if indices == [None, None]
            && let Some(constant) = self.named_constant(name)
        {
            return constant;
        }
        let Some(net) = self.net(name) else { return nothing };
        let [Some(first), second] = indices else { return ExpressionKind::Net(net) };
        if !self.is_value(first) {
            if self.memory_of(net).is_some() {
                let index = self.value_of(first, values.first().copied());
                return index.and_then(|index| self.element(net, index, second)).unwrap_or(nothing);
            }
            let bits = self.constant_bits(net, indices);
            return bits.map_or(nothing, |(word, bits)| ExpressionKind::Slice { net, word, bits });
        }
        let index = self.value_of(first, values.first().copied());
        index.and_then(|index| self.element(net, index, second)).unwrap_or(nothing)
    }

    fn element(&mut self, net: NetSlot, index: ExpressionId, second: Option<&Index>) -> Option<ExpressionKind> {
        if let (Some(second), false) = (second, self.is_array(net)) {
            let name = self.circuit.nets[net.0 as usize].name.clone();
            self.diagnostics.push(wording::no_array(&name, second.span));
            return None;
        }
        let bits = self.second_bits(second)?;
        let Some(memory) = self.memory_of(net) else { return Some(ExpressionKind::Element { net, index, bits }) };
        let read = self.read(memory, index);
        Some(match bits {
            Some(bits) => ExpressionKind::Slice { net: read, word: None, bits: Some(bits) },
            None => ExpressionKind::Net(read),
        })
    }

    /// `value` is the expression in the brackets, unless they hold an integer.
    fn value_of(&mut self, index: &Index, value: Option<ExpressionId>) -> Option<ExpressionId> {
        match index.kind {
            IndexKind::Value(_) => value,
            IndexKind::One(size) => self.size_as_value(size),
            IndexKind::Slice(..) => {
                self.diagnostics.push(wording::value_for_bits(index.span));
                None
            }
        }
    }

    fn size_as_value(&mut self, root: SizeSyntaxId) -> Option<ExpressionId> {
        let body = self.body;
        let mut done: Vec<ExpressionId> = Vec::new();
        for at in super::size::first_leaf(&body.sizes, root) as usize..=root.0 as usize {
            let size = &body.sizes[at];
            let kind = match &size.kind {
                SizeSyntaxKind::Group(_) => continue,
                SizeSyntaxKind::Literal(digits) => {
                    ExpressionKind::Unsized(FreeNumber::Literal(constant::unsized_number(digits).unwrap_or(u128::MAX)))
                }
                SizeSyntaxKind::Name(name) => {
                    let name = tree::NameSyntax { text: name.clone(), span: size.span };
                    match self.named_constant(&name) {
                        Some(constant) => constant,
                        None => ExpressionKind::Net(self.net(&name)?),
                    }
                }
                SizeSyntaxKind::Binary(operator, ..) => {
                    let operands = done.split_off(done.len() - 2);
                    let infix = match operator {
                        SizeOperator::Add => Infix::Add,
                        SizeOperator::Subtract => Infix::Subtract,
                        SizeOperator::Multiply => Infix::Multiply,
                        _ => {
                            self.diagnostics.push(wording::operator_of_integers(operator.sign(), size.span));
                            return None;
                        }
                    };
                    self.infix(infix, size.span, operands)
                }
                SizeSyntaxKind::Log2(_) => {
                    self.diagnostics.push(wording::operator_of_integers("log2", size.span));
                    return None;
                }
            };
            let id = self.push(kind, size.span);
            done.push(id);
        }
        done.pop()
    }

    // ---- words that registers write ----

    pub(crate) fn written_word(&mut self, target: &tree::TargetSyntax) -> Option<WrittenWord> {
        let Some(Binding::Net(net)) = self.lookup(&target.name.text) else { return None };
        let index = target.index.filter(|index| self.is_array(net) && self.is_value(index))?;
        self.refer(target.name.span, Binding::Net(net));
        self.driven[net.0 as usize] = true;
        Some(WrittenWord { net, index, span: target.span })
    }

    /// `words[address] = register(d, clk, enable: e)`: each word is a register that is enabled at its own address.
    pub(crate) fn write_word(&mut self, written: WrittenWord, value: ExpressionSyntaxId) -> Option<Statement> {
        let first = self.circuit.nets.len() as u32;
        let array = self.circuit.nets[written.net.0 as usize].name.clone();
        let span = written.span;
        let root = self.expression(value, 1);
        let register =
            self.declared.names.circuits.find(REGISTER, Home::Prelude).expect("the prelude declares registers");
        let register = CircuitId(register as u32);
        let kind = self.circuit.expressions[root.0 as usize].kind.clone();
        let is_call = matches!(self.body.expressions[value.0 as usize].kind, ExpressionSyntaxKind::Call { .. });
        let found = match kind {
            ExpressionKind::Call { circuit, arguments, operands } if circuit == register && is_call => {
                match operands[..] {
                    [Some(data), Some(clk), enable, None] => Some((arguments, data, clk, enable)),
                    _ => None,
                }
            }
            _ => None,
        };
        let Some((arguments, data, clk, enable)) = found else {
            self.diagnostics.push(wording::no_register(&array, span));
            return None;
        };
        let address = match written.index.kind {
            IndexKind::Value(value) => self.expression(value, 1),
            IndexKind::One(size) => self.size_as_value(size)?,
            IndexKind::Slice(..) => return None,
        };
        let enable = enable.unwrap_or_else(|| self.push(ExpressionKind::Bits(vec![true]), span));
        let memory = self.memory_of(written.net);
        let (words, width) = self.shape(written.net, span);
        let places = self.log2(words, span);
        let one = self.one(span);
        let nets = [
            ("at", Some(places), address),
            ("data", width, data),
            ("write", Some(one), enable),
            ("clk", Some(one), clk),
        ];
        let nets = nets.map(|(part, width, value)| {
            let net = self.add_net(format!("{array}.{part}"), span, width);
            self.driven[net.0 as usize] = true;
            self.used[net.0 as usize] = true;
            (net, value)
        });
        self.circuit.nets[nets[0].0.0 as usize].selects = Some(written.net);
        let last = self.circuit.nets.len() as u32;
        let reads = std::mem::take(&mut self.reads).into_iter();
        let mut statements: Vec<Statement> = reads.chain(nets).map(|(net, value)| drive(net, value, span)).collect();
        let [(address, _), (data, _), (enable, _), (clk, _)] = nets;
        match memory {
            Some(memory) => {
                if arguments.iter().any(Option::is_some) {
                    self.diagnostics.push(wording::start_of_memory(&array, span));
                }
                self.circuit.memories[memory].writes.push(MemoryWrite { address, data, enable, clk });
            }
            None => {
                let variable = self.circuit.variables as u32;
                self.circuit.variables += 1;
                let from = self.push_size(SizeKind::Literal(0), span);
                let (to, _) = self.shape(written.net, span);
                let slot = self.push_size(SizeKind::Variable(variable), span);
                let value = self.register_of(register, arguments, [address, data, enable, clk], slot, span);
                let word = self.push_size(SizeKind::Variable(variable), span);
                let target = Target { net: Some(written.net), word: Some(word), bits: None, start: None, span };
                let drive = Statement::Drive { targets: vec![target], joined: false, value };
                let body = Block { nets: last..last, statements: vec![drive] };
                statements.push(Statement::For { variable, from, to, span, body });
            }
        }
        Some(Statement::Scope(Block { nets: first..last, statements }))
    }

    fn register_of(
        &mut self,
        circuit: CircuitId,
        arguments: Vec<Option<SizeId>>,
        [address, data, enable, clk]: [NetSlot; 4],
        place: SizeId,
        span: Span,
    ) -> ExpressionId {
        let data = self.push(ExpressionKind::Net(data), span);
        let clk = self.push(ExpressionKind::Net(clk), span);
        let address = self.push(ExpressionKind::Net(address), span);
        let place = self.push(ExpressionKind::Unsized(FreeNumber::Size(place)), span);
        let here = self.infix(Infix::Compare(Relation::Equal), span, vec![address, place]);
        let here = self.push(here, span);
        let enable = self.push(ExpressionKind::Net(enable), span);
        let both = ExpressionKind::Operation { operator: Operator::And, operands: vec![here, enable] };
        let both = self.push(both, span);
        let operands = vec![Some(data), Some(clk), Some(both), None];
        self.push(ExpressionKind::Call { circuit, arguments, operands }, span)
    }

    // ---- memories of environments ----

    pub(crate) fn memory(&mut self, net: NetSlot, port: &tree::Port) {
        let contents =
            port.contents.as_ref().and_then(|name| match self.declared.names.files.resolve(name, self.home) {
                Ok(file) => Some(file),
                Err(fault) => {
                    self.diagnostics.push(fault);
                    None
                }
            });
        let declared = &mut self.circuit.nets[net.0 as usize];
        let (Some(words), Some(width)) = (declared.words.take(), declared.width.take()) else { return };
        self.driven[net.0 as usize] = true;
        self.circuit.memories.push(MemoryArray { net, words, width, contents, reads: Vec::new(), writes: Vec::new() });
    }

    fn shape(&self, net: NetSlot, span: Span) -> (SizeId, Option<SizeId>) {
        let declared = &self.circuit.nets[net.0 as usize];
        match self.memory_of(net) {
            Some(memory) => (self.circuit.memories[memory].words, Some(self.circuit.memories[memory].width)),
            None => (declared.words.unwrap_or_else(|| unreachable!("{span:?} is of an array")), declared.width),
        }
    }

    /// The number of bits that select one of so many words: `log2(words + 1 / words)`, which is one bit for one word.
    fn log2(&mut self, words: SizeId, span: Span) -> SizeId {
        let first = self.copy_of_size(words);
        let one = self.one(span);
        let again = self.copy_of_size(words);
        let extra = self.push_size(SizeKind::Binary(SizeOperator::Divide, one, again), span);
        let places = self.push_size(SizeKind::Binary(SizeOperator::Add, first, extra), span);
        self.push_size(SizeKind::Log2(places), span)
    }

    fn read(&mut self, memory: usize, index: ExpressionId) -> NetSlot {
        let span = self.circuit.expressions[index.0 as usize].span;
        let name = self.circuit.nets[self.circuit.memories[memory].net.0 as usize].name.clone();
        let (words, width) = (self.circuit.memories[memory].words, self.circuit.memories[memory].width);
        let places = self.log2(words, span);
        let at = self.circuit.memories[memory].reads.len();
        let address = self.add_net(format!("{name}.at{at}"), span, Some(places));
        let data = self.add_net(format!("{name}.word{at}"), span, Some(width));
        self.circuit.nets[address.0 as usize].selects = Some(self.circuit.memories[memory].net);
        for net in [address, data] {
            self.driven[net.0 as usize] = true;
            self.used[net.0 as usize] = true;
        }
        self.circuit.memories[memory].reads.push(MemoryRead { address, data });
        self.reads.push((address, index));
        data
    }

    /// Adds the drivers of the addresses of memories that a statement reads; their nets begin at `first`.
    pub(crate) fn with_reads(&mut self, first: u32, statement: Option<Statement>) -> Option<Statement> {
        let reads = std::mem::take(&mut self.reads);
        let statement = statement?;
        let Some(&(_, value)) = reads.first() else { return Some(statement) };
        let span = self.circuit.expressions[value.0 as usize].span;
        let mut statements: Vec<Statement> = reads.into_iter().map(|(net, value)| drive(net, value, span)).collect();
        statements.push(statement);
        let last = self.circuit.nets.len() as u32;
        Some(Statement::Scope(Block { nets: first..last, statements }))
    }
}

fn drive(net: NetSlot, value: ExpressionId, span: Span) -> Statement {
    let target = Target { net: Some(net), word: None, bits: None, start: None, span };
    Statement::Drive { targets: vec![target], joined: false, value }
}
