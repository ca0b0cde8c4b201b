//! Properties of circuits.

use crate::syntax::format::circuit::places;
use crate::syntax::format::expression::{Written, expression};
use crate::syntax::format::layout::{LayoutPiece, layout};
use crate::syntax::format::printer::Printer;
use crate::syntax::format::record::instance;
use crate::syntax::tree::Prove;
use nbc_base::source::Span;

impl Printer<'_> {
    pub(super) fn prove(&mut self, prove: &Prove, span: Span) {
        self.write(&format!("prove {} ", instance(&prove.circuit)));
        if let Some(title) = &prove.title {
            self.write(&format!("\"{}\" ", title.text));
        }
        if let Some(environment) = &prove.environment {
            self.write(&format!("with {} ", environment.text));
        }
        let width = prove.properties.iter().map(|property| property.kind.word().len()).max().unwrap_or(0);
        self.block(span.end, |printer| {
            for property in &prove.properties {
                let (source, comments) = printer.source();
                let written = Written { body: &prove.body, source, comments };
                let mut pieces = Vec::new();
                if let Some(condition) = property.condition {
                    pieces.extend(expression(written, condition));
                    pieces.push(LayoutPiece::Text(" => ".to_owned()));
                }
                pieces.extend(expression(written, property.value));
                if let Some(steps) = &property.within {
                    let word = if steps.text == "1" { "step" } else { "steps" };
                    pieces.push(LayoutPiece::Text(format!(" within {} {word}", steps.text)));
                }
                printer.place(places(&pieces));
                printer.item(property.span, |printer| {
                    printer.write(&format!("{:width$} ", property.kind.word()));
                    let text = layout(&pieces, printer.column(), printer.indent);
                    printer.write(&text);
                });
            }
        });
    }
}
