//! Some clocks of the processor in full physics.

use super::machine::with_clocks;
use crate::support::*;

/// addi x1, x0, -7
const PROGRAM: [u32; 1] = [0xff90_0093];

/// The clocks before those that are tested: the fetch of the instruction has two left then, and its execution begins.
const SKIPPED: usize = 62;

#[test]
#[ignore = "takes minutes: cargo test --release --test it riscv::physics -- --ignored"]
fn clocks_of_two_passes_are_right_in_physics() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("riscv.nb");
    fs::write(&path, with_clocks(&PROGRAM, SKIPPED, 8)).unwrap();
    nbc::run_file(&path, &nbc::CompileOptions::default()).unwrap_or_else(|error| panic!("{error}")).assert_passed();
}
