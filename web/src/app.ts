// The page as a whole: its parts, and what happens when the server is found, lost and found again.

import { Connection, type ConnectionState } from "./connection";
import { EditPanel } from "./editor/panel";
import { LanguageServer } from "./editor/server";
import { button } from "./element";
import { Header } from "./header";
import { Layout } from "./layout";
import { ClassPanel } from "./learn/class";
import { lessonAddress, lessonPath, Lessons } from "./learn/lessons";
import { LearnPanel } from "./learn/panel";
import type { Ways } from "./line";
import { SwarmPanel } from "./live/panel";
import { LiveSwarm } from "./live/swarm";
import { paper } from "./print";
import { Places } from "./place";
import { Program, type Choice, type Origin } from "./program";
import type { Greeting } from "./protocol";
import { RobotsPanel } from "./robots/panel";
import { TakeAway } from "./take";
import { recall, remember } from "./memory";
import { isShare, type SharedProgram } from "./share/link";
import { sharedBits } from "./share/share";
import { TestsPanel } from "./tests/panel";
import { prefersStillness } from "./theme";
import { Welcome } from "./welcome";

const LATCH = "latch";
/** The name under which the program that was shown last is remembered. */
const LAST = "last-program";

export class App {
  readonly #connection: Connection;
  readonly #language: LanguageServer;
  readonly #swarm: LiveSwarm;
  readonly #program: Program;
  readonly #edit: EditPanel;
  readonly #header = new Header();
  readonly #lessons: Lessons;
  readonly #class: ClassPanel;
  readonly #layout: Layout;
  readonly #learn: LearnPanel;
  readonly #paper: HTMLElement;
  readonly #places = new Places(tab => this.#layout.show(tab));
  #begun = false;
  #lessonsRead: Promise<void> = Promise.resolve();

  constructor(
    private readonly ways: Ways,
    preferred: Choice | null = null,
  ) {
    ways.status.follow(text => this.#header.showStatus(text));
    this.#connection = new Connection(ways.live);
    this.#language = new LanguageServer(ways.language);
    this.#swarm = new LiveSwarm(this.#connection);
    this.#program = new Program(this.#connection, this.#swarm);
    this.#program.preferred = preferred;
    this.#edit = new EditPanel(this.#connection, this.#program, this.#language, {
      folder: ways.folder,
      shared: shared => this.#share(shared),
      shown: isSame => this.#place(isSame),
    });
    this.#lessons = new Lessons(this.#connection);
    this.#class = new ClassPanel(this.#connection);
    const take = new TakeAway(this.#connection, ways, this.#program, this.#swarm, () => this.#layout.tab.value);
    const swarm = new SwarmPanel(this.#program, this.#swarm);
    const reveal = (line: number): void => this.#edit.editor.reveal(line);
    const tests = new TestsPanel(
      this.#connection,
      this.#program,
      this.#swarm,
      reveal,
      () => this.#layout.show("swarm"),
      text => this.#edit.editor.append(text),
    );
    this.#paper = paper(this.#program, this.#swarm, tests);
    const robots = new RobotsPanel(this.#connection, this.#program, {
      declare: line => this.#edit.editor.insertAtTop(line),
      append: line => this.#edit.editor.append(line),
      show: () => this.#layout.show("swarm"),
    });
    const welcome = new Welcome(this.#swarm, () => this.#layout.show("learn"));
    this.#learn = new LearnPanel(
      this.#connection,
      { program: this.#program, swarm: this.#swarm, tests, robots },
      this.#lessons,
      {
        open: (path, text) => void this.#edit.leaveFor(() => this.#edit.begin(path, text)),
        openSaved: (saved, path, text) => void this.#edit.leaveFor(() => this.#openSaved(saved, path, text)),
        replace: text => this.#edit.editor.replace(text),
        show: tab => this.#layout.show(tab),
        moved: () => this.#place(),
        begun: () => welcome.close(),
      },
      this.#class,
    );
    const open = button("Open", () => void this.#edit.pick(), {
      "data-do": "programs",
      title: "Your programs and examples",
    });
    this.#header.add(open, take.host, welcome.help);
    this.#layout = new Layout(
      this.#header.host,
      this.#edit.host,
      [welcome.strip, this.#learn.strip.host],
      [
        { name: "swarm", label: "Swarm", panel: swarm.host },
        { name: "tests", label: "Tests", panel: tests.host },
        { name: "robots", label: "Robots", panel: robots.host },
        { name: "learn", label: "Learn", panel: this.#learn.host },
      ],
    );
    this.#layout.tab.follow(tab => {
      this.#places.note({ tab });
      robots.shown(tab === "robots");
      swarm.wake();
      this.#watch();
    });
    document.addEventListener("visibilitychange", () => this.#watch());
    addEventListener("hashchange", () => void this.#follow());
    this.#program.plays = !prefersStillness();
    this.#bindKeys(swarm);
  }

  start(): void {
    document.body.append(this.#layout.host, this.#paper);
    this.#connection.state.on(state => void this.#connected(state));
    this.#connection.open();
  }

  offerReload(): void {
    this.#header.offer("A new version is there: reload", () => location.reload());
  }

  async #connected(state: ConnectionState): Promise<void> {
    this.#header.showConnection(state);
    if (state !== "open") {
      return;
    }
    const hello = await this.#connection.request("hello", {});
    this.#program.hello = hello;
    if (this.ways.folder === null) {
      this.#header.showFolder(hello);
    }
    this.#language.connect(hello.root);
    this.#lessonsRead = this.#lessons.load();
    void this.#class.open(hello.class);
    if (this.#begun) {
      this.#program.restore();
    } else {
      this.#begun = true;
      await this.#openFirst(hello);
    }
  }

  #watch(): void {
    this.#swarm.watch(this.#layout.tab.value === "swarm" && !document.hidden);
  }

  /** Opens the program of the address if that has one; whether it has. */
  async #openFragment(): Promise<boolean> {
    const fragment = location.hash.slice(1);
    if (!isShare(fragment)) {
      return false;
    }
    const reason = await this.#edit.openLink(fragment);
    if (reason === null) {
      return true;
    }
    // A reload would only fail again.
    this.#places.rename(encodeURI(this.#program.path.value));
    if (this.#program.path.value === "" && this.#program.hello !== null) {
      await this.#openNamed(this.#program.hello, "");
    }
    this.#edit.notices.show("shared", reason);
    return true;
  }

  #share(shared: SharedProgram): void {
    this.#swarm.propose(swarm => sharedBits(shared, swarm));
    const tab = this.#layout.tabs.find(({ name }) => name === shared.tab);
    if (tab !== undefined) {
      this.#layout.show(tab.name);
    }
  }

  async #follow(): Promise<void> {
    const named = decoded(location.hash.slice(1));
    const { path } = this.#program;
    if ((await this.#openFragment()) || named === "" || named === path.value || this.#program.hello === null) {
      return;
    }
    if (named === this.#learn.address) {
      return;
    }
    if (await this.#edit.mayLeave()) {
      await this.#openNamed(this.#program.hello, named);
    } else {
      this.#place();
    }
  }

  /** Notes where the page is: at a step of a lesson, or at a program. */
  #place(isSame = false): void {
    const { path } = this.#program;
    const fragment = this.#learn.address ?? encodeURI(path.value);
    if (fragment !== "") {
      remember(LAST, path.value);
      if (isSame) {
        this.#places.rename(fragment);
      } else {
        this.#places.note({ fragment });
      }
    }
  }

  async #openLesson(hello: Greeting, { name, step }: NonNullable<ReturnType<typeof lessonAddress>>): Promise<boolean> {
    const isKnown = this.#places.isKnown;
    await this.#lessonsRead;
    const lesson = this.#lessons.named(name);
    if (lesson === null) {
      return false;
    }
    if (lesson.program === null && this.#program.path.value === "") {
      await this.#openNamed(hello, recall<string>(LAST) ?? "");
    }
    this.#learn.openStep(lesson, step, !isKnown);
    return true;
  }

  /** The program of the address, else that of the command line, else the latch. */
  async #openFirst(hello: Greeting): Promise<void> {
    if (!(await this.#openFragment())) {
      await this.#openNamed(hello, decoded(location.hash.slice(1)));
    }
  }

  async #openNamed(hello: Greeting, named: string): Promise<void> {
    const step = lessonAddress(named);
    if (step !== null && (await this.#openLesson(hello, step))) {
      return;
    }
    if (named !== "") {
      const isFile = hello.files.some(file => file.path === named);
      const isExample = hello.examples.some(({ name }) => name === named);
      const draft = isExample ? null : this.#program.drafts.of(named);
      const text = isFile ? null : ((await this.#lessonAt(named)) ?? draft?.text ?? null);
      if (text !== null) {
        this.#edit.begin(named, text);
        return;
      }
      if ((await this.#edit.open({ path: named })) || (await this.#edit.open({ example: named }))) {
        return;
      }
      // Back must not lead there again.
      this.#places.rename("");
    }
    const example = exampleNamed(hello, LATCH);
    const own = hello.files.some(file => file.path === example) ? { path: example } : { example };
    const origins: Origin[] = hello.file === null ? [own] : [{ path: hello.file }, own];
    if (hello.file === null) {
      // While `e` is off, the other switch of the latch changes nothing.
      this.#swarm.propose(({ inputs }) =>
        inputs.map(({ name, width }) => (name === "e" ? "1" : "0".repeat(width))).join(""),
      );
    }
    for (const origin of origins) {
      if (await this.#edit.open(origin)) {
        if (named !== "") {
          this.#edit.notices.show("open", `There is no ${named} here.`);
        }
        return;
      }
    }
  }

  async #openSaved(saved: string, path: string, text: string): Promise<void> {
    const files = await this.#connection.request("files", {});
    const isThere = files.some(file => file.path === saved);
    if (!isThere || !(await this.#edit.open({ path: saved }))) {
      this.#edit.begin(path, text);
    }
  }

  /** The program of the lesson that begins at a path, if there is one. */
  async #lessonAt(path: string): Promise<string | null> {
    await this.#lessonsRead;
    return this.#lessons.list.value.find(lesson => lessonPath(lesson) === path)?.program ?? null;
  }

  /** Space plays and pauses, and a period is one cycle, wherever nothing else takes these keys. */
  #bindKeys(swarm: SwarmPanel): void {
    addEventListener("keydown", event => {
      const target = event.composedPath()[0] as HTMLElement;
      const busy =
        target.closest?.("input, select, button, summary, [contenteditable], [role=button], dialog") !== null;
      if (busy || this.#layout.tab.value !== "swarm" || event.ctrlKey || event.metaKey || event.altKey) {
        return;
      }
      if (event.key === " ") {
        event.preventDefault();
        swarm.controls.toggle();
      } else if (event.key === ".") {
        this.#swarm.step();
      }
    });
  }
}

/** The example with this in its name, else the first. */
function exampleNamed(hello: Greeting, word: string): string {
  const found = hello.examples.find(example => example.name.replace(/\.nb$/, "").endsWith(word)) ?? hello.examples[0];
  return found?.name ?? word;
}

/** A path in an address; none if it is no such text. */
function decoded(fragment: string): string {
  try {
    return decodeURI(fragment);
  } catch {
    return "";
  }
}
