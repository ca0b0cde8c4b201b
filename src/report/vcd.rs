//! Waveforms as a value change dump (IEEE 1364, section 18), for GTKWave, Surfer and the like: ports, robots' bits, stimuli and places.

use std::fmt::Write;

use crate::swarm::SwarmTrace;

/// Microseconds of one actuation cycle: 84 env steps of 3 ms (docs/physics.md 1 and 10).
const CYCLE: u64 = 252_000;

/// One signal over time.
struct Wave {
    name: String,
    values: Values,
}

enum Values {
    /// Bits with the times from which they hold.
    Bits(Vec<(u64, bool)>),
    /// Numbers with the times from which they hold.
    Reals(Vec<(u64, f64)>),
}

/// Signals with one name in front.
struct Scope {
    name: String,
    waves: Vec<Wave>,
}

/// A trace as a value change dump. Inputs and stimuli hold from a cycle's start, outputs from the end of the cycle that made them; the
/// places of the robots are in voxels.
pub fn vcd(trace: &SwarmTrace) -> String {
    let scopes = scopes(trace);
    let mut text = String::from("$version nbc $end\n$timescale 1 us $end\n");
    declare(&mut text, &identifier(&trace.circuit), &scopes);
    let mut changes: Vec<(u64, usize, String)> = Vec::new();
    for (number, wave) in scopes.iter().flat_map(|scope| &scope.waves).enumerate() {
        changes.extend(changes_of(wave, number));
    }
    changes.sort_by_key(|&(time, number, _)| (time, number));
    let mut now = None;
    for (time, _, change) in changes {
        if now != Some(time) {
            writeln!(text, "#{time}").expect("text can be written to a string");
            now = Some(time);
        }
        text.push_str(&change);
        text.push('\n');
    }
    writeln!(text, "#{}", trace.cycles.len() as u64 * CYCLE).expect("text can be written to a string");
    text
}

fn scopes(trace: &SwarmTrace) -> Vec<Scope> {
    let starts = |bit: &dyn Fn(usize) -> bool| {
        Values::Bits((0..trace.cycles.len()).map(|c| (c as u64 * CYCLE, bit(c))).collect())
    };
    let ends = |bit: &dyn Fn(usize) -> bool| {
        Values::Bits((0..trace.cycles.len()).map(|c| ((c as u64 + 1) * CYCLE, bit(c))).collect())
    };
    let port = |name: &String, values| Wave { name: identifier(name), values };
    let inputs = trace.inputs.iter().enumerate().map(|(i, name)| port(name, starts(&|c| trace.cycles[c].inputs[i])));
    let outputs = trace.outputs.iter().enumerate().map(|(o, name)| port(name, ends(&|c| trace.cycles[c].outputs[o])));
    let mut scopes = vec![
        Scope { name: "inputs".to_owned(), waves: inputs.collect() },
        Scope { name: "outputs".to_owned(), waves: outputs.collect() },
    ];
    for (k, robot) in trace.robots.iter().enumerate() {
        let wave = |name: &str, values| Wave { name: name.to_owned(), values };
        let pace = trace.samples_per_cycle.max(1) as u64;
        let places = robot.com_x.iter().enumerate().map(|(i, &x)| (i as u64 * CYCLE / pace, x));
        let waves = vec![
            wave("bit", ends(&|c| trace.cycles[c].bits[k])),
            wave("stimulus_1", starts(&|c| trace.cycles[c].sensed[k][0])),
            wave("stimulus_2", starts(&|c| trace.cycles[c].sensed[k][1])),
            wave("x", Values::Reals(places.collect())),
        ];
        scopes.push(Scope { name: format!("robot_{}", identifier(&robot.net)), waves });
    }
    scopes
}

fn declare(text: &mut String, circuit: &str, scopes: &[Scope]) {
    let mut number = 0;
    text.push_str(&format!("$scope module {circuit} $end\n"));
    for scope in scopes {
        text.push_str(&format!("$scope module {} $end\n", scope.name));
        for wave in &scope.waves {
            let kind = match wave.values {
                Values::Bits(_) => "wire 1",
                Values::Reals(_) => "real 64",
            };
            text.push_str(&format!("$var {kind} {} {} $end\n", code(number), wave.name));
            number += 1;
        }
        text.push_str("$upscope $end\n");
    }
    text.push_str("$upscope $end\n$enddefinitions $end\n");
}

/// The moments at which a signal changes, with the lines that say so; before its first value a bit is unknown.
fn changes_of(wave: &Wave, number: usize) -> Vec<(u64, usize, String)> {
    let code = code(number);
    match &wave.values {
        Values::Bits(bits) => {
            let unknown = bits.first().is_none_or(|&(time, _)| time > 0).then(|| (0, number, format!("x{code}")));
            let changed = bits.iter().enumerate().filter(|&(i, &(_, bit))| i == 0 || bits[i - 1].1 != bit);
            let told = changed.map(|(_, &(time, bit))| (time, number, format!("{}{code}", u8::from(bit))));
            unknown.into_iter().chain(told).collect()
        }
        Values::Reals(reals) => {
            let changed =
                reals.iter().enumerate().filter(|&(i, &(_, x))| i == 0 || reals[i - 1].1.to_bits() != x.to_bits());
            changed.map(|(_, &(time, x))| (time, number, format!("r{x} {code}"))).collect()
        }
    }
}

/// The short name of a signal: printable ASCII, counted like numbers.
fn code(mut number: usize) -> String {
    let mut code = String::new();
    loop {
        code.push(char::from(b'!' + (number % 94) as u8));
        number /= 94;
        if number == 0 {
            return code;
        }
        number -= 1;
    }
}

/// A name that readers of dumps take: letters, digits and underscores.
fn identifier(name: &str) -> String {
    let name: String = name.chars().map(|c| if c.is_ascii_alphanumeric() { c } else { '_' }).collect();
    name.trim_end_matches('_').to_owned()
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeSet;

    use super::*;

    #[test]
    fn codes_are_different() {
        let codes: BTreeSet<String> = (0..20_000).map(code).collect();
        assert_eq!(codes.len(), 20_000);
        assert!(codes.iter().all(|code| code.bytes().all(|b| b.is_ascii_graphic())));
    }

    #[test]
    fn names_have_no_blanks() {
        assert_eq!(identifier("a[3]"), "a_3");
        assert_eq!(identifier("n 1"), "n_1");
    }
}
