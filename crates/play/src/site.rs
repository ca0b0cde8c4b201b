//! What the pages of one place share: its files, its lessons and its class.

use std::sync::Arc;

use crate::class::Class;
use crate::shell::{PageFolder, Shell};
use nbc_session::CompileOptions;
use nbc_session::report::Scheme;

pub(super) const SCHEME: Scheme = Scheme::Safe;

/// The address of a public page without a server, if the program was built with that variable.
pub const PUBLIC_PAGE: Option<&str> = option_env!("NBC_PUBLIC_PAGE");

pub struct PlaySite {
    pub folder: Arc<dyn PageFolder>,
    /// Relative to the folder.
    pub file: Option<String>,
    pub making: CompileOptions,
    /// Whether live pages can be made: [`Shell::template`] has what they are made of when a page asks for one.
    pub live_pages: bool,
    /// The address of a public page, for links ([`PUBLIC_PAGE`]).
    pub public_page: Option<String>,
    pub class: Option<Arc<Class>>,
    pub shell: Arc<dyn Shell>,
}
