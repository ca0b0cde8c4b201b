//! The reasons of Yosys in words without its own names, and the lines that they are about.

use crate::verilog::listing::VerilogListing;
use nbc_base::source::{VERILOG_SOURCE, VerilogError, VerilogPlace, verilog_line};

/// The error message of Yosys, with its place in the user's files.
pub(super) fn rejected(said: &str, listing: &VerilogListing) -> VerilogError {
    let said = said.lines().find(|line| line.contains("ERROR")).unwrap_or("no reason given").trim();
    let (line, reason) = match said.strip_prefix(VERILOG_SOURCE).and_then(|said| said.split_once(": ")) {
        Some((place, reason)) => (verilog_line(place).filter(|line| *line > 0), reason),
        None => (None, said),
    };
    let reason = with_advice(plain(reason.trim_start_matches("ERROR:").trim_start()));
    let place = line.and_then(|line| listing.place(line)).or_else(|| named(&reason, listing));
    VerilogError::Rejected { reason, place }
}

/// A message with what to do about it.
fn with_advice(reason: String) -> String {
    if reason.ends_with("is not part of the design.") { reason + " Give its file, too." } else { reason }
}

/// A message without the names that only Yosys knows.
fn plain(said: &str) -> String {
    said.split(' ').map(plain_word).collect::<Vec<_>>().join(" ")
}

fn plain_word(word: &str) -> String {
    if let Some(at) = word.find("TOK_") {
        let end = word[at + 4..]
            .find(|c: char| !c.is_ascii_alphanumeric() && c != '_')
            .map_or(word.len(), |end| at + 4 + end);
        let meant = match &word[at + 4..end] {
            "ID" => "a name".to_owned(),
            "CONSTVAL" => "a number".to_owned(),
            "STRING" => "a text".to_owned(),
            other => format!("`{}`", other.to_ascii_lowercase()),
        };
        return format!("{}{meant}{}", &word[..at], &word[end..]);
    }
    // Names are between a backquote and a quote.
    let name = word.strip_prefix(['`', '\'']).unwrap_or(word);
    let is_quoted = name.len() < word.len();
    let (name, rest) = match name.find('\'').filter(|_| is_quoted) {
        Some(end) => (&name[..end], &name[end + 1..]),
        None => (name, ""),
    };
    if !name.contains(['\\', '$']) {
        return if is_quoted { format!("`{name}`{rest}") } else { word.to_owned() };
    }
    // `$paramod\m\N=8` is module `m`; another name with `$` in front is of Yosys alone.
    let name = name.strip_prefix("$paramod").and_then(|name| name.split('\\').nth(1)).unwrap_or(name);
    let parts: Vec<&str> =
        name.split('.').map(|part| part.trim_start_matches('\\')).take_while(|part| !part.starts_with('$')).collect();
    let end = word.trim_end_matches([':', ',', '.', '!']).len();
    let mark = if is_quoted { rest } else { &word[end..] };
    match parts.join(".").trim_end_matches([':', ',', '.', '!']) {
        "" => format!("a part without a name{mark}"),
        name => format!("`{name}`{mark}"),
    }
}

/// The first line with the first name in backquotes that a line has.
fn named(reason: &str, listing: &VerilogListing) -> Option<VerilogPlace> {
    let names = reason.split('`').skip(1).step_by(2).filter_map(|name| name.rsplit('.').next());
    let line_of = |name: &str| {
        let has =
            |line: &str| line.split(|c: char| !c.is_ascii_alphanumeric() && !"_$".contains(c)).any(|word| word == name);
        listing.text.lines().position(has)
    };
    names.filter(|name| !name.is_empty()).find_map(line_of).and_then(|at| listing.place(at + 1))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn reasons_have_no_names_of_yosys() {
        for (said, expected) in [
            (
                "syntax error, unexpected TOK_ENDMODULE, expecting ';'",
                "syntax error, unexpected `endmodule`, expecting `;`",
            ),
            ("syntax error, unexpected TOK_ID", "syntax error, unexpected a name"),
            (
                "Module `\\gone' referenced in module `\\m' in cell `\\u' is",
                "Module `gone` referenced in module `m` in cell `u` is",
            ),
            ("Can't resolve task name `$error'.", "Can't resolve task name a part without a name."),
            (
                "Latch inferred for signal `\\m.\\o' from process `\\m.$proc$source.v:2$1'.",
                "Latch inferred for signal `m.o` from process `m`.",
            ),
            ("in module $paramod\\alu\\N=32'00000000000000000000000000000100:", "in module `alu`:"),
            ("Can't do 3 - 4", "Can't do 3 - 4"),
        ] {
            assert_eq!(plain(said), expected);
        }
    }
}
