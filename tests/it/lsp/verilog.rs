//! Verilog in editors: it is read only as long as somebody waits for it.

use crate::lsp::client::{Client, uri};
use crate::support::slow_yosys::{MODULE, SlowYosys, USER, ended};
use crate::support::*;

fn waiting(slow: &SlowYosys) -> (Client, String, u32) {
    let mut client = Client::of(&mut slow.program(), &json!({ "capabilities": {} }));
    let own = uri(&slow.bench.path().join("a.nb"));
    client.open(&own, USER);
    let yosys = slow.begun();
    (client, own, yosys)
}

#[test]
fn verilog_that_a_text_uses_is_read() {
    let Some(_) = SLANG.find() else { return };
    let bench = Bench::with("m.v", MODULE);
    let own = uri(&bench.file("a.nb", USER));
    let mut client = Client::initialized(&json!({ "capabilities": {} }));
    client.open(&own, USER);
    assert_eq!(client.diagnostics(&own), json!([]));
    client.goodbye();
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
