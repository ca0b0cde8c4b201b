//! What the pages of one place share: its files, its lessons and its class.

use std::sync::Arc;

use crate::class::Class;
use crate::shell::{PageFolder, Shell};
use nbc_session::CompileOptions;
use nbc_session::report::Scheme;

pub(super) const SCHEME: Scheme = Scheme::Safe;

pub const PUBLIC_PAGE: Option<&str> = option_env!("NBC_PUBLIC_PAGE");

pub struct PlaySite {
    pub folder: Arc<dyn PageFolder>,
    /// Relative to the folder.
    pub file: Option<String>,
    pub making: CompileOptions,
    pub live_pages: bool,
    pub public_page: Option<String>,
    pub class: Option<Arc<Class>>,
    pub shell: Arc<dyn Shell>,
}
