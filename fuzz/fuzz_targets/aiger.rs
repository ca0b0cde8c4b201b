//! Any bytes are read as AIGER or refused, and what is read is written in both forms and read again as the same design.
#![no_main]

use libfuzzer_sys::fuzz_target;
use nbc::circuit::formats::aiger;

fuzz_target!(|bytes: &[u8]| {
    if let Ok(design) = aiger::read(bytes, None) {
        for binary in [false, true] {
            let written = aiger::write(&design, binary);
            nbc_fuzz::same_design(&design, &aiger::read(&written, None).expect("what is written is read"));
        }
    }
});
