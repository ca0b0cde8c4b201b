// The bundled extension in an editor without a window, with the real `nbc`.

import assert from "node:assert/strict";
import { mkdtempSync, rmSync, writeFileSync } from "node:fs";
import Module, { createRequire } from "node:module";
import { tmpdir } from "node:os";
import * as path from "node:path";
import { after, test } from "node:test";
import { pathToFileURL } from "node:url";

import { Editor, Item } from "./fake";
import { NBC } from "./nbc";

const TESTED = `circuit g(a, b) -> (q) {
    q = a nand b
}

test g "is a nand" {
    a b | q
    0 0 | 1
    1 1 | 1
}

test g for all inputs { q = a and b }
`;

const folder = mkdtempSync(path.join(tmpdir(), "nbc-editor-"));
const loader = Module as unknown as { _load(request: string, ...rest: unknown[]): unknown };
const load = loader._load;
const started: { deactivate(): Promise<void> }[] = [];

after(async () => {
  await Promise.all(started.map(extension => extension.deactivate()));
  rmSync(folder, { recursive: true });
});

/** Activates the bundle in an editor. */
async function activate(editor: Editor): Promise<void> {
  const vscode = editor.module();
  loader._load = (request, ...rest) => (request === "vscode" ? vscode : load(request, ...rest));
  const require = createRequire(import.meta.url);
  const bundle = path.resolve("dist/extension.js");
  delete require.cache[bundle];
  const extension = require(bundle);
  loader._load = load;
  started.push(extension);
  const storage = vscode.Uri.file(folder);
  const context = { subscriptions: [], extensionUri: vscode.Uri.file(process.cwd()), storageUri: storage };
  await extension.activate({ ...context, globalStorageUri: storage });
}

/** An editor with a file that is open and saved. */
function editorWith(name: string, text: string, settings: Record<string, unknown> = { "nbc.path": NBC }): Editor {
  writeFileSync(path.join(folder, name), text);
  const editor = new Editor(folder, settings);
  editor.open(name, text);
  return editor;
}

const uri = (name: string) => pathToFileURL(path.join(folder, name)).href;

/** All items below an item, with itself. */
const below = (item: Item): Item[] => [item, ...[...item.children].flatMap(([, child]) => below(child))];

/** The items whose tests run with a profile. */
async function ran(editor: Editor, profile: string, include?: Item[]) {
  const token = { onCancellationRequested: () => ({ dispose() {} }), isCancellationRequested: false };
  await editor.profiles.get(profile)!({ include }, token);
  return editor.runs.at(-1)!;
}

test("the errors of an open file are published", async () => {
  const editor = editorWith("broken.nb", "circuit g(a) -> (q) { q = b }\n");
  const published = new Promise(resolve => editor.published.event(resolve));
  await activate(editor);
  await published;
  const [fault] = editor.diagnostics.get(uri("broken.nb"))!;
  assert.ok(fault !== undefined);
  assert.deepEqual(editor.shown, []);
});

test("the explorer lists tests and rows, and shows what each came to", async () => {
  const editor = editorWith("tested.nb", TESTED);
  await activate(editor);
  const file = editor.items.get(uri("tested.nb"))!;
  const labels = ["tested.nb", 'g "is a nand"', "0 0 | 1", "1 1 | 1", "g"];
  assert.deepEqual(
    below(file).map(item => item.label),
    labels,
  );

  const run = await ran(editor, "Run as Logic");
  assert.ok(run.ended);
  const last = new Map(run.states.map(state => [state.slice(state.indexOf(" ") + 1), state.split(" ")[0]]));
  assert.deepEqual(Object.fromEntries(last), {
    'g "is a nand"': "failed",
    "0 0 | 1": "passed",
    "1 1 | 1": "failed",
    g: "failed",
  });
  const [message] = run.messages.get("1 1 | 1")!;
  assert.equal(message!.message, "row 2: a=1 b=1 | q=0, expected 1");
  assert.deepEqual([message!.expectedOutput, message!.actualOutput], ["q = 1", "q = 0"]);
  assert.equal(message!.location!.range.line, 7);
  assert.equal(run.messages.get("g")!.length, 4);
  const [first] = run.states;
  assert.match(first!, /^enqueued/);
  assert.ok(run.states.includes("started 0 0 | 1"));
});

test("the explorer proves what a program claims, and shows the test that refutes it", async () => {
  const claimed = `circuit toggle(t, clk) -> (q) { q = register(t xor q, clk) }
prove toggle "turns" {
    always q == (before(q) xor t)
    never  q
}
test toggle { t clk | q
    1 ^ | 1
}
`;
  const editor = editorWith("claimed.nb", claimed);
  await activate(editor);
  const run = await ran(editor, "Run as Logic");
  const told = run.states.filter(state => /^(passed|failed|errored)/.test(state));
  assert.deepEqual(told, [
    'failed toggle "turns"',
    "passed always q == (before(q) xor t)",
    "failed never q",
    "passed toggle",
    "passed 1 ^ | 1",
  ]);
  const [message] = run.messages.get("never q")!;
  assert.match(message!.message, /^refuted after 2 steps\ntest toggle "never q" \{/);
  assert.equal(message!.location!.range.line, 3);
  const file = path.join(folder, "claimed.nb");
  assert.equal(editor.logged.at(-1), `${NBC} prove --format json ${file}`);
  await ran(editor, "Run", [below(editor.items.get(uri("claimed.nb"))!)[0]!]);
  assert.equal(editor.logged.at(-1), `${NBC} prove --format json ${file}`);
});

test("one row runs its whole test, and no other", async () => {
  const editor = editorWith("tested.nb", TESTED);
  await activate(editor);
  const items = below(editor.items.get(uri("tested.nb"))!);
  const row = items.find(item => item.label === "1 1 | 1")!;
  const run = await ran(editor, "Run", [row]);
  assert.ok(run.states.includes("passed 0 0 | 1") && run.states.includes("failed 1 1 | 1"));
  assert.ok(!run.states.some(state => state.endsWith(" g")), run.states.join());
  const file = path.join(folder, "tested.nb");
  assert.equal(editor.logged.at(-1), `${NBC} test --format json --only=is a nand ${file}`);
  // A test without a title is chosen by its circuit, which other tests may have too.
  const other = await ran(editor, "Run as Logic", [items.at(-1)!]);
  assert.deepEqual(other.states, ["enqueued g", "started g", "failed g"]);
  assert.equal(editor.logged.at(-1), `${NBC} test --format json --logic --only=g ${file}`);
  await ran(editor, "Run as Logic", items.slice(1));
  assert.equal(editor.logged.at(-1), `${NBC} test --format json --logic ${file}`);
});

test("some tests of a file run by their names", async () => {
  const more =
    TESTED + TESTED.replaceAll(" g", " h").replaceAll("is a nand", "--help").replace("(a, b)", "[n = 1](a, b)");
  const editor = editorWith("more.nb", more.replace("test h for", "test h[1] for"));
  await activate(editor);
  const chosen = below(editor.items.get(uri("more.nb"))!).filter(item => /^h/.test(item.label));
  const run = await ran(editor, "Run as Logic", chosen);
  const told = run.states.filter(state => /^(passed|failed|errored)/.test(state));
  assert.deepEqual(told, ['failed h "--help"', "passed 0 0 | 1", "failed 1 1 | 1", "failed h[1]"]);
  const only = editor.logged.slice(-2).map(line => /--only=\S+/.exec(line)![0]);
  assert.deepEqual(only, ["--only=--help", "--only=h"]);
});

test("a file with errors, and an editor without nbc, are errors of the tests", async () => {
  const editor = editorWith("faulty.nb", TESTED.replace("a nand b", "a nand bb"));
  await activate(editor);
  const run = await ran(editor, "Run");
  assert.ok(run.states.includes("errored 0 0 | 1"));
  assert.match(run.messages.get("g")![0]!.message, /no net is called `bb`/);

  const without = editorWith("tested.nb", TESTED, { "nbc.path": "/no/nbc" });
  await activate(without);
  assert.match(without.shown[0]!, /`\/no\/nbc`: there is no such file/);
  const none = await ran(without, "Run");
  assert.ok(none.states.includes("errored g"));
  await without.commands.get("nbc.runFile")!();
  assert.match(without.shown.at(-1)!, /Open a program/);
});

test("a run that is cancelled skips its tests", async () => {
  const editor = editorWith("tested.nb", TESTED);
  await activate(editor);
  editor.changed = (run, state) => state === "started" && run.source.cancel();
  const run = await ran(editor, "Run in Physics");
  assert.ok(run.ended);
  assert.ok(run.states.includes("skipped 0 0 | 1"), run.states.join());
  assert.ok(!run.states.some(state => /^(passed|failed)/.test(state)), run.states.join());
});

test("a continuous run runs a file's tests when it is saved, until it is stopped", async () => {
  const editor = editorWith("tested.nb", TESTED);
  await activate(editor);
  const source = new editor.CancellationTokenSource();
  await editor.profiles.get("Run as Logic")!({ continuous: true }, source.token);
  assert.equal(editor.runs.length, 0);
  const passed = new Promise(resolve => (editor.changed = (_, state) => state === "passed" && resolve(state)));
  editor.saved.fire(editor.documents[0]!);
  await passed;
  assert.equal(editor.runs.length, 1);
  source.cancel();
  editor.saved.fire(editor.documents[0]!);
  assert.equal(editor.runs.length, 1);
});

test("a lens runs its test, and the panel shows the report", async () => {
  const editor = editorWith("tested.nb", TESTED);
  await activate(editor);
  const token = { onCancellationRequested: () => ({ dispose() {} }), isCancellationRequested: false };
  const lenses = await editor.lenses[0]!.provideCodeLenses(editor.documents[0], token);
  const lens = lenses.find(({ command }) => command.title === "run as logic");
  assert.ok(lens !== undefined, JSON.stringify(lenses));
  await editor.commands.get(lens.command.command)!(...lens.command.arguments);
  const [panel] = editor.panels;
  assert.equal(panel!.title, "tested.nb");
  assert.match(panel!.webview.html, /script-src 'nonce-\w+'/);
  assert.ok(panel!.webview.html.includes("is a nand"));

  await editor.commands.get("nbc.drawFile")!(editor.documents[0]!.uri);
  assert.match(panel!.webview.html, /<img alt="tested\.nb" src="data:image\/svg\+xml/);
  assert.ok(!editor.shown.some(text => text.startsWith("nbc: ")), editor.shown.join("\n"));
});

test("a run of a lens reports its progress, and is cancelled by its notification", async () => {
  const editor = editorWith("tested.nb", TESTED);
  await activate(editor);
  const steps: string[] = [];
  editor.progressed = ({ message }, source) => {
    steps.push(message);
    source.cancel();
  };
  await editor.commands.get("nbc.run")!({ uri: uri("tested.nb") });
  assert.equal(steps[0], "simulating tested.nb");
  assert.equal(editor.panels.length, 0);
  assert.deepEqual(editor.shown, []);
});

test("when a setting changes, the server asks for new lenses", async () => {
  const editor = editorWith("tested.nb", TESTED);
  await activate(editor);
  const token = { onCancellationRequested: () => ({ dispose() {} }), isCancellationRequested: false };
  const lenses = editor.lenses[0]!;
  assert.ok((await lenses.provideCodeLenses(editor.documents[0], token)).length > 0);
  const changed = new Promise<void>(resolve => lenses.onDidChangeCodeLenses(resolve));
  editor.settings["nbc.codeLenses"] = false;
  editor.configured.fire({ affectsConfiguration: name => name === "nbc" });
  await changed;
  assert.deepEqual((await lenses.provideCodeLenses(editor.documents[0], token)) ?? [], []);
});

test("when the setting changes, nbc is looked for again", async () => {
  const editor = editorWith("broken.nb", "circuit g(a) -> (q) { q = b }\n", { "nbc.path": "/no/nbc" });
  await activate(editor);
  assert.equal(editor.diagnostics.size, 0);
  const published = new Promise(resolve => editor.published.event(resolve));
  editor.settings["nbc.path"] = NBC;
  editor.configured.fire({ affectsConfiguration: () => true });
  await published;
  assert.equal(editor.diagnostics.get(uri("broken.nb"))!.length, 1);
});
