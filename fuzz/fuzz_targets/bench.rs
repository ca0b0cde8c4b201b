//! Any text is read as ISCAS .bench or rejected. A design that is read is the same after writing and reading BLIF.
#![no_main]

use libfuzzer_sys::fuzz_target;
use nbc_circuit::formats::{bench, blif};
use nbc_base::diag::render;
use nbc_base::source::Sources;

fuzz_target!(|text: &str| {
    let mut sources = Sources::default();
    let file = sources.add("a.bench", text);
    match bench::read(text, file, Some("clk")) {
        Ok(design) => {
            let written = blif::write(&design);
            let file = sources.add("again.blif", written.clone());
            nbc_fuzz::same_design(&design, &blif::read(&written, file, None).expect("a written design can be read"));
        }
        Err(faults) => {
            render::text(&faults, &sources, false);
        }
    }
});
