//! Lenses, and the commands behind them.

use std::process::Command;

use crate::lsp::client::{Client, file, opened};
use crate::support::*;
use crate::unstable::{BOOM, SIMULATED, names};

const TESTED: &str = "\
circuit f(a, b) -> (q) {
    q = a nand b
}

test f \"is a nand\" {
    a b | q
    0 1 | 1
    1 1 | 0
}

swarm s { circuit: f }

simulate s with schedule (a, b) {
    1 1 for 3 cycles
}
";

fn lenses(client: &mut Client, uri: &str) -> Vec<Value> {
    client.ask("textDocument/codeLens", json!({ "textDocument": { "uri": uri } })).unwrap().as_array().unwrap().clone()
}

fn titled<'l>(lenses: &'l [Value], title: &str, line: u64) -> &'l Value {
    let is_meant = |lens: &&Value| {
        lens["command"]["title"].as_str().unwrap().starts_with(title) && lens["range"]["start"]["line"] == line
    };
    &lenses.iter().find(is_meant).unwrap_or_else(|| panic!("{title} at {line}: {lenses:?}"))["command"]
}

fn execute(client: &mut Client, command: &Value) -> Result<Value, String> {
    client.ask("workspace/executeCommand", json!({ "command": command["command"], "arguments": command["arguments"] }))
}

#[test]
fn lenses_run_tests_and_simulations_and_give_their_pages() {
    let (_bench, mut client, uri, _) = opened("a.nb", TESTED);
    let found = lenses(&mut client, &uri);
    let ran = execute(&mut client, titled(&found, "run in physics", 4)).unwrap();
    assert_eq!((&ran["passed"], &ran["text"]), (&json!(true), &json!("pass: 1 of 1 passed")));
    let page = fs::read_to_string(ran["path"].as_str().unwrap()).unwrap();
    assert!(page.contains("is a nand") && page.contains("<svg") && page.contains("pass: 1 of 1 test passed"));
    let ran = execute(&mut client, titled(&found, "run as logic", 4)).unwrap();
    let page = fs::read_to_string(ran["path"].as_str().unwrap()).unwrap();
    assert!(ran["passed"] == true && page.contains("<pre>") && page.contains("is a nand"), "{ran}");
    assert_eq!(ran["page"].as_str().unwrap(), format!("file://{}", ran["path"].as_str().unwrap()));
    let ran = execute(&mut client, titled(&found, "run in physics", 12)).unwrap();
    assert_eq!((&ran["passed"], &ran["text"]), (&Value::Null, &json!("simulated")));
    let drawn = execute(&mut client, titled(&found, "schematic", 0)).unwrap();
    let picture = fs::read_to_string(drawn["path"].as_str().unwrap()).unwrap();
    assert!(picture.starts_with("<svg"));
    client.goodbye();
}

#[test]
fn a_lens_proves_what_is_claimed() {
    let claimed = "circuit f(a) -> (q) {\n    q = not a\n}\n\nprove f \"one of both\" {\n    never a and q\n}\n\n\
                   prove f {\n    never q\n}\n";
    let (_bench, mut client, uri, _) = opened("a.nb", claimed);
    let found = lenses(&mut client, &uri);
    let ran = execute(&mut client, titled(&found, "prove", 4)).unwrap();
    let said = "f \"one of both\"\n    proved     never a and q  (by induction over 1 step)\n";
    assert_eq!((&ran["passed"], &ran["text"]), (&json!(true), &json!(said)));
    let ran = execute(&mut client, titled(&found, "prove", 8)).unwrap();
    assert!(ran["passed"] == false && ran["text"].as_str().unwrap().contains("test f \"never q\" {"), "{ran}");
    let all = json!({ "command": "nbc.prove", "arguments": [{ "uri": uri }] });
    let ran = execute(&mut client, &all).unwrap();
    assert!(ran["passed"] == false && ran["text"].as_str().unwrap().starts_with(said), "{ran}");
    client.goodbye();
}

#[test]
fn a_lens_tells_the_robots_and_the_clock() {
    let bench = Bench::new();
    let (uri, text) = file(&bench, "a.nb", TESTED);
    let mut client = Client::with(&json!({ "workspace": { "codeLens": { "refreshSupport": true } } }));
    client.open(&uri, &text);
    let has_figures = |found: &[Value]| {
        let title = |lens: &Value| lens["command"]["title"].as_str().unwrap().to_owned();
        found.iter().map(title).filter(|title| title.starts_with("1 robot, clock ")).count() == 2
    };
    let mut found = lenses(&mut client, &uri);
    while !has_figures(&found) {
        found = lenses(&mut client, &uri);
    }
    let timing = execute(&mut client, titled(&found, "1 robot", 10)).unwrap();
    assert!(timing["text"].as_str().unwrap().starts_with("timing   settles within "), "{timing}");
    client.tell("workspace/didChangeConfiguration", json!({ "settings": { "nbc": { "codeLenses": false } } }));
    let off = client.ask("textDocument/codeLens", json!({ "textDocument": { "uri": uri } })).unwrap();
    assert_eq!(off, Value::Null);
    client.goodbye();
}

#[test]
fn the_progress_of_a_run_is_told() {
    let (_bench, mut client, uri, _) = opened("a.nb", TESTED);
    let asked = json!({ "command": "nbc.run", "arguments": [{ "uri": uri }], "workDoneToken": "mine" });
    let ran = client.ask("workspace/executeCommand", asked).unwrap();
    assert_eq!(ran["passed"], true);
    let kinds: Vec<_> =
        client.told.iter().filter(|told| told["token"] == "mine").map(|told| &told["value"]["kind"]).collect();
    assert_eq!((kinds[0], kinds[kinds.len() - 1]), (&json!("begin"), &json!("end")));
    assert!(kinds.len() > 2 && kinds[1..kinds.len() - 1].iter().all(|kind| **kind == "report"), "{kinds:?}");
    client.goodbye();
}

#[test]
fn a_run_can_be_cancelled_and_the_server_answers_meanwhile() {
    let bench = Bench::new();
    let long = TESTED.replace("for 3 cycles", "for 900000 cycles");
    let (uri, text) = file(&bench, "a.nb", &long);
    let mut client = Client::start();
    client.open(&uri, &text);
    for by_token in [true, false] {
        let asked =
            json!({ "command": "nbc.run", "arguments": [{ "uri": uri, "simulation": 0 }], "workDoneToken": "mine" });
        let id = client.begin("workspace/executeCommand", asked);
        assert_eq!(client.diagnostics(&uri), json!([]), "other requests do not wait");
        match by_token {
            true => client.tell("window/workDoneProgress/cancel", json!({ "token": "mine" })),
            false => client.tell("$/cancelRequest", json!({ "id": id })),
        }
        assert_eq!(client.wait(id).unwrap_err(), "cancelled");
    }
    // A client that leaves does not wait for what it began.
    client.begin(
        "workspace/executeCommand",
        json!({ "command": "nbc.run", "arguments": [{ "uri": uri, "simulation": 0 }] }),
    );
    client.goodbye();
}

#[test]
fn wrong_commands_are_refused() {
    let (_bench, mut client, uri, _) = opened("a.nb", "circuit f(a) -> (q) { q = b }\n");
    let mut ask = |command: &str, arguments: Value| {
        let asked = json!({ "command": command, "arguments": arguments });
        client.ask("workspace/executeCommand", asked).unwrap_err()
    };
    assert!(ask("nbc.fly", json!([{ "uri": uri }])).contains("`nbc.fly` is not a command"));
    assert!(ask("nbc.run", json!([])).contains("expected an object with the `uri`"));
    assert!(ask("nbc.run", json!([{ "uri": "untitled:x" }])).contains("is not open"));
    assert_eq!(ask("nbc.run", json!([{ "uri": uri }])), "the source has errors");
    client.goodbye();
}

fn client_with_temporary_files(bench: &Bench) -> Client {
    Client::of(Command::new(env!("CARGO_BIN_EXE_nbc")).env("TMPDIR", bench.path()), &json!({ "capabilities": {} }))
}

#[test]
#[cfg(unix)]
fn results_end_with_their_server_and_those_of_dead_servers_are_removed() {
    let (bench, temporary) = (Bench::new(), Bench::new());
    let (uri, text) = file(&bench, "a.nb", TESTED);
    let user = std::os::unix::fs::MetadataExt::uid(&fs::metadata(temporary.path()).unwrap());
    let all = temporary.path().join(format!("nbc-{}-{user}", env!("CARGO_PKG_VERSION")));
    let kept = ["results-x", "other", "prelude.nb"].map(|name| all.join(name));
    for folder in ["results-4194305/a_nb", "results-x", "other"] {
        fs::create_dir_all(all.join(folder)).unwrap();
    }
    fs::write(all.join("results-4194305/a_nb/report.html"), "of a server that was killed").unwrap();
    fs::write(&kept[2], "").unwrap();
    std::os::unix::fs::symlink(bench.path(), all.join("results-4194306")).unwrap();

    let asked = json!({ "command": "nbc.schematic", "arguments": [{ "uri": uri }] });
    let mut first = client_with_temporary_files(&temporary);
    first.open(&uri, &text);
    let drawn = first.ask("workspace/executeCommand", asked.clone()).unwrap();
    assert!(!all.join("results-4194305").exists() && kept.iter().all(|path| path.exists()));
    assert!(bench.has("a.nb"), "links are not followed");
    let path = PathBuf::from(drawn["path"].as_str().unwrap());
    assert!(path.starts_with(all.join(format!("results-{}", first.server.id()))), "{drawn}");
    // Another server leaves the results of one that lives.
    client_with_temporary_files(&temporary).goodbye();
    assert!(path.exists());
    first.goodbye();
    assert!(!path.parent().unwrap().parent().unwrap().exists());

    // A client that vanishes leaves nothing either, and what a killed server leaves is removed.
    for is_killed in [false, true] {
        let mut client = client_with_temporary_files(&temporary);
        client.open(&uri, &text);
        let drawn = client.ask("workspace/executeCommand", asked.clone()).unwrap();
        if is_killed {
            client.server.kill().unwrap();
        }
        drop(client.input.take());
        client.server.wait().unwrap();
        let path = Path::new(drawn["path"].as_str().unwrap());
        assert_eq!(path.exists(), is_killed);
        client_with_temporary_files(&temporary).goodbye();
        assert!(!path.exists());
    }
}

#[test]
fn a_robot_that_fails_is_named() {
    for (text, says) in [(BOOM, "FAIL: 0 of 1 passed; "), (SIMULATED, "FAIL: ")] {
        let (_bench, mut client, uri, _) = opened("a.nb", text);
        let order = json!({ "command": "nbc.run", "arguments": [{ "uri": uri }] });
        let ran = client.ask("workspace/executeCommand", order).unwrap();
        assert_eq!(ran["passed"], false);
        let told = ran["text"].as_str().unwrap();
        assert!(told.starts_with(says) && names(told), "{told}");
        client.goodbye();
    }
}
