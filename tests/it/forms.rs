//! The cells of the gallery's circuits are equal to them for ever, by the search for properties: a second opinion of
//! the compiler's own proofs, and of how it recognizes registers.

use std::time::Instant;

use nbc_base::diag::counted;
use nbc_base::model::Instance;
use nbc_circuit::properties::{InductiveProof, Monitored, PropertySearch, PropertyVerdict, SearchBudget};
use nbc_circuit::{CancelFlag, Netlist};
use nbc_session::store::DiskWorld;
use nbc_session::{CompileOptions, Mapping, Session};

use crate::support::*;

fn mappings(file: &str) -> Vec<Mapping> {
    let mut session = Session::new(DiskWorld);
    let checked = session.checked(root().join("circuits").join(file).to_str().unwrap());
    let mut circuits: Vec<_> = checked.program.tests.iter().map(|test| test.circuit.clone()).collect();
    circuits.sort_by_key(|circuit| circuit.to_string());
    circuits.dedup();
    let map = |circuit: &Instance| {
        let swarm =
            checked.program.swarms.iter().rfind(|swarm| swarm.circuit == *circuit).map(|swarm| swarm.name.clone());
        let found = checked.map(circuit, &CompileOptions { swarm, ..CompileOptions::default() });
        found.unwrap_or_else(|faults| panic!("{file}: {faults}"))
    };
    circuits.iter().map(map).filter(|mapping| !mapping.proof.cuts.is_empty() && mapping.waves.is_none()).collect()
}

/// Whether two netlists are equal for ever; `None` if the work ends before that is known.
fn is_equal(one: &Netlist, two: &Netlist, what: &str) -> Option<bool> {
    let begun = Instant::now();
    let system = Monitored::of_two([one, two], &CancelFlag::default()).unwrap().system;
    let [registers, gates] = [system.registers.len(), system.ands.len()];
    let verdict = PropertySearch::new(system, SearchBudget::SHORT, CancelFlag::default()).finish().remove(0);
    let (how, is_equal) = match &verdict {
        PropertyVerdict::Proved(InductiveProof::Steps { steps, .. }) => {
            (format!("induction, {}", counted(*steps, "step")), Some(true))
        }
        PropertyVerdict::Proved(InductiveProof::Invariant { clauses, .. }) => {
            (format!("invariant of {} clauses", clauses.len()), Some(true))
        }
        PropertyVerdict::Refuted(run) => (format!("refuted after {} steps", run.inputs.len()), Some(false)),
        PropertyVerdict::Undecided { steps } => (format!("undecided after {steps} steps"), None),
    };
    println!("| {what} | {registers} | {gates} | {how} | {:.1} |", begun.elapsed().as_secs_f64());
    is_equal
}

fn check(files: &[&str]) {
    for file in files {
        for mapping in mappings(file) {
            let what = format!("`{file}`, `{}`", mapping.source.name);
            assert_eq!(is_equal(&mapping.source, &mapping.netlist, &what), Some(true), "{what}");
        }
    }
}

#[test]
fn circuits_of_the_gallery_and_their_robots_are_equal_for_ever() {
    check(&[
        "latch.nb",
        "d_flip_flop.nb",
        "t_flip_flop.nb",
        "counter.nb",
        "lfsr.nb",
        "sequence_detector.nb",
        "traffic_light.nb",
        "three_senses.nb",
        "three_computer.nb",
        "computer.nb",
    ]);
}

// cargo test --test it forms:: -- --ignored --nocapture
#[test]
#[ignore = "takes half a minute"]
fn the_processor_and_its_robots_are_equal_for_ever() {
    check(&["riscv.nb"]);
}

/// A circuit whose registers read their own clocks as data, and a latch whose data depend on what opens it.
const READING: &str = "\
circuit reading(a, b, clk, clk2) -> (p, q, r) {
    own   = register((a nand clk) nand (clk2 nor b), clk2)
    gone  = register(own xor a, clk)
    p     = register((clk and a) and gone, clk)
    q     = latch((own and a) nand b, a and b)
    r     = own
}
";

#[test]
fn registers_that_read_their_own_clocks_are_compiled_in_each_form() {
    let bench = Bench::new();
    let swarm = "\nswarm all { circuit: reading, registers: mux, library: three }\n";
    bench.file("reading.nb", format!("{READING}{swarm}"));
    bench.run("build reading.nb --format json").expect_json();
    let latch = ".model m\n.inputs b c\n.outputs q\n.latch d q ah c 2\n.names c b d\n0- 1\n-1 1\n.end\n";
    bench.file("latch.blif", latch);
    let ran = bench.ok("synth latch.blif --registers expand");
    assert!(ran.out.contains("proved from the file,"), "{}", ran.out);
}
