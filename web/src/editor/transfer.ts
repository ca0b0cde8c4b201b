// Files from a disk, and all files of the browser's folder as a zip archive: where there is no server, the only ways.

import { counted } from "../counted";
import { downloadBytes } from "../download";
import { button, element, fill } from "../element";
import type { BrowserFolder } from "../line";
import type { KeptFiles } from "../tab/files";
import { INVISIBLE, MOST_FILE, ZipError, contentsOf, unzip, zip } from "../tab/zip";

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
    const read: KeptFiles = [];
    for (const file of files) {
      try {
        read.push(...(await filesOf(file)));
      } catch (error) {
        if (!(error instanceof ZipError)) {
          throw error;
        }
        fill(this.#status, element("p", { class: "fail" }, `Cannot import ${file.name}: ${error.message}.`));
        return;
      }
    }
    const isArchive = files.some(({ name }) => name.endsWith(".zip"));
    const [path, text] = (isArchive ? undefined : read.find(([path]) => path.endsWith(".nb"))) ?? [null];
    if (this.folder !== null) {
      this.#offer(this.folder, read, path);
    } else if (path !== null && typeof text === "string") {
      this.open(path, text);
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
  #offer(folder: BrowserFolder, read: KeptFiles, program: string | null): void {
    const known = new Map(folder.files());
    const paths = read.flatMap(([path, text]) => (known.has(path) && known.get(path) !== text ? [path] : []));
    const insert = (files: KeptFiles): void => {
      files.forEach(([path, text]) => folder.insert(path, text));
      fill(this.#status, `${counted(files.length, "file")} imported.`);
      if (program === null) {
        this.changed();
      } else {
        this.open(program, null);
      }
    };
    if (paths.length === 0) {
      insert(read);
      return;
    }
    const others = read.filter(([path]) => !paths.includes(path));
    fill(
      this.#status,
      element("p", {}, `Other files of these names are there already: ${names(paths)}.`),
      element(
        "p",
        { class: "row" },
        button("Replace them", () => insert(read), { "data-do": "replace-files" }),
        button("Keep mine", () => insert(others), { "data-do": "keep-files" }),
        button("Import nothing", () => fill(this.#status)),
      ),
    );
  }
}

async function filesOf(file: File): Promise<KeptFiles> {
  const isArchive = file.name.endsWith(".zip");
  if (INVISIBLE.test(file.name)) {
    throw new ZipError("its name has invisible characters");
  }
  if (!isArchive && file.size > MOST_FILE) {
    throw new ZipError("the file is larger than 1 MB");
  }
  const bytes = new Uint8Array(await file.arrayBuffer());
  return isArchive ? unzip(bytes) : [[file.name, contentsOf(bytes)]];
}

const MOST = 5;

function names(paths: string[]): string {
  const more = paths.length > MOST ? [`and ${paths.length - MOST} more`] : [];
  return [...paths.slice(0, MOST), ...more].join(", ");
}
