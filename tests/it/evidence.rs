//! The claims of the manual: does again what it says was done, and compares.

use std::process::Command;
use std::time::{Duration, Instant};

use serde::Deserialize;

use crate::support::*;

/// What a page says, and the command that shows it.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct Claim {
    claim: String,
    page: String,
    /// The command, with `{out}` for a folder that is removed afterwards. Words are parted by spaces; one with spaces
    /// is in single quotes.
    command: String,
    /// Seconds that it takes, about, on two cores.
    seconds: u32,
    /// Texts that the command prints, and the page has.
    #[serde(default)]
    says: Vec<String>,
    /// Texts that the command prints, ...
    #[serde(default)]
    prints: Vec<String>,
    /// ... and those of the page that say the same in other words.
    #[serde(default)]
    quotes: Vec<String>,
    /// Whether the page has every line of the tables that the command prints.
    #[serde(default)]
    tables: bool,
}

fn claims() -> Vec<Claim> {
    serde_json::from_str(&text_of("docs/evidence.json")).unwrap()
}

impl Claim {
    fn page(&self) -> String {
        squeezed(&text_of(&self.page))
    }

    fn words(&self, out: &Path) -> Vec<String> {
        self.command.replace("{out}", out.to_str().unwrap()).words()
    }

    fn missing(&self, page: &str, printed: &str) -> Vec<String> {
        let all = squeezed(printed);
        let said = self.says.iter().chain(&self.prints).filter(|text| !all.contains(&squeezed(text)));
        let unsaid = self.says.iter().chain(&self.quotes).filter(|text| !page.contains(&squeezed(text)));
        let rows = printed.lines().filter(|line| self.tables && line.starts_with('|'));
        let unsaid_rows = rows.filter(|line| !page.contains(&squeezed(line)));
        said.chain(unsaid).cloned().chain(unsaid_rows.map(str::to_owned)).collect()
    }
}

/// Does again what takes so many seconds at most: one, or as many as `NBC_CLAIMS` says.
#[test]
fn what_the_manual_says_is_so() {
    let most = std::env::var("NBC_CLAIMS").map_or(1, |seconds| seconds.parse().expect("a number of seconds"));
    let chosen: Vec<Claim> = claims().into_iter().filter(|claim| claim.seconds <= most).collect();
    assert!(chosen.len() >= 2, "{chosen:?}");
    let mut differ = Vec::new();
    for claim in chosen {
        let (out, start) = (tempfile::tempdir().unwrap(), Instant::now());
        let mut words = claim.words(out.path()).into_iter();
        let mut command = match words.next().as_deref() {
            Some("nbc") => Command::new(env!("CARGO_BIN_EXE_nbc")),
            Some("cargo") => Command::new("cargo"),
            other => panic!("claims start nbc or cargo, not {other:?}"),
        };
        let patience = PATIENCE.max(Duration::from_secs(10 * u64::from(claim.seconds)));
        let ran = command.args(words).current_dir(root()).output_within(patience);
        let missing = claim.missing(&claim.page(), &String::from_utf8_lossy(&ran.stdout));
        let word = if missing.is_empty() { "same" } else { "DIFFERS" };
        eprintln!("{word:8} {}: {} ({:.1} s)", claim.page, claim.claim, start.elapsed().as_secs_f64());
        differ.extend(missing.into_iter().map(|text| format!("{}: `{}` lacks {text}", claim.page, claim.command)));
    }
    assert!(differ.is_empty(), "{}", differ.join("\n"));
}

#[test]
fn a_text_must_be_printed_and_be_on_the_page() {
    let text =
        r#"{"claim": "c", "page": "p", "command": "nbc x 'a b' {out}/y", "seconds": 1, "says": ["five robots"]}"#;
    let claim: Claim = serde_json::from_str(text).unwrap();
    assert_eq!(claim.words(Path::new("/o")), ["nbc", "x", "a b", "/o/y"]);
    assert_eq!(claim.missing("five robots", "four robots"), ["five robots"]);
    assert_eq!(claim.missing("six robots", "five robots"), ["five robots"]);
    let claim = Claim { tables: true, ..claim };
    assert!(claim.missing("it has five robots | 1 | 2 |", "five  robots\n| 1 | 2 |\n").is_empty());
    assert_eq!(claim.missing("five robots | 1 | 3 |", "five robots\n| 1 | 2 |"), ["| 1 | 2 |"]);
}

#[test]
fn the_table_of_claims_is_that_of_the_list() {
    let time = |seconds: u32| match seconds {
        0..120 => format!("{seconds} s"),
        120..7200 => format!("{} min", seconds / 60),
        _ => format!("{} h", seconds / 3600),
    };
    let mut table = "| claim | page | command | takes |\n|---|---|---|---|\n".to_owned();
    for Claim { claim, page, command, seconds, .. } in claims() {
        let name = page.rsplit('/').next().unwrap_or(&page);
        let link = page.strip_prefix("docs/").map_or_else(|| format!("../{page}"), str::to_owned);
        table += &format!("| {claim} | [{name}]({link}) | `{command}` | {} |\n", time(seconds));
    }
    let page = text_of("docs/reproduce.md");
    assert!(page.contains(&table), "docs/reproduce.md needs this table:\n{table}");
}

#[test]
fn each_claim_is_on_its_page_and_compares_something() {
    for claim in claims() {
        let page = claim.page();
        for text in claim.says.iter().chain(&claim.quotes) {
            assert!(page.contains(&squeezed(text)), "{claim:?} is not on its page: {text}");
        }
        let is_shown = !claim.says.is_empty() || claim.tables || !claim.prints.is_empty() && !claim.quotes.is_empty();
        assert!(is_shown, "{claim:?} compares nothing");
    }
}
