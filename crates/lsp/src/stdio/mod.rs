//! The language server on standard input and output, or on any other connection.

mod disk_shell;
mod pending;
mod results;
mod wire;

use std::path::Path;
use std::sync::Arc;
use std::thread;
use std::time::Instant;

use crossbeam_channel::{after, bounded, never, select};
use lsp_server::Connection;

use crate::message::message;
use crate::service::LanguageService;
use crate::uri;
use crate::{ServerEnd, wording};
use disk_shell::DiskShell;
use nbc_base::diag::Diagnostic;
use nbc_base::source::SourceWorld;
use nbc_session::store::{DiskWorld, FolderWorld};
use pending::Pending;

pub fn serve_standard() -> Result<ServerEnd, Diagnostic> {
    let (connection, wire) = wire::open();
    // After an error the threads still wait for the client.
    let end = serve(connection, DiskWorld)?;
    wire.join().map_err(|reason| wording::protocol(&reason))?;
    Ok(end)
}

const WAITING: usize = 32;

/// Adds a queue in which the server looks ahead: if another change of a text is waiting, the older text is not checked.
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

pub fn serve(
    connection: Connection,
    world: impl SourceWorld + Clone + Send + Sync + 'static,
) -> Result<ServerEnd, Diagnostic> {
    let (connection, pending) = queued(connection);
    let (wake, woken) = bounded(1);
    let shell = Arc::new(DiskShell::new(world, pending.clone(), wake));
    let begun = Instant::now();
    let mut service = LanguageService::new(shell.clone());
    let end = loop {
        let due = service.due(begun.elapsed()).map_or_else(never, after);
        select! {
            recv(connection.receiver) -> message => match message {
                Ok(message) => {
                    pending.take(&message);
                    let end = service.receive(message, begun.elapsed());
                    send(&connection, &mut service);
                    if let Some(end) = end {
                        break Ok(end);
                    }
                }
                Err(_) if service.is_greeted() => break Ok(ServerEnd::Orderly),
                Err(_) => break Err(wording::protocol("the input ended before `initialize`")),
            },
            recv(woken) -> _ => {}
            recv(due) -> _ => {}
        }
        // What changes again at once need not be checked.
        if connection.receiver.is_empty() {
            service.advance(begun.elapsed());
            send(&connection, &mut service);
        }
    };
    shell.remove_results();
    end
}

/// If the connection is closed, the loop ends at its next message.
fn send(connection: &Connection, service: &mut LanguageService) {
    while let Some(message) = service.next_message() {
        let _ = connection.sender.send(message);
    }
}

/// For the fuzzer, without a pipe: a client sends these texts and then closes its connection.
pub fn serve_texts(folder: &Path, texts: &[&[u8]]) {
    let world = FolderWorld::new(folder).expect("there is such a folder");
    let (server, client) = Connection::memory();
    for message in texts.iter().filter_map(|text| message(serde_json::from_slice(text).ok()?).ok()) {
        client.sender.send(message).expect("the server has not begun");
    }
    drop(client);
    // A client may break the protocol.
    let _ = serve(server, world);
}

pub fn file_uri(path: &str) -> String {
    uri::uri(&DiskWorld, path).0
}

#[cfg(test)]
mod tests {
    use lsp_server::{ErrorCode, Message, Notification, Request, Response};
    use proptest::prelude::*;
    use proptest::sample::select;
    use serde_json::{Value, json};

    use super::*;

    const METHODS: &str = "initialize shutdown textDocument/didOpen textDocument/didChange textDocument/didClose \
        textDocument/hover textDocument/definition textDocument/references textDocument/rename textDocument/completion \
        textDocument/signatureHelp textDocument/selectionRange textDocument/semanticTokens/full \
        textDocument/semanticTokens/range textDocument/rangeFormatting textDocument/codeAction textDocument/inlayHint \
        nonsense";
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
            sent in prop::collection::vec(
                (any::<bool>(), select(METHODS.split(' ').collect::<Vec<_>>()), parameters()),
                0..16,
            ),
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
