//! The server of the live page: sockets, threads, clocks and files around the visits of `nbc_play`.

mod connections;
mod disk_folder;
mod http;
mod language;
mod lesson_source;
mod live;
mod page;
mod post;
mod served;
mod server;
mod socket;
mod takes;
mod teacher;
mod threads;
mod token;
mod wording;

use std::net::{IpAddr, Ipv4Addr, Ipv6Addr, SocketAddr, TcpListener, TcpStream};
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::thread;
use std::time::{Duration, Instant};

use nbc_base::diag::{Diagnostic, Diagnostics, io_words};
use nbc_play::{Class, LocalLine, PlaySite, Visit};
use nbc_session::CompileOptions;
use nbc_session::store::{FolderWorld, PrivateFile};

pub use lesson_source::LessonSource;
pub use token::is_token;

use disk_folder::DiskFolder;
use page::Page;
use served::{Served, Taught};
use threads::Threads;
use token::random_token;
use wording::missing;

const LOOK: Duration = Duration::from_millis(100);
/// The name of the file that a browser opens: other users can list a browser's arguments, so the token is not there.
const REDIRECT: (&str, &str) = ("open-", ".html");

#[derive(Clone, Debug, Default)]
pub struct PlayOptions {
    /// The page can read and write only below the current folder, or this file's folder if that is elsewhere.
    pub file: Option<PathBuf>,
    pub making: CompileOptions,
    pub host: String,
    /// 0 is any free one.
    pub port: u16,
    /// A folder with a page of its own, instead of the built-in one.
    pub page: Option<PathBuf>,
    /// The secret part of the address ([`is_token`]), instead of a random one.
    pub token: Option<String>,
    /// One source after the other; the lessons of the program if there is none.
    pub lessons: Vec<LessonSource>,
    pub class: bool,
    pub public_page: Option<String>,
    /// At most [`PlayOptions::MOST_PAGES`]; 16 by default.
    pub pages: Option<usize>,
}

impl PlayOptions {
    pub const MOST_PAGES: usize = served::MOST_PAGES;
}

/// A server that has its address, and serves nothing until [`PlayServer::serve`].
pub struct PlayServer {
    listener: TcpListener,
    served: Arc<Served>,
}

impl PlayServer {
    pub fn bind(options: &PlayOptions) -> Result<Self, Diagnostic> {
        let (folder, file) = place(options.file.as_deref())?;
        let token = options.token.clone().map_or_else(random_token, Ok)?;
        let folder_of_page = options.page.as_deref();
        let page =
            Page::of(folder_of_page).map_err(|error| missing(folder_of_page.unwrap_or(Path::new("")), &error))?;
        let (host, port) = (options.host.clone(), options.port);
        let bound = TcpListener::bind((host.as_str(), port));
        let listener = bound.map_err(|error| wording::cannot_listen(&host, port, &error))?;
        let port = listener.local_addr().map_err(|error| wording::system(&io_words(&error)))?.port();
        let threads = Arc::new(Threads::new(&options.lessons));
        let mut site = PlaySite {
            folder: Arc::new(DiskFolder::new(folder.clone())),
            file,
            making: options.making.clone(),
            live_pages: nbc_play::live_template().is_some(),
            public_page: options.public_page.clone(),
            class: None,
            shell: threads.clone(),
        };
        let mut taught = None;
        if options.class {
            let class = Arc::new(Class::new(|| random_token().ok()));
            site.class = Some(class.clone());
            taught = Some(Taught { class, token: random_token()? });
        }
        let pages = options.pages.unwrap_or(served::PAGES).clamp(1, PlayOptions::MOST_PAGES);
        let most_sockets = pages * served::SOCKETS_OF_PAGE;
        let served = Served { page, host, port, taught, most_sockets, ..Served::new(folder, site, threads, token) };
        Ok(Self { listener, served: Arc::new(served) })
    }

    pub fn address(&self) -> String {
        self.served.address()
    }

    pub fn address_elsewhere(&self) -> Option<String> {
        self.served.address_elsewhere()
    }

    pub fn address_of_teacher(&self) -> Option<String> {
        self.served.address_of_teacher()
    }

    pub fn faults_of_lessons(&self) -> Diagnostics {
        let site = &self.served.site;
        nbc_play::faults_of_lessons(site.shell.lessons(), &site.folder.world())
    }

    /// Opens the page in a browser, through a file that must stay until the browser has read it.
    pub fn open_browser(&self) -> Option<PrivateFile> {
        let file = PrivateFile::create(REDIRECT.0, REDIRECT.1, &redirect(&self.address())).ok()?;
        open::that_detached(file.path()).ok().map(|()| file)
    }

    pub fn serve(self, is_stopped: impl Fn() -> bool) {
        let Self { listener, served } = self;
        let stop = AtomicBool::new(false);
        thread::scope(|scope| {
            scope.spawn(|| connections::serve(&listener, &stop, move |wire| server::answer(&served, wire)));
            while !is_stopped() {
                thread::sleep(LOOK);
            }
            stop.store(true, Ordering::Relaxed);
            // `accept` returns only for a connection.
            let _ = listener.local_addr().and_then(|address| TcpStream::connect(reachable(address)));
        });
    }
}

fn reachable(address: SocketAddr) -> SocketAddr {
    let ip = match address.ip() {
        IpAddr::V4(ip) if ip.is_unspecified() => Ipv4Addr::LOCALHOST.into(),
        IpAddr::V6(ip) if ip.is_unspecified() => Ipv6Addr::LOCALHOST.into(),
        ip => ip,
    };
    SocketAddr::new(ip, address.port())
}

/// Serves a page that sends these requests and waits for each answer; for the fuzzer, without a socket.
pub fn serve_texts(folder: &Path, texts: &[&str]) {
    const PATIENCE: Duration = Duration::from_millis(250);
    let world = FolderWorld::new(folder).expect("there is such a folder");
    let site = PlaySite {
        folder: Arc::new(DiskFolder::new(world)),
        file: None,
        making: CompileOptions::default(),
        live_pages: false,
        public_page: None,
        class: None,
        shell: Arc::new(Threads::new(&[])),
    };
    let begun = Instant::now();
    // Nobody reads the answers.
    let mut visit = Visit::new(Arc::new(site), Arc::new(LocalLine::default()), begun.elapsed());
    for text in texts {
        let end = begun.elapsed() + PATIENCE;
        visit.receive(text, begun.elapsed());
        while !visit.is_idle() && begun.elapsed() < end {
            thread::sleep(Duration::from_millis(1));
        }
        visit.advance(begun.elapsed());
    }
}

fn redirect(address: &str) -> String {
    format!(
        "<!doctype html>\n<html lang=\"en\">\n<meta charset=\"utf-8\">\n\
         <meta name=\"referrer\" content=\"no-referrer\">\n\
         <meta http-equiv=\"refresh\" content=\"0; url={address}\">\n<title>nbc</title>\n\
         <p><a href=\"{address}\">Open the page of nbc play</a></p>\n"
    )
}

fn place(file: Option<&Path>) -> Result<(FolderWorld, Option<String>), Diagnostic> {
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
