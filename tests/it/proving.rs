//! Properties of all steps, through the program: the gallery, its mutants, and models in AIGER's format.

use crate::support::*;

fn mutant(bench: &Bench, file: &str, replaced: &str, by: &str) -> String {
    let text = fs::read_to_string(root().join("circuits").join(file)).unwrap();
    assert!(text.contains(replaced), "{file} has `{replaced}`");
    bench.file(file, text.replacen(replaced, by, 1));
    file.to_owned()
}

fn verdicts(bench: &Bench, arguments: &[&str], status: i32) -> Vec<Value> {
    let ran = bench.run(&[&["prove"], arguments, &["--format", "json"]].concat());
    assert_eq!(ran.status, status, "{}{}", ran.out, ran.err);
    let found: Value = serde_json::from_str(&ran.out).unwrap();
    let claims = found["claims"].as_array().unwrap();
    claims.iter().flat_map(|claim| claim["properties"].as_array().unwrap()).cloned().collect()
}

#[test]
fn every_clocked_program_of_the_gallery_has_a_property_that_is_proved_in_ten_seconds() {
    let bench = Bench::new();
    let mut proved = 0;
    for entry in fs::read_dir(root().join("circuits")).unwrap() {
        let path = entry.unwrap().path();
        let Some(text) = path.extension().filter(|end| *end == "nb").map(|_| fs::read_to_string(&path).unwrap()) else {
            continue;
        };
        let is_clocked = text.contains("register(") || text.contains("register[");
        if !text.contains("\nprove ") {
            assert!(!is_clocked, "{} has no property", path.display());
            continue;
        }
        let found = verdicts(&bench, &[path.to_str().unwrap(), "--seconds", "10"], 0);
        assert!(!found.is_empty(), "{}", path.display());
        proved += found.len();
    }
    assert!(proved > 25, "{proved} are proved");
}

#[test]
fn a_proof_of_what_is_never_checked_is_called_empty() {
    let bench = Bench::new();
    let circuit = "circuit c(a, b, clk) -> (q) { q = register(a and b, clk) }\n";
    let cases = [
        ("assume a and not a\n always q", Some("no step satisfies the assumptions")),
        ("assume not a\n always a => q", Some("its condition is never true under the assumptions")),
        (
            "assume not q\n assume a and b\n always not before(q) => 0",
            Some("its condition is never true under the assumptions"),
        ),
        ("assume not q\n assume a and b\n never before(q) xor q", Some("no run is long enough under the assumptions")),
        (
            "assume not q\n assume a and b\n always b => q within 2 steps",
            Some("its condition is never true under the assumptions"),
        ),
        ("always q and not q => 0", Some("its condition is never true")),
        ("assume a\n always b and not q => a", None),
        ("assume not a\n never q", None),
        ("always before(b) => b or not b", None),
        ("assume a and b\n always a => q within 1 step", None),
    ];
    for (at, (properties, why)) in cases.into_iter().enumerate() {
        let file = format!("{at}.nb");
        bench.file(&file, format!("{circuit}prove c {{\n {properties}\n}}\n"));
        let found = verdicts(&bench, &[&file], 0);
        assert_eq!(found[0]["empty"].as_str(), why, "{properties}: {found:?}");
    }
    let text = bench.run("prove 0.nb").out;
    assert!(text.contains("    proved     always q  (but empty: no step satisfies the assumptions)\n"), "{text}");

    // A bad state that is the input, under a constraint of the constant 0, and under one of the input's opposite.
    for (constraint, why) in [("0", Some("no step satisfies the constraints")), ("3", None)] {
        bench.file("model.aag", format!("aag 1 1 0 0 0 1 1\n2\n2\n{constraint}\n"));
        let found = verdicts(&bench, &["model.aag"], 0);
        assert_eq!(found[0]["empty"].as_str(), why, "{found:?}");
    }
}

/// Mutants of the gallery: a part of a file, what it becomes, and the property that is refuted.
const MUTANTS: [(&str, &str, &str, &str); 3] = [
    ("traffic_light.nb", "else:                      10", "else:                      11", "main_stops xor side_stops"),
    ("counter.nb", "count + 3'd1", "count + {1'd0, count[2], 1'd1}", "count == before(count) + 1"),
    ("lfsr.nb", "state[2] xor state[1]", "state[2] and state[1]", "never state == 0"),
];

#[test]
fn a_mutant_of_the_gallery_is_refuted_by_a_test_that_it_passes() {
    for (file, part, other, property) in MUTANTS {
        let bench = Bench::new();
        let file = mutant(&bench, file, part, other);
        let found = verdicts(&bench, &[&file], 1);
        let refuted = found.iter().find(|found| found["verdict"] == "refuted").unwrap();
        assert!(refuted["property"].as_str().unwrap().contains(property), "{refuted}");
        let test = refuted["test"].as_str().unwrap();
        let text = bench.read(&file);
        // The tests of the file fail now; only the one that was printed is run.
        bench.file("shown.nb", format!("{text}\n{test}"));
        bench.ok(&["test", "shown.nb", "--logic", "--only", refuted["property"].as_str().unwrap()]);
        bench.ok("fmt --check shown.nb");
    }
}

#[test]
fn robots_do_what_refutes_a_property() {
    let bench = Bench::new();
    let file = mutant(&bench, "latch.nb", "nand(nand(d, e), nq)", "nand(nand(d, d), nq)");
    let found = verdicts(&bench, &[&file, "--physics"], 1);
    let refuted: Vec<&Value> = found.iter().filter(|found| found["verdict"] == "refuted").collect();
    assert!(!refuted.is_empty(), "{found:?}");
    assert!(refuted.iter().all(|found| found["physics"] == true), "{refuted:?}");
}

#[test]
fn a_search_that_ends_is_undecided_and_the_same_again() {
    let bench = Bench::new();
    let wide = "circuit wide(clk) -> (count[24]) {\n    count = register(count + 1, clk)\n}\n\n\
                prove wide \"ends\" {\n    never count == 9000000\n}\n";
    bench.file("wide.nb", wide);
    let search = || bench.run("prove wide.nb --work 2000 --format json");
    let first = search();
    assert_eq!(first.status, 1, "{}", first.err);
    assert!(first.out.contains("\"verdict\":\"undecided\""), "{}", first.out);
    assert_eq!(search().out, first.out);
    let text = bench.run("prove wide.nb --work 2000").out;
    assert!(text.contains("undecided  never count == 9000000  (it holds in the first "), "{text}");
    assert!(text.ends_with("0 proved, 0 refuted, 1 undecided\n"), "{text}");
}

#[test]
fn one_claim_of_several_is_chosen_by_its_title_or_circuit() {
    let bench = Bench::new();
    let path = root().join("circuits/traffic_light.nb");
    let path = path.to_str().unwrap();
    assert_eq!(verdicts(&bench, &[path, "--only", "never green for both roads"], 0).len(), 1);
    assert!(verdicts(&bench, &[path, "--only", "traffic_light"], 0).len() > 1);
    bench.run(&["prove", path, "--only", "traffic"]).expect_fault(&["no claim of", "called `traffic`"]);
    let file = bench.file("none.nb", "circuit f(a) -> (q) {\n    q = a\n}\n");
    bench.run(&["prove", file.to_str().unwrap()]).expect_fault(&["none.nb` claims nothing", "prove my_circuit {"]);
}

#[test]
fn a_register_of_a_file_does_not_change_what_was_before() {
    let bench = Bench::new();
    let own = "circuit register(d, clk) -> (q) {\n    q = d xor clk\n}\n\n\
               circuit same(a) -> (q) {\n    q = a\n}\n\n\
               prove same {\n    always before(a) == before(q)\n    never before(a) and not before(q)\n}\n";
    bench.file("own.nb", own);
    assert_eq!(verdicts(&bench, &["own.nb"], 0).len(), 2);
}

#[test]
fn models_are_decided_with_witnesses() {
    let bench = Bench::new();
    // A latch that turns over while the input is 0; the second property is its being 0 and 1 at once.
    bench.file("model.aag", "aag 4 1 1 0 2 2\n2\n4 6\n4\n8\n6 3 5\n8 4 5\nb0 on\nb1 both\n");
    let found = verdicts(&bench, &["model.aag", "--witness", "model.wit"], 1);
    assert_eq!((&found[0]["property"], &found[0]["verdict"]), (&"on".into(), &"refuted".into()));
    assert_eq!((&found[1]["property"], &found[1]["verdict"]), (&"both".into(), &"proved".into()));
    let witness = bench.read("model.wit");
    assert_eq!(witness, "1\nb0\n0\n0\n0\n.\n0\nb1\n.\n");
    bench.file("live.aag", "aag 1 1 0 0 0 0 0 1\n2\n1\n2\n");
    bench.run("prove live.aag").expect_fault(&["justice properties are not supported"]);
    let latch = root().join("circuits/latch.nb");
    let refused = bench.run(&["prove", latch.to_str().unwrap(), "--witness", "latch.wit"]);
    refused.expect_fault(&["`--witness` is for one model"]);
}

const COUNTERS: &str = "circuit up(go, clk) -> (n[3]) {
    n = register(n + {2'd0, go}, clk)
}

circuit toggled(go, clk) -> (n[3]) {
    low  = register(low xor go, clk)
    mid  = register(mid xor (go and low), clk)
    high = register(high xor (go and low and mid), clk)
    n    = {high, mid, low}
}

circuit other(go, clk) -> (n[3]) {
    n = register[start = 1](n + {2'd0, go}, not clk)
}

test up \"is three toggles\" against toggled for ever
";

#[test]
fn two_circuits_are_equal_for_ever_or_a_run_shows_where_they_differ() {
    let bench = Bench::with("counters.nb", COUNTERS);
    let test = |level: &str| -> Value {
        let ran = bench.run(&["test", "counters.nb", level, "--format", "json"]);
        serde_json::from_str(&ran.out).unwrap_or_else(|_| panic!("{}", ran.err))
    };
    // It is at the level of logic, whatever is asked for.
    for level in ["--logic", "--physics"] {
        let found = &test(level)["tests"][0];
        assert_eq!((&found["passed"], &found["level"]), (&true.into(), &"logic".into()), "{found}");
        assert_eq!(found["proof"], "proved by induction over 1 step");
        assert_eq!(found["rows"], Value::Array(Vec::new()));
    }
    bench.run("run counters.nb").expect_fault(&["there is nothing to run"]);
    bench.run("test counters.nb --vary 10%").expect_fault(&["none of these tests runs in a world"]);
    bench.file("counters.nb", COUNTERS.replace("(go and low and mid)", "(low and mid)"));
    let found = &test("--logic")["tests"][0];
    assert_eq!((&found["passed"], &found["proof"]), (&false.into(), &"refuted after 5 steps".into()), "{found}");
    let last = found["rows"].as_array().unwrap().last().unwrap();
    assert!(last["passed"] == false && last["expected"] != last["observed"], "{last}");
    let text = bench.run("test counters.nb");
    assert!(text.out.contains("FAIL  up \"is three toggles\" (refuted after 5 steps, logic)"), "{}", text.out);
    bench.file("counters.nb", COUNTERS.replace("against toggled", "against other"));
    bench.run("test counters.nb").expect_fault(&["`other` cannot be compared with this circuit for ever"]);
}

#[test]
fn a_register_that_stores_when_its_clock_falls_has_steps() {
    let bench = Bench::with(
        "falls.nb",
        "circuit toggle(go, clk) -> (q) {\n    q = register(q xor go, not clk)\n}\n\n\
         prove toggle {\n    never before(go or not go) and q != before(q) xor go\n    never q and before(q)\n}\n",
    );
    let found = verdicts(&bench, &["falls.nb"], 1);
    assert_eq!((&found[0]["verdict"], &found[1]["steps"]), (&"proved".into(), &3.into()), "{found:?}");
    let test = found[1]["test"].as_str().unwrap();
    let text = bench.read("falls.nb");
    bench.file("shown.nb", format!("{text}\n{test}"));
    bench.ok("test shown.nb");
    bench.ok("fmt --check shown.nb");
}

#[test]
fn properties_read_nets_inside_their_circuit() {
    let bench = Bench::new();
    let text = "circuit shift[n = 3](d, clk) -> (q) {
    net inside[n]
    inside = register({d, inside[n - 1..1]}, clk)
    q      = inside[0]
}

prove shift[4] {
    always q == inside[0]
    always before(d) => before(inside[3]) or not inside[2]
    never  inside == 4'd9
}
";
    bench.file("shift.nb", text);
    let found = verdicts(&bench, &["shift.nb"], 1);
    let said: Vec<&str> = found.iter().map(|found| found["verdict"].as_str().unwrap()).collect();
    assert_eq!(said[0], "proved", "{found:?}");
    assert_eq!((said[2], &found[2]["steps"]), ("refuted", &5.into()), "{found:?}");
    // Its test has the ports alone.
    assert!(found[2]["test"].as_str().unwrap().contains("d clk | q\n"), "{found:?}");
    bench.file("shift.nb", text.replace("inside == 4'd9", "beside == 4'd9"));
    bench.run("prove shift.nb").expect_fault(&["`beside`"]);
}

fn flip_flop(q: &str, nq: &str) -> String {
    let latch = "    low = not clk
    set = nand(d, low)
    held init 0 = nand(set, heldn)
    heldn = nand(nand(set, low), held)
    show = nand(held, clk)";
    let shown = format!("    q{q} = nand(show, nq)\n    nq{nq} = nand(nand(show, clk), q)");
    format!("circuit stored(d, clk) -> (q) {{\n{latch}\n{shown}\n}}\n\nprove stored \"starts\" {{\n    never q\n}}\n")
}

#[test]
fn a_register_starts_as_its_cells_do() {
    let bench = Bench::with("one.nb", flip_flop("", " init 0"));
    let ran = bench.run("prove one.nb");
    assert!(ran.status == 1 && ran.out.contains("refuted    never q  (after 1 step)"), "{}{}", ran.out, ran.err);
    bench.file("none.nb", flip_flop(" init 0", " init 0"));
    let ran = bench.run("prove none.nb");
    assert!(ran.err.contains("no-steps") && ran.err.contains("does not settle"), "{}{}", ran.out, ran.err);
    bench.file(
        "waves.nb",
        format!("{}\nswarm s {{ circuit: stored, registers: waves }}\n", flip_flop(" init 0", " init 0")),
    );
    let ran = bench.run("build waves.nb");
    assert!(
        ran.err.contains("the cells of the register `q` have start values that contradict"),
        "{}{}",
        ran.out,
        ran.err
    );
}
