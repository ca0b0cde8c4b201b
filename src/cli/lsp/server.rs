//! The loop of the server: messages come in, buffers change, answers and diagnostics go out.

use std::collections::{BTreeMap, BTreeSet};
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::Arc;

use gen_lsp_types::{
    self as lsp, CodeActionRequest, CompletionRequest, DefinitionRequest, DocumentFormattingRequest,
    DocumentHighlightRequest, DocumentSymbolRequest, FoldingRangeRequest, HoverRequest, LspNotificationMethod,
    LspRequestMethod, PrepareRenameRequest, PublishDiagnosticsParams, ReferencesRequest, RenameRequest,
    TextDocumentPositionParams, TextEdit, Uri,
};
use lsp_server::{Connection, ErrorCode, Message, Notification, ProtocolError, Request, Response};

use crate::check::NameUse;
use crate::cli::lsp::buffers::Buffers;
use crate::cli::lsp::files::Files;
use crate::cli::lsp::position::{Encoding, Lines};
use crate::cli::lsp::{completion, hover, navigation, outline, problems, uri};
use crate::session::{Checked, Session};
use crate::source::LineStarts;
use crate::store::DiskWorld;
use crate::syntax;

/// The server of one client.
pub(super) struct Server<'c> {
    connection: &'c Connection,
    session: Session,
    buffers: Buffers,
    encoding: Encoding,
    /// For each open text, what was last published, and about which files.
    published: BTreeMap<String, (Arc<Checked>, BTreeSet<String>)>,
}

/// An answer, or why there is none.
type Answer<R> = Result<<R as lsp::Request>::Result, String>;

impl<'c> Server<'c> {
    pub(super) fn new(connection: &'c Connection, encoding: Encoding) -> Self {
        let session = Session::new(DiskWorld);
        Self { connection, session, buffers: Buffers::default(), encoding, published: BTreeMap::new() }
    }

    /// Serves until the client says goodbye or vanishes.
    ///
    /// # Errors
    /// When the client breaks the protocol.
    pub(super) fn run(mut self) -> Result<(), ProtocolError> {
        while let Ok(message) = self.connection.receiver.recv() {
            match message {
                Message::Request(request) => {
                    if self.connection.handle_shutdown(&request)? {
                        return Ok(());
                    }
                    let answer = self.request(request);
                    self.send(Message::Response(answer));
                }
                Message::Notification(notification) => self.notice(notification),
                Message::Response(_) => {}
            }
            // What changes again at once need not be checked.
            if self.connection.receiver.is_empty() {
                self.publish();
            }
        }
        Ok(())
    }

    /// A client that has vanished ends the loop at its next message.
    fn send(&self, message: Message) {
        let _ = self.connection.sender.send(message);
    }

    fn notice(&mut self, notification: Notification) {
        fn read<N: lsp::Notification>(notification: Notification) -> Option<N::Params> {
            serde_json::from_value(notification.params).ok()
        }
        let method = notification.method.clone();
        match LspNotificationMethod::from(method.as_str()) {
            LspNotificationMethod::TextDocumentDidOpen => {
                let Some(opened) = read::<lsp::DidOpenTextDocumentNotification>(notification) else { return };
                let document = opened.text_document;
                let buffer = self.buffers.open(document.uri, document.version, document.text);
                self.session.close(&buffer.path);
                self.session.update(&buffer.path, revision(buffer.version), buffer.text.clone());
            }
            LspNotificationMethod::TextDocumentDidChange => {
                let Some(changed) = read::<lsp::DidChangeTextDocumentNotification>(notification) else { return };
                let (id, changes) = (changed.text_document, changed.content_changes);
                let uri = id.text_document_identifier.uri;
                let Some(buffer) = self.buffers.change(&uri, id.version, changes, self.encoding) else { return };
                self.session.update(&buffer.path, revision(buffer.version), buffer.text.clone());
            }
            LspNotificationMethod::TextDocumentDidClose => {
                let Some(closed) = read::<lsp::DidCloseTextDocumentNotification>(notification) else { return };
                self.close(&closed.text_document.uri);
            }
            LspNotificationMethod::WorkspaceDidChangeWatchedFiles => {
                let Some(changed) = read::<lsp::DidChangeWatchedFilesNotification>(notification) else { return };
                for change in changed.changes.iter().filter(|change| self.buffers.get(&change.uri).is_none()) {
                    uri::path(&change.uri).into_iter().for_each(|path| self.session.close(&path));
                }
            }
            _ => {}
        }
    }

    fn close(&mut self, uri: &Uri) {
        let Some(buffer) = self.buffers.close(uri) else { return };
        self.session.close(&buffer.path);
        if let Some((_, files)) = self.published.remove(&buffer.path) {
            files.into_iter().for_each(|uri| self.tell(Uri(uri), None, Vec::new()));
        }
    }

    /// Publishes the diagnostics of the texts whose results have changed.
    fn publish(&mut self) {
        let open: Vec<_> = self.buffers.iter().map(|buffer| (buffer.path.clone(), buffer.version)).collect();
        for (path, version) in open {
            let checked = self.session.checked(&path);
            let known = self.published.get(&path);
            if known.is_some_and(|(known, _)| Arc::ptr_eq(known, &checked)) {
                continue;
            }
            let files = Files { checked: &checked, encoding: self.encoding };
            let mut found = problems::by_file(&files);
            let own = self.buffers.iter().find(|buffer| buffer.path == path).map(|buffer| buffer.uri.clone());
            let own = own.unwrap_or_else(|| files.own());
            let mine = found.remove(files.own().as_ref()).map(|(_, list)| list).unwrap_or_default();
            let before = known.map(|(_, files)| files.clone()).unwrap_or_default();
            let about: BTreeSet<String> = found.keys().cloned().chain([own.to_string()]).collect();
            self.tell(own, Some(version), mine);
            found.into_values().for_each(|(uri, list)| self.tell(uri, None, list));
            before.difference(&about).for_each(|uri| self.tell(Uri(uri.clone()), None, Vec::new()));
            self.published.insert(path, (checked, about));
        }
    }

    fn tell(&self, uri: Uri, version: Option<i32>, diagnostics: Vec<lsp::Diagnostic>) {
        let method = LspNotificationMethod::TextDocumentPublishDiagnostics.to_string();
        let published = PublishDiagnosticsParams { uri, version, diagnostics };
        self.send(Message::Notification(Notification::new(method, published)));
    }

    fn request(&mut self, request: Request) -> Response {
        let method = request.method.clone();
        match LspRequestMethod::from(method.as_str()) {
            LspRequestMethod::TextDocumentHover => self.answer::<HoverRequest>(request, Self::hover),
            LspRequestMethod::TextDocumentDefinition => self.answer::<DefinitionRequest>(request, Self::definition),
            LspRequestMethod::TextDocumentReferences => self.answer::<ReferencesRequest>(request, Self::references),
            LspRequestMethod::TextDocumentDocumentHighlight => {
                self.answer::<DocumentHighlightRequest>(request, Self::highlights)
            }
            LspRequestMethod::TextDocumentPrepareRename => {
                self.answer::<PrepareRenameRequest>(request, Self::prepare_rename)
            }
            LspRequestMethod::TextDocumentRename => self.answer::<RenameRequest>(request, Self::rename),
            LspRequestMethod::TextDocumentDocumentSymbol => {
                self.answer::<DocumentSymbolRequest>(request, Self::symbols)
            }
            LspRequestMethod::TextDocumentFoldingRange => self.answer::<FoldingRangeRequest>(request, Self::folds),
            LspRequestMethod::TextDocumentFormatting => self.answer::<DocumentFormattingRequest>(request, Self::format),
            LspRequestMethod::TextDocumentCodeAction => self.answer::<CodeActionRequest>(request, Self::fixes),
            LspRequestMethod::TextDocumentCompletion => self.answer::<CompletionRequest>(request, Self::complete),
            _ => {
                let message = format!("`{method}` is not a request of this server");
                Response::new_err(request.id, ErrorCode::MethodNotFound as i32, message)
            }
        }
    }

    /// Answers a request. A bug of a handler is an answer too, and the server goes on.
    fn answer<R: lsp::Request>(
        &mut self,
        request: Request,
        handle: impl FnOnce(&mut Self, R::Params) -> Answer<R>,
    ) -> Response {
        let parameters = match serde_json::from_value(request.params) {
            Ok(parameters) => parameters,
            Err(error) => return Response::new_err(request.id, ErrorCode::InvalidParams as i32, error.to_string()),
        };
        match catch_unwind(AssertUnwindSafe(|| handle(self, parameters))) {
            Ok(Ok(result)) => Response::new_ok(request.id, result),
            Ok(Err(reason)) => Response::new_err(request.id, ErrorCode::RequestFailed as i32, reason),
            Err(_) => {
                let message = "this is a bug of nbc; details are on standard error".to_owned();
                Response::new_err(request.id, ErrorCode::InternalError as i32, message)
            }
        }
    }

    /// The checked text with a URI; `None` if it is not open.
    fn checked(&mut self, uri: &Uri) -> Option<Arc<Checked>> {
        let path = self.buffers.get(uri)?.path.clone();
        Some(self.session.checked(&path))
    }

    /// The name at a place, with its source.
    fn name(&mut self, place: &TextDocumentPositionParams) -> Option<(Arc<Checked>, NameUse)> {
        let checked = self.checked(&place.text_document.uri)?;
        let file = checked.file?;
        let offset = self.files(&checked).lines(file).offset(place.position);
        let found = checked.uses.at(file, offset)?;
        Some((checked, found))
    }

    fn files<'a>(&self, checked: &'a Checked) -> Files<'a> {
        Files { checked, encoding: self.encoding }
    }

    fn hover(&mut self, asked: lsp::HoverParams) -> Answer<HoverRequest> {
        Ok(self.name(&asked.text_document_position_params).map(|(checked, found)| {
            let files = self.files(&checked);
            let value = hover::text(&files, found);
            let contents = lsp::MarkupContent { kind: lsp::MarkupKind::Markdown, value };
            lsp::Hover { contents: contents.into(), range: Some(files.range(found.place)) }
        }))
    }

    fn definition(&mut self, asked: lsp::DefinitionParams) -> Answer<DefinitionRequest> {
        Ok(self.name(&asked.text_document_position_params).map(|(checked, found)| {
            let location = self.files(&checked).location(found.declared);
            lsp::DefinitionResponse::Definition(location.into())
        }))
    }

    /// The uses of a name in all open texts and what they use.
    fn uses(&mut self, checked: &Checked, found: NameUse, with_declaration: bool) -> Vec<lsp::Location> {
        let home = self.files(checked).uri(found.declared.file);
        let paths: Vec<_> = self.buffers.iter().map(|buffer| buffer.path.clone()).collect();
        let mut places: Vec<lsp::Location> = Vec::new();
        for path in paths {
            let other = self.session.checked(&path);
            places.extend(navigation::uses(&self.files(&other), &home, found.declared, with_declaration));
        }
        places.sort_by(|a, b| (&a.uri.0, a.range).cmp(&(&b.uri.0, b.range)));
        places.dedup();
        places
    }

    fn references(&mut self, asked: lsp::ReferenceParams) -> Answer<ReferencesRequest> {
        let found = self.name(&asked.text_document_position_params);
        Ok(found.map(|(checked, found)| self.uses(&checked, found, asked.context.include_declaration)))
    }

    fn highlights(&mut self, asked: lsp::DocumentHighlightParams) -> Answer<DocumentHighlightRequest> {
        let found = self.name(&asked.text_document_position_params);
        Ok(found.map(|(checked, found)| navigation::highlights(&self.files(&checked), found)))
    }

    fn prepare_rename(&mut self, asked: lsp::PrepareRenameParams) -> Answer<PrepareRenameRequest> {
        let found = self.name(&asked.text_document_position_params);
        let Some((checked, found)) = found else { return Ok(None) };
        let files = self.files(&checked);
        match files.prelude(found.declared.file) {
            Some(_) => Ok(None),
            None => Ok(Some(files.range(found.place).into())),
        }
    }

    fn rename(&mut self, asked: lsp::RenameParams) -> Answer<RenameRequest> {
        let found = self.name(&asked.text_document_position_params);
        let Some((checked, found)) = found else { return Ok(None) };
        if let Some(reason) = navigation::refusal(&self.files(&checked), found, &asked.new_name) {
            return Err(reason);
        }
        let places = self.uses(&checked, found, true).into_iter();
        let edit =
            |place: lsp::Location| (place.uri, TextEdit { range: place.range, new_text: asked.new_name.clone() });
        Ok(Some(navigation::workspace_edit(places.map(edit))))
    }

    fn symbols(&mut self, asked: lsp::DocumentSymbolParams) -> Answer<DocumentSymbolRequest> {
        let parsed = self.parsed(&asked.text_document.uri, outline::symbols);
        Ok(parsed.map(Into::into))
    }

    fn folds(&mut self, asked: lsp::FoldingRangeParams) -> Answer<FoldingRangeRequest> {
        Ok(self.parsed(&asked.text_document.uri, outline::folds))
    }

    /// Reads the tree of an open text.
    fn parsed<T>(&mut self, uri: &Uri, read: impl FnOnce(&syntax::tree::Tree, &Lines<'_>) -> T) -> Option<T> {
        let checked = self.checked(uri)?;
        let file = checked.file?;
        let tree = syntax::parse(&checked.sources, file).tree;
        Some(read(&tree, &self.files(&checked).lines(file)))
    }

    fn format(&mut self, asked: lsp::DocumentFormattingParams) -> Answer<DocumentFormattingRequest> {
        let Some(buffer) = self.buffers.get(&asked.text_document.uri) else { return Ok(None) };
        // A text with errors of syntax stays as it is; its diagnostics say why.
        let Ok(formatted) = self.session.formatted(&buffer.path) else { return Ok(None) };
        if formatted.is_canonical {
            return Ok(Some(Vec::new()));
        }
        let starts = LineStarts::of(&buffer.text);
        let lines = Lines { text: &buffer.text, starts: &starts, encoding: self.encoding };
        let range = lines.range(0..buffer.text.len());
        Ok(Some(vec![TextEdit { range, new_text: formatted.text }]))
    }

    fn fixes(&mut self, asked: lsp::CodeActionParams) -> Answer<CodeActionRequest> {
        let checked = self.checked(&asked.text_document.uri);
        Ok(checked.map(|checked| {
            let files = self.files(&checked);
            problems::fixes(&files, &files.own(), asked.range)
        }))
    }

    fn complete(&mut self, asked: lsp::CompletionParams) -> Answer<CompletionRequest> {
        let place = asked.text_document_position_params;
        let Some(checked) = self.checked(&place.text_document.uri) else { return Ok(None) };
        let Some(file) = checked.file else { return Ok(None) };
        let files = self.files(&checked);
        let offset = files.lines(file).offset(place.position);
        let tree = syntax::parse(&checked.sources, file).tree;
        Ok(Some(completion::items(&files, file, &tree, offset).into()))
    }
}

/// The revision of a version; editors count up from any number.
fn revision(version: i32) -> u64 {
    u64::try_from(version).unwrap_or_default()
}
