//! A new name for a declaration, in all files that use it, and the proof that nothing else changes its meaning.

use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;

use gen_lsp_types::{TextEdit, Uri, WorkspaceEdit};

use crate::buffers::{self, Buffers};
use crate::files::Files;
use crate::navigation::workspace_edit;
use crate::position::Encoding;
use crate::shell::LanguageShell;
use crate::uri;
use crate::wording::{self, RequestError};
use nbc_base::diag::Diagnostic;
use nbc_base::source::SharedWorld;
use nbc_base::source::Span;
use nbc_lang::check::NameUse;
use nbc_session::{Checked, Session};

pub(super) struct Rename<'a> {
    new: &'a str,
    home: Uri,
    declared: Span,
    encoding: Encoding,
    world: SharedWorld,
    shell: Arc<dyn LanguageShell>,
    /// By URI.
    files: BTreeMap<String, RenamedFile>,
    /// With the number of uses.
    sources: Vec<(Arc<Checked>, usize)>,
}

struct RenamedFile {
    text: String,
    places: BTreeSet<(u32, u32)>,
    edits: Vec<TextEdit>,
}

impl<'a> Rename<'a> {
    pub(super) fn new(
        files: &Files<'_>,
        found: NameUse,
        new: &'a str,
        (world, shell): (SharedWorld, Arc<dyn LanguageShell>),
    ) -> Self {
        let (home, declared, encoding) = (files.uri(found.declared.file), found.declared, files.encoding);
        Self { new, home, declared, encoding, world, shell, files: BTreeMap::new(), sources: Vec::new() }
    }

    pub(super) fn add(&mut self, checked: Arc<Checked>) {
        let (world, shell) = (self.world.clone(), self.shell.clone());
        let files = Files { checked: &checked, encoding: self.encoding, world: &world, shell: &*shell };
        let Some(declared) = self.declared_in(&files, self.declared) else { return };
        let mut count = 0;
        for found in checked.uses.of(declared) {
            count += 1;
            let source = checked.sources.file(found.place.file);
            let file = self.files.entry(files.uri(source.id).0).or_insert_with(|| RenamedFile {
                text: source.text.clone(),
                places: BTreeSet::new(),
                edits: Vec::new(),
            });
            if file.places.insert((found.place.start, found.place.end)) {
                file.edits.push(TextEdit { range: files.range(found.place), new_text: self.new.to_owned() });
            }
        }
        if count > 0 {
            self.sources.push((checked, count));
        }
    }

    fn declared_in(&self, files: &Files<'_>, declared: Span) -> Option<Span> {
        let home = files.checked.sources.iter().find(|source| files.uri(source.id) == self.home)?;
        Some(Span { file: home.id, ..declared })
    }

    /// Refuses a name that causes an error, or that changes the meaning of another name.
    pub(super) fn finish(self, buffers: &Buffers, open: &Session) -> Result<WorkspaceEdit, RequestError> {
        let mut session = Session::new(self.world.clone());
        for buffer in buffers.iter() {
            session.update(&buffer.path, 0, buffers::text(open, &buffer.path));
        }
        for (name, file) in &self.files {
            let path = uri::path(&Uri(name.clone())).unwrap_or_else(|| name.clone());
            session.update(&path, 1, file.renamed(self.new));
        }
        for (before, count) in &self.sources {
            let after = session.checked(&before.path);
            if let Some(fault) = new_error(before, &after) {
                return Err(wording::bad_name(self.new, &fault.message));
            }
            let files = Files { checked: &after, encoding: self.encoding, world: &self.world, shell: &*self.shell };
            let declared = self.declared_in(&files, self.moved());
            if declared.map(|declared| after.uses.of(declared).count()) != Some(*count) {
                return Err(wording::other_meaning(self.new));
            }
        }
        let edits = self
            .files
            .into_iter()
            .flat_map(|(uri, file)| file.edits.into_iter().map(move |edit| (Uri(uri.clone()), edit)));
        Ok(workspace_edit(edits))
    }

    fn moved(&self) -> Span {
        let places = self.files.get(&self.home.0).into_iter().flat_map(|file| &file.places);
        let before = places.take_while(|(start, _)| *start < self.declared.start);
        let length = |start: u32, end: u32| i64::from(end) - i64::from(start);
        let more: i64 = before.map(|&(start, end)| self.new.len() as i64 - length(start, end)).sum();
        let start = (i64::from(self.declared.start) + more) as usize;
        Span::new(self.declared.file, start, start + self.new.len())
    }
}

impl RenamedFile {
    fn renamed(&self, new: &str) -> String {
        let mut text = self.text.clone();
        for &(start, end) in self.places.iter().rev() {
            text.replace_range(start as usize..end as usize, new);
        }
        text
    }
}

fn new_error<'c>(before: &Checked, after: &'c Checked) -> Option<&'c Diagnostic> {
    let errors = |checked: &Checked| checked.diagnostics.iter().filter(|fault| fault.is_error()).count();
    if errors(after) <= errors(before) {
        return None;
    }
    let is_new = |fault: &&Diagnostic| !before.diagnostics.iter().any(|known| known.message == fault.message);
    let mut now = after.diagnostics.iter().filter(|fault| fault.is_error());
    now.clone().find(is_new).or_else(|| now.next())
}
