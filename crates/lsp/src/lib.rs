//! The language in editors, by the Language Server Protocol.
//!
//! A [`LanguageService`] takes messages and the time, and gives messages: it passes the texts of the editor to a
//! `Session`, and answers requests with its results. It knows no threads, clocks and files: these are its shell's
//! ([`LanguageShell`]). With the feature `disk`, a server on standard input and output is one.

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
mod message;
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
mod service;
mod settings;
mod shell;
mod signature;
mod spot;
#[cfg(feature = "disk")]
mod stdio;
mod texts;
mod tokens;
mod uri;
mod used_files;
mod wording;
mod workspace;

pub use message::{message, parse, refusal, written};
pub use service::LanguageService;
pub use shell::{LanguageShell, LanguageWork, ServerEnd};
#[cfg(feature = "disk")]
pub use stdio::{file_uri, serve, serve_standard, serve_texts};
