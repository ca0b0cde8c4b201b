//! The live page: a server that runs swarms, and a page in a browser that draws them (docs/play-protocol.md).

mod bodies;
mod class;
mod connections;
mod evolving;
mod export;
mod files;
mod frame;
mod history;
mod jobs;
mod language;
mod lessons;
mod live;
mod message;
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
mod teacher;
mod text_checker;
mod token;
#[cfg(test)]
mod typescript;
mod visit;
mod wording;

use std::io;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::time::Duration;

use nbc_base::diag::{Diagnostics, io_words};
use nbc_session::CompileOptions;
use nbc_session::store::{FolderWorld, PrivateFile};
use tokio::net::TcpListener;
use tokio::runtime::{Builder, Runtime};
use tokio::sync::Semaphore;

pub use export::{ExportedPage, export};
pub use lessons::LessonSource;
pub use token::is_token;
pub use wording::PlayError;

use class::Class;
use page::Page;
use served::Served;
use token::random_token;

/// The time between two checks of the request to stop.
const LOOK: Duration = Duration::from_millis(100);
/// The start and the end of the name of the file that a browser opens. With a file, the token is not in the arguments
/// of the browser, which other users can list.
const REDIRECT: (&str, &str) = ("open-", ".html");

/// The options of a server.
#[derive(Clone, Debug, Default)]
pub struct PlayOptions {
    /// The program to open first. The page can read and write only below the current folder, or the file's folder if
    /// that is elsewhere.
    pub file: Option<PathBuf>,
    /// How its circuits become swarms.
    pub making: CompileOptions,
    /// The address to listen at, such as `127.0.0.1`.
    pub host: String,
    /// The port; 0 is any free one.
    pub port: u16,
    /// A folder with a page of its own, instead of the built-in one.
    pub page: Option<PathBuf>,
    /// The secret part of the address ([`is_token`]), instead of a random one.
    pub token: Option<String>,
    /// The lessons of the page, one source after the other; those that come with the program if there is none.
    pub lessons: Vec<LessonSource>,
    /// Whether pages can join a class, which a page of its own shows.
    pub class: bool,
    /// The pages for which there is room, at most [`PlayOptions::MOST_PAGES`]; 16 if it is not said.
    pub pages: Option<usize>,
}

impl PlayOptions {
    /// The most pages for which there can be room.
    pub const MOST_PAGES: usize = served::MOST_PAGES;
}

/// A server that has its address, and serves nothing until [`PlayServer::serve`].
pub struct PlayServer {
    runtime: Runtime,
    listener: TcpListener,
    served: Arc<Served>,
}

impl PlayServer {
    /// Listens at the address.
    ///
    /// # Errors
    /// When the file or the page cannot be found, or the address cannot be listened at.
    pub fn bind(options: &PlayOptions) -> Result<Self, PlayError> {
        let runtime = Builder::new_current_thread().enable_all().build().map_err(system)?;
        let (folder, file) = place(options.file.as_deref())?;
        let token = options.token.clone().map_or_else(random_token, Ok)?;
        let root = nbc_lsp::file_uri(&folder.root().to_string_lossy());
        let page = Page::of(options.page.as_deref()).map_err(|error| {
            let folder = options.page.clone().unwrap_or_default();
            missing(&folder, &error)
        })?;
        let refused = |error: io::Error| PlayError::Address {
            host: options.host.clone(),
            port: options.port,
            reason: io_words(&error),
        };
        let bound = runtime.block_on(TcpListener::bind((options.host.as_str(), options.port)));
        let listener = bound.map_err(refused)?;
        let port = listener.local_addr().map_err(system)?.port();
        let (host, making) = (options.host.clone(), options.making.clone());
        let mut served = Served { page, making, host, port, ..Served::new(folder, root, file, token) };
        if !options.lessons.is_empty() {
            served.lessons.clone_from(&options.lessons);
        }
        if let Some(pages) = options.pages {
            let pages = pages.clamp(1, PlayOptions::MOST_PAGES);
            served.sockets = Arc::new(Semaphore::new(pages * served::SOCKETS_OF_PAGE));
        }
        if options.class {
            served.class = Some(Arc::new(Class::new(random_token()?)));
        }
        Ok(Self { runtime, listener, served: Arc::new(served) })
    }

    /// The address of the page, for a browser on this computer.
    pub fn address(&self) -> String {
        self.served.address()
    }

    /// The address for other computers, if they can reach the server.
    pub fn address_elsewhere(&self) -> Option<String> {
        self.served.address_elsewhere()
    }

    /// The address of the teacher's page, if there is a class.
    pub fn address_of_teacher(&self) -> Option<String> {
        self.served.address_of_teacher()
    }

    /// What is wrong with the lessons of an author. A page shows it, too.
    pub fn faults_of_lessons(&self) -> Diagnostics {
        lessons::load(&self.served.lessons, Some(&self.served.world)).found
    }

    /// Opens the page in a browser, through a file that must stay until the browser has read it; `None` if no browser
    /// could be opened.
    pub fn open_browser(&self) -> Option<PrivateFile> {
        let file = PrivateFile::create(REDIRECT.0, REDIRECT.1, &redirect(&self.address())).ok()?;
        open::that_detached(file.path()).ok().map(|()| file)
    }

    /// Serves until `is_stopped`.
    pub fn serve(self, is_stopped: impl Fn() -> bool) {
        let Self { runtime, listener, served } = self;
        let stopped = async {
            while !is_stopped() {
                tokio::time::sleep(LOOK).await;
            }
        };
        runtime.block_on(async {
            tokio::select! {
                never = connections::serve(listener, server::router(served), connections::PATIENCE) => match never {},
                () = stopped => {}
            }
        });
    }
}

/// Serves a page that sends these texts, each of which should be a request, and waits for each answer. The fuzzer calls
/// this, because it needs no socket.
pub fn serve_texts(folder: &Path, texts: &[&str]) {
    /// The time for a long request. What is left of it is stopped.
    const PATIENCE: Duration = Duration::from_millis(250);
    let world = FolderWorld::new(folder).expect("there is such a folder");
    let served = Arc::new(Served::new(world, String::new(), None, String::new()));
    let (inbox, outgoing) = outbox::outbox();
    let mut visit = visit::Visit::new(served, inbox);
    // Nobody reads the answers.
    drop(outgoing);
    texts.iter().for_each(|text| visit.receive_and_wait(text, PATIENCE));
}

/// What is wrong with the text of a lesson. The fuzzer calls this, because it needs no folder.
pub fn faults_of_lesson(text: &str) -> Diagnostics {
    lessons::faults_of(text)
}

fn system(error: io::Error) -> PlayError {
    PlayError::System { reason: io_words(&error) }
}

fn missing(path: &Path, error: &io::Error) -> PlayError {
    PlayError::File { path: path.display().to_string(), reason: io_words(error) }
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

/// The folder to serve, and the file in it.
fn place(file: Option<&Path>) -> Result<(FolderWorld, Option<String>), PlayError> {
    let open = |folder: &Path| FolderWorld::new(folder).map_err(|error| missing(folder, &error));
    let here = open(Path::new("."))?;
    let Some(file) = file else { return Ok((here, None)) };
    let whole = file.canonicalize().map_err(|error| missing(file, &error))?;
    let folder = match whole.parent() {
        Some(parent) if !whole.starts_with(here.root()) => open(parent)?,
        _ => here,
    };
    let path = whole.strip_prefix(folder.root()).ok().map(|path| path.to_string_lossy().into_owned());
    Ok((folder, path))
}
