//! `--device` and `nbc devices` of the program.

use crate::gpu::{device, first_device};

use crate::support::*;

const RUNS: &str = "\
evolution walks { from: gates, box: 3 x 2, variable: short, fixed: 1 cycles, batch: 6, generations: 6, seed: 3 }
evolution turns { from: walks, objective: gate, batch: 2, generations: 2 }
";

fn without_drivers(bench: &Bench, arguments: &[&str]) -> Ran {
    let output = bench.command(arguments).env("OCL_ICD_VENDORS", bench.path()).output_in_time();
    let text = |bytes| String::from_utf8(bytes).unwrap();
    Ran { status: output.status.code().unwrap(), out: text(output.stdout), err: text(output.stderr) }
}

#[test]
fn devices_are_listed_with_their_verdict() {
    if device().is_none() {
        return;
    }
    let bench = Bench::new();
    let listed = bench.ok("devices --format json");
    let devices = &validate("devices", &listed.out)["devices"];
    assert!(devices[0]["usable"] == true && devices[0]["boxes"][0]["different"] == 0, "{devices}");
    let text = bench.run("devices").out;
    assert!(text.contains("gpu:0") && text.contains("simulations with the bits of this processor"), "{text}");
}

#[test]
fn simulations_have_the_same_bytes_on_a_device() {
    if device().is_none() {
        return;
    }
    let bench = Bench::with("walker.yaml", "body: [\"00345\", \"33333\"]\n");
    let simulate = |device: &str| {
        let ran =
            bench.run(&["simulate", "walker.yaml", "--schedule", "01*1 10*1", "--format", "json", "--device", device]);
        assert_eq!(ran.status, 0, "{}", ran.err);
        ran.out
    };
    let expected = simulate("cpu");
    assert_eq!(simulate("gpu"), expected);
    assert_eq!(simulate("gpu:0"), expected);
    assert_eq!(simulate("auto"), expected);
}

#[test]
fn evolutions_write_the_same_bytes_on_a_device() {
    if device().is_none() {
        return;
    }
    let bench = Bench::new();
    bench.runs("runs.nb", RUNS);
    let evolve = |device: &str| {
        bench.ok(&["evolve", "runs.nb", "--out", device, "--device", device]);
        let read =
            |run: &str, file: &str| fs::read(bench.path().join(device).join(run).join("seed-3").join(file)).unwrap();
        [("walks", "checkpoint.nbc"), ("walks", "progress.jsonl"), ("turns", "checkpoint.nbc")]
            .map(|(run, file)| read(run, file))
    };
    assert_eq!(evolve("gpu"), evolve("cpu"));
}

#[test]
fn circuits_run_the_same_on_a_device() {
    if device().is_none() {
        return;
    }
    let run = |device: &str| {
        let bench = Bench::with(
            "flip.nb",
            "circuit flip(a) -> (y) {\n    y = not a\n}\n\ntest flip {\n    a | y\n    0 | 1\n}\n",
        );
        bench.ok(&["run", "flip.nb", "--no-report", "--device", device]);
        let tested = bench.ok(&["test", "flip.nb", "--physics", "--format", "json", "--device", device]);
        (bench.read("out/flip/result.json"), tested.out)
    };
    assert_eq!(run("gpu"), run("cpu"));
}

#[test]
fn a_device_that_is_not_there_is_reported() {
    let bench = Bench::with("walker.yaml", "body: [\"00345\", \"33333\"]\n");
    let simulate = |device: &'static str| ["simulate", "walker.yaml", "--schedule", "01*1", "--device", device];
    without_drivers(&bench, &simulate("gpu")).expect_fault(&["no OpenCL driver was found", "install the driver"]);
    without_drivers(&bench, &["devices"]).expect_fault(&["no OpenCL driver was found"]);
    let auto = without_drivers(&bench, &simulate("auto"));
    assert_eq!((auto.status, &auto.out), (0, &bench.run(&simulate("cpu")).out));
    bench.run(&simulate("cuda")).expect_fault(&["expected cpu, gpu, auto, or a device such as gpu:1"]);
    if first_device().is_some() {
        bench.run(&simulate("gpu:99")).expect_fault(&["there is no device `gpu:99`", "`nbc devices` lists them"]);
    }
}
