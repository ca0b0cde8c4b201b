// Starts a page that is a file of its own: it contains its program, and the sources of a circuit.

import { App } from "../app";
import { rememberApart } from "../memory";
import { restoreTheme } from "../theme";
import { TabHost } from "./host";
import { decodeBase64 } from "../share/packed";

interface Sources {
  first: string;
  circuit: string;
  swarm: string | null;
  files: [path: string, text: string][];
}

function part(id: string): string {
  return document.getElementById(id)?.textContent ?? "";
}

const { first, circuit, swarm, files } = JSON.parse(part("sources")) as Sources;
// Browsers take all files of a disk for one place.
rememberApart(files.map(([path, text]) => `${path} ${text.length}`).join());
restoreTheme();
const worker = URL.createObjectURL(new Blob([part("worker")], { type: "text/javascript" }));
const host = new TabHost({
  worker: () => new Worker(worker),
  program: () => ({ packed: decodeBase64(part("program")).buffer }),
  first,
  files,
  keeps: false,
});
new App(host, { circuit, swarm }).start();
