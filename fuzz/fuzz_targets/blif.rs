//! Any text is read as BLIF or refused, and what is read is written and read again as the same design.
#![no_main]

use libfuzzer_sys::fuzz_target;
use nbc::circuit::formats::blif;
use nbc::diag::render;
use nbc::source::Sources;

fuzz_target!(|text: &str| {
    let mut sources = Sources::default();
    let file = sources.add("a.blif", text);
    match blif::read(text, file, Some("clk")) {
        Ok(design) => {
            let written = blif::write(&design);
            let file = sources.add("again.blif", written.clone());
            nbc_fuzz::same_design(&design, &blif::read(&written, file, Some("clk")).expect("what is written is read"));
        }
        Err(faults) => {
            render::text(&faults, &sources, false);
        }
    }
});
