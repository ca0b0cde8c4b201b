//! Robots: cards, the designer, evolution.

use super::page::{Server, served};
use crate::support::*;

const NAND: &str = "nand_5x5";

#[test]
fn the_library_is_shown_and_a_robot_designed_after_it_is_that_gate() {
    let (_folder, _server, mut page) = served(&[]);
    let library = page.done(json!({ "do": "robots", "path": null }));
    let robots = library["robots"].as_array().unwrap();
    assert!(robots.len() >= 30 && robots.iter().all(|robot| robot["shipped"] == true));
    assert_eq!(library["palette"].as_array().unwrap().len(), 10);
    // Colors that everybody can tell apart.
    let colors: Vec<&str> =
        library["looks"].as_array().unwrap().iter().filter_map(|look| look["color"].as_str()).collect();
    assert!(colors.contains(&"#d55e00") && colors.contains(&"#009e73"), "{colors:?}");
    let nand = robots.iter().find(|robot| robot["name"] == NAND).unwrap();
    let probe = json!({ "do": "probe", "body": nand["body"], "cycles": 2, "character": false });
    let probe = page.done(probe);
    assert_eq!((&probe["letters"], &probe["function"]), (&json!("RRRL"), &json!("nand")));
    assert_eq!((probe["gaits"].as_array().unwrap().len(), &probe["character"]), (4, &json!(null)));
}

const AND: [&str; 5] = ["3a379", "5442a", "44076", "50095", "60016"];

#[test]
fn a_body_of_three_senses_walks_under_eight_patterns() {
    let (_folder, _server, mut page) = served(&[]);
    page.done(json!({ "do": "program", "path": "n.nb", "text": "circuit n(a) -> (q) { q = not a }" }));
    let library = page.done(json!({ "do": "robots", "path": "n.nb" }));
    let card = library["robots"].as_array().unwrap().iter().find(|robot| robot["name"] == "and3_5x5").unwrap();
    assert_eq!((&card["body"], &card["behavior"]), (&json!(AND), &json!("LLLLLLLR")));
    assert_eq!((&card["shipped"], &card["painted"]), (&json!(true), &json!(true)));
    let probe = page.done(json!({ "do": "probe", "body": AND, "cycles": 1, "character": false }));
    assert_eq!((&probe["letters"], &probe["function"]), (&json!("LLLLLLLR"), &json!("and3")));
    assert_eq!((probe["gaits"].as_array().unwrap().len(), probe["displacement"].as_array().unwrap().len()), (8, 8));
    // It looks the same on its card.
    let look = |of: &Value, voxel: usize| {
        let index = of["voxels"][voxel][4].as_u64().unwrap() as usize;
        of["looks"][index].clone()
    };
    let index = card["voxels"][1][4].as_u64().unwrap() as usize;
    assert_eq!((look(&probe, 1)["name"].as_str(), &library["looks"][index]), (Some("s3_grow"), &look(&probe, 1)));
    page.done(json!({ "do": "evolve", "body": ["a79", "343"], "box": [3, 2], "generations": 1, "seed": 1 }));
    let archive = page.event(|event| event["event"] == "archive" && event["generation"] == 1);
    assert_eq!(archive["axes"][1], json!({ "name": "behavior", "bins": 256 }));
    let niches = archive["niches"].as_array().unwrap();
    let letters: Vec<_> = niches.iter().map(|niche| niche["behavior"].as_str().unwrap()).collect();
    assert!(!letters.is_empty() && letters.iter().all(|letters| letters.len() == 8), "{archive}");
}

#[test]
fn a_body_is_measured_and_kept_as_a_robot() {
    let folder = tempfile::tempdir().unwrap();
    fs::create_dir(folder.path().join("circuits")).unwrap();
    let server = Server::start(folder.path(), &[]);
    let mut page = server.page();
    // The NAND of the library: a clock of one cycle is measured in the shortest time.
    let body = json!(["37555", "77765", "02563", "00263", "33333"]);
    let sketch = page.done(json!({ "do": "probe", "body": body, "cycles": 1 }))["character"].take();
    assert_eq!((&sketch["switches"], &sketch["clock"]), (&json!(128), &json!(1)));
    // Robots are beside the program that uses them.
    let kept_as = |name: &str, replace: bool| {
        let mut request = json!({ "do": "keep", "path": "circuits/n.nb", "body": body });
        request["name"] = json!(name);
        request["replace"] = json!(replace);
        request
    };
    let kept = page.done(kept_as("mine", false));
    assert_eq!(kept, json!({ "path": "circuits/robots/mine.yaml", "use": "library own { from: \"robots\" }" }));
    let file = folder.path().join("circuits/robots/mine.yaml");
    let text = fs::read_to_string(&file).unwrap();
    let refused = page.ask(kept_as("mine", false)).unwrap_err();
    assert_eq!((&refused["code"], &refused["help"]), (&json!("exists"), &json!("the name `mine_2` is free")));
    for (name, replace) in [("mine", true), ("mine_2", false)] {
        let id = page.begin(kept_as(name, replace));
        page.done(json!({ "do": "cancel", "of": id }));
        assert_eq!(page.wait(id).unwrap_err()["code"], "cancelled");
    }
    assert_eq!(fs::read_to_string(&file).unwrap(), text);
    assert_eq!(fs::read_dir(file.parent().unwrap()).unwrap().count(), 1);
    let circuit = "circuit n(a, b) -> (c) { c = nand(a, b) }\nswarm s { circuit: n, library: own }";
    let text = format!("{}\n{circuit}\n", kept["use"].as_str().unwrap());
    assert_eq!(page.compile("circuits/n.nb", &text)["robots"][0]["robot"], "mine");
}

#[test]
fn bodies_that_cannot_walk_are_refused_with_the_reason() {
    let (_folder, _server, mut page) = served(&[]);
    for (body, message) in [
        (json!([]), "the body has no voxels"),
        (json!(["000"]), "the body has no voxels"),
        (json!(["33", "3"]), "row 2 has 1 voxel, expected 2 as in row 1"),
        (json!(["30b"]), "row 1, column 3: `b` is not a material code; expected 0 to a"),
        (json!(["111"]), "the body has 0 actuators, expected at least 3"),
        (json!(["33033"]), "the body is not in one piece"),
        (json!(["3".repeat(21)]), "a body has at most 20 rows and columns here"),
    ] {
        let refused = page.ask(json!({ "do": "probe", "body": body, "cycles": 1 })).unwrap_err();
        assert_eq!(refused["message"], message);
    }
    let refused = page.ask(json!({ "do": "keep", "name": "../up", "body": ["343", "303"] })).unwrap_err();
    assert_eq!(refused["message"], "`../up` cannot be the name of a robot");
}

#[test]
fn an_archive_fills_from_a_body_the_same_way_each_time() {
    let (_folder, _server, mut page) = served(&[]);
    let request = json!({ "do": "evolve", "body": ["343", "303"], "box": [3, 2], "generations": 1, "seed": 1 });
    let mut archives = Vec::new();
    for _ in 0..2 {
        let done = page.done(request.clone());
        assert_eq!(done["generations"], 1);
        let niches = page.event(|event| event["event"] == "archive" && event["generation"] == 1)["niches"].take();
        assert!(!niches.as_array().unwrap().is_empty());
        archives.push(niches);
    }
    assert_eq!(archives[0], archives[1]);
    let endless = json!({ "do": "evolve", "body": null, "box": [3, 2], "generations": 1000, "seed": 1 });
    let id = page.begin(endless);
    page.event(|event| event["event"] == "archive");
    page.done(json!({ "do": "cancel", "of": id }));
    assert_eq!(page.wait(id).unwrap_err()["code"], "cancelled");
}

#[test]
fn a_body_of_the_archive_is_of_the_same_kind_in_the_designer() {
    let (_folder, _server, mut page) = served(&[]);
    page.done(json!({ "do": "evolve", "body": null, "box": [3, 3], "generations": 1, "seed": 1 }));
    let archive = page.event(|event| event["event"] == "archive" && event["generation"] == 1);
    let niches = archive["niches"].as_array().unwrap();
    assert!(!niches.is_empty());
    for niche in niches {
        let probe = json!({ "do": "probe", "body": niche["body"], "cycles": 1, "character": false });
        assert_eq!(page.done(probe)["letters"], niche["behavior"], "{niche}");
    }
}
