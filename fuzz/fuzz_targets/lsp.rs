//! Any session of an editor is served: each line is a message.
#![no_main]

use libfuzzer_sys::fuzz_target;

fuzz_target!(|session: &[u8]| {
    let folder = tempfile::tempdir().expect("there is room for a folder");
    let texts: Vec<&[u8]> = session.split(|&byte| byte == b'\n').collect();
    nbc_lsp::serve_texts(folder.path(), &texts);
});
