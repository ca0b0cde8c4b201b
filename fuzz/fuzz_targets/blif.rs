//! Any text is read as BLIF or rejected. A design that is read is the same after writing and reading it.
#![no_main]

use libfuzzer_sys::fuzz_target;
use nbc_circuit::formats::blif;
use nbc_base::diag::render;
use nbc_base::source::Sources;

fuzz_target!(|text: &str| {
    let mut sources = Sources::default();
    let file = sources.add("a.blif", text);
    match blif::read(text, file, Some("clk")) {
        Ok(design) => {
            let written = blif::write(&design);
            let file = sources.add("again.blif", written.clone());
            let again = blif::read(&written, file, Some("clk")).expect("a written design can be read");
            nbc_fuzz::same_design(&design, &again);
        }
        Err(faults) => {
            render::text(&faults, &sources, false);
        }
    }
});
