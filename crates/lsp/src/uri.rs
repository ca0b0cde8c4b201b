//! Files as URIs.

use std::path::PathBuf;

use gen_lsp_types::Uri;
use nbc_base::source::SourceWorld;
use percent_encoding::{AsciiSet, NON_ALPHANUMERIC, percent_decode_str, utf8_percent_encode};

/// All characters but those that are frequent in paths.
const ESCAPED: &AsciiSet = &NON_ALPHANUMERIC.remove(b'/').remove(b'-').remove(b'.').remove(b'_').remove(b'~');

pub(super) fn path(uri: &Uri) -> Option<String> {
    let path = uri.as_ref().strip_prefix("file://")?;
    let path = &path[path.find('/')?..];
    Some(percent_decode_str(path).decode_utf8().ok()?.into_owned())
}

pub(super) fn uri(world: &dyn SourceWorld, path: &str) -> Uri {
    let path = absolute(&world.identity(path));
    Uri(format!("file://{}", utf8_percent_encode(&path.to_string_lossy(), ESCAPED)))
}

fn absolute(path: &str) -> PathBuf {
    std::path::absolute(path).unwrap_or_else(|_| PathBuf::from(path))
}

#[cfg(test)]
mod tests {
    use super::*;
    use nbc_base::source::MemoryWorld;

    #[test]
    fn a_path_and_its_uri_are_the_same_file() {
        let place = "/tmp/a b/é%.nb";
        let world = MemoryWorld::default();
        assert_eq!(uri(&world, place).as_ref(), "file:///tmp/a%20b/%C3%A9%25.nb");
        assert_eq!(path(&uri(&world, place)).as_deref(), Some(place));
        assert_eq!(path(&Uri("file://localhost/a.nb".to_owned())).as_deref(), Some("/a.nb"));
        assert_eq!(path(&Uri("untitled:Untitled-1".to_owned())), None);
    }
}
