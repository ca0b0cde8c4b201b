//! `nbc play`: serves a page that shows robots live in a browser.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use clap::Args;
use clap::builder::RangedU64ValueParser;
use nbc_play::{PUBLIC_PAGE, live_page, live_template, recorded_page, recorded_runs};
use nbc_play_server::{LessonSource, PlayOptions, PlayServer, is_token};
use nbc_session::report::Schema;
use nbc_session::store::{self, DiskWorld};
use nbc_session::{Choice, CompileOptions, Session};
use nbc_swarm::Room;
use serde::Serialize;

use crate::cli::options::making::MakingArguments;
use crate::cli::options::new_path::new_path;
use crate::cli::runs::run_list;
use crate::cli::source_path::source_path;
use crate::cli::wording;
use crate::cli::{Context, Failure, Interrupt, OutputFormat, Status};
use nbc_base::diag::counted;

/// The lessons that come with the program.
const SHIPPED: &str = "shipped";
const MOST_PAGES: u64 = PlayOptions::MOST_PAGES as u64;

/// Show robots live in a browser
///
/// Serves a page in which programs are edited, their robots walk, and new robots are designed. It prints the page's
/// address and opens it. The page can read and write only below the current folder, or the file's folder if that is
/// elsewhere. Everyone who knows the address can use the page. Ctrl-C stops the server.
///
/// With `--export`, it starts no server. It writes one HTML file that a browser opens without nbc and without a
/// network: the recorded tests and simulations, as `nbc run` does, or with `--live` the whole page with its physics,
/// tests and editor.
#[derive(Args)]
#[command(after_help = "Examples:
  nbc play
  nbc play circuits/latch.nb
  nbc play adder.nb --port 8000 --no-open
  nbc play circuits/latch.nb --export latch.html
  nbc play circuits/latch.nb --export latch.html --live
  nbc play --class --host 0.0.0.0 --pages 30")]
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
    /// Write this HTML file, which needs no server, and start none: the tests and simulations, recorded
    #[arg(long, value_name = "OUT", requires = "file", value_parser = new_path())]
    #[arg(conflicts_with_all = [
        "port", "host", "no_open", "page", "token", "lessons", "class", "public_page", "pages",
    ])]
    export: Option<PathBuf>,
    /// Write a page that simulates and can be edited, instead of a recording
    #[arg(long, requires = "export", conflicts_with_all = ["library", "effort", "objective", "runs"])]
    live: bool,
    #[command(flatten)]
    making: MakingArguments,
    /// Show the lessons of this folder instead of those that come with the program, which are `shipped`. May be
    /// repeated: `--lessons shipped --lessons DIR` shows both
    #[arg(long, value_name = "DIR")]
    lessons: Vec<PathBuf>,
    /// Let learners join a class with a name, and print the address of a page that shows who is at which lesson
    #[arg(long)]
    class: bool,
    /// The address of a page made by `.ci/site` that everybody can open. The page offers links to it
    #[arg(long, value_name = "URL", value_parser = web_address)]
    public_page: Option<String>,
    /// The pages that may be open at once, at most 64
    #[arg(long, default_value_t = 16, value_parser = RangedU64ValueParser::<usize>::new().range(1..=MOST_PAGES))]
    pages: usize,
}

#[derive(Serialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
pub(super) struct WrittenPage {
    file: String,
    /// That of the last swarm, with the numbers of its parameters.
    circuit: String,
    /// Those of the last swarm.
    robots: usize,
    /// The size of the file.
    bytes: usize,
}

#[derive(Serialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
pub(super) struct ServedPage {
    address: String,
    /// The address for other computers, if the server listens for them.
    elsewhere: Option<String>,
    /// The address of the teacher's page, if there is a class.
    teacher: Option<String>,
}

impl PlayArguments {
    pub fn run(self, context: &mut Context) -> Result<Status, Failure> {
        let Self { file, port, host, no_open, page, token, export, live, making, lessons, class, public_page, pages } =
            self;
        if let (Some(output), Some(file)) = (export, &file) {
            return write_page(file, &output, &making, live, context);
        }
        if making.choice() != Choice::default() {
            return Err(wording::only_exported().into());
        }
        let making = making.options()?;
        file.as_deref().map(source_path).transpose()?;
        let interrupt = Interrupt::watch()?;
        let lessons = lessons.into_iter().map(source).collect();
        let (pages, public_page) = (Some(pages), public_page.or_else(|| PUBLIC_PAGE.map(str::to_owned)));
        let options = PlayOptions { file, making, host, port, page, token, lessons, class, public_page, pages };
        let server = PlayServer::bind(&options)?;
        let faults = server.faults_of_lessons();
        context.tell(&faults.list, &faults.sources);
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

fn write_page(
    file: &Path,
    output: &Path,
    making: &MakingArguments,
    live: bool,
    context: &mut Context,
) -> Result<Status, Failure> {
    let template = if live { Some(live_template().ok_or_else(wording::no_live_pages)?) } else { None };
    let mut session = Session::new(DiskWorld).with_poses(Room::SWARM);
    let checked = session.open(source_path(file)?)?;
    let (choice, options) = (making.choice(), making.options()?);
    let page = if let Some(template) = template {
        let (page, warnings) = live_page(template, Arc::new(DiskWorld), &checked, &choice, &options)?;
        context.tell(&warnings.list, &warnings.sources);
        page
    } else {
        let (list, interrupt) = (recorded_runs(&checked, &choice)?, Interrupt::watch()?);
        let options = CompileOptions { cancel: interrupt.cancel(), ..options };
        let report = run_list(&session, &checked, &list, options, &interrupt)?;
        if interrupt.is_raised() {
            return Ok(Status::Interrupted);
        }
        let of_tests = report.tests.iter().flat_map(|run| &run.warnings);
        let warnings = of_tests.chain(report.simulations.iter().flat_map(|run| &run.warnings));
        context.warn(&checked, checked.diagnostics.iter().chain(warnings));
        recorded_page(&file.to_string_lossy(), &report)
    };
    store::write(output, page.html.as_bytes()).map_err(|error| Failure::unwritable(output, &error))?;
    let (bytes, file) = (page.html.len(), output.display().to_string());
    let written = WrittenPage { file, circuit: page.circuit, robots: page.robots, bytes };
    context.print_result(Schema::Player, &written, || {
        let WrittenPage { file, circuit, robots, .. } = &written;
        let robots = counted(*robots, "robot");
        format!("wrote {file}: {circuit} with {robots}, {} kB; a browser opens it\n", bytes.div_ceil(1000))
    })?;
    Ok(Status::Done)
}

/// Prints the addresses for this computer, other computers and the teacher.
fn tell(server: &PlayServer, context: &mut Context) -> Result<(), Failure> {
    let (address, elsewhere, teacher) = (server.address(), server.address_elsewhere(), server.address_of_teacher());
    match context.format {
        OutputFormat::Text => {
            context.print(format_args!("{address}\n"))?;
            if let Some(elsewhere) = elsewhere {
                context.print(format_args!("{elsewhere} (for other computers)\n"))?;
            }
            if let Some(teacher) = teacher {
                context.print(format_args!("{teacher} (for the teacher)\n"))?;
            }
        }
        OutputFormat::Json => {
            context.print_json(Schema::Play, &ServedPage { address, elsewhere, teacher })?;
        }
    }
    context.flush()
}

fn source(folder: PathBuf) -> LessonSource {
    if folder == Path::new(SHIPPED) { LessonSource::Shipped } else { LessonSource::Folder(folder) }
}

fn token(text: &str) -> Result<String, String> {
    if is_token(text) { Ok(text.to_owned()) } else { Err("expected at least 16 letters and digits".to_owned()) }
}

fn web_address(text: &str) -> Result<String, String> {
    let is_plain = !text.contains(|letter: char| letter == '#' || letter.is_whitespace() || letter.is_control());
    let rest = text.strip_prefix("https://").or_else(|| text.strip_prefix("http://"));
    match rest {
        Some(rest) if is_plain && !rest.is_empty() => Ok(text.to_owned()),
        _ => Err("expected an address that begins with `https://`, without `#`".to_owned()),
    }
}
