//! The language server behind a page: what is outside of its folder stays unknown to it, whatever it asks.

use std::net::TcpStream;

use tungstenite::{Message, WebSocket};

use super::page::Server;
use crate::support::*;

/// The requests about a text, without the word before their names.
const METHODS: &str = "hover definition references documentHighlight prepareRename rename documentSymbol foldingRange \
    formatting rangeFormatting codeAction completion signatureHelp selectionRange semanticTokens/full \
    semanticTokens/range inlayHint documentLink codeLens";

fn methods() -> impl Iterator<Item = String> {
    METHODS.split_whitespace().map(|name| format!("textDocument/{name}"))
}

struct Language {
    socket: WebSocket<TcpStream>,
    next: u64,
}

impl Language {
    fn open(server: &Server) -> Self {
        let socket = server.socket("language", &format!("http://{}", server.host())).unwrap();
        let mut language = Self { socket, next: 0 };
        let folders = json!([{ "uri": "file:///", "name": "all" }]);
        let parameters = json!({ "capabilities": {}, "rootUri": "file:///", "workspaceFolders": folders });
        language.ask("initialize", parameters);
        language.tell("initialized", json!({}));
        language
    }

    fn send(&mut self, message: Value) {
        self.socket.send(Message::text(message.to_string())).unwrap();
    }

    fn tell(&mut self, method: &str, parameters: Value) {
        self.send(json!({ "jsonrpc": "2.0", "method": method, "params": parameters }));
    }

    /// What the server says up to the answer of a request, the answer last.
    fn ask(&mut self, method: &str, parameters: Value) -> Vec<Value> {
        self.next += 1;
        self.send(json!({ "jsonrpc": "2.0", "id": self.next, "method": method, "params": parameters }));
        let mut said = Vec::new();
        while said.last().is_none_or(|last: &Value| last["id"] != self.next || last.get("method").is_some()) {
            let Message::Text(text) = self.socket.read().unwrap() else { continue };
            said.push(serde_json::from_str(&text).unwrap());
        }
        said
    }

    /// All that is said about a text at a URI, without the numbers of requests.
    fn all(&mut self, uri: &str, text: &str) -> String {
        let document = json!({ "uri": uri, "languageId": "nb", "version": 1, "text": text });
        self.tell("textDocument/didOpen", json!({ "textDocument": document }));
        self.tell("workspace/didChangeWatchedFiles", json!({ "changes": [{ "uri": uri, "type": 2 }] }));
        let added = json!([{ "uri": uri, "name": "more" }]);
        self.tell("workspace/didChangeWorkspaceFolders", json!({ "event": { "added": added, "removed": [] } }));
        let mut said = Vec::new();
        // In both paths of the text, behind their last slash, and at the name of the circuit.
        let last_slash = |line: usize| text.lines().nth(line).unwrap().rfind('/').unwrap() + 1;
        for (line, character) in [(0, last_slash(0)), (1, last_slash(1)), (2, 9)] {
            let place = json!({ "line": line, "character": character });
            let range = json!({ "start": { "line": 0, "character": 0 }, "end": { "line": 9, "character": 0 } });
            let parameters = json!({
                "textDocument": { "uri": uri }, "position": place, "positions": [place], "range": range,
                "newName": "other", "options": { "tabSize": 4, "insertSpaces": true },
                "context": { "includeDeclaration": true, "diagnostics": [], "triggerKind": 1 },
            });
            said.extend(methods().flat_map(|method| self.ask(&method, parameters.clone())));
        }
        said.extend(self.ask("workspace/symbol", json!({ "query": "" })));
        for command in ["nbc.run", "nbc.test", "nbc.schematic", "nbc.timing"] {
            let arguments = json!([{ "uri": uri, "circuit": "own" }]);
            said.extend(self.ask("workspace/executeCommand", json!({ "command": command, "arguments": arguments })));
        }
        self.tell("textDocument/didClose", json!({ "textDocument": { "uri": uri } }));
        // What is said about the end of the text does not belong to the next one.
        self.ask("workspace/symbol", json!({ "query": "" }));
        said.iter_mut().for_each(|message| message["id"] = Value::Null);
        // Mistakes are published when they are found, before or after an answer.
        let mut said: Vec<String> = said.iter().map(Value::to_string).collect();
        said.sort_unstable();
        said.join("\n")
    }
}

fn secret() -> (Bench, Server) {
    let bench = Bench::new();
    for name in ["secret.nb", "secret.v", "secret_robots/secret.yaml", "served/own.nb", "served/inner/part.nb"] {
        bench.file(name, "circuit hidden(a) -> (q) { q = not a }\n");
    }
    let served = bench.path().join("served");
    #[cfg(unix)]
    std::os::unix::fs::symlink(bench.path(), served.join("up")).unwrap();
    #[cfg(unix)]
    std::os::unix::fs::symlink(bench.path().join("secret.nb"), served.join("link.nb")).unwrap();
    let server = Server::start(&served, &["own.nb"]);
    (bench, server)
}

fn text(file: &str, folder: &str) -> String {
    format!("use \"{file}\"\nlibrary robots {{ from: \"{folder}\" }}\ncircuit own(a) -> (q) {{ q = hidden(a) }}\n")
}

/// A path as it is, and with `up` as the link that leads there.
fn ways(folder: &Path, name: &str) -> Vec<String> {
    let whole = folder.canonicalize().unwrap();
    let ways = ["../".to_owned(), "inner/../../".to_owned(), "up/".to_owned(), format!("{}/", whole.display())];
    ways.iter().map(|way| format!("{way}{name}")).collect()
}

#[test]
fn nothing_outside_of_the_folder_is_known_to_any_request() {
    let (folder, server) = secret();
    let whole = folder.path().canonicalize().unwrap();
    let homes = [
        format!("file://{}/served/new.nb", whole.display()),
        format!("file://{}/new.nb", whole.display()),
        format!("file://{}/served/up/new.nb", whole.display()),
        "file:///new.nb".to_owned(),
    ];
    for home in &homes {
        // A connection for each, as one may send so many messages a second.
        let mut language = Language::open(&server);
        let ways = |name| ways(folder.path(), name).into_iter();
        for (((file, absent), robots), none) in
            ways("secret.nb").zip(ways("absent.nb")).zip(ways("secret_robots")).zip(ways("absent_robots"))
        {
            let there = language.all(home, &text(&file, &robots));
            let missing = language.all(home, &text(&absent, &none));
            // What is there is answered like what is not: nobody learns which of the two it is.
            assert_eq!(there.replace("secret", "absent"), missing, "{home}: {file}");
            assert!(!missing.contains("secret"), "{missing}");
        }
    }
}

#[test]
fn texts_outside_of_the_folder_are_not_opened_by_their_addresses() {
    let (folder, server) = secret();
    let whole = folder.path().canonicalize().unwrap();
    let mut language = Language::open(&server);
    for name in ["secret.nb", "served/up/secret.nb", "served/link.nb"] {
        let uri = format!("file://{}/{name}", whole.display());
        let asked = json!({ "textDocument": { "uri": uri }, "position": { "line": 0, "character": 9 } });
        for method in methods() {
            let said = language.ask(&method, asked.clone()).pop().unwrap();
            assert!(said["error"].is_object() || said["result"].is_null(), "{method}: {said}");
        }
    }
    let symbols = language.ask("workspace/symbol", json!({ "query": "hidden" })).pop().unwrap().to_string();
    assert!(
        symbols.contains("served/own.nb") && !symbols.contains("secret") && !symbols.contains("link.nb"),
        "{symbols}"
    );
}

#[test]
fn what_is_in_the_folder_is_completed_and_linked() {
    let (folder, server) = secret();
    let mut language = Language::open(&server);
    let home = format!("file://{}/served/new.nb", folder.path().canonicalize().unwrap().display());
    let said = language.all(&home, &text("inner/part.nb", "inner/"));
    assert!(said.contains("\"part.nb\"") && said.contains("served/inner/part.nb"), "{said}");
    assert!(!said.contains("/nbc-") && said.contains("outside of the folder of this client"), "{said}");
}
