//! The requests that the server answers.

use std::panic::{AssertUnwindSafe, catch_unwind};

use gen_lsp_types::{
    self as lsp, CodeActionRequest, CodeLensRequest, CompletionRequest, DefinitionRequest, DocumentFormattingRequest,
    DocumentHighlightRequest, DocumentLinkRequest, DocumentRangeFormattingRequest, DocumentSymbolRequest,
    ExecuteCommandRequest, FoldingRangeRequest, HoverRequest, InlayHintRequest, LspRequestMethod, PrepareRenameRequest,
    ReferencesRequest, RenameRequest, SelectionRangeRequest, SemanticTokensRangeRequest, SemanticTokensRequest,
    SignatureHelpRequest, WorkspaceSymbolRequest,
};
use lsp_server::{Request, RequestId, Response};

use crate::service::{Reply, Server};
use crate::wording;

impl Server {
    /// `None` if the answer comes later.
    pub(super) fn request(&mut self, request: Request) -> Option<Response> {
        let method = request.method.clone();
        Some(match LspRequestMethod::from(method.as_str()) {
            LspRequestMethod::TextDocumentHover => return self.answer_later::<HoverRequest>(request, Self::hover),
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
            LspRequestMethod::TextDocumentSignatureHelp => {
                self.answer::<SignatureHelpRequest>(request, Self::signature)
            }
            LspRequestMethod::TextDocumentSelectionRange => {
                self.answer::<SelectionRangeRequest>(request, Self::selections)
            }
            LspRequestMethod::TextDocumentSemanticTokensFull => {
                self.answer::<SemanticTokensRequest>(request, Self::tokens)
            }
            LspRequestMethod::TextDocumentSemanticTokensRange => {
                self.answer::<SemanticTokensRangeRequest>(request, Self::some_tokens)
            }
            LspRequestMethod::TextDocumentInlayHint => self.answer::<InlayHintRequest>(request, Self::hints),
            LspRequestMethod::TextDocumentDocumentLink => self.answer::<DocumentLinkRequest>(request, Self::links),
            LspRequestMethod::TextDocumentRangeFormatting => {
                self.answer::<DocumentRangeFormattingRequest>(request, Self::format_range)
            }
            LspRequestMethod::WorkspaceSymbol => self.answer::<WorkspaceSymbolRequest>(request, Self::find),
            LspRequestMethod::TextDocumentCodeLens => self.answer::<CodeLensRequest>(request, Self::lenses),
            LspRequestMethod::WorkspaceExecuteCommand => {
                return self.answer_later::<ExecuteCommandRequest>(request, Self::execute);
            }
            _ => wording::unknown_method(&method).answer(request.id),
        })
    }

    /// If the handler panics, the answer is an error, and the server continues.
    fn answer<R: lsp::Request>(
        &mut self,
        request: Request,
        handle: impl FnOnce(&mut Self, R::Params) -> Reply<R>,
    ) -> Response {
        let respond = |server: &mut Self, id, parameters| {
            Some(match handle(server, parameters) {
                Ok(result) => Response::new_ok(id, result),
                Err(error) => error.answer(id),
            })
        };
        self.answer_later::<R>(request, respond).expect("it was answered")
    }

    fn answer_later<R: lsp::Request>(
        &mut self,
        request: Request,
        handle: impl FnOnce(&mut Self, RequestId, R::Params) -> Option<Response>,
    ) -> Option<Response> {
        let id = request.id;
        let parameters = match serde_json::from_value(request.params) {
            Ok(parameters) => parameters,
            Err(error) => return Some(wording::invalid_parameters(error.to_string()).answer(id)),
        };
        catch_unwind(AssertUnwindSafe(|| handle(self, id.clone(), parameters)))
            .unwrap_or_else(|_| Some(wording::internal().answer(id)))
    }
}
