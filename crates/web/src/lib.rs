//! The whole of nbc in a browser tab. A [`Tab`] has a visit of the live page and a language service, and does all their
//! work in the thread of its caller. `exports` are the functions that a script calls (`web/src/tab/worker.ts`).

mod exports;
mod language;
mod parts;
mod tab;

pub use tab::{Tab, TabMessage};
