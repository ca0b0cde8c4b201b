//! The page: what `web/` builds, in the program or in a folder.

use std::borrow::Cow;
use std::fs;
use std::io;
use std::path::Path;

/// The texts of the page.
pub(super) struct Page {
    pub(super) html: Cow<'static, str>,
    pub(super) script: Cow<'static, str>,
    pub(super) style: Cow<'static, str>,
}

impl Default for Page {
    /// The one in the program.
    fn default() -> Self {
        Self {
            html: include_str!("../../../web/dist/index.html").into(),
            script: include_str!("../../../web/dist/app.js").into(),
            style: include_str!("../../../web/dist/app.css").into(),
        }
    }
}

impl Page {
    /// The page in a folder, or else the one in the program.
    ///
    /// # Errors
    /// When a part of it cannot be read.
    pub(super) fn of(folder: Option<&Path>) -> io::Result<Self> {
        let Some(folder) = folder else { return Ok(Self::default()) };
        let read = |name: &str| fs::read_to_string(folder.join(name)).map(Cow::from);
        Ok(Self { html: read("index.html")?, script: read("app.js")?, style: read("app.css")? })
    }
}
