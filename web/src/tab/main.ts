// Starts the page of a site, whose program is in a file beside it.

import { App } from "../app";
import { restoreTheme } from "../theme";
import { TabHost } from "./host";

/** The program's name, with a hash, and its size; put in by the build. */
declare const PROGRAM: { name: string; bytes: number };

restoreTheme();
const host = new TabHost({
  worker: () => new Worker(new URL("worker.js", document.baseURI)),
  program: () => ({ address: new URL(PROGRAM.name, document.baseURI).href, bytes: PROGRAM.bytes }),
  template: new URL("alone.html", document.baseURI).href,
  first: "",
  files: [],
  keeps: true,
});
new App(host).start();
// Without a network the page still opens. Where this is not to be had, such as on an insecure address, it needs one.
navigator.serviceWorker?.register("offline.js").catch(() => {});
