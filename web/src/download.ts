// Files for the folder of downloads.

import { element } from "./element";

/** How long a browser may take to begin, in milliseconds. */
const PATIENCE = 10_000;

export function download(url: string, name: string): void {
  const link = element("a", { href: url, download: name });
  document.body.append(link);
  link.click();
  link.remove();
}

export function downloadBytes(bytes: Uint8Array | string, type: string, name: string): void {
  const url = URL.createObjectURL(new Blob([bytes as Uint8Array<ArrayBuffer> | string], { type }));
  download(url, name);
  setTimeout(() => URL.revokeObjectURL(url), PATIENCE);
}
