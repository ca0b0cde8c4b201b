// An editor without a window: as much of the module `vscode` as the extension and its client need. What is not here is
// a function that does nothing and returns something like it, or a class without members.

import { EventEmitter } from "node:events";
import * as path from "node:path";
import { fileURLToPath, pathToFileURL } from "node:url";

/** Anything: it can be called, constructed, extended, and asked for any property. */
function anything(): any {
  const target = function () {};
  return new Proxy(target, {
    get: (_, name) => (name === "prototype" ? target.prototype : isAbsent(name) ? undefined : anything()),
    apply: () => anything(),
    construct: () => ({}),
  });
}

/** What has a meaning where it is present. */
function isAbsent(name: string | symbol): boolean {
  return typeof name === "symbol" || name === "then" || name === "toJSON";
}

/** Known members of an object, and anything for the others. */
function partly<T extends object>(known: T): T & Record<string, any> {
  // A bundle copies the known members of a module to an object with the same prototype.
  const others = anything();
  return new Proxy(known, {
    get: (target, name) => Reflect.get(name in target ? target : others, name),
    getPrototypeOf: () => others,
  }) as T & Record<string, any>;
}

class Disposable {
  constructor(private readonly call: () => void = () => {}) {}
  static from(...list: { dispose(): void }[]) {
    return new Disposable(() => list.forEach(one => one.dispose()));
  }
  dispose() {
    this.call();
  }
}

class Emitter<T> {
  private readonly emitter = new EventEmitter().setMaxListeners(0);
  readonly event = (listener: (value: T) => void, self?: unknown) => {
    const bound = listener.bind(self);
    this.emitter.on("fire", bound);
    return new Disposable(() => this.emitter.off("fire", bound));
  };
  fire(value: T) {
    this.emitter.emit("fire", value);
  }
  dispose() {
    this.emitter.removeAllListeners();
  }
}

class Position {
  constructor(
    readonly line: number,
    readonly character: number,
  ) {}
}

class Range {
  readonly start: Position;
  readonly end: Position;
  constructor(...numbers: any[]) {
    const [a, b, c, d] = numbers;
    this.start = typeof a === "number" ? new Position(a, b) : a;
    this.end = typeof a === "number" ? new Position(c, d) : b;
  }
}

class Uri {
  private constructor(private readonly url: URL) {}
  static parse(text: string) {
    return new Uri(new URL(text));
  }
  static file(file: string) {
    return new Uri(pathToFileURL(file));
  }
  static joinPath(base: Uri, ...parts: string[]) {
    return Uri.file(path.join(base.fsPath, ...parts));
  }
  get scheme() {
    return this.url.protocol.slice(0, -1);
  }
  get path() {
    return decodeURIComponent(this.url.pathname);
  }
  get fsPath() {
    return fileURLToPath(this.url);
  }
  with() {
    return this;
  }
  toString() {
    return this.url.href;
  }
}

class TestMessage {
  location?: { uri: Uri; range: Position };
  expectedOutput?: string;
  actualOutput?: string;
  constructor(readonly message: string) {}
  static diff(message: string, expected: string, actual: string) {
    return Object.assign(new TestMessage(message), { expectedOutput: expected, actualOutput: actual });
  }
}

class Diagnostic {
  constructor(
    readonly range: Range,
    readonly message: string,
    readonly severity?: number,
  ) {}
}

class Items implements Iterable<[string, Item]> {
  private map = new Map<string, Item>();
  constructor(private readonly owner?: Item) {}
  get size() {
    return this.map.size;
  }
  get = (id: string) => this.map.get(id);
  delete = (id: string) => this.map.delete(id);
  add(item: Item) {
    item.parent = this.owner;
    this.map.set(item.id, item);
  }
  replace(items: Item[]) {
    this.map = new Map();
    items.forEach(item => this.add(item));
  }
  forEach(call: (item: Item) => void) {
    this.map.forEach(item => call(item));
  }
  [Symbol.iterator]() {
    return this.map[Symbol.iterator]();
  }
}

export class Item {
  parent?: Item;
  range?: Range;
  sortText?: string;
  readonly children = new Items(this);
  constructor(
    readonly id: string,
    public label: string,
    readonly uri: Uri,
  ) {}
}

/** What happened to items, in order: `passed 0 0 | 1`. */
export class Run {
  readonly states: string[] = [];
  readonly messages = new Map<string, TestMessage[]>();
  readonly source = new CancellationTokenSource();
  readonly token = this.source.token;
  ended = false;
  private state = (name: string) => (item: Item, messages?: TestMessage | TestMessage[]) => {
    this.states.push(`${name} ${item.label}`);
    this.messages.set(item.label, [messages ?? []].flat());
    this.changed?.(name);
  };
  enqueued = this.state("enqueued");
  started = this.state("started");
  passed = this.state("passed");
  failed = this.state("failed");
  errored = this.state("errored");
  skipped = this.state("skipped");
  appendOutput() {}
  end() {
    this.ended = true;
  }
  constructor(private readonly changed?: (state: string) => void) {}
}

class CancellationTokenSource {
  private readonly emitter = new Emitter<void>();
  readonly token = { isCancellationRequested: false, onCancellationRequested: this.emitter.event };
  cancel() {
    this.token.isCancellationRequested = true;
    this.emitter.fire();
  }
  dispose() {}
}

class TestRunRequest {
  constructor(
    readonly include?: Item[],
    readonly exclude?: Item[],
    readonly profile?: unknown,
    readonly continuous?: boolean,
  ) {}
}

/** A document that is open. */
class Document {
  readonly languageId = "nb";
  readonly version = 1;
  readonly isDirty = false;
  readonly isClosed = false;
  constructor(
    readonly uri: Uri,
    private readonly text: string,
  ) {}
  getText = () => this.text;
}

/** An editor with a folder, its open documents and its settings. */
export class Editor {
  readonly diagnostics = new Map<string, any[]>();
  readonly commands = new Map<string, (...args: any[]) => any>();
  readonly profiles = new Map<string, (request: TestRunRequest, token: unknown) => Promise<void>>();
  readonly items = new Items();
  readonly runs: Run[] = [];
  readonly shown: string[] = [];
  readonly logged: string[] = [];
  readonly panels: { webview: { html: string }; title: string }[] = [];
  readonly lenses: {
    provideCodeLenses(document: unknown, token: unknown): Promise<any[]>;
    onDidChangeCodeLenses(listener: () => void): Disposable;
  }[] = [];
  readonly configured = new Emitter<{ affectsConfiguration(name: string): boolean }>();
  readonly published = new Emitter<string>();
  readonly CancellationTokenSource = CancellationTokenSource;
  readonly saved = new Emitter<Document>();
  readonly documents: Document[] = [];
  /** What to do at each state of an item of a run. */
  changed?: (run: Run, state: string) => void;
  /** What to do at each step of a notification. */
  progressed?: (step: any, source: CancellationTokenSource) => void;
  trusted = true;

  constructor(
    readonly folder: string,
    readonly settings: Record<string, unknown>,
  ) {}

  open(name: string, text: string): Document {
    const document = new Document(Uri.file(path.join(this.folder, name)), text);
    this.documents.push(document);
    return document;
  }

  /** The settings of a section that have no further parts. */
  private values(section: string): Record<string, unknown> {
    const own = Object.entries(this.settings).filter(([name]) => name.startsWith(`${section}.`));
    return Object.fromEntries(own.map(([name, value]) => [name.slice(section.length + 1), value]));
  }

  /** The module `vscode`. */
  module() {
    const workspaceFolder = { uri: Uri.file(this.folder), name: "here", index: 0 };
    const get = (section: string) => (name: string, otherwise: unknown) =>
      this.settings[`${section}.${name}`] ?? otherwise;
    return partly({
      ...{ version: "1.139.0", Disposable, EventEmitter: Emitter, Position, Range, Uri, TestMessage, TestRunRequest },
      ...{ CancellationTokenSource, Diagnostic },
      Location: class {
        constructor(
          readonly uri: Uri,
          readonly range: Position,
        ) {}
      },
      workspace: partly({
        workspaceFolders: [workspaceFolder],
        isTrusted: this.trusted,
        textDocuments: this.documents,
        notebookDocuments: [],
        fs: partly({ readFile: () => Promise.reject(new Error("nothing is on the disk")) }),
        getConfiguration: (section: string) => partly({ ...this.values(section), get: get(section) }),
        getWorkspaceFolder: () => workspaceFolder,
        asRelativePath: (uri: Uri) => path.relative(this.folder, uri.fsPath),
        findFiles: async () => [],
        openTextDocument: async () => this.documents[0],
        onDidChangeConfiguration: this.configured.event,
        onDidSaveTextDocument: this.saved.event,
      }),
      window: partly({
        visibleTextEditors: [],
        tabGroups: partly({ all: [] }),
        activeColorTheme: { kind: 2 },
        createOutputChannel: () =>
          partly({
            error: (text: string) => this.shown.push(text),
            info: (text: string) => this.logged.push(text),
          }),
        showWarningMessage: async (text: string) => void this.shown.push(text),
        showErrorMessage: async (text: string) => void this.shown.push(text),
        showInformationMessage: async (text: string) => void this.shown.push(text),
        withProgress: (_: unknown, task: any) => {
          const source = new CancellationTokenSource();
          return task({ report: (step: unknown) => this.progressed?.(step, source) }, source.token);
        },
        createWebviewPanel: () => {
          const panel = partly({ webview: { html: "" }, title: "" });
          this.panels.push(panel);
          return panel;
        },
      }),
      languages: partly({
        match: () => 10,
        createLanguageStatusItem: () => partly({}),
        registerCodeLensProvider: (_: unknown, provider: any) => {
          this.lenses.push(provider);
          return new Disposable();
        },
        createDiagnosticCollection: () =>
          partly({
            set: (uri: Uri, list: any[]) => {
              this.diagnostics.set(uri.toString(), list);
              this.published.fire(uri.toString());
            },
          }),
      }),
      commands: partly({
        registerCommand: (name: string, call: (...args: any[]) => any) => {
          this.commands.set(name, call);
          return new Disposable(() => this.commands.delete(name));
        },
        executeCommand: async () => undefined,
      }),
      tests: partly({ createTestController: () => this.controller() }),
      ColorThemeKind: { Light: 1, Dark: 2, HighContrast: 3, HighContrastLight: 4 },
      TestRunProfileKind: { Run: 1 },
    });
  }

  private controller() {
    return partly({
      items: this.items,
      createTestItem: (id: string, label: string, uri: Uri) => new Item(id, label, uri),
      createRunProfile: (name: string, _: number, handler: any) => this.profiles.set(name, handler),
      createTestRun: () => {
        const run: Run = new Run(state => this.changed?.(run, state));
        this.runs.push(run);
        return run;
      },
    });
  }
}
