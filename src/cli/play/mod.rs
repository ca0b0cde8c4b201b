//! `nbc play`: the robots live, in a browser. The server runs the swarms; the page of `web/` draws them.

mod bodies;
mod connections;
mod evolving;
mod files;
mod frame;
mod history;
mod jobs;
mod language;
mod live;
mod outbox;
mod page;
mod programs;
mod refusal;
mod request;
mod runner;
mod served;
mod server;
mod socket;
mod takes;
mod taking;
mod visit;

use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::time::Duration;

use clap::Args;
use serde_json::json;
use tokio::net::TcpListener;
use tokio::runtime::Builder;

use crate::circuit::CancelFlag;
use crate::cli::lsp;
use crate::cli::wording::PlayError;
use crate::cli::{Context, Failure, Interrupt, OutputFormat, Status};
use crate::report::Schema;
use crate::store::{FolderWorld, PrivateFile};
use page::Page;
use served::Served;

/// The time between two looks for Ctrl-C.
const LOOK: Duration = Duration::from_millis(100);
/// The file that a browser is told to open. So the token is in no list of processes.
const REDIRECT: (&str, &str) = ("open-", ".html");
/// Bytes of a random token.
const TOKEN: usize = 16;

/// Show robots live in a browser
///
/// Serves a page in which programs are edited, their robots walk, and new robots are designed. It prints the page's
/// address and opens it. The page can read and write only below the current folder, or the file's folder if that is
/// elsewhere. Whoever knows the address can use it; Ctrl-C ends.
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
    /// The address to listen at. Others than the default let other computers in
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
        let runtime = Builder::new_current_thread().enable_all().build()?;
        let served = self.served()?;
        runtime.block_on(self.serve(served, &interrupt, context))
    }

    fn served(&self) -> Result<Served, Failure> {
        let (folder, file) = place(self.file.as_deref())?;
        let token = self.token.clone().map_or_else(random_token, Ok)?;
        let root = lsp::file_uri(&folder.root().to_string_lossy());
        let page = Page::of(self.page.as_deref())?;
        Ok(Served { page, ..Served::new(folder, root, file, token) })
    }

    async fn serve(self, served: Served, interrupt: &Interrupt, context: &mut Context) -> Result<Status, Failure> {
        let refused = |error: std::io::Error| PlayError::Address {
            host: self.host.clone(),
            port: self.port,
            reason: crate::diag::io_words(&error),
        };
        let listener = TcpListener::bind((self.host.as_str(), self.port)).await.map_err(refused)?;
        let port = listener.local_addr()?.port();
        let served = Arc::new(Served { host: self.host.clone(), port, ..served });
        self.tell(&served, context)?;
        let redirect = self.open(&served, context);
        let stopped = async {
            while !interrupt.is_raised() {
                tokio::time::sleep(LOOK).await;
            }
        };
        tokio::select! {
            never = connections::serve(listener, server::router(served)) => match never {},
            () = stopped => {}
        }
        drop(redirect);
        Ok(Status::Done)
    }

    /// Prints the address, and the one for other computers.
    fn tell(&self, served: &Served, context: &mut Context) -> Result<(), Failure> {
        let (address, elsewhere) = (served.address(), served.address_elsewhere());
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

    /// Opens the address in a browser, through a file that must stay until the browser has read it.
    fn open(&self, served: &Served, context: &Context) -> Option<PrivateFile> {
        if self.no_open {
            return None;
        }
        let file = PrivateFile::create(REDIRECT.0, REDIRECT.1, &redirect(&served.address()));
        match file {
            Ok(file) if open::that_detached(file.path()).is_ok() => Some(file),
            _ => {
                context.log("no browser could be opened; open the address yourself\n");
                None
            }
        }
    }
}

/// A page that leads to another one.
fn redirect(address: &str) -> String {
    format!(
        "<!doctype html>\n<html lang=\"en\">\n<meta charset=\"utf-8\">\n\
         <meta name=\"referrer\" content=\"no-referrer\">\n\
         <meta http-equiv=\"refresh\" content=\"0; url={address}\">\n<title>nbc</title>\n\
         <p><a href=\"{address}\">Open the page of nbc play</a></p>\n"
    )
}

/// Serves a page that sends these texts, each of which should be a request, and waits for each. For the fuzzer, which
/// needs no socket.
pub fn serve_texts(folder: &Path, texts: &[&str]) {
    /// The time for a long request. What is left of it is stopped.
    const PATIENCE: Duration = Duration::from_millis(250);
    let world = FolderWorld::new(folder).expect("there is such a folder");
    let served = Arc::new(Served::new(world, String::new(), None, String::new()));
    let (inbox, outgoing) = outbox::outbox();
    let mut visit = visit::Visit::new(served, inbox, CancelFlag::default());
    // Nobody reads the answers.
    drop(outgoing);
    texts.iter().for_each(|text| visit.receive_and_wait(text, PATIENCE));
}

/// The folder to serve, and the file in it.
fn place(file: Option<&Path>) -> Result<(FolderWorld, Option<String>), Failure> {
    let here = FolderWorld::new(Path::new("."))?;
    let Some(file) = file else { return Ok((here, None)) };
    let missing = |error: std::io::Error| PlayError::File {
        path: file.display().to_string(),
        reason: crate::diag::io_words(&error),
    };
    let whole = file.canonicalize().map_err(missing)?;
    let folder = match whole.parent() {
        Some(parent) if !whole.starts_with(here.root()) => FolderWorld::new(parent)?,
        _ => here,
    };
    let path = whole.strip_prefix(folder.root()).ok().map(|path| path.to_string_lossy().into_owned());
    Ok((folder, path))
}

fn random_token() -> Result<String, Failure> {
    let mut bytes = [0; TOKEN];
    getrandom::fill(&mut bytes).map_err(|error| std::io::Error::other(error.to_string()))?;
    Ok(bytes.iter().map(|byte| format!("{byte:02x}")).collect())
}

fn token(text: &str) -> Result<String, String> {
    let fits = text.len() >= 16 && text.bytes().all(|byte| byte.is_ascii_alphanumeric());
    if fits { Ok(text.to_owned()) } else { Err("expected at least 16 letters and digits".to_owned()) }
}
