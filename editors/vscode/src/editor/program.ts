// The program `nbc` of this window: found once, and again when something changes that decides where it is.

import { homedir } from "node:os";

import * as vscode from "vscode";

import { machine } from "../core/child";
import { explain, locate, type Located } from "../core/locate";

export class Program implements vscode.Disposable {
  private located: Promise<Located> | undefined;
  private readonly status = vscode.languages.createLanguageStatusItem("nbc", { language: "nb" });
  private readonly moved = new vscode.EventEmitter<void>();
  private readonly subscriptions: vscode.Disposable[];

  /** Another program may be the right one now. */
  readonly onDidMove = this.moved.event;

  constructor(
    private readonly help: vscode.Uri,
    private readonly log: vscode.LogOutputChannel,
  ) {
    this.status.name = "nbc";
    this.subscriptions = [
      this.status,
      this.moved,
      vscode.workspace.onDidChangeConfiguration(change => change.affectsConfiguration("nbc.path") && this.retry()),
      vscode.workspace.onDidGrantWorkspaceTrust(() => this.retry()),
      vscode.workspace.onDidChangeWorkspaceFolders(() => this.retry()),
    ];
  }

  /** The path of `nbc`; without one, `undefined`, and the user is told how to get it once. */
  async path(): Promise<string | undefined> {
    this.located ??= this.locate();
    const located = await this.located;
    return located.kind === "found" ? located.program : undefined;
  }

  retry(): void {
    this.located = undefined;
    this.moved.fire();
  }

  dispose(): void {
    this.subscriptions.forEach(one => one.dispose());
  }

  private async locate(): Promise<Located> {
    const located = await locate(surroundings(), machine);
    this.status.command = { command: "nbc.showOutput", title: "Show Output" };
    if (located.kind === "found") {
      this.log.info(`${located.program}: version ${located.version}`);
      this.status.text = `nbc ${located.version}`;
      this.status.detail = located.program;
      this.status.severity = vscode.LanguageStatusSeverity.Information;
    } else {
      const message = explain(located);
      this.log.warn(message);
      this.status.text = "nbc not found";
      this.status.detail = message;
      this.status.severity = vscode.LanguageStatusSeverity.Warning;
      void this.offerHelp(message);
    }
    return located;
  }

  private async offerHelp(message: string): Promise<void> {
    const [install, settings, retry] = ["How to Install", "Open Settings", "Try Again"] as const;
    const chosen = await vscode.window.showWarningMessage(message, install, settings, retry);
    if (chosen === install) {
      await vscode.commands.executeCommand("markdown.showPreview", this.help);
    } else if (chosen === settings) {
      await vscode.commands.executeCommand("workbench.action.openSettings", "nbc.path");
    } else if (chosen === retry) {
      this.retry();
    }
  }
}

function surroundings() {
  const folders = vscode.workspace.workspaceFolders ?? [];
  return {
    setting: vscode.workspace.getConfiguration("nbc").get<string>("path", "").trim(),
    searchPath: process.env.PATH ?? "",
    home: homedir(),
    workspaces: folders.filter(folder => folder.uri.scheme === "file").map(folder => folder.uri.fsPath),
    trusted: vscode.workspace.isTrusted,
    windows: process.platform === "win32",
  };
}
