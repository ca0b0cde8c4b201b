//! The language in editors, by the Language Server Protocol.
//!
//! The server passes the texts of the editor to a `Session`, and answers requests with its results.

mod aids;
mod buffers;
mod capabilities;
mod commands;
mod compiler;
mod completion;
mod figures;
mod files;
mod hints;
mod hover;
mod interface;
mod later;
mod layout;
mod lenses;
mod links;
mod names;
mod navigation;
mod outline;
mod pending;
mod position;
mod problems;
mod rename;
mod requests;
mod runs;
mod selection;
mod semantics;
mod server;
mod server_end;
mod settings;
mod signature;
mod spot;
mod texts;
mod tokens;
mod uri;
mod used_files;
mod wire;
mod wording;
mod workspace;

use std::path::Path;
use std::sync::Arc;
use std::thread;

use crossbeam_channel::bounded;
use gen_lsp_types::{InitializeResult, ServerInfo};
use lsp_server::{Connection, ErrorCode, Message, Request, Response};

pub use server_end::ServerEnd;
pub use wording::ServerError;

use capabilities::{Client, capabilities};
use nbc_base::source::VerilogError;
use nbc_session::store::{DiskWorld, FolderWorld, GuardedWorld, VerilogFiles};
use pending::Pending;
use server::Server;
pub use wire::{NO_MESSAGE, message};

/// Serves an editor on standard input and output until it ends the session or closes its connection.
///
/// # Errors
/// When the client does not speak the protocol.
pub fn serve_standard() -> Result<ServerEnd, ServerError> {
    let (connection, wire) = wire::open();
    // After an error the threads still wait for the client.
    let end = serve(connection, DiskWorld)?;
    wire.join().map_err(ServerError::Protocol)?;
    Ok(end)
}

/// The most messages that wait to be handled.
const WAITING: usize = 32;

/// The connection with a queue of messages in front of the server. The server looks ahead in the queue: if another
/// change of a text is waiting, it does not check the older text.
fn queued(connection: Connection) -> (Connection, Pending) {
    let Connection { sender, receiver: arriving } = connection;
    let (queue, receiver) = bounded(WAITING);
    let pending = Pending::default();
    let noted = pending.clone();
    // It ends with the thread that reads, or with the server.
    thread::spawn(move || {
        let _ = arriving.into_iter().try_for_each(|message| {
            noted.add(&message);
            queue.send(message)
        });
        noted.end();
    });
    (Connection { sender, receiver }, pending)
}

/// Serves a client until it ends the session or closes its connection.
///
/// # Errors
/// When it does not speak the protocol.
pub fn serve(
    connection: Connection,
    world: impl VerilogFiles + Send + Sync + 'static,
) -> Result<ServerEnd, ServerError> {
    let (connection, pending) = queued(connection);
    let Some(client) = greeted(&connection, &pending)? else { return Ok(ServerEnd::Abandoned) };
    let (is_trusted, waiting) = (client.trusts_verilog, pending.clone());
    let world = GuardedWorld::new(world, move || waiting.cancel());
    let world = if is_trusted { world } else { world.refusing(VerilogError::Untrusted) };
    Ok(Server::new(&connection, client, Arc::new(world), pending).run())
}

/// Serves a client that sends these texts, each of which should be a message, and then closes its connection. The
/// fuzzer calls this, because it needs no pipe.
pub fn serve_texts(folder: &Path, texts: &[&[u8]]) {
    let world = FolderWorld::new(folder).expect("there is such a folder");
    let (server, client) = Connection::memory();
    for message in texts.iter().filter_map(|text| wire::message(serde_json::from_slice(text).ok()?).ok()) {
        client.sender.send(message).expect("the server has not begun");
    }
    drop(client);
    // A client may break the protocol.
    let _ = serve(server, world);
}

/// The abilities and settings of the client, from its `initialize` request; `None` if the connection ends before.
fn greeted(connection: &Connection, pending: &Pending) -> Result<Option<Client>, ServerError> {
    loop {
        let message = connection.receiver.recv();
        let message = message.map_err(|_| ServerError::Protocol("the input ended before `initialize`".to_owned()))?;
        pending.take(&message);
        let answer = match message {
            Message::Request(Request { id, method, params }) if method == "initialize" && params.is_object() => {
                let client = Client::of(&params);
                let _ = connection.sender.send(Response::new_ok(id, welcome(&client)).into());
                return Ok(Some(client));
            }
            Message::Request(Request { id, method, .. }) if method == "initialize" => {
                let reason = "expected an object as the parameters of `initialize`";
                Response::new_err(id, ErrorCode::InvalidParams as i32, reason.to_owned())
            }
            Message::Request(Request { id, method, .. }) => {
                let reason = format!("expected `initialize`, found `{method}`");
                Response::new_err(id, ErrorCode::ServerNotInitialized as i32, reason)
            }
            Message::Notification(told) if told.method == "exit" => return Ok(None),
            Message::Notification(_) | Message::Response(_) => continue,
        };
        let _ = connection.sender.send(answer.into());
    }
}

fn welcome(client: &Client) -> InitializeResult {
    let name = ServerInfo { name: nbc_base::PROGRAM.to_owned(), version: Some(nbc_base::VERSION.to_owned()) };
    InitializeResult { capabilities: capabilities(client.encoding), server_info: Some(name) }
}

/// The URI of a file or folder.
pub fn file_uri(path: &str) -> String {
    uri::uri(&DiskWorld, path).0
}

#[cfg(test)]
mod tests {
    use lsp_server::Notification;
    use proptest::prelude::*;
    use proptest::sample::select;
    use serde_json::{Value, json};

    use super::*;

    const METHODS: [&str; 18] = [
        "initialize",
        "shutdown",
        "textDocument/didOpen",
        "textDocument/didChange",
        "textDocument/didClose",
        "textDocument/hover",
        "textDocument/definition",
        "textDocument/references",
        "textDocument/rename",
        "textDocument/completion",
        "textDocument/signatureHelp",
        "textDocument/selectionRange",
        "textDocument/semanticTokens/full",
        "textDocument/semanticTokens/range",
        "textDocument/rangeFormatting",
        "textDocument/codeAction",
        "textDocument/inlayHint",
        "nonsense",
    ];
    const TEXTS: [&str; 6] = [
        "circuit f(a) -> (q) { q = not a }\ntest f { a | q\n 0 | 1 }\n",
        "é circuit \u{1d11e}(",
        "use \"missing.v\"\n\"",
        "/* 4'b1",
        "",
        "swarm s { circuit: f",
    ];

    fn position() -> impl Strategy<Value = Value> {
        (0..4u32, select(vec![0, 1, 7, 19, u32::MAX])).prop_map(|(line, at)| json!({ "line": line, "character": at }))
    }

    fn parameters() -> impl Strategy<Value = Value> {
        let texts = || select(TEXTS.to_vec());
        let whole = (texts(), texts(), position(), position()).prop_map(|(text, new, start, end)| {
            let range = json!({ "start": start, "end": end });
            json!({
                "textDocument": { "uri": "untitled:a", "languageId": "nb", "version": 1, "text": text },
                "contentChanges": [{ "range": range, "text": new }],
                "position": start,
                "positions": [start, end],
                "range": range,
                "context": { "includeDeclaration": true, "diagnostics": [] },
                "options": { "tabSize": 4, "insertSpaces": true },
                "newName": "b",
                "capabilities": {},
            })
        });
        prop_oneof![8 => whole, 1 => select(vec![json!([]), json!(null), json!(3), json!({ "textDocument": 1 })])]
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(48))]
        #[test]
        fn any_messages_are_served_without_a_fault(
            sent in prop::collection::vec((any::<bool>(), select(METHODS.to_vec()), parameters()), 0..16),
        ) {
            let (server, client) = Connection::memory();
            let Connection { sender, receiver } = client;
            sender.send(Request::new(0_i32.into(), "initialize".to_owned(), json!({})).into()).unwrap();
            for (number, (is_request, method, parameters)) in (1_i32..).zip(sent) {
                let method = method.to_owned();
                let message = match is_request && !method.contains("/did") {
                    true => Message::from(Request { id: number.into(), method, params: parameters }),
                    false => Message::from(Notification { method, params: parameters }),
                };
                sender.send(message).unwrap();
            }
            drop(sender);
            prop_assert!(serve(server, DiskWorld).is_ok());
            for message in receiver {
                if let Message::Response(Response { response_result: Err(error), .. }) = message {
                    prop_assert!(error.code != ErrorCode::InternalError as i32, "{}", error.message);
                }
            }
        }
    }
}
