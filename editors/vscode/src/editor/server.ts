// The language server `nbc lsp`, and the client that vscode-languageclient makes of this editor.

import { randomUUID } from "node:crypto";

import * as vscode from "vscode";
import {
  DidChangeConfigurationNotification,
  ExecuteCommandRequest,
  LanguageClient,
  type LanguageClientOptions,
  WorkDoneProgress,
} from "vscode-languageclient/node";

import { type Order, shownOf } from "../core/outcome";
import type { Panel } from "./panel";
import type { Program } from "./program";

type Progress = vscode.Progress<{ message?: string; increment?: number }>;

const WATCHED = "**/*.{nb,blif,csv,pla,aig,aag,bench,v,sv}";

/** The server's reason for a run that the user stopped. */
const CANCELLED = "cancelled";

/** Keeps one language server running while there is an `nbc`. */
export class Server implements vscode.Disposable {
  private client: LanguageClient | undefined;
  /** A start waits for the stop before it, and the other way round. */
  private last: Promise<void> = Promise.resolve();
  private readonly watcher = vscode.workspace.createFileSystemWatcher(WATCHED);
  private readonly subscriptions: vscode.Disposable[];

  constructor(
    private readonly program: Program,
    private readonly log: vscode.LogOutputChannel,
    private readonly panel: Panel,
  ) {
    this.subscriptions = [
      this.watcher,
      program.onDidMove(() => this.restart()),
      vscode.workspace.onDidChangeConfiguration(change => change.affectsConfiguration("nbc") && this.tellSettings()),
    ];
  }

  restart(): Promise<void> {
    this.last = this.last
      .then(() => this.stop())
      .then(() => this.start())
      .catch((error: unknown) => this.log.error(`the language server did not start: ${error}`));
    return this.last;
  }

  /** Stops the server; the window closes. */
  end(): Promise<void> {
    this.last = this.last.then(() => this.stop());
    return this.last;
  }

  /** Runs a command of the server on a whole file, as its lenses do on a declaration. */
  async order(order: Order, file: vscode.Uri): Promise<void> {
    await this.last;
    const known = this.client?.initializeResult?.capabilities.executeCommandProvider?.commands ?? [];
    if (!known.includes(order)) {
      const missing = this.client === undefined ? "`nbc` was not found." : "This needs a newer `nbc`.";
      await vscode.window.showErrorMessage(missing);
      return;
    }
    // The server knows open texts only.
    await vscode.workspace.openTextDocument(file);
    await this.perform(order, [{ uri: file.toString() }]);
  }

  dispose(): void {
    this.subscriptions.forEach(one => one.dispose());
  }

  private async start(): Promise<void> {
    const command = await this.program.path();
    if (command === undefined) {
      return;
    }
    this.client = new LanguageClient("nbc", "nbc", { command, args: ["lsp"] }, this.options());
    await this.client.start();
  }

  private async stop(): Promise<void> {
    const client = this.client;
    this.client = undefined;
    // A server that crashed has nothing to stop.
    await client?.dispose().catch((error: unknown) => this.log.warn(String(error)));
  }

  /** Tells the server its settings; it asks for new lenses and hints itself. */
  private async tellSettings(): Promise<void> {
    // The next server starts with them.
    await this.last;
    const client = this.client;
    if (!client?.isRunning()) {
      return;
    }
    await client.sendNotification(DidChangeConfigurationNotification.type, { settings: { nbc: settings() } });
  }

  private options(): LanguageClientOptions {
    return {
      documentSelector: [{ scheme: "file", language: "nb" }],
      synchronize: { fileEvents: this.watcher },
      initializationOptions: settings(),
      outputChannel: this.log,
      middleware: { executeCommand: (command, args) => this.perform(command, args) },
    };
  }

  /** Runs a command of the server with a notification that can stop it, and shows its result in the panel. */
  private async perform(command: string, args: unknown[]): Promise<void> {
    const place = { location: vscode.ProgressLocation.Notification, title: "nbc", cancellable: true };
    try {
      const answer = await vscode.window.withProgress(place, (progress, token) =>
        this.request(command, args, progress, token),
      );
      const shown = shownOf(command, args[0], answer);
      if (shown !== undefined) {
        await this.panel.show(shown);
      }
    } catch (error) {
      const reason = error instanceof Error ? error.message : String(error);
      this.log.warn(`${command}: ${reason}`);
      if (reason !== CANCELLED) {
        await vscode.window.showErrorMessage(`nbc: ${reason}`);
      }
    }
  }

  private async request(command: string, args: unknown[], progress: Progress, token: vscode.CancellationToken) {
    const workDoneToken = randomUUID();
    let [title, done] = ["", 0];
    const listener = this.client?.onProgress(WorkDoneProgress.type, workDoneToken, told => {
      if (told.kind === "begin") {
        title = told.title;
        progress.report({ message: title });
      } else if (told.kind === "report") {
        const percentage = told.percentage ?? done;
        progress.report({ message: `${title}, ${told.message ?? ""}`, increment: percentage - done });
        done = percentage;
      }
    });
    try {
      const order = { command, arguments: args, workDoneToken };
      const answer: unknown = await this.client?.sendRequest(ExecuteCommandRequest.type, order, token);
      return answer;
    } finally {
      listener?.dispose();
    }
  }
}

function settings(): vscode.WorkspaceConfiguration {
  return vscode.workspace.getConfiguration("nbc");
}
