//! Several errors at once: an error in one declaration does not hide others, and JSON has the same messages as the
//! text.

use std::sync::OnceLock;

use nbc_base::diag::{Code, Diagnostic};
use nbc_base::source::{MemoryWorld, Sources};
use nbc_lang::check;
use proptest::prelude::*;

/// Declarations with one error each, whose names no other declaration uses. A word that begins no declaration is not
/// included, because it belongs to the previous one.
const BROKEN: &[(Code, &str)] = &[
    (Code::Ambiguous, "circuit f0(a, b, c) -> (q) { q = a nand b nand c }"),
    (Code::Duplicate, "circuit f1(a, a) -> (q) { q = a }"),
    (Code::Duplicate, "stimulus s7, s7"),
    (Code::LoopWithoutStart, "circuit f2(a) -> (q) { q = nand(a, q) }"),
    (Code::MissingField, "material m0 { kind: actuator, drive: sine, range: 0.6..1.6 }"),
    (Code::MissingField, "swarm w0 { library: shipped }"),
    (Code::MultipleDrivers, "circuit f3(a) -> (q) {\n q = a\n q = not a\n}"),
    (Code::Operands, "circuit f4(a) -> (q) { q = half_adder(a) }"),
    (Code::OutOfRange, "material m1 { kind: actuator, drive: sine, period: 84 steps, range: 0.6..1.7 }"),
    (Code::OutOfRange, "evolution e0 { box: 0 x 5 }"),
    (Code::OutOfRange, "evolution e1 { generations: 0 }"),
    (Code::Recursion, "circuit f5(a) -> (q) { q = f5(a) }"),
    (Code::RowWidth, "schedule c0(s1, s2) { 0 for 10 cycles }"),
    (Code::RowWidth, "test and_gate {\n a b | q\n 0 0 | 0 0\n}"),
    (Code::Syntax, "circuit f6(a) -> (q) { q = = a }"),
    (Code::Syntax, "circuit f7(a) -> q { q = a"),
    (Code::Syntax, "material m2 { kind rigid }"),
    (Code::TableIncomplete, "circuit f9(a) -> (q) { q = table(a) { 0: 1 } }"),
    (Code::TableOverlap, "circuit g0(a) -> (q) { q = table(a) { 0: 1, -: 0 } }"),
    (Code::Undriven, "circuit g1(a) -> (q, r) { q = a }"),
    (Code::Unit, "schedule c1(s1) { 0 for 10 }"),
    (Code::Unit, "material m3 { kind: actuator, drive: sine, period: 84 deg, range: 0.6..1.6 }"),
    (Code::Unknown, "circuit g2(a) -> (q) { q = b and a }"),
    (Code::Unknown, "library l0 { from: nowhere }"),
    (Code::Unknown, "simulate nobody with sweep"),
    (Code::Unknown, "test nobody {\n a | q\n 0 | 1\n}"),
    (Code::UnknownField, "material m4 { kind: rigid, color: red }"),
    (Code::Unused, "circuit g3(a, b) -> (q) { q = a }"),
    (Code::Value, "evolution e2 { genome: trees }"),
    (Code::Width, "circuit g4(a[2], b[3]) -> (q[2]) { q = a and b }"),
];

const SOUND: &str = "circuit and_gate(a, b) -> (q) { q = a and b }";

fn found(declarations: &[&str]) -> Vec<(Code, String)> {
    let mut sources = Sources::default();
    let file = sources.add("main.nb", declarations.join("\n\n"));
    let diagnostics = check::check(&MemoryWorld::default(), &mut sources, file).diagnostics;
    diagnostics.into_iter().map(|Diagnostic { code, message, .. }| (code, message)).collect()
}

fn alone() -> &'static [Vec<(Code, String)>] {
    static ALONE: OnceLock<Vec<Vec<(Code, String)>>> = OnceLock::new();
    ALONE.get_or_init(|| BROKEN.iter().map(|(_, text)| found(&[SOUND, text])).collect())
}

#[test]
fn each_error_is_found_alone() {
    for ((code, text), found) in BROKEN.iter().zip(alone()) {
        assert!(found.iter().all(|(found, _)| found == code) && !found.is_empty(), "{text}: {found:?}");
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 32, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn an_error_in_a_declaration_does_not_hide_others(
        order in Just((0..BROKEN.len()).collect::<Vec<_>>()).prop_shuffle(),
        count in 2..=BROKEN.len(),
    ) {
        let chosen: Vec<_> = order[..count].iter().map(|&at| BROKEN[at].1).collect();
        let together = found(&[&[SOUND], &chosen[..]].concat());
        for (text, alone) in order[..count].iter().map(|&at| (BROKEN[at].1, &alone()[at])) {
            for (code, message) in alone.iter().cloned() {
                // The right place of an unclosed or stray brace depends on the following text.
                let here = |found: &&(Code, String)| found.0 == code && (code == Code::Syntax || found.1 == message);
                prop_assert!(together.iter().any(|one| here(&one)), "{} of {} is not among \
                    {:?}", message, text, together);
            }
        }
        let syntax = |text: &&&str| found(&[SOUND, text])[0].0 == Code::Syntax;
        let slips = together.iter().filter(|(code, _)| *code == Code::Syntax).count();
        prop_assert!(slips >= chosen.iter().filter(syntax).count(), "each slip has a message: {:?}", together);
    }
}
