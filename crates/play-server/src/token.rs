//! Secrets that are a part of an address, or that show that a name is a learner's.

use crate::wording;
use nbc_base::diag::Diagnostic;

const TOKEN: usize = 16;

pub fn is_token(text: &str) -> bool {
    text.len() >= 16 && text.bytes().all(|byte| byte.is_ascii_alphanumeric())
}

pub(super) fn random_token() -> Result<String, Diagnostic> {
    let mut bytes = [0; TOKEN];
    getrandom::fill(&mut bytes).map_err(|error| wording::system(&error.to_string()))?;
    Ok(bytes.iter().map(|byte| format!("{byte:02x}")).collect())
}
