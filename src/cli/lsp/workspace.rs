//! The source files of the folders that are open in the editor.

use std::fs;
use std::path::{Path, PathBuf};

use gen_lsp_types::Uri;
use serde_json::Value;

use crate::cli::lsp::uri;

/// The most files and folders that are looked at.
const MOST: usize = 10_000;

/// The folders that are open.
#[derive(Clone, Debug, Default)]
pub(super) struct Workspace {
    folders: Vec<String>,
}

impl Workspace {
    /// The folders that the parameters of the initialization name.
    pub(super) fn of(parameters: &Value) -> Self {
        let path = |uri: &Value| uri::path(&Uri(uri.as_str()?.to_owned()));
        let folders = parameters.get("workspaceFolders").and_then(Value::as_array);
        let mut folders: Vec<String> =
            folders.into_iter().flatten().filter_map(|folder| path(folder.get("uri")?)).collect();
        if folders.is_empty() {
            folders.extend(parameters.get("rootUri").and_then(path));
        }
        Self { folders }
    }

    pub(super) fn add(&mut self, folder: &Uri) {
        self.folders.extend(uri::path(folder));
    }

    pub(super) fn remove(&mut self, folder: &Uri) {
        let path = uri::path(folder);
        self.folders.retain(|known| Some(known) != path.as_ref());
    }

    /// The paths of its source files, in order. Hidden folders and those of results and packages are left out.
    pub(super) fn files(&self) -> Vec<String> {
        let mut found = Vec::new();
        let mut open: Vec<PathBuf> = self.folders.iter().map(PathBuf::from).collect();
        let mut seen = 0;
        while let Some(folder) = open.pop() {
            for entry in fs::read_dir(&folder).into_iter().flatten().flatten() {
                seen += 1;
                let (path, kind) = (entry.path(), entry.file_type());
                match kind {
                    _ if seen > MOST => break,
                    Ok(kind) if kind.is_dir() && !is_left_out(&path) => open.push(path),
                    Ok(kind) if kind.is_file() && path.extension().is_some_and(|extension| extension == "nb") => {
                        found.push(path.to_string_lossy().into_owned());
                    }
                    _ => {}
                }
            }
        }
        found.sort();
        found.dedup();
        found
    }
}

fn is_left_out(folder: &Path) -> bool {
    let name = folder.file_name().unwrap_or_default().to_string_lossy();
    name.starts_with('.') || ["node_modules", "out", "target"].contains(&name.as_ref())
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::json;

    #[test]
    fn the_folders_of_a_client_are_read() {
        let folders = |parameters: Value| Workspace::of(&parameters).folders;
        assert_eq!(folders(json!({ "rootUri": "file:///a" })), ["/a"]);
        let both = json!({ "rootUri": "file:///a", "workspaceFolders": [{ "uri": "file:///b", "name": "b" }] });
        assert_eq!(folders(both), ["/b"]);
        assert_eq!(folders(json!({ "rootUri": null, "workspaceFolders": null })), [""; 0]);
    }
}
