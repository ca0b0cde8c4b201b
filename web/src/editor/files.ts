// Choosing a program: the files of the folder, the examples, or a new one.

import { button, element, fill, iconButton } from "../element";
import type { ExampleEntry, FileEntry } from "../protocol";
import type { Origin } from "../program";

export const NEW_PROGRAM = `// A circuit of your own: name its inputs and outputs, and say what each output is.

circuit mine(a, b) -> (q) {
    q = a and b
}

test mine "both" {
    a b | q
    0 1 | 0
    1 1 | 1
}
`;

/** A folder with more files is closed at first. */
const FEW = 12;

export class FilePicker {
  readonly host = element("dialog", { class: "files", "aria-label": "Open a program" });

  constructor(
    private readonly open: (origin: Origin) => void,
    private readonly begin: (path: string) => void,
    private readonly share: (link: string) => Promise<string | null>,
    /** The section of all files as an archive, if there is one. */
    private readonly archive: HTMLElement | null = null,
  ) {
    this.host.addEventListener("click", event => {
      if (event.target === this.host) {
        this.host.close();
      }
    });
  }

  show(files: FileEntry[], examples: ExampleEntry[]): void {
    fill(
      this.host,
      element(
        "header",
        {},
        element("h2", {}, "Open a program"),
        iconButton("close", "Close", () => this.host.close()),
      ),
      this.#new(files),
      this.#shared(),
      this.archive,
      ...byFolder(files.map(({ path }) => path)).map(([folder, paths]) => this.#folder(folder, paths)),
      this.#list(
        "Examples",
        examples.map(({ name, about }) => ({ label: name, about, origin: { example: name } })),
      ),
    );
    if (!this.host.open) {
      this.host.showModal();
    }
  }

  #list(title: string, entries: { label: string; about: string; origin: Origin }[]): HTMLElement {
    const items = entries.map(({ label, about, origin }) =>
      element(
        "li",
        {},
        button(label.split("/").at(-1) ?? label, () => this.#choose(origin), { "data-open": label }),
        about !== "" && element("span", {}, about),
      ),
    );
    return element(
      "section",
      { class: entries.every(({ about }) => about === "") ? "names" : null },
      element("h3", {}, title),
      items.length === 0 ? element("p", {}, "none") : element("ul", {}, ...items),
    );
  }

  /** The files of a folder; those of folders below are closed at first if there are many. */
  #folder(folder: string, paths: string[]): HTMLElement {
    const entries = paths.map(path => ({ label: path, about: "", origin: { path } }));
    if (folder === "") {
      return this.#list("In this folder", entries);
    }
    const list = this.#list("", entries);
    list.querySelector("h3")?.remove();
    return element(
      "details",
      { class: "folder", open: paths.length <= FEW, "data-folder": folder },
      element("summary", {}, `${folder} (${paths.length})`),
      list,
    );
  }

  #choose(origin: Origin): void {
    this.host.close();
    this.open(origin);
  }

  /** A link that someone has sent; what is wrong with it is shown. */
  #shared(): HTMLElement {
    const field = element("input", {
      type: "text",
      placeholder: "paste a link with #share=",
      "aria-label": "Link to a shared program",
      autocomplete: "off",
      spellcheck: "false",
    });
    const fault = element("p", { class: "fail", role: "alert" });
    const open = async (): Promise<void> => {
      const reason = await this.share(field.value);
      fault.textContent = reason ?? "";
      if (reason === null) {
        this.host.close();
      }
    };
    field.onkeydown = event => {
      if (event.key === "Enter") {
        void open();
      }
    };
    return element(
      "section",
      {},
      element("h3", {}, "Open a shared program"),
      element(
        "p",
        { class: "row" },
        field,
        button("Open", () => void open(), { "data-do": "open-shared" }),
      ),
      fault,
    );
  }

  #new(files: FileEntry[]): HTMLElement {
    const field = element("input", {
      type: "text",
      value: freeName(files),
      "aria-label": "Name of the new file",
      spellcheck: "false",
    });
    const make = (): void => {
      const name = withEnding(field.value);
      if (name !== null) {
        this.host.close();
        this.begin(name);
      }
    };
    field.onkeydown = event => {
      if (event.key === "Enter") {
        make();
      }
    };
    return element(
      "section",
      {},
      element("h3", {}, "New"),
      element("p", { class: "row" }, field, button("Begin", make, { "data-do": "new" })),
    );
  }
}

/** The paths of each folder, the folder itself first, then those below it in order. */
export function byFolder(paths: string[]): [string, string[]][] {
  const folders = new Map<string, string[]>([["", []]]);
  for (const path of paths) {
    const folder = path.includes("/") ? path.slice(0, path.lastIndexOf("/")) : "";
    folders.set(folder, [...(folders.get(folder) ?? []), path]);
  }
  return [...folders].sort(([a], [b]) => (a < b ? -1 : 1));
}

function freeName(files: FileEntry[]): string {
  const taken = new Set(files.map(file => file.path));
  let number = 1;
  while (taken.has(`circuit${number}.nb`)) {
    number++;
  }
  return `circuit${number}.nb`;
}

/** A path with the ending of a program; null if there is no name. */
export function withEnding(text: string): string | null {
  const path = text.trim().replace(/^\/+/, "");
  return path === "" ? null : path.endsWith(".nb") ? path : `${path}.nb`;
}

/** Asks for a path to save at. */
export function askPath(suggested: string): Promise<string | null> {
  return new Promise(resolve => {
    const field = element("input", {
      type: "text",
      value: suggested,
      "aria-label": "Path within the folder",
      spellcheck: "false",
    });
    let answer: string | null = null;
    const dialog = element(
      "dialog",
      { class: "ask", "aria-label": "Save as" },
      element("h2", {}, "Save as"),
      field,
      element(
        "p",
        { class: "row" },
        button("Save", () => accept(), { class: "primary", "data-do": "save-as" }),
        button("Cancel", () => dialog.close()),
      ),
    );
    const accept = (): void => {
      answer = withEnding(field.value);
      dialog.close();
    };
    field.onkeydown = event => {
      if (event.key === "Enter") {
        accept();
      }
    };
    dialog.onclose = () => {
      dialog.remove();
      resolve(answer);
    };
    document.body.append(dialog);
    dialog.showModal();
    field.select();
  });
}

/** A path like the wished one that is not taken: itself, or with a number. */
export function freePath(wished: string, isTaken: (path: string) => boolean): string {
  const [, stem = wished, ending = ""] = /^(.*?)(\.\w+)?$/.exec(wished) ?? [];
  let path = wished;
  for (let number = 2; isTaken(path); number++) {
    path = `${stem}_${number}${ending}`;
  }
  return path;
}

/** Asks whether the unsaved text of a program may go, where the browser keeps no drafts. */
export function askLeave(path: string): Promise<boolean> {
  return new Promise(resolve => {
    let answer = false;
    const dialog = element(
      "dialog",
      { class: "ask", "aria-label": "Leave the program" },
      element("h2", {}, `${path} is not saved`),
      element("p", {}, "This browser does not keep drafts: opening another program loses your changes."),
      element(
        "p",
        { class: "row" },
        button("Stay here", () => dialog.close(), { class: "primary", "data-do": "stay" }),
        button(
          "Open it anyway",
          () => {
            answer = true;
            dialog.close();
          },
          { "data-do": "leave" },
        ),
      ),
    );
    dialog.onclose = () => {
      dialog.remove();
      resolve(answer);
    };
    document.body.append(dialog);
    dialog.showModal();
  });
}
