//! The web socket of a language server for the texts of the page.

use std::sync::Arc;
use std::thread;

use crossbeam_channel::{Receiver, bounded};
use lsp_server::{Connection, ErrorCode, Message};
use serde_json::{Value, json};
use tungstenite::Utf8Bytes;

use crate::connections::SharedStream;
use crate::post::post;
use crate::served::Served;
use crate::socket::{WAITING, pump};
use nbc_play::Line;

/// Messages that may wait in the server's form, which is much larger than their texts.
const READ: usize = 2;
const ANSWERS: usize = 16;

pub(super) fn serve(served: &Arc<Served>, wire: SharedStream, rest: Vec<u8>) {
    let (requests, waiting): (_, Receiver<Utf8Bytes>) = bounded(WAITING);
    let (post, outgoing, _) = post();
    let post = Arc::new(post);
    let (sender, receiver) = bounded(READ);
    let (answer, answers) = bounded(ANSWERS);
    let world = served.world.clone();
    // A page that breaks the protocol is left alone: it sees that nothing is answered.
    thread::spawn(move || _ = nbc_lsp::serve(Connection { sender: answer, receiver }, world));
    let told = post.clone();
    thread::spawn(move || answers.into_iter().for_each(|message| told.text(nbc_lsp::written(&message))));
    let folder = served.clone();
    thread::spawn(move || {
        for text in waiting {
            let sent = match read(&text, &folder) {
                Ok(message) => message.map_or(Ok(()), |message| sender.send(message)),
                Err(refusal) => {
                    post.text(refusal.to_string());
                    Ok(())
                }
            };
            if sent.is_err() {
                return;
            }
        }
    });
    pump(wire, rest, requests, outgoing, &served.waiting);
}

/// A message of the page; `None` if it is not for the server. Folders that it names are replaced by the served folder.
fn read(text: &str, served: &Served) -> Result<Option<Message>, Value> {
    let mut value = nbc_lsp::parse(text.as_bytes())?;
    if value["method"] == "initialize" {
        let id = value["id"].clone();
        let Some(params) = value["params"].as_object_mut() else {
            let reason = "the parameters of `initialize` must be an object";
            return Err(nbc_lsp::refusal(&id, ErrorCode::InvalidParams, reason));
        };
        params.insert("rootUri".to_owned(), json!(served.site.folder.uri()));
        params.insert("workspaceFolders".to_owned(), json!([{ "uri": served.site.folder.uri(), "name": "play" }]));
    }
    if value["method"] == "workspace/didChangeWorkspaceFolders" {
        return Ok(None);
    }
    nbc_lsp::message(value).map(Some)
}
