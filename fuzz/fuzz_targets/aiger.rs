//! Any bytes are read as AIGER or rejected. A design that is read is the same after writing and reading both forms.
#![no_main]

use libfuzzer_sys::fuzz_target;
use nbc_circuit::formats::aiger;

fuzz_target!(|bytes: &[u8]| {
    if let Ok(design) = aiger::read(bytes, None) {
        for binary in [false, true] {
            let written = aiger::write(&design, binary);
            nbc_fuzz::same_design(&design, &aiger::read(&written, None).expect("a written design can be read"));
        }
    }
});
