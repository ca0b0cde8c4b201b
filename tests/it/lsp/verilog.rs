//! Verilog in editors: only where the user trusts it, and only as long as somebody waits for it.

use serde_json::{Value, json};

use crate::lsp::client::{Client, at, uri};
use crate::support::slow_yosys::{MODULE, REACHING, SlowYosys, USER, ended};
use crate::support::tools::{YOSYS, signal};

fn parameters(trusted: &Value) -> Value {
    json!({ "capabilities": {}, "initializationOptions": { "verilog": { "trusted": trusted } } })
}

/// A server that waits for Yosys, with the URI of its text and the process.
fn waiting(slow: &SlowYosys) -> (Client, String, u32) {
    let mut client = Client::of(&mut slow.program(), &parameters(&json!(true)));
    let own = uri(&slow.bench.path().join("a.nb"));
    client.open(&own, USER);
    let yosys = slow.begun();
    (client, own, yosys)
}

#[test]
fn verilog_of_a_workspace_that_is_not_trusted_is_not_given_to_yosys() {
    for trusted in [json!(false), Value::Null, json!("yes"), json!([])] {
        let slow = SlowYosys::new();
        let mut client = Client::of(&mut slow.program(), &parameters(&trusted));
        let own = uri(&slow.bench.path().join("a.nb"));
        client.open(&own, USER);
        // Settings can come from files of the workspace.
        let settings = json!({ "settings": { "nbc": { "verilog": { "trusted": true } } } });
        client.tell("workspace/didChangeConfiguration", settings);
        client.change(&own, &format!("{USER}\n"));
        let found = client.diagnostics(&own);
        let said = found[0]["message"].as_str().unwrap();
        assert!(said.contains("a workspace that is not trusted") && said.contains("`verilog.trusted`"), "{said}");
        assert_eq!(found[0]["range"]["start"], at(USER, "\"m.v\""));
        client.goodbye();
        assert!(!slow.has_begun());
    }
}

#[test]
fn verilog_of_a_trusted_workspace_is_translated() {
    if !YOSYS.is_there() {
        return;
    }
    let bench = crate::support::bench::Bench::new();
    bench.file("m.v", MODULE);
    let own = uri(&bench.file("a.nb", USER));
    let mut client = Client::initialized(&parameters(&json!(true)));
    client.open(&own, USER);
    // Only an old Yosys is told.
    let found = client.diagnostics(&own);
    let is_old = |fault: &Value| fault["severity"] == 2 && fault["message"].as_str().unwrap().contains("which is old");
    assert!(found.as_array().unwrap().iter().all(is_old), "{found}");
    client.goodbye();
}

#[test]
fn verilog_that_reaches_the_machine_is_refused_before_yosys_begins() {
    for (text, word) in REACHING {
        let slow = SlowYosys::new();
        slow.bench.file("m.v", format!("{text}{MODULE}"));
        let mut client = Client::of(&mut slow.program(), &parameters(&json!(true)));
        client.open(&uri(&slow.bench.path().join("a.nb")), USER);
        let found = client.diagnostics(&uri(&slow.bench.path().join("m.v"))).to_string();
        assert!(found.contains(&word.replace('\\', r"\\")), "{found}");
        client.goodbye();
        assert!(!slow.has_begun());
    }
}

#[test]
fn a_change_ends_yosys_and_what_is_new_is_checked() {
    let slow = SlowYosys::new();
    let (mut client, own, first) = waiting(&slow);
    client.change(&own, &format!("{USER}\n"));
    ended(first);
    let second = slow.begun();
    client.change(&own, "circuit f(a) -> (q) {\n    q = not a\n}\n");
    ended(second);
    assert_eq!(client.diagnostics(&own), json!([]));
    client.goodbye();
}

#[test]
fn yosys_ends_with_the_server() {
    let slow = SlowYosys::new();
    let (client, _, yosys) = waiting(&slow);
    client.goodbye();
    ended(yosys);
    for leave in [
        |client: &mut Client| drop(client.input.take()),
        |client: &mut Client| client.tell("exit", Value::Null),
        |client: &mut Client| signal("TERM", client.server.id()),
        |client: &mut Client| signal("KILL", client.server.id()),
    ] {
        let slow = SlowYosys::new();
        let (mut client, _, yosys) = waiting(&slow);
        leave(&mut client);
        client.server.wait().unwrap();
        ended(yosys);
    }
}
