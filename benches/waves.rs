//! The wave machines of docs/waves.md beside the same circuits with latches: `cargo bench --bench waves`. It takes some
//! minutes.

use std::fs;
use std::process::ExitCode;

use nbc_base::model::CircuitTest;
use nbc_base::source::MemoryWorld;
use nbc_circuit::Effort;
use nbc_session::{CompileOptions, Session, TestOptions};
use nbc_swarm::Level;

use aims::Aims;

mod aims;

/// Machines that are in no file of the gallery.
const MORE: &str = "
circuit counter4(clk) -> (c[4]) { c = register(c + 4'd1, clk) }
test counter4 { clk | c
 0 | 4'd0
 ^ | 4'd1
 ^ | 4'd2
 ^ | 4'd3
 ^ | 4'd4
}
circuit gray(clk) -> (g[3]) {
    c = register(c + 3'd1, clk)
    g = {c[2], c[2] xor c[1], c[1] xor c[0]}
}
test gray { clk | g
 0 | 000
 ^ | 001
 ^ | 011
 ^ | 010
}
circuit lfsr4(clk) -> (s[4]) { s = register[start = 1]({s[2..0], s[3] xor s[2]}, clk) }
test lfsr4 { clk | s
 0 | 0001
 ^ | 0010
 ^ | 0100
 ^ | 1001
 ^ | 0011
}
circuit shift8(d, clk) -> (q[8]) { q = register({q[6..0], d}, clk) }
test shift8 { clk d | q
 0 1 | 00000000
 ^ 1 | 00000001
 ^ 0 | 00000010
 ^ 1 | 00000101
}
";

/// A machine: its file, its circuit, and the most robots and cycles of a step that it is to have, if that is an aim.
type Machine = (&'static str, &'static str, Option<(usize, usize)>);

const MACHINES: [Machine; 12] = [
    ("counter.nb", "counter", Some((8, 2))),
    ("", "counter4", Some((11, 2))),
    ("", "gray", Some((8, 2))),
    ("wave_lfsr.nb", "wave_lfsr", Some((5, 1))),
    ("lfsr.nb", "lfsr", None),
    ("", "lfsr4", Some((8, 1))),
    ("", "shift8", Some((8, 1))),
    ("rule_110.nb", "rule_110_ring", Some((60, 3))),
    ("sequence_detector.nb", "", None),
    ("t_flip_flop.nb", "", None),
    ("computer.nb", "fibonacci", None),
    ("computer.nb", "product", Some((130, 7))),
];

/// The product of robots and cycles of a step is to be smaller by this factor.
const FACTOR: f64 = 6.0;

/// A circuit in one form.
struct Form {
    robots: usize,
    /// Cycles of a step; the mean over the steps of the test.
    cycles: f64,
    threads: u32,
}

impl Form {
    fn of(text: &str, circuit: &str, fields: &str) -> Result<Self, String> {
        let mut world = MemoryWorld::default();
        // Swarms of the gallery's files would be tested, too.
        let own = text.lines().filter(|line| !line.starts_with("swarm ")).collect::<Vec<_>>().join("\n");
        world.insert("m.nb", format!("{own}\nswarm measured {{ circuit: {circuit}, {fields} }}\n"));
        let mut session = Session::new(world);
        let checked = session.open("m.nb").map_err(|error| format!("{error:?}"))?;
        let test: &CircuitTest =
            checked.program.tests.iter().find(|test| test.circuit.circuit == circuit).ok_or("no test")?;
        let compile = CompileOptions { effort: Effort::Normal, ..CompileOptions::default() };
        let options = TestOptions { level: Some(Level::Physics), compile };
        let case = checked.cases(test, &options).map_err(|error| error.list[0].message.clone())?.remove(0);
        let robots = case.robots();
        let compiled = checked.compile(&circuit.into(), &options.compile).map_err(|e| format!("{e:?}"))?;
        if let Some(machine) = &compiled.mapping.waves {
            return Ok(Self { robots, cycles: machine.cycles_per_step() as f64, threads: machine.period });
        }
        // Both halves of a pulse are a step.
        let steps = case.rows().windows(2).filter(|pair| pair[0].row == pair[1].row).count();
        let cycles: usize = case.row_holds().iter().skip(1).map(|row| row.hold).sum();
        Ok(Self { robots, cycles: cycles as f64 / steps as f64, threads: 1 })
    }

    fn product(&self) -> f64 {
        self.robots as f64 * self.cycles
    }
}

fn main() -> ExitCode {
    let mut aims = Aims::default();
    println!(
        "| circuit | latches: robots, cycles a step | waves: robots, cycles a step, threads | product smaller by |"
    );
    println!("|---|---|---|---|");
    let mut checks = Vec::new();
    for (file, circuit, aim) in MACHINES {
        let text = match file {
            "" => MORE.to_owned(),
            file => fs::read_to_string(format!("circuits/{file}")).unwrap(),
        };
        let circuit = if circuit.is_empty() { file.strip_suffix(".nb").unwrap() } else { circuit };
        let latched = Form::of(&text, circuit, "registers: master_slave");
        let waves = Form::of(&text, circuit, "registers: waves");
        let (Ok(latched), Ok(waves)) = (&latched, &waves) else {
            let errors: Vec<String> = [latched, waves].into_iter().filter_map(Result::err).collect();
            println!("| {circuit} | {} | | |", errors.join("; "));
            continue;
        };
        let factor = latched.product() / waves.product();
        println!(
            "| `{circuit}` | {}, {:.1} | {}, {}, {} | {factor:.1} |",
            latched.robots, latched.cycles, waves.robots, waves.cycles, waves.threads
        );
        if let Some((robots, cycles)) = aim {
            let is_met = waves.robots <= robots && waves.cycles <= cycles as f64;
            checks.push((is_met, format!("{circuit} in {robots} robots and {cycles} cycles at most")));
        }
        if !file.is_empty() {
            checks.push((factor >= FACTOR, format!("{circuit} smaller by {FACTOR} at least")));
        }
    }
    checks.into_iter().for_each(|(is_met, aim)| aims.check(is_met, aim));
    aims.end()
}
