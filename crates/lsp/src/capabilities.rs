//! The capabilities of the server and of its client.

use gen_lsp_types::{
    CodeActionKind, CodeActionOptions, CodeLensOptions, CompletionOptions, DocumentLinkOptions, ExecuteCommandOptions,
    PositionEncodingKind, RenameOptions, SemanticTokensOptions, ServerCapabilities, SignatureHelpOptions,
    TextDocumentSyncKind, TextDocumentSyncOptions, WorkspaceFoldersServerCapabilities, WorkspaceOptions,
};
use serde_json::Value;

use crate::position::Encoding;
use crate::settings::Settings;
use crate::workspace::Workspace;
use crate::{completion, runs, semantics};

/// Other parts of `initialize` are not read; those may be missing or wrong.
#[derive(Clone, Debug)]
pub(super) struct Client {
    pub(super) encoding: Encoding,
    pub(super) settings: Settings,
    pub(super) workspace: Workspace,
    pub(super) abilities: Abilities,
}

#[derive(Clone, Copy, Debug)]
pub(super) struct Abilities {
    pub(super) refreshes_lenses: bool,
    pub(super) refreshes_hints: bool,
    pub(super) refreshes_tokens: bool,
    pub(super) shows_progress: bool,
    pub(super) watches_files: bool,
}

impl Client {
    pub(super) fn of(parameters: &Value) -> Self {
        let encodings = parameters.pointer("/capabilities/general/positionEncodings").cloned().unwrap_or_default();
        let encodings: Vec<PositionEncodingKind> = serde_json::from_value(encodings).unwrap_or_default();
        let can =
            |path: &str| parameters.pointer(&format!("/capabilities{path}")).and_then(Value::as_bool) == Some(true);
        Self {
            encoding: Encoding::negotiated(&encodings),
            settings: Settings::of_client(parameters),
            workspace: Workspace::of(parameters),
            abilities: Abilities {
                refreshes_lenses: can("/workspace/codeLens/refreshSupport"),
                refreshes_hints: can("/workspace/inlayHint/refreshSupport"),
                refreshes_tokens: can("/workspace/semanticTokens/refreshSupport"),
                shows_progress: can("/window/workDoneProgress"),
                watches_files: can("/workspace/didChangeWatchedFiles/dynamicRegistration"),
            },
        }
    }
}

pub(super) fn capabilities(encoding: Encoding) -> ServerCapabilities {
    let sync = TextDocumentSyncOptions {
        open_close: Some(true),
        change: Some(TextDocumentSyncKind::Incremental),
        ..TextDocumentSyncOptions::default()
    };
    let tokens = SemanticTokensOptions {
        legend: semantics::legend(),
        range: Some(true.into()),
        full: Some(true.into()),
        ..SemanticTokensOptions::default()
    };
    let folders = WorkspaceFoldersServerCapabilities { supported: Some(true), change_notifications: Some(true.into()) };
    let quick_fixes = vec![CodeActionKind::QuickFix];
    ServerCapabilities {
        position_encoding: Some(encoding.kind()),
        text_document_sync: Some(sync.into()),
        hover_provider: Some(true.into()),
        definition_provider: Some(true.into()),
        references_provider: Some(true.into()),
        document_highlight_provider: Some(true.into()),
        document_symbol_provider: Some(true.into()),
        document_formatting_provider: Some(true.into()),
        folding_range_provider: Some(true.into()),
        code_action_provider: Some(
            CodeActionOptions { code_action_kinds: Some(quick_fixes), ..CodeActionOptions::default() }.into(),
        ),
        rename_provider: Some(RenameOptions { prepare_provider: Some(true), ..RenameOptions::default() }.into()),
        completion_provider: Some(CompletionOptions {
            trigger_characters: Some(completion::TRIGGERS.map(str::to_owned).to_vec()),
            ..CompletionOptions::default()
        }),
        signature_help_provider: Some(SignatureHelpOptions {
            trigger_characters: Some(["(", "[", ","].map(str::to_owned).to_vec()),
            ..SignatureHelpOptions::default()
        }),
        code_lens_provider: Some(CodeLensOptions::default()),
        execute_command_provider: Some(ExecuteCommandOptions {
            commands: runs::COMMANDS.map(str::to_owned).to_vec(),
            ..ExecuteCommandOptions::default()
        }),
        selection_range_provider: Some(true.into()),
        semantic_tokens_provider: Some(tokens.into()),
        inlay_hint_provider: Some(true.into()),
        document_link_provider: Some(DocumentLinkOptions::default()),
        document_range_formatting_provider: Some(true.into()),
        workspace_symbol_provider: Some(true.into()),
        workspace: Some(WorkspaceOptions { workspace_folders: Some(folders), ..WorkspaceOptions::default() }),
        ..ServerCapabilities::default()
    }
}
