//! Why circuits cannot be exported.

use nbc_base::diag::{Code, Diagnostic};

pub(super) fn too_many_robots(robots: usize, most: u64) -> Diagnostic {
    let message = format!("the circuit needs {robots} robots; an exported page has at most {most}");
    Diagnostic::without_place(Code::BadValue, message).with_help("choose a smaller circuit with `--circuit`")
}

pub(super) fn too_many_bodies(bodies: usize, most: usize) -> Diagnostic {
    let message = format!("the swarm has {bodies} different bodies; an exported page has at most {most}");
    Diagnostic::without_place(Code::BadValue, message).with_help("export it in a world without `noise`")
}
