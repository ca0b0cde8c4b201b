//! Semantic tokens: the meaning of each token, which determines its color.

use gen_lsp_types::{SemanticToken, SemanticTokens, SemanticTokensLegend};

use crate::files::Files;
use crate::tokens::tokens;
use nbc_base::source::{FileId, Span};
use nbc_circuit::formats::is_word;
use nbc_lang::check::{NameKind, NameUse};
use nbc_lang::syntax::{KEYWORDS, Token, TokenKind};

/// In the order of their numbers.
const TYPES: [&str; 13] = [
    "keyword",
    "comment",
    "string",
    "number",
    "operator",
    "function",
    "variable",
    "parameter",
    "typeParameter",
    "property",
    "event",
    "enumMember",
    "class",
];

/// In the order of their bits.
const MODIFIERS: [&str; 2] = ["declaration", "defaultLibrary"];

/// Words that are keywords only where they are not names.
const WORDS: [&str; 21] = [
    "against", "all", "always", "assume", "at", "bins", "cycles", "deg", "ever", "from", "inputs", "least", "match",
    "most", "never", "repeat", "rows", "steps", "until", "with", "within",
];

pub(super) fn legend() -> SemanticTokensLegend {
    SemanticTokensLegend {
        token_types: TYPES.map(str::to_owned).to_vec(),
        token_modifiers: MODIFIERS.map(str::to_owned).to_vec(),
    }
}

pub(super) fn of(files: &Files<'_>, file: FileId, part: std::ops::Range<usize>) -> SemanticTokens {
    let text = &files.checked.sources.file(file).text;
    let lines = files.lines(file);
    let uses: Vec<NameUse> = files.checked.uses.of_file(file).collect();
    let all = tokens(text);
    let mut data = Vec::new();
    let (mut line, mut column) = (0, 0);
    for (at, token) in all.iter().enumerate() {
        if token.range.end < part.start || token.range.start > part.end {
            continue;
        }
        let next = all.get(at + 1).map_or("", |next| &text[next.range.clone()]);
        let Some((kind, modifiers)) = meaning(files, file, &uses, text, token, next) else { continue };
        // No token of the protocol goes beyond its line.
        let shown = &text[token.range.clone()];
        let end = token.range.start + shown.find(['\n', '\r']).unwrap_or(shown.len());
        let range = lines.range(token.range.start..end);
        let delta_line = range.start.line - line;
        let delta_start = range.start.character - if delta_line == 0 { column } else { 0 };
        (line, column) = (range.start.line, range.start.character);
        let token_type = TYPES.iter().position(|name| *name == kind).expect("the legend has every type") as u32;
        data.push(SemanticToken {
            delta_line,
            delta_start,
            length: range.end.character - range.start.character,
            token_type,
            token_modifiers_bitset: modifiers,
        });
    }
    SemanticTokens { result_id: None, data }
}

fn meaning(
    files: &Files<'_>,
    file: FileId,
    uses: &[NameUse],
    text: &str,
    token: &Token,
    next: &str,
) -> Option<(&'static str, u32)> {
    let word = &text[token.range.clone()];
    match token.kind {
        TokenKind::Comment | TokenKind::ForeignComment => Some(("comment", 0)),
        TokenKind::Quoted => Some(("string", 0)),
        TokenKind::Number => Some(("number", 0)),
        TokenKind::Sign => word.starts_with(|sign| "+-=<>!*/%|".contains(sign)).then_some(("operator", 0)),
        TokenKind::Word => {
            let place = Span::new(file, token.range.start, token.range.end);
            match uses.binary_search_by_key(&place, |found| found.place) {
                Ok(at) => Some(of_name(files, uses[at])),
                Err(_) if word == "_" || !word.is_ascii() => None,
                Err(_) if next == ":" && word != "else" => Some(("property", 0)),
                Err(_) if !is_word(word) => Some(("keyword", 0)),
                Err(_) => (KEYWORDS.contains(&word) || WORDS.contains(&word)).then_some(("keyword", 0)),
            }
        }
    }
}

fn of_name(files: &Files<'_>, found: NameUse) -> (&'static str, u32) {
    let kind = match found.kind {
        NameKind::Circuit => "function",
        NameKind::Net if is_input(files, found.declared) => "parameter",
        NameKind::Net => "variable",
        NameKind::Number => "typeParameter",
        NameKind::Stimulus => "event",
        NameKind::Material | NameKind::Member => "enumMember",
        NameKind::Enumeration
        | NameKind::File
        | NameKind::Images
        | NameKind::Schedule
        | NameKind::Evolution
        | NameKind::Library
        | NameKind::Swarm
        | NameKind::World => "class",
    };
    let declaration = u32::from(found.place == found.declared);
    let library = u32::from(files.prelude(found.declared.file).is_some());
    (kind, declaration | library << 1)
}

fn is_input(files: &Files<'_>, declared: Span) -> bool {
    let circuits = &files.checked.program.circuits;
    circuits.iter().any(|circuit| circuit.nets[..circuit.inputs].iter().any(|net| net.span == declared))
}
