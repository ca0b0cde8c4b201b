// Choosing a program: the files of the folder, the examples, or a new one.

import { ask } from "../dialog";
import { button, element, fill, iconButton } from "../element";
import { INVISIBLE } from "../tab/zip";
import pictures from "../../gallery.json";
import { freePath } from "../free_path";
import type { ExampleEntry } from "../protocol";

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

const FEW = 12;

export interface FileDoors {
  title: string;
  /** Opens a program of this path: a file, an example or a draft. */
  open: (path: string) => void;
  openExample: (name: string) => void;
  begin: (path: string) => void;
  share: (link: string) => Promise<string | null>;
  isUnsaved: (path: string) => boolean;
  /** Whether the page can delete a program, and rename it. */
  isOwn: (path: string) => boolean;
  /** The result brings it back. */
  remove: (path: string) => () => void;
  rename: (path: string) => void;
}

export class FilePicker {
  readonly host = element("dialog", { class: "files", "aria-label": "Open a program" });
  readonly #status = element("p", { class: "row", role: "status" });

  constructor(
    private readonly doors: FileDoors,
    private readonly transfer: HTMLElement,
  ) {
    this.host.addEventListener("click", event => {
      if (event.target === this.host) {
        this.host.close();
      }
    });
    this.host.addEventListener("close", () => fill(this.#status));
  }

  /** Shows the programs of these paths, which have a file or a draft, and the examples. */
  show(paths: string[], examples: ExampleEntry[]): void {
    fill(
      this.host,
      element(
        "header",
        {},
        element("h2", {}, "Open a program"),
        iconButton("close", "Close", () => this.host.close()),
      ),
      this.#new(paths),
      ...byFolder(paths).map(([folder, inside]) => this.#folder(folder, inside)),
      this.#status,
      this.#shared(),
      this.transfer,
      section(
        "Examples",
        examples.map(({ name, about }) => {
          const open = this.#opener(name, () => this.doors.openExample(name));
          open.prepend(element("img", { src: (pictures as Record<string, string>)[name], alt: "" }));
          return element("li", { class: "example" }, open, element("span", {}, about));
        }),
      ),
    );
    if (!this.host.open) {
      this.host.showModal();
    }
  }

  /** The files of a folder; those of folders below are closed at first if there are many. */
  #folder(folder: string, paths: string[]): HTMLElement {
    const items = paths.map(path => this.#item(path));
    if (folder === "") {
      return section(this.doors.title, items);
    }
    return element(
      "details",
      { class: "folder", open: paths.length <= FEW, "data-folder": folder },
      element("summary", {}, `${folder} (${paths.length})`),
      element("section", { class: "names" }, element("ul", {}, ...items)),
    );
  }

  #item(path: string): HTMLElement {
    const { doors } = this;
    const remove = (): void => {
      const undo = doors.remove(path);
      fill(this.#status, `${path} was deleted. `, button("Undo", undo, { "data-do": "undo-delete" }));
    };
    return element(
      "li",
      {},
      this.#opener(path, () => doors.open(path)),
      doors.isUnsaved(path) && element("b", { class: "unsaved", title: "not saved" }, "•"),
      ...(doors.isOwn(path)
        ? [
            iconButton("rename", `Rename ${path}`, () => doors.rename(path), { "data-rename": path }),
            iconButton("close", `Delete ${path}`, remove, { "data-delete": path }),
          ]
        : []),
    );
  }

  #opener(path: string, open: () => void): HTMLElement {
    const choose = (): void => {
      this.host.close();
      open();
    };
    return button(path.split("/").at(-1) ?? path, choose, { "data-open": path });
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
      const reason = await this.doors.share(field.value);
      fault.textContent = reason ?? "";
      if (reason === null) {
        this.host.close();
      }
    };
    onEnter(field, () => void open());
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

  #new(paths: string[]): HTMLElement {
    const field = element("input", {
      type: "text",
      value: freePath("circuit1.nb", path => paths.includes(path)),
      "aria-label": "Name of the new file",
      spellcheck: "false",
    });
    const make = (): void => {
      const name = withEnding(field.value);
      if (name !== null) {
        this.host.close();
        this.doors.begin(name);
      }
    };
    onEnter(field, make);
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

/** Without the default, a key that closes a dialog would press the button to which the focus returns. */
function onEnter(field: HTMLInputElement, run: () => void): void {
  field.onkeydown = event => {
    if (event.key === "Enter") {
      event.preventDefault();
      run();
    }
  };
}

function section(title: string, items: HTMLElement[]): HTMLElement {
  const list = items.length === 0 ? element("p", {}, "none") : element("ul", {}, ...items);
  return element("section", {}, element("h3", {}, title), list);
}

/** A path with the ending of a program, of visible characters alone; null if there is no name. */
export function withEnding(text: string): string | null {
  const path = text.replace(new RegExp(INVISIBLE, "gu"), "").trim().replace(/^\/+/, "");
  return path === "" ? null : path.endsWith(".nb") ? path : `${path}.nb`;
}

export async function askPath(suggested: string, label = "Save as", action = "Save"): Promise<string | null> {
  const field = element("input", {
    type: "text",
    value: suggested,
    "aria-label": "Path within the folder",
    spellcheck: "false",
  });
  const asked = ask<string>(label, "ask", close => {
    const accept = (): void => close(field.value);
    onEnter(field, accept);
    return [
      element("h2", {}, label),
      field,
      element(
        "p",
        { class: "row" },
        button(action, accept, { class: "primary", "data-do": "save-as" }),
        button("Cancel", () => close("")),
      ),
    ];
  });
  field.select();
  return withEnding((await asked) ?? "");
}

/** Asks whether the unsaved text of a program may go, where the browser keeps no drafts. */
export async function askLeave(path: string): Promise<boolean> {
  const answer = await ask<boolean>("Leave the program", "ask", close => [
    element("h2", {}, `${path} is not saved`),
    element("p", {}, "This browser does not keep drafts: opening another program loses your changes."),
    element(
      "p",
      { class: "row" },
      button("Stay here", () => close(false), { class: "primary", "data-do": "stay" }),
      button("Open it anyway", () => close(true), { "data-do": "leave" }),
    ),
  ]);
  return answer === true;
}
