//! A client of `nbc lsp` over pipes.

use std::io::{BufReader, Write};
use std::process::{Child, ChildStdin, ChildStdout, Command, Stdio};

use lsp_server::{Message, Response};

use crate::support::*;

pub(super) struct Client {
    pub(super) server: Child,
    _limit: Limit,
    pub(super) input: Option<ChildStdin>,
    output: BufReader<ChildStdout>,
    next: i32,
    version: i32,
    answers: Vec<Response>,
    capabilities: Value,
    pub(super) requests: Vec<String>,
    pub(super) told: Vec<Value>,
    /// The diagnostics published since they were last asked for, by URI.
    published: Vec<(String, Value)>,
}

impl Client {
    pub(super) fn start() -> Self {
        Self::with(&json!({}))
    }

    pub(super) fn with(capabilities: &Value) -> Self {
        Self::initialized(&json!({ "clientInfo": { "name": "tests" }, "capabilities": capabilities }))
    }

    pub(super) fn initialized(parameters: &Value) -> Self {
        Self::of(&mut Command::new(env!("CARGO_BIN_EXE_nbc")), parameters)
    }

    pub(super) fn of(program: &mut Command, parameters: &Value) -> Self {
        let mut server = program
            .args(["lsp", "--stdio"])
            .stdin(Stdio::piped())
            .stdout(Stdio::piped())
            .stderr(Stdio::null())
            .spawn()
            .unwrap();
        let input = server.stdin.take();
        let output = BufReader::new(server.stdout.take().unwrap());
        let mut client = Self {
            _limit: Limit::of(&server),
            server,
            input,
            output,
            next: 0,
            version: 1,
            answers: Vec::new(),
            capabilities: Value::Null,
            requests: Vec::new(),
            told: Vec::new(),
            published: Vec::new(),
        };
        let answer = client.ask("initialize", parameters.clone()).unwrap();
        assert_eq!(answer["serverInfo"]["name"], "nbc");
        client.capabilities = answer["capabilities"].clone();
        client.tell("initialized", json!({}));
        client
    }

    pub(super) fn send(&mut self, message: &Value) {
        let text = message.to_string();
        let input = self.input.as_mut().unwrap();
        write!(input, "Content-Length: {}\r\n\r\n{text}", text.len()).unwrap();
        input.flush().unwrap();
    }

    pub(super) fn tell(&mut self, method: &str, parameters: Value) {
        self.send(&json!({ "jsonrpc": "2.0", "method": method, "params": parameters }));
    }

    pub(super) fn ask(&mut self, method: &str, parameters: Value) -> Result<Value, String> {
        let id = self.begin(method, parameters);
        self.wait(id)
    }

    pub(super) fn begin(&mut self, method: &str, parameters: Value) -> i32 {
        self.next += 1;
        self.send(&json!({ "jsonrpc": "2.0", "id": self.next, "method": method, "params": parameters }));
        self.next
    }

    /// The answer to a request, which may have come already.
    pub(super) fn wait(&mut self, id: i32) -> Result<Value, String> {
        loop {
            if let Some(at) = self.answers.iter().position(|answer| answer.id == id.into()) {
                return self.answers.remove(at).response_result.map_err(|error| error.message);
            }
            match Message::read(&mut self.output).unwrap().expect("the server answers") {
                Message::Response(response) => self.answers.push(response),
                Message::Notification(told) if told.method == "textDocument/publishDiagnostics" => {
                    let uri = told.params["uri"].as_str().unwrap().to_owned();
                    self.published.push((uri, told.params["diagnostics"].clone()));
                }
                Message::Notification(told) if told.method == "$/progress" => self.told.push(told.params),
                Message::Notification(_) => {}
                Message::Request(request) => {
                    self.requests.push(request.method);
                    self.send(&json!({ "jsonrpc": "2.0", "id": request.id, "result": null }));
                }
            }
        }
    }

    pub(super) fn capabilities(&self) -> &Value {
        &self.capabilities
    }

    pub(super) fn change(&mut self, uri: &str, text: &str) {
        self.edit(uri, &json!([{ "text": text }]));
    }

    /// Changes a text; returns its version.
    pub(super) fn edit(&mut self, uri: &str, changes: &Value) -> i32 {
        self.version += 1;
        let document = json!({ "uri": uri, "version": self.version });
        self.tell("textDocument/didChange", json!({ "textDocument": document, "contentChanges": changes }));
        self.version
    }

    /// Waits for the diagnostics of a version of a text; the number of versions of which there were diagnostics until
    /// then.
    pub(super) fn published(&mut self, uri: &str, version: i32) -> usize {
        for count in 1.. {
            let told = loop {
                match Message::read(&mut self.output).unwrap().expect("the server publishes") {
                    Message::Notification(told) if told.method == "textDocument/publishDiagnostics" => {
                        break told.params;
                    }
                    _ => {}
                }
            };
            if (told["uri"].as_str(), told["version"].as_i64()) == (Some(uri), Some(version.into())) {
                self.published.push((uri.to_owned(), told["diagnostics"].clone()));
                return count;
            }
        }
        unreachable!("it counts on")
    }

    pub(super) fn text(&self, text: &str, range: &Value) -> String {
        text[offset(text, &range["start"])..offset(text, &range["end"])].to_owned()
    }

    pub(super) fn edited(&self, text: &str, edits: &[Value]) -> String {
        let place = |edit: &Value| offset(text, &edit["range"]["start"])..offset(text, &edit["range"]["end"]);
        let mut edits: Vec<_> = edits.iter().map(|edit| (place(edit), edit["newText"].as_str().unwrap())).collect();
        edits.sort_by_key(|(place, _)| place.start);
        let mut text = text.to_owned();
        edits.into_iter().rev().for_each(|(place, new)| text.replace_range(place, new));
        text
    }

    pub(super) fn open(&mut self, uri: &str, text: &str) {
        let document = json!({ "uri": uri, "languageId": "nb", "version": 1, "text": text });
        self.tell("textDocument/didOpen", json!({ "textDocument": document }));
    }

    /// The last diagnostics of a file. An answer to any request comes after them.
    pub(super) fn diagnostics(&mut self, uri: &str) -> Value {
        self.ask("textDocument/foldingRange", json!({ "textDocument": { "uri": uri } })).unwrap();
        let found = self.published.iter().rev().find(|(known, _)| known == uri);
        found.map(|(_, list)| list.clone()).expect("diagnostics were published")
    }

    pub(super) fn goodbye(mut self) {
        self.ask("shutdown", Value::Null).unwrap();
        self.tell("exit", Value::Null);
        assert!(self.server.wait().unwrap().success());
    }
}

pub(super) fn uri(path: &Path) -> String {
    format!("file://{}", path.canonicalize().unwrap().display())
}

pub(super) fn file(bench: &Bench, name: &str, text: &str) -> (String, String) {
    bench.file(name, text);
    (uri(&bench.path().join(name)), text.to_owned())
}

/// A client with one open file in a folder of its own: the folder, the client, the URI and the text.
pub(super) fn opened(name: &str, text: &str) -> (Bench, Client, String, String) {
    let bench = Bench::new();
    let (uri, text) = file(&bench, name, text);
    let mut client = Client::start();
    client.open(&uri, &text);
    (bench, client, uri, text)
}

pub(super) fn at(text: &str, word: &str) -> Value {
    let before = &text[..text.find(word).unwrap()];
    let line = before.matches('\n').count();
    let start = before.rfind('\n').map_or(0, |end| end + 1);
    json!({ "line": line, "character": before[start..].encode_utf16().count() })
}

pub(super) fn place(uri: &str, text: &str, word: &str) -> Value {
    json!({ "textDocument": { "uri": uri }, "position": at(text, word) })
}

fn offset(text: &str, position: &Value) -> usize {
    let line = position["line"].as_u64().unwrap() as usize;
    let start: usize = text.split_inclusive('\n').take(line).map(str::len).sum();
    let mut left = position["character"].as_u64().unwrap() as usize;
    for (at, character) in text[start..].char_indices() {
        if left == 0 {
            return start + at;
        }
        left = left.saturating_sub(character.len_utf16());
    }
    text.len()
}
