//! Any text is parsed, and its errors are shown, without a panic.
#![no_main]

use libfuzzer_sys::fuzz_target;
use nbc_base::diag::render;
use nbc_base::source::Sources;
use nbc_lang::syntax;

fuzz_target!(|text: &str| {
    let mut sources = Sources::default();
    let file = sources.add("main.nb", text);
    let parsed = syntax::parse(&sources, file);
    render::text(&parsed.errors, &sources, false);
});
