//! Standard input as a source file, which the command line calls `-`.

use nbc_base::source::SourceWorld;
use nbc_session::Session;
use nbc_session::store::DiskWorld;

pub(super) const DASH: &str = "-";
const NAME: &str = "<stdin>";
const PATH: &str = "/dev/stdin";

/// Adds standard input to a session as a file of the current folder, and returns its path there.
pub(super) fn open(session: &mut Session) -> &'static str {
    match DiskWorld.read(PATH) {
        Ok(text) => {
            session.update(NAME, 0, text);
            NAME
        }
        // Reading it once more gives the diagnostic.
        Err(_) => PATH,
    }
}
