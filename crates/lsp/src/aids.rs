//! Requests about a place in a text: hover, completion, signature help and fixes.

use std::sync::Arc;

use gen_lsp_types::{self as lsp, CodeActionRequest, CompletionRequest, InlayHintRequest, SignatureHelpRequest};
use lsp_server::{Message, RequestId, Response};

use crate::compiler::FigureState;
use crate::figures::{Figures, Subject};
use crate::files::Files;
use crate::later::{PATIENCE, WaitingHover};
use crate::service::{Reply, Server};
use crate::spot::Spot;
use crate::{completion, hints, hover, problems, signature};
use nbc_base::source::Span;
use nbc_session::Checked;

impl Server {
    /// Waits a short time for figures that must be compiled first.
    pub(super) fn hover(&mut self, id: RequestId, asked: lsp::HoverParams) -> Option<Response> {
        let place = asked.text_document_position_params;
        let Some(checked) = self.checked(&place.text_document.uri) else { return Some(Response::new_ok(id, ())) };
        let files = self.files(&checked);
        let spot = Spot::of(files, place.position);
        let shown = spot.and_then(|spot| hover::show(&spot, self.settings.pictures));
        let Some(shown) = shown else { return Some(Response::new_ok(id, ())) };
        let range = Some(files.range(shown.place));
        let figures = match &shown.subject {
            None => None,
            Some(subject) => match self.compiler.ask(&checked, subject) {
                FigureState::Done(figures) => figures.cloned(),
                FigureState::NotYet => {
                    let (path, subject) = (checked.path.clone(), subject.clone());
                    let (text, until) = (shown.text, self.now + PATIENCE);
                    self.waiting.push(WaitingHover { id, path, subject, range, text, until });
                    return None;
                }
            },
        };
        Some(Response::new_ok(id, hover_of(shown.text, figures.as_ref(), range)))
    }

    pub(super) fn answer_hovers(&mut self) {
        for waiting in std::mem::take(&mut self.waiting) {
            let known = self.compiler.known(&waiting.path, &waiting.subject);
            if known.is_none() && !waiting.left(self.now).is_zero() {
                self.waiting.push(waiting);
                continue;
            }
            let hover = hover_of(waiting.text, known.flatten(), waiting.range);
            self.send(Message::Response(Response::new_ok(waiting.id, hover)));
        }
    }

    pub(super) fn fixes(&mut self, asked: lsp::CodeActionParams) -> Reply<CodeActionRequest> {
        let checked = self.checked(&asked.text_document.uri);
        let Some(checked) = checked else { return Ok(None) };
        let (world, shell) = (self.world.clone(), self.shell.clone());
        let files = Files { checked: &checked, encoding: self.encoding, world: &world, shell: &*shell };
        let mut fixes = problems::fixes(&files, &files.own(), asked.range);
        for (diagnostic, found) in problems::unused(&files, &files.own(), asked.range) {
            let new = format!("_{}", checked.sources.text(found.declared));
            if let Ok(edit) = self.renamed(&checked, found, &new) {
                fixes.push(problems::rename(&files, diagnostic, &new, edit));
            }
        }
        Ok(Some(fixes))
    }

    pub(super) fn hints(&mut self, asked: lsp::InlayHintParams) -> Reply<InlayHintRequest> {
        let Some(checked) = self.checked(&asked.text_document.uri) else { return Ok(None) };
        let Some(file) = checked.file else { return Ok(None) };
        let (world, shell) = (self.world.clone(), self.shell.clone());
        let files = Files { checked: &checked, encoding: self.encoding, world: &world, shell: &*shell };
        let bytes = files.lines(file).bytes(asked.range);
        let part = Span::new(file, bytes.start, bytes.end);
        let mut found = hints::of(&files, file, part, self.settings.inlay_hints);
        if self.settings.inlay_hints.robots {
            for (circuit, subject) in hints::circuits(&files, file, part) {
                if let Some(summary) = self.summary(&checked, &subject) {
                    found.push(hints::robots(&files, circuit, &summary));
                }
            }
        }
        Ok(Some(found))
    }

    /// `None` if they are not compiled yet; the client is asked to request them again when they are.
    pub(super) fn summary(&mut self, checked: &Arc<Checked>, subject: &Subject) -> Option<String> {
        match self.compiler.ask(checked, subject) {
            FigureState::Done(Some(Figures::Circuit(figures))) => Some(figures.summary()),
            FigureState::Done(_) => None,
            FigureState::NotYet => {
                self.is_outdated = true;
                None
            }
        }
    }

    pub(super) fn complete(&mut self, asked: lsp::CompletionParams) -> Reply<CompletionRequest> {
        let place = asked.text_document_position_params;
        let Some(checked) = self.checked(&place.text_document.uri) else { return Ok(None) };
        let spot = Spot::of(self.files(&checked), place.position);
        let typed = asked.context.and_then(|context| context.trigger_character);
        Ok(spot.map(|spot| completion::items(&spot, typed.as_deref()).into()))
    }

    pub(super) fn signature(&mut self, asked: lsp::SignatureHelpParams) -> Reply<SignatureHelpRequest> {
        let place = asked.text_document_position_params;
        let Some(checked) = self.checked(&place.text_document.uri) else { return Ok(None) };
        Ok(Spot::of(self.files(&checked), place.position).and_then(|spot| signature::help(&spot)))
    }
}

fn hover_of(mut text: String, figures: Option<&Figures>, range: Option<lsp::Range>) -> lsp::Hover {
    if let Some(figures) = figures {
        text.push_str(&format!("\n{}\n", figures.describe()));
    }
    let contents = lsp::MarkupContent { kind: lsp::MarkupKind::Markdown, value: text };
    lsp::Hover { contents: contents.into(), range }
}
