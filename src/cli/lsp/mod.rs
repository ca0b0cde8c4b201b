//! `nbc lsp`: the language in editors, by the Language Server Protocol on standard input and output.
//!
//! A door over a `Session`: texts of the editor go in, and what the session knows of them comes out.

mod buffers;
mod completion;
mod files;
mod hover;
mod navigation;
mod outline;
mod position;
mod problems;
mod server;
mod uri;

use clap::Args;
use gen_lsp_types::{
    CodeActionKind, CodeActionOptions, CompletionOptions, InitializeResult, PositionEncodingKind, RenameOptions,
    ServerCapabilities, ServerInfo, TextDocumentSyncKind, TextDocumentSyncOptions,
};
use lsp_server::Connection;

use crate::cli::wording::ServerError;
use crate::cli::{Context, Failure, Status};
use position::Encoding;
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
        // After an error the threads still wait for the client.
        serve(&connection)?;
        // The writing thread ends with its channel.
        drop(connection);
        threads.join().map_err(|error| Failure::from(ServerError::Protocol(error.to_string())))?;
        Ok(Status::Done)
    }
}

fn serve(connection: &Connection) -> Result<(), Failure> {
    let broken = |error: &dyn std::fmt::Display| Failure::from(ServerError::Protocol(error.to_string()));
    let (id, parameters) = connection.initialize_start().map_err(|error| broken(&error))?;
    // Of what the client can do, only this matters; the rest may be missing or wrong.
    let known = parameters.pointer("/capabilities/general/positionEncodings").cloned().unwrap_or_default();
    let known: Vec<PositionEncodingKind> = serde_json::from_value(known).unwrap_or_default();
    let encoding = Encoding::negotiated(&known);
    let name = ServerInfo { name: "nbc".to_owned(), version: Some(env!("CARGO_PKG_VERSION").to_owned()) };
    let answer = InitializeResult { capabilities: capabilities(encoding), server_info: Some(name) };
    let answer = serde_json::to_value(answer).expect("capabilities are data");
    connection.initialize_finish(id, answer).map_err(|error| broken(&error))?;
    Server::new(connection, encoding).run().map_err(|error| broken(&error))
}

/// What the server can do.
fn capabilities(encoding: Encoding) -> ServerCapabilities {
    let sync = TextDocumentSyncOptions {
        open_close: Some(true),
        change: Some(TextDocumentSyncKind::Incremental),
        ..TextDocumentSyncOptions::default()
    };
    let quick_fixes = vec![CodeActionKind::QuickFix];
    ServerCapabilities {
        position_encoding: Some(encoding.kind()),
        text_document_sync: Some(sync.into()),
        hover_provider: Some(true.into()),
        definition_provider: Some(true.into()),
        references_provider: Some(true.into()),
        document_highlight_provider: Some(true.into()),
        document_symbol_provider: Some(true.into()),
        document_formatting_provider: Some(true.into()),
        folding_range_provider: Some(true.into()),
        code_action_provider: Some(
            CodeActionOptions { code_action_kinds: Some(quick_fixes), ..CodeActionOptions::default() }.into(),
        ),
        rename_provider: Some(RenameOptions { prepare_provider: Some(true), ..RenameOptions::default() }.into()),
        completion_provider: Some(CompletionOptions::default()),
        ..ServerCapabilities::default()
    }
}
