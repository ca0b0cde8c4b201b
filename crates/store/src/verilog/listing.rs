//! The text that Yosys reads, and where its lines come from.

use std::collections::BTreeMap;
use std::ops::Range;

use crate::verilog::assertions::{AssertionFilter, Kept};
use crate::verilog::checker::{TokenChecker, TokenFault};
use crate::verilog::modules::ModuleList;
use crate::verilog::parameter::ParameterValue;
use crate::verilog::printing::PrintFilter;
use crate::verilog::source::{Reader, Source};
use crate::verilog::token::{TokenPlace, VerilogToken, VerilogTokenKind};
use nbc_base::source::{VerilogError, VerilogFile, VerilogName, VerilogPlace};
use nbc_circuit::CancelFlag;

/// What is to be listed.
#[derive(Clone, Copy)]
pub(super) struct ListingRequest<'a> {
    pub(super) files: &'a [VerilogFile<'a>],
    /// The wanted module.
    pub(super) top: Option<&'a str>,
    pub(super) parameters: &'a BTreeMap<String, ParameterValue>,
    pub(super) read: Reader<'a>,
    pub(super) cancel: &'a CancelFlag,
}

/// A text that reads no files and runs no programs.
pub(super) struct VerilogListing {
    /// What was written, without directives and without statements that only print.
    pub(super) text: String,
    /// Hints for synthesizers, each kind once.
    pub(super) hints: Vec<VerilogName>,
    /// The place of each line.
    pub(super) lines: Vec<VerilogPlace>,
    /// The modules that are not in the text, because they have no outputs.
    pub(super) left_out: Vec<VerilogName>,
    /// The modules with outputs that no other of them names.
    pub(super) tops: Vec<String>,
    /// The parameters of the wanted module, or of the only one of these.
    pub(super) parameters: Vec<String>,
    /// The places of assignments to nets, by module and name.
    pub(super) assigned: BTreeMap<(String, String), Vec<VerilogPlace>>,
}

impl VerilogListing {
    /// The text of some files, with those that they include. A wanted module is in it, whatever its outputs.
    ///
    /// # Errors
    /// When it could lead to other files or programs, or is not Verilog for circuits.
    pub(super) fn of(request: &ListingRequest<'_>) -> Result<Self, VerilogError> {
        let &ListingRequest { files, top, parameters, read, cancel } = request;
        let mut source = Source::new(files, read, cancel);
        let (mut checker, mut filter) = (TokenChecker::default(), PrintFilter::default());
        let mut listing = Self {
            text: String::new(),
            hints: Vec::new(),
            lines: Vec::new(),
            left_out: Vec::new(),
            tops: Vec::new(),
            parameters: Vec::new(),
            assigned: BTreeMap::new(),
        };
        let mut modules = ModuleList::default();
        let mut assertions = AssertionFilter::default();
        let (mut last, mut written) = (None, [0..0, 0..0]);
        while let Some(mut token) = source.next()? {
            match assertions.see(&token, filter.is_in_procedure()) {
                Kept::As => {}
                Kept::Not => continue,
                Kept::Instead { text, has_label } => {
                    listing.note(&token.text, &token, &source);
                    if has_label {
                        written.iter().for_each(|label| listing.blank(label.clone()));
                    }
                    if text.is_empty() {
                        continue;
                    }
                    let kind = if text == ";" { VerilogTokenKind::Sign } else { VerilogTokenKind::Word };
                    token = VerilogToken { kind, text: text.to_owned(), ..token };
                }
            }
            if filter.leaves_out(&token) {
                continue;
            }
            listing.hint(&token, &source);
            let start = listing.write(&token, &mut last, &source);
            written = [start..listing.text.len(), written[0].clone()];
            modules.see(&token, start..listing.text.len(), |at| source.place(at.place));
            if let Err(fault) = checker.see(&token) {
                modules.fault(refused(fault, source.place(token.place)))?;
            }
        }
        listing.text.push('\n');
        listing.tops = modules.tops();
        let wanted = top.or(listing.tops.first().map(String::as_str));
        listing.parameters = wanted.map_or_else(Vec::new, |top| modules.parameters(top));
        listing.assigned = modules.take_assigned();
        let values = match (parameters.is_empty(), top, &listing.tops[..]) {
            (true, ..) => Vec::new(),
            (_, Some(name), _) => modules.values(name, parameters)?,
            (_, None, [only]) => modules.values(only, parameters)?,
            (_, None, tops) => return Err(VerilogError::SeveralModules { known: tops.to_vec() }),
        };
        listing.left_out = modules.leave_out(top, &mut listing.text)?;
        listing.replace(values);
        Ok(listing)
    }

    /// Notes a hint for synthesizers, which a simulator ignores.
    fn hint(&mut self, token: &VerilogToken, source: &Source<'_>) {
        let text = token.text.as_str();
        let is_choice = matches!(text, "case" | "casez" | "casex" | "if");
        let hints: Vec<&str> = match token.kind {
            VerilogTokenKind::Hint => {
                ["full_case", "parallel_case"].into_iter().filter(|hint| text.contains(hint)).collect()
            }
            VerilogTokenKind::Word if matches!(text, "full_case" | "parallel_case") => vec![text],
            VerilogTokenKind::Word if is_choice => {
                let before = self.text.trim_end().rsplit(|c: char| !c.is_ascii_alphanumeric() && c != '_').next();
                before.filter(|word| ["unique", "unique0", "priority"].contains(word)).into_iter().collect()
            }
            _ => return,
        };
        for hint in hints.into_iter().map(str::to_owned).collect::<Vec<_>>() {
            self.note(&hint, token, source);
        }
    }

    /// Notes that a word of a token is taken otherwise than a simulator takes it, each word once.
    fn note(&mut self, hint: &str, token: &VerilogToken, source: &Source<'_>) {
        if !self.hints.iter().any(|known| known.name == hint) {
            self.hints.push(VerilogName { name: hint.to_owned(), place: Some(source.place(token.place)) });
        }
    }

    /// Writes spaces in the place of a token, which has no lines.
    fn blank(&mut self, token: Range<usize>) {
        let spaces = " ".repeat(token.len());
        self.text.replace_range(token, &spaces);
    }

    /// Writes values in the place of other texts. Lines stay where they are.
    fn replace(&mut self, mut values: Vec<(Range<usize>, String)>) {
        values.sort_by_key(|(range, _)| std::cmp::Reverse(range.start));
        for (range, value) in values {
            let lines = "\n".repeat(self.text[range.clone()].matches('\n').count());
            self.text.replace_range(range, &format!(" {value}{lines} "));
        }
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
        TokenFault::InOutArgument => VerilogError::Unclear { place, fault: VerilogFault::InOutArgument },
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
        list(&[VerilogFile { path: "d/a.v", text }], &read)
    }

    fn list(files: &[VerilogFile<'_>], read: Reader<'_>) -> Result<VerilogListing, VerilogError> {
        let (parameters, cancel) = (&BTreeMap::new(), &CancelFlag::default());
        VerilogListing::of(&ListingRequest { files, top: None, parameters, read, cancel })
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
            ("`define CAT(a, b) a``b``_1 x\n`CAT(t, 1) `CAT(, u) `CAT(4, 'b1)", "t1_1 x u_1 x 4'b1_1 x"),
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
            ("a``b", VerilogFault::Undefined { word: "``".to_owned() }),
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
        assert_eq!(written(&format!("{text}`M40")), Err(VerilogFault::TooMuch { megabytes: 8 }));
    }

    #[test]
    fn files_that_include_each_other_often_are_too_much() {
        let names: Vec<String> = (0..15).map(|n| format!("d/i{n}.vh")).collect();
        let texts: Vec<String> = (1..=15).map(|n| format!("`include \"i{n}.vh\"\n").repeat(10)).collect();
        let mut files: Vec<_> = names.iter().map(String::as_str).zip(texts.iter().map(String::as_str)).collect();
        files.push(("d/i15.vh", ""));
        match listed("`include \"i0.vh\"", &files) {
            Err(VerilogError::Unclear { fault: VerilogFault::TooManyFiles { most: 4096 }, .. }) => {}
            other => panic!("{:?}", other.map(|listing| listing.text)),
        }
    }

    #[test]
    fn a_listing_that_nobody_waits_for_ends() {
        let cancel = CancelFlag::default();
        cancel.raise();
        let (files, parameters) = (&[VerilogFile { path: "a.v", text: "a" }], &BTreeMap::new());
        let read = &|_: &str| Err(FileError::NotFound);
        let listed = VerilogListing::of(&ListingRequest { files, top: None, parameters, read, cancel: &cancel });
        assert_eq!(listed.err(), Some(VerilogError::Cancelled));
    }

    #[test]
    fn several_files_are_one_text_with_the_macros_of_those_before() {
        let files = [
            VerilogFile { path: "a.v", text: "`define W 4\nmodule a(output q); endmodule" },
            VerilogFile { path: "b.v", text: "module b(output [`W:0] q); a u(q[0]); endmodule" },
        ];
        let listing = list(&files, &|_| Err(FileError::NotFound)).unwrap();
        assert_eq!(listing.tops, ["b"]);
        assert_eq!(listing.place(2), Some(VerilogPlace { file: "b.v".into(), line: 1 }));
    }

    #[test]
    fn parameters_have_their_values_in_the_place_of_their_defaults() {
        let text = "module a #(parameter N = 2 +\n (3), parameter signed [3:0] M = f(1, 2)) (output q);\n\
                    parameter K = 1, L = {2{1'b1}}; localparam P = 1; endmodule \
                    module b #(Q = 1) (output r); endmodule";
        let listed = |top, values: &[(&str, &str)]| {
            let parameters = values.iter().map(|(name, value)| ((*name).to_owned(), value.parse().unwrap())).collect();
            let (files, cancel) = (&[VerilogFile { path: "a.v", text }], &CancelFlag::default());
            let read = &|_: &str| Err(FileError::NotFound);
            VerilogListing::of(&ListingRequest { files, top, parameters: &parameters, read, cancel })
        };
        let listing = listed(Some("a"), &[("N", "-2"), ("M", "4'd3"), ("L", "7")]).unwrap();
        let expected = "module a #(parameter N = -2\n , parameter signed [3:0] M = 4'd3 ) (output q);\n\
                        parameter K = 1, L = 7 ; localparam P = 1; endmodule";
        assert!(listing.text.starts_with(expected), "{}", listing.text);
        assert!(listed(Some("b"), &[("Q", "3")]).unwrap().text.contains("#(Q = 3 )"));
        let known = ["K", "L", "M", "N"].map(str::to_owned).to_vec();
        let missing = VerilogError::NoParameter { parameter: "P".to_owned(), known };
        assert_eq!(listed(Some("a"), &[("P", "3")]).err(), Some(missing));
        let several = VerilogError::SeveralModules { known: vec!["a".to_owned(), "b".to_owned()] };
        assert_eq!(listed(None, &[("N", "3")]).err(), Some(several));
    }

    #[test]
    fn hints_are_noted_once() {
        let text = "case (s) // synopsys full_case parallel_case\n endcase (* parallel_case *) case (s) endcase \
                    unique case (s) endcase unique if (a) ;";
        let hints = listed(text, &[]).unwrap().hints;
        assert_eq!(
            hints.iter().map(|hint| hint.name.as_str()).collect::<Vec<_>>(),
            ["full_case", "parallel_case", "unique"]
        );
    }

    #[test]
    fn lines_lead_back_to_the_files_that_they_come_from() {
        let included = [("d/p/b.vh", "b1\n`include \"c.vh\"\nb3"), ("d/p/c.vh", "c1")];
        let listing = listed("\n\na3\n`include \"p/b.vh\"\na5", &included).unwrap();
        assert_eq!(listing.text, "a3\nb1\nc1\nb3\na5\n");
        let places: Vec<_> = listing.lines.iter().map(|place| (&*place.file, place.line)).collect();
        assert_eq!(places, [("d/a.v", 3), ("d/p/b.vh", 1), ("d/p/c.vh", 1), ("d/p/b.vh", 3), ("d/a.v", 5)]);
        assert_eq!(&*listing.place(2).unwrap().file, "d/p/b.vh");
        let place = VerilogPlace { file: "d/a.v".into(), line: 2 };
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
            if let Ok(listing) = list(&[VerilogFile { path: "m.v", text: &text }], &read) {
                prop_assert!(listing.place(listing.text.lines().count() + 1).is_none());
            }
        }
    }
}
