//! Help while a text is being written: completion, signatures, fixes.

use crate::lsp::client::{Client, at, file, opened, place};

use crate::support::*;

const START: &str = "\
// Adds two bits.
circuit half(a, b) -> (s, c) {
    s = a xor b
    c = a and b
}

circuit ripple[n = 4](x[n], y[n], cin) -> (sum[n]) {
    sum = x + y + {(n){cin}}
}

material brisk { kind: actuator, period: 42 steps, range: 0.8..1.4 }

";

fn completions(client: &mut Client, uri: &str, rest: &str) -> Vec<Value> {
    let text = format!("{START}{rest}");
    let place = place(uri, &text, "$");
    client.change(uri, &text.replace('$', ""));
    client.ask("textDocument/completion", place).unwrap().as_array().unwrap().clone()
}

fn labels(list: &[Value]) -> Vec<&str> {
    list.iter().map(|item| item["label"].as_str().unwrap()).collect()
}

#[test]
fn completion_knows_the_place() {
    let (_bench, mut client, uri, _) = opened("a.nb", START);
    let cases: [(&str, &[&str], &[&str]); 20] = [
        ("$", &["circuit", "use"], &["and", "half"]),
        ("// no$", &[], &["circuit"]),
        ("circuit f(p) -> (q) {\n    q = $", &["p", "q", "half", "not", "table"], &["circuit", "for", "material"]),
        ("circuit f(p) -> (q) {\n    t = not p\n    $\n    q = t\n}", &["p", "t", "for", "net"], &["and", "half"]),
        ("circuit f(p) -> (q) {\n    q = p $", &["and", "init", "xnor"], &["half", "not", "p"]),
        ("circuit f[m](p[m]) -> (q) {\n    q = p[$", &["m", "log2"], &["half", "and"]),
        ("test $", &["half", "ripple", "latch"], &["material", "brisk"]),
        ("test half {\n    a $", &["a", "b", "s", "c"], &["half"]),
        ("test half {\n    a b | s\n    0 1 | 1 for 3 $", &["cycles"], &["a"]),
        ("swarm w { $", &["circuit", "hold", "window"], &["kind", "half"]),
        ("swarm w { circuit: $", &["half", "ripple"], &["brisk", "auto"]),
        ("swarm w { circuit: half, registers: $", &["master_slave", "mux"], &["half"]),
        ("library l { from: shipped, behaviors: [$", &["nand", "xor"], &["half", "shipped"]),
        ("evolution e { materials: [$", &["brisk", "muscle"], &["sweep", "half"]),
        ("material m { kind: sensor, stimulus: $", &["s1", "s2"], &["brisk"]),
        ("material m { period: 42 $", &["cycles", "deg", "steps"], &["brisk"]),
        ("evolution e { mutation: { $", &["add_node", "change_weight"], &["half"]),
        ("swarm w { circuit: half }\nsimulate $", &["w"], &["half", "brisk"]),
        ("swarm w { circuit: half }\nsimulate w with $", &["sweep", "schedule"], &["w", "half"]),
        ("test ripple[2] for all inputs against $", &["half", "add"], &["brisk"]),
    ];
    for (rest, wanted, unwanted) in cases {
        let found = completions(&mut client, &uri, rest);
        let labels = labels(&found);
        assert!(wanted.iter().all(|label| labels.contains(label)), "{rest}: {labels:?}");
        assert!(unwanted.iter().all(|label| !labels.contains(label)), "{rest}: {labels:?}");
    }
    client.goodbye();
}

#[test]
fn completion_finds_the_files_and_folders_of_a_path() {
    let bench = Bench::new();
    for folder in ["parts", "parts/robots", ".hidden"] {
        fs::create_dir(bench.path().join(folder)).unwrap();
    }
    for name in ["half.nb", "notes.txt", "parts/cells.blif", "parts/mux.v", ".secret.nb"] {
        bench.file(name, "");
    }
    let (uri, text) = file(&bench, "a.nb", START);
    let mut client = Client::start();
    client.open(&uri, &text);
    let cases: [(&str, &[&str]); 11] = [
        ("use \"$\"", &["half.nb", "parts/"]),
        ("use \"ha$", &["half.nb", "parts/"]),
        ("use \"parts/$\"", &["cells.blif", "mux.v", "robots/"]),
        ("use \"./parts/../parts/c$\"", &["cells.blif", "mux.v", "robots/"]),
        ("use \".$\"", &[".hidden/", ".secret.nb", "half.nb", "parts/"]),
        ("use \"missing/$\"", &[]),
        ("use $\"half.nb\"", &[]),
        ("use \"half.nb\"$", &[]),
        ("library l { from: \"$\" }", &["parts/"]),
        ("library l { from: \"parts/$", &["robots/"]),
        ("test half \"$\" {", &[]),
    ];
    for (rest, expected) in cases {
        assert_eq!(labels(&completions(&mut client, &uri, rest)), expected, "{rest}");
    }
    // Only the name is replaced, whatever an editor thinks a word is.
    let rest = "use \"parts/cel$\"";
    let found = completions(&mut client, &uri, rest);
    let text = format!("{START}{rest}").replace('$', "");
    assert_eq!(client.edited(&text, &[found[0]["textEdit"].clone()]), format!("{START}use \"parts/cells.blif\""));
    // Outside of a path, its signs complete nothing.
    let text = format!("{START}/$");
    let mut asked = place(&uri, &text, "$");
    asked["context"] = json!({ "triggerKind": 2, "triggerCharacter": "/" });
    client.change(&uri, &text.replace('$', ""));
    assert_eq!(client.ask("textDocument/completion", asked).unwrap(), json!([]));
    client.goodbye();
}

#[test]
fn a_completed_call_has_its_operands_its_signature_and_its_comment() {
    let (_bench, mut client, uri, _) = opened("a.nb", START);
    let found = completions(&mut client, &uri, "circuit f(p) -> (q) {\n    q = ha$");
    let half = found.iter().find(|item| item["label"] == "half").unwrap();
    assert_eq!((&half["insertText"], &half["insertTextFormat"]), (&json!("half(${1:a}, ${2:b})"), &json!(2)));
    assert_eq!(
        (&half["detail"], &half["documentation"]["value"]),
        (&json!("half(a, b) -> (s, c)"), &json!("Adds two bits."))
    );
    client.goodbye();
}

#[test]
fn the_signature_of_a_call_shows_the_operand_that_is_being_written() {
    let (_bench, mut client, uri, _) = opened("a.nb", START);
    let mut active = |rest: &str| {
        let text = format!("{START}circuit f(p[4], q[4]) -> (r[4]) {{\n    r = {rest}");
        let place = place(&uri, &text, "$");
        client.change(&uri, &text.replace('$', ""));
        let help = client.ask("textDocument/signatureHelp", place).unwrap();
        let Some(signature) = help["signatures"].get(0) else { return (Value::Null, String::new()) };
        let at = help["activeParameter"].as_u64().unwrap() as usize;
        let label = signature["label"].as_str().unwrap();
        let place = &signature["parameters"][at]["label"];
        let (start, end) = (place[0].as_u64().unwrap() as usize, place[1].as_u64().unwrap() as usize);
        (signature["label"].clone(), label[start..end].to_owned())
    };
    let ripple = json!("ripple[n](x[n], y[n], cin) -> (sum[n])");
    assert_eq!(active("ripple($"), (ripple.clone(), "x[n]".to_owned()));
    assert_eq!(active("ripple[4](p, any({p, q}), $"), (ripple.clone(), "cin".to_owned()));
    assert_eq!(active("ripple[$"), (ripple, "n".to_owned()));
    assert_eq!(active("ripple(p, half(p[0], $").1, "b");
    assert_eq!(active("p and $").0, Value::Null);
    client.goodbye();
}

#[test]
fn certain_help_is_a_quick_fix() {
    let bench = Bench::new();
    let cases = [
        ("circuit f(abc) -> (q) {\n    q = abd\n}\n", "abd", "circuit f(abc) -> (q) {\n    q = abc\n}\n"),
        (
            "circuit f(a[4]) -> (q[8]) {\n    q = {a, 10}\n}\n",
            "10",
            "circuit f(a[4]) -> (q[8]) {\n    q = {a, 4'd10}\n}\n",
        ),
        (
            "circuit f(a[2]) -> (q) {\n    q = table(a) { 00: 1, 01: 0 }\n}\n",
            "table",
            "circuit f(a[2]) -> (q) {\n    q = table(a) { 00: 1, 01: 0, else: 0 }\n}\n",
        ),
        (
            "circuit f(a) -> (q) {\n    t = not a\n    q = a\n}\n",
            "t =",
            "circuit f(a) -> (q) {\n    _t = not a\n    q = a\n}\n",
        ),
        ("circut f(a) -> (q) {\n    q = a\n}\n", "circut", "circuit f(a) -> (q) {\n    q = a\n}\n"),
        ("circuit f(a b) -> (q) {\n    q = a\n}\n", "b)", "circuit f(a, b) -> (q) {\n    q = a\n}\n"),
        ("material m { kind: actuator, phase: 90 }\n", "90", "material m { kind: actuator, phase: 90 deg }\n"),
    ];
    let mut client = Client::start();
    for (at_all, (text, word, fixed)) in (0..).zip(cases) {
        let (uri, text) = file(&bench, &format!("{at_all}.nb"), text);
        client.open(&uri, &text);
        let range = json!({ "start": at(&text, word), "end": at(&text, word) });
        let asked = json!({ "textDocument": { "uri": uri }, "range": range, "context": { "diagnostics": [] } });
        let actions = client.ask("textDocument/codeAction", asked).unwrap();
        let edits = actions[0]["edit"]["changes"][&uri].as_array().unwrap_or_else(|| panic!("{word}: {actions}"));
        assert_eq!(client.edited(&text, edits), fixed, "{word}");
    }
    client.goodbye();
}
