//! Waveforms, read back by another reader of dumps.

use nbc_session::report;
use nbc_swarm::Flip;
use vcd::{Command, Header, Parser};

use crate::support::traces::latch;
use crate::support::*;

/// A dump as the other reader sees it.
struct Waves {
    header: Header,
    /// With the time of each, in microseconds.
    commands: Vec<(u64, Command)>,
}

fn read(dump: &[u8]) -> Waves {
    let mut parser = Parser::new(dump);
    let header = parser.parse_header().unwrap();
    assert_eq!(header.timescale, Some((1, vcd::TimescaleUnit::US)));
    let mut now = 0;
    let mut timed = |command| {
        if let Command::Timestamp(time) = command {
            now = time;
        }
        (now, command)
    };
    let commands = parser.map(|command| timed(command.unwrap())).collect();
    Waves { header, commands }
}

/// The times in microseconds and values of a signal, by its full name.
fn changes(waves: &Waves, name: &str) -> Vec<(u64, String)> {
    let path: Vec<&str> = name.split('.').collect();
    let signal = waves.header.find_var(&path).unwrap_or_else(|| panic!("no signal {name}")).code;
    let value = |command: &Command| match command {
        Command::ChangeScalar(code, value) if *code == signal => Some(value.to_string()),
        Command::ChangeVector(code, value) if *code == signal => Some(value.to_string()),
        Command::ChangeReal(code, value) if *code == signal => Some(value.to_string()),
        _ => None,
    };
    waves.commands.iter().filter_map(|(at, command)| Some((*at, value(command)?))).collect()
}

#[test]
fn a_dump_reads_back_with_the_traces_values() {
    let trace = latch(&[(true, true), (false, false)], 3);
    let waves = read(report::vcd(&trace).as_bytes());
    let cycle = 252_000;
    let told = |times: &[(u64, &str)]| times.iter().map(|&(c, bit)| (c * cycle, bit.to_owned())).collect::<Vec<_>>();
    assert_eq!(changes(&waves, "d_latch.inputs.d"), told(&[(0, "1"), (3, "0")]));
    assert_eq!(waves.commands.last().unwrap().0, 6 * cycle);
    let mut expected = vec![(0, "x")];
    for (c, states) in trace.cycles.iter().enumerate() {
        let bit = if states.bits[1] { "1" } else { "0" };
        if expected.last().unwrap().1 != bit {
            expected.push((c as u64 + 1, bit));
        }
    }
    assert_eq!(changes(&waves, "d_latch.robot_q.bit"), told(&expected));
    let places = changes(&waves, "d_latch.robot_q.x");
    assert_eq!(places.len(), trace.cycles.len() + 1, "a place at the start and at the end of each cycle");
    assert_eq!(places[1], (cycle, trace.robots[1].com_x[4].to_string()));
}

#[test]
fn a_bit_that_changes_within_a_cycle_does_so_at_its_env_step() {
    let mut trace = latch(&[(true, true)], 3);
    trace.flips.push(Flip { env_step: 100, robot: 1 });
    let before = trace.cycles[0].bits[1];
    let bits = changes(&read(report::vcd(&trace).as_bytes()), "d_latch.robot_q.bit");
    let digit = |bit: bool| u8::from(bit).to_string();
    assert_eq!(bits[1..3], [(252_000, digit(before)), (300_000, digit(!before))]);
}

#[test]
fn robots_are_in_the_scopes_of_their_parts() {
    let mut trace = latch(&[(true, true), (false, false)], 3);
    let part = |names: &[&str]| names.iter().map(|&name| name.to_owned()).collect::<Vec<_>>();
    trace.robots[1].block = part(&["one", "store[0]"]);
    trace.robots[4].block = part(&["one"]);
    trace.robots[4].net = "one/nq".to_owned();
    let waves = read(report::vcd(&trace).as_bytes());
    for name in ["d_latch.one.store_0.robot_q.bit", "d_latch.one.robot_nq.bit", "d_latch.inputs.d"] {
        assert!(!changes(&waves, name).is_empty(), "{name}");
    }
}

#[test]
fn a_run_writes_its_waveforms_beside_the_report() {
    let bench = Bench::new();
    let program =
        "circuit inverter(a) -> (q) { q = not a }\ntest inverter \"inverts\" {\n    a | q\n    1 | 0\n    0 | 1\n}\n";
    bench.file("not.nb", program);
    bench.ok("run not.nb");
    assert!(bench.path().join("out/not/report.html").is_file());
    let bytes = bench.bytes("out/not/inverter-waves.vcd");
    bench.ok("draw not.nb --as vcd -o a.vcd");
    assert!(bytes == bench.bytes("a.vcd"), "the same run has the same waveforms");
    let waves = read(&bytes);
    let hold = changes(&waves, "inverter.inputs.a")[1].0;
    assert_eq!(changes(&waves, "inverter.inputs.a"), [(0, "1".to_owned()), (hold, "0".to_owned())]);
    assert_eq!(changes(&waves, "inverter.robot_q.bit").last().unwrap().1, "1");
    let places = changes(&waves, "inverter.robot_q.x");
    let place = |time: u64| places.iter().rfind(|(at, _)| *at <= time).unwrap().1.parse::<f64>().unwrap();
    assert!(place(2 * hold) > place(hold), "a robot whose bit is 1 goes right");
}

#[test]
fn an_empty_trace_is_a_dump_too() {
    read(report::vcd(&latch(&[], 1)).as_bytes());
}

#[test]
fn a_bus_is_a_vector_in_the_dump() {
    let mut trace = latch(&[(true, false), (false, true)], 2);
    trace.inputs = vec![nbc_base::model::Column::new("both", 2)];
    (trace.outputs[0].name, trace.outputs[1].name) = ("q_".to_owned(), "__".to_owned());
    let waves = read(report::vcd(&trace).as_bytes());
    let told = changes(&waves, "d_latch.inputs.both");
    assert_eq!(told, [(0, "10".to_owned()), (2 * 252_000, "01".to_owned())]);
    assert!(!changes(&waves, "d_latch.outputs.q_").is_empty() && !changes(&waves, "d_latch.outputs.__").is_empty());
}
