//! Any text is read as a lesson, or its mistakes are found.
#![no_main]

use libfuzzer_sys::fuzz_target;

fuzz_target!(|text: &str| {
    let _ = nbc_play::faults_of_lesson(text);
});
