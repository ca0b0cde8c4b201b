//! Completions at a place: words of the language, declared names, fields, units, and calls of circuits.

mod item;
mod paths;
mod place;

use std::collections::BTreeMap;

use gen_lsp_types::{CompletionItem, CompletionItemKind, InsertTextFormat, MarkupContent, MarkupKind};

use crate::files::Files;
use crate::interface::Interface;
use crate::spot::Spot;
use nbc_base::model::Function;
use nbc_circuit::formats::is_word;
use nbc_lang::check::{Holds, NameKind, record_fields};
use nbc_lang::syntax::{KEYWORDS, Token, TokenKind};

use item::item;
use paths::PathKind;
use place::{Before, Place};

const INFIXES: [&str; 9] = ["and", "else", "init", "nand", "nor", "or", "then", "xnor", "xor"];

const PREFIXES: [&str; 9] = ["and", "if", "nand", "nor", "not", "or", "table", "xnor", "xor"];

const UNITS: [&str; 5] = ["cycles", "deg", "ms", "s", "steps"];

pub(super) const TRIGGERS: [&str; 5] = [":", "[", "(", "\"", "/"];

const TRIGGERS_IN_PATHS: [&str; 2] = ["\"", "/"];

/// `typed` is the trigger, unless the user asked.
pub(super) fn items(spot: &Spot<'_>, typed: Option<&str>) -> Vec<CompletionItem> {
    let tokens = spot.tokens();
    if let Some(quoted) = tokens.iter().find(|token| is_inside(token, spot)) {
        return path(spot, &tokens, quoted.range.start);
    }
    if is_comment(&tokens, spot.offset) || typed.is_some_and(|sign| TRIGGERS_IN_PATHS.contains(&sign)) {
        return Vec::new();
    }
    let before = Before::of(spot.text(), &tokens, spot.offset);
    let files = &spot.files;
    match before.place(spot.offset) {
        Place::NewName | Place::UsedFile => Vec::new(),
        Place::Outside => words(&KEYWORDS),
        Place::Unit => words(&UNITS),
        Place::Row => words(&["for"]),
        Place::Field(record) => record_fields(record).iter().map(|known| field(known.name)).collect(),
        Place::Value(keyword, field) => values(files, keyword, field),
        Place::Statement => [words(&["for", "net"]), nets(&before, files, NameKind::Net)].concat(),
        Place::Operand => [nets(&before, files, NameKind::Net), circuits(files), words(&PREFIXES)].concat(),
        Place::Infix => words(&INFIXES),
        Place::Size => [nets(&before, files, NameKind::Number), words(&["log2"])].concat(),
        Place::Name(kind) => names(files, kind),
        Place::Columns(name) => columns(files, name),
        Place::Schedule => [names(files, NameKind::Schedule), words(&["schedule"])].concat(),
    }
}

/// The second quote may be missing.
fn is_inside(token: &Token, spot: &Spot<'_>) -> bool {
    let text = &spot.text()[token.range.clone()];
    let is_closed = text.len() > 1 && text.ends_with('"');
    let end = token.range.end - usize::from(is_closed);
    token.kind == TokenKind::Quoted && (token.range.start + 1..=end).contains(&spot.offset)
}

fn is_comment(tokens: &[Token], offset: usize) -> bool {
    tokens
        .iter()
        .any(|token| token.kind == TokenKind::Comment && (token.range.start..=token.range.end).contains(&offset))
}

fn path(spot: &Spot<'_>, tokens: &[Token], quote: usize) -> Vec<CompletionItem> {
    match Before::of(spot.text(), tokens, quote).place(quote) {
        Place::UsedFile => paths::items(spot, quote + 1, PathKind::Source),
        Place::Value("library", "from") => paths::items(spot, quote + 1, PathKind::Folder),
        _ => Vec::new(),
    }
}

fn words(list: &[&str]) -> Vec<CompletionItem> {
    list.iter().map(|word| item(word, CompletionItemKind::Keyword, "keyword")).collect()
}

fn field(name: &str) -> CompletionItem {
    let insert_text = Some(format!("{name}: "));
    CompletionItem { insert_text, ..item(name, CompletionItemKind::Field, "field") }
}

fn values(files: &Files<'_>, keyword: &str, field: &str) -> Vec<CompletionItem> {
    let choices = |list: &[&str]| -> Vec<CompletionItem> {
        list.iter().map(|word| item(word, CompletionItemKind::EnumMember, field)).collect()
    };
    match record_fields(keyword).iter().find(|known| known.name == field).map(|known| known.holds) {
        None | Some(Holds::Value | Holds::Record(_)) => Vec::new(),
        Some(Holds::Word(list)) => choices(list),
        Some(Holds::Name(kind)) => names(files, kind),
        Some(Holds::NameOr(kind, list)) => [choices(list), names(files, kind)].concat(),
        Some(Holds::Function) => {
            Function::named().map(|function| item(function.name(), CompletionItemKind::EnumMember, "robot")).collect()
        }
    }
}

fn nets(before: &Before<'_>, files: &Files<'_>, wanted: NameKind) -> Vec<CompletionItem> {
    let Some(first) = before.tokens.first() else { return Vec::new() };
    let checked = files.checked;
    let around = checked.file.and_then(|file| {
        let declarations = &checked.tree(file)?.declarations;
        declarations.iter().map(|declaration| declaration.span).find(|span| span.start as usize == first.range.start)
    });
    let named: BTreeMap<&str, &str> = match around {
        Some(span) => {
            let inside =
                checked.uses.of_file(span.file).filter(|found| span.range().contains(&found.place.range().start));
            let wanted = inside.filter(|found| found.kind == wanted);
            wanted.map(|found| (checked.sources.text(found.place), found.kind.word())).collect()
        }
        None => {
            let words = before.tokens.iter().skip(2).filter(|token| token.kind == TokenKind::Word);
            let words = words.map(|token| &before.text[token.range.clone()]);
            let is_name = |word: &&str| is_word(word) && checked.program.circuit(word).is_none();
            words.filter(is_name).map(|word| (word, "name")).collect()
        }
    };
    named.into_iter().map(|(name, detail)| item(name, CompletionItemKind::Variable, detail)).collect()
}

fn circuits(files: &Files<'_>) -> Vec<CompletionItem> {
    let call = |interface: Interface| {
        let operands: Vec<_> =
            interface.inputs.iter().zip(1..).map(|(port, at)| format!("${{{at}:{}}}", port.name)).collect();
        let value = interface.comment.clone();
        CompletionItem {
            insert_text: Some(format!("{}({})", interface.name, operands.join(", "))),
            insert_text_format: Some(InsertTextFormat::Snippet),
            documentation: (!value.is_empty()).then(|| MarkupContent { kind: MarkupKind::Markdown, value }.into()),
            ..item(&interface.name, CompletionItemKind::Function, &interface.label())
        }
    };
    let own = files.checked.program.circuits.iter().filter(|circuit| !circuit.name.contains('.'));
    own.map(|circuit| call(Interface::of(files, circuit))).collect()
}

fn columns(files: &Files<'_>, name: &str) -> Vec<CompletionItem> {
    let program = &files.checked.program;
    let circuit = program.swarm(name).map_or(name, |swarm| swarm.circuit.circuit.as_str());
    let Some(circuit) = program.circuit(circuit) else { return Vec::new() };
    let ports = circuit.nets[..circuit.inputs + circuit.outputs].iter();
    ports.map(|port| item(&port.name, CompletionItemKind::Variable, "port")).collect()
}

fn names(files: &Files<'_>, wanted: NameKind) -> Vec<CompletionItem> {
    let all = files.checked.sources.iter().flat_map(|source| files.checked.uses.of_file(source.id));
    let declared = all.filter(|found| found.place == found.declared && found.kind == wanted);
    let named: BTreeMap<&str, NameKind> =
        declared.map(|found| (files.checked.sources.text(found.place), found.kind)).collect();
    named.into_iter().map(|(name, kind)| item(name, CompletionItemKind::Reference, kind.word())).collect()
}
