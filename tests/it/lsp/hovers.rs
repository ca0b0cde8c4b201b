//! What editors show about a place.

use base64::Engine;
use base64::engine::general_purpose::STANDARD;

use crate::lsp::client::{Client, file, opened, place};
use crate::lsp::{ADDER, HALF};

use crate::support::*;

/// Hovers over a word of an open text until the answer has what only compiling tells, and returns it.
fn settled(client: &mut Client, uri: &str, text: &str, word: &str, wanted: &str) -> String {
    loop {
        let shown = hover(client, uri, text, word);
        if shown.contains(wanted) {
            return shown;
        }
    }
}

fn hover(client: &mut Client, uri: &str, text: &str, word: &str) -> String {
    let found = client.ask("textDocument/hover", place(uri, text, word)).unwrap();
    found["contents"]["value"].as_str().unwrap_or_else(|| panic!("{word}: {found}")).to_owned()
}

fn pictures(markdown: &str) -> Vec<String> {
    let encoded = markdown.split("data:image/svg+xml;base64,").skip(1).map(|rest| rest.split(')').next().unwrap());
    encoded.map(|text| String::from_utf8(STANDARD.decode(text).unwrap()).unwrap()).collect()
}

#[test]
fn a_circuit_is_shown_with_its_comment_its_ports_its_robots_and_its_slowest_path() {
    let bench = Bench::new();
    file(&bench, "half.nb", HALF);
    let (full, text) = file(&bench, "full.nb", ADDER);
    let mut client = Client::start();
    client.open(&full, &text);
    let shown = settled(&mut client, &full, &text, "half(a", "**");
    assert!(shown.starts_with("```nb\ncircuit half(a, b) -> (s, c)\n```\n\nAdds two bits.\n"), "{shown}");
    assert!(shown.contains("- inputs: `a`, `b`\n- outputs: `s`, `c`"), "{shown}");
    assert!(shown.contains("**2 robots**, settles within ") && shown.contains("Slowest path: `"), "{shown}");
    client.goodbye();
}

#[test]
fn a_net_is_shown_with_its_width_what_it_depends_on_and_its_robots() {
    let (_bench, mut client, uri, text) = opened(
        "a.nb",
        "circuit f[n = 4](a[n], b[n], c) -> (q) {\n    t = a and b\n    u init 0 = any(t) nor u\n    q = u and c\n}\n",
    );
    let shown = settled(&mut client, &uri, &text, "t = a", "Made alone");
    assert!(shown.contains("- width: 4 bits\n- depends on `a`, `b`\n"), "{shown}");
    assert!(shown.contains("it takes 4 cells as written and **4 robots**"), "{shown}");
    let shown = hover(&mut client, &uri, &text, "u init");
    assert!(shown.contains("- depends on `a`, `b`, through `t`\n- part of a loop, which is memory"), "{shown}");
    assert!(hover(&mut client, &uri, &text, "c) ->").contains("- width: 1 bit\n- an input of `f`"));
    client.goodbye();
}

#[test]
fn figures_are_of_the_text_as_it_is_now() {
    let (_bench, mut client, uri, text) = opened("a.nb", "circuit f(a, b) -> (q) {\n    q = a nand b\n}\n");
    settled(&mut client, &uri, &text, "f(a", "**1 robot**");
    let longer = text.replace("a nand b", "(a nand b) xor c").replace("a, b", "a, b, c");
    let change = json!({ "textDocument": { "uri": uri, "version": 2 }, "contentChanges": [{ "text": longer }] });
    client.tell("textDocument/didChange", change);
    let shown = hover(&mut client, &uri, &longer, "f(a");
    assert!(!shown.contains("**1 robot**"), "no figures rather than old ones: {shown}");
    settled(&mut client, &uri, &longer, "f(a", "**2 robots**");
    let broken = json!([{ "text": "circuit f(a, b) -> (q) { q = t }" }]);
    let document = json!({ "uri": uri, "version": 3 });
    client.tell("textDocument/didChange", json!({ "textDocument": document, "contentChanges": broken }));
    let shown = hover(&mut client, &uri, "circuit f", "f");
    assert!(!shown.contains("**"), "a text with errors is not compiled: {shown}");
    client.goodbye();
}

#[test]
fn materials_and_schedules_are_shown_with_their_curves() {
    let (_bench, mut client, uri, text) = opened(
        "a.nb",
        "evolution mine { materials: [muscle, s1_grow, bone], variable: sweep }\nlibrary l { from: mine }\n",
    );
    for word in ["muscle", "s1_grow", "sweep"] {
        let shown = hover(&mut client, &uri, &text, word);
        let [picture] = &pictures(&shown)[..] else { panic!("{word}: {shown}") };
        let drawn = roxmltree::Document::parse(picture).unwrap();
        assert!(drawn.descendants().any(|node| node.has_tag_name("polyline")), "{word}: {picture}");
    }
    let bone = hover(&mut client, &uri, &text, "bone");
    assert!(bone.contains("kind: rigid") && pictures(&bone).is_empty(), "{bone}");
    client.goodbye();
}

#[test]
fn a_function_is_shown_as_the_robot_that_computes_it() {
    let (_bench, mut client, uri, text) = opened(
        "a.nb",
        "circuit f(a, b) -> (q) {\n    q = a nand b\n}\n\nlibrary few { from: shipped, behaviors: [nand, RRRL] }\n\n\
         swarm s { circuit: f, library: few }\n",
    );
    for (word, begins) in
        [("nand b", "`and`, `or`, `xor`"), ("nand, ", "The best robot for `nand`"), ("RRRL", "The best robot")]
    {
        let shown = hover(&mut client, &uri, &text, word);
        assert!(shown.starts_with(begins) && shown.contains("| nand | `"), "{word}: {shown}");
        let header = "| function | robot | box | clock | margin | errors |";
        assert!(shown.contains(header) && pictures(&shown).len() == 1, "{word}: {shown}");
    }
    let shown = hover(&mut client, &uri, &text, "few {");
    assert!(shown.contains("robots for 1 function") && pictures(&shown).len() == 1, "{shown}");
    let shown = settled(&mut client, &uri, &text, "s {", "**1 robot** as `s`");
    assert!(shown.contains("swarm s"), "{shown}");
    client.goodbye();
}
