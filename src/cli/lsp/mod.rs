//! `nbc lsp`: the language in editors, by the Language Server Protocol on standard input and output.
//!
//! A door over a `Session`: texts of the editor go in, and what the session knows of them comes out.

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
mod position;
mod problems;
mod rename;
mod requests;
mod runs;
mod selection;
mod semantics;
mod server;
mod settings;
mod signature;
mod spot;
mod texts;
mod tokens;
mod uri;
mod workspace;

use std::sync::Arc;
use std::thread;

use clap::Args;
use crossbeam_channel::bounded;
use gen_lsp_types::{InitializeResult, ServerInfo};
use lsp_server::Connection;

use crate::cli::wording::ServerError;
use crate::cli::{Context, Failure, Status};
use crate::source::SharedWorld;
use crate::store::DiskWorld;
use capabilities::{Client, capabilities};
use server::Server;

/// Serve editors by the Language Server Protocol
///
/// Speaks on standard input and output; editors start it themselves (docs/editors.md).
#[derive(Args)]
#[command(after_help = "Example:
  nvim --cmd \"autocmd FileType nb lua vim.lsp.start({ name = 'nbc', cmd = { 'nbc', 'lsp' } })\" latch.nb")]
pub struct LspArguments {
    /// Accepted because editors pass it; there is no other way
    #[arg(long)]
    stdio: bool,
}

impl LspArguments {
    /// Serves until the client says goodbye or vanishes.
    ///
    /// # Errors
    /// When the client does not speak the protocol.
    pub fn run(self, _context: &mut Context) -> Result<Status, Failure> {
        let (connection, threads) = Connection::stdio();
        let connection = queued(connection);
        // After an error the threads still wait for the client.
        serve(&connection, Arc::new(DiskWorld))?;
        // The writing thread ends with its channel.
        drop(connection);
        threads.join().map_err(|error| Failure::from(ServerError::Protocol(error.to_string())))?;
        Ok(Status::Done)
    }
}

/// The most messages that wait to be handled.
const WAITING: usize = 1024;

/// The same connection with a queue of messages. So the server knows whether a text has changed again, and checks only
/// what is newest.
fn queued(connection: Connection) -> Connection {
    let Connection { sender, receiver: arriving } = connection;
    let (queue, receiver) = bounded(WAITING);
    // It ends with the thread that reads, or with the server.
    thread::spawn(move || arriving.into_iter().try_for_each(|message| queue.send(message)));
    Connection { sender, receiver }
}

/// Serves a client until it says goodbye or vanishes.
///
/// # Errors
/// When it does not speak the protocol.
pub(in crate::cli) fn serve(connection: &Connection, world: SharedWorld) -> Result<(), Failure> {
    let broken = |error: &dyn std::fmt::Display| Failure::from(ServerError::Protocol(error.to_string()));
    let (id, parameters) = connection.initialize_start().map_err(|error| broken(&error))?;
    let client = Client::of(&parameters);
    let name = ServerInfo { name: "nbc".to_owned(), version: Some(env!("CARGO_PKG_VERSION").to_owned()) };
    let answer = InitializeResult { capabilities: capabilities(client.encoding), server_info: Some(name) };
    let answer = serde_json::to_value(answer).expect("capabilities are data");
    connection.initialize_finish(id, answer).map_err(|error| broken(&error))?;
    Server::new(connection, client, world).run().map_err(|error| broken(&error))
}

/// The URI of a file or folder.
#[cfg(feature = "play")]
pub(in crate::cli) fn file_uri(path: &str) -> String {
    uri::uri(path).0
}
