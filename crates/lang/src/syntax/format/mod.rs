//! From the tree to formatted text. Comments are kept. Formatting twice changes nothing, and the tree stays the same
//! except for places.

mod circuit;
mod expression;
mod layout;
mod printer;
mod prove;
mod record;
mod rows;

use std::sync::Arc;

use crate::syntax::format::layout::WIDTH;
use crate::syntax::format::printer::Printer;
use crate::syntax::tree::{Declaration, DeclarationKind, SizeSyntaxId, Text, Tree};
use nbc_base::source::{FileId, Sources};

/// The formatted text of a file that was parsed without errors.
///
/// # Panics
/// When a comment would be lost, which is a bug of this function.
pub fn format(sources: &Sources, file: FileId, tree: &Tree) -> String {
    let mut printer = Printer::new(&sources.file(file).text, &tree.comments);
    let mut at = 0;
    while at < tree.declarations.len() {
        at += printer.declarations(&tree.declarations[at..]);
    }
    printer.finish()
}

impl Printer<'_> {
    /// Prints the first declaration, or all adjacent one-line records at the start; returns how many.
    fn declarations(&mut self, rest: &[Arc<Declaration>]) -> usize {
        let run = self.record_run(rest);
        if !run.is_empty() {
            for (declaration, text) in rest.iter().zip(&run) {
                self.item(declaration.span, |printer| printer.write(text));
            }
            return run.len();
        }
        let declaration = &rest[0];
        let long = !matches!(
            declaration.kind,
            DeclarationKind::Use(_) | DeclarationKind::Stimulus(_) | DeclarationKind::Let(_) | DeclarationKind::File(_)
        );
        self.separate(long);
        self.item_with_inside(declaration.span, head_end(declaration), |printer| printer.declaration(declaration));
        self.separate_next(long);
        1
    }

    fn declaration(&mut self, declaration: &Declaration) {
        match &declaration.kind {
            DeclarationKind::Use(paths) => self.used(paths),
            DeclarationKind::Stimulus(stimuli) => self.write(&format!("stimulus {}", rows::stimuli(stimuli))),
            DeclarationKind::Record(record) => self.record_declaration(record),
            DeclarationKind::Schedule(schedule) => self.schedule(schedule, declaration.span),
            DeclarationKind::Simulate(simulate) => self.simulate(simulate, declaration.span),
            DeclarationKind::Circuit(circuit) => self.circuit(circuit, declaration.span),
            DeclarationKind::Enumeration(enumeration) => self.enumeration(enumeration, declaration.span),
            DeclarationKind::Let(integer) => {
                let value = expression::size(&integer.sizes, SizeSyntaxId(integer.sizes.len() as u32 - 1));
                self.write(&format!("let {} = {value}", integer.name.text));
            }
            DeclarationKind::File(file) => self.write(&format!("file {} = \"{}\"", file.name.text, file.path.text)),
            DeclarationKind::Prove(prove) => self.prove(prove, declaration.span),
            DeclarationKind::Test(test) => self.test(test, declaration.span),
        }
    }

    /// On one line if it fits, else a line for each file.
    fn used(&mut self, paths: &[Text]) {
        let paths: Vec<String> = paths.iter().map(|path| format!("\"{}\"", path.text)).collect();
        let flat = format!("use {}", paths.join(", "));
        let is_short = paths.len() == 1 || flat.chars().count() <= WIDTH;
        self.write(&if is_short { flat } else { format!("use {}", paths.join(",\n    ")) });
    }
}

/// The end of the part that is printed as one piece; comments before it are printed before the declaration.
fn head_end(declaration: &Declaration) -> u32 {
    use crate::syntax::tree::{TestKind, With};
    let first = |spans: Vec<u32>| spans.first().copied().unwrap_or(declaration.span.end);
    match &declaration.kind {
        DeclarationKind::Circuit(circuit) => first(circuit.body.statements.iter().map(|one| one.span.start).collect()),
        DeclarationKind::Enumeration(one) => first(one.members.iter().map(|one| one.name.span.start).collect()),
        DeclarationKind::Schedule(schedule) => first(schedule.spells.iter().map(|one| one.span.start).collect()),
        DeclarationKind::Record(record) => first(record.record.fields.iter().map(|one| one.name.span.start).collect()),
        DeclarationKind::Simulate(simulate) => match &simulate.with {
            With::Named(_) => declaration.span.end,
            With::Spells { spells, .. } => first(spells.iter().map(|one| one.span.start).collect()),
        },
        DeclarationKind::Prove(prove) => first(prove.properties.iter().map(|one| one.span.start).collect()),
        DeclarationKind::Test(test) => match &test.kind {
            TestKind::Table(table) => table.header.start,
            TestKind::Against(_) | TestKind::Ever(_) | TestKind::FromFile { .. } => declaration.span.end,
            TestKind::Reference(body) => first(body.statements.iter().map(|one| one.span.start).collect()),
        },
        _ => declaration.span.end,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::syntax::parse;

    fn formatted(text: &str) -> String {
        let mut sources = Sources::default();
        let file = sources.add("a.nb", text);
        let parsed = parse(&sources, file);
        assert_eq!(parsed.errors, [], "{text}");
        format(&sources, file, &parsed.tree)
    }

    fn check(text: &str, expected: &str) {
        assert_eq!(formatted(text), expected);
        assert_eq!(formatted(expected), expected, "formatting twice changes nothing");
    }

    #[test]
    fn statements_are_aligned_and_spaced() {
        check(
            "circuit  f( a,b )->( q ,r){q=nand( a,b)\n\n\n nq   = not q\n r=if a then b else(  a  and b)}",
            "circuit f(a, b) -> (q, r) {\n    q = nand(a, b)\n\n    nq = not q\n    r  = if a then b else (a and \
             b)\n}\n",
        );
    }

    #[test]
    fn comments_stay_with_their_declarations() {
        check(
            "// one\n\n// two\ncircuit f(a) -> (q) { // three\n  q = // four\n a // five\n // six\n}\n// seven",
            "// one\n\n// two\ncircuit f(a) -> (q) {\n    // three\n    // four\n    q = a  // five\n    // \
             six\n}\n// seven\n",
        );
    }

    #[test]
    fn tables_are_aligned() {
        check(
            "test add \"adds\" {\na b|s\n// zeros\n0000 0001 | 1 for 3 cycles\n1 0 | 1\n}",
            "test add \"adds\" {\n    a    b    | s\n    // zeros\n    0000 0001 | 1 for 3 cycles\n    1    0    | \
             1\n}\n",
        );
        check(
            "test ring {\n|q\n|- for 3 cycles\n|1\n}\nsimulate ring with schedule( ){for 9 cycles}",
            "test ring {\n    | q\n    | - for 3 cycles\n    | 1\n}\n\nsimulate ring with schedule () {\n    for 9 \
             cycles\n}\n",
        );
        check(
            "schedule s(a,b) { 0 1 for 10 cycles 1 1 for 9 steps }",
            "schedule s(a, b) {\n    0 1 for 10 cycles\n    1 1 for 9 steps\n}\n",
        );
    }

    #[test]
    fn records_that_fit_are_on_one_line() {
        check(
            "material bone {kind:rigid}\nmaterial antimuscle { kind : actuator\n range:0.6 .. 1.6 }",
            "material bone       { kind: rigid }\nmaterial antimuscle { kind: actuator, range: 0.6..1.6 }\n",
        );
        let table = "material bone       { kind: rigid }\n\
                     material muscle     { kind: actuator, period: 84 steps, phase:   0 deg, range: 0.6..1.6 }\n\
                     material antimuscle { kind: actuator, period:  9 steps, phase: 180 deg, range: 0.6..1.6 }\n\
                     material ear        { kind: sensor,   stimulus: s1,    absent:  1, present: 0.6 }\n\
                     material eye        { kind: actuator, stimulus: other, absent: 10, present:   1 }\n";
        check(table, table);
        let apart = "swarm a { circuit: c }\n\nswarm longer { circuit: c }\n";
        check(apart, apart);
        check(
            "world w{friction:90 %,gravity:1.1}\ntest f  in w{a|q\n0|1}\nsimulate s in  w with sweep",
            "world w { friction: 90%, gravity: 1.1 }\n\ntest f in w {\n    a | q\n    0 | 1\n}\n\nsimulate s in w with \
             sweep\n",
        );
        let long = "evolution gates {\n    box:         5 x 5\n    materials:   [bone, flesh, muscle, \
            antimuscle]\n    descriptors: \
                    [voxels in 4 bins, active in 4 bins, sensory in 4 bins, behavior]\n}\n";
        check(long, long);
    }

    #[test]
    fn tables_with_lines_keep_them() {
        let lines = "circuit f(a) -> (q) {\n    q = table(a) {\n        0:    1\n        else: 0\n    }\n}\n";
        check(lines, lines);
        let line = "circuit f(a) -> (q) {\n    q = table(a) { 0: 1, else: 0 }\n}\n";
        check("circuit f(a) -> (q) {\n q = table(a) { 0: 1,\n else: 0 } }", line);
    }

    #[test]
    fn comments_in_tables_stay_at_their_rows() {
        check(
            "circuit f(a, b) -> (q) {\n// before\nq = table(a, b) { // zeros\n00: 0 // nothing\n// ones\n11: table(a) \
             {0: 0 // low\n 1: 1}\nelse: 0,\n// the end\n} // behind\n// last\n}",
            "circuit f(a, b) -> (q) {\n    // before\n    q = table(a, b) {\n        // zeros\n        00:   0  // \
             nothing\n        // ones\n        11:   table(a) {\n            0: 0  // low\n            1: 1\n        \
             }\n        else: 0\n        // the end\n    }  // behind\n    // last\n}\n",
        );
        check(
            "circuit f(a) -> (q) { q = nand(a, // one\n table(a) { 0: 1\n// two\n else: 0 }) }",
            "circuit f(a) -> (q) {\n    // one\n    q = nand(\n        a,\n        table(a) {\n            0:    1\n \
             \x20          // two\n            else: 0\n        }\n    )\n}\n",
        );
    }

    #[test]
    fn long_expressions_are_broken_at_their_operands() {
        let name = "a_rather_long_name_of_a_net";
        let text = format!("circuit f(a) -> (q) {{ q = nand({name}, {name}, {name} and {name}) or {name} }}");
        let arguments = format!("            {name},\n            {name},\n            {name} and {name}\n");
        let expected = format!("circuit f(a) -> (q) {{\n    q = nand(\n{arguments}        )\n        or {name}\n}}\n");
        check(&text, &expected);
    }
}
