//! The declarations of a file, as an outline and as ranges to fold.

use gen_lsp_types::{DocumentSymbol, FoldingRange, FoldingRangeKind, SymbolKind};

use crate::position::Lines;
use nbc_base::source::Span;
use nbc_lang::syntax::tree::{CircuitSyntax, Declaration, DeclarationKind, NameSyntax, RecordKeyword, Tree};

pub(super) fn symbols(tree: &Tree, lines: &Lines<'_>) -> Vec<DocumentSymbol> {
    tree.declarations.iter().flat_map(|declaration| symbols_of(declaration, lines)).collect()
}

fn symbols_of(declaration: &Declaration, lines: &Lines<'_>) -> Vec<DocumentSymbol> {
    let span = declaration.span;
    let one = |name: &NameSyntax, kind, detail: &str| vec![symbol(name, kind, detail, span, lines)];
    match &declaration.kind {
        DeclarationKind::Use(_) => Vec::new(),
        DeclarationKind::Stimulus(stimuli) => {
            let names = stimuli.iter().map(|stimulus| &stimulus.name);
            names.map(|name| symbol(name, SymbolKind::Event, "stimulus", name.span, lines)).collect()
        }
        DeclarationKind::Record(record) => {
            let kind = match record.keyword {
                RecordKeyword::Material => SymbolKind::Constant,
                RecordKeyword::Evolution => SymbolKind::Class,
                RecordKeyword::Images => SymbolKind::Array,
                RecordKeyword::Library => SymbolKind::Package,
                RecordKeyword::Swarm => SymbolKind::Object,
                RecordKeyword::World => SymbolKind::Namespace,
            };
            one(&record.name, kind, record.keyword.word())
        }
        DeclarationKind::Schedule(schedule) => one(&schedule.name, SymbolKind::Array, "schedule"),
        DeclarationKind::Simulate(simulate) => one(&simulate.swarm, SymbolKind::Method, "simulate"),
        DeclarationKind::Circuit(circuit) => {
            let word = if circuit.is_environment { "environment" } else { "circuit" };
            let symbol = symbol(&circuit.name, SymbolKind::Function, word, span, lines);
            vec![DocumentSymbol { children: Some(ports(circuit, lines)), ..symbol }]
        }
        DeclarationKind::Enumeration(enumeration) => {
            let member = |name: &NameSyntax| symbol(name, SymbolKind::EnumMember, "member", name.span, lines);
            let members = enumeration.members.iter().map(|one| member(&one.name)).collect();
            let symbol = symbol(&enumeration.name, SymbolKind::Enum, "enum", span, lines);
            vec![DocumentSymbol { children: Some(members), ..symbol }]
        }
        DeclarationKind::Let(integer) => one(&integer.name, SymbolKind::Constant, "integer"),
        DeclarationKind::File(file) => one(&file.name, SymbolKind::File, "file"),
        DeclarationKind::Prove(claim) => {
            let title = claim.title.as_ref().map_or("prove", |title| title.text.as_str());
            one(&claim.circuit.name, SymbolKind::Method, title)
        }
        DeclarationKind::Test(test) => {
            let title = test.title.as_ref().map_or("test", |title| title.text.as_str());
            one(&test.circuit.name, SymbolKind::Method, title)
        }
    }
}

fn ports(circuit: &CircuitSyntax, lines: &Lines<'_>) -> Vec<DocumentSymbol> {
    let inputs = circuit.inputs.iter().map(|port| (port, "input"));
    let outputs = circuit.outputs.iter().map(|port| (port, "output"));
    inputs
        .chain(outputs)
        .map(|(port, kind)| symbol(&port.name, SymbolKind::Variable, kind, port.name.span, lines))
        .collect()
}

fn symbol(name: &NameSyntax, kind: SymbolKind, detail: &str, span: Span, lines: &Lines<'_>) -> DocumentSymbol {
    #[expect(deprecated, reason = "the structure has this field, which nobody sets")]
    DocumentSymbol {
        name: name.text.clone(),
        detail: Some(detail.to_owned()),
        kind,
        range: lines.range(span.range()),
        selection_range: lines.range(name.span.range()),
        tags: None,
        deprecated: None,
        children: None,
    }
}

pub(super) fn folds(tree: &Tree, lines: &Lines<'_>) -> Vec<FoldingRange> {
    let of = |span: &Span| {
        let range = lines.range(span.range());
        (range.start.line, range.end.line)
    };
    let mut folds: Vec<_> =
        tree.declarations.iter().map(|declaration| (of(&declaration.span), FoldingRangeKind::Region)).collect();
    let mut comments: Vec<(u32, u32)> = Vec::new();
    for (start, end) in tree.comments.iter().map(of) {
        match comments.last_mut().filter(|last| last.1 + 1 == start) {
            Some(last) => last.1 = end,
            None => comments.push((start, end)),
        }
    }
    folds.extend(comments.into_iter().map(|lines| (lines, FoldingRangeKind::Comment)));
    folds.retain(|((start, end), _)| start < end);
    let fold = |((start_line, end_line), kind)| FoldingRange {
        start_line,
        end_line,
        kind: Some(kind),
        start_character: None,
        end_character: None,
        collapsed_text: None,
    };
    folds.into_iter().map(fold).collect()
}
