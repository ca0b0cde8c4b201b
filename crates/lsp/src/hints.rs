//! Hints inside the text: widths, names of ports in calls, robots.

use gen_lsp_types::{InlayHint, InlayHintKind};

use crate::figures::Subject;
use crate::files::Files;
use crate::settings::HintSettings;
use nbc_base::model::{Circuit, Net};
use nbc_base::source::{FileId, Span};
use nbc_lang::check::NameKind;
use nbc_lang::syntax::tree::{
    BodySyntax, DeclarationKind, ExpressionSyntax, ExpressionSyntaxKind, OperandSyntax, TestKind,
};

/// The hints that need nothing compiled.
pub(super) fn of(files: &Files<'_>, file: FileId, part: Span, settings: HintSettings) -> Vec<InlayHint> {
    let mut hints = Vec::new();
    if settings.widths {
        hints.extend(widths(files, file, part));
    }
    if settings.parameters {
        hints.extend(operands(files, file, part));
    }
    hints
}

pub(super) fn robots(files: &Files<'_>, circuit: &Circuit, summary: &str) -> InlayHint {
    let text = &files.checked.sources.file(circuit.span.file).text[circuit.span.end as usize..];
    let ports = text.find('{').map_or(0, |brace| text[..brace].trim_end().len());
    let at = circuit.span.end + ports as u32;
    InlayHint { padding_left: Some(true), ..hint(files, circuit.span, at, summary, InlayHintKind::Type) }
}

pub(super) fn circuits<'a>(
    files: &Files<'a>,
    file: FileId,
    part: Span,
) -> impl Iterator<Item = (&'a Circuit, Subject)> + use<'a> {
    let checked = files.checked;
    let own = checked.program.circuits.iter().filter(move |circuit| is_in(circuit.span, file, part));
    own.filter_map(move |circuit| Some((circuit, Subject::Circuit(checked.in_use(circuit)?, None))))
}

fn is_in(place: Span, file: FileId, part: Span) -> bool {
    place.file == file && part.start <= place.end && place.start <= part.end
}

fn widths(files: &Files<'_>, file: FileId, part: Span) -> Vec<InlayHint> {
    let text = &files.checked.sources.file(file).text;
    let declared = files.checked.uses.of_file(file).filter(|found| {
        let is_first = found.kind == NameKind::Net && found.place == found.declared && is_in(found.place, file, part);
        is_first && !text[found.place.end as usize..].starts_with('[')
    });
    let width = |place: Span| match &files.checked.widths.of(place).collect::<Vec<_>>()[..] {
        [width] if *width != 1 => Some(*width),
        _ => None,
    };
    let hint = |place: Span| Some(hint(files, place, place.end, &format!("[{}]", width(place)?), InlayHintKind::Type));
    declared.filter_map(|found| hint(found.place)).collect()
}

fn operands(files: &Files<'_>, file: FileId, part: Span) -> Vec<InlayHint> {
    let declarations = files.checked.tree(file).into_iter().flat_map(|tree| &tree.declarations);
    let bodies = declarations.filter(|declaration| is_in(declaration.span, file, part)).filter_map(|declaration| {
        match &declaration.kind {
            DeclarationKind::Circuit(circuit) => Some(&circuit.body),
            DeclarationKind::Prove(claim) => Some(&claim.body),
            DeclarationKind::Test(test) => match &test.kind {
                TestKind::Reference(body) => Some(&**body),
                _ => None,
            },
            _ => None,
        }
    });
    let calls = bodies.flat_map(|body| body.expressions.iter().map(move |expression| (body, expression)));
    calls.filter(|(_, call)| is_in(call.span, file, part)).flat_map(|(body, call)| of_call(files, body, call)).collect()
}

/// An operand that is named like its port gets none, nor does a single operand.
fn of_call(files: &Files<'_>, body: &BodySyntax, call: &ExpressionSyntax) -> Vec<InlayHint> {
    let ExpressionSyntaxKind::Call { name, operands, .. } = &call.kind else { return Vec::new() };
    let checked = files.checked;
    let declared = checked.uses.at(name.span.file, name.span.start as usize).map(|found| found.declared);
    let circuit = checked.program.circuits.iter().find(|circuit| Some(circuit.span) == declared);
    let Some(circuit) = circuit.filter(|_| operands.len() > 1) else { return Vec::new() };
    let pairs = circuit.nets[..circuit.inputs].iter().zip(operands);
    let hint = |(port, operand): (&Net, &OperandSyntax)| {
        if operand.name.is_some() {
            return None;
        }
        let place = body.expressions[operand.value.0 as usize].span;
        let text = checked.sources.text(place);
        let is_clear = text == port.name;
        (!is_clear).then(|| InlayHint {
            padding_right: Some(true),
            ..hint(files, place, place.start, &format!("{}:", port.name), InlayHintKind::Parameter)
        })
    };
    pairs.filter_map(hint).collect()
}

fn hint(files: &Files<'_>, place: Span, at: u32, label: &str, kind: InlayHintKind) -> InlayHint {
    InlayHint {
        position: files.lines(place.file).position(at as usize),
        label: label.into(),
        kind: Some(kind),
        text_edits: None,
        tooltip: None,
        padding_left: None,
        padding_right: None,
        data: None,
    }
}
