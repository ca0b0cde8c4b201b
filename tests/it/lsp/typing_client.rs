//! A client that types letters and takes them back, again and again.

use crate::lsp::client::{Client, file};

use crate::support::*;

/// Messages that are sent before the answer to the last of them is awaited. What the server sends meanwhile fits into
/// its pipe.
const AHEAD: usize = 20;

pub(super) struct TypingClient {
    client: Client,
    uri: String,
    edits: usize,
}

impl TypingClient {
    pub(super) fn start(bench: &Bench) -> Self {
        let path = programs("circuits").into_iter().find(|path| path.ends_with("full_adder.nb")).unwrap();
        let (uri, text) = file(bench, "a.nb", &fs::read_to_string(path).unwrap());
        let mut client = Client::start();
        client.open(&uri, &text);
        Self { client, uri, edits: 0 }
    }

    /// Types until there are so many edits, with so many in each message. Now and then it waits, and asks for lenses.
    pub(super) fn type_until(&mut self, edits: usize, each: usize) {
        let mut sent = 0;
        while self.edits < edits {
            let changes: Vec<Value> = (0..each).map(|more| change(self.edits + more)).collect();
            let version = self.client.edit(&self.uri, &json!(changes));
            self.edits += each;
            sent += 1;
            if sent % AHEAD == 0 || self.edits >= edits {
                self.client.published(&self.uri, version);
                self.client.ask("textDocument/codeLens", json!({ "textDocument": { "uri": self.uri } })).unwrap();
            }
        }
    }

    pub(super) fn megabytes(&self) -> f64 {
        let status = fs::read_to_string(format!("/proc/{}/status", self.client.server.id())).unwrap();
        let held = status.lines().find_map(|line| line.strip_prefix("VmRSS:")).unwrap();
        held.trim().trim_end_matches(" kB").parse::<f64>().unwrap() / 1024.0
    }

    /// Takes leave, with the text as it was at first.
    pub(super) fn goodbye(mut self) {
        assert_eq!(self.client.diagnostics(&self.uri), json!([]));
        self.client.goodbye();
    }
}

fn change(number: usize) -> Value {
    let is_there = number % 2 == 1;
    let (start, end) = (json!({ "line": 0, "character": 0 }), json!({ "line": 0, "character": u32::from(is_there) }));
    json!({ "range": { "start": start, "end": end }, "text": if is_there { "" } else { "/" } })
}
