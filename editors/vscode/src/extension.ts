// The extension: finds `nbc`, starts its language server, and offers runs and tests.

import * as vscode from "vscode";

import { Explorer } from "./editor/explorer";
import { Panel } from "./editor/panel";
import { Program } from "./editor/program";
import { Server } from "./editor/server";

let server: Server | undefined;

export async function activate(context: vscode.ExtensionContext): Promise<void> {
  const log = vscode.window.createOutputChannel("nbc", { log: true });
  const program = new Program(vscode.Uri.joinPath(context.extensionUri, "INSTALL.md"), log);
  const panel = new Panel();
  const explorer = new Explorer(program, log);
  const started = new Server(program, log, panel);
  server = started;
  context.subscriptions.push(log, program, panel, explorer, started);

  const command = (name: string, call: (...args: never[]) => unknown) =>
    context.subscriptions.push(vscode.commands.registerCommand(name, call));
  command("nbc.runFile", (file?: vscode.Uri) => withFile(file, file => started.order("nbc.run", file)));
  command("nbc.drawFile", (file?: vscode.Uri) => withFile(file, file => started.order("nbc.schematic", file)));
  command("nbc.testFile", (file?: vscode.Uri) => withFile(file, file => started.order("nbc.test", file)));
  command("nbc.showReport", () => panel.showLastReport());
  command("nbc.openReport", () => panel.lastReport && vscode.env.openExternal(vscode.Uri.file(panel.lastReport)));
  command("nbc.restartServer", () => program.retry());
  command("nbc.showOutput", () => log.show());

  await Promise.all([started.restart(), explorer.items.discover()]);
}

export async function deactivate(): Promise<void> {
  await server?.end();
}

/** Calls with a file, or with the one in the active editor. */
async function withFile(file: vscode.Uri | undefined, call: (file: vscode.Uri) => Promise<void>): Promise<void> {
  const active = vscode.window.activeTextEditor?.document;
  const chosen = file ?? (active?.languageId === "nb" ? active.uri : undefined);
  if (chosen === undefined) {
    await vscode.window.showInformationMessage("Open a program (.nb) first.");
    return;
  }
  await call(chosen);
}
