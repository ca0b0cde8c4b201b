//! `nbc lsp`: the language in editors, by the Language Server Protocol on standard input and output.

use clap::Args;
use nbc_lsp::ServerEnd;

use crate::cli::{Context, Failure, Status};

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
    pub fn run(self, _context: &mut Context) -> Result<Status, Failure> {
        Ok(match nbc_lsp::serve_standard()? {
            ServerEnd::Orderly => Status::Done,
            ServerEnd::Abandoned => Status::Abandoned,
        })
    }
}
