//! The compiler on the benchmark circuits.

use nbc_circuit::formats::blif;
use nbc_circuit::{Effort, MapOptions, map_with, prove};

use crate::designs::{files, libraries, read};
use crate::support::*;

#[test]
#[ignore = "maps all benchmarks; .ci/full runs it"]
fn abc_proves_every_written_blif_of_the_benchmarks() {
    let folder = tempfile::tempdir().unwrap();
    let options = MapOptions { effort: Effort::Fast, ..MapOptions::default() };
    let mut script = String::new();
    let mut pairs = 0;
    for path in files() {
        let design = read(&path);
        for (name, library) in libraries() {
            let source = design.opened();
            let logic = map_with(&source, &library, &options).unwrap();
            prove(&source, &logic).unwrap();
            let written = folder.path().join(format!("{}-{name}.blif", path.file_stem().unwrap().display()));
            fs::write(&written, blif::write(&design.closed(logic))).unwrap();
            let command = if design.netlist.registers().next().is_none() { "cec -n" } else { "dsec" };
            script.push_str(&format!("{command} {} {}; ", path.display(), written.display()));
            pairs += 1;
        }
    }
    let Some(said) = abc(folder.path(), &script) else { return };
    assert_eq!(said.matches("Networks are equivalent").count(), pairs, "{said}");
}
