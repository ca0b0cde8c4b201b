//! Circuits as wave machines: which machine is made of a circuit, and the steps that the rows of a test are.

use crate::mapping::Mapping;
use crate::wording;
use nbc_base::diag::Diagnostic;
use nbc_base::model::{CircuitTest, Library, TestRow, WaveTimes};
use nbc_circuit::waves::{ClockStep, WaveMachine, WaveOptions, balance, certify};
use nbc_circuit::{MapOptions, Netlist, Proof};

/// In cycles, if the swarm names none.
const BEATS: [u32; 2] = [1, 2];

/// The smallest product of robots and cycles of a step. Panics if a machine does not make the steps of the circuit.
pub(super) fn map_waves(
    source: Netlist,
    library: &Library,
    times: WaveTimes,
    options: &MapOptions,
) -> Result<Mapping, Diagnostic> {
    let fits = |beat: &u32| times.step.is_none_or(|step| step.is_multiple_of(*beat));
    let beats = times.beat.map_or_else(|| BEATS.into_iter().filter(fits).collect(), |beat| vec![beat]);
    let made = beats.into_iter().map(|beat| {
        let cells = nbc_swarm::cells(&nbc_swarm::within_beat(library, beat, options.objective));
        let options = WaveOptions { cycles: times.step, beat, mapping: options.clone() };
        balance(&source, &cells, &options).map(|machine| (cells, machine))
    });
    let (made, errors): (Vec<_>, Vec<_>) = made.partition(Result::is_ok);
    let weight = |machine: &WaveMachine| (machine.cells() * machine.cycles_per_step(), machine.beat);
    let best = made.into_iter().filter_map(Result::ok).min_by_key(|(_, machine)| weight(machine));
    let error = || errors.into_iter().filter_map(Result::err).next_back().expect("a beat is tried");
    let (cells, machine) = best.ok_or_else(|| wording::no_waves(&error()))?;
    let step = ClockStep::of(&source).expect("a machine was made of its step");
    let method = certify(&step, &machine)
        .unwrap_or_else(|error| panic!("the wave machine of `{}` differs from its source: {error}", source.name));
    let cuts = step.state.into_iter().map(|bit| bit.name).collect();
    let proof = Proof { method, cuts };
    let netlist = machine.netlist.clone();
    let waves = Some(machine);
    Ok(Mapping { source, netlist, cells, proof, kept: Vec::new(), waves })
}

/// The first row is before the first edge of the clock, each other one edge; without state each row is a step.
/// `clock` is an input, and whether its rising edge makes a step.
pub(super) fn steps(
    test: &CircuitTest,
    rows: &[TestRow],
    clock: Option<(usize, bool)>,
    step: Option<u32>,
) -> Result<Vec<TestRow>, Vec<Diagnostic>> {
    let mut faults: Vec<Diagnostic> = Vec::new();
    for row in rows.iter().filter(|row| row.hold.is_some()) {
        let fault = wording::hold_in_waves(step, row.span);
        if !faults.contains(&fault) {
            faults.push(fault);
        }
    }
    let Some((clock, rises)) = clock else {
        return if faults.is_empty() { Ok(rows.to_vec()) } else { Err(faults) };
    };
    let mut steps: Vec<TestRow> = Vec::new();
    let mut before = None;
    for row in rows {
        let level = row.inputs[clock] == rises;
        let is_checked = row.expected.iter().any(Option::is_some);
        match before.replace(level) {
            Some(false) if level => steps.push(row.clone()),
            None => steps.push(row.clone()),
            _ if is_checked => faults.push(wording::no_edge(&test.input_bits()[clock], rises, row.span)),
            _ => {}
        }
    }
    if faults.is_empty() { Ok(steps) } else { Err(faults) }
}
