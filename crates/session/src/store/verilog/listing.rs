//! The text that Yosys reads, and where its lines come from.

use crate::store::verilog::checker::{TokenChecker, TokenFault};
use crate::store::verilog::modules::ModuleList;
use crate::store::verilog::source::{Reader, Source};
use crate::store::verilog::token::{TokenPlace, VerilogToken, VerilogTokenKind};
use nbc_base::source::{VerilogError, VerilogName, VerilogPlace};

/// A text that reads no files and runs no programs.
pub(super) struct VerilogListing {
    pub(super) text: String,
    /// The place of each line.
    pub(super) lines: Vec<VerilogPlace>,
    /// The modules that are not in the text, because they have no outputs.
    pub(super) left_out: Vec<VerilogName>,
    /// The modules with outputs that no other of them names.
    pub(super) tops: Vec<String>,
    /// The parameters of the wanted module, or of the only one of these.
    pub(super) parameters: Vec<String>,
}

impl VerilogListing {
    /// The text of a file, with the files that it includes. A wanted module is in it, whatever its outputs.
    ///
    /// # Errors
    /// When it could lead to other files or programs, or is not Verilog for circuits.
    pub(super) fn of(path: &str, text: &str, top: Option<&str>, read: Reader<'_>) -> Result<Self, VerilogError> {
        let mut source = Source::new(path, text, read);
        let mut checker = TokenChecker::default();
        let mut listing = Self {
            text: String::new(),
            lines: Vec::new(),
            left_out: Vec::new(),
            tops: Vec::new(),
            parameters: Vec::new(),
        };
        let mut modules = ModuleList::default();
        let mut last = None;
        while let Some(token) = source.next()? {
            let start = listing.write(&token, &mut last, &source);
            modules.see(&token, start..listing.text.len(), || source.place(token.place));
            if let Err(fault) = checker.see(&token) {
                modules.fault(refused(fault, source.place(token.place)))?;
            }
        }
        listing.text.push('\n');
        listing.tops = modules.tops();
        let wanted = top.or(listing.tops.first().map(String::as_str));
        listing.parameters = wanted.map_or_else(Vec::new, |top| modules.parameters(top));
        listing.left_out = modules.leave_out(top, &mut listing.text)?;
        Ok(listing)
    }

    /// Writes a token, and returns where it begins.
    fn write(&mut self, token: &VerilogToken, last: &mut Option<TokenPlace>, source: &Source<'_>) -> usize {
        if *last != Some(token.place) {
            if last.is_some() {
                self.text.push('\n');
            }
            self.lines.push(source.place(token.place));
            *last = Some(token.place);
        } else if token.is_spaced {
            self.text.push(' ');
        }
        let start = self.text.len();
        // Yosys counts the lines of what it reads, so a token has none.
        self.text.extend(token.text.chars().map(|c| if matches!(c, '\n' | '\r') { ' ' } else { c }));
        if token.kind == VerilogTokenKind::Escaped {
            self.text.push(' ');
        }
        start
    }

    /// The place of a line, from 1.
    pub(super) fn place(&self, line: usize) -> Option<VerilogPlace> {
        self.lines.get(line.checked_sub(1)?).cloned()
    }
}

fn refused(fault: TokenFault, place: VerilogPlace) -> VerilogError {
    use nbc_base::source::VerilogFault;
    match fault {
        TokenFault::Outside(word) => VerilogError::Outside { place, word },
        TokenFault::HighImpedance(construct) => VerilogError::HighImpedance { place, construct },
        TokenFault::NoDigits(base) => VerilogError::Unclear { place, fault: VerilogFault::NoDigits { base } },
    }
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeMap;

    use proptest::prelude::*;

    use super::*;
    use nbc_base::source::{FileError, VerilogFault};

    const WORDS: [&str; 30] = [
        "module",
        "endmodule",
        "m",
        "(",
        ")",
        "input",
        ";",
        "`define",
        "`A",
        "A",
        "`include",
        "`ifdef",
        "`else",
        "`endif",
        "`undef",
        "\"a\"",
        "\"",
        "//",
        "/*",
        "*/",
        "\\",
        "\\\n",
        "4'b",
        "1z",
        "?",
        "case",
        "$readmemh",
        "#",
        "é",
        "import",
    ];

    fn listed(text: &str, files: &[(&str, &str)]) -> Result<VerilogListing, VerilogError> {
        let files: BTreeMap<_, _> = files.iter().copied().collect();
        let read = |path: &str| files.get(path).map(|text| (*text).to_owned()).ok_or(FileError::NotFound);
        VerilogListing::of("d/a.v", text, None, &read)
    }

    fn written(text: &str) -> Result<String, VerilogFault> {
        match listed(text, &[]) {
            Ok(listing) => Ok(listing.text.trim_end().to_owned()),
            Err(VerilogError::Unclear { fault, .. }) => Err(fault),
            Err(other) => panic!("{other:?}"),
        }
    }

    #[test]
    fn comments_go_and_words_around_them_stay_two() {
        assert_eq!(written("a/* x */b<=c // d\n;").unwrap(), "a b<=c\n;");
        assert_eq!(written("\\q[0] (x)/*\n*/y").unwrap(), "\\q[0]  (x)\ny");
    }

    #[test]
    fn macros_are_expanded() {
        for (text, expected) in [
            ("`define W 8\ninput [`W-1:0]a", "input [ 8 -1:0]a"),
            (
                "`define MAX(a, b = 2) ((a)>(b)?a:b)\n`MAX(`MAX(1),3)",
                "(( (( 1)>( 2)? 1: 2) )>( 3)? (( 1)>( 2)? 1: 2) : 3)",
            ),
            ("`define A b\n`define B `A`A\nx`B`A y", "x b b b y"),
            ("`define A\n`ifdef A\n1\n`else\n2\n`endif\n`undef A\n`ifndef A\n3\n`elsif YOSYS\n4\n`endif", "1\n3"),
            ("`ifdef NO\n`define A `endif\n`ifdef YOSYS\n1\n`else\n2\n`endif\n`else\n3\n`endif", "3"),
            ("`define LONG a \\\n b // c\n`LONG", "a b"),
            ("`timescale 1ns/1ps\n`default_nettype none\n`celldefine a", "`default_nettype none\na"),
            ("a // synopsys translate_off\n`NO $system\n// synthesis translate_on\nb", "a\nb"),
        ] {
            assert_eq!(written(text).as_deref(), Ok(expected), "{text}");
        }
    }

    #[test]
    fn macros_do_not_hide_what_is_refused() {
        for (text, word) in [
            ("`define I import\n`define D \"DPI-C\"\n\n`I `D function f;", "import"),
            ("`define M(a) $a\n`M(readmemh)", "$a"),
            ("`define S $system\n\n\n`S", "$system"),
        ] {
            let line = text.lines().count();
            match listed(text, &[]) {
                Err(VerilogError::Outside { place, word: found }) => {
                    assert_eq!((place.line, found.as_str()), (line, word), "{text}");
                }
                other => panic!("{text}: {:?}", other.map(|listing| listing.text)),
            }
        }
    }

    #[test]
    fn faults_of_the_preprocessor_are_told() {
        let directive = |word: &str, expected| VerilogFault::Directive { word: word.to_owned(), expected };
        for (text, fault) in [
            ("`NO", VerilogFault::Undefined { word: "`NO".to_owned() }),
            ("a``b", VerilogFault::Undefined { word: "`".to_owned() }),
            ("`define A `A\n`A", VerilogFault::TooDeep),
            ("`ifdef A", VerilogFault::OpenCondition),
            ("`endif", VerilogFault::NoCondition { word: "`endif".to_owned() }),
            ("`define 1", directive("`define", "a name")),
            ("`define A(a) a\n`A(1, 2)", VerilogFault::Arguments { word: "`A".to_owned(), expected: 1 }),
            ("`define A(a) a\n`A", directive("`A", "arguments in parentheses")),
            ("`include <a>", directive("`include", "a path in quotes")),
        ] {
            assert_eq!(written(text), Err(fault), "{text}");
        }
    }

    #[test]
    fn macros_that_double_are_too_much() {
        let double = |n: usize| format!("`define M{} `M{n} `M{n}\n", n + 1);
        let text: String = std::iter::once("`define M0 x\n".to_owned()).chain((0..40).map(double)).collect();
        assert_eq!(written(&format!("{text}`M40")), Err(VerilogFault::TooMuch { megabytes: 64 }));
    }

    #[test]
    fn lines_lead_back_to_the_files_that_they_come_from() {
        let included = [("d/p/b.vh", "b1\n`include \"c.vh\"\nb3"), ("d/p/c.vh", "c1")];
        let listing = listed("\n\na3\n`include \"p/b.vh\"\na5", &included).unwrap();
        assert_eq!(listing.text, "a3\nb1\nc1\nb3\na5\n");
        let places: Vec<_> = listing.lines.iter().map(|place| (place.file.as_str(), place.line)).collect();
        assert_eq!(places, [("d/a.v", 3), ("d/p/b.vh", 1), ("d/p/c.vh", 1), ("d/p/b.vh", 3), ("d/a.v", 5)]);
        assert_eq!(listing.place(2).unwrap().file, "d/p/b.vh");
        let place = VerilogPlace { file: "d/a.v".to_owned(), line: 2 };
        let missing = VerilogError::Include { place, path: "no.vh".to_owned(), error: FileError::NotFound };
        assert_eq!(listed("\n`include \"no.vh\"", &included).err(), Some(missing));
    }

    proptest! {
        #[test]
        fn any_text_is_listed_or_refused(
            words in prop::collection::vec(prop::sample::select(WORDS.to_vec()), 0..60),
            spaces in prop::sample::select(vec!["", " ", "\n"]),
        ) {
            let text = words.join(spaces);
            let read = |_: &str| -> Result<String, FileError> { Ok("`include \"a\"\n`define A `A".to_owned()) };
            if let Ok(listing) = VerilogListing::of("m.v", &text, None, &read) {
                prop_assert!(listing.place(listing.text.lines().count() + 1).is_none());
            }
        }
    }
}
