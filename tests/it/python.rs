//! The text of the Python package: it is a door, and keeps the rules of the source where they apply.

use regex::Regex;

use crate::support::*;

fn files(folders: &[&str], extension: &str) -> Vec<(PathBuf, String)> {
    let mut open: Vec<PathBuf> = folders.iter().map(|folder| root().join("python").join(folder)).collect();
    let mut found = Vec::new();
    while let Some(path) = open.pop() {
        if path.is_dir() {
            open.extend(fs::read_dir(path).unwrap().map(|entry| entry.unwrap().path()));
        } else if path.extension().is_some_and(|found| found == extension) {
            let text = fs::read_to_string(&path).unwrap();
            found.push((path, text));
        }
    }
    assert!(found.len() > 3, "the files of {folders:?} were found");
    found
}

fn forbid(rule: &str, pattern: &str) {
    let pattern = Regex::new(pattern).unwrap();
    let mut found = Vec::new();
    for (path, text) in files(&["src"], "rs") {
        for (number, line) in text.lines().enumerate() {
            if pattern.is_match(line.split("//").next().unwrap_or_default()) {
                found.push(format!("{}:{}: {}", path.display(), number + 1, line.trim()));
            }
        }
    }
    assert!(found.is_empty(), "{rule}\n{}", found.join("\n"));
}

#[test]
fn the_native_half_uses_the_names_of_the_root() {
    let rooms = "check|circuit|cli|diag|evolve|model|report|session|sim|source|store|swarm|syntax";
    forbid("a door calls the names of src/lib.rs", &format!(r"\bnbc::(\{{?)({rooms})(::|\b[,}}])"));
}

#[test]
fn the_native_half_keeps_the_rules_of_the_source() {
    forbid("`unsafe` is in one file of the physics", r"\bunsafe\b");
    forbid("a hash map's order differs from run to run", "HashMap|HashSet");
    forbid("only the Python half talks to users", r"\be?println?!");
}

#[test]
fn every_file_has_a_description_and_narrow_lines() {
    let mut faults = Vec::new();
    let sources = files(&["src"], "rs").into_iter().map(|(path, text)| (path, text, "//! "));
    let folders = ["python", "tests", "examples", "benchmarks"];
    for (path, text, opening) in
        sources.chain(files(&folders, "py").into_iter().map(|(path, text)| (path, text, "\"\"\"")))
    {
        if !text.starts_with(opening) {
            faults.push(format!("{}: no description", path.display()));
        }
        let wide = text.lines().enumerate().filter(|(_, line)| line.chars().count() > 120);
        faults.extend(wide.map(|(number, _)| format!("{}:{}: more than 120 columns", path.display(), number + 1)));
    }
    assert!(faults.is_empty(), "{}", faults.join("\n"));
}
