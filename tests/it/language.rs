//! The language from outside: the prelude, the gallery, the manual.

use nbc_base::diag::render;
use nbc_base::model::Palette;
use nbc_base::source::Sources;
use nbc_lang::check::{self};
use nbc_session::Session;
use nbc_session::store::DiskWorld;

use crate::support::*;

#[test]
fn the_prelude_has_the_papers_palette() {
    let program = sound("a.nb", "circuit inverter(a) -> (q) { q = not a }");
    assert_eq!(program.evolution("gates").unwrap().palette, Palette::paper());
    assert_eq!(program.stimuli, ["s1", "s2"]);
}

#[test]
fn right_programs_are_read_without_a_word_and_do_what_their_tests_say() {
    for path in programs("tests/right") {
        let text = fs::read_to_string(&path).unwrap();
        let program = sound(path.to_str().unwrap(), &text);
        program.tests.iter().for_each(|test| passes(&program, test));
    }
}

#[test]
fn the_materials_of_three_stimuli_are_those_that_the_library_declares() {
    let program = sound("three.nb", &text_of("library/three.nb"));
    assert_eq!(program.evolution("three_gates").unwrap().palette, Palette::three());
    assert_eq!(Palette::three().inputs(), 3);
    assert_eq!(Palette::three().materials()[..8], *Palette::paper().materials());
}

#[test]
fn the_prelude_is_read_extended_and_redeclared() {
    let read = Bench::new().run("explain prelude");
    assert!(read.out.contains("material muscle ") && read.out.contains("schedule sweep("), "{}", read.out);

    let extended = sound(
        "a.nb",
        "stimulus s3
         material ear { kind: sensor, stimulus: s3, absent: 0.6, present: 1.6 }
         material whisk { kind: actuator, drive: sine, period: 42 steps, range: 0.8..1.4 }
         evolution wide { box: 7 x 7, materials: [bone, whisk], seed: 2 }
         evolution wider { from: wide, box: 9 x 7 }",
    );
    assert_eq!(extended.stimuli, ["s1", "s2", "s3"]);
    let [gates, wide, wider] = ["gates", "wide", "wider"].map(|name| extended.evolution(name).unwrap());
    assert_eq!((wide.width, wide.palette.materials().len(), wide.generations), (7, 2, gates.generations));
    assert_eq!((wider.width, wider.height, &wider.seeds), (9, 7, &vec![2]));

    let redeclared = sound(
        "a.nb",
        "evolution gates { batch: 4, materials: [bone, muscle] }
         material muscle { kind: actuator, drive: sine, period: 42 steps, range: 0.8..1.4 }
         circuit half_adder(a, b) -> (s, c) { s = a or b
 c = a and b }
         circuit full(a, b) -> (q, r) { (q, _) = half_adder(a, b)
 (r, _) = full_adder(a, b, 0) }
         test full for all inputs { q = a or b
 r = a xor b }",
    );
    let own = redeclared.evolution("gates").unwrap();
    assert_eq!((own.batch, own.generations, own.palette.materials().len()), (4, 3000, 2));
    assert_eq!(redeclared.evolutions.len(), 1, "what is declared again replaces the prelude's");
    assert_eq!(own.palette.materials()[1], *redeclared.materials.last().unwrap());
    // Standard circuits still use the original standard circuits.
    passes(&redeclared, &redeclared.tests[0]);
}

#[test]
fn every_test_of_the_gallery_passes_at_the_level_of_logic() {
    for path in programs("circuits") {
        let mut sources = Sources::default();
        let file = check::open(&DiskWorld, path.to_str().unwrap(), &mut sources).unwrap();
        let checked = check::check(&DiskWorld, &mut sources, file);
        assert!(checked.diagnostics.is_empty(), "{}", render::text(&checked.diagnostics, &sources, false));
        assert!(!checked.program.tests.is_empty(), "{} has tests", path.display());
        for test in &checked.program.tests {
            passes(&checked.program, test);
        }
        performs(&mut Session::new(DiskWorld), path.to_str().unwrap());
    }
}
