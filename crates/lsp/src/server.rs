//! The loop of the server: it receives messages, changes buffers, and sends answers and diagnostics.

use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;

use crossbeam_channel::{after, never, select};
use gen_lsp_types::{
    self as lsp, CodeLensRefreshRequest, InlayHintRefreshRequest, LspNotificationMethod, PublishDiagnosticsParams,
    Registration, RegistrationParams, RegistrationRequest, SemanticTokensRefreshRequest, Uri,
};
use lsp_server::{Connection, ErrorCode, Message, Notification, Request, Response};

use crate::buffers::Buffers;
use crate::capabilities::{Abilities, Client};
use crate::compiler::{Compilation, Compiler};
use crate::files::Files;
use crate::later::WaitingHover;
use crate::pending::Pending;
use crate::position::Encoding;
use crate::runs::Runs;
use crate::server_end::ServerEnd;
use crate::settings::Settings;
use crate::workspace::Workspace;
use crate::{problems, uri};
use nbc_base::source::SharedWorld;
use nbc_session::{Checked, Session};

/// The server of one client.
pub(super) struct Server<'c> {
    connection: &'c Connection,
    pending: Pending,
    /// Whether the client asked it to shut down.
    is_shut: bool,
    pub(super) world: SharedWorld,
    pub(super) session: Session,
    pub(super) buffers: Buffers,
    pub(super) encoding: Encoding,
    pub(super) settings: Settings,
    pub(super) workspace: Workspace,
    pub(super) abilities: Abilities,
    /// Whether lenses or hints lack figures that are being compiled.
    pub(super) is_outdated: bool,
    /// The number of requests to the client.
    asked: i32,
    pub(super) compiler: Compiler,
    pub(super) waiting: Vec<WaitingHover>,
    pub(super) runs: Runs,
    /// For each open text, what was last published, and about which files.
    published: BTreeMap<String, (Arc<Checked>, BTreeSet<String>)>,
}

/// An answer, or the reason for a refusal.
pub(super) type Reply<R> = Result<<R as lsp::Request>::Result, String>;

impl<'c> Server<'c> {
    pub(super) fn new(connection: &'c Connection, client: Client, world: SharedWorld, pending: Pending) -> Self {
        let Client { encoding, settings, workspace, abilities, trusts_verilog: _ } = client;
        Self {
            connection,
            pending,
            is_shut: false,
            session: Session::new(world.clone()),
            buffers: Buffers::default(),
            encoding,
            settings,
            workspace,
            abilities,
            is_outdated: false,
            asked: 0,
            compiler: Compiler::start(world.clone()),
            waiting: Vec::new(),
            runs: Runs::new(),
            published: BTreeMap::new(),
            world,
        }
    }

    /// Serves until the client ends the session or closes its connection.
    pub(super) fn run(mut self) -> ServerEnd {
        self.watch();
        loop {
            let patience = self.waiting.iter().map(WaitingHover::left).min();
            select! {
                recv(self.connection.receiver) -> message => match message {
                    Ok(message) => if let Some(end) = self.message(message) { return end },
                    Err(_) => return ServerEnd::Orderly,
                },
                recv(self.compiler.results()) -> done => self.compiled(done.ok()),
                recv(self.runs.events()) -> event => event.into_iter().for_each(|event| self.told(event)),
                recv(patience.map_or_else(never, after)) -> _ => {}
            }
            self.answer_hovers();
            // What changes again at once need not be checked.
            if self.connection.receiver.is_empty() && !self.is_shut {
                self.publish();
            }
        }
    }

    /// Handles a message. Returns how the server ends, if this was the last message.
    fn message(&mut self, message: Message) -> Option<ServerEnd> {
        self.pending.take(&message);
        match message {
            Message::Notification(told) if told.method == "exit" => {
                return Some(if self.is_shut { ServerEnd::Orderly } else { ServerEnd::Abandoned });
            }
            Message::Request(Request { id, method, .. }) if self.is_shut || method == "initialize" => {
                let state = if self.is_shut { "is shut down" } else { "is initialized" };
                let reason = format!("the server {state}, and does not answer `{method}`");
                self.send(Response::new_err(id, ErrorCode::InvalidRequest as i32, reason).into());
            }
            Message::Request(Request { id, method, .. }) if method == "shutdown" => {
                self.is_shut = true;
                self.runs = Runs::new();
                self.send(Response::new_ok(id, ()).into());
            }
            Message::Request(request) => {
                // An answer comes after the diagnostics of the text that it is about.
                self.publish();
                if let Some(answer) = self.request(request) {
                    self.send(Message::Response(answer));
                }
            }
            Message::Notification(notification) if !self.is_shut => self.notice(notification),
            Message::Notification(_) | Message::Response(_) => {}
        }
        None
    }

    fn compiled(&mut self, done: Option<Compilation>) {
        done.into_iter().for_each(|done| self.compiler.keep(done));
        if self.is_outdated && self.compiler.is_idle() {
            self.is_outdated = false;
            self.refresh_figures();
        }
    }

    /// Asks the client to request lenses and hints again, which contain figures, as far as it supports this.
    fn refresh_figures(&mut self) {
        if self.abilities.refreshes_lenses {
            self.ask::<CodeLensRefreshRequest>(());
        }
        if self.abilities.refreshes_hints {
            self.ask::<InlayHintRefreshRequest>(());
        }
    }

    /// Asks the client to request again all that it shows of open texts, as far as it supports this.
    fn refresh(&mut self) {
        self.refresh_figures();
        if self.abilities.refreshes_tokens {
            self.ask::<SemanticTokensRefreshRequest>(());
        }
    }

    /// Sends a request to the client. Its answer is ignored.
    pub(super) fn ask<R: lsp::Request>(&mut self, parameters: R::Params) {
        self.asked += 1;
        let method = R::METHOD.to_string();
        self.send(Message::Request(Request::new(self.asked.into(), method, parameters)));
    }

    /// Asks the client to watch the files that sources are read from.
    fn watch(&mut self) {
        if !self.abilities.watches_files {
            return;
        }
        let watchers = serde_json::json!({ "watchers": [{ "globPattern": "**/*.{nb,yaml,blif,bench,aag,aig,v,sv}" }] });
        self.ask::<RegistrationRequest>(RegistrationParams {
            registrations: vec![Registration {
                id: "files".to_owned(),
                method: LspNotificationMethod::WorkspaceDidChangeWatchedFiles.to_string(),
                register_options: Some(watchers),
            }],
        });
    }

    /// Sends a message. If the connection is closed, the loop ends at its next message.
    pub(super) fn send(&self, message: Message) {
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
            LspNotificationMethod::CancelRequest => {
                notification.params.get("id").into_iter().for_each(|id| self.runs.cancel_request(id));
            }
            LspNotificationMethod::WindowWorkDoneProgressCancel => {
                let Some(cancelled) = read::<lsp::WorkDoneProgressCancelNotification>(notification) else { return };
                self.runs.cancel_progress(&cancelled.token);
            }
            LspNotificationMethod::WorkspaceDidChangeWorkspaceFolders => {
                let Some(changed) = read::<lsp::DidChangeWorkspaceFoldersNotification>(notification) else { return };
                changed.event.removed.iter().for_each(|folder| self.workspace.remove(&folder.uri));
                changed.event.added.iter().for_each(|folder| self.workspace.add(&folder.uri));
            }
            LspNotificationMethod::WorkspaceDidChangeConfiguration => {
                let settings = notification.params.pointer("/settings/nbc");
                let settings = settings.map_or(self.settings, |change| self.settings.with(change));
                if std::mem::replace(&mut self.settings, settings) != settings {
                    self.refresh();
                }
            }
            LspNotificationMethod::WorkspaceDidChangeWatchedFiles => {
                let Some(changed) = read::<lsp::DidChangeWatchedFilesNotification>(notification) else { return };
                let is_closed = |change: &&lsp::FileEvent| self.buffers.get(&change.uri).is_none();
                let paths: Vec<String> =
                    changed.changes.iter().filter(is_closed).filter_map(|change| uri::path(&change.uri)).collect();
                paths.iter().for_each(|path| self.session.close(path));
                if !paths.is_empty() {
                    self.refresh();
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
            // A check that was cut short is done again soon. Until then the last diagnostics stay.
            let is_whole = self.session.is_checked(&path);
            if !is_whole || known.is_some_and(|(known, _)| Arc::ptr_eq(known, &checked)) {
                continue;
            }
            let files = Files { checked: &checked, encoding: self.encoding, world: &*self.world };
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
        self.compiler.cancel_stale();
    }

    /// The checked text with a URI; `None` if it is not open.
    pub(super) fn checked(&mut self, uri: &Uri) -> Option<Arc<Checked>> {
        let path = self.buffers.get(uri)?.path.clone();
        Some(self.session.checked(&path))
    }

    pub(super) fn files<'a>(&'a self, checked: &'a Checked) -> Files<'a> {
        Files { checked, encoding: self.encoding, world: &*self.world }
    }

    fn tell(&self, uri: Uri, version: Option<i32>, diagnostics: Vec<lsp::Diagnostic>) {
        let method = LspNotificationMethod::TextDocumentPublishDiagnostics.to_string();
        let published = PublishDiagnosticsParams { uri, version, diagnostics };
        self.send(Message::Notification(Notification::new(method, published)));
    }
}

/// The revision of a version; editors count up from any number.
fn revision(version: i32) -> u64 {
    u64::try_from(version).unwrap_or_default()
}
