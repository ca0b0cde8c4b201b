//! Waveforms as a value change dump (IEEE 1364, section 18), for GTKWave, Surfer and the like: ports, robots' bits,
//! stimuli and places.
//!
//! The text is written here, not with the `vcd` crate: its writer takes one change at a time and returns an error for
//! each, while a trace is text in memory. So the tests read dumps with the crate, which knows nothing of this file.

use std::collections::BTreeSet;

use nbc_base::model::{Column, Value};
use nbc_swarm::SwarmTrace;

/// Microseconds of one actuation cycle: 84 env steps of 3 ms (docs/physics.md 1 and 10).
const CYCLE: u64 = 252_000;
const ENV_STEP: u64 = 3_000;

struct Wave {
    name: String,
    /// Its type and width, such as `wire 1`.
    kind: String,
    /// The range of a bus, such as ` [3:0]`.
    range: String,
    /// Start times, and values as they stand before the code of the signal.
    values: Vec<(u64, String)>,
}

impl Wave {
    /// A signal with a value for each cycle, which it takes `delay` cycles later.
    fn new(name: impl Into<String>, kind: &str, delay: u64, values: impl Iterator<Item = String>) -> Self {
        let values = (delay..).map(|cycle| cycle * CYCLE).zip(values).collect();
        Self { name: name.into(), kind: kind.to_owned(), range: String::new(), values }
    }

    fn bits(name: impl Into<String>, width: usize, delay: u64, digits: impl Iterator<Item = String>) -> Self {
        let text = |digits: String| if width == 1 { digits } else { format!("b{digits} ") };
        let mut wave = Self::new(name, &format!("wire {width}"), delay, digits.map(text));
        if wave.values.first().is_none_or(|(time, _)| *time > 0) {
            wave.values.insert(0, (0, text("x".to_owned())));
        }
        if width > 1 {
            wave.range = format!(" [{}:0]", width - 1);
        }
        wave
    }
}

struct Scope {
    part: Vec<String>,
    name: String,
    waves: Vec<Wave>,
}

/// Inputs and stimuli change at the start of a cycle, outputs at the end of the cycle that produced them, and the bits
/// of robots with clocks of their own at an env step. Positions of robots are given at the ends of cycles, in voxels to
/// the hundredth.
pub fn vcd(trace: &SwarmTrace) -> String {
    let scopes = scopes(trace);
    let mut text = String::from("$version nbc $end\n$timescale 1 us $end\n");
    declare(&mut text, &identifier(&trace.circuit), &scopes);
    let mut changes: Vec<(u64, String)> = Vec::new();
    for (number, wave) in scopes.into_iter().flat_map(|scope| scope.waves).enumerate() {
        let (mut values, code) = (wave.values, code(number));
        values.dedup_by(|next, value| next.1 == value.1);
        changes.extend(values.into_iter().map(|(time, value)| (time, value + &code)));
    }
    changes.sort_by_key(|(time, _)| *time);
    for same in changes.chunk_by(|one, next| one.0 == next.0) {
        text += &format!("#{}\n", same[0].0);
        text.extend(same.iter().flat_map(|(_, change)| [change, "\n"]));
    }
    text + &format!("#{}\n", trace.cycles.len() as u64 * CYCLE)
}

fn scopes(trace: &SwarmTrace) -> Vec<Scope> {
    let cycles = 0..trace.cycles.len();
    let inputs: Vec<Vec<Value>> = cycles.clone().map(|cycle| trace.input_values(cycle)).collect();
    let outputs: Vec<Vec<Value>> = cycles.map(|cycle| trace.output_values(cycle)).collect();
    let ports = |name: &str, waves| Scope { part: Vec::new(), name: name.to_owned(), waves };
    let mut scopes = vec![
        ports("inputs", port_waves(&trace.inputs, &inputs, 0)),
        ports("outputs", port_waves(&trace.outputs, &outputs, 1)),
    ];
    let mut robots: Vec<_> = trace.robots.iter().enumerate().collect();
    robots.sort_by(|(_, a), (_, b)| a.block.cmp(&b.block));
    let digit = |bit: bool| u8::from(bit).to_string();
    for (k, robot) in robots {
        let mut bit = Wave::bits("bit", 1, 1, trace.cycles.iter().map(|cycle| digit(cycle.bits[k])));
        for flip in trace.flips.iter().filter(|flip| flip.robot == k) {
            let time = u64::from(flip.env_step) * ENV_STEP;
            let at = bit.values.partition_point(|(other, _)| *other < time);
            let value = digit(bit.values[at - 1].1 != "1");
            bit.values.insert(at, (time, value));
        }
        let mut waves = vec![bit];
        waves.extend((0..robot.senses.len()).map(|i| {
            let bits = trace.cycles.iter().map(|cycle| digit(cycle.sensed[k].has(i)));
            Wave::bits(format!("stimulus_{}", i + 1), 1, 0, bits)
        }));
        let ends = robot.com_x.iter().step_by(trace.samples_per_cycle.max(1));
        waves.push(Wave::new("x", "real 64", 0, ends.map(|x| format!("r{} ", (x * 100.0).round() / 100.0))));
        let path = robot.block.join("/") + "/";
        let net = robot.net.strip_prefix(&path).unwrap_or(&robot.net);
        scopes.push(Scope { part: robot.block.clone(), name: format!("robot_{net}"), waves });
    }
    scopes
}

fn port_waves(ports: &[Column], values: &[Vec<Value>], delay: u64) -> Vec<Wave> {
    let of = |at: usize| values.iter().map(move |all| &all[at]);
    let mut waves: Vec<Wave> = Vec::new();
    for (at, port) in ports.iter().enumerate() {
        waves.push(Wave::bits(&port.name, port.width, delay, of(at).map(Value::digits)));
    }
    // Members of enumerations have their names beside the bits, as words: an extension that GTKWave, Surfer and others
    // read.
    for (at, port) in ports.iter().enumerate().filter(|(_, port)| port.members.is_some()) {
        let words = of(at).map(|value| format!("s{} ", word(&value.to_string())));
        waves.push(Wave::new(format!("{}_name", port.name), "string 1", delay, words));
    }
    waves
}

fn declare(text: &mut String, circuit: &str, scopes: &[Scope]) {
    let mut number = 0;
    text.push_str(&format!("$scope module {circuit} $end\n"));
    let mut part: &[String] = &[];
    for (scope, name) in scopes.iter().zip(identifiers(scopes.iter().map(|scope| scope.name.as_str()))) {
        enter(text, part, &scope.part);
        part = &scope.part;
        text.push_str(&format!("$scope module {name} $end\n"));
        for (wave, name) in scope.waves.iter().zip(identifiers(scope.waves.iter().map(|wave| wave.name.as_str()))) {
            let Wave { kind, range, .. } = wave;
            text.push_str(&format!("$var {kind} {} {name}{range} $end\n", code(number)));
            number += 1;
        }
        text.push_str("$upscope $end\n");
    }
    enter(text, part, &[]);
    text.push_str("$upscope $end\n$enddefinitions $end\n");
}

fn enter(text: &mut String, from: &[String], to: &[String]) {
    let common = from.iter().zip(to).take_while(|(from, to)| from == to).count();
    from[common..].iter().for_each(|_| text.push_str("$upscope $end\n"));
    to[common..].iter().for_each(|part| text.push_str(&format!("$scope module {} $end\n", identifier(part))));
}

fn word(text: &str) -> String {
    text.chars().filter(|c| !c.is_whitespace()).collect()
}

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

/// Letters, digits and underscores. A valid name stays as it is; equal names are numbered.
fn identifiers<'n>(names: impl Iterator<Item = &'n str> + Clone) -> Vec<String> {
    let mut taken: BTreeSet<String> =
        names.clone().filter(|name| identifier(name) == **name).map(str::to_owned).collect();
    let mut seen = BTreeSet::new();
    let mut unique = |name: &str| {
        let plain = identifier(name);
        if plain == name && seen.insert(plain.clone()) {
            return plain;
        }
        let numbered = (2..).map(|number| format!("{plain}_{number}"));
        let free = std::iter::once(plain.clone()).chain(numbered).find(|name| !taken.contains(name));
        let free = free.expect("there are numbers enough");
        taken.insert(free.clone());
        free
    };
    names.map(&mut unique).collect()
}

fn identifier(name: &str) -> String {
    let name = name.strip_suffix(']').unwrap_or(name);
    let plain: String = name.chars().map(|c| if c.is_ascii_alphanumeric() { c } else { '_' }).collect();
    if plain.is_empty() { "_".to_owned() } else { plain }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn codes_are_unique() {
        let codes: BTreeSet<String> = (0..20_000).map(code).collect();
        assert_eq!(codes.len(), 20_000);
        assert!(codes.iter().all(|code| code.bytes().all(|b| b.is_ascii_graphic())));
    }

    #[test]
    fn names_have_no_spaces() {
        assert_eq!(identifier("a[3]"), "a_3");
        assert_eq!(identifier("n 1"), "n_1");
        assert_eq!(identifier("__"), "__");
    }

    #[test]
    fn names_stay_unique() {
        let named = |names: &[&str]| identifiers(names.iter().copied());
        assert_eq!(
            named(&["q", "q_", "__", "a[3]", "a_3", "a/3", ""]),
            ["q", "q_", "__", "a_3_2", "a_3", "a_3_3", "_"]
        );
    }
}
