//! Unrolls loops: one frame for each iteration, with its nets and statements.

use std::ops::Range;

use crate::elaborate::build::ModuleBuilder;
use crate::elaborate::module::{Item, ModuleNet, Scope};
use crate::elaborate::size;
use crate::elaborate::wording;
use nbc_base::budget::Limit;
use nbc_base::model::{Block, NetSlot, Size, SizeId, SizeKind, Statement};
use nbc_base::source::Span;

impl<'a> ModuleBuilder<'a, '_> {
    pub(super) fn unroll(&mut self, variables: Vec<i128>) {
        let body = &self.circuit.body;
        if let Some(root) = self.open_frame(None, body, variables, String::new()) {
            self.unroll_block(root, body);
        }
    }

    fn open_frame(&mut self, parent: Option<u32>, block: &Block, variables: Vec<i128>, turn: String) -> Option<u32> {
        let first_net = self.module.nets.len() as u32;
        let nets = &self.circuit.nets[block.nets.start as usize..block.nets.end as usize];
        let names: usize = nets.iter().map(|net| net.name.len() + turn.len()).sum();
        self.take(Limit::Statements, 1)?;
        self.take(Limit::Steps, variables.len() as u64)?;
        self.take(Limit::Nets, nets.len() as u64)?;
        self.take(Limit::NetNameBytes, (names + turn.len()) as u64)?;
        for net in nets {
            let name = if parent.is_none() { net.name.clone() } else { format!("{}{turn}", net.name) };
            self.module.nets.push(ModuleNet { name, span: net.span, width: None, words: None, first: 0 });
        }
        self.frames.push(Scope {
            parent,
            first_slot: block.nets.start,
            first_net,
            nets: block.nets.len() as u32,
            variables,
            turn,
        });
        Some(self.frames.len() as u32 - 1)
    }

    fn unroll_block(&mut self, frame: u32, block: &'a Block) {
        for statement in &block.statements {
            if let Statement::Let { variable, value } = statement {
                match self.size(*value, frame) {
                    Some(value) => set_variable(&mut self.frames[frame as usize].variables, *variable, value),
                    None => self.failed = true,
                }
            }
        }
        for statement in &block.statements {
            match statement {
                Statement::Let { .. } => {}
                Statement::Drive { targets, joined, value } => {
                    if self.take(Limit::Statements, 1).is_none() {
                        return;
                    }
                    self.items.push(Item { frame, targets, joined: *joined, value: *value });
                }
                Statement::If { condition, then, otherwise } => {
                    let (left, right) = (self.size(condition.left, frame), self.size(condition.right, frame));
                    let (Some(left), Some(right)) = (left, right) else {
                        self.failed = true;
                        return;
                    };
                    let block = if condition.comparison.holds(&left, &right) { then } else { otherwise };
                    self.unroll_inside(frame, block);
                }
                Statement::Scope(block) => self.unroll_inside(frame, block),
                Statement::For { variable, from, to, span, body } => {
                    self.unroll_loop(frame, *variable, (*from, *to), *span, body)
                }
            }
            if self.failed {
                return;
            }
        }
    }

    fn unroll_inside(&mut self, frame: u32, block: &'a Block) {
        let Scope { variables, turn, .. } = &self.frames[frame as usize];
        let (variables, turn) = (variables.clone(), turn.clone());
        if let Some(inner) = self.open_frame(Some(frame), block, variables, turn) {
            self.unroll_block(inner, block);
        }
    }

    fn unroll_loop(&mut self, frame: u32, variable: u32, range: (SizeId, SizeId), span: Span, body: &'a Block) {
        let (Some(from), Some(to)) = (self.size(range.0, frame), self.size(range.1, frame)) else {
            self.failed = true;
            return;
        };
        let sizes = &self.circuit.sizes;
        let is_fixed = |end: SizeId| {
            let parts = Size::first_part(sizes, end).0..=end.0;
            parts.into_iter().all(|at| !matches!(sizes[at as usize].kind, SizeKind::Variable(_)))
        };
        if from > to && is_fixed(range.1) {
            let is_literal =
                [range.0, range.1].iter().all(|end| matches!(sizes[end.0 as usize].kind, SizeKind::Literal(_)));
            self.fault(wording::descending_loop([from, to], is_literal, span));
            return;
        }
        let turns = u64::try_from(to.saturating_sub(from).max(0)).unwrap_or(u64::MAX);
        let statements = turns.saturating_mul(body.statements.len() as u64 + 1);
        if Limit::Statements.permit(statements).is_err() {
            self.fault(wording::too_many_turns(statements, span));
            return;
        }
        for value in from..to {
            let mut variables = self.frames[frame as usize].variables.clone();
            set_variable(&mut variables, variable, value);
            let turn = format!("{}.{value}", self.frames[frame as usize].turn);
            if let Some(inner) = self.open_frame(Some(frame), body, variables, turn) {
                self.unroll_block(inner, body);
            }
            if self.failed {
                return;
            }
        }
    }

    pub(super) fn net(&self, slot: NetSlot, frame: u32) -> usize {
        let mut frame = &self.frames[frame as usize];
        loop {
            if (frame.first_slot..frame.first_slot + frame.nets).contains(&slot.0) {
                return (frame.first_net + slot.0 - frame.first_slot) as usize;
            }
            let parent = frame.parent.expect("every net belongs to a block around its use");
            frame = &self.frames[parent as usize];
        }
    }

    pub(super) fn size(&mut self, size: SizeId, frame: u32) -> Option<i128> {
        let first = Size::first_part(&self.circuit.sizes, size);
        self.take(Limit::Steps, u64::from(size.0 - first.0))?;
        let value = size::value(&self.circuit.sizes, size, &self.frames[frame as usize].variables);
        value.map_err(|fault| self.fault(fault)).ok()
    }

    pub(super) fn unsigned(&mut self, size: SizeId, frame: u32, span: Span) -> Option<u128> {
        let value = self.size(size, frame)?;
        let unsigned = u128::try_from(value).ok();
        if unsigned.is_none() {
            self.fault(wording::negative_constant(value, span));
        }
        unsigned
    }

    pub(super) fn width(&mut self, size: SizeId, frame: u32) -> Option<u32> {
        let value = self.size(size, frame)?;
        let width = u32::try_from(value).ok();
        let width = width.filter(|&width| width >= 1 && Limit::Width.permit(width.into()).is_ok());
        if width.is_none() {
            self.fault(wording::net_width(value, self.circuit.sizes[size.0 as usize].span));
        }
        width
    }

    pub(super) fn slice(&mut self, bits: (SizeId, SizeId), width: u32, name: &str, frame: u32) -> Option<Range<u32>> {
        let (high, low) = (self.size(bits.0, frame)?, self.size(bits.1, frame)?);
        let ends = [bits.0, bits.1].map(|end| self.circuit.sizes[end.0 as usize]);
        let span = ends[0].span.to(ends[1].span);
        if high < low {
            let is_literal = ends.iter().all(|end| matches!(end.kind, SizeKind::Literal(_)));
            self.fault(wording::ascending_slice(name, [high, low], is_literal, span));
            return None;
        }
        if low < 0 || high >= i128::from(width) {
            let bit = if low < 0 { low } else { high };
            self.fault(wording::no_such_bit(name, bit, width, span));
            return None;
        }
        Some(low as u32..high as u32 + 1)
    }
}

fn set_variable(variables: &mut Vec<i128>, slot: u32, value: i128) {
    let slot = slot as usize;
    variables.resize(variables.len().max(slot + 1), 0);
    variables[slot] = value;
}
