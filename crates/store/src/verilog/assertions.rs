//! Leaves out assertions and assumptions, with what is done if they hold or fail: a circuit has no part for them. Yosys
//! reads only some of them, and Icarus Verilog others.

use crate::verilog::token::{VerilogToken, VerilogTokenKind};

/// The words that begin an assertion.
const ASSERTING: [&str; 4] = ["assert", "assume", "cover", "restrict"];
/// The tokens after which a statement or an item of a module can begin.
const BEFORE: [&str; 18] = [
    ";",
    ")",
    ":",
    "*",
    "begin",
    "end",
    "else",
    "fork",
    "join",
    "endcase",
    "endfunction",
    "endtask",
    "endproperty",
    "generate",
    "initial",
    "always_comb",
    "always_latch",
    "final",
];
/// What may stand between the word and the condition.
const PREFIXES: [&str; 7] = ["(", "property", "sequence", "final", "#", "0", "1"];
/// The words after which a colon and a name may stand.
const NAMED: [&str; 6] = ["begin", "end", "fork", "join", "endfunction", "endtask"];

/// What becomes of a token.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Kept {
    /// It stays.
    As,
    /// It is left out.
    Not,
    /// The first token of an assertion: this text comes in its place.
    Instead {
        text: &'static str,
        /// Whether the name and the colon before it are a label of the assertion.
        has_label: bool,
    },
}

/// The state that follows from the tokens so far.
#[derive(Debug, Default)]
pub(super) struct AssertionFilter {
    part: Part,
    /// Conditions `if` of the statement being left out that may have an `else`, outside of blocks.
    ifs: usize,
    /// Whether the assertion's own `else` has come.
    has_else: bool,
    /// The last three tokens that stayed, latest first.
    last: [String; 3],
    /// The open blocks of the module: whether each is a `case`.
    blocks: Vec<bool>,
}

/// The part of an assertion that is being left out.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
enum Part {
    #[default]
    Outside,
    /// Up to the end of the condition, with this many open parentheses.
    Condition(usize),
    /// After the condition: a statement, `else` or the end.
    Next,
    /// A statement with open parentheses and blocks.
    Statement(usize, usize),
    /// After a statement: `else`, or the assertion has ended.
    End,
    /// Up to `endproperty`.
    Property,
}

impl AssertionFilter {
    /// What becomes of the next token, in a procedure or as an item of a module.
    pub(super) fn see(&mut self, token: &VerilogToken, in_procedure: bool) -> Kept {
        let is_text = matches!(token.kind, VerilogTokenKind::Word | VerilogTokenKind::Sign);
        let word = if is_text { token.text.as_str() } else { "" };
        self.part = match (self.part, word) {
            (Part::Outside, _) => return self.outside(token, word, in_procedure),
            (Part::End, "else") if self.ifs > 0 => {
                self.ifs -= 1;
                Part::Statement(0, 0)
            }
            (Part::End | Part::Next, "else") if !self.has_else => {
                self.has_else = true;
                Part::Statement(0, 0)
            }
            (Part::End, _) => {
                self.part = Part::Outside;
                return self.outside(token, word, in_procedure);
            }
            (Part::Property, "endproperty") => Part::Outside,
            // Yosys says that this end is missing.
            (Part::Property, "endmodule") => {
                self.part = Part::Outside;
                return Kept::Instead { text: "endproperty", has_label: false };
            }
            // Another meaning of the word, which Yosys refuses.
            (Part::Condition(0), _) if !PREFIXES.contains(&token.text.as_str()) => {
                self.part = Part::Outside;
                return Kept::Instead { text: "assert assert", has_label: false };
            }
            (Part::Condition(1), ")") => Part::Next,
            (Part::Condition(open), "(") => Part::Condition(open + 1),
            (Part::Condition(open), ")") => Part::Condition(open.saturating_sub(1)),
            (Part::Next, ";") => Part::Outside,
            (Part::Next | Part::Statement(0, 0), "if") => {
                self.ifs += 1;
                Part::Statement(0, 0)
            }
            (Part::Next, "begin" | "fork" | "case" | "casex" | "casez") => Part::Statement(0, 1),
            (Part::Next, _) => Part::Statement(0, 0),
            (Part::Statement(open, blocks), "(") => Part::Statement(open + 1, blocks),
            (Part::Statement(open, blocks), ")") => Part::Statement(open.saturating_sub(1), blocks),
            (Part::Statement(open, blocks), "begin" | "fork" | "case" | "casex" | "casez") => {
                Part::Statement(open, blocks + 1)
            }
            (Part::Statement(_, 0 | 1), "end" | "join" | "endcase") | (Part::Statement(0, 0), ";") => Part::End,
            (Part::Statement(open, blocks), "end" | "join" | "endcase") => Part::Statement(open, blocks - 1),
            (part, _) => part,
        };
        Kept::Not
    }

    fn outside(&mut self, token: &VerilogToken, word: &str, in_procedure: bool) -> Kept {
        let [last, before, first] = self.last.each_ref().map(String::as_str);
        let is_start = BEFORE.contains(&last) || before == ":" && NAMED.contains(&first);
        if is_start && ASSERTING.contains(&word) {
            (self.part, self.ifs, self.has_else) = (Part::Condition(0), 0, false);
            // The name before a colon is a label of the assertion unless it is one of a `case`.
            let has_label = last == ":" && !self.blocks.last().is_some_and(|is_case| *is_case);
            let is_branch = matches!(last, ")" | "else" | ":") && !has_label;
            self.note(";");
            let text = match (in_procedure, is_branch) {
                (true, _) => ";",
                (false, true) => "begin end",
                (false, false) => "",
            };
            return Kept::Instead { text, has_label };
        }
        if is_start && !in_procedure && word == "property" {
            self.part = Part::Property;
            return Kept::Not;
        }
        match word {
            "begin" | "fork" => self.blocks.push(false),
            "case" | "casex" | "casez" => self.blocks.push(true),
            "end" | "join" | "endcase" => _ = self.blocks.pop(),
            "endmodule" => self.blocks.clear(),
            _ => {}
        }
        self.note(&token.text);
        Kept::As
    }

    fn note(&mut self, text: &str) {
        self.last.rotate_right(1);
        self.last[0] = text.to_owned();
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::verilog::token::{Lexer, TokenPlace};

    /// What is left of a text; `<` marks the place of a label that goes.
    fn kept(text: &str, in_procedure: bool) -> String {
        let (mut lexer, mut filter) = (Lexer::new(text, TokenPlace::default()), AssertionFilter::default());
        let mut kept = Vec::new();
        while let Some(token) = lexer.next().unwrap() {
            match filter.see(&token, in_procedure) {
                Kept::As => kept.push(token.text),
                Kept::Not => {}
                Kept::Instead { text, has_label } => {
                    kept.extend(has_label.then(|| "<".to_owned()));
                    kept.extend((!text.is_empty()).then(|| text.to_owned()));
                }
            }
        }
        kept.join(" ")
    }

    #[test]
    fn assertions_of_a_module_leave_nothing() {
        for (text, expected) in [
            ("x ; assert property (@(posedge c) a |-> b); y", "x ; y"),
            ("x ; l: assert property (p) else $error(\"no\"); y", "x ; l : < y"),
            ("x ; cover property (p) begin a; b; end y", "x ; y"),
            ("if (N) assume property (p); else y", "if ( N ) begin end else y"),
            ("begin : g assert property (p); end", "begin : g end"),
            ("x ; property p; a |-> b; endproperty y", "x ; y"),
            ("reg assert ; y", "reg assert ; y"),
            ("x ; assert u(a); y", "x ; assert assert ( a ) ; y"),
            ("x ; property p; endmodule", "x ; endproperty"),
        ] {
            assert_eq!(kept(text, false), expected, "{text}");
        }
    }

    #[test]
    fn assertions_of_a_procedure_are_empty_statements() {
        for (text, expected) in [
            ("begin assert (a == b); q = a; end", "begin ; q = a ; end"),
            // An `else` after an assertion is its own.
            ("if (a) assert (x) else $error(\"no\"); else q = 1;", "if ( a ) ; else q = 1 ;"),
            ("if (a) assert (x) p = 1; else p = 2; q = 1;", "if ( a ) ; q = 1 ;"),
            ("if (a) assert (x) begin p; end else begin if (y) p; end else q = 1;", "if ( a ) ; else q = 1 ;"),
            ("if (a) assert (x) else if (y) p; else r; else q = 1;", "if ( a ) ; else q = 1 ;"),
            ("case (s) A: assert (x); B: q = 1; endcase", "case ( s ) A : ; B : q = 1 ; endcase"),
            ("begin l: assert #0 (f(x)); end", "begin l : < ; end"),
        ] {
            assert_eq!(kept(text, true), expected, "{text}");
        }
    }
}
