//! The claims of the manual, with the commands that show them.

use std::path::Path;

use serde::Deserialize;

use crate::cli::Failure;
use crate::cli::evidence::wording::EvidenceError;
use nbc_base::diag::Diagnostic;
use nbc_session::store::read_text;

/// The largest list or page.
const MOST_BYTES: u64 = 1 << 20;

/// What a page says, and the command that shows it.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Claim {
    /// The claim in one sentence.
    pub(super) claim: String,
    /// The page, from the root of the repository.
    pub(super) page: String,
    /// The command, with `{out}` for a folder that is removed afterwards. Words are parted by spaces; one with spaces
    /// is in single quotes.
    pub(super) command: String,
    /// Seconds that it takes, about, on two cores.
    pub(super) seconds: u32,
    /// Texts that the command prints, and the page has.
    #[serde(default)]
    pub(super) says: Vec<String>,
    /// Texts that the command prints, ...
    #[serde(default)]
    pub(super) prints: Vec<String>,
    /// ... and those of the page that say the same in other words.
    #[serde(default)]
    pub(super) quotes: Vec<String>,
    /// Whether the page has every line of the tables that the command prints.
    #[serde(default)]
    pub(super) tables: bool,
}

/// Reads a list of claims.
///
/// # Errors
/// When it cannot be read, or is not such a list.
pub(super) fn read_claims(path: &Path) -> Result<Vec<Claim>, Failure> {
    let fault = |reason: serde_json::Error| EvidenceError::List {
        path: path.display().to_string(),
        reason: reason.to_string(),
    };
    Ok(serde_json::from_str(&read_page(path)?).map_err(fault)?)
}

/// Reads a page.
///
/// # Errors
/// When it cannot be read.
pub(super) fn read_page(path: &Path) -> Result<String, Failure> {
    let unreadable = |error| Failure::plain(Diagnostic::unreadable(&path.display().to_string(), &error));
    read_text(path, MOST_BYTES).map_err(unreadable)
}

/// A text whose words are parted by single spaces, so that line ends and columns do not matter.
pub(super) fn squeezed(text: &str) -> String {
    text.split_whitespace().collect::<Vec<_>>().join(" ")
}

impl Claim {
    /// The words of the command.
    pub(super) fn words(&self, out: &Path) -> Vec<String> {
        let quoted = self.command.split('\'').enumerate();
        let words = quoted.flat_map(|(n, part)| match n % 2 {
            1 => vec![part.to_owned()],
            _ => part.split_whitespace().map(str::to_owned).collect(),
        });
        words.map(|word| word.replace("{out}", &out.display().to_string())).collect()
    }

    /// The texts that the output or the page lacks.
    pub(super) fn missing(&self, page: &str, printed: &str) -> Vec<String> {
        let (page, all) = (squeezed(page), squeezed(printed));
        let said = self.says.iter().chain(&self.prints).filter(|text| !all.contains(&squeezed(text)));
        let unsaid = self.says.iter().chain(&self.quotes).filter(|text| !page.contains(&squeezed(text)));
        let rows = printed.lines().filter(|line| self.tables && line.starts_with('|'));
        let unsaid_rows = rows.filter(|line| !page.contains(&squeezed(line)));
        said.chain(unsaid).cloned().chain(unsaid_rows.map(str::to_owned)).collect()
    }
}

/// All claims as a table of Markdown.
pub(super) fn table(claims: &[Claim]) -> String {
    let time = |seconds: u32| match seconds {
        0..120 => format!("{seconds} s"),
        120..7200 => format!("{} min", seconds / 60),
        _ => format!("{} h", seconds / 3600),
    };
    let mut text = "| claim | page | command | takes |\n|---|---|---|---|\n".to_owned();
    for Claim { claim, page, command, seconds, .. } in claims {
        let name = page.rsplit('/').next().unwrap_or(page);
        let link = page.strip_prefix("docs/").map_or_else(|| format!("../{page}"), str::to_owned);
        text += &format!("| {claim} | [{name}]({link}) | `{command}` | {} |\n", time(*seconds));
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    fn claim() -> Claim {
        let text =
            r#"{"claim": "c", "page": "p", "command": "nbc x 'a b' {out}/y", "seconds": 1, "says": ["five robots"]}"#;
        serde_json::from_str(text).unwrap()
    }

    #[test]
    fn words_are_parted_and_quoted() {
        assert_eq!(claim().words(Path::new("/o")), ["nbc", "x", "a b", "/o/y"]);
    }

    #[test]
    fn a_text_must_be_printed_and_be_on_the_page() {
        let claim = Claim { tables: true, ..claim() };
        assert!(claim.missing("it has five\nrobots | 1 | 2 |", "five  robots\n| 1 | 2 |\n").is_empty());
        assert_eq!(claim.missing("five robots", "four robots"), ["five robots"]);
        assert_eq!(claim.missing("six robots", "five robots"), ["five robots"]);
        assert_eq!(claim.missing("five robots | 1 | 3 |", "five robots\n| 1 | 2 |"), ["| 1 | 2 |"]);
    }
}
