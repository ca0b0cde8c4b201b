// All files of the browser's folder as a zip archive, and back: where there is no server, the only way to a disk.

import { counted } from "../counted";
import { downloadBytes } from "../download";
import { button, element, fill } from "../element";
import type { BrowserFolder } from "../line";
import { ZipError, unzip, zip, type Unzipped } from "../tab/zip";

/** The section of the list of programs; `changed` is called when files have come. */
export function archiveSection(folder: BrowserFolder, changed: () => void): HTMLElement {
  const status = element("div", { class: "status", role: "status", "aria-live": "polite" });
  const field = element("input", {
    type: "file",
    accept: ".zip,application/zip",
    "aria-label": "Zip archive with files",
    "data-do": "import",
  });
  field.onchange = () => {
    const [file] = field.files ?? [];
    if (file !== undefined) {
      void take(file, folder, status, changed);
      // The same file can be chosen again.
      field.value = "";
    }
  };
  return element(
    "section",
    {},
    element("h3", {}, "All files as an archive"),
    element(
      "p",
      { class: "row" },
      button("Export all files (zip)", () => void give(folder, status), { "data-do": "export" }),
      element("label", { class: "import" }, "Import a zip: ", field),
    ),
    status,
  );
}

async function give(folder: BrowserFolder, status: HTMLElement): Promise<void> {
  const files = folder.files();
  if (files.length === 0) {
    fill(status, "No file has been saved yet.");
    return;
  }
  const [day, time] = new Date().toISOString().replace(/[-:]/g, "").split("T");
  const name = `nbc-files-${day}-${time?.slice(0, 6)}.zip`;
  downloadBytes(await zip(files), "application/zip", name);
  fill(status, `${name} has ${counted(files.length, "file")}. What is not saved is not in it.`);
}

async function take(file: File, folder: BrowserFolder, status: HTMLElement, changed: () => void): Promise<void> {
  let read: Unzipped;
  try {
    read = await unzip(new Uint8Array(await file.arrayBuffer()));
  } catch (error) {
    if (!(error instanceof ZipError)) {
      throw error;
    }
    fill(status, element("p", { class: "fail" }, `Cannot import ${file.name}: ${error.message}.`));
    return;
  }
  const known = new Map(folder.files());
  const differ = read.files.filter(([path, text]) => known.has(path) && known.get(path) !== text);
  const insert = (files: Unzipped["files"]): void => {
    files.forEach(([path, text]) => folder.insert(path, text));
    const without = read.leftOut.length === 0 ? "" : ` Left out, because they are no text: ${names(read.leftOut)}.`;
    fill(status, `${counted(files.length, "file")} imported.${without}`);
    changed();
  };
  if (differ.length === 0) {
    insert(read.files);
    return;
  }
  const paths = differ.map(([path]) => path);
  fill(
    status,
    element("p", {}, `Other files of these names are there already: ${names(paths)}.`),
    element(
      "p",
      { class: "row" },
      button("Replace them", () => insert(read.files), { "data-do": "replace-files" }),
      button("Keep mine", () => insert(read.files.filter(([path]) => !paths.includes(path))), {
        "data-do": "keep-files",
      }),
      button("Import nothing", () => fill(status)),
    ),
  );
}

/** The most names that are listed. */
const MOST = 5;

function names(paths: string[]): string {
  const more = paths.length > MOST ? [`and ${paths.length - MOST} more`] : [];
  return [...paths.slice(0, MOST), ...more].join(", ");
}
