//! A signal ends every command within a second.

use std::process::Stdio;
use std::thread;
use std::time::{Duration, Instant};

use crate::support::*;

const BODY: &str = "body: ['37150', '77735', '02543', '00253', '33333']\n";

const PRODUCTS: &str = "circuit products(a[24], b[24], clk) -> (q[24], r[24]) {
    q = register(a * b, clk)
    r = register(b * a, clk)
}
prove products { always q == r }
";

/// Commands that take much longer than the test lets them, in a folder with the circuits of the gallery.
const COMMANDS: [&str; 15] = [
    "bench",
    "build latch.nb --harden start=1 --worlds 2000",
    "build products.nb",
    "evolve paper.nb --run paper5 --out out --resume",
    "learn rows.csv --hold-out 0",
    "library add body.yaml --into robots",
    "library verify shipped",
    "play latch.nb --port 0",
    "prove products.nb",
    "run computer.nb",
    "see SEEING held_out seen/zeros_and_ones",
    "simulate nand --schedule 00*100000",
    "test latch.nb --vary start=1 --worlds 2000",
    "test computer.nb --physics",
    "watch latch.nb",
];

/// Commands that are quick, or that leave signals to the system, which ends them.
const QUICK: &str = "bug-report check completions devices draw explain export fmt help lsp manual new synth worker \
                     workers";

#[test]
fn each_command_is_asked_or_quick() {
    let help = Bench::new().run("--help").out;
    let listed = help.lines().skip_while(|line| *line != "Commands:").skip(1).take_while(|line| !line.is_empty());
    let asked: Vec<&str> = COMMANDS.iter().filter_map(|command| command.split(' ').next()).collect();
    for command in listed.filter_map(|line| line.split_whitespace().next()) {
        assert!(
            asked.contains(&command) || QUICK.split(' ').any(|quick| quick == command),
            "`{command}` is in one of the lists"
        );
    }
}

#[cfg(unix)]
#[test]
fn every_command_ends_within_a_second_of_a_signal() {
    let bench = Bench::new();
    let copy = |from: &str, to: &str| bench.file(to, fs::read(root().join(from)).unwrap());
    copy("library/paper.nb", "paper.nb");
    for name in ["latch", "computer"] {
        copy(&format!("circuits/{name}.nb"), &format!("{name}.nb"));
    }
    fs::create_dir(bench.path().join("shipped")).unwrap();
    for robot in fs::read_dir(root().join("library/robots")).unwrap() {
        let name = robot.unwrap().file_name().into_string().unwrap();
        copy(&format!("library/robots/{name}"), &format!("shipped/{name}"));
    }
    bench.file("body.yaml", BODY);
    bench.file("products.nb", PRODUCTS);
    let row = |at: u32| {
        let bits = at.wrapping_mul(0x9e37_79b9);
        format!("{bits},{},{}\n", bits ^ bits >> 7, bits.count_ones() >> 1 & 1)
    };
    bench.file("rows.csv", format!("a,b,q\n{}", (0..20_000).map(row).collect::<String>()));
    let seeing = root().join("library/seeing.nb").to_str().unwrap().to_owned();
    let bodies = ["--run", "zeros_and_ones", "--seed", "1", "--generations", "1", "--out", "seen"];
    bench.ok(&[&["evolve", seeing.as_str()], &bodies[..]].concat());
    let mut late = Vec::new();
    for (at, command) in COMMANDS.iter().enumerate() {
        let words = command.split(' ').map(|word| if word == "SEEING" { seeing.as_str() } else { word });
        let arguments: Vec<&str> = words.collect();
        let word = if at % 2 == 0 { "TERM" } else { "INT" };
        // Other tests may keep the machine busy.
        let tries: Vec<String> = (0..3).map_while(|_| too_late(&bench, &arguments, word)).collect();
        late.extend(tries.get(2).map(|said| format!("{command}: {said}")));
    }
    assert!(late.is_empty(), "{}", late.join("\n"));
}

/// What a command said that a signal did not end within a second, or that ended before the signal.
#[cfg(unix)]
fn too_late(bench: &Bench, arguments: &[&str], word: &str) -> Option<String> {
    let command = &mut bench.command(arguments);
    let mut child = command.stdout(Stdio::null()).stderr(Stdio::piped()).spawn().unwrap();
    thread::sleep(Duration::from_millis(500));
    let before = child.try_wait().unwrap();
    if before.is_none() {
        signal(word, child.id());
    }
    let begin = Instant::now();
    let said = String::from_utf8_lossy(&end(child).stderr).into_owned();
    let took = begin.elapsed();
    (before.is_some() || took > Duration::from_secs(1))
        .then(|| format!("{took:?}, {before:?} before the signal\n{said}"))
}
