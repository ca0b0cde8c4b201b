//! The hold of each row of a test, and warnings of rows that end before their robots have settled.

use crate::compiled::Compiled;
use crate::wording;
use nbc_base::diag::Diagnostic;
use nbc_base::model::{CircuitTest, Hold, TestRow};
use nbc_base::source::Span;
use nbc_circuit::{Netlist, Timing};
use nbc_swarm::{RowHold, STEADY_CYCLES, Settling, resting_outputs};

/// Outputs are judged over [`STEADY_CYCLES`], so a row lasts longer than its robots need to settle.
const STEADY_EXTRA: usize = STEADY_CYCLES - 1;

pub(super) fn row_holds(rows: &[TestRow], netlist: &Netlist, compiled: &Compiled) -> Vec<RowHold> {
    let holds = holds(rows, compiled, compiled.plan.hold);
    let row_hold = |([hold, needed], rests): ([usize; 2], Vec<bool>)| RowHold { hold, needed, rests };
    holds.into_iter().zip(resting_outputs(rows, netlist)).map(row_hold).collect()
}

/// The holds of the same rows in the world of a compiled circuit.
pub(super) fn again(rows: &[TestRow], row_holds: &[RowHold], compiled: &Compiled) -> Vec<RowHold> {
    let holds = holds(rows, compiled, compiled.plan.hold).into_iter().zip(row_holds);
    holds.map(|([hold, needed], before)| RowHold { hold, needed, rests: before.rests.clone() }).collect()
}

/// For each row, the cycles for which it is held, and those that its robots need.
fn holds(rows: &[TestRow], compiled: &Compiled, usual: Hold) -> Vec<[usize; 2]> {
    let window = compiled.plan.window;
    let bound = (compiled.timing.hold + window - 1) as usize;
    let mut settling = Settling::new(&compiled.assembly, window as usize);
    let hold = |(i, row): (usize, &TestRow)| {
        let most = if i == 0 { bound + compiled.assembly.start_cycles() } else { bound };
        let settled = settling.cycles_to_settle(&row.inputs, most);
        let needed = settled.map_or(most, |cycles| compiled.plan.stretched(cycles)) + STEADY_EXTRA;
        let hold = match (row.hold, usual) {
            (Some(cycles), _) | (None, Hold::Cycles(cycles)) => cycles.max(1) as usize,
            (None, Hold::Auto) => needed,
        };
        settling.hold(&row.inputs, hold);
        [hold, needed]
    };
    rows.iter().enumerate().map(hold).collect()
}

/// Suffices for rows without a hold of their own. A longer hold may show that a later row needs more.
pub(super) fn sufficient(rows: &[TestRow], compiled: &Compiled) -> usize {
    let mut cycles = 1;
    loop {
        let found = holds(rows, compiled, Hold::Cycles(cycles as u32));
        let usual = rows.iter().zip(found).filter(|(row, _)| row.hold.is_none());
        let needed = usual.map(|(_, [_, needed])| needed).max().unwrap_or(cycles);
        if needed <= cycles {
            return cycles;
        }
        cycles = needed;
    }
}

pub(super) fn warnings(
    test: &CircuitTest,
    rows: &[TestRow],
    row_holds: &[RowHold],
    compiled: &Compiled,
    sufficient: impl FnOnce() -> usize,
) -> Vec<Diagnostic> {
    let Compiled { mapping, timing: Timing { critical_path, .. }, .. } = compiled;
    let path: Vec<String> = critical_path.iter().map(|&net| mapping.netlist.net_name(net)).collect();
    let warning = |hold, needed, place| wording::short_hold(hold, needed, &path, place);
    let short = || rows.iter().zip(row_holds).filter(|(_, row_hold)| row_hold.hold < row_hold.needed);
    let usual = short().find(|(row, _)| row.hold.is_none());
    let mut own: Vec<(Span, usize, usize)> = Vec::new();
    for (row, row_hold) in short().filter(|(row, _)| row.hold.is_some()) {
        match own.last_mut() {
            // The two halves of a pulse.
            Some((place, _, needed)) if *place == row.span => *needed = row_hold.needed.max(*needed),
            _ => own.push((row.span, row_hold.hold, row_hold.needed)),
        }
    }
    let usual = usual.map(|(_, row_hold)| warning(row_hold.hold, sufficient(), test.span));
    let own = own.into_iter().map(|(place, hold, needed)| warning(hold, needed, place));
    usual.into_iter().chain(own).collect()
}
