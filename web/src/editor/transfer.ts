// Files from a disk, and all files of the browser's folder as a zip archive: where there is no server, the only ways.

import { counted } from "../counted";
import { downloadBytes } from "../download";
import { button, element, fill } from "../element";
import type { BrowserFolder } from "../line";
import { INVISIBLE, MOST_FILE, ZipError, decoded, unzip, zip, type Unzipped } from "../tab/zip";

export class Transfer {
  readonly host: HTMLElement;
  readonly #status = element("div", { class: "status", role: "status", "aria-live": "polite" });

  constructor(
    /** The folder, if it is in the browser; else programs come as drafts. */
    private readonly folder: BrowserFolder | null,
    private readonly changed: () => void,
    private readonly open: (path: string, text: string | null) => void,
  ) {
    const field = element("input", { type: "file", multiple: true, "aria-label": "Files to add", "data-do": "import" });
    field.onchange = () => {
      void this.take([...(field.files ?? [])]);
      // The same file can be chosen again.
      field.value = "";
    };
    this.host = element(
      "section",
      {},
      element("h3", {}, "From and to your disk"),
      element(
        "p",
        { class: "row" },
        element("label", { class: "import" }, "Add files, or drop them on the page: ", field),
        folder !== null && button("Export all files (zip)", () => this.#give(folder), { "data-do": "export" }),
      ),
      this.#status,
    );
  }

  async take(files: File[]): Promise<void> {
    const read: Unzipped = { files: [], leftOut: [] };
    for (const file of files) {
      try {
        await add(file, read);
      } catch (error) {
        if (!(error instanceof ZipError)) {
          throw error;
        }
        fill(this.#status, element("p", { class: "fail" }, `Cannot import ${file.name}: ${error.message}.`));
        return;
      }
    }
    const isArchive = files.some(({ name }) => name.endsWith(".zip"));
    const program = isArchive ? undefined : read.files.find(([path]) => path.endsWith(".nb"));
    if (this.folder !== null) {
      this.#offer(this.folder, read, program?.[0] ?? null);
    } else if (program !== undefined) {
      this.open(...program);
    } else {
      fill(this.#status, "Only programs (.nb) can be opened from here. Put other files into the folder.");
    }
  }

  #give(folder: BrowserFolder): void {
    const files = folder.files();
    if (files.length === 0) {
      fill(this.#status, "No file has been saved yet.");
      return;
    }
    const [day, time] = new Date().toISOString().replace(/[-:]/g, "").split("T");
    const name = `nbc-files-${day}-${time?.slice(0, 6)}.zip`;
    downloadBytes(zip(files), "application/zip", name);
    fill(this.#status, `${name} has ${counted(files.length, "file")}. What is not saved is not in it.`);
  }

  /** Puts files into the folder; what is there already is not replaced without a question. */
  #offer(folder: BrowserFolder, read: Unzipped, program: string | null): void {
    const known = new Map(folder.files());
    const paths = read.files.flatMap(([path, text]) => (known.has(path) && known.get(path) !== text ? [path] : []));
    const insert = (files: Unzipped["files"]): void => {
      files.forEach(([path, text]) => folder.insert(path, text));
      const without = read.leftOut.length === 0 ? "" : ` Left out, because they are no text: ${names(read.leftOut)}.`;
      fill(this.#status, `${counted(files.length, "file")} imported.${without}`);
      if (program === null) {
        this.changed();
      } else {
        this.open(program, null);
      }
    };
    if (paths.length === 0) {
      insert(read.files);
      return;
    }
    const others = read.files.filter(([path]) => !paths.includes(path));
    fill(
      this.#status,
      element("p", {}, `Other files of these names are there already: ${names(paths)}.`),
      element(
        "p",
        { class: "row" },
        button("Replace them", () => insert(read.files), { "data-do": "replace-files" }),
        button("Keep mine", () => insert(others), { "data-do": "keep-files" }),
        button("Import nothing", () => fill(this.#status)),
      ),
    );
  }
}

async function add(file: File, read: Unzipped): Promise<void> {
  const isArchive = file.name.endsWith(".zip");
  if (INVISIBLE.test(file.name)) {
    throw new ZipError("its name has invisible characters");
  }
  if (!isArchive && file.size > MOST_FILE) {
    throw new ZipError("the file is larger than 1 MB");
  }
  const bytes = new Uint8Array(await file.arrayBuffer());
  const text = isArchive ? null : decoded(bytes);
  if (isArchive) {
    const inside = unzip(bytes);
    read.files.push(...inside.files);
    read.leftOut.push(...inside.leftOut);
  } else if (text === null) {
    read.leftOut.push(file.name);
  } else {
    read.files.push([file.name, text]);
  }
}

const MOST = 5;

function names(paths: string[]): string {
  const more = paths.length > MOST ? [`and ${paths.length - MOST} more`] : [];
  return [...paths.slice(0, MOST), ...more].join(", ");
}
