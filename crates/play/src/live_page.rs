//! A circuit as one HTML file that has the whole program in it: the page of a browser tab, with the files of a source.

use std::collections::BTreeMap;
use std::sync::{Arc, Mutex};

use serde::Serialize;
use serde_json::to_string;

use crate::lock::lock;
use crate::recorded_page::ExportedPage;
use nbc_base::diag::Diagnostics;
use nbc_base::source::{
    CancelFlag, EntryKind, FileError, OverlayWorld, SharedWorld, SourceWorld, VerilogError, VerilogFiles,
    VerilogModules,
};
use nbc_session::{Checked, Choice, CompileOptions, Session};

/// The page without sources; empty if the program was built without it.
const TEMPLATE: &str = include_str!(concat!(env!("OUT_DIR"), "/live.html"));
const SOURCES: &str = "<script type=\"application/json\" id=\"sources\">";
const TITLE: &str = "<title>nbc";

pub fn live_template() -> Option<&'static str> {
    Some(TEMPLATE).filter(|template| !template.is_empty())
}

#[derive(Serialize)]
struct LiveSources<'a> {
    first: &'a str,
    circuit: &'a str,
    swarm: Option<&'a str>,
    files: Vec<(&'a str, &'a str)>,
}

pub fn live_page(
    template: &str,
    world: SharedWorld,
    checked: &Checked,
    choice: &Choice,
    options: &CompileOptions,
) -> Result<(ExportedPage, Diagnostics), Diagnostics> {
    let mut over = OverlayWorld::new(world);
    for file in checked.sources.iter() {
        over.insert(&file.name, file.text.clone());
    }
    // The page needs every file that is read to compile the circuit.
    let noted = Arc::new(NotingWorld { over, read: Mutex::default() });
    let mut session = Session::new(noted.clone());
    let again = session.open(&checked.path)?;
    let compiled = again.compile(&again.circuit(choice)?, options)?;
    let read = lock(&noted.read);
    let folder = checked.path.rsplit_once('/').map_or("", |(folder, _)| folder);
    let circuit = &compiled.plan.circuit.circuit;
    let sources = LiveSources {
        first: within(folder, &checked.path),
        circuit,
        swarm: choice.swarm.as_deref(),
        files: read.iter().map(|(path, text)| (within(folder, path), text.as_str())).collect(),
    };
    // No text may end its element.
    let data = to_string(&sources).expect("texts can be written as JSON").replace('<', "\\u003c");
    let html = template.replacen(TITLE, &format!("<title>{circuit} – nbc"), 1);
    let html = html.replacen(SOURCES, &format!("{SOURCES}{data}"), 1);
    let page = ExportedPage { html, circuit: circuit.clone(), robots: compiled.assembly.members.len() };
    Ok((page, again.fail(compiled.warnings.clone())))
}

fn within<'a>(folder: &str, path: &'a str) -> &'a str {
    let inside = path.strip_prefix(folder).filter(|_| !folder.is_empty());
    inside.and_then(|rest| rest.strip_prefix('/')).unwrap_or(path)
}

struct NotingWorld {
    over: OverlayWorld<SharedWorld>,
    read: Mutex<BTreeMap<String, String>>,
}

impl NotingWorld {
    fn note(&self, path: &str, text: &str) {
        lock(&self.read).insert(path.to_owned(), text.to_owned());
    }
}

impl SourceWorld for NotingWorld {
    fn read(&self, path: &str) -> Result<String, FileError> {
        let text = self.over.read(path)?;
        self.note(path, &text);
        Ok(text)
    }

    fn read_bytes(&self, path: &str) -> Result<Vec<u8>, FileError> {
        let bytes = self.over.read_bytes(path)?;
        if let Ok(text) = str::from_utf8(&bytes) {
            self.note(path, text);
        }
        Ok(bytes)
    }

    fn read_verilog(&self, files: &VerilogFiles) -> Result<VerilogModules, VerilogError> {
        self.over.read_verilog(files)
    }

    fn cancel(&self) -> CancelFlag {
        self.over.cancel()
    }

    fn list(&self, folder: &str) -> Result<Vec<String>, FileError> {
        self.over.list(folder)
    }

    fn kind(&self, path: &str) -> Option<EntryKind> {
        self.over.kind(path)
    }

    fn identity(&self, path: &str) -> String {
        self.over.identity(path)
    }
}

#[cfg(test)]
mod tests {
    use nbc_base::source::MemoryWorld;

    use super::*;

    #[test]
    fn a_live_page_has_the_files_that_its_circuit_is_made_of_and_no_others() {
        let mut world = MemoryWorld::default();
        world.insert("a/half.nb", "circuit half(a, b) -> (s, c) {\n    s = a xor b // <script>\n    c = a and b\n}\n");
        world.insert("a/other.nb", "circuit other(a) -> (q) {\n    q = not a\n}\n");
        world.insert("a/main.nb", "use \"half.nb\"\ncircuit main(a, b) -> (s) {\n    (s, _) = half(a, b)\n}\n");
        let world: SharedWorld = Arc::new(world);
        let mut session = Session::new(world.clone());
        let checked = session.open("a/main.nb").unwrap();
        let template = format!("{TITLE}</title>{SOURCES}</script>");
        let choice = Choice { circuit: Some("main".to_owned()), swarm: None };
        let (page, warnings) = live_page(&template, world, &checked, &choice, &CompileOptions::default()).unwrap();
        assert!(warnings.list.is_empty());
        assert_eq!(page.circuit, "main");
        let (_, data) = page.html.split_once(SOURCES).unwrap();
        let data: serde_json::Value = serde_json::from_str(data.strip_suffix("</script>").unwrap()).unwrap();
        let names: Vec<&str> = data["files"].as_array().unwrap().iter().map(|file| file[0].as_str().unwrap()).collect();
        assert_eq!((data["first"].as_str(), names), (Some("main.nb"), vec!["half.nb", "main.nb"]));
        assert_eq!(page.html.matches('<').count(), 4, "what the files contain ends no element");
    }
}
