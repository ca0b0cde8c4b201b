//! Verilog that cannot reach beyond its own text.
//!
//! Yosys reads the files that a Verilog text names, and calls functions of C for it. A macro can put the name of such a
//! thing together out of pieces, so a text with macros cannot be judged by what is written in it; macros are refused.

/// Directives of the preprocessor that neither read files nor insert text.
const DIRECTIVES: &[&str] = &["celldefine", "default_nettype", "endcelldefine", "resetall", "timescale"];
/// System functions that compute with their arguments only.
const FUNCTIONS: &[&str] = &["bits", "clog2", "display", "finish", "signed", "size", "unsigned"];
/// The name of the interface to functions of C.
const FOREIGN: &str = "DPI";

/// The first word of a Verilog text that may lead beyond the text, with its line, from 1.
pub(super) fn reach(text: &str) -> Option<(usize, String)> {
    let joined = without_comments(text);
    [text, joined.as_str()]
        .into_iter()
        .find_map(|text| text.lines().zip(1..).find_map(|(line, number)| Some((number, reach_of_line(line)?))))
}

fn reach_of_line(line: &str) -> Option<String> {
    let marked = line.char_indices().filter(|(_, c)| matches!(c, '`' | '$')).find_map(|(at, mark)| {
        let rest = &line[at + 1..];
        let end = rest.find(|c: char| !c.is_ascii_alphanumeric() && !matches!(c, '_' | '$')).unwrap_or(rest.len());
        let allowed = if mark == '`' { DIRECTIVES } else { FUNCTIONS };
        (!allowed.contains(&&rest[..end])).then(|| line[at..=at + end].to_owned())
    });
    marked.or_else(|| line.contains(FOREIGN).then(|| FOREIGN.to_owned()))
}

/// The text without block comments: words around a comment may become one. The line breaks of a comment come after the
/// line that it ends in, so that later lines keep their numbers.
fn without_comments(text: &str) -> String {
    let mut parts = text.split("/*");
    let mut joined = parts.next().unwrap_or_default().to_owned();
    let mut owed = 0;
    for part in parts {
        let (comment, rest) = part.split_once("*/").unwrap_or((part, ""));
        owed += comment.matches('\n').count();
        match rest.split_once('\n') {
            Some((line, rest)) => joined.extend([line, &"\n".repeat(owed + 1), rest]),
            None => joined.push_str(rest),
        }
        owed = if rest.contains('\n') { 0 } else { owed };
    }
    joined
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn words_that_lead_out_are_found_at_their_line() {
        for (text, line, word) in [
            ("`include \"/etc/passwd\"", 1, "`include"),
            ("module a;\n  initial $readmemh(\"/etc/passwd\", m);", 2, "$readmemh"),
            ("\n`define m $read\n`m`n", 2, "`define"),
            ("a = $`m;", 1, "$"),
            ("a = ``;", 1, "`"),
            ("import \"DPI-C\" function integer kill(integer a, integer b);", 1, "DPI"),
            ("\n/*\n*/ import \"D/* \n */PI\" function", 2, "DPI"),
            ("a /*\n\n*/ b\nc $time", 4, "$time"),
            ("$signed/**/x(a)", 1, "$signedx"),
            ("$signed$x(a)", 1, "$signed$x"),
        ] {
            assert_eq!(reach(text), Some((line, word.to_owned())), "{text}");
        }
    }

    #[test]
    fn what_computes_only_is_left_alone() {
        let text = "`timescale 1ns/1ps\n`default_nettype none\nmodule a(input [3:0] b, output c); // plain\n\
                    /* two\nlines */ assign c = $signed(b) > $clog2(8);\nendmodule\n";
        assert_eq!(reach(text), None);
    }
}
