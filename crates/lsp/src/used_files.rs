//! Which sources use which files, as their texts say without being checked.

use std::collections::{BTreeMap, BTreeSet};

use crate::buffers::Buffers;
use nbc_base::source::SourceWorld;
use nbc_circuit::rows::RowFormat;
use nbc_lang::check::{beside, is_usable};
use nbc_session::Session;

#[derive(Default)]
pub(super) struct UsedFiles {
    texts: BTreeMap<String, String>,
    users: BTreeMap<String, BTreeSet<String>>,
}

impl UsedFiles {
    pub(super) fn of(session: &Session, world: &dyn SourceWorld, buffers: &Buffers, mut waiting: Vec<String>) -> Self {
        let mut found = Self::default();
        while let Some(path) = waiting.pop() {
            let identity = world.identity(&path);
            if found.texts.contains_key(&identity) || !(buffers.has(&path) || path.ends_with(".nb")) {
                continue;
            }
            let text = session.text(&path).unwrap_or_default();
            // Any text in quotes may be a path, and any quote may be the first one: a file too many does no harm.
            let is_path = |used: &&str| is_usable(used) || RowFormat::of_path(used).is_some();
            for used in text.split('"').filter(is_path).map(|used| beside(&path, used)) {
                found.users.entry(world.identity(&used)).or_default().insert(identity.clone());
                waiting.push(used);
            }
            found.texts.insert(identity, text);
        }
        found
    }

    pub(super) fn has(&self, source: &str) -> bool {
        self.texts.contains_key(source)
    }

    pub(super) fn with(&self, name: &str) -> Vec<String> {
        let having = self.texts.iter().filter(|(_, text)| text.contains(name));
        having.map(|(identity, _)| identity.clone()).collect()
    }

    pub(super) fn users(&self, files: impl IntoIterator<Item = String>) -> BTreeSet<String> {
        let mut waiting: Vec<String> = files.into_iter().collect();
        let mut found = BTreeSet::new();
        while let Some(file) = waiting.pop() {
            if found.insert(file.clone()) {
                waiting.extend(self.users.get(&file).into_iter().flatten().cloned());
            }
        }
        found
    }
}

#[cfg(test)]
#[cfg(feature = "disk")]
mod tests {
    use std::fs;
    use std::sync::{Arc, Mutex};

    use lsp_server::{Connection, Message, Notification, Request};
    use nbc_base::source::FileError;
    use nbc_session::store::FolderWorld;
    use serde_json::{Value, json};

    use super::*;

    #[derive(Clone)]
    struct Watched(FolderWorld, Arc<Mutex<Vec<String>>>);

    impl SourceWorld for Watched {
        fn read(&self, path: &str) -> Result<String, FileError> {
            self.1.lock().unwrap().push(path.to_owned());
            self.0.read(path)
        }

        fn list(&self, folder: &str) -> Result<Vec<String>, FileError> {
            self.0.list(folder)
        }

        fn identity(&self, path: &str) -> String {
            self.0.identity(path)
        }
    }

    const PART: &str = "circuit part(a) -> (q) { q = not a }\n";

    #[test]
    fn only_the_sources_that_use_a_declaration_are_checked_for_it() {
        let folder = tempfile::tempdir().unwrap();
        let circuit = ".model gate\n.inputs a\n.outputs q\n.names a q\n0 1\n.end\n";
        for (name, text) in [
            ("part.nb", PART),
            ("middle.nb", "use \"part.nb\"\ncircuit middle(a) -> (q) { q = a }\n"),
            ("far.nb", "use \"middle.nb\"\nuse \"near.blif\"\ncircuit far(a) -> (q) { q = part(a) }\n"),
            ("other.nb", "use \"far.blif\"\ncircuit other(part) -> (q) { q = part }\n"),
            ("near.blif", circuit),
            ("far.blif", circuit),
        ] {
            fs::write(folder.path().join(name), text).unwrap();
        }
        let root = folder.path().canonicalize().unwrap();
        let uri = |name: &str| format!("file://{}/{name}", root.display());
        let read = Arc::new(Mutex::new(Vec::new()));
        let (server, Connection { sender, receiver }) = Connection::memory();
        let ask = |id: i32, method: &str, parameters: Value| {
            sender.send(Request::new(id.into(), method.to_owned(), parameters).into()).unwrap();
        };
        ask(1, "initialize", json!({ "capabilities": {}, "rootUri": format!("file://{}", root.display()) }));
        let document = json!({ "uri": uri("part.nb"), "languageId": "nb", "version": 1, "text": PART });
        let opened = Notification::new("textDocument/didOpen".to_owned(), json!({ "textDocument": document }));
        sender.send(opened.into()).unwrap();
        let (place, context) = (json!({ "line": 0, "character": 9 }), json!({ "includeDeclaration": true }));
        let asked = json!({ "textDocument": { "uri": uri("part.nb") }, "position": place, "context": context });
        ask(2, "textDocument/references", asked);
        drop(sender);
        crate::serve(server, Watched(FolderWorld::new(&root).unwrap(), read.clone())).unwrap();
        let answer = receiver.into_iter().find_map(|message| match message {
            Message::Response(response) if response.id == 2.into() => Some(response.response_result.unwrap()),
            _ => None,
        });
        let files: Vec<Value> = answer.unwrap().as_array().unwrap().iter().map(|use_| use_["uri"].clone()).collect();
        assert_eq!(files, [uri("far.nb"), uri("part.nb")]);
        let read = read.lock().unwrap();
        let has_read = |name: &str| read.iter().any(|path| path.ends_with(name));
        assert!(has_read("near.blif") && !has_read("far.blif"), "{read:?}");
    }
}
