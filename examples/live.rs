//! A door in a few lines: steps the latch, from a source in memory, cycle by cycle with inputs typed on standard input.
//!
//!     cargo run --release --no-default-features --example live
//!
//! A line has a bit for each input and a number of cycles: `11 6`, then `00 4`.

use std::error::Error;
use std::io::{BufRead, Write, stdin, stdout};

use nbc::{Choice, CompileOptions, MemoryWorld, Session};

fn main() -> Result<(), Box<dyn Error>> {
    converse(stdin().lock(), &mut stdout())
}

/// Steps the latch as the lines of `input` say, and writes its outputs after each line.
pub fn converse(input: impl BufRead, output: &mut impl Write) -> Result<(), Box<dyn Error>> {
    let mut session = Session::new(MemoryWorld::default());
    session.update("latch.nb", 1, include_str!("../circuits/latch.nb"));
    let checked = session.open("latch.nb")?;
    let circuit = checked.circuit(&Choice::default())?;
    let compiled = checked.compile(&circuit, &CompileOptions::default())?;
    let mut swarm = session.swarm(&compiled);
    let names = swarm.trace().inputs.iter().map(|port| port.name.as_str()).collect::<Vec<_>>().join(" ");
    let width = names.split(' ').count();
    writeln!(output, "{} robots, inputs {names}", compiled.assembly.members.len())?;
    for line in input.lines() {
        let line = line?;
        let (bits, cycles) = line.split_once(' ').unwrap_or((line.as_str(), "1"));
        let bits: Vec<bool> = bits.chars().filter_map(|bit| bit.to_digit(2)).map(|bit| bit == 1).collect();
        let Some(cycles) = cycles.parse().ok().filter(|_| bits.len() == width) else {
            writeln!(output, "expected {width} bits and a number of cycles, such as `11 6`")?;
            continue;
        };
        for _ in 0..cycles {
            swarm.step(&bits)?;
        }
        if let Some(cycle) = swarm.trace().cycles.len().checked_sub(1) {
            let values = swarm.trace().output_values(cycle);
            let ports = swarm.trace().outputs.iter().zip(values);
            let shown: Vec<String> = ports.map(|(port, value)| format!("{} {value}", port.name)).collect();
            writeln!(output, "cycle {}: {}", cycle + 1, shown.join(", "))?;
        }
    }
    Ok(())
}
