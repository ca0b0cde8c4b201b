//! The source files of the folders that are open in the editor.

use gen_lsp_types::Uri;
use serde_json::Value;

use crate::shell::LanguageShell;
use crate::uri;

#[derive(Clone, Debug, Default)]
pub(super) struct Workspace {
    folders: Vec<String>,
}

impl Workspace {
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

    /// Hidden folders, those of results and packages, links, and folders that the client does not see are left out.
    pub(super) fn files(&self, shell: &dyn LanguageShell) -> Vec<String> {
        shell.source_files(&self.folders.iter().map(String::as_str).collect::<Vec<_>>())
    }
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
