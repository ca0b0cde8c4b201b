// The half of the page with the program: what file it is, whether it is saved, and the editor.

import type { Connection } from "../connection";
import type { BrowserFolder } from "../line";
import { button, element } from "../element";
import { Notices } from "../notices";
import type { Origin, Program } from "../program";
import type { FileChange, FileText } from "../protocol";
import { RequestError } from "../request";
import { LinkError, decodeShare, type SharedProgram } from "../share/link";
import { Editor } from "./editor";
import { freePath } from "../free_path";
import { FilePicker, NEW_PROGRAM, askLeave, askPath } from "./files";
import { problemList } from "./problems";
import type { LanguageServer } from "./server";
import { Transfer } from "./transfer";

export interface EditDoors {
  folder: BrowserFolder | null;
  shared: (shared: SharedProgram) => void;
  /** A program is shown: another one, or the same under a new name. */
  shown: (isSame: boolean) => void;
}

export class EditPanel {
  readonly host: HTMLElement;
  readonly editor: Editor;
  readonly notices = new Notices();
  readonly #picker: FilePicker;
  readonly #transfer: Transfer;
  #files: string[] = [];
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
    private readonly doors: EditDoors,
  ) {
    this.#transfer = new Transfer(
      doors.folder,
      () => void this.pick(),
      (path, text) => void this.leaveFor(() => this.#came(path, text)),
    );
    this.editor = new Editor({ changed: text => program.edit(text), save: () => void this.save() });
    this.#picker = new FilePicker(
      {
        title: doors.folder === null ? "In this folder" : "My programs",
        open: path => void this.leaveFor(() => this.#return(path)),
        openExample: name => void this.leaveFor(() => this.open({ example: name })),
        begin: path => void this.leaveFor(() => this.begin(path, NEW_PROGRAM)),
        share: link => this.openLink(link),
        isUnsaved: path => program.drafts.paths.includes(path),
        isOwn: path => doors.folder !== null || !this.#files.includes(path),
        remove: path => this.#remove(path),
        rename: path => void this.#rename(path),
      },
      this.#transfer.host,
    );
    this.host = element(
      "section",
      { class: "edit", "aria-label": "Program" },
      element("div", { class: "bar" }, this.#name, this.#save),
      this.notices.host,
      this.editor.host,
      element("p", { class: "leaving" }, "Tab indents. Esc, then Tab leaves the editor."),
      // Below what a click on it hides, so that it stays under the pointer.
      problemList(program, line => this.editor.reveal(line)),
      this.#picker.host,
    );
    server.client.on(client => this.editor.serve(client));
    program.path.on(() => this.#showName());
    program.unsaved.follow(() => this.#showName());
    program.forked.on(fork => {
      if (fork !== null) {
        doors.shown(true);
        this.notices.show(
          "forked",
          `Another tab has unsaved changes of ${fork.from}. Yours are ${fork.path} from here on.`,
        );
      }
    });
    connection.events.on(event => event?.event === "changed" && this.#changed(event));
    connection.state.on(state => {
      // What could not be saved or opened without the server now may be.
      if (state === "open") {
        this.notices.hide("save");
        this.notices.hide("open");
      }
    });
    addEventListener("dragover", event => isOfFiles(event) && event.preventDefault());
    // The editor would insert the text.
    addEventListener("drop", event => isOfFiles(event) && void this.#dropped(event), { capture: true });
    addEventListener("beforeunload", event => {
      if (!program.isKept) {
        event.preventDefault();
      }
    });
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
      const file = await this.connection.request("read", origin);
      const isExample = "example" in origin;
      const taken = new Set(this.program.hello?.files.map(({ path }) => path));
      if (isExample && taken.has(file.path)) {
        // The address and the draft would be those of the file.
        this.#show({ ...file, path: freePath(file.path, path => taken.has(path)) }, true);
      } else {
        this.#show(file, !isExample && file.stamp === null);
      }
      return true;
    } catch (error) {
      if (error instanceof RequestError) {
        this.notices.show("open", `Cannot open this program: ${error.message}`);
        return false;
      }
      throw error;
    }
  }

  begin(path: string, text: string): void {
    this.#show({ path, text, stamp: null }, true);
  }

  async leaveFor(show: () => unknown): Promise<void> {
    if (await this.mayLeave()) {
      show();
    }
  }

  /** Whether the program may go: where the browser keeps no drafts, the user is asked. */
  async mayLeave(): Promise<boolean> {
    return this.program.isKept || (await askLeave(this.program.path.value));
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
    if (!(await this.mayLeave())) {
      return;
    }
    const before = program.path.value;
    const files = await this.#list();
    const path = freePath(shared.file, name => {
      const draft = program.drafts.of(name);
      const isExample = program.hello?.examples.some(example => example.name === name) === true;
      return files.includes(name) || isExample || (draft === null ? name === before : draft.text !== shared.text);
    });
    this.notices.clear();
    program.beginDraft(
      path,
      shared.text,
      shared.circuit === null ? null : { circuit: shared.circuit, swarm: shared.swarm },
    );
    this.#showText();
    this.doors.shared(shared);
    const back =
      before === "" || before === path ? [] : [{ label: `Back to ${before}`, run: () => void this.#return(before) }];
    this.notices.show("shared", `A shared program, not saved yet: ${path}. Read it before you trust it.`, back);
  }

  async #return(path: string): Promise<void> {
    const isExample = this.program.hello?.examples.some(({ name }) => name === path) === true;
    const draft = this.program.drafts.of(path);
    const isFile = (await this.#list()).includes(path);
    if (draft !== null && !isFile && !isExample) {
      this.begin(path, draft.text);
    } else {
      await this.open(isExample && !isFile ? { example: path } : { path });
    }
  }

  async #dropped(event: DragEvent): Promise<void> {
    event.preventDefault();
    event.stopPropagation();
    const files = [...(event.dataTransfer?.files ?? [])];
    await this.pick();
    await this.#transfer.take(files);
  }

  /** Opens a program that has come from a disk: a file of the folder, or a text that has none. */
  async #came(path: string, text: string | null): Promise<void> {
    this.#picker.host.close();
    if (text === null) {
      await this.open({ path });
    } else {
      const files = await this.#list();
      const name = freePath(path, wished => files.includes(wished) || this.program.isTaken(wished));
      this.program.beginDraft(name, text, null);
      this.#showText();
    }
  }

  /** Deletes a program that only this browser has. The result brings it back. */
  #remove(path: string): () => void {
    const { folder } = this.doors;
    const { drafts } = this.program;
    const text = new Map(folder?.files()).get(path);
    const draft = drafts.open(path);
    drafts.keep(path, null);
    folder?.remove(path);
    void this.pick();
    return () => {
      if (text !== undefined) {
        folder?.insert(path, text);
      }
      drafts.keep(path, draft);
      void this.pick();
    };
  }

  async #rename(from: string): Promise<void> {
    const { folder } = this.doors;
    const { drafts } = this.program;
    const to = await askPath(from, `Rename ${from}`, "Rename");
    if (to === null || to === from) {
      return;
    }
    const path = freePath(to, name => this.#files.includes(name) || this.program.isTaken(name));
    const text = new Map(folder?.files()).get(from);
    if (text !== undefined) {
      folder?.insert(path, text);
    }
    drafts.keep(path, drafts.open(from));
    this.#remove(from);
    if (this.program.path.value === from) {
      await this.pick();
      this.#picker.host.close();
      await this.#return(path);
    }
  }

  async #list(): Promise<string[]> {
    this.#files = (await this.connection.request("files", {})).map(({ path }) => path);
    return this.#files;
  }

  async pick(): Promise<void> {
    try {
      const paths = new Set([...(await this.#list()), ...this.program.drafts.paths]);
      this.#picker.show([...paths], this.program.hello?.examples ?? []);
    } catch (error) {
      if (!(error instanceof RequestError)) {
        throw error;
      }
      this.notices.show("open", `Cannot list the programs: ${error.message}`);
    }
  }

  async save(): Promise<void> {
    const { program } = this;
    const path = program.stamp === null ? await askPath(program.path.value) : program.path.value;
    if (path !== null) {
      await this.#saveAt(path);
    }
  }

  /** Saves at a path, over the file with this stamp if one is given. */
  async #saveAt(path: string, stamp?: string | null): Promise<void> {
    try {
      await this.program.save(path, stamp);
      for (const name of ["changed", "draft", "save"]) {
        this.notices.hide(name);
      }
      this.doors.shown(true);
      this.#showName();
    } catch (error) {
      this.#saveFailed(error, path);
    }
  }

  #saveFailed(error: unknown, path: string): void {
    if (!(error instanceof RequestError)) {
      throw error;
    }
    const { instead } = error;
    if (error.code === "changed" && path === this.program.path.value && this.program.stamp !== null) {
      this.#offerTheirs(path, `${path} was changed by another program since you opened it.`);
    } else if (error.code === "changed") {
      this.#offerReplace(path);
    } else if (instead !== null) {
      this.notices.show("save", `Cannot save ${path}: ${error.message}.`, [
        { label: `Save as ${instead}`, run: () => void this.#saveAt(instead) },
      ]);
    } else {
      this.notices.show("save", `Cannot save ${path}: ${error.message}`);
    }
  }

  #show(file: FileText, alone = false): void {
    this.notices.clear();
    const draft = this.program.begin(file, alone);
    this.#showText();
    if (draft === null) {
      return;
    }
    const text = `Your unsaved changes of ${file.path} are shown again.`;
    if (file.stamp !== null && draft.stamp !== file.stamp) {
      this.#offerTheirs(file.path, `${text} The file was changed since then, and is not replaced without a question.`);
    } else {
      this.notices.show("draft", text, [{ label: "Discard them", run: () => this.editor.replace(file.text) }]);
    }
  }

  #showText(): void {
    this.editor.open(this.program.uri, this.program.text);
    this.#showName();
    this.doors.shown(false);
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

  #offerReplace(path: string): void {
    const replace = async (): Promise<void> => {
      const { stamp } = await this.connection.request("read", { path });
      await this.#saveAt(path, stamp);
    };
    this.notices.show("changed", `${path} is there already.`, [{ label: "Replace it", run: () => void replace() }]);
  }

  /** Takes the text of the file; undo brings the own one back. */
  #adopt(file: FileText): void {
    this.program.adopt(file);
    this.editor.replace(file.text);
  }
}

function isOfFiles({ dataTransfer }: DragEvent): boolean {
  return dataTransfer?.types.includes("Files") === true;
}
