//! Start values of nets that are driven by a circuit with a start value of its own.

use crate::check::circuit::{CircuitChecker, Header};
use crate::check::wording;
use crate::syntax::tree::{self, ExpressionSyntaxId, ExpressionSyntaxKind, SizeSyntaxId, SizeSyntaxKind};
use nbc_base::diag::Diagnostic;
use nbc_base::source::Span;

const START: &str = "start";

impl CircuitChecker<'_> {
    /// The error of `q init 1 = register(…)`: the register starts with its own value, whatever `q` starts with.
    pub(crate) fn start_fault(&self, targets: &[tree::TargetSyntax], value: ExpressionSyntaxId) -> Option<Diagnostic> {
        let target = targets.iter().find(|target| target.start.is_some())?;
        let (name, arguments) = self.called(value)?;
        let header = &self.headers.circuits[self.declared.names.circuits.find(&name.text, self.home)?];
        let place = header.parameters.iter().position(|parameter| parameter == START)?;
        let start = self.size_text(target.start?);
        let is_whole = targets.len() == 1 && target.index.is_none();
        let edit = start.filter(|_| is_whole).map(|start| {
            let init = Span { start: target.name.span.end, ..target.span };
            (init, argument_edit(name, header, place, arguments, start))
        });
        Some(wording::start_of_call(&target.name.text, &name.text, start, edit, target.span))
    }

    fn called(&self, mut value: ExpressionSyntaxId) -> Option<(&tree::NameSyntax, &[tree::Argument])> {
        loop {
            match &self.body.expressions[value.0 as usize].kind {
                ExpressionSyntaxKind::Group(inner) => value = *inner,
                ExpressionSyntaxKind::Call { name, arguments, .. } => return Some((name, arguments)),
                _ => return None,
            }
        }
    }

    fn size_text(&self, size: SizeSyntaxId) -> Option<&str> {
        match &self.body.sizes[size.0 as usize].kind {
            SizeSyntaxKind::Literal(text) | SizeSyntaxKind::Name(text) => Some(text),
            _ => None,
        }
    }
}

fn argument_edit(
    name: &tree::NameSyntax,
    header: &Header,
    place: usize,
    arguments: &[tree::Argument],
    start: &str,
) -> Option<(Span, String)> {
    let is_start = |(at, argument): (usize, &tree::Argument)| match &argument.name {
        Some(name) => name.text == header.parameters[place],
        None => at == place,
    };
    if arguments.iter().enumerate().any(is_start) {
        return None;
    }
    let (before, text) = match arguments.last() {
        Some(last) => (last.span, format!(", {START} = {start}")),
        None => (name.span, format!("[{START} = {start}]")),
    };
    Some((Span { start: before.end, ..before }, text))
}
