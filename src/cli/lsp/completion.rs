//! What may be written at a place: words of the language, declared names, and calls of circuits.

use std::collections::BTreeMap;

use gen_lsp_types::{CompletionItem, CompletionItemKind, InsertTextFormat};

use crate::check::NameKind;
use crate::cli::lsp::files::Files;
use crate::source::{FileId, Span};
use crate::syntax::tree::{DeclarationKind, Tree};

/// Words that begin a declaration.
const DECLARATIONS: [&str; 10] =
    ["circuit", "evolution", "library", "material", "schedule", "simulate", "stimulus", "swarm", "test", "use"];

/// Words inside a circuit.
const EXPRESSIONS: [&str; 15] =
    ["and", "else", "for", "if", "in", "init", "nand", "net", "nor", "not", "or", "table", "then", "xnor", "xor"];

/// The completions at a byte of a file.
pub(super) fn items(files: &Files<'_>, file: FileId, tree: &Tree, offset: usize) -> Vec<CompletionItem> {
    let covers = |span: Span| span.file == file && (span.start as usize..=span.end as usize).contains(&offset);
    let around = tree.declarations.iter().find(|declaration| covers(declaration.span));
    let Some(around) = around else {
        return DECLARATIONS.iter().map(|word| item(word, CompletionItemKind::Keyword, "keyword")).collect();
    };
    match &around.kind {
        DeclarationKind::Circuit(_) | DeclarationKind::Test(_) => {
            let mut items = inside(files, around.span);
            items.extend(EXPRESSIONS.iter().map(|word| item(word, CompletionItemKind::Keyword, "keyword")));
            items.extend(circuits(files));
            items
        }
        _ => names(files, |kind| !matches!(kind, NameKind::Net | NameKind::Number)),
    }
}

/// The nets and numbers that a declaration uses or declares.
fn inside(files: &Files<'_>, span: Span) -> Vec<CompletionItem> {
    let within = |place: Span| place.file == span.file && span.start <= place.start && place.end <= span.end;
    let used = files.checked.uses.of_file(span.file).filter(|found| within(found.place));
    let inner = used.filter(|found| matches!(found.kind, NameKind::Net | NameKind::Number));
    let named: BTreeMap<&str, NameKind> =
        inner.map(|found| (files.checked.sources.text(found.place), found.kind)).collect();
    named.into_iter().map(|(name, kind)| item(name, CompletionItemKind::Variable, kind.word())).collect()
}

/// Calls of the circuits, with their operands to be filled in.
fn circuits(files: &Files<'_>) -> Vec<CompletionItem> {
    let call = |circuit: &crate::model::Circuit| {
        let inputs = circuit.nets[..circuit.inputs].iter().map(|net| net.name.as_str());
        let (first, last) = (circuit.inputs, circuit.inputs + circuit.outputs);
        let outputs: Vec<&str> = circuit.nets[first..last].iter().map(|net| net.name.as_str()).collect();
        let detail = format!("({}) -> ({})", inputs.clone().collect::<Vec<_>>().join(", "), outputs.join(", "));
        let operands: Vec<_> = inputs.zip(1..).map(|(name, at)| format!("${{{at}:{name}}}")).collect();
        CompletionItem {
            insert_text: Some(format!("{}({})", circuit.name, operands.join(", "))),
            insert_text_format: Some(InsertTextFormat::Snippet),
            ..item(&circuit.name, CompletionItemKind::Function, &detail)
        }
    };
    files.checked.program.circuits.iter().filter(|circuit| !circuit.name.contains('.')).map(call).collect()
}

/// The declared names of some kinds.
fn names(files: &Files<'_>, wanted: impl Fn(NameKind) -> bool) -> Vec<CompletionItem> {
    let all = files.checked.sources.iter().flat_map(|source| files.checked.uses.of_file(source.id));
    let declared = all.filter(|found| found.place == found.declared && wanted(found.kind));
    let named: BTreeMap<&str, NameKind> =
        declared.map(|found| (files.checked.sources.text(found.place), found.kind)).collect();
    named.into_iter().map(|(name, kind)| item(name, CompletionItemKind::Reference, kind.word())).collect()
}

fn item(label: &str, kind: CompletionItemKind, detail: &str) -> CompletionItem {
    CompletionItem {
        label: label.to_owned(),
        kind: Some(kind),
        detail: Some(detail.to_owned()),
        ..CompletionItem::default()
    }
}
