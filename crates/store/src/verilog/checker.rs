//! Refuses tokens of Verilog that could read files, run programs, or leave nets without a driver. Only text that
//! computes is translated.

use crate::verilog::token::{VerilogToken, VerilogTokenKind};

/// System functions and tasks that compute with their arguments only, or that Yosys ignores.
const FUNCTIONS: [&str; 24] = [
    "$bits",
    "$clog2",
    "$display",
    "$error",
    "$fatal",
    "$finish",
    "$high",
    "$info",
    "$itor",
    "$left",
    "$low",
    "$monitor",
    "$realtime",
    "$right",
    "$rtoi",
    "$signed",
    "$size",
    "$stop",
    "$strobe",
    "$time",
    "$unsigned",
    "$warning",
    "$write",
    "$dumpvars",
];

/// Why a token is refused.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) enum TokenFault {
    /// It could lead to other files or programs.
    Outside(String),
    /// It is not always 0 or 1.
    HighImpedance(String),
    /// An argument of a task that goes in and out, whose value some versions of Yosys lose.
    InOutArgument,
    /// A base without digits, which could follow from elsewhere.
    NoDigits(String),
}

/// The state that follows from the tokens so far.
#[derive(Debug, Default)]
pub(super) struct TokenChecker {
    /// Whether `import` was the word before.
    is_importing: bool,
    /// Tasks and functions that are open.
    tasks: usize,
    /// Statements `case` that are open, outermost first.
    cases: Vec<Case>,
    /// Parentheses that are open.
    depth: usize,
    /// Whether a constant here can only be a label of a statement `case`.
    is_label: bool,
}

#[derive(Debug)]
struct Case {
    /// Whether `z` and `?` match any value.
    has_wildcards: bool,
    /// The parentheses outside of its head, until that ends.
    head: Option<usize>,
}

impl TokenChecker {
    /// Checks the next token.
    ///
    /// # Errors
    /// When it is refused.
    pub(super) fn see(&mut self, token: &VerilogToken) -> Result<(), TokenFault> {
        let text = token.text.as_str();
        if std::mem::take(&mut self.is_importing)
            && !matches!(token.kind, VerilogTokenKind::Word | VerilogTokenKind::Escaped)
        {
            return Err(TokenFault::Outside("import".to_owned()));
        }
        let was_label = std::mem::take(&mut self.is_label);
        match token.kind {
            VerilogTokenKind::Word => self.word(text)?,
            VerilogTokenKind::Based => {
                self.constant(text, was_label)?;
                self.is_label = was_label;
            }
            VerilogTokenKind::Number | VerilogTokenKind::Hint => self.is_label = was_label,
            VerilogTokenKind::Sign => self.sign(text, was_label),
            VerilogTokenKind::System | VerilogTokenKind::Escaped if is_outside(text) => {
                return Err(TokenFault::Outside(text.to_owned()));
            }
            VerilogTokenKind::System
            | VerilogTokenKind::Escaped
            | VerilogTokenKind::Quoted
            | VerilogTokenKind::Directive => {}
        }
        Ok(())
    }

    fn word(&mut self, word: &str) -> Result<(), TokenFault> {
        match word {
            // Packages are imported by name, functions of C by a text.
            "import" => self.is_importing = true,
            "export" => return Err(TokenFault::Outside(word.to_owned())),
            "module" | "macromodule" | "endmodule" => (self.tasks, self.cases) = (0, Vec::new()),
            "task" | "function" => self.tasks += 1,
            "endtask" | "endfunction" => self.tasks = self.tasks.saturating_sub(1),
            "inout" if self.tasks == 0 => return Err(TokenFault::HighImpedance(word.to_owned())),
            "inout" => return Err(TokenFault::InOutArgument),
            "tri0" | "tri1" | "trireg" => return Err(TokenFault::HighImpedance(word.to_owned())),
            "case" | "casex" | "casez" => {
                self.cases.push(Case { has_wildcards: word != "case", head: Some(self.depth) });
            }
            "endcase" => {
                self.cases.pop();
                self.is_label = true;
            }
            "end" => self.is_label = true,
            _ => {}
        }
        Ok(())
    }

    fn sign(&mut self, sign: &str, was_label: bool) {
        match sign {
            "(" => self.depth += 1,
            ")" => {
                self.depth = self.depth.saturating_sub(1);
                let depth = self.depth;
                let ended = self.cases.last_mut().and_then(|case| case.head.take_if(|head| *head == depth));
                self.is_label = ended.is_some();
            }
            ";" => self.is_label = true,
            // A label may be made of several constants.
            "," | "{" | "}" => self.is_label = was_label,
            _ => {}
        }
    }

    fn constant(&self, text: &str, is_label: bool) -> Result<(), TokenFault> {
        let signed = text.trim_start_matches('\'').trim_start_matches(['s', 'S']);
        if signed.len() == 1 && signed.starts_with(['b', 'B', 'o', 'O', 'd', 'D', 'h', 'H']) {
            return Err(TokenFault::NoDigits(text.to_owned()));
        }
        let has_wildcards = self.cases.last().is_some_and(|case| case.has_wildcards);
        if text.contains(['z', 'Z', '?']) && !(is_label && has_wildcards) {
            return Err(TokenFault::HighImpedance(text.to_owned()));
        }
        Ok(())
    }
}

/// Whether a name could be that of a function which does more than compute. Yosys takes `\$readmemh` for `$readmemh`;
/// the gates in its own netlists, such as `\$_AND_`, are no functions.
fn is_outside(name: &str) -> bool {
    let meant = name.strip_prefix('\\').unwrap_or(name);
    meant.starts_with('$') && !name.starts_with("\\$_") && !FUNCTIONS.contains(&meant)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::verilog::token::{Lexer, TokenPlace};

    fn judged(text: &str) -> Result<(), TokenFault> {
        let (mut lexer, mut checker) = (Lexer::new(text, TokenPlace::default()), TokenChecker::default());
        while let Some(token) = lexer.next().unwrap() {
            checker.see(&token)?;
        }
        Ok(())
    }

    #[test]
    fn what_leads_out_is_refused() {
        for (text, word) in [
            ("import \"DPI-C\" function integer kill(integer a, integer b);", "import"),
            ("import /* c */ \"DPI\" context function integer f();", "import"),
            ("export \"DPI-C\" function f;", "export"),
            ("initial $readmemh(\"/etc/passwd\", m);", "$readmemh"),
            ("f = $fopen(\"a\");", "$fopen"),
            ("x = $system(\"a\") + $signed(1);", "$system"),
            ("x = $signed$x(a);", "$signed$x"),
            ("x = $;", "$"),
            ("initial \\$readmemh (\"/etc/passwd\", m);", "\\$readmemh"),
            ("#1import \"DPI-C\" function integer f();", "import"),
            ("#1.5e3import \"DPI-C\" function integer f();", "import"),
        ] {
            assert_eq!(judged(text), Err(TokenFault::Outside(word.to_owned())), "{text}");
        }
        assert_eq!(judged("import p::*; import q::f;"), Ok(()));
        assert_eq!(judged("x = \\$signed (a); \\$_AND_ g (); \\a$b c;"), Ok(()));
    }

    #[test]
    fn nets_without_a_driver_are_refused() {
        for (text, word) in [
            ("module m(inout a);", "inout"),
            ("assign q = s ? a : 1'bz;", "'bz"),
            ("assign q = 4'b1??0;", "'b1??0"),
            ("assign q = 'z;", "'z"),
            ("case (s) 2'b1z: q = 1; endcase", "'b1z"),
            ("casez (s) 2'b1z: q = 1'bz; endcase", "'bz"),
            ("casez (s) 2'b1z: q = {f(a), 1'bz}; endcase", "'bz"),
            ("casez (s) 2'b1z: q = a ? b : 1'bz; endcase", "'bz"),
            ("casez (s) 2'b1z: {q, r} = {a, 1'bz}; endcase", "'bz"),
            ("casez (s) 2'b1z: begin q = 1; end endcase assign q = 1'bz;", "'bz"),
            ("tri1 q;", "tri1"),
        ] {
            assert_eq!(judged(text), Err(TokenFault::HighImpedance(word.to_owned())), "{text}");
        }
    }

    #[test]
    fn wildcards_of_labels_and_arguments_of_tasks_are_left_alone() {
        for text in [
            "casez (f(s)) 4'b1???, 4'b01zz: begin q = 1; end 2'd3: r = 1; 4'b001?: q = 2; default: q = 1'bx; endcase",
            "casex ({a, b}) {1'b1, 2'b?0}, 2'b?1: case (c) 1: q = 1; endcase 2'bz0: q = 0; endcase",
            "task t(input a); endtask module m(input a, output b); assign b = $signed(a) > $clog2(8); endmodule",
        ] {
            assert_eq!(judged(text), Ok(()), "{text}");
        }
    }

    #[test]
    fn a_base_does_not_find_its_digits_elsewhere() {
        assert_eq!(judged("task t(inout a); endtask"), Err(TokenFault::InOutArgument));
        assert_eq!(judged("x = 1'sb"), Err(TokenFault::NoDigits("'sb".to_owned())));
    }
}
