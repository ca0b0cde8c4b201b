//! What the pages of one place share: its files, its lessons and its class.

use std::sync::Arc;

use crate::class::Class;
use crate::shell::{PageFolder, Shell};
use nbc_session::CompileOptions;
use nbc_session::report::Scheme;

/// The colors of materials on the page, and of what is taken from it.
pub(super) const SCHEME: Scheme = Scheme::Safe;

/// The address of a page without a server that everybody can open, if the program was built with the variable of that
/// name.
pub const PUBLIC_PAGE: Option<&str> = option_env!("NBC_PUBLIC_PAGE");

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
    /// The address of a page that everybody can open, for links ([`PUBLIC_PAGE`]).
    pub public_page: Option<String>,
    /// The class that pages can join.
    pub class: Option<Arc<Class>>,
    /// What is around the pages.
    pub shell: Arc<dyn Shell>,
}
