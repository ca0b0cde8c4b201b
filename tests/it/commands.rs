//! The reference of commands in docs/commands.md is what the program writes of its own help.
//! `NBC_UPDATE_COMMANDS=1 cargo test --test it commands::` writes it.

use std::fs;

use crate::support::bench::Bench;
use crate::support::root;

#[test]
#[cfg(feature = "play")]
fn the_reference_of_commands_is_made_from_their_help() {
    let bench = Bench::new();
    let ran = bench.run(&["manual", "commands.md"]);
    assert_eq!((ran.status, ran.out.as_str()), (0, "wrote commands.md\n"), "{}", ran.err);
    let made = fs::read_to_string(bench.path().join("commands.md")).unwrap();
    let page = root().join("docs/commands.md");
    if std::env::var_os("NBC_UPDATE_COMMANDS").is_some() {
        fs::write(&page, &made).unwrap();
    }
    let there = fs::read_to_string(&page).unwrap_or_default();
    let differs = made.lines().zip(there.lines()).find(|(made, there)| made != there);
    assert!(
        made == there,
        "docs/commands.md is not what `nbc manual docs/commands.md` writes: {differs:?}; \
         `NBC_UPDATE_COMMANDS=1 cargo test --test it commands::` writes it"
    );
    for command in ["## nbc build", "### nbc library add", "## nbc worker", "| `--nats <URL>` |", "| `--emit <"] {
        assert!(made.contains(command), "{command} is missing");
    }
}

#[test]
fn the_table_of_prerequisites_has_the_tools_of_the_tests() {
    let page = fs::read_to_string(root().join("docs/prerequisites.md")).unwrap();
    let tools = fs::read_to_string(root().join("tests/it/support/tools.rs")).unwrap();
    let packages: Vec<&str> = tools
        .lines()
        .filter(|line| line.starts_with("pub const "))
        .filter_map(|line| line.split("remedy: \"").nth(1)?.split('"').next())
        .map(|remedy| remedy.trim_start_matches("apt-get install "))
        .collect();
    assert!(packages.len() >= 8, "{packages:?}");
    for package in packages {
        assert!(page.contains(&format!("`{package}`")), "docs/prerequisites.md does not name {package}");
    }
}
