//! Programs and their swarms.

use super::LATCH;
use super::page::{Frame, Page, Server};
use crate::support::*;
use crate::unstable::{BOOM, names};

fn latch() -> (Bench, Server, Page) {
    let bench = Bench::with("latch.nb", LATCH);
    let server = Server::start(bench.path(), &["latch.nb"]);
    let page = server.page();
    (bench, server, page)
}

fn steps(page: &mut Page, cycles: u32) -> Frame {
    let before = page.frames.back().map_or(0, |frame| frame.now);
    page.done(json!({ "do": "step", "cycles": cycles }));
    page.frame(move |frame| !frame.runs && frame.now > before)
}

#[test]
fn a_page_learns_what_is_served() {
    let (folder, _server, mut page) = latch();
    let hello = page.done(json!({ "do": "hello" }));
    assert_eq!(hello["file"], "latch.nb");
    assert_eq!(hello["files"], json!([{ "path": "latch.nb", "size": LATCH.len() }]));
    let root = folder.path().canonicalize().unwrap();
    assert_eq!(hello["root"], format!("file://{}", root.display()));
    let examples: Vec<&str> =
        hello["examples"].as_array().unwrap().iter().map(|one| one["name"].as_str().unwrap()).collect();
    assert!(examples.contains(&"latch.nb") && examples.contains(&"computer.nb"), "{examples:?}");
    let example = page.done(json!({ "do": "read", "example": "latch.nb" }));
    assert_eq!(example["text"], LATCH);
}

#[test]
fn files_are_saved_unless_someone_else_changed_them() {
    let (folder, _server, mut page) = latch();
    let path = folder.path().join("latch.nb");
    let stamp = page.done(json!({ "do": "read", "path": "latch.nb" }))["stamp"].clone();
    let save = |stamp: &Value| json!({ "do": "save", "path": "latch.nb", "text": "// mine\n", "stamp": stamp });
    let saved = page.done(save(&stamp));
    assert_eq!(fs::read_to_string(&path).unwrap(), "// mine\n");
    fs::write(&path, "// theirs, longer\n").unwrap();
    let changed = page.event(|event| event["event"] == "changed");
    assert_eq!(changed["path"], "latch.nb");
    let refused = page.ask(save(&saved["stamp"])).unwrap_err();
    assert_eq!(refused["code"], "changed");
    assert_eq!(fs::read_to_string(&path).unwrap(), "// theirs, longer\n");
    page.done(save(&changed["stamp"]));
    assert_eq!(fs::read_to_string(&path).unwrap(), "// mine\n");
    let new = page.done(json!({ "do": "save", "path": "new.nb", "text": "", "stamp": null }));
    assert!(new["stamp"].is_string() && folder.path().join("new.nb").is_file());
}

#[test]
fn the_latch_computes_live() {
    let (_folder, _server, mut page) = latch();
    let swarm = page.compile("latch.nb", LATCH);
    assert_eq!((&swarm["circuit"], swarm["robots"].as_array().unwrap().len()), (&json!("d_latch"), 5));
    let schematic = swarm["schematic"]["sheets"][0]["svg"].as_str().unwrap();
    for id in ["cell-0", "net-q", "input-d", "output-q"] {
        assert!(schematic.contains(&format!("data-id=\"{id}\"")), "{id}");
    }
    let start = page.frame(|frame| frame.now == 0);
    assert_eq!((start.robots, start.shown, start.cycles), (5, 5, 0));
    // The rows of its test: d, e, and q with its complement.
    for (inputs, outputs) in [("01", 0b10), ("11", 0b01), ("10", 0b01), ("00", 0b01), ("01", 0b10)] {
        page.done(json!({ "do": "inputs", "bits": inputs }));
        let frame = steps(&mut page, 10);
        assert_eq!(frame.outputs(), outputs, "after {inputs}");
    }
}

#[test]
fn going_back_shows_and_does_the_same_again() {
    let (_folder, _server, mut page) = latch();
    page.compile("latch.nb", LATCH);
    page.done(json!({ "do": "inputs", "bits": "11" }));
    let first = steps(&mut page, 7);
    let second = steps(&mut page, 5);
    assert_eq!((second.now, second.last, second.logged + u32::from(second.cycles)), (12, 12, 13));
    page.done(json!({ "do": "seek", "cycle": 7 }));
    let back = page.frame(|frame| frame.now == 7);
    assert_eq!((back.first, back.last, back.cycles), (0, 12, 0));
    assert_eq!(back.poses(), first.poses());
    let again = steps(&mut page, 5);
    assert_eq!((again.now, again.outputs(), again.poses()), (12, second.outputs(), second.poses()));
    page.done(json!({ "do": "reset" }));
    page.frame(|frame| frame.now == 0 && frame.last == 0);
    let anew = steps(&mut page, 7);
    assert_eq!((anew.last, anew.outputs(), anew.poses()), (7, first.outputs(), first.poses()));
    let refused = page.ask(json!({ "do": "seek", "cycle": 8 })).unwrap_err();
    assert_eq!(refused["message"], "the log goes from cycle 0 to 7");
}

#[test]
fn a_clock_changes_an_input_by_itself_and_a_swarm_runs_at_its_pace() {
    let (_folder, _server, mut page) = latch();
    page.compile("latch.nb", LATCH);
    page.done(json!({ "do": "clock", "bit": 1, "half": 3 }));
    page.done(json!({ "do": "run", "speed": null }));
    let mut inputs = Vec::new();
    while inputs.len() < 12 {
        let frame = page.frame(|frame| frame.cycles > 0);
        inputs.extend(frame.rest.chunks_exact(frame.length()).take(frame.cycles.into()).map(|cycle| cycle[0]));
    }
    assert_eq!(inputs[..12], [0, 0, 0, 2, 2, 2, 0, 0, 0, 2, 2, 2]);
    page.done(json!({ "do": "pause" }));
    page.frame(|frame| !frame.runs);
    page.done(json!({ "do": "view", "robots": [3, 1, 3, 9] }));
    assert_eq!(page.frame(|frame| frame.shown == 2).poses()[..2], [1, 0]);
    page.done(json!({ "do": "clock", "bit": 1, "half": u32::MAX }));
    let [before, after] = [1, 3].map(|cycles| steps(&mut page, cycles));
    assert_eq!(after.now, before.now + 3);
}

#[test]
fn tests_run_and_lead_to_their_moment() {
    let (_folder, _server, mut page) = latch();
    let wrong = LATCH.replace("1 0 | 1", "1 0 | 0");
    let program = page.done(json!({ "do": "program", "path": "latch.nb", "text": wrong }));
    assert_eq!(program["tests"][0]["rows"].as_array().unwrap().len(), 5);
    for level in ["logic", "physics"] {
        let answer = page.done(json!({ "do": "test", "path": "latch.nb", "test": 0, "level": level }));
        let verdict = &answer["results"][0];
        let passed: Vec<bool> =
            verdict["rows"].as_array().unwrap().iter().map(|row| row["passed"].as_bool().unwrap()).collect();
        assert_eq!(passed, [true, true, false, true, true], "{level}");
    }
    let replay = json!({ "do": "replay", "path": "latch.nb", "test": 0, "swarm": null, "row": 3 });
    let swarm = page.done(replay)["swarm"].take();
    let frame = page.frame(|frame| json!(frame.number) == swarm["number"] && frame.now > 0);
    assert_eq!((frame.outputs() & 1, frame.runs, frame.last), (1, false, frame.now));
    let missing = json!({ "do": "replay", "path": "latch.nb", "test": 0, "swarm": null, "row": 6 });
    assert_eq!(page.ask(missing).unwrap_err()["message"], "the program has no such test or row");
}

#[test]
fn a_wave_machine_says_whose_waves_its_robots_carry() {
    let (_folder, _server, mut page) = latch();
    let text = include_str!("../../../circuits/wave_counter.nb");
    page.done(json!({ "do": "program", "path": "w.nb", "text": text }));
    let compile = json!({ "do": "compile", "path": "w.nb", "circuit": "wave_counter", "swarm": "sturdy_wave" });
    let swarm = page.done(compile)["swarm"].take();
    let waves = &swarm["waves"];
    let [step, beat, threads, begins] = ["step", "beat", "threads", "begins"].map(|name| waves[name].as_u64().unwrap());
    assert_eq!((beat, waves["clock"].as_u64()), (2, Some(0)));
    assert_eq!((step, begins % beat), (threads * beat, 0));
    assert_eq!(waves["phases"].as_array().unwrap().len(), swarm["robots"].as_array().unwrap().len());
    let answer = page.done(json!({ "do": "test", "path": "w.nb", "test": 0, "level": "physics" }));
    let rows = answer["results"][1]["rows"].as_array().unwrap();
    assert_eq!(rows.iter().filter_map(|row| row["thread"].as_u64()).max(), Some(threads - 1));
    assert!(page.compile("latch.nb", LATCH)["waves"].is_null());
}

#[test]
fn mistakes_are_told_with_their_places() {
    let (_folder, _server, mut page) = latch();
    let text = "circuit a(x) -> (y) { y = not z }";
    let program = page.done(json!({ "do": "program", "path": "a.nb", "text": text }));
    assert_eq!(program["errors"], 1);
    let refused = page.ask(json!({ "do": "compile", "path": "a.nb", "circuit": "a", "swarm": null })).unwrap_err();
    assert_eq!(refused["diagnostics"][0]["code"], "unknown");
    for (request, message) in [
        (json!({ "do": "step", "cycles": 1 }), "no circuit has been compiled"),
        (json!({ "do": "fly" }), "the message is not a request: unknown variant `fly`"),
        (json!({ "do": "read", "example": "x.nb" }), "there is no example `x.nb`"),
        (json!({ "do": "save", "path": "x.txt", "text": "", "stamp": null }), "`x.txt` does not end in `.nb`"),
    ] {
        let refused = page.ask(request).unwrap_err();
        assert!(refused["message"].as_str().unwrap().starts_with(message), "{refused}");
    }
    page.compile("latch.nb", LATCH);
    let refused = page.ask(json!({ "do": "inputs", "bits": "0" })).unwrap_err();
    assert_eq!(refused["message"], "expected 2 input bits, such as `00`");
}

#[test]
fn what_a_swarm_did_can_be_taken_away_once() {
    let (_folder, server, mut page) = latch();
    assert_eq!(
        page.ask(json!({ "do": "take", "what": "csv", "cycles": 5 })).unwrap_err()["message"],
        "no circuit has been compiled"
    );
    page.compile("latch.nb", LATCH);
    page.done(json!({ "do": "inputs", "bits": "11" }));
    steps(&mut page, 9);
    let begins: [(&str, &[u8]); 6] = [
        ("csv", b"cycle,"),
        ("vcd", b"$"),
        ("svg", b"<svg"),
        ("png", b"\x89PNG"),
        ("gif", b"GIF89a"),
        ("page", b"<!DOCTYPE html>"),
    ];
    for (what, begin) in begins {
        let taken = page.done(json!({ "do": "take", "what": what, "cycles": 5 }));
        let url = taken["url"].as_str().unwrap();
        let (head, body) = server.fetch(url);
        assert!(head.starts_with("HTTP/1.1 200") && head.contains("attachment"), "{head}");
        assert!(body.to_ascii_lowercase().starts_with(&begin.to_ascii_lowercase()), "{what}");
        if what == "csv" {
            assert_eq!(String::from_utf8(body).unwrap().lines().count(), 6);
        }
        assert!(server.fetch(url).0.starts_with("HTTP/1.1 404"));
    }
}

#[test]
fn two_pages_have_swarms_of_their_own() {
    let (_folder, server, mut first) = latch();
    let mut second = server.page();
    first.compile("latch.nb", LATCH);
    second.compile("latch.nb", "circuit inverter(a) -> (b) { b = not a }");
    second.done(json!({ "do": "inputs", "bits": "1" }));
    assert_eq!(steps(&mut second, 8).outputs(), 0);
    first.done(json!({ "do": "inputs", "bits": "11" }));
    assert_eq!(steps(&mut first, 10).outputs(), 1);
    drop(second);
    assert_eq!(steps(&mut first, 1).now, 11);
}

#[test]
fn a_page_that_does_not_read_does_not_hold_up_its_swarm() {
    let (_folder, _server, mut page) = latch();
    page.compile("latch.nb", LATCH);
    let id = page.begin(json!({ "do": "run", "speed": null }));
    page.wait(id).unwrap();
    // Nothing is read while large answers are asked for.
    let last = (0..100).map(|_| page.begin(json!({ "do": "robots", "path": null }))).last().unwrap();
    page.frame(|frame| frame.now >= 40);
    page.wait(last).unwrap();
}

#[test]
fn a_robot_that_fails_is_named() {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("boom.nb"), BOOM).unwrap();
    let server = Server::start(folder.path(), &[]);
    let mut page = server.page();
    page.done(json!({ "do": "program", "path": "boom.nb", "text": BOOM }));
    let answer = page.done(json!({ "do": "test", "path": "boom.nb", "test": 0, "level": "physics" }));
    let verdict = &answer["results"][0];
    assert_eq!((&verdict["passed"], &verdict["world"]), (&json!(false), &json!("w")));
    assert!(names(verdict["fault"].as_str().unwrap()));
    page.done(json!({ "do": "replay", "path": "boom.nb", "test": 0, "swarm": null, "world": "w", "row": 1 }));
    assert!(names(page.event(|event| event["event"] == "stopped")["reason"].as_str().unwrap()));
    page.done(json!({ "do": "step", "cycles": 3 }));
    assert!(names(page.event(|event| event["event"] == "stopped")["reason"].as_str().unwrap()));
}
