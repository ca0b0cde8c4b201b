//! Visits without a server: the messages of a page, and the time that it is given.

use proptest::prelude::*;
use proptest::sample::select;

use serde_json::json;

use super::*;
use crate::local::{LocalLine, LocalShell, MemoryFolder, PageMessage};

const VERBS: [&str; 20] = [
    "hello", "files", "read", "save", "program", "inputs", "clock", "run", "pause", "step", "reset", "seek", "view",
    "cancel", "robots", "lessons", "join", "progress", "leave", "nonsense",
];
const TEXTS: [&str; 6] = ["a.nb", "../a", "", "circuit f(a) -> (q) { q = a }", "é\u{0}", "01"];

struct Tab {
    folder: MemoryFolder,
    shell: Arc<LocalShell>,
    line: Arc<LocalLine>,
    visit: Visit,
    now: Duration,
}

impl Tab {
    fn new() -> Self {
        let (folder, shell, line) = (MemoryFolder::default(), Arc::<LocalShell>::default(), Arc::default());
        let making = nbc_session::CompileOptions::default();
        let site = Arc::new(PlaySite {
            folder: Arc::new(folder.clone()),
            file: None,
            making,
            live_pages: true,
            public_page: None,
            class: None,
            shell: shell.clone(),
        });
        let visit = Visit::new(site, Arc::<LocalLine>::clone(&line), Duration::ZERO);
        Self { folder, shell, line, visit, now: Duration::ZERO }
    }

    fn ask(&mut self, request: &Value) -> Vec<Value> {
        self.visit.receive(&request.to_string(), self.now);
        while self.shell.has_work() {
            self.shell.advance();
        }
        self.visit.advance(self.now);
        self.texts()
    }

    fn texts(&self) -> Vec<Value> {
        let next = || self.line.next(true);
        let texts = std::iter::from_fn(next).filter_map(|message| match message {
            PageMessage::Text(text) => Some(serde_json::from_str(&text).unwrap()),
            PageMessage::Frame(_) => None,
        });
        texts.collect()
    }

    fn pass(&mut self, time: Duration) -> usize {
        let end = self.now + time;
        let mut frames = 0;
        while self.now < end {
            self.now += self.visit.due(self.now).clamp(Duration::from_millis(1), end - self.now);
            self.visit.advance(self.now);
            frames += usize::from(matches!(self.line.next(true), Some(PageMessage::Frame(_))));
        }
        frames
    }
}

const LATCH: &str = "circuit latch(d, e) -> (q) { q = if e then d else q }";

#[test]
fn a_swarm_walks_as_fast_as_its_page_says_by_the_clock_that_it_is_given() {
    let mut tab = Tab::new();
    let program = json!({ "id": 1, "do": "program", "path": "latch.nb", "text": LATCH });
    let checked = tab.ask(&program);
    assert_eq!(checked[0]["ok"]["errors"], 0, "{checked:?}");
    let compile = json!({ "id": 2, "do": "compile", "path": "latch.nb", "circuit": "latch", "swarm": null });
    assert_eq!(tab.ask(&compile).last().unwrap()["to"], "compile");
    assert_eq!(tab.ask(&json!({ "id": 3, "do": "inputs", "bits": "11" })), [json!({ "id": 3, "ok": {} })]);
    tab.ask(&json!({ "id": 4, "do": "run", "speed": 4.0 }));
    let frames = tab.pass(Duration::from_secs(2));
    assert!((7..=10).contains(&frames), "{frames} frames");
    // The log knows each cycle that was done, and no other.
    let refused = tab.ask(&json!({ "id": 5, "do": "seek", "cycle": 100 }));
    assert_eq!(refused[0]["error"]["message"], "the log goes from cycle 0 to 9");
    assert_eq!(tab.ask(&json!({ "id": 6, "do": "seek", "cycle": 3 })), [json!({ "id": 6, "ok": {} })]);
    assert_eq!(tab.pass(Duration::from_secs(1)), 1, "a swarm that is shown at a cycle has paused");
}

const TWO: &str = "file program = \"two.csv\"
    circuit two(char[2], clk) -> (at, q) {
        at = register(not at, clk)
        q  = char[0] and char[1]
    }
    environment desk(at) -> (char[2], screen: text) {
        net words[2][8] init program
        word   = words[at]
        char   = word[1..0]
        screen = {1, word}
    }
    test two \"reads\" with desk {
        clk | q
        ^   | -
        ^   | -
        ^   | -
    }";

#[test]
fn a_test_gives_the_inputs_of_its_swarm_until_somebody_sets_them() {
    let mut tab = Tab::new();
    tab.folder.insert("two.csv", "72, 107\n");
    tab.ask(&json!({ "id": 1, "do": "program", "path": "two.nb", "text": TWO }));
    let replay = json!({ "id": 2, "do": "replay", "path": "two.nb", "test": 0, "swarm": null, "row": 0 });
    let answer = tab.ask(&replay).pop().unwrap();
    let script = &answer["ok"]["swarm"]["script"];
    let (desk, all) = (&script["environment"], script["cycles"].as_u64().unwrap());
    let written: Vec<&str> =
        desk["screen"].as_array().unwrap().iter().map(|piece| piece[1].as_str().unwrap()).collect();
    assert_eq!((desk["name"].as_str(), written.concat()), (Some("desk"), "HkH".to_owned()), "{answer}");
    let memory = &desk["memories"][0];
    assert_eq!(memory["words"], json!(["48", "6b"]));
    let reads = memory["reads"][0].as_array().unwrap();
    assert_eq!(reads.iter().map(|read| read[1].as_u64().unwrap()).collect::<Vec<_>>(), [0, 1, 0, 1]);
    // The second word is read, and given, from the edge on.
    let edge = reads[1][0].as_u64().unwrap();
    assert!(0 < edge && edge + 1 < all, "{reads:?}");
    tab.ask(&json!({ "id": 3, "do": "step", "cycles": all - 1 }));
    tab.pass(Duration::from_secs(1));
    let given = tab.visit.runner.excerpt(all as u32).unwrap().inputs;
    let at = |cycle: u64| given[cycle as usize].clone();
    assert_eq!((at(0), at(edge - 1)), (vec![false; 3], vec![false; 3]));
    assert_eq!(at(edge), [false, false, true], "its inputs stay the same until the next row");
    let second = reads[2][0].as_u64().unwrap();
    assert_eq!((at(second - 1), at(second)), (vec![true, true, false], vec![true; 3]));
    tab.ask(&json!({ "id": 4, "do": "inputs", "bits": "010" }));
    tab.ask(&json!({ "id": 5, "do": "step", "cycles": 1 }));
    tab.pass(Duration::from_millis(100));
    assert_eq!(tab.visit.runner.excerpt(1).unwrap().inputs, [[false, true, false]]);
}

#[test]
fn a_file_that_is_taken_is_kept_at_the_address_of_the_answer() {
    let mut tab = Tab::new();
    tab.ask(&json!({ "id": 1, "do": "program", "path": "latch.nb", "text": LATCH }));
    tab.ask(&json!({ "id": 2, "do": "compile", "path": "latch.nb", "circuit": "latch", "swarm": null }));
    tab.ask(&json!({ "id": 3, "do": "step", "cycles": 1 }));
    let taken = tab.ask(&json!({ "id": 4, "do": "take", "what": "csv", "cycles": 1 }));
    let file = tab.shell.take_kept().unwrap();
    assert_eq!(taken.last().unwrap()["ok"], json!({ "url": file.address, "name": "latch.csv" }));
    assert!(file.media_type.starts_with("text/csv") && !file.bytes.is_empty());
    assert_eq!(tab.shell.take_kept(), None);
}

#[test]
fn work_is_done_in_portions_between_which_it_can_be_cancelled() {
    let mut tab = Tab::new();
    let evolve = json!({ "id": 7, "do": "evolve", "body": null, "box": [2, 2], "generations": 1000, "seed": 1 });
    tab.visit.receive(&evolve.to_string(), tab.now);
    (0..4).for_each(|_| tab.shell.advance());
    let seen = tab.texts();
    assert_eq!(seen.iter().filter(|text| text["event"] == "archive").count(), 3, "{seen:?}");
    assert!(!tab.visit.is_idle());
    let cancelled = tab.ask(&json!({ "id": 8, "do": "cancel", "of": 7 }));
    assert_eq!(cancelled[0], json!({ "id": 8, "ok": {} }));
    assert_eq!(cancelled[1]["error"]["code"], "cancelled");
    assert!(tab.visit.is_idle());
}

#[test]
fn a_test_shows_its_progress_and_can_be_cancelled_in_one_thread() {
    for (level, rows) in [("physics", 60), ("logic", 6000)] {
        let mut tab = Tab::new();
        let rows = "    0 | 1\n    1 | 0\n".repeat(rows / 2);
        let text = format!("circuit f(a) -> (q) {{ q = not a }}\ntest f {{\n    a | q\n{rows}}}");
        tab.ask(&json!({ "id": 1, "do": "program", "path": "a.nb", "text": text }));
        let test = json!({ "id": 2, "do": "test", "path": "a.nb", "test": 0, "level": level });
        tab.visit.receive(&test.to_string(), tab.now);
        (0..12).for_each(|_| tab.shell.advance());
        let seen = tab.texts();
        assert!(seen.iter().any(|text| text["progress"].is_array()), "{seen:?}");
        let found = seen.iter().rfind(|text| text["found"].is_array()).expect("the rows so far");
        assert!(found["found"][0]["rows"].as_array().is_some_and(|rows| !rows.is_empty()), "{found}");
        let cancelled = tab.ask(&json!({ "id": 3, "do": "cancel", "of": 2 }));
        assert_eq!(cancelled.last().unwrap()["error"]["code"], "cancelled", "{cancelled:?}");
        let answer = tab.ask(&test);
        let results = &answer.last().unwrap()["ok"]["results"];
        assert_eq!(results[0]["passed"], true, "{answer:?}");
    }
}

const LIGHTS: &str = "circuit lights(car, clk) -> (main, side) {
        turn = register(turn xor car, clk)
        main = not turn
        side = turn
    }
    prove lights {
        never main and side
        always car and before(main or side) => side
    }";

#[test]
fn what_refutes_a_property_is_watched_like_a_test() {
    let mut tab = Tab::new();
    let program = tab.ask(&json!({ "id": 1, "do": "program", "path": "lights.nb", "text": LIGHTS }));
    let claims = &program[0]["ok"]["claims"];
    assert_eq!(claims[0]["properties"][0], json!({ "property": "never main and side", "line": 7 }), "{program:?}");
    let answer = tab.ask(&json!({ "id": 2, "do": "prove", "path": "lights.nb", "claim": 0 })).pop().unwrap();
    let found = &answer["ok"]["properties"];
    assert_eq!(found[0]["how"], "by induction over 1 step", "{answer}");
    assert_eq!([0, 1].map(|at| found[at]["verdict"].as_str().unwrap()), ["proved", "refuted"], "{answer}");
    let replay = json!({ "id": 3, "do": "replay", "path": "lights.nb", "test": found[1]["test"], "swarm": null,
        "row": 3 });
    let shown = tab.ask(&replay).pop().unwrap();
    let script = &shown["ok"]["swarm"]["script"];
    assert_eq!(script["title"], "always car and before(main or side) => side", "{shown}");
    // The program itself is as it was.
    let other = json!({ "id": 4, "do": "replay", "path": "lights.nb", "test": 0, "swarm": null, "row": 0 });
    assert_eq!(tab.ask(&other)[0]["error"]["message"], "the program has no such test or row");
    let other = tab.ask(&json!({ "id": 5, "do": "prove", "path": "lights.nb", "claim": 1 }));
    assert_eq!(other[0]["error"]["message"], "the program claims nothing of that number");
    let broken = json!({ "id": 6, "do": "replay", "path": "lights.nb", "test": "test lights {", "swarm": null,
        "row": 0 });
    assert!(tab.ask(&broken)[0]["error"]["message"].is_string());
}

#[test]
fn the_outputs_of_a_swarm_without_a_state_are_known_before_it_settles() {
    let mut tab = Tab::new();
    let text = "circuit half(a, b) -> (s, c) { s = a xor b c = a and b }
        circuit latch(d, e) -> (q) { q = if e then d else q }";
    tab.ask(&json!({ "id": 1, "do": "program", "path": "two.nb", "text": text }));
    let mut settle = |circuit: &str, rows: &[&str]| {
        tab.ask(&json!({ "id": 2, "do": "compile", "path": "two.nb", "circuit": circuit, "swarm": null }));
        tab.ask(&json!({ "id": 3, "do": "settle", "rows": rows })).remove(0)
    };
    assert_eq!(settle("half", &["00", "01", "10", "11"])["ok"]["outputs"], json!(["00", "10", "10", "01"]));
    assert_eq!(settle("latch", &["00"])["ok"], json!({ "outputs": null }));
    assert_eq!(settle("half", &["0"])["error"]["message"], "expected 2 input bits, such as `00`");
}

#[test]
fn work_that_takes_too_long_is_stopped() {
    let mut tab = Tab::new();
    let evolve = json!({ "id": 7, "do": "evolve", "body": null, "box": [2, 2], "generations": 1000, "seed": 1 });
    tab.visit.receive(&evolve.to_string(), tab.now);
    tab.now = Duration::from_secs(Limit::PageSeconds.most() + 1);
    tab.visit.advance(tab.now);
    let ended = tab.ask(&json!({ "id": 8, "do": "pause" }));
    assert_eq!(ended.last().unwrap()["error"]["code"], "timed-out", "{ended:?}");
}

#[test]
fn what_changes_in_the_folder_is_told_and_counts() {
    let mut tab = Tab::new();
    tab.folder.insert("a.nb", LATCH);
    let read = tab.ask(&json!({ "id": 1, "do": "read", "path": "a.nb" }));
    assert_eq!(read[0]["ok"]["text"], LATCH);
    tab.folder.insert("a.nb", "");
    tab.now += LOOK;
    tab.visit.advance(tab.now);
    let changed = tab.texts().remove(0);
    assert_eq!(changed["event"], "changed");
    let (old, new) = (&read[0]["ok"]["stamp"], &changed["stamp"]);
    let saved = tab.ask(&json!({ "id": 2, "do": "save", "path": "a.nb", "text": LATCH, "stamp": old }));
    assert_eq!(saved[0]["error"]["code"], "changed");
    let saved = tab.ask(&json!({ "id": 3, "do": "save", "path": "a.nb", "text": LATCH, "stamp": new }));
    assert_eq!(saved[0]["to"], "save");
    // The draft of a page knows its file again after a reload.
    assert_eq!(saved[0]["ok"]["stamp"], *old);
    assert_eq!(tab.folder.take_written(), Some(("a.nb".to_owned(), LATCH.to_owned())));
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(24))]
    #[test]
    fn any_requests_are_answered_without_a_fault(
        sent in prop::collection::vec((select(VERBS.to_vec()), select(TEXTS.to_vec()), number(), number()), 0..12),
        broken in ".{0,30}",
    ) {
        let mut tab = Tab::new();
        tab.visit.receive(&broken, tab.now);
        for (verb, text, one, two) in sent {
            let request = json!({
                "id": one, "do": verb, "path": text, "text": text, "example": text, "stamp": null, "bits": text,
                "bit": two, "half": one, "speed": two, "cycles": one, "cycle": two, "robots": [one], "of": two,
                "name": text, "place": null, "finished": one,
            });
            for answer in tab.ask(&request) {
                prop_assert!(answer["error"]["message"] != json!("the program failed; its log says where"));
            }
        }
    }
}

fn number() -> impl Strategy<Value = Value> {
    select(vec![json!(0), json!(1), json!(-1), json!(1.5), json!(1e300), json!(u64::MAX), json!("x"), Value::Null])
}
