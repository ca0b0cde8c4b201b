//! Any text is checked without a panic. The circuits of tests of a program without errors are elaborated.
#![no_main]

use libfuzzer_sys::fuzz_target;
use nbc_lang::check;
use nbc_circuit::elaborate;
use nbc_base::diag::{json, render};
use nbc_base::source::{MemoryWorld, Sources};

fuzz_target!(|text: &str| {
    let mut sources = Sources::default();
    let file = sources.add("main.nb", text);
    let checked = check::check(&MemoryWorld::default(), &mut sources, file);
    render::text(&checked.diagnostics, &sources, false);
    json(&checked.diagnostics, &sources);
    if !checked.has_errors() {
        for test in &checked.program.tests {
            elaborate(&checked.program, &test.circuit).expect("the circuit of a test of a sound program is elaborated");
        }
    }
});
