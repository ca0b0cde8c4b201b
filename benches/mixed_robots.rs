//! Whether quick and slow robots in one swarm would help: `cargo bench --bench mixed_robots`. It takes a minute.

// Files of the tests have more than this needs.
#![allow(dead_code, unused_imports)]

use nbc_base::model::{CircuitTest, Robot, Stimulation};
use nbc_circuit::{CellKind, MappingObjective, Timing};
use nbc_session::store::DiskWorld;
use nbc_session::{CompileOptions, Compiled, Session};
use nbc_swarm::{Assembly, Settling};

use support::programs::programs;

#[path = "../tests/it/support/mod.rs"]
mod support;

/// The holds of a test's rows with certain robots.
#[derive(Clone, Copy, PartialEq)]
struct Holds {
    /// Cycles of all rows.
    cycles: usize,
    /// Cycles of a row by static timing.
    bound: u32,
}

impl Holds {
    fn of(compiled: &Compiled, assembly: &Assembly, rows: &[Vec<bool>]) -> Self {
        let ids: Vec<_> = compiled.mapping.netlist.cells().map(|(id, _)| id).collect();
        let kinds: Vec<CellKind> = assembly.members.iter().map(|member| kind(&member.robot)).collect();
        let kind = |id| ids.iter().position(|&known| known == id).map_or(&kinds[0], |at| &kinds[at]);
        let bound = Timing::with(&compiled.mapping.netlist, kind).hold;
        let mut settling = Settling::new(assembly, 1);
        let mut cycles = 0;
        for (row, inputs) in rows.iter().enumerate() {
            let most = bound as usize + if row == 0 { assembly.start_cycles() } else { 0 };
            let hold = settling.cycles_to_settle(inputs, most).unwrap_or(most) + 1;
            settling.hold(inputs, hold);
            cycles += hold;
        }
        Self { cycles, bound }
    }

    fn no_longer_than(self, other: Self) -> bool {
        self.cycles <= other.cycles && self.bound <= other.bound
    }
}

fn kind(robot: &Robot) -> CellKind {
    let glitches = robot.character.glitch_rate != 0.0;
    CellKind { glitches, ..CellKind::uniform(robot.character.clock, robot.character.margin) }
}

fn rows(test: &CircuitTest) -> Vec<Vec<bool>> {
    match &test.stimulation {
        Stimulation::Rows(rows) => rows.iter().map(|row| row.inputs.clone()).collect(),
        Stimulation::Script(_) | Stimulation::Ever { .. } => Vec::new(),
        Stimulation::All { .. } => {
            let bits: usize = test.inputs.iter().map(|port| port.width).sum();
            (0..1usize << bits).map(|row| (0..bits).rev().map(|bit| row >> bit & 1 == 1).collect()).collect()
        }
    }
}

/// The margins of robots: the smallest, and the mean.
fn margins(assembly: &Assembly) -> (f64, f64) {
    let margins = || assembly.members.iter().map(|member| member.robot.character.margin);
    (margins().fold(f64::INFINITY, f64::min), margins().sum::<f64>() / assembly.members.len() as f64)
}

/// The swarm in which each robot is the one of its function with the widest margin that makes no hold longer; those
/// with the thinnest margins are tried first.
fn widened(compiled: &Compiled, rows: &[Vec<bool>]) -> Assembly {
    let mut best = compiled.assembly.clone();
    let holds = Holds::of(compiled, &best, rows);
    let mut order: Vec<usize> = (0..best.members.len()).collect();
    order.sort_by(|&a, &b| {
        let margin = |at: usize| best.members[at].robot.character.margin;
        margin(a).total_cmp(&margin(b))
    });
    for at in order {
        let now = best.members[at].robot.clone();
        let others = compiled.plan.library.robots_for(now.function());
        let wider = others.filter(|robot| robot.character.margin > now.character.margin);
        let Some(wider) = wider.max_by(|a, b| a.character.margin.total_cmp(&b.character.margin)) else { continue };
        best.members[at].robot = wider.clone();
        if !Holds::of(compiled, &best, rows).no_longer_than(holds) {
            best.members[at].robot = now;
        }
    }
    best
}

fn main() {
    println!("margins: the smallest and the mean");
    for path in programs("circuits") {
        let session = &mut Session::new(DiskWorld);
        let checked = session.checked(path.to_str().unwrap());
        for test in &checked.program.tests {
            let compile = |objective| {
                let options = CompileOptions { objective, ..CompileOptions::default() };
                checked.compile(&test.circuit, &options).unwrap()
            };
            let [quick, wide] = [MappingObjective::Delay, MappingObjective::Margin].map(compile);
            let rows = rows(test);
            let mixed = widened(&quick, &rows);
            println!("{} \"{}\":", test.circuit, test.title);
            for (name, compiled, assembly) in
                [("delay", &quick, &quick.assembly), ("mixed", &quick, &mixed), ("margin", &wide, &wide.assembly)]
            {
                let holds = Holds::of(compiled, assembly, &rows);
                let (least, mean) = margins(assembly);
                let slow = assembly.members.iter().filter(|member| member.robot.character.clock > 1).count();
                let robots = assembly.members.len();
                let average = holds.cycles as f64 / rows.len() as f64;
                println!("  {name:6} {robots:3} robots, {slow:3} slow; margins {least:.3}, {mean:.3}");
                println!("         {average:5.2} cycles a row, {:2} by static timing", holds.bound);
            }
        }
    }
}
