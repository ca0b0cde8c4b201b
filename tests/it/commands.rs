//! What the manual says of tools that must be installed.

use crate::support::*;

#[test]
fn the_table_of_prerequisites_has_the_tools_of_the_tests() {
    let page = text_of("docs/prerequisites.md");
    let tools = text_of("tests/it/support/tools.rs");
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
