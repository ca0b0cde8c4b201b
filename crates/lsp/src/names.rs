//! Requests about the names of a source: declarations, uses, new names.

use std::collections::BTreeSet;
use std::sync::Arc;

use gen_lsp_types::{
    self as lsp, DefinitionRequest, DocumentHighlightRequest, PrepareRenameRequest, ReferencesRequest, RenameRequest,
    TextDocumentPositionParams, WorkspaceEdit, WorkspaceSymbolRequest,
};

use crate::navigation;
use crate::rename::Rename;
use crate::service::{Reply, Server};
use crate::used_files::UsedFiles;
use crate::wording::RequestError;
use nbc_lang::check::NameUse;
use nbc_session::Checked;

const MOST_SYMBOLS: usize = 1000;

impl Server {
    pub(super) fn name(&mut self, place: &TextDocumentPositionParams) -> Option<(Arc<Checked>, NameUse)> {
        let checked = self.checked(&place.text_document.uri)?;
        let file = checked.file?;
        let offset = self.files(&checked).lines(file).offset(place.position);
        let found = checked.uses.at(file, offset)?;
        Some((checked, found))
    }

    pub(super) fn definition(&mut self, asked: lsp::DefinitionParams) -> Reply<DefinitionRequest> {
        Ok(self.name(&asked.text_document_position_params).map(|(checked, found)| {
            let location = self.files(&checked).location(found.declared);
            lsp::DefinitionResponse::Definition(location.into())
        }))
    }

    fn uses(&mut self, checked: &Checked, found: NameUse, with_declaration: bool) -> Vec<lsp::Location> {
        let home = self.files(checked).uri(found.declared.file);
        let mut places: Vec<lsp::Location> = Vec::new();
        for other in self.sources_of(checked, found) {
            places.extend(navigation::uses(&self.files(&other), &home, found.declared, with_declaration));
        }
        places.sort_by(|a, b| (&a.uri.0, a.range).cmp(&(&b.uri.0, b.range)));
        places.dedup();
        places
    }

    /// The sources that use a declaration's file, also through others. Checking all others would take long.
    fn sources_of(&mut self, checked: &Checked, found: NameUse) -> Vec<Arc<Checked>> {
        let home = checked.sources.file(found.declared.file);
        let mut paths = self.all_paths();
        let used = UsedFiles::of(&self.session, &*self.world, &self.buffers, paths.clone());
        let homes = match self.files(checked).prelude(home.id) {
            // Every source uses the prelude.
            Some(_) => used.with(checked.sources.text(found.declared)),
            None => vec![self.world.identity(&home.name)],
        };
        // The circuits of another tool's file have a text of their own, which nothing names.
        if homes.iter().all(|home| used.has(home)) {
            let users = used.users(homes);
            paths.retain(|path| users.contains(&self.world.identity(path)));
        }
        paths.iter().map(|path| self.as_it_is(path)).collect()
    }

    fn all_sources(&mut self) -> Vec<Arc<Checked>> {
        self.all_paths().iter().map(|path| self.as_it_is(path)).collect()
    }

    fn all_paths(&self) -> Vec<String> {
        let open: BTreeSet<String> = self.buffers.iter().map(|buffer| buffer.path.clone()).collect();
        let names: BTreeSet<String> = open.iter().map(|path| self.world.identity(path)).collect();
        let closed = self.workspace.files(&*self.shell).into_iter();
        closed.filter(|path| !names.contains(&self.world.identity(path))).chain(open.iter().cloned()).collect()
    }

    fn as_it_is(&mut self, path: &str) -> Arc<Checked> {
        let checked = self.session.checked(path);
        let known = checked.file.map(|file| checked.sources.file(file).text.as_str());
        if self.buffers.has(path) || self.world.read(path).ok().as_deref() == known {
            return checked;
        }
        self.session.close(path);
        self.session.checked(path)
    }

    pub(super) fn find(&mut self, asked: lsp::WorkspaceSymbolParams) -> Reply<WorkspaceSymbolRequest> {
        let sources = self.all_sources();
        let found = sources.iter().flat_map(|checked| navigation::declarations(&self.files(checked), &asked.query));
        Ok(Some(found.take(MOST_SYMBOLS).collect::<Vec<_>>().into()))
    }

    pub(super) fn references(&mut self, asked: lsp::ReferenceParams) -> Reply<ReferencesRequest> {
        let found = self.name(&asked.text_document_position_params);
        Ok(found.map(|(checked, found)| self.uses(&checked, found, asked.context.include_declaration)))
    }

    pub(super) fn highlights(&mut self, asked: lsp::DocumentHighlightParams) -> Reply<DocumentHighlightRequest> {
        let found = self.name(&asked.text_document_position_params);
        Ok(found.map(|(checked, found)| navigation::highlights(&self.files(&checked), found)))
    }

    pub(super) fn prepare_rename(&mut self, asked: lsp::PrepareRenameParams) -> Reply<PrepareRenameRequest> {
        let found = self.name(&asked.text_document_position_params);
        let Some((checked, found)) = found else { return Ok(None) };
        let files = self.files(&checked);
        match files.prelude(found.declared.file) {
            Some(_) => Ok(None),
            None => Ok(Some(files.range(found.place).into())),
        }
    }

    pub(super) fn renamed(
        &mut self,
        checked: &Checked,
        found: NameUse,
        new: &str,
    ) -> Result<WorkspaceEdit, RequestError> {
        let mut rename = Rename::new(&self.files(checked), found, new, (self.world.clone(), self.shell.clone()));
        self.sources_of(checked, found).into_iter().for_each(|source| rename.add(source));
        rename.finish(&self.buffers, &self.session)
    }

    pub(super) fn rename(&mut self, asked: lsp::RenameParams) -> Reply<RenameRequest> {
        let found = self.name(&asked.text_document_position_params);
        let Some((checked, found)) = found else { return Ok(None) };
        if let Some(reason) = navigation::refusal(&self.files(&checked), found, &asked.new_name) {
            return Err(reason);
        }
        self.renamed(&checked, found, &asked.new_name).map(Some)
    }
}
