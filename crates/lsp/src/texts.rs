//! Requests about the text of a source: its outline, its folds, its canonical form.

use gen_lsp_types::{
    self as lsp, DocumentFormattingRequest, DocumentLinkRequest, DocumentRangeFormattingRequest, DocumentSymbolRequest,
    FoldingRangeRequest, SelectionRangeRequest, SemanticTokensRangeRequest, SemanticTokensRequest, TextEdit, Uri,
};

use crate::buffers;
use crate::position::Lines;
use crate::service::{Reply, Server};
use crate::spot::Spot;
use crate::{layout, links, outline, selection, semantics};
use nbc_base::source::LineStarts;
use nbc_lang::syntax::tree::Tree;

impl Server {
    pub(super) fn symbols(&mut self, asked: lsp::DocumentSymbolParams) -> Reply<DocumentSymbolRequest> {
        let parsed = self.parsed(&asked.text_document.uri, outline::symbols);
        Ok(parsed.map(Into::into))
    }

    pub(super) fn folds(&mut self, asked: lsp::FoldingRangeParams) -> Reply<FoldingRangeRequest> {
        Ok(self.parsed(&asked.text_document.uri, outline::folds))
    }

    pub(super) fn parsed<T>(&mut self, uri: &Uri, read: impl FnOnce(&Tree, &Lines<'_>) -> T) -> Option<T> {
        let checked = self.checked(uri)?;
        let file = checked.file?;
        let nothing = Tree::default();
        Some(read(checked.tree(file).unwrap_or(&nothing), &self.files(&checked).lines(file)))
    }

    pub(super) fn selections(&mut self, asked: lsp::SelectionRangeParams) -> Reply<SelectionRangeRequest> {
        let Some(checked) = self.checked(&asked.text_document.uri) else { return Ok(None) };
        let spots = asked.positions.into_iter().map(|position| Spot::of(self.files(&checked), position));
        Ok(spots.map(|spot| Some(selection::around(&spot?))).collect())
    }

    pub(super) fn tokens(&mut self, asked: lsp::SemanticTokensParams) -> Reply<SemanticTokensRequest> {
        Ok(self.checked(&asked.text_document.uri).and_then(|checked| {
            let file = checked.file?;
            let whole = 0..checked.sources.file(file).text.len();
            Some(semantics::of(&self.files(&checked), file, whole))
        }))
    }

    pub(super) fn some_tokens(&mut self, asked: lsp::SemanticTokensRangeParams) -> Reply<SemanticTokensRangeRequest> {
        Ok(self.checked(&asked.text_document.uri).and_then(|checked| {
            let (file, files) = (checked.file?, self.files(&checked));
            Some(semantics::of(&files, file, files.lines(file).bytes(asked.range)))
        }))
    }

    pub(super) fn links(&mut self, asked: lsp::DocumentLinkParams) -> Reply<DocumentLinkRequest> {
        let checked = self.checked(&asked.text_document.uri);
        Ok(checked.and_then(|checked| Some(links::of(&self.files(&checked), checked.file?))))
    }

    pub(super) fn format_range(
        &mut self,
        asked: lsp::DocumentRangeFormattingParams,
    ) -> Reply<DocumentRangeFormattingRequest> {
        let Some(buffer) = self.buffers.get(&asked.text_document.uri) else { return Ok(None) };
        let Ok(formatted) = self.session.formatted(&buffer.path) else { return Ok(None) };
        let text = buffers::text(&self.session, &buffer.path);
        let starts = LineStarts::of(&text);
        let lines = Lines { text: &text, starts: &starts, encoding: self.encoding };
        Ok(Some(layout::edits(&lines, &formatted, lines.bytes(asked.range))))
    }

    pub(super) fn format(&mut self, asked: lsp::DocumentFormattingParams) -> Reply<DocumentFormattingRequest> {
        let Some(buffer) = self.buffers.get(&asked.text_document.uri) else { return Ok(None) };
        // A text with errors of syntax stays as it is; its diagnostics say why.
        let Ok(formatted) = self.session.formatted(&buffer.path) else { return Ok(None) };
        if formatted.is_canonical {
            return Ok(Some(Vec::new()));
        }
        let text = buffers::text(&self.session, &buffer.path);
        let starts = LineStarts::of(&text);
        let range = Lines { text: &text, starts: &starts, encoding: self.encoding }.range(0..text.len());
        Ok(Some(vec![TextEdit { range, new_text: formatted.text }]))
    }
}
