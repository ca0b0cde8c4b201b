//! Any text is parsed, and its errors are shown, without a panic.
#![no_main]

use libfuzzer_sys::fuzz_target;
use nbc::diag::render;
use nbc::source::Sources;
use nbc::syntax;

fuzz_target!(|text: &str| {
    let mut sources = Sources::default();
    let file = sources.add("main.nb", text);
    let parsed = syntax::parse(&sources, file);
    render::text(&parsed.errors, &sources, false);
});
