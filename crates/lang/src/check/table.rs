//! Truth tables: their patterns and outputs as written.

use crate::check::circuit::CircuitChecker;
use crate::check::constant;
use crate::syntax::tree;
use nbc_base::diag::Suggestion;
use nbc_base::model::{ExpressionId, OutputValue, Table, TableOutput, TablePattern, TableRow};
use nbc_base::source::Span;
use nbc_circuit::elaborate::{not_a_pattern, table_fault, two_else};

impl CircuitChecker<'_> {
    /// `values` are the outputs that are expressions.
    pub(crate) fn table(&mut self, rows: &[tree::TableRowSyntax], values: &[ExpressionId], span: Span) -> Table {
        let mut table = Table { rows: Vec::new(), otherwise: None, span };
        let mut values = values.iter().enumerate();
        for row in rows {
            let output = match &row.output {
                tree::TableOutputSyntax::Bits(word) => {
                    let Some(value) = self.output_value(word) else { continue };
                    TableOutput { value, span: word.span }
                }
                tree::TableOutputSyntax::Value(_) => {
                    let (index, value) = values.next().expect("every expression has its value");
                    let span = self.circuit.expressions[value.0 as usize].span;
                    TableOutput { value: OutputValue::Expression(index), span }
                }
            };
            for word in &row.patterns {
                let row = |pattern| TableRow { pattern, span: word.span, output: output.clone() };
                table.rows.extend(self.pattern(word).map(row));
            }
            if row.patterns.is_empty() {
                self.otherwise(&mut table, output, row.span);
            }
        }
        if !table.is_in_bits() {
            for row in &mut table.rows {
                if let Some(value) = row.pattern.digit() {
                    row.pattern = TablePattern::Number(value);
                }
            }
        } else {
            self.diagnostics.extend(table_fault(&table));
        }
        table
    }

    fn otherwise(&mut self, table: &mut Table, output: TableOutput, span: Span) {
        match &table.otherwise {
            Some(first) => self.diagnostics.push(two_else(first.span, span)),
            None => table.otherwise = Some(output),
        }
    }

    fn pattern(&mut self, word: &tree::NameSyntax) -> Option<TablePattern> {
        let declared = self.declared;
        if let Some((place, member)) = declared.member(&word.text, self.home) {
            declared.names.members.refer_to(&word.text, word.span, self.home);
            let bits = declared.all[place].bits(member.value);
            return Some(TablePattern::Bits(bits.into_iter().map(Some).collect()));
        }
        if let Some(bits) = constant::pattern(&word.text) {
            return Some(TablePattern::Bits(bits));
        }
        if let Some(value) = constant::unsized_number(&word.text) {
            return Some(TablePattern::Number(value));
        }
        let meant = Suggestion::of(&word.text, declared.names.members.all());
        self.diagnostics.push(not_a_pattern(&word.text, &meant, word.span));
        None
    }

    /// Bits, or a number as wide as the other outputs; a single digit is both.
    fn output_value(&mut self, word: &tree::NameSyntax) -> Option<OutputValue> {
        match (constant::pattern(&word.text), constant::unsized_number(&word.text)) {
            (Some(bits), _) if bits.len() != 1 || bits[0].is_none() => Some(OutputValue::Bits(bits)),
            (_, Some(value)) => Some(OutputValue::Number(value)),
            _ => {
                self.diagnostics.push(not_a_pattern(&word.text, &Suggestion::None, word.span));
                None
            }
        }
    }
}
