//! The pictures of README.md and docs/: all are made by the commands of docs/pictures.md, and none is left over.

use std::collections::BTreeSet;

use crate::support::*;

const MOST: [u64; 2] = [1_000_000, 4_000_000];
const AGAIN: &str = "`cargo run --release --example gallery` makes them";

fn commands() -> Vec<String> {
    let manual = text_of("docs/pictures.md");
    manual.lines().filter_map(|line| line.strip_prefix("    nbc ")).map(str::to_owned).collect()
}

fn written(command: &str) -> Option<String> {
    command.split_once("-o docs/pictures/").map(|(_, file)| file.trim().to_owned())
}

fn shown(page: &Path) -> Vec<String> {
    let text = fs::read_to_string(page).unwrap();
    let links = text.split("](").skip(1).filter_map(|rest| rest.split(')').next()?.split_once("pictures/"));
    links.map(|(_, file)| file.to_owned()).collect()
}

#[test]
fn every_picture_is_made_by_one_command_and_shown() {
    let made: BTreeSet<String> = commands().iter().filter_map(|command| written(command)).collect();
    let files = fs::read_dir(root().join("docs/pictures")).unwrap().map(|entry| entry.unwrap());
    let there: BTreeSet<String> = files.map(|entry| entry.file_name().into_string().unwrap()).collect();
    assert_eq!(made, there, "the commands of docs/pictures.md against docs/pictures; {AGAIN}");
    let pages = fs::read_dir(root().join("docs")).unwrap().map(|entry| entry.unwrap().path());
    let pages = pages.filter(|path| path.extension().is_some_and(|extension| extension == "md"));
    let shown: BTreeSet<String> = pages
        .chain([root().join("README.md")])
        .flat_map(|page| shown(&page))
        .filter(|file| file.contains('.'))
        .collect();
    assert_eq!(shown, there, "the pictures that README.md and docs/ show against docs/pictures");
}

#[test]
fn pictures_are_small() {
    let size = |file: String| (fs::metadata(root().join("docs/pictures").join(&file)).unwrap().len(), file);
    let sizes: Vec<(u64, String)> = commands().iter().filter_map(|command| written(command)).map(size).collect();
    let large: Vec<_> = sizes.iter().filter(|(size, _)| *size > MOST[0]).collect();
    assert!(large.is_empty(), "{large:?}");
    assert!(sizes.iter().map(|(size, _)| size).sum::<u64>() < MOST[1]);
}

#[test]
fn pictures_of_bodies_are_those_of_this_version() {
    let bench = Bench::new();
    let quick =
        commands().into_iter().filter(|command| command.contains("--as sprite") || command.contains("--as pose"));
    let mut tried = 0;
    for command in quick {
        let file = written(&command).unwrap();
        bench.ok(&command.replace("docs/pictures/", ""));
        let [made, kept] = [bench.path().join(&file), root().join("docs/pictures").join(&file)].map(fs::read);
        assert!(made.unwrap() == kept.unwrap(), "docs/pictures/{file} is of another version; {AGAIN}");
        tried += 1;
    }
    assert!(tried >= 4);
}

/// `cargo test --release --test it the_picture_of_the_processor -- --ignored` takes some ten seconds.
#[test]
#[ignore = "compiles the processor"]
fn the_picture_of_the_processor_is_of_this_version() {
    let bench = Bench::new();
    let program = root().join("circuits/riscv.nb");
    bench.ok(&["draw", program.to_str().unwrap(), "--as", "schematic", "-o", "parts.png"]);
    let [made, kept] = [bench.path().join("parts.png"), root().join("docs/riscv-parts.png")].map(fs::read);
    assert!(made.unwrap() == kept.unwrap(), "docs/riscv-parts.png is of another version; docs/riscv.md makes it");
}
