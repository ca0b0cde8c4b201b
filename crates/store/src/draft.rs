//! A file that is being written, and gets its name when it is complete.

use std::fs::{self, File};
use std::io;
use std::path::Path;

use tempfile::{Builder, NamedTempFile};

/// Where Linux has a name for each file that this process has opened.
#[cfg(target_os = "linux")]
const NAMES_OF_OPEN_FILES: &str = "/proc/self/fd";

/// If the system supports unnamed files it has no name until it is kept; elsewhere it is removed when dropped.
pub(super) enum DraftFile {
    Unnamed(File),
    Named(NamedTempFile),
}

impl DraftFile {
    pub(super) fn create(folder: &Path) -> io::Result<Self> {
        match unnamed(folder) {
            Some(file) => Ok(Self::Unnamed(file)),
            // The name of the new file, which the user did not write.
            None => names().tempfile_in(folder).map(Self::Named).map_err(|error| io::Error::from(error.kind())),
        }
    }

    pub(super) fn file(&mut self) -> &mut File {
        match self {
            Self::Unnamed(file) => file,
            Self::Named(file) => file.as_file_mut(),
        }
    }

    pub(super) fn persist(self, folder: &Path, target: &Path) -> io::Result<()> {
        match self {
            Self::Named(file) => file.persist(target).map(drop).map_err(|error| error.error),
            Self::Unnamed(file) => match link(&file, target) {
                // A link cannot replace a file, but a renamed file can.
                Err(error) if error.kind() == io::ErrorKind::AlreadyExists => {
                    let named = names().make_in(folder, |path| link(&file, path))?;
                    named.persist(target).map(drop).map_err(|error| error.error)
                }
                linked => linked,
            },
        }
    }
}

fn names() -> Builder<'static, 'static> {
    let mut builder = Builder::new();
    builder.prefix(".nbc-").suffix(".part");
    #[cfg(unix)]
    {
        use std::os::unix::fs::PermissionsExt;
        // Read and write for all, minus the umask, as for any other new file.
        builder.permissions(fs::Permissions::from_mode(0o666));
    }
    builder
}

/// A file without a name, if one can be made and be given a name later. That needs `/proc`, which some containers lack.
#[cfg(target_os = "linux")]
fn unnamed(folder: &Path) -> Option<File> {
    use rustix::fs::{Mode, OFlags};
    if !Path::new(NAMES_OF_OPEN_FILES).exists() {
        return None;
    }
    let flags = OFlags::TMPFILE | OFlags::RDWR | OFlags::CLOEXEC;
    rustix::fs::open(folder, flags, Mode::from_raw_mode(0o666)).ok().map(File::from)
}

#[cfg(target_os = "linux")]
fn link(file: &File, path: &Path) -> io::Result<()> {
    use std::os::fd::AsRawFd;

    use rustix::fs::{AtFlags, CWD};
    let own = format!("{NAMES_OF_OPEN_FILES}/{}", file.as_raw_fd());
    Ok(rustix::fs::linkat(CWD, own.as_str(), CWD, path, AtFlags::SYMLINK_FOLLOW)?)
}

#[cfg(not(target_os = "linux"))]
fn unnamed(_: &Path) -> Option<File> {
    None
}

#[cfg(not(target_os = "linux"))]
fn link(_: &File, _: &Path) -> io::Result<()> {
    Err(io::Error::from(io::ErrorKind::Unsupported))
}

pub(super) fn keep_owner_and_mode(file: &File, before: &fs::Metadata) -> io::Result<()> {
    #[cfg(unix)]
    {
        use std::os::unix::fs::{MetadataExt, fchown};
        let own = file.metadata()?;
        if (own.uid(), own.gid()) != (before.uid(), before.gid()) {
            let foreign = |_| io::Error::other("it belongs to another user or group");
            fchown(file, Some(before.uid()), Some(before.gid())).map_err(foreign)?;
        }
    }
    file.set_permissions(before.permissions())
}
