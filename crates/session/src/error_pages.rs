//! The pages of docs/errors, which explain the codes of diagnostics.

use include_dir::{Dir, include_dir};
use nbc_base::diag::Code;

const PAGES: Dir<'static> = include_dir!("$CARGO_MANIFEST_DIR/errors");

pub fn error_page(code: Code) -> &'static str {
    let file = PAGES.get_file(format!("{code}.md")).expect("every code has its page");
    file.contents_utf8().expect("pages are text")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_code_has_its_page_and_every_page_its_code() {
        for code in Code::ALL {
            assert!(error_page(*code).starts_with(&format!("# `{code}`\n")), "the page of `{code}` begins with it");
        }
        assert_eq!(PAGES.files().count(), Code::ALL.len(), "pages without a code");
    }
}
