//! Real editors with their own clients.

use std::process::Command;

use crate::lsp::client::at;
use crate::manual::fences;

use crate::support::*;

const NAME: &str = "d_latch";

/// A bench with `latch.nb`, its text, and the byte of a use of [`NAME`].
fn latch() -> (Bench, String, usize) {
    let bench = Bench::new();
    let text = text_of("circuits/latch.nb");
    bench.file("latch.nb", &text);
    let used = text.rfind(&format!("test {NAME}")).unwrap() + "test ".len();
    (bench, text, used)
}

fn run(bench: &Bench, editor: &mut Command) -> Value {
    let output = editor.current_dir(bench.path()).output_in_time();
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let found = fs::read(bench.path().join("found.json"));
    serde_json::from_slice(&found.unwrap_or_else(|_| panic!("{output:?}"))).unwrap()
}

/// The example of the manual in a language, which configures an editor.
fn configuration(language: &str) -> String {
    let manual = text_of("docs/editors.md");
    let found = fences(&manual).into_iter().find(|fence| fence.words == [language]);
    found.unwrap_or_else(|| panic!("the manual has no {language}")).text
}

/// The hover of a robot has its table, but no picture, of which the editor would show the source.
fn expect_no_picture(found: &Value) {
    let robot = found["robot"].as_str().unwrap();
    assert!(robot.contains("| nand | `") && !robot.contains("data:image"), "{robot}");
}

#[test]
fn neovim_hovers_goes_to_definitions_renames_and_formats() {
    let Some(neovim) = NEOVIM.find() else { return };
    let (bench, text, used) = latch();
    let place = at(&text, &text[used..]);
    let script = root().join("tests/it/neovim.lua");
    let mut editor = Command::new(neovim);
    editor
        .args(["--headless", "-u", "NONE", "-n", "-c", &format!("luafile {}", script.display())])
        .env("NBC", env!("CARGO_BIN_EXE_nbc"))
        .env("LINE", place["line"].to_string())
        .env("CHARACTER", place["character"].to_string());
    let found = run(&bench, &mut editor);
    assert!(found["hover"].as_str().unwrap().starts_with(&format!("```nb\ncircuit {NAME}(")), "{found}");
    assert_eq!(found["definition"], at(&text, &format!("{NAME}("))["line"]);
    assert_eq!(found["problems"], 0);
    expect_no_picture(&found);
    let test = &found["ran"];
    assert!(test["passed"] == true && found["page"].as_str().unwrap().contains("<pre>"), "{found}");
    for count in ["highlights", "symbols", "workspace"] {
        assert!(found[count].as_u64().unwrap() > 0, "{count}: {found}");
    }
    assert_eq!(found["completions"], 0, "nothing is completed in a comment");
    let renamed = format!("//   formatted\n\n{}", text.replace(NAME, "memory"));
    assert_eq!(found["text"], renamed, "a canonical text stays as it is");
    assert!(found["signature"].as_str().unwrap().contains("memory(d, e) -> (q, nq)"), "{found}");
}

fn emacs() -> Option<PathBuf> {
    let emacs = EMACS.find()?;
    let eglot = Command::new(&emacs).args(["--batch", "-f", "package-initialize", "-l", "eglot"]).output_in_time();
    if !eglot.status.success() {
        EMACS.skip();
        return None;
    }
    Some(emacs)
}

#[test]
fn emacs_hovers_goes_to_definitions_renames_and_formats() {
    let Some(emacs) = emacs() else { return };
    let (bench, text, used) = latch();
    bench.file("init.el", configuration("elisp"));
    let program = Path::new(env!("CARGO_BIN_EXE_nbc")).parent().unwrap();
    let before = std::env::var_os("PATH").unwrap_or_default();
    let path = std::env::join_paths([program.into()].into_iter().chain(std::env::split_paths(&before))).unwrap();
    let mut editor = Command::new(emacs);
    editor
        .args(["--batch", "--no-site-file", "-l", "init.el", "-l"])
        .arg(root().join("tests/it/emacs.el"))
        .env("HOME", bench.path())
        .env("PATH", path)
        // Emacs counts characters from 1.
        .env("PLACE", (text[..used].chars().count() + 1).to_string());
    let found = run(&bench, &mut editor);
    assert_eq!(found["mode"], "nb-mode");
    assert!(found["hover"].as_str().unwrap().starts_with(&format!("```nb\ncircuit {NAME}(")), "{found}");
    expect_no_picture(&found);
    let line = at(&text, &format!("{NAME}("))["line"].as_u64().unwrap();
    assert_eq!(found["definition"], line + 1);
    for count in ["references", "symbols"] {
        assert!(found[count].as_u64().unwrap() > 0, "{count}: {found}");
    }
    let renamed = format!("//   formatted\n\n{}", text.replace(NAME, "memory"));
    assert_eq!(found["text"], renamed);
}

#[test]
fn the_mode_of_kate_is_that_of_its_settings() {
    let mode = configuration("xml");
    let mode = roxmltree::Document::parse(&mode).unwrap();
    let language = mode.root_element();
    assert_eq!(language.attribute("extensions"), Some("*.nb"));
    let settings: Value = serde_json::from_str(&configuration("json")).unwrap();
    let pattern = settings["servers"]["nb"]["highlightingModeRegex"].as_str().unwrap();
    assert!(regex::Regex::new(pattern).unwrap().is_match(language.attribute("name").unwrap()));
}
