//! `nbc play`: serves a page that shows robots live in a browser.

use std::path::PathBuf;

use clap::Args;
use nbc_play::{PlayOptions, PlayServer, is_token};
use nbc_session::report::Schema;
use serde_json::json;

use crate::cli::{Context, Failure, Interrupt, OutputFormat, Status};

/// Show robots live in a browser
///
/// Serves a page in which programs are edited, their robots walk, and new robots are designed. It prints the page's
/// address and opens it. The page can read and write only below the current folder, or the file's folder if that is
/// elsewhere. Everyone who knows the address can use the page. Ctrl-C stops the server.
#[derive(Args)]
#[command(after_help = "Examples:
  nbc play
  nbc play circuits/latch.nb
  nbc play adder.nb --port 8000 --no-open")]
pub struct PlayArguments {
    /// The program to open first
    file: Option<PathBuf>,
    /// The port; 0 is any free one
    #[arg(long, default_value_t = 0)]
    port: u16,
    /// The address to listen at. The default accepts connections from this computer only
    #[arg(long, default_value = "127.0.0.1")]
    host: String,
    /// Do not open a browser
    #[arg(long)]
    no_open: bool,
    /// Serve the page from this folder instead of the built-in one, to work on it
    #[arg(long, value_name = "DIR")]
    page: Option<PathBuf>,
    /// The secret part of the address, at least 16 letters and digits, instead of a random one
    #[arg(long, value_name = "TEXT", value_parser = token)]
    token: Option<String>,
}

impl PlayArguments {
    /// Serves until a signal arrives.
    ///
    /// # Errors
    /// When the file cannot be found, or the address cannot be listened at.
    pub fn run(self, context: &mut Context) -> Result<Status, Failure> {
        let interrupt = Interrupt::watch()?;
        let Self { file, port, host, no_open, page, token } = self;
        let server = PlayServer::bind(&PlayOptions { file, host, port, page, token })?;
        tell(&server, context)?;
        let redirect = if no_open { None } else { server.open_browser() };
        if redirect.is_none() && !no_open {
            context.log("no browser could be opened; open the address yourself\n");
        }
        server.serve(|| interrupt.is_raised());
        drop(redirect);
        Ok(Status::Done)
    }
}

/// Prints the address, and the one for other computers.
fn tell(server: &PlayServer, context: &mut Context) -> Result<(), Failure> {
    let (address, elsewhere) = (server.address(), server.address_elsewhere());
    match context.format {
        OutputFormat::Text => {
            context.print(format_args!("{address}\n"))?;
            if let Some(elsewhere) = elsewhere {
                context.print(format_args!("{elsewhere} (for other computers)\n"))?;
            }
        }
        OutputFormat::Json => {
            context.print_json(Schema::Play, &json!({ "address": address, "elsewhere": elsewhere }))?;
        }
    }
    context.flush()
}

fn token(text: &str) -> Result<String, String> {
    if is_token(text) { Ok(text.to_owned()) } else { Err("expected at least 16 letters and digits".to_owned()) }
}
