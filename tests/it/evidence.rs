//! The claims of the manual, and the command that does again what they say.

use std::fs;

use serde_json::{Value, json};

use crate::support::bench::Bench;
use crate::support::root;

const FLIP: &str = "circuit flip(a) -> (y) {\n    y = not a\n}\n\ntest flip {\n    a | y\n    0 | 1\n}\n";

fn bench(says: &str) -> Bench {
    let bench = Bench::new();
    bench.file("flip.nb", FLIP);
    fs::create_dir(bench.path().join("docs")).unwrap();
    bench.file("docs/page.md", "A test of one circuit:\n    1 passed,\n    0 failed\n");
    let page = "docs/page.md";
    let claims = json!([
        { "claim": "It flips.", "page": page, "command": "nbc test 'flip.nb' --logic", "seconds": 1, "says": [says] },
        { "claim": "It takes long.", "page": page, "command": "nbc fly", "seconds": 100 },
    ]);
    bench.file("docs/evidence.json", claims.to_string());
    bench
}

#[test]
fn what_the_page_says_is_done_again() {
    let ran = bench("1 passed, 0 failed").run(&["evidence"]);
    assert_eq!(ran.status, 0, "{}{}", ran.out, ran.err);
    assert!(ran.out.starts_with("same      docs/page.md: It flips. ("), "{}", ran.out);
    assert!(ran.out.ends_with("left out  docs/page.md: It takes long.\n1 same, 0 differ, 1 left out\n"), "{}", ran.out);
}

#[test]
fn what_differs_is_named() {
    let ran = bench("2 passed, 0 failed").run(&["evidence"]);
    assert_eq!(ran.status, 1, "{}{}", ran.out, ran.err);
    assert!(ran.out.contains("DIFFERS   docs/page.md: It flips.: nbc test 'flip.nb' --logic\n"), "{}", ran.out);
    assert!(ran.out.contains("missing: 2 passed, 0 failed\n"), "{}", ran.out);
}

#[test]
fn a_list_that_cannot_be_read_is_an_error() {
    let bench = bench("");
    bench.run(&["evidence", "none.json"]).expect_fault(&["none.json", "no such file"]);
    bench.file("docs/wrong.json", r#"[{ "claim": "nothing else" }]"#);
    let other = r#"[{ "claim": "c", "page": "docs/page.md", "command": "rm x", "seconds": 1 }]"#;
    bench.file("docs/other.json", other);
    bench.run(&["evidence", "docs/other.json"]).expect_fault(&["`nbc` or `cargo`, not `rm`"]);
    bench.run(&["evidence", "docs/wrong.json"]).expect_fault(&["not a list of claims", "page"]);
}

#[test]
fn the_table_of_claims_is_that_of_the_list() {
    let listed = Bench::new().run(&["evidence", root().join("docs/evidence.json").to_str().unwrap(), "--list"]);
    let page = fs::read_to_string(root().join("docs/reproduce.md")).unwrap();
    assert!(page.contains(&listed.out), "docs/reproduce.md needs the output of `nbc evidence --list`:\n{}", listed.out);
}

#[test]
fn what_takes_a_second_is_so() {
    let list = root().join("docs/evidence.json");
    let ran = Bench::new().run(&["evidence", list.to_str().unwrap(), "--most", "1"]);
    assert_eq!(ran.status, 0, "{}{}", ran.out, ran.err);
    let same = ran.out.lines().filter(|line| line.starts_with("same ")).count();
    assert!(same >= 2, "{}", ran.out);
}

#[test]
fn each_claim_is_on_its_page_and_in_its_output() {
    let text = fs::read_to_string(root().join("docs/evidence.json")).unwrap();
    let claims: Vec<Value> = serde_json::from_str(&text).unwrap();
    let squeezed = |text: &str| text.split_whitespace().collect::<Vec<_>>().join(" ");
    for claim in claims {
        let page = fs::read_to_string(root().join(claim["page"].as_str().unwrap())).unwrap();
        let texts = |key: &str| claim[key].as_array().cloned().unwrap_or_default();
        for text in [texts("says"), texts("quotes")].concat() {
            let text = text.as_str().unwrap();
            assert!(squeezed(&page).contains(&squeezed(text)), "{claim:?} is not on its page: {text}");
        }
        let is_shown = !texts("says").is_empty()
            || claim["tables"] == true
            || !texts("prints").is_empty() && !texts("quotes").is_empty();
        assert!(is_shown, "{claim:?} compares nothing");
    }
}
