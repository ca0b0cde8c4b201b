//! Bodies that see, from the text of a program to the images that they tell apart.

use nbc_base::model::{Body, Evolution, ImageOrder, Pattern, Program, SearchObjective, Setting, Trial};
use nbc_base::source::MemoryWorld;
use nbc_session::Session;
use nbc_session::store::DiskWorld;
use nbc_sim::Simulator;

use crate::support::*;

/// Images of two rows and columns: those with ink on top, and those with ink below.
const SPOTS: &str = "a,b,c,d,label\n4,4,0,0,top\n3,4,1,0,top\n0,0,4,4,bottom\n0,1,4,3,bottom\n1,0,3,4,bottom\n";

const PROGRAM: &str = "\
stimulus spot[2][2]

material dark  { kind: sensor, stimulus: spot, absent: 1.6, present: 0.6 }
material light { kind: sensor, stimulus: spot, absent: 0.6, present: 1.6 }

images tops    { stimulus: spot, from: \"spots.csv\", white: 4, label: top }
images bottoms { stimulus: spot, from: \"spots.csv\", white: 4, label: bottom, take: 2..3 }

schedule spots(spot) {
    tops    for 20 steps
    bottoms for 30 steps
}

evolution tell {
    box:         3 x 3
    materials:   [muscle, antimuscle, dark, light]
    genome:      voxels
    objective:   images
    variable:    spots
    descriptors: [voxels in 3 bins, sensory in 3 bins]
    batch:       6
    generations: 4
    seed:        5
}

evolution tell_in_turn { from: tell, shown: in_turn }
";

fn program() -> Program {
    let mut world = MemoryWorld::default();
    world.insert("spots.csv", SPOTS);
    world.insert("tell.nb", PROGRAM);
    let checked = Session::new(world).checked("tell.nb").clone();
    assert!(checked.diagnostics.is_empty(), "{:?}", checked.diagnostics);
    checked.program.clone()
}

#[test]
fn a_schedule_shows_each_image_of_its_sets_and_numbers_the_sets() {
    let program = program();
    let spells = &program.schedule("spots").unwrap().schedule.spells;
    let shown: Vec<(Pattern, u32, &[f64])> =
        spells.iter().map(|spell| (spell.pattern, spell.steps, spell.image.as_ref().unwrap().pixels())).collect();
    let [top, bottom] = [false, true].map(|second| Pattern::new(&[second]));
    let expected: [(Pattern, u32, &[f64]); 4] = [
        (top, 20, &[1.0, 1.0, 0.0, 0.0]),
        (top, 20, &[0.75, 1.0, 0.25, 0.0]),
        (bottom, 30, &[0.0, 0.25, 1.0, 0.75]),
        (bottom, 30, &[0.25, 0.0, 0.75, 1.0]),
    ];
    assert_eq!(shown, expected);
    let Evolution { objective, shown, variable, .. } = program.evolution("tell").unwrap();
    assert_eq!((*objective, *shown, &variable.spells), (SearchObjective::Images, ImageOrder::Apart, spells));
    assert_eq!(program.evolution("tell_in_turn").unwrap().shown, ImageOrder::InTurn);
}

#[test]
fn a_program_with_images_is_in_canonical_form() {
    let bench = Bench::with("spots.csv", SPOTS);
    bench.file("tell.nb", PROGRAM.replace("stimulus spot[2][2]", "stimulus   spot [ 2 ] [2]"));
    bench.ok("fmt tell.nb");
    assert_eq!(bench.read("tell.nb"), PROGRAM);
}

#[test]
fn bodies_are_evolved_and_tell_the_images_that_they_were_evolved_with_apart_as_the_archive_says() {
    let bench = Bench::with("spots.csv", SPOTS);
    bench.file("tell.nb", PROGRAM);
    for run in ["tell", "tell_in_turn"] {
        bench.ok(&["evolve", "tell.nb", "--run", run]);
    }
    let seen = bench.ok("see tell.nb spots out/tell --best 3 --format json");
    let found = validate("see", &seen.out);
    let bodies = found["bodies"].as_array().unwrap();
    assert!((1..=3).contains(&bodies.len()), "{found}");
    for body in bodies {
        let sets = body["sets"].as_array().unwrap();
        let least = sets.iter().map(|set| set["least"].as_f64().unwrap()).fold(f64::INFINITY, f64::min);
        assert_eq!(body["least"].as_f64(), Some(least), "the archive has what the body does");
        assert_eq!((&sets[0]["set"], &sets[1]["set"], &body["images"]), (&"tops".into(), &"bottoms".into(), &4.into()));
        assert_ne!(sets[0]["way"], sets[1]["way"]);
        assert!(least <= 0.0 || body["accuracy"] == 1.0, "{body}");
    }
    let text = bench.run("see tell.nb spots out/tell/seed-5");
    assert!(text.out.starts_with("1 body before the images of spots\nevolution  seed"), "{}", text.out);
    let map = bench.run("see tell.nb spots out/tell --map needed.svg");
    assert_eq!((map.status, &map.out), (0, &bench.run("see tell.nb spots out/tell").out), "{}", map.err);
    let picture = bench.read("needed.svg");
    assert!(["losses", "mean-tops", "mean-bottoms"].iter().all(|part| picture.contains(&format!("id=\"{part}\""))));
    let both = ["see", "tell.nb", "spots", "out/tell", "out/tell_in_turn", "--best", "2", "--chart", "chart.svg"];
    let ran = bench.ok(&both);
    let of = |evolution: &str| ran.out.lines().filter(|line| line.starts_with(&format!("{evolution}  "))).count();
    assert_eq!([of("tell"), of("tell_in_turn")], [2, 2], "{}", ran.out);
    assert!(ran.out.lines().any(|line| line.starts_with("tell: ") && line.contains(" % on average, ")), "{}", ran.out);
    let chart = bench.read("chart.svg");
    for part in ["evolution-tell\"", "evolution-tell_in_turn\"", "2 bodies"] {
        assert!(chart.contains(part), "{part}");
    }
    // The same seed again, with an interruption, gives the same bits.
    let checkpoint = |folder: &str| fs::read(bench.path().join(folder).join("tell/seed-5/checkpoint.nbc")).unwrap();
    for generations in [&["--generations", "2"][..], &["--resume"]] {
        let again = ["evolve", "tell.nb", "--run", "tell", "--out", "again"];
        bench.ok(&[&again[..], generations].concat());
    }
    assert_eq!(checkpoint("out"), checkpoint("again"));
}

#[test]
fn a_body_of_a_run_is_simulated_and_drawn_before_images() {
    let bench = Bench::with("spots.csv", SPOTS);
    bench.file("tell.nb", PROGRAM);
    bench.ok("evolve tell.nb --run tell");
    let seen = bench.run("see tell.nb spots out/tell --format json");
    let best = &validate("see", &seen.out)["bodies"][0];
    let behavior = if best["sets"][0]["way"] == "right" { "RRLL" } else { "LLRR" };
    let shown = ["--behavior", behavior, "--images", "tell.nb", "--schedule", "tops*20steps bottoms*30steps"];
    let simulate = |more: &[&str]| bench.run(&[&["simulate", "out/tell"], more].concat());

    let program = program();
    let evolution = program.evolution("tell").unwrap();
    let rows: Vec<&str> = best["body"].as_array().unwrap().iter().map(|row| row.as_str().unwrap()).collect();
    let body = Body::parse(&rows, &evolution.palette).unwrap();
    let trial = Trial { body, schedule: evolution.variable.clone() };
    let walked = Simulator::default().run_trials(&Setting::default(), std::slice::from_ref(&trial)).remove(0);
    let ran = simulate(&[&shown[..], &["--format", "json"]].concat());
    assert_eq!(ran.status, 0, "{}", ran.err);
    let found = validate("simulate", &ran.out);
    assert_eq!(found["displacement"], json!(walked.displacements(&trial.schedule)));
    let text = simulate(&shown).out;
    let first: Vec<&str> = text.lines().filter_map(|line| line.split("  ").next()).collect();
    assert_eq!(first[1..5], ["tops 1", "tops 2", "bottoms 1", "bottoms 2"], "{text}");

    for (kind, file) in [("gif", "film.gif"), ("strip", "strip.svg"), ("pose", "pose.svg"), ("spacetime", "path.svg")] {
        bench.ok(&[&["draw", "out/tell", "--as", kind, "-o", file][..], &shown].concat());
    }
    let picture = |file: &str| bench.read(file);
    // A strip shows all images, of which three have a pixel that is three quarters black; a pose shows the last one.
    assert_eq!(["strip.svg", "pose.svg"].map(|file| picture(file).matches("\"#535353\"").count()), [3, 1]);
    assert!(!picture("path.svg").contains("stimulus"));
    // The page of a run lets its elites walk before the first image of each set.
    bench.ok("draw out/tell --as report -o page.html");
    assert!(picture("page.html").contains(r#""images":[[[1.0,1.0],[0.0,0.0]],[[0.0,0.25],[1.0,0.75]]]"#));

    let (images, behavior) = (&shown[2..], &shown[..2]);
    simulate(images).expect_fault(&["`out/tell` is a run, expected one `--behavior` of it", "it has bodies with"]);
    let dark = [behavior, &["--schedule", "00*1"]].concat();
    simulate(&dark).expect_fault(&["the body senses images of 2 x 2 pixels, but is shown none", "`--images`"]);
    let drawn = bench.run(&[&["draw", "out/tell", "--as", "gif", "-o", "dark.gif"][..], behavior].concat());
    drawn.expect_fault(&["the body senses images of 2 x 2 pixels, but is shown none"]);
    let blind = bench.run("simulate nand --schedule 00*1 --images tell.nb");
    blind.expect_fault(&["`--images` is for bodies that sense images"]);
    let own = bench.run("simulate nand --schedule 00*1 --behavior nand");
    own.expect_fault(&["`--behavior` chooses among the robots of runs"]);
}

#[test]
fn images_are_read_from_png() {
    let bench = Bench::new();
    let mut png = png::Encoder::new(fs::File::create(bench.path().join("top.png")).unwrap(), 2, 2);
    png.set_color(png::ColorType::Grayscale);
    png.write_header().unwrap().write_image_data(&[255, 255, 51, 0]).unwrap();
    bench.file("top.nb", "stimulus spot[2][2]\nimages top { stimulus: spot, from: \"top.png\" }\n");
    let checked = Session::new(DiskWorld).open(bench.path().join("top.nb").to_str().unwrap()).unwrap();
    assert_eq!(checked.program.images[0].images[0].pixels(), [1.0, 1.0, 0.2, 0.0]);
}

#[test]
fn images_and_bodies_that_do_not_fit_are_refused() {
    let bench = Bench::with("spots.csv", SPOTS);
    let other = "\nschedule one(spot) {\n    tops for 9 steps\n}\n";
    bench.file("tell.nb", format!("{PROGRAM}{other}"));
    bench.ok("evolve tell.nb --run tell --generations 1");
    let see = |file: &str, schedule: &str| bench.run(&["see", file, schedule, "out/tell"]);
    see("tell.nb", "spot").expect_fault(&["no schedule is called `spot`", "`spots`"]);
    see("tell.nb", "one").expect_fault(&["the schedule `one` shows 1 set of images, expected 2 sets"]);
    bench.file("dark.nb", PROGRAM.replace("[muscle, antimuscle, dark, light]", "[muscle, dark, light]"));
    see("dark.nb", "spots").expect_fault(&["the bodies have other materials than `tell` declares"]);
    bench.file("gates.nb", "evolution tell { from: gates }\n\nschedule spots(s1, s2) {\n    0 0 for 9 steps\n}\n");
    see("gates.nb", "spots").expect_fault(&["the bodies of `tell` see no images"]);
}

#[test]
fn the_programs_of_the_library_read_their_images() {
    let bench = Bench::new();
    for file in ["library/seeing.nb", "library/seeing/experiments.nb"] {
        let path = root().join(file);
        let ran = bench.run(&["check", path.to_str().unwrap()]);
        assert_eq!((ran.status, ran.err.as_str()), (0, ""), "{}", ran.out);
    }
}
