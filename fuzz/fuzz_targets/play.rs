//! Any visit of a page is served: each line is a request.
#![no_main]

use libfuzzer_sys::fuzz_target;

fuzz_target!(|visit: &str| {
    let folder = tempfile::tempdir().expect("there is room for a folder");
    nbc_play_server::serve_texts(folder.path(), &visit.lines().collect::<Vec<_>>());
});
