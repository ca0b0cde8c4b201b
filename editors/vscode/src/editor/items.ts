// The items of the test explorer: files, the tests that they declare, and the rows of each test.

import * as path from "node:path";

import * as vscode from "vscode";

import { declaredTests, type DeclaredTest } from "../core/declared";
import { isProgram, openDocument } from "./files";

/** Folders of results and of evolution runs have no programs of their own. */
const SKIPPED = "**/{node_modules,target,out}/**";

/** Milliseconds without typing before the items follow. */
const REST = 300;

/** Items follow the files, saved or not. */
export class Items implements vscode.Disposable {
  private readonly declared = new WeakMap<vscode.TestItem, DeclaredTest>();
  private readonly resting = new Map<string, NodeJS.Timeout>();
  private readonly subscriptions: vscode.Disposable[];

  constructor(private readonly controller: vscode.TestController) {
    const watcher = vscode.workspace.createFileSystemWatcher("**/*.nb");
    this.subscriptions = [
      watcher,
      watcher.onDidCreate(file => this.refresh(file)),
      watcher.onDidChange(file => this.refresh(file)),
      watcher.onDidDelete(file => controller.items.delete(file.toString())),
      vscode.workspace.onDidOpenTextDocument(
        document => isProgram(document) && this.update(document.uri, document.getText()),
      ),
      vscode.workspace.onDidChangeTextDocument(({ document }) => isProgram(document) && this.rest(document)),
    ];
    controller.refreshHandler = () => this.discover();
  }

  async discover(): Promise<void> {
    const found = await vscode.workspace.findFiles("**/*.nb", SKIPPED);
    const open = vscode.workspace.textDocuments.filter(isProgram).map(document => document.uri);
    await Promise.all([...found, ...open].map(file => this.refresh(file)));
  }

  async refresh(file: vscode.Uri): Promise<vscode.TestItem | undefined> {
    try {
      const text = openDocument(file)?.getText() ?? new TextDecoder().decode(await vscode.workspace.fs.readFile(file));
      return this.update(file, text);
    } catch {
      this.controller.items.delete(file.toString());
      return undefined;
    }
  }

  /** The declaration of an item; `undefined` for files and rows. */
  test(item: vscode.TestItem): DeclaredTest | undefined {
    return this.declared.get(item);
  }

  dispose(): void {
    this.resting.forEach(clearTimeout);
    this.subscriptions.forEach(one => one.dispose());
  }

  private rest(document: vscode.TextDocument): void {
    const key = document.uri.toString();
    clearTimeout(this.resting.get(key));
    const update = () => {
      this.resting.delete(key);
      const item = this.update(document.uri, document.getText());
      // Results are of the text before.
      this.controller.invalidateTestResults(item);
    };
    this.resting.set(key, setTimeout(update, REST));
  }

  private update(file: vscode.Uri, text: string): vscode.TestItem | undefined {
    const tests = declaredTests(text);
    const key = file.toString();
    if (tests.length === 0) {
      this.controller.items.delete(key);
      return undefined;
    }
    const known = this.controller.items.get(key);
    const item = known ?? this.controller.createTestItem(key, path.basename(file.fsPath), file);
    const folder = path.dirname(vscode.workspace.asRelativePath(file));
    item.description = folder === "." ? "" : folder;
    const names = new Map<string, number>();
    const children = tests.map((test, at) => {
      const name = `${test.circuit} ${test.title}`;
      const copies = (names.get(name) ?? 0) + 1;
      names.set(name, copies);
      return this.testItem(item, `${name} ${copies}`, test, at);
    });
    item.children.replace(children);
    if (known === undefined) {
      this.controller.items.add(item);
    }
    return item;
  }

  private testItem(file: vscode.TestItem, id: string, test: DeclaredTest, at: number): vscode.TestItem {
    const label = test.title === "" ? test.circuit : `${test.circuit} "${test.title}"`;
    const item = this.child(file, id, label, at);
    item.range = new vscode.Range(test.line, 0, test.endLine, 0);
    item.children.replace(
      test.rows.map((row, number) => {
        const child = this.child(item, `row ${number + 1}`, row.text, number);
        child.range = new vscode.Range(row.line, 0, row.line, 0);
        return child;
      }),
    );
    this.declared.set(item, test);
    return item;
  }

  /** The child with this identity, as it is known or new; what is known keeps its results. */
  private child(parent: vscode.TestItem, id: string, label: string, at: number): vscode.TestItem {
    const child = parent.children.get(id) ?? this.controller.createTestItem(id, label, parent.uri);
    child.label = label;
    child.sortText = String(at).padStart(6, "0");
    return child;
  }
}
