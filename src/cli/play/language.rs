//! The socket of the language server: the one that editors start, for the texts of the page.

use std::sync::Arc;
use std::thread;
use std::time::Instant;

use axum::extract::ws::{Message as Frame, WebSocket};
use lsp_server::{Connection, Message};
use serde_json::{Value, json};
use tokio::sync::mpsc;

use crate::cli::lsp;
use crate::cli::play::served::Served;
use crate::cli::play::socket::{Allowance, receive, send};

/// Messages that may wait for the page.
const WAITING: usize = 256;

/// Serves one page until it is gone.
pub(super) async fn serve(served: Arc<Served>, mut socket: WebSocket) {
    let (server, page) = Connection::memory();
    let world = served.world.clone();
    // A page that breaks the protocol is left alone: it sees that nothing is answered.
    thread::spawn(move || _ = lsp::serve(server, world));
    let (outbox, mut outgoing) = mpsc::channel(WAITING);
    let answers = page.receiver;
    thread::spawn(move || answers.into_iter().try_for_each(|message| outbox.blocking_send(written(&message))));
    let mut allowance = Allowance::new(Instant::now());
    loop {
        tokio::select! {
            text = receive(&mut socket, &mut allowance) => {
                let Some(text) = text else { return };
                let Some(message) = read(&text, &served) else { continue };
                if page.sender.send(message).is_err() { return }
            }
            text = outgoing.recv() => {
                let Some(text) = text else { return };
                if !send(&mut socket, Frame::Text(text.into())).await { return }
            }
        }
    }
}

/// A message of the page. Whatever folders it names, it works in the served one.
fn read(text: &str, served: &Served) -> Option<Message> {
    let mut value: Value = serde_json::from_str(text).ok()?;
    // The language server answers other parameters with an error.
    if value["method"] == "initialize"
        && let Some(params) = value["params"].as_object_mut()
    {
        params.insert("rootUri".to_owned(), json!(served.root));
        // The user has opened this folder with `nbc play`.
        params.insert("initializationOptions".to_owned(), trusting(params.get("initializationOptions")));
        params.insert("workspaceFolders".to_owned(), json!([{ "uri": served.root, "name": "play" }]));
    }
    if value["method"] == "workspace/didChangeWorkspaceFolders" {
        return None;
    }
    serde_json::from_value(value).ok()
}

/// The options of a page, with trust in the Verilog of the folder.
fn trusting(options: Option<&Value>) -> Value {
    let mut options = options.filter(|options| options.is_object()).cloned().unwrap_or_else(|| json!({}));
    options["verilog"] = json!({ "trusted": true });
    options
}

fn written(message: &Message) -> String {
    let mut value = serde_json::to_value(message).expect("messages are data");
    value["jsonrpc"] = json!("2.0");
    value.to_string()
}
