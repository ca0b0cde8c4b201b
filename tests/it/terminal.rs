//! Output to a terminal: no name or text of a user can control it.

use crate::support::*;

/// Clears the screen, sets the title, rings, colors, and reads from right to left.
const HOSTILE: &str = "\u{1b}[2J\u{1b}]0;pwned\u{7}\u{9b}31m\u{202e}x";

/// The control characters in a text, apart from `nbc`'s own colors.
fn steering(text: &str) -> Vec<char> {
    let colors = regex::Regex::new("\u{1b}\\[[0-9;]*m").unwrap();
    let hidden =
        |c: &char| *c != '\n' && (c.is_control() || matches!(c, '\u{202a}'..='\u{202e}' | '\u{2066}'..='\u{2069}'));
    colors.replace_all(text, "").chars().filter(hidden).collect()
}

#[track_caller]
fn check(bench: &Bench, arguments: &[&str]) {
    let quiet = |further: &[&str]| {
        let ran = bench.run(&[arguments, further].concat());
        assert_eq!((steering(&ran.out), steering(&ran.err)), (vec![], vec![]), "{arguments:?}");
        ran
    };
    let told = quiet(&["--color", "always"]);
    assert!(told.out.contains("pwned") || told.err.contains("pwned"), "{arguments:?}:\n{}{}", told.out, told.err);
    quiet(&["--format", "json"]);
}

#[test]
fn titles_excerpts_and_paths_are_shown_as_codes() {
    let bench = Bench::new();
    let title = format!("circuit f(a) -> (q) {{ q = a }}\ntest f \"{HOSTILE}\" {{\n a | q\n 0 | 1\n}}\n");
    bench.file("title.nb", title);
    check(&bench, &["test", "title.nb", "--logic"]);
    bench.file("excerpt.nb", format!("circuit f(a) -> (q) {{ q = b }}  // {HOSTILE}\n"));
    check(&bench, &["check", "excerpt.nb"]);
    bench.file("sign.nb", format!("circuit f(a) -> (q) {{ q = a {HOSTILE} }}\n"));
    check(&bench, &["fmt", "sign.nb"]);
    bench.file("use.nb", format!("use \"{HOSTILE}.nb\"\n"));
    check(&bench, &["check", "use.nb"]);
    bench.file("folder.nb", format!("library l {{ from: \"{HOSTILE}\" }}\n"));
    check(&bench, &["check", "folder.nb"]);
    let ran = bench.run(&["check", "use.nb", &format!("--{HOSTILE}")]);
    assert_eq!((ran.status, steering(&ran.err)), (2, vec![]), "{}", ran.err.escape_debug());
    let name = format!("{HOSTILE}.nb");
    check(&bench, &["check", &name]);
    bench.file(&name, "circuit f(a) -> (q) {  q = a }");
    let ran = bench.run(&["fmt", "--check", &name]);
    assert_eq!((ran.status, steering(&ran.out)), (1, vec![]));
}

#[test]
fn robots_circuits_and_checkpoints_are_shown_as_codes() {
    let bench = Bench::new();
    let robot = text_of("library/robots/nand_5x5.yaml");
    bench.file("robot.yaml", format!("\"\\e[2J\\e]0;pwned\\a\\x9b31m\\u202ex\": 1\n{robot}"));
    check(&bench, &["library", "verify", "robot.yaml"]);
    bench.file(format!("{HOSTILE}.yaml"), "body: []");
    check(&bench, &["library", "verify", &format!("{HOSTILE}.yaml")]);
    bench.file("names.blif", format!(".model m\n.inputs a\n.outputs {HOSTILE}\n.end\n"));
    check(&bench, &["synth", "names.blif", "--cells", "nand"]);
    let run = Path::new("run").join("seed-1");
    fs::create_dir_all(bench.path().join(&run)).unwrap();
    bench.file("run/seed-1/checkpoint.nbc", format!("nbc-checkpoint {} 0 0\n", HOSTILE.replace(' ', "")));
    check(&bench, &["draw", "run", "--as", "heatmap", "-o", "a.svg"]);
}
