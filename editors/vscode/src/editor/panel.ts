// The panel beside the editor: the report page of the last run, a schematic or a list of times.

import { randomBytes } from "node:crypto";
import { readFile } from "node:fs/promises";

import * as vscode from "vscode";

import type { Shown } from "../core/outcome";
import { drawingPage, type Frame, messagePage, reportPage, textPage } from "../core/page";

/** One panel in a window; what is shown later replaces what was shown before. */
export class Panel implements vscode.Disposable {
  private view: vscode.WebviewPanel | undefined;
  private shown: Shown | undefined;
  private report: Extract<Shown, { kind: "report" }> | undefined;
  private readonly subscription = vscode.window.onDidChangeActiveColorTheme(() => this.draw());

  get lastReport(): string | undefined {
    return this.report?.file;
  }

  /** Shows a page, beside the editor if there is no panel yet. */
  async show(shown: Shown): Promise<void> {
    if (shown.kind === "report") {
      this.report = shown;
      await vscode.commands.executeCommand("setContext", "nbc.hasReport", true);
    }
    this.shown = shown;
    this.view ??= this.open();
    this.view.reveal(undefined, true);
    await this.draw();
  }

  async showLastReport(): Promise<void> {
    if (this.report === undefined) {
      await vscode.window.showInformationMessage("There is no report yet: run a file first.");
      return;
    }
    await this.show(this.report);
  }

  dispose(): void {
    this.subscription.dispose();
    this.view?.dispose();
  }

  private open(): vscode.WebviewPanel {
    const place = { viewColumn: vscode.ViewColumn.Beside, preserveFocus: true };
    // Pages load nothing, so no folder is open to them.
    const options = { enableScripts: true, localResourceRoots: [], retainContextWhenHidden: true };
    const view = vscode.window.createWebviewPanel("nbc.report", "nbc", place, options);
    view.onDidDispose(() => (this.view = undefined));
    return view;
  }

  private async draw(): Promise<void> {
    const [view, shown] = [this.view, this.shown];
    if (view === undefined || shown === undefined) {
      return;
    }
    const page = await pageOf(shown);
    // Something else may have been shown meanwhile.
    if (this.shown === shown && this.view === view) {
      view.title = shown.title;
      view.webview.html = page;
    }
  }
}

async function pageOf(shown: Shown): Promise<string> {
  if (shown.kind === "text") {
    return textPage(shown.title, shown.text);
  }
  try {
    const text = await readFile(shown.file, "utf8");
    return shown.kind === "report" ? reportPage(text, frame()) : drawingPage(shown.title, text);
  } catch (error) {
    return messagePage(`${shown.file} cannot be read: ${String(error)}`);
  }
}

function frame(): Frame {
  const { kind } = vscode.window.activeColorTheme;
  const dark = kind === vscode.ColorThemeKind.Dark || kind === vscode.ColorThemeKind.HighContrast;
  return { nonce: randomBytes(16).toString("hex"), dark };
}
