//! A text without syntax errors is formatted to one without syntax errors. Formatting it again changes nothing.
#![no_main]

use libfuzzer_sys::fuzz_target;
use nbc_base::source::Sources;
use nbc_lang::syntax;

/// The canonical form; `None` if the text has syntax errors.
fn formatted(text: &str) -> Option<String> {
    let mut sources = Sources::default();
    let file = sources.add("main.nb", text);
    let parsed = syntax::parse(&sources, file);
    parsed.errors.is_empty().then(|| syntax::format(&sources, file, &parsed.tree))
}

fuzz_target!(|text: &str| {
    if let Some(once) = formatted(text) {
        assert_eq!(formatted(&once).as_ref(), Some(&once), "formatting twice changes nothing");
    }
});
