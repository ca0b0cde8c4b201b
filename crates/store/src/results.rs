//! Places for results. Links that are found there are not followed: a folder from elsewhere may have them, and what
//! they lead to is not ours.

use std::ffi::OsStr;
use std::fs;
use std::io;
use std::path::{Path, PathBuf};

use crate::atomic::replace;
use crate::write;

/// The folder of results: one that the user chose, which may be a link, and a path below it without links.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ResultPlace {
    chosen: PathBuf,
    below: PathBuf,
}

impl ResultPlace {
    /// The folder `name` in the one that the user chose, or else in `usual`, which nobody chose.
    pub fn new(chosen: Option<&Path>, usual: &Path, name: impl AsRef<Path>) -> Self {
        match chosen {
            Some(chosen) => Self { chosen: chosen.to_owned(), below: name.as_ref().to_owned() },
            None => Self { chosen: PathBuf::new(), below: usual.join(name) },
        }
    }

    pub fn path(&self) -> PathBuf {
        self.chosen.iter().chain(&self.below).collect()
    }

    pub fn create(&self) -> io::Result<PathBuf> {
        self.refuse_links()?;
        let path = self.path();
        fs::create_dir_all(&path)?;
        Ok(path)
    }

    /// Checks that files can be written there, and leaves the disk as it was.
    pub fn probe(&self) -> io::Result<()> {
        self.refuse_links()?;
        let path = self.path();
        let is_missing = |folder: &&Path| *folder != Path::new("") && !folder.exists();
        let missing: Vec<&Path> = path.ancestors().take_while(is_missing).collect();
        let made = fs::create_dir_all(&path).and_then(|()| tempfile::tempfile_in(&path));
        for folder in missing {
            // Another program may use it by now.
            let _ = fs::remove_dir(folder);
        }
        made.map(drop).map_err(|error| io::Error::from(error.kind()))
    }

    fn refuse_links(&self) -> io::Result<()> {
        let mut path = self.chosen.clone();
        for part in self.below.iter().filter(|part| *part != OsStr::new(".")) {
            path.push(part);
            if is_link(&path) {
                let words = format!("`{}` is a link, which results do not follow", path.display());
                return Err(io::Error::other(words));
            }
        }
        Ok(())
    }
}

pub(super) fn is_link(path: &Path) -> bool {
    fs::symlink_metadata(path).is_ok_and(|about| about.is_symlink())
}

/// Writes a file of results as [`write()`] does, but replaces a link instead of the file that it leads to.
pub fn write_result(path: &Path, bytes: &[u8]) -> io::Result<()> {
    if is_link(path) { replace(path, |out| out.write_all(bytes)) } else { write(path, bytes) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_probe_leaves_nothing_and_a_folder_that_is_there_stays() {
        let root = tempfile::tempdir().unwrap();
        let folder = ResultPlace::new(Some(root.path()), Path::new("out"), "a/b");
        folder.probe().unwrap();
        assert_eq!(fs::read_dir(root.path()).unwrap().count(), 0);
        assert_eq!(folder.create().unwrap(), root.path().join("a/b"));
        folder.probe().unwrap();
        assert!(root.path().join("a/b").is_dir());
        fs::write(root.path().join("file"), "").unwrap();
        assert!(ResultPlace::new(Some(&root.path().join("file")), Path::new(""), "a").probe().is_err());
    }

    #[test]
    #[cfg(unix)]
    fn links_are_followed_only_where_the_user_chose_them() {
        let root = tempfile::tempdir().unwrap();
        let [real, link] = ["real", "link"].map(|name| root.path().join(name));
        fs::create_dir(&real).unwrap();
        std::os::unix::fs::symlink(&real, &link).unwrap();
        ResultPlace::new(Some(&link), Path::new(""), "a").create().unwrap();
        assert!(real.join("a").is_dir());
        let below = ResultPlace::new(Some(root.path()), Path::new(""), "link/b");
        assert!(below.probe().unwrap_err().to_string().ends_with("/link` is a link, which results do not follow"));
        assert!(below.create().is_err() && !real.join("b").exists());
    }

    #[test]
    #[cfg(unix)]
    fn a_link_is_replaced_and_what_it_leads_to_stays() {
        let root = tempfile::tempdir().unwrap();
        let [file, link] = ["file", "link"].map(|name| root.path().join(name));
        for target in [&file, &root.path().join("missing")] {
            fs::write(&file, "mine").unwrap();
            let _ = fs::remove_file(&link);
            std::os::unix::fs::symlink(target, &link).unwrap();
            write_result(&link, b"result").unwrap();
            assert_eq!([&file, &link].map(|path| fs::read_to_string(path).unwrap()), ["mine", "result"]);
            assert!(!is_link(&link));
        }
        assert_eq!(fs::read_dir(root.path()).unwrap().count(), 2);
    }
}
