//! Text that Yosys misreads, written in another way that it reads rightly.
//!
//! - The place of a part select, as in `a[x -: 4]`, has no sign for Yosys, so one that begins below the vector is lost.
//! - A value that is assigned to a computed part of a vector loses its sign, and in a block without a clock the bits of
//!   some vectors are counted from the wrong end.
//! - The variable of a loop has the sign and the width of the last value instead of its own.
//! - `unique`, `priority` and `parallel_case` let Yosys take labels for disjoint. A simulator takes the first.
//!
//! Each edit stays in its line.

use std::collections::BTreeMap;
use std::ops::Range;

use crate::verilog::token::{Lexer, TokenPlace, VerilogToken, VerilogTokenKind};
use nbc_base::source::VerilogFault;

/// A listed text in the form that Yosys reads rightly.
///
/// # Errors
/// Those of its tokens.
pub(super) fn mended(text: &str) -> Result<String, VerilogFault> {
    let mut lexer = Lexer::new(text, TokenPlace { file: 0, line: 1 });
    let mut tokens = Vec::new();
    while let Some(token) = lexer.next()? {
        let end = lexer.offset();
        tokens.push(Placed { at: end - token.text.len()..end, token });
    }
    let closing = closing(&tokens);
    let mut mender = Mender { text, tokens: &tokens, closing, edits: BTreeMap::new(), declared: BTreeMap::new() };
    mender.mend();
    Ok(mender.made())
}

/// A token and its bytes.
struct Placed {
    at: Range<usize>,
    token: VerilogToken,
}

impl Placed {
    fn is(&self, text: &str) -> bool {
        self.token.text == text && matches!(self.token.kind, VerilogTokenKind::Sign | VerilogTokenKind::Word)
    }

    fn is_one_of(&self, texts: &[&str]) -> bool {
        texts.iter().any(|text| self.is(text))
    }

    fn is_name(&self) -> bool {
        match self.token.kind {
            VerilogTokenKind::Word => !self.is_one_of(&KEYWORDS) && !self.is_one_of(&DECLARING),
            kind => kind == VerilogTokenKind::Escaped,
        }
    }
}

/// What is known of a declared name.
#[derive(Clone, Copy, Debug)]
struct Declared {
    is_signed: bool,
    /// Whether it has 32 bits and no range.
    is_integer: bool,
    /// Whether it is one row of bits.
    is_vector: bool,
}

/// Words that begin or go on with a declaration of nets or variables.
const DECLARING: [&str; 15] = [
    "input", "output", "inout", "wire", "reg", "logic", "bit", "integer", "int", "byte", "shortint", "longint",
    "genvar", "var", "tri",
];
/// Those whose variables have a sign.
const SIGNED: [&str; 6] = ["integer", "int", "byte", "shortint", "longint", "genvar"];
/// Those whose variables have 32 bits.
const INTEGERS: [&str; 3] = ["integer", "int", "genvar"];
/// Other words that are not names.
const KEYWORDS: [&str; 37] = [
    "always",
    "always_comb",
    "always_ff",
    "always_latch",
    "assign",
    "automatic",
    "begin",
    "case",
    "casex",
    "casez",
    "default",
    "else",
    "end",
    "endcase",
    "endfunction",
    "endgenerate",
    "endmodule",
    "endtask",
    "for",
    "function",
    "generate",
    "if",
    "initial",
    "localparam",
    "module",
    "negedge",
    "or",
    "parameter",
    "posedge",
    "priority",
    "repeat",
    "return",
    "signed",
    "task",
    "unique",
    "unsigned",
    "while",
];
/// Words before a head in parentheses.
const HEADS: [&str; 9] = ["if", "for", "while", "repeat", "case", "casez", "casex", "foreach", "@"];
/// Words that no expression has.
const STATEMENTS: [&str; 16] = [
    "always",
    "assign",
    "begin",
    "case",
    "casex",
    "casez",
    "else",
    "end",
    "endcase",
    "endmodule",
    "for",
    "if",
    "initial",
    "module",
    "repeat",
    "while",
];
/// The longest place of a part select that is written twice, in bytes.
const LONGEST: usize = 4096;

/// The token that closes each bracket.
fn closing(tokens: &[Placed]) -> Vec<Option<usize>> {
    let mut closing = vec![None; tokens.len()];
    let mut open = Vec::new();
    for (at, placed) in tokens.iter().enumerate().filter(|(_, placed)| placed.token.kind == VerilogTokenKind::Sign) {
        match placed.token.text.as_str() {
            "(" | "[" | "{" => open.push(at),
            ")" | "]" | "}" => open.pop().into_iter().for_each(|open: usize| closing[open] = Some(at)),
            _ => {}
        }
    }
    closing
}

struct Mender<'a> {
    text: &'a str,
    tokens: &'a [Placed],
    closing: Vec<Option<usize>>,
    /// What is written at a place: the bytes that go, and the text that comes.
    edits: BTreeMap<usize, (usize, String)>,
    /// The names of the module so far.
    declared: BTreeMap<String, Declared>,
}

impl Mender<'_> {
    /// The text with the edits.
    fn made(&self) -> String {
        let mut made = String::with_capacity(self.text.len());
        let mut from = 0;
        for (&at, (gone, text)) in &self.edits {
            made.push_str(&self.text[from..at]);
            made.push_str(text);
            from = at + gone;
        }
        made.push_str(&self.text[from..]);
        made
    }

    fn mend(&mut self) {
        // Whether a statement may begin here, whether one may after the next colon, and whether it is of a block
        // without a clock.
        let (mut is_start, mut is_label, mut is_loose) = (false, false, false);
        // Whether the parentheses that are open are the head of a statement.
        let mut heads = Vec::new();
        for at in 0..self.tokens.len() {
            let placed = &self.tokens[at];
            let was_start = std::mem::take(&mut is_start);
            let is_head = match placed.token.text.as_str() {
                "(" => {
                    heads.push(at > 0 && self.tokens[at - 1].is_one_of(&HEADS));
                    false
                }
                ")" => heads.pop().unwrap_or_default(),
                "*" => at > 0 && self.tokens[at - 1].is("@"),
                _ => false,
            };
            if is_head || placed.is_one_of(&[";", "begin", "end", "else", "endcase", "always_comb", "always_latch"]) {
                (is_start, is_label) = (true, true);
            } else if placed.is(":") {
                is_start = is_label;
            } else if placed.is_one_of(&["=", "?", "assign"]) {
                is_label = false;
            }
            if placed.is_one_of(&["always", "always_comb", "always_latch"]) {
                is_loose = self.has_no_clock(at + 1);
            } else if placed.is_one_of(&["always_ff", "initial", "function", "task"]) {
                is_loose = false;
            }
            match placed.token.text.as_str() {
                "module" | "macromodule" => self.declared.clear(),
                "for" => self.head(at + 1),
                "[" => self.downward(at),
                "unique" | "unique0" | "priority" => self.disjoint(at),
                "parallel_case" if placed.token.kind == VerilogTokenKind::Word => self.replace(at, "nbc_ignored"),
                text if placed.token.kind == VerilogTokenKind::Hint && text.contains("parallel_case") => {
                    self.replace(at, if text.contains("full_case") { "/* synopsys full_case */" } else { "" });
                }
                _ if placed.is_one_of(&DECLARING) => self.declare(at),
                _ if was_start && placed.is_name() => {
                    if at >= 2 && self.is(at - 1, ":") && self.is(at - 2, "begin") {
                        is_start = true;
                    } else {
                        self.assignment(at, is_loose);
                    }
                }
                _ => {}
            }
        }
    }

    fn is(&self, at: usize, text: &str) -> bool {
        self.tokens.get(at).is_some_and(|placed| placed.is(text))
    }

    /// Writes a text before a token.
    fn insert(&mut self, at: usize, text: &str) {
        self.edits.entry(self.tokens[at].at.start).or_default().1.push_str(text);
    }

    /// Writes a text in the place of a token.
    fn replace(&mut self, at: usize, text: &str) {
        let length = self.tokens[at].at.len();
        let edit = self.edits.entry(self.tokens[at].at.start).or_default();
        edit.0 = length;
        edit.1.push_str(text);
    }

    /// The text of some tokens. A name after a backslash needs the space.
    fn source(&self, range: Range<usize>) -> String {
        let (first, last) = (self.tokens[range.start].at.start, self.tokens[range.end - 1].at.end);
        format!("{} ", &self.text[first..last])
    }

    /// The first token from `from` on for which `is` holds, outside of brackets that begin there.
    fn outside(&self, from: usize, is: impl Fn(usize) -> bool) -> Option<usize> {
        let mut at = from;
        while at < self.tokens.len() {
            if is(at) {
                return Some(at);
            }
            let placed = &self.tokens[at];
            if placed.is_one_of(&[")", "]", "}"]) || placed.is_one_of(&STATEMENTS) {
                return None;
            }
            at = self.closing[at].unwrap_or(at) + 1;
        }
        None
    }

    /// Whether the events of an `always` have no edge.
    fn has_no_clock(&self, from: usize) -> bool {
        let Some(close) = self.closing.get(from + 1).copied().flatten().filter(|_| self.is(from, "@")) else {
            return true;
        };
        !self.tokens[from + 1..close].iter().any(|placed| placed.is_one_of(&["posedge", "negedge"]))
    }

    /// Notes the names of a declaration.
    fn declare(&mut self, from: usize) {
        let (mut is_signed, mut is_integer, mut ranges, mut at) = (false, false, 0, from);
        while let Some(placed) = self.tokens.get(at) {
            if placed.is_one_of(&DECLARING) {
                // Another port.
                if at > from + 2 {
                    return;
                }
                is_signed |= placed.is_one_of(&SIGNED);
                is_integer |= placed.is_one_of(&INTEGERS);
            } else if placed.is("signed") || placed.is("unsigned") {
                is_signed = placed.is("signed");
            } else if placed.is("[") {
                ranges += 1;
                let Some(close) = self.closing[at] else { return };
                at = close;
            } else if placed.is_name() {
                let is_vector = ranges <= 1 && !self.is(at + 1, "[");
                let declared = Declared { is_signed, is_integer: is_integer && ranges == 0, is_vector };
                self.declared.insert(placed.token.text.clone(), declared);
                let next = self.outside(at + 1, |at| self.tokens[at].is_one_of(&[",", ";"]));
                let Some(comma) = next.filter(|&at| self.is(at, ",")) else { return };
                at = comma;
                if self.tokens.get(at + 1).is_some_and(|next| next.is_one_of(&DECLARING)) {
                    return;
                }
            } else {
                return;
            }
            at += 1;
        }
    }

    /// Writes `[x -: 4]` as a part select upward from a place with a sign.
    fn downward(&mut self, open: usize) {
        let Some(close) = self.closing[open] else { return };
        let sign = self.outside(open + 1, |at| self.is(at, "-") && self.is(at + 1, ":"));
        let Some(sign) = sign.filter(|&sign| sign > open + 1 && sign + 2 < close) else { return };
        if self.tokens[open + 1..sign].iter().all(|placed| placed.token.kind == VerilogTokenKind::Number) {
            return;
        }
        let (place, width) = (self.source(open + 1..sign), self.source(sign + 2..close));
        if place.len() + width.len() > LONGEST {
            return;
        }
        // The place has a size and a sign of its own.
        self.insert(open + 1, &format!("$signed(65'(($bits({place}))'("));
        self.replace(sign, &format!("))) - ({width}) + 1 +"));
        self.insert(sign + 2, "(");
        self.insert(close, ")");
    }

    /// Gives the values of a loop's variable its sign and width: `i = i + 1`, `i += 1` and `i++` in its head.
    fn head(&mut self, open: usize) {
        let Some(close) = self.closing.get(open).copied().flatten() else { return };
        let Some(first) = self.outside(open + 1, |at| self.is(at, ";")) else { return };
        let Some(second) = self.outside(first + 1, |at| self.is(at, ";")) else { return };
        let types = self.tokens[open + 1..first].iter().take_while(|placed| !placed.is_name()).count();
        if types > 0 {
            self.declare(open + 1);
        }
        let begin = open + 1 + types;
        if !self.is(begin + 1, "=") || begin + 2 >= first {
            return;
        }
        let name = self.tokens[begin].token.text.clone();
        let Some(declared) = self.declared.get(&name).copied() else { return };
        let last = second + 1..close;
        let own = |at: usize| self.tokens.get(at).is_some_and(|placed| placed.token.text == name);
        let from = match last.len() {
            0 => return,
            // `i++` and `++i`
            3 if own(last.start) || own(last.end - 1) => {
                let at = if own(last.start) { last.start + 1 } else { last.start };
                let sign = self.tokens[at].token.text.clone();
                if !self.is(at + 1, &sign) {
                    return;
                }
                for at in last.clone() {
                    self.replace(at, "");
                }
                self.insert(last.start, &format!("{name} = {}", cast(&declared, &name, &format!("{name} {sign} 1"))));
                None
            }
            _ if !own(last.start) => return,
            _ => {
                let Some(equal) = self.outside(last.start + 1, |at| self.is(at, "=")).filter(|&at| at < close) else {
                    return;
                };
                let operator: String =
                    self.tokens[last.start + 1..equal].iter().map(|placed| placed.token.text.as_str()).collect();
                for at in last.start + 1..equal {
                    self.replace(at, "");
                }
                Some((equal + 1, operator))
            }
        };
        self.enclose(begin + 2, first, &declared, &name, "");
        if let Some((at, operator)) = from.filter(|(at, _)| *at < close) {
            self.enclose(at, close, &declared, &name, &operator);
        }
    }

    /// Encloses a value of a loop's variable. An operator comes between the variable and the value.
    fn enclose(&mut self, from: usize, end: usize, declared: &Declared, name: &str, operator: &str) {
        let made = cast(declared, name, "\0");
        let (before, after) = made.split_once('\0').expect("the value is part of the cast");
        match operator {
            "" => self.insert(from, before),
            _ => self.insert(from, &format!("{before}{name} {operator} (")),
        }
        self.insert(end, &format!("{}{after}", if operator.is_empty() { "" } else { ")" }));
    }

    /// Gives a value that is assigned to a computed part of a vector the width of the part.
    fn assignment(&mut self, name: usize, is_loose: bool) {
        let open = name + 1;
        let Some(close) = self.closing.get(open).copied().flatten().filter(|_| self.is(open, "[")) else { return };
        // The last of several brackets.
        let mut last = open;
        while let Some(next) = self.closing[last].filter(|&close| self.is(close + 1, "[")) {
            last = next + 1;
        }
        let Some(end) = self.closing[last] else { return };
        let is_later = self.is(end + 1, "<") && self.is(end + 2, "=");
        let from = if is_later { end + 3 } else { end + 2 };
        if !is_later && (!self.is(end + 1, "=") || self.is(end + 2, "=")) {
            return;
        }
        let Some(stop) = self.outside(from, |at| self.is(at, ";")).filter(|&stop| stop > from) else { return };
        let colon = self.outside(last + 1, |at| self.is(at, ":")).filter(|&at| at < end);
        let sign = colon.filter(|&at| self.is(at - 1, "+") || self.is(at - 1, "-"));
        if let Some(colon) = sign
            && !self.is(from, "#")
        {
            let width = self.source(colon + 1..end);
            self.insert(from, &format!("({width})'(("));
            self.insert(stop, &format!(") | ({width})'(1'sd0))"));
        }
        let is_number = |placed: &Placed| placed.token.kind == VerilogTokenKind::Number || placed.is(":");
        let is_computed = !self.tokens[open + 1..close].iter().all(is_number);
        let text = self.tokens[name].token.text.clone();
        let is_vector = self.declared.get(&text).is_some_and(|declared| declared.is_vector && !declared.is_integer);
        if is_loose && !is_later && is_computed && last == open && is_vector {
            // An assignment to the whole vector makes Yosys shift the part to its place instead of comparing places.
            self.insert(name, &format!("begin {text} = {text} ; "));
            self.replace(stop, "; end");
        }
    }

    /// Leaves out `unique` and `priority`. That there are no other values stays a promise.
    fn disjoint(&mut self, at: usize) {
        if !self.tokens.get(at + 1).is_some_and(|next| next.is_one_of(&["case", "casez", "casex", "if"])) {
            return;
        }
        let is_full = !self.is(at + 1, "if") && !self.is(at, "unique0");
        self.replace(at, if is_full { "(* full_case *)" } else { "" });
    }
}

/// A value in the type of a variable.
fn cast(declared: &Declared, name: &str, value: &str) -> String {
    let sign = if declared.is_signed { "$signed" } else { "$unsigned" };
    let width = if declared.is_integer { "32".to_owned() } else { format!("($bits({name} ))") };
    format!("{sign}({width}'(({value}) | {width}'(1'sd0)))")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_yosys_misreads_is_written_in_another_way() {
        for (text, expected) in [
            ("assign q = a[7 -: 4] + b[x +: 2];", "assign q = a[7 -: 4] + b[x +: 2];"),
            ("q = a[x -: W];", "q = a[$signed(65'(($bits(x ))'( x))) - (W ) + 1 +: ( W)];"),
            (
                "reg [7:0] y; always @* y[x +: 4] = s;",
                "reg [7:0] y; always @* begin y = y ; y[x +: 4] = (4 )'((s) | (4 )'(1'sd0)); end",
            ),
            ("reg [7:0] y; always @(posedge c) y[x] <= s;", "reg [7:0] y; always @(posedge c) y[x] <= s;"),
            ("reg [7:0] m [0:3]; always @* m[x] = s;", "reg [7:0] m [0:3]; always @* m[x] = s;"),
            (
                "always @* case (s) 1: q = s ? t : y[x +: 2] <= 3; endcase",
                "always @* case (s) 1: q = s ? t : y[x +: 2] <= 3; endcase",
            ),
            (
                "always @(posedge c) case (s) 2: y[x +: 2] <= 3; endcase",
                "always @(posedge c) case (s) 2: y[x +: 2] <= (2 )'((3) | (2 )'(1'sd0)); endcase",
            ),
            (
                "integer i; for (i = a; i < 3; i = i + 1) ;",
                "integer i; for (i = $signed(32'((a) | 32'(1'sd0))); i < 3; i = $signed(32'((i + 1) | 32'(1'sd0)))) ;",
            ),
            (
                "reg [1:0] i; for (i = 0; i < 3; i += 2) ;",
                "reg [1:0] i; for (i = $unsigned(($bits(i ))'((0) | ($bits(i ))'(1'sd0))); i < 3; i = \
                 $unsigned(($bits(i ))'((i + (2)) | ($bits(i ))'(1'sd0)))) ;",
            ),
            (
                "for (int i = 0; i < 3; i++) ;",
                "for (int i = $signed(32'((0) | 32'(1'sd0))); i < 3; i = $signed(32'((i + 1) | 32'(1'sd0)))) ;",
            ),
            ("unique case (a) endcase priority if (b) ;", "(* full_case *) case (a) endcase  if (b) ;"),
            ("(* full_case, parallel_case *) case (a) endcase", "(* full_case, nbc_ignored *) case (a) endcase"),
        ] {
            let plain = |text: &str| text.split_whitespace().collect::<String>();
            assert_eq!(plain(&mended(text).unwrap()), plain(expected), "{text}");
        }
    }

    #[test]
    fn hostile_texts_take_no_time_that_squares() {
        for part in ["[", "(", "input ", "for (", "a[", "begin a[0] = ", "reg x, ", "unique "] {
            assert!(mended(&part.repeat(200_000)).is_ok());
        }
    }
}
