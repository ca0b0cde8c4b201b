// Files of the editor, as `nbc` reads them.

import * as vscode from "vscode";

/** Whether a document is a program on the disk. */
export function isProgram(document: vscode.TextDocument): boolean {
  return document.languageId === "nb" && document.uri.scheme === "file";
}

export function openDocument(file: vscode.Uri): vscode.TextDocument | undefined {
  return vscode.workspace.textDocuments.find(document => document.uri.toString() === file.toString());
}

/** Saves a file if it is open and changed; whether `nbc` now reads what the editor shows. */
export async function save(file: vscode.Uri): Promise<boolean> {
  const document = openDocument(file);
  return document === undefined || !document.isDirty || (await document.save());
}

/** The folder in which `nbc` runs for a file: evolution runs are in its `out`. */
export function folderOf(file: vscode.Uri): string {
  return (vscode.workspace.getWorkspaceFolder(file)?.uri ?? vscode.Uri.joinPath(file, "..")).fsPath;
}
