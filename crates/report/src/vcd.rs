//! Waveforms as a value change dump (IEEE 1364, section 18), for GTKWave, Surfer and the like: ports, robots' bits,
//! stimuli and places.
//!
//! The text is written here, not with the `vcd` crate: its writer takes one change at a time and returns an error for
//! each, while a trace is text in memory.

use std::collections::BTreeSet;
use std::fmt::Write;

use nbc_base::model::Column;
use nbc_swarm::SwarmTrace;

/// Microseconds of one actuation cycle: 84 env steps of 3 ms (docs/physics.md 1 and 10).
const CYCLE: u64 = 252_000;

/// One signal over time.
struct Wave {
    name: String,
    values: Values,
}

enum Values {
    /// Values of this many bits, as digits, with their start times.
    Bits(usize, Vec<(u64, String)>),
    /// Numbers with their start times.
    Reals(Vec<(u64, f64)>),
    /// Words with their start times: an extension that GTKWave, Surfer and others read.
    Words(Vec<(u64, String)>),
}

/// Signals with one name in front, in a part of the circuit.
struct Scope {
    part: Vec<String>,
    name: String,
    waves: Vec<Wave>,
}

/// A trace as a value change dump. Inputs and stimuli change at the start of a cycle, outputs at the end of the cycle
/// that produced them. Positions of robots are given at the start and at the end of each cycle, in voxels to the
/// hundredth.
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
    let digit = |bit: bool| u8::from(bit).to_string();
    let cycles = 0..trace.cycles.len();
    let values = |width: usize, delay: u64, digits: &dyn Fn(usize) -> String| {
        Values::Bits(width, cycles.clone().map(|c| ((c as u64 + delay) * CYCLE, digits(c))).collect())
    };
    let input = |(i, port): (usize, &Column)| Wave {
        name: port.name.clone(),
        values: values(port.width, 0, &|c| trace.input_values(c)[i].digits()),
    };
    let output = |(o, port): (usize, &Column)| Wave {
        name: port.name.clone(),
        values: values(port.width, 1, &|c| trace.output_values(c)[o].digits()),
    };
    // The members of enumerations have their names beside the bits.
    let named = |port: &Column, delay: u64, text: &dyn Fn(usize) -> String| {
        let words = cycles.clone().map(|c| ((c as u64 + delay) * CYCLE, text(c)));
        port.members
            .as_ref()
            .map(|_| Wave { name: format!("{}_name", port.name), values: Values::Words(words.collect()) })
    };
    let named_input = |(i, port): (usize, &Column)| named(port, 0, &|c| trace.input_values(c)[i].to_string());
    let named_output = |(o, port): (usize, &Column)| named(port, 1, &|c| trace.output_values(c)[o].to_string());
    let inputs = trace.inputs.iter().enumerate();
    let outputs = trace.outputs.iter().enumerate();
    let input_waves = inputs.clone().map(input).chain(inputs.filter_map(named_input)).collect();
    let output_waves = outputs.clone().map(output).chain(outputs.filter_map(named_output)).collect();
    let mut scopes = vec![
        Scope { part: Vec::new(), name: "inputs".to_owned(), waves: input_waves },
        Scope { part: Vec::new(), name: "outputs".to_owned(), waves: output_waves },
    ];
    let mut robots: Vec<_> = trace.robots.iter().enumerate().collect();
    robots.sort_by(|(_, a), (_, b)| a.block.cmp(&b.block));
    for (k, robot) in robots {
        let wave = |name: &str, values| Wave { name: name.to_owned(), values };
        let ends = robot.com_x.iter().step_by(trace.samples_per_cycle.max(1)).enumerate();
        let places = ends.map(|(cycle, &x)| (cycle as u64 * CYCLE, (x * 100.0).round() / 100.0));
        let stimulus = |i: usize| {
            let bits = values(1, 0, &|c| digit(trace.cycles[c].sensed[k].has(i)));
            wave(&format!("stimulus_{}", i + 1), bits)
        };
        let mut waves = vec![wave("bit", values(1, 1, &|c| digit(trace.cycles[c].bits[k])))];
        waves.extend((0..robot.senses.len()).map(stimulus));
        waves.push(wave("x", Values::Reals(places.collect())));
        let path = robot.block.join("/") + "/";
        let net = robot.net.strip_prefix(&path).unwrap_or(&robot.net);
        scopes.push(Scope { part: robot.block.clone(), name: format!("robot_{net}"), waves });
    }
    scopes
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
            let (kind, range) = match wave.values {
                Values::Bits(1, _) => ("wire 1".to_owned(), String::new()),
                Values::Bits(width, _) => (format!("wire {width}"), format!(" [{}:0]", width - 1)),
                Values::Reals(_) => ("real 64".to_owned(), String::new()),
                Values::Words(_) => ("string 1".to_owned(), String::new()),
            };
            text.push_str(&format!("$var {kind} {} {name}{range} $end\n", code(number)));
            number += 1;
        }
        text.push_str("$upscope $end\n");
    }
    enter(text, part, &[]);
    text.push_str("$upscope $end\n$enddefinitions $end\n");
}

/// Leaves a part of the circuit for another one.
fn enter(text: &mut String, from: &[String], to: &[String]) {
    let common = from.iter().zip(to).take_while(|(from, to)| from == to).count();
    from[common..].iter().for_each(|_| text.push_str("$upscope $end\n"));
    to[common..].iter().for_each(|part| text.push_str(&format!("$scope module {} $end\n", identifier(part))));
}

/// The moments at which a signal changes, with their lines; before its first value it is unknown.
fn changes_of(wave: &Wave, number: usize) -> Vec<(u64, usize, String)> {
    let code = code(number);
    match &wave.values {
        Values::Bits(width, values) => {
            let line = |digits: &str| if *width == 1 { format!("{digits}{code}") } else { format!("b{digits} {code}") };
            let unknown = values.first().is_none_or(|&(time, _)| time > 0).then(|| (0, number, line("x")));
            let changed = values.iter().enumerate().filter(|&(i, value)| i == 0 || values[i - 1].1 != value.1);
            let told = changed.map(|(_, (time, digits))| (*time, number, line(digits)));
            unknown.into_iter().chain(told).collect()
        }
        Values::Reals(reals) => {
            let changed =
                reals.iter().enumerate().filter(|&(i, &(_, x))| i == 0 || reals[i - 1].1.to_bits() != x.to_bits());
            changed.map(|(_, &(time, x))| (time, number, format!("r{x} {code}"))).collect()
        }
        Values::Words(words) => {
            let changed = words.iter().enumerate().filter(|&(i, value)| i == 0 || words[i - 1].1 != value.1);
            changed.map(|(_, (time, text))| (*time, number, format!("s{} {code}", word(text)))).collect()
        }
    }
}

/// A word as a value of a signal, which has no blanks.
fn word(text: &str) -> String {
    text.chars().filter(|c| !c.is_whitespace()).collect()
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

/// Valid names for readers of dumps: letters, digits and underscores. A valid name stays as it is; equal names are
/// numbered.
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

/// A name with other characters replaced: `a[3]` is `a_3`.
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
