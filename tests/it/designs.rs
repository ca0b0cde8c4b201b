//! The circuits of `tests/benchmarks`, and the cells that they are mapped to.

use nbc_base::model::Function;
use nbc_base::source::FileId;
use nbc_circuit::CellLibrary;
use nbc_circuit::formats::{Design, aiger, bench, blif};

use crate::support::*;

pub fn files() -> Vec<PathBuf> {
    let folder = root().join("tests/benchmarks");
    let mut files: Vec<_> = fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()).collect();
    files.retain(|path| path.extension().is_some_and(|ending| ending != "md" && ending != "csv"));
    files.sort();
    files
}

pub fn read(path: &Path) -> Design {
    let bytes = fs::read(path).unwrap();
    let text = || String::from_utf8(bytes.clone()).unwrap();
    match path.extension().unwrap().to_str().unwrap() {
        "blif" => blif::read(&text(), FileId(0), None).unwrap(),
        "bench" => bench::read(&text(), FileId(0), None).unwrap(),
        _ => aiger::read(&bytes, None).unwrap(),
    }
}

/// The cell libraries of docs/synthesis.md: (a), (b) and (c).
pub fn libraries() -> [(&'static str, CellLibrary); 3] {
    let all = Function::all().filter(|function| function.arity() == 2 || *function == Function::NOT);
    [
        ("a", CellLibrary::uniform([Function::NAND, Function::NOT])),
        ("b", CellLibrary::uniform([Function::NAND, Function::AND, Function::NOT])),
        ("c", CellLibrary::uniform(all)),
    ]
}
