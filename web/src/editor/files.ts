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

export class FilePicker {
  readonly host = element("dialog", { class: "files", "aria-label": "Open a program" });

  constructor(
    private readonly open: (origin: Origin) => void,
    private readonly begin: (path: string) => void,
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
      this.#list(
        "In this folder",
        files.map(({ path }) => ({ label: path, about: "", origin: { path } })),
      ),
      this.#list(
        "Examples",
        examples.map(({ name, about }) => ({ label: name, about, origin: { example: name } })),
      ),
    );
    this.host.showModal();
  }

  #list(title: string, entries: { label: string; about: string; origin: Origin }[]): HTMLElement {
    const items = entries.map(({ label, about, origin }) =>
      element(
        "li",
        {},
        button(label, () => this.#choose(origin), { "data-open": label }),
        about !== "" && element("span", {}, about),
      ),
    );
    return element(
      "section",
      {},
      element("h3", {}, title),
      items.length === 0 ? element("p", {}, "none") : element("ul", {}, ...items),
    );
  }

  #choose(origin: Origin): void {
    this.host.close();
    this.open(origin);
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
    field.onkeydown = event => event.key === "Enter" && accept();
    dialog.onclose = () => {
      dialog.remove();
      resolve(answer);
    };
    document.body.append(dialog);
    dialog.showModal();
    field.select();
  });
}
