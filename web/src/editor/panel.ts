// The half of the page with the program: what file it is, whether it is saved, and the editor.

import type { Connection } from "../connection";
import { button, element } from "../element";
import { Notices } from "../notices";
import type { Origin, Program } from "../program";
import type { FileChange, FileText } from "../protocol";
import { RequestError } from "../request";
import { LinkError, decodeShare, type SharedProgram } from "../share/link";
import { Editor } from "./editor";
import { FilePicker, NEW_PROGRAM, askLeave, askPath, freePath } from "./files";
import type { LanguageServer } from "./server";

export class EditPanel {
  readonly host: HTMLElement;
  readonly editor: Editor;
  readonly notices = new Notices();
  readonly #picker: FilePicker;
  readonly #name = button("", () => void this.pick(), {
    class: "file",
    title: "Open another program",
    "data-do": "open",
  });
  readonly #save = button("Save", () => void this.save(), { "data-do": "save", title: "Save (Ctrl-S)" });

  constructor(
    private readonly connection: Connection,
    private readonly program: Program,
    server: LanguageServer,
    private readonly shared: (shared: SharedProgram) => void,
  ) {
    this.editor = new Editor({ changed: text => program.edit(text), save: () => void this.save() });
    this.#picker = new FilePicker(
      origin => void this.open(origin),
      path => this.begin(path, NEW_PROGRAM),
      link => this.openLink(link),
    );
    this.host = element(
      "section",
      { class: "edit", "aria-label": "Program" },
      element("div", { class: "bar" }, this.#name, this.#save),
      this.notices.host,
      this.editor.host,
      element("p", { class: "leaving" }, "Tab indents. Esc, then Tab leaves the editor."),
      this.#picker.host,
    );
    server.client.on(client => this.editor.serve(client));
    program.path.on(() => this.#showName());
    program.unsaved.follow(() => this.#showName());
    connection.events.on(event => event?.event === "changed" && this.#changed(event));
    addEventListener("keydown", event => {
      if ((event.ctrlKey || event.metaKey) && event.key === "s") {
        // The editor has its own binding, and has then handled the key.
        if (!event.defaultPrevented) {
          void this.save();
        }
        event.preventDefault();
      }
    });
  }

  async open(origin: Origin): Promise<boolean> {
    try {
      this.#show(await this.connection.request("read", origin));
      return true;
    } catch (error) {
      if (error instanceof RequestError) {
        this.notices.show("open", `Cannot open this program: ${error.message}`);
        return false;
      }
      throw error;
    }
  }

  /** Begins a program that has no file yet. */
  begin(path: string, text: string): void {
    this.#show({ path, text, stamp: null });
  }

  /** Opens the program of a link. The result is what is wrong with the link, if it is. */
  async openLink(link: string): Promise<string | null> {
    try {
      await this.#openShared(await decodeShare(link));
      return null;
    } catch (error) {
      if (error instanceof LinkError || error instanceof RequestError) {
        return `Cannot open the link: ${error.message}.`;
      }
      throw error;
    }
  }

  /** Opens a shared program under a name that no other program has. The program that is there stays as a draft. */
  async #openShared(shared: SharedProgram): Promise<void> {
    const { program } = this;
    if (!program.isKept && !(await askLeave(program.path.value))) {
      return;
    }
    const before = program.path.value;
    const files = new Set((await this.connection.request("files", {})).map(({ path }) => path));
    const path = freePath(shared.file, name => {
      const draft = program.draftAlone(name);
      return files.has(name) || (draft === null ? name === before : draft !== shared.text);
    });
    this.notices.clear();
    program.beginDraft(
      path,
      shared.text,
      shared.circuit === null ? null : { circuit: shared.circuit, swarm: shared.swarm },
    );
    this.#showText();
    this.shared(shared);
    const back =
      before === "" || before === path ? [] : [{ label: `Back to ${before}`, run: () => void this.#return(before) }];
    this.notices.show("shared", `A shared program, not saved yet: ${path}. Read it before you trust it.`, back);
  }

  /** Opens a program again that was shown before: a file, an example, or a draft. */
  async #return(path: string): Promise<void> {
    const draft = this.program.draftAlone(path);
    for (const origin of [{ path }, { example: path }]) {
      try {
        this.#show(await this.connection.request("read", origin));
        return;
      } catch (error) {
        if (!(error instanceof RequestError)) {
          throw error;
        }
      }
    }
    if (draft !== null) {
      this.program.beginDraft(path, draft, null);
      this.#showText();
    }
  }

  async pick(): Promise<void> {
    const files = await this.connection.request("files", {});
    this.#picker.show(files, this.program.hello?.examples ?? []);
  }

  async save(): Promise<void> {
    const { program } = this;
    const path = program.stamp === null ? await askPath(program.path.value) : program.path.value;
    if (path === null) {
      return;
    }
    try {
      await program.save(path);
      this.notices.hide("changed");
      this.notices.hide("draft");
      this.notices.hide("save");
      this.#remember();
      this.#showName();
    } catch (error) {
      this.#saveFailed(error, path);
    }
  }

  #saveFailed(error: unknown, path: string): void {
    if (!(error instanceof RequestError)) {
      throw error;
    }
    if (error.code === "changed") {
      this.#offerTheirs(path, `${path} is there already, or was changed by another program.`);
    } else {
      this.notices.show("save", `Cannot save ${path}: ${error.message}`);
    }
  }

  #show(file: FileText): void {
    this.notices.clear();
    const draft = this.program.begin(file);
    this.#showText();
    if (draft !== null) {
      const changed = draft.stamp === file.stamp ? "" : " The file was changed since then.";
      this.notices.show("draft", `Your unsaved changes of ${file.path} are shown again.${changed}`, [
        { label: "Discard them", run: () => this.editor.replace(file.text) },
      ]);
    }
  }

  #showText(): void {
    this.editor.open(this.program.uri, this.program.text);
    this.#showName();
    this.#remember();
  }

  /** The address names the program, so that a reload shows it again. */
  #remember(): void {
    window.history.replaceState(null, "", `#${encodeURI(this.program.path.value)}`);
  }

  #showName(): void {
    const { path, unsaved } = this.program;
    this.#name.textContent = path.value;
    this.#name.setAttribute("aria-label", `${path.value}${unsaved.value ? ", not saved" : ""}; open another program`);
    this.#name.dataset["unsaved"] = String(unsaved.value);
    this.#save.disabled = !unsaved.value && this.program.stamp !== null;
    document.title = `${unsaved.value ? "• " : ""}${path.value} – nbc`;
  }

  #changed({ path, stamp }: FileChange): void {
    if (path !== this.program.path.value || stamp === this.program.stamp) {
      return;
    }
    if (stamp === null) {
      this.program.stamp = null;
      this.notices.show("changed", `${path} was deleted. Save to write it again.`);
    } else {
      this.#offerTheirs(path, `${path} was changed by another program.`);
    }
  }

  #offerTheirs(path: string, text: string): void {
    const read = (): Promise<FileText> => this.connection.request("read", { path });
    this.notices.show("changed", text, [
      { label: "Load theirs", run: () => void read().then(file => this.#adopt(file)) },
      {
        label: "Keep mine",
        run: () =>
          void read().then(file => {
            this.program.stamp = file.stamp;
          }),
      },
    ]);
  }

  /** Takes the text of the file; undo brings the own one back. */
  #adopt(file: FileText): void {
    this.program.adopt(file);
    this.editor.replace(file.text);
  }
}
