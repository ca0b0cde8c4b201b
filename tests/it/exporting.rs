//! `nbc export`: archives and libraries as tables, with everything that is in them.

use nbc_session::store::shipped_library;

use crate::support::*;

/// A run with two materials of its own, on two axes of one word.
const RUN: &str = "
material heart { kind: actuator, drive: sine, period: 84 steps, phase: 0 deg, range: 0.9..1.1 }

evolution own {
    box:         3 x 2
    materials:   [heart, bone, s1_grow, s2_shrink]
    descriptors: [voxels in 3 bins, behavior, voxels in 2 bins]
    fixed:       1 cycles
    batch:       6
    generations: 4
    seed:        1..2
}
";

/// A table without quoted commas: its header and its rows.
fn table(text: &str) -> (Vec<&str>, Vec<Vec<&str>>) {
    let mut lines = text.lines().map(|line| line.split(',').collect::<Vec<_>>());
    (lines.next().unwrap(), lines.collect())
}

#[test]
fn a_librarys_table_has_a_row_for_each_robot() {
    let ran = Bench::new().run("export shipped");
    let (head, rows) = table(&ran.out);
    let library = shipped_library();
    assert_eq!((ran.status, rows.len()), (0, library.robots.len()));
    let column =
        |name: &str| head.iter().position(|known| *known == name).unwrap_or_else(|| panic!("{name} in {head:?}"));
    for (row, robot) in rows.iter().zip(&library.robots) {
        assert_eq!(row.len(), head.len());
        assert_eq!(row[column("name")], robot.name);
        assert_eq!(row[column("body")], robot.body.rows().join("|"));
        assert_eq!(row[column("materials")], "", "the paper's");
        assert_eq!(row[column("margin")].parse(), Ok(robot.character.margin), "to the bit");
        assert_eq!(row[column("displacement_01")].parse(), Ok(robot.displacement[1]));
        assert_eq!(row[column("seed")].parse(), Ok(robot.provenance.seed));
        let settle = robot.character.settle.iter().find(|t| t.from.to_string() == "00" && t.to.to_string() == "11");
        assert_eq!(row[column("settle_00_11")].parse(), Ok(settle.unwrap().cycles));
    }
}

#[test]
fn an_archive_is_exported_completely_with_its_materials() {
    let bench = Bench::with("own.nb", RUN);
    bench.ok("evolve own.nb");
    for file in ["elites.csv", "elites.json"] {
        let ran = bench.run(&["export", "out/own", "-o", file]);
        assert_eq!((ran.status, ran.out.as_str(), ran.err), (0, "", format!("wrote {file}\n")));
    }
    let read = |file: &str| bench.read(file);
    let json = validate("elites", &read("elites.json"));
    let elites = json["elites"].as_array().unwrap();
    assert_eq!(json["axes"][2], json!({ "name": "voxels", "bins": 2 }));
    let text = read("elites.csv");
    let head: Vec<&str> = text.lines().next().unwrap().split(',').collect();
    assert!(head.contains(&"niche_voxels_1") && head.contains(&"niche_voxels_3") && head.contains(&"niche_behavior"));
    assert_eq!(text.lines().count(), 1 + elites.len());
    for (line, elite) in text.lines().skip(1).zip(elites) {
        let rows: Vec<&str> = elite["body"].as_array().unwrap().iter().map(|row| row.as_str().unwrap()).collect();
        assert!(line.contains(&format!(",{},\"[{{\"\"name\"\":\"\"heart\"\"", rows.join("|"))), "{line}");
        assert_eq!(elite["materials"].as_array().unwrap().len(), 4);
        let voxels: usize = rows.iter().map(|row| row.chars().filter(|c| *c != '0').count()).sum();
        assert_eq!(elite["voxels"], voxels);
        let hearts: usize = rows.iter().map(|row| row.matches('1').count()).sum();
        assert_eq!(elite["actuators"], hearts);
    }
    let one: Value = bench.run("export out/own/seed-2 --to json").expect_json();
    assert!(one["elites"].as_array().unwrap().iter().all(|elite| elite["seed"] == 2));
}

#[test]
fn impossible_exports_are_reported() {
    let bench = Bench::new();
    bench.run("export none").expect_fault(&["none"]);
    fs::create_dir(bench.path().join("empty")).unwrap();
    bench.run("export empty").expect_fault(&["`empty` contains neither a run nor robots"]);
    let both = bench.run("export shipped --to csv --format json");
    assert!(both.status == 2 && both.err.contains("ask for two formats"), "{}", both.err);
}
