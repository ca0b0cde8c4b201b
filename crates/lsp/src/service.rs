//! The language service: it receives messages, changes buffers, and sends answers and diagnostics.

use std::collections::{BTreeMap, BTreeSet};
use std::sync::mpsc::{Receiver, Sender, channel};
use std::sync::{Arc, Weak};

use core::time::Duration;

use gen_lsp_types::{
    self as lsp, CodeLensRefreshRequest, InitializeResult, InlayHintRefreshRequest, LspNotificationMethod,
    PublishDiagnosticsParams, Registration, RegistrationParams, RegistrationRequest, SemanticTokensRefreshRequest,
    ServerInfo, Uri,
};
use lsp_server::{Message, Notification, Request, Response};

use crate::buffers::{self, Buffers};
use crate::capabilities::{Abilities, Client, capabilities};
use crate::compiler::{Compilation, Compiler};
use crate::files::Files;
use crate::later::WaitingHover;
use crate::position::Encoding;
use crate::runs::Runs;
use crate::settings::Settings;
use crate::shell::{LanguageShell, ServerEnd};
use crate::wording::{self, RequestError};
use crate::workspace::Workspace;
use crate::{problems, uri};
use nbc_base::source::SharedWorld;
use nbc_session::{Checked, Session};

/// The language service of one client. `now` is the time since any moment, and never goes back.
pub struct LanguageService {
    shell: Arc<dyn LanguageShell>,
    outbox: (Sender<Message>, Receiver<Message>),
    server: Option<Server>,
}

impl LanguageService {
    pub fn new(shell: Arc<dyn LanguageShell>) -> Self {
        Self { shell, outbox: channel(), server: None }
    }

    pub fn is_greeted(&self) -> bool {
        self.server.is_some()
    }

    /// Returns how the service ends, if this was the last message.
    pub fn receive(&mut self, message: Message, now: Duration) -> Option<ServerEnd> {
        match &mut self.server {
            Some(server) => {
                server.now = now;
                server.message(message)
            }
            None => self.greet(message),
        }
    }

    /// Takes finished work, answers hovers that have waited, and publishes diagnostics. Call it after all messages.
    pub fn advance(&mut self, now: Duration) {
        if let Some(server) = &mut self.server {
            server.now = now;
            server.advance();
        }
    }

    /// The time until [`LanguageService::advance`] has something to do; `None` until a message or finished work.
    pub fn due(&self, now: Duration) -> Option<Duration> {
        self.server.as_ref()?.waiting.iter().map(|hover| hover.left(now)).min()
    }

    pub fn next_message(&mut self) -> Option<Message> {
        self.outbox.1.try_recv().ok()
    }

    fn greet(&mut self, message: Message) -> Option<ServerEnd> {
        let answer = match message {
            Message::Request(Request { id, method, params }) if method == "initialize" && params.is_object() => {
                let client = Client::of(&params);
                let _ = self.outbox.0.send(Response::new_ok(id, welcome(&client)).into());
                let mut server = Server::new(client, self.shell.clone(), self.outbox.0.clone());
                server.watch();
                self.server = Some(server);
                return None;
            }
            Message::Request(Request { id, method, .. }) if method == "initialize" => {
                wording::initialize_parameters().answer(id)
            }
            Message::Request(Request { id, method, .. }) => wording::not_initialized(&method).answer(id),
            Message::Notification(told) if told.method == "exit" => return Some(ServerEnd::Abandoned),
            Message::Notification(_) | Message::Response(_) => return None,
        };
        let _ = self.outbox.0.send(answer.into());
        None
    }
}

fn welcome(client: &Client) -> InitializeResult {
    let name = ServerInfo { name: nbc_base::PROGRAM.to_owned(), version: Some(nbc_base::VERSION.to_owned()) };
    InitializeResult { capabilities: capabilities(client.encoding), server_info: Some(name) }
}

pub(super) struct Server {
    outbox: Sender<Message>,
    pub(super) shell: Arc<dyn LanguageShell>,
    pub(super) now: Duration,
    is_shut: bool,
    pub(super) world: SharedWorld,
    pub(super) session: Session,
    pub(super) buffers: Buffers,
    pub(super) encoding: Encoding,
    pub(super) settings: Settings,
    pub(super) workspace: Workspace,
    pub(super) abilities: Abilities,
    pub(super) is_outdated: bool,
    asked: i32,
    pub(super) compiler: Compiler,
    pub(super) waiting: Vec<WaitingHover>,
    pub(super) runs: Runs,
    /// The files that each source has diagnostics in.
    published: BTreeMap<String, (Weak<Checked>, BTreeSet<String>)>,
    /// A notification has come since the diagnostics were published.
    is_noticed: bool,
}

pub(super) type Reply<R> = Result<<R as lsp::Request>::Result, RequestError>;

impl Server {
    fn new(client: Client, shell: Arc<dyn LanguageShell>, outbox: Sender<Message>) -> Self {
        let Client { encoding, settings, workspace, abilities } = client;
        let world = shell.world();
        Self {
            outbox,
            now: Duration::ZERO,
            is_shut: false,
            session: Session::new(world.clone()),
            buffers: Buffers::default(),
            encoding,
            settings,
            workspace,
            abilities,
            is_outdated: false,
            asked: 0,
            compiler: Compiler::new(shell.clone()),
            waiting: Vec::new(),
            runs: Runs::new(shell.clone()),
            published: BTreeMap::new(),
            is_noticed: false,
            world,
            shell,
        }
    }

    fn advance(&mut self) {
        while let Some(done) = self.compiler.result() {
            self.compiled(done);
        }
        while let Some(event) = self.runs.event() {
            self.told(event);
        }
        self.answer_hovers();
        if !self.is_shut {
            self.publish();
        }
    }

    fn message(&mut self, message: Message) -> Option<ServerEnd> {
        match message {
            Message::Notification(told) if told.method == "exit" => {
                return Some(if self.is_shut { ServerEnd::Orderly } else { ServerEnd::Abandoned });
            }
            Message::Request(Request { id, method, .. }) if self.is_shut => {
                self.send(wording::shut_down(&method).answer(id).into());
            }
            Message::Request(Request { id, method, .. }) if method == "initialize" => {
                self.send(wording::initialized(&method).answer(id).into());
            }
            Message::Request(Request { id, method, .. }) if method == "shutdown" => {
                self.is_shut = true;
                self.runs = Runs::new(self.shell.clone());
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

    fn compiled(&mut self, done: Compilation) {
        self.compiler.keep(done);
        if self.is_outdated && self.compiler.is_idle() {
            self.is_outdated = false;
            self.refresh_figures();
        }
    }

    fn refresh_figures(&mut self) {
        if self.abilities.refreshes_lenses {
            self.ask::<CodeLensRefreshRequest>(());
        }
        if self.abilities.refreshes_hints {
            self.ask::<InlayHintRefreshRequest>(());
        }
    }

    fn refresh(&mut self) {
        self.refresh_figures();
        if self.abilities.refreshes_tokens {
            self.ask::<SemanticTokensRefreshRequest>(());
        }
    }

    pub(super) fn ask<R: lsp::Request>(&mut self, parameters: R::Params) {
        self.asked += 1;
        let method = R::METHOD.to_string();
        self.send(Message::Request(Request::new(self.asked.into(), method, parameters)));
    }

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

    pub(super) fn send(&self, message: Message) {
        let _ = self.outbox.send(message);
    }

    fn notice(&mut self, notification: Notification) {
        self.is_noticed = true;
        fn read<N: lsp::Notification>(notification: Notification) -> Option<N::Params> {
            serde_json::from_value(notification.params).ok()
        }
        let method = notification.method.clone();
        match LspNotificationMethod::from(method.as_str()) {
            LspNotificationMethod::TextDocumentDidOpen => {
                let Some(opened) = read::<lsp::DidOpenTextDocumentNotification>(notification) else { return };
                let document = opened.text_document;
                let buffer = self.buffers.open(document.uri, document.version);
                self.session.close(&buffer.path);
                self.session.update(&buffer.path, 0, document.text);
            }
            LspNotificationMethod::TextDocumentDidChange => {
                let Some(changed) = read::<lsp::DidChangeTextDocumentNotification>(notification) else { return };
                let (id, changes) = (changed.text_document, changed.content_changes);
                let uri = id.text_document_identifier.uri;
                let Some(buffer) = self.buffers.change(&uri, id.version) else { return };
                let mut text = buffers::text(&self.session, &buffer.path);
                changes.into_iter().for_each(|change| buffers::change(&mut text, change, self.encoding));
                self.session.update(&buffer.path, 0, text);
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

    fn publish(&mut self) {
        if !std::mem::take(&mut self.is_noticed) {
            return;
        }
        let open: Vec<_> = self.buffers.iter().map(|buffer| (buffer.path.clone(), buffer.version)).collect();
        for (path, version) in open {
            let checked = self.session.checked(&path);
            let known = self.published.get(&path);
            // A check that was cut short is done again soon. Until then the last diagnostics stay.
            let is_whole = self.session.is_checked(&path);
            self.is_noticed |= !is_whole;
            if !is_whole || known.is_some_and(|(known, _)| known.as_ptr() == Arc::as_ptr(&checked)) {
                continue;
            }
            let files = self.files(&checked);
            let mut found = problems::by_file(&files);
            let own = self.buffers.iter().find(|buffer| buffer.path == path).map(|buffer| buffer.uri.clone());
            let own = own.unwrap_or_else(|| files.own());
            let mine = found.remove(files.own().as_ref()).map(|(_, list)| list).unwrap_or_default();
            let before = known.map(|(_, files)| files.clone()).unwrap_or_default();
            let about: BTreeSet<String> = found.keys().cloned().chain([own.to_string()]).collect();
            self.tell(own, Some(version), mine);
            found.into_values().for_each(|(uri, list)| self.tell(uri, None, list));
            before.difference(&about).for_each(|uri| self.tell(Uri(uri.clone()), None, Vec::new()));
            self.published.insert(path, (Arc::downgrade(&checked), about));
        }
        self.compiler.cancel_stale(self.published.values().map(|(checked, _)| checked));
    }

    pub(super) fn checked(&mut self, uri: &Uri) -> Option<Arc<Checked>> {
        let path = self.buffers.get(uri)?.path.clone();
        Some(self.session.checked(&path))
    }

    pub(super) fn files<'a>(&'a self, checked: &'a Checked) -> Files<'a> {
        Files { checked, encoding: self.encoding, world: &*self.world, shell: &*self.shell }
    }

    fn tell(&self, uri: Uri, version: Option<i32>, diagnostics: Vec<lsp::Diagnostic>) {
        let method = LspNotificationMethod::TextDocumentPublishDiagnostics.to_string();
        let published = PublishDiagnosticsParams { uri, version, diagnostics };
        self.send(Message::Notification(Notification::new(method, published)));
    }
}

#[cfg(test)]
mod tests {
    use std::sync::Mutex;

    use nbc_base::source::MemoryWorld;
    use serde_json::{Value, json};

    use super::*;
    use crate::shell::LanguageWork;

    #[derive(Default)]
    struct Bare {
        work: Mutex<Vec<LanguageWork>>,
    }

    impl Bare {
        fn do_all(&self) {
            for work in std::mem::take(&mut *self.work.lock().unwrap()) {
                work();
            }
        }
    }

    impl LanguageShell for Bare {
        fn world(&self) -> SharedWorld {
            Arc::new(MemoryWorld::default())
        }

        fn source_files(&self, _: &[&str]) -> Vec<String> {
            Vec::new()
        }

        fn queue(&self, work: LanguageWork) {
            self.work.lock().unwrap().push(work);
        }

        fn start(&self, work: LanguageWork) {
            self.queue(work);
        }

        fn wake(&self) {}

        fn write_text(&self, _: &str, _: &str) -> Option<String> {
            None
        }

        fn shows_results(&self) -> bool {
            false
        }

        fn write_result(&self, _: &str, _: &str, _: &str) -> Result<String, String> {
            Err("there is no disk".to_owned())
        }
    }

    const TEXT: &str = "circuit invert(a) -> (q) {\n    q = not a\n}\n";

    fn opened() -> (Arc<Bare>, LanguageService, Vec<Value>) {
        let shell = Arc::new(Bare::default());
        let mut service = LanguageService::new(shell.clone());
        send(&mut service, Some(1), "initialize", json!({ "capabilities": {} }));
        let document = json!({ "uri": "file:///a.nb", "languageId": "nb", "version": 1, "text": TEXT });
        send(&mut service, None, "textDocument/didOpen", json!({ "textDocument": document }));
        service.advance(Duration::ZERO);
        let said = said(&mut service);
        (shell, service, said)
    }

    fn send(service: &mut LanguageService, id: Option<i32>, method: &str, params: Value) -> Option<ServerEnd> {
        let method = method.to_owned();
        let message = match id {
            Some(id) => Message::Request(Request { id: id.into(), method, params }),
            None => Message::Notification(Notification { method, params }),
        };
        service.receive(message, Duration::ZERO)
    }

    fn said(service: &mut LanguageService) -> Vec<Value> {
        std::iter::from_fn(|| service.next_message()).map(|message| serde_json::to_value(message).unwrap()).collect()
    }

    #[test]
    fn a_service_answers_and_publishes_when_it_is_advanced() {
        let (_, mut service, said_first) = opened();
        assert_eq!(said_first[0]["id"], 1);
        assert_eq!(said_first[1]["method"], "textDocument/publishDiagnostics");
        assert_eq!(said_first[1]["params"]["diagnostics"], json!([]));
        let change = json!({
            "textDocument": { "uri": "file:///a.nb", "version": 2 }, "contentChanges": [{ "text": "circuit" }],
        });
        send(&mut service, None, "textDocument/didChange", change);
        assert_eq!(said(&mut service), [] as [Value; 0]);
        service.advance(Duration::ZERO);
        let published = said(&mut service);
        assert!(published[0]["params"]["diagnostics"][0]["code"].is_string(), "{published:?}");
        assert_eq!(send(&mut service, Some(2), "shutdown", Value::Null), None);
        assert_eq!(send(&mut service, None, "exit", Value::Null), Some(ServerEnd::Orderly));
    }

    #[test]
    fn a_hover_waits_for_its_figures_as_long_as_its_clock_says() {
        let hover = json!({
            "textDocument": { "uri": "file:///a.nb" }, "position": { "line": 0, "character": 10 },
        });
        let text = |answer: &Value| answer["result"]["contents"]["value"].as_str().unwrap().to_owned();
        let (shell, mut service, _) = opened();
        send(&mut service, Some(2), "textDocument/hover", hover.clone());
        service.advance(Duration::ZERO);
        assert_eq!(said(&mut service), [] as [Value; 0]);
        let due = service.due(Duration::ZERO).unwrap();
        service.advance(due);
        let without = said(&mut service);
        assert_eq!(without[0]["id"], 2);
        assert_eq!(service.due(due), None);
        shell.do_all();
        service.advance(due);
        send(&mut service, Some(3), "textDocument/hover", hover);
        let with = said(&mut service);
        assert!(text(&with[0]).contains("1 robot") && !text(&without[0]).contains("1 robot"), "{with:?}");
    }
}
