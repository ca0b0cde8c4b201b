//! Leaves out statements that only print, which mean nothing to a circuit.

use crate::verilog::token::{VerilogToken, VerilogTokenKind};

/// System tasks that print, write what was printed, or end a simulation; `$display` stands for `$displayb` too.
const PRINTING: [&str; 22] = [
    "$display",
    "$write",
    "$strobe",
    "$monitor",
    "$fdisplay",
    "$fwrite",
    "$fstrobe",
    "$fmonitor",
    "$monitoron",
    "$monitoroff",
    "$dumpfile",
    "$dumpvars",
    "$dumpon",
    "$dumpoff",
    "$dumpall",
    "$dumplimit",
    "$dumpflush",
    "$finish",
    "$stop",
    "$timeformat",
    "$printtimescale",
    "$fflush",
];
/// Tasks that print in a procedure, and stop the translation elsewhere.
const REPORTING: [&str; 4] = ["$error", "$fatal", "$info", "$warning"];

/// The state that follows from the tokens so far.
#[derive(Debug, Default)]
pub(super) struct PrintFilter {
    /// Whether a statement is being left out, and its parentheses that are open.
    leaving: Option<usize>,
    /// The statement of a procedure, if one is open.
    procedure: Option<Procedure>,
}

#[derive(Debug, Default)]
struct Procedure {
    /// `begin`, `case` and parentheses that are open.
    depth: usize,
    /// Whether only `else` goes on with it.
    may_end: bool,
    /// Whether `endtask` or `endfunction` ends it.
    is_named: bool,
}

impl PrintFilter {
    /// Whether the next token is in a statement of a procedure.
    pub(super) fn is_in_procedure(&self) -> bool {
        self.procedure.as_ref().is_some_and(|open| !open.may_end)
    }

    /// Whether the next token is part of such a statement.
    pub(super) fn leaves_out(&mut self, token: &VerilogToken) -> bool {
        let text = token.text.as_str();
        if let Some(depth) = &mut self.leaving {
            match text {
                _ if token.kind != VerilogTokenKind::Sign => {}
                "(" => *depth += 1,
                ")" => *depth = depth.saturating_sub(1),
                ";" if *depth == 0 => {
                    self.leaving = None;
                    self.follow(token);
                    return false;
                }
                _ => {}
            }
            return true;
        }
        if token.kind == VerilogTokenKind::System {
            let plain = text.trim_end_matches(['b', 'h', 'o']);
            let prints = PRINTING.contains(&text) || PRINTING[..8].contains(&plain);
            if prints || self.procedure.is_some() && REPORTING.contains(&text) {
                self.leaving = Some(0);
                return true;
            }
        }
        self.follow(token);
        false
    }

    fn follow(&mut self, token: &VerilogToken) {
        let word = match token.kind {
            VerilogTokenKind::Word | VerilogTokenKind::Sign => token.text.as_str(),
            _ => "",
        };
        if self.procedure.as_ref().is_some_and(|open| open.may_end && word != "else") {
            self.procedure = None;
        }
        let Some(open) = &mut self.procedure else {
            let is_named = matches!(word, "task" | "function");
            if is_named || matches!(word, "initial" | "always" | "always_comb" | "always_ff" | "always_latch") {
                self.procedure = Some(Procedure { is_named, ..Procedure::default() });
            }
            return;
        };
        open.may_end = false;
        match word {
            "begin" | "case" | "casex" | "casez" | "fork" | "(" => open.depth += 1,
            "end" | "endcase" | "join" | ")" => {
                open.depth = open.depth.saturating_sub(1);
                open.may_end = open.depth == 0 && word != ")" && !open.is_named;
            }
            ";" => open.may_end = open.depth == 0 && !open.is_named,
            "endtask" | "endfunction" | "endmodule" => self.procedure = None,
            _ => {}
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::verilog::token::{Lexer, TokenPlace};

    fn kept(text: &str) -> String {
        let (mut lexer, mut filter) = (Lexer::new(text, TokenPlace::default()), PrintFilter::default());
        let mut kept = Vec::new();
        while let Some(token) = lexer.next().unwrap() {
            if !filter.leaves_out(&token) {
                kept.push(token.text);
            }
        }
        kept.join(" ")
    }

    #[test]
    fn what_only_prints_is_left_out() {
        for (text, expected) in [
            ("initial $display(\"a;\", f(x)); assign q = a;", "initial ; assign q = a ;"),
            (
                "always @(posedge c) begin if (a) $finish; else q <= a; $strobeh(\"x\"); end",
                "always @ ( posedge c ) begin if ( a ) ; else q <= a ; ; end",
            ),
            (
                "always @* if (a) $error(\"x\"); else q = 1; if (N > 2) $error(\"y\");",
                "always @ * if ( a ) ; else q = 1 ; if ( N > 2 ) $error ( \"y\" ) ;",
            ),
            ("task t; begin $info(\"x\"); end endtask $fatal(1);", "task t ; begin ; end endtask $fatal ( 1 ) ;"),
            ("x = $signed(a) + $clog2(8);", "x = $signed ( a ) + $clog2 ( 8 ) ;"),
        ] {
            assert_eq!(kept(text).replace("< =", "<="), expected, "{text}");
        }
    }
}
