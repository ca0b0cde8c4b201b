//! What the pages of one place share: its files, its lessons and its class.

use std::sync::Arc;

use crate::class::Class;
use crate::shell::{PageFolder, Shell};
use nbc_session::CompileOptions;
use nbc_session::report::Scheme;

/// The colors of materials on the page, and of what is taken from it.
pub(super) const SCHEME: Scheme = Scheme::Safe;

/// What the pages of one place share.
pub struct PlaySite {
    /// The files that pages may read and write.
    pub folder: Arc<dyn PageFolder>,
    /// The file that pages open first, relative to the folder.
    pub file: Option<String>,
    /// How pages make swarms.
    pub making: CompileOptions,
    /// Whether live pages can be made: [`Shell::template`] has what they are made of when a page asks for one.
    pub live_pages: bool,
    /// The class that pages can join.
    pub class: Option<Arc<Class>>,
    /// What is around the pages.
    pub shell: Arc<dyn Shell>,
}
