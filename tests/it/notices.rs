//! `THIRD-PARTY.md`: the licenses of the crates in the program. After a change of Cargo.lock, `NBC_UPDATE_NOTICES=1
//! cargo test --test it notices` rewrites it.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use serde_json::Value;

use crate::support::limits::InTime;
use crate::support::root;

/// A crate of the program, with the texts under which it may be used.
struct Crate {
    name: String,
    version: String,
    license: String,
    texts: Vec<String>,
}

/// Cargo's metadata of the packages for this machine.
fn metadata() -> Value {
    let mut cargo = Command::new(env!("CARGO"));
    cargo.args(["metadata", "--format-version", "1", "--locked", "--offline", "--filter-platform"]);
    let output = cargo.arg("x86_64-unknown-linux-gnu").current_dir(root()).output_in_time();
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    serde_json::from_slice(&output.stdout).unwrap()
}

/// The packages that a normal build needs, by their identity, without those of tests.
fn used(metadata: &Value) -> BTreeSet<String> {
    let nodes: BTreeMap<&str, &Value> = metadata["resolve"]["nodes"]
        .as_array()
        .unwrap()
        .iter()
        .map(|node| (node["id"].as_str().unwrap(), node))
        .collect();
    let own = metadata["resolve"]["root"].as_str().unwrap();
    let (mut open, mut found) = (vec![own], BTreeSet::new());
    while let Some(id) = open.pop() {
        for dependency in nodes[id]["deps"].as_array().unwrap() {
            let kinds = dependency["dep_kinds"].as_array().unwrap();
            let package = dependency["pkg"].as_str().unwrap();
            if kinds.iter().any(|kind| kind["kind"] != "dev") && found.insert(package.to_owned()) {
                open.push(package);
            }
        }
    }
    found
}

fn crates() -> Vec<Crate> {
    let metadata = metadata();
    let used = used(&metadata);
    let packages = metadata["packages"].as_array().unwrap().iter();
    let text = |value: &Value| value.as_str().unwrap_or_default().to_owned();
    let describe = |package: &Value| Crate {
        name: text(&package["name"]),
        version: text(&package["version"]),
        license: text(&package["license"]),
        texts: license_texts(Path::new(package["manifest_path"].as_str().unwrap()).parent().unwrap()),
    };
    let from_elsewhere =
        |package: &&Value| !package["source"].is_null() && used.contains(package["id"].as_str().unwrap());
    packages.filter(from_elsewhere).map(describe).collect()
}

/// The license texts in a package's folder: the short one if there is a choice, and the notices that must accompany it.
fn license_texts(folder: &Path) -> Vec<String> {
    let name = |path: &PathBuf| path.file_name().unwrap().to_string_lossy().to_lowercase();
    let mut paths: Vec<PathBuf> = fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()).collect();
    paths.retain(|path| {
        path.is_file() && ["license", "licence", "copying", "notice"].iter().any(|word| name(path).starts_with(word))
    });
    paths.sort();
    if paths.iter().any(|path| name(path).contains("mit")) {
        paths.retain(|path| !["apache", "zlib", "unlicense"].iter().any(|other| name(path).contains(other)));
    }
    paths.iter().map(|path| clean(&String::from_utf8_lossy(&fs::read(path).unwrap()))).collect()
}

/// A text with normalized line ends.
fn clean(text: &str) -> String {
    let lines: Vec<&str> = text.lines().map(str::trim_end).collect();
    lines.join("\n").trim_matches('\n').to_owned()
}

/// The expected contents of the file.
fn expected() -> String {
    let crates = crates();
    let mut by_text: BTreeMap<&str, Vec<String>> = BTreeMap::new();
    let mut list = String::new();
    for Crate { name, version, license, texts } in &crates {
        list += &format!("| {name} | {version} | {license} |\n");
        for text in texts {
            by_text.entry(text).or_default().push(format!("{name} {version}"));
        }
    }
    let mut sections: Vec<(Vec<String>, &str)> = by_text.into_iter().map(|(text, crates)| (crates, text)).collect();
    sections.sort();
    let sections: String =
        sections.iter().map(|(crates, text)| format!("\n## {}\n\n```text\n{text}\n```\n", crates.join(", "))).collect();
    let fonts = clean(&fs::read_to_string(root().join("crates/session/assets/DejaVu-LICENSE.txt")).unwrap());
    format!(
        "# Third-party licenses\n\nThe crates of which `nbc` is built, with the licenses that their authors offer, \
         and the texts of those that \
         they are used under. Crates without a text of their own name their license in the table. Written by \
         `NBC_UPDATE_NOTICES=1 cargo test --test it notices`.\n\n| crate | version | license \
         |\n|---|---|---|\n{list}{sections}\n\
         ## The DejaVu fonts, in pictures and pages\n\n```text\n{fonts}\n```\n"
    )
}

#[test]
fn every_crate_of_the_program_is_in_the_notices() {
    let (path, expected) = (root().join("THIRD-PARTY.md"), expected());
    if std::env::var_os("NBC_UPDATE_NOTICES").is_some() {
        fs::write(&path, &expected).unwrap();
    }
    let found = fs::read_to_string(&path).unwrap_or_default();
    let missing: Vec<&str> = expected.lines().filter(|line| line.starts_with("| ") && !found.contains(line)).collect();
    assert!(
        missing.is_empty(),
        "NBC_UPDATE_NOTICES=1 cargo test --test it notices; missing are\n{}",
        missing.join("\n")
    );
    assert!(found == expected, "THIRD-PARTY.md is not as NBC_UPDATE_NOTICES=1 cargo test --test it notices writes it");
}

#[test]
fn every_crate_has_a_license() {
    let without: Vec<String> =
        crates().into_iter().filter(|found| found.license.is_empty()).map(|found| found.name).collect();
    assert!(without.is_empty(), "crates without a license: {without:?}");
}

#[test]
fn paths_in_the_manifest_exist() {
    assert!(!fs::read_to_string(root().join("Cargo.toml")).unwrap().contains("example.org"));
}
