//! Lenses, and the commands behind them.

use std::sync::Arc;

use gen_lsp_types::{
    self as lsp, CodeLensRequest, ProgressParams, ProgressToken, WorkDoneProgressCreateParams,
    WorkDoneProgressCreateRequest,
};
use lsp_server::{Message, Notification, RequestId, Response};
use serde_json::{Value, json};

use crate::figures::Subject;
use crate::files::Files;
use crate::lenses;
use crate::runs::{RunEvent, RunOrder, RunOutcome};
use crate::service::{Reply, Server};
use crate::wording::{self, RequestError};
use nbc_session::Checked;

impl Server {
    pub(super) fn lenses(&mut self, asked: lsp::CodeLensParams) -> Reply<CodeLensRequest> {
        let Some(checked) = self.checked(&asked.text_document.uri) else { return Ok(None) };
        let Some(file) = checked.file.filter(|_| self.settings.code_lenses) else { return Ok(None) };
        let (world, shell) = (self.world.clone(), self.shell.clone());
        let files = Files { checked: &checked, encoding: self.encoding, world: &world, shell: &*shell };
        let mut found = lenses::of_runs(&files, file);
        for (place, circuit, swarm) in lenses::subjects(&files, file) {
            let subject = Subject::Circuit(circuit, swarm);
            let summary = self.summary(&checked, &subject);
            found.extend(lenses::of_subject(&files, place, &subject, summary));
        }
        Ok(Some(found))
    }

    pub(super) fn execute(&mut self, id: RequestId, asked: lsp::ExecuteCommandParams) -> Option<Response> {
        let (order, checked) = match self.ordered(&asked) {
            Ok(ordered) => ordered,
            Err(error) => return Some(error.answer(id)),
        };
        let token = self.progress_token(&id, asked.work_done_progress_params.work_done_token);
        let begin = json!({ "kind": "begin", "title": order.title(&checked), "cancellable": true, "percentage": 0 });
        token.iter().for_each(|token| self.tell_progress(token, begin.clone()));
        self.runs.start(id, token, checked, order, self.world.clone());
        None
    }

    fn ordered(&mut self, asked: &lsp::ExecuteCommandParams) -> Result<(RunOrder, Arc<Checked>), RequestError> {
        let order = RunOrder::read(asked)?;
        if !self.shell.shows_results() {
            return Err(wording::no_place());
        }
        let checked = self.checked(&order.uri).ok_or_else(|| wording::not_open(&order.uri.0))?;
        Ok((order, checked))
    }

    /// The client's token, or one of the server's if the client shows progress that it did not begin.
    fn progress_token(&mut self, id: &RequestId, given: Option<ProgressToken>) -> Option<ProgressToken> {
        if given.is_some() || !self.abilities.shows_progress {
            return given;
        }
        let token = ProgressToken::String(format!("nbc {id}"));
        self.ask::<WorkDoneProgressCreateRequest>(WorkDoneProgressCreateParams { token: token.clone() });
        Some(token)
    }

    fn tell_progress(&self, token: &ProgressToken, value: Value) {
        let told = ProgressParams { token: token.clone(), value };
        self.send(Message::Notification(Notification::new("$/progress".to_owned(), told)));
    }

    pub(super) fn told(&mut self, event: RunEvent) {
        match event {
            RunEvent::Progress { token, percentage, message } => {
                let report = json!({ "kind": "report", "percentage": percentage, "message": message });
                self.tell_progress(&token, report);
            }
            RunEvent::Done { id, token, result } => {
                token.iter().for_each(|token| self.tell_progress(token, json!({ "kind": "end" })));
                self.runs.end(&id);
                self.send(Message::Response(match &result {
                    Ok(outcome) => Response::new_ok(id, outcome),
                    Err(error) => error.answer(id),
                }));
                result.iter().for_each(|outcome| self.show(outcome));
            }
        }
    }

    /// Some editors do not show the answer to a command.
    fn show(&self, outcome: &RunOutcome) {
        let message = match &outcome.path {
            Some(path) => format!("{}: {path}", outcome.text),
            None => outcome.text.clone(),
        };
        let shown = json!({ "type": 3, "message": message });
        self.send(Message::Notification(Notification::new("window/showMessage".to_owned(), shown)));
    }
}
