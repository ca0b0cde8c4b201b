// Starts the page of a site, whose program is in a file beside it.

import { App } from "../app";
import { restoreTheme } from "../theme";
import { TabHost } from "./host";

/** The names of what the page loads, with hashes, and the program's size; put in by the build. */
declare const PROGRAM: { name: string; bytes: number; worker: string; template: string };

restoreTheme();
const address = (name: string): string => new URL(name, document.baseURI).href;
const host = new TabHost({
  worker: () => new Worker(address(PROGRAM.worker)),
  program: () => ({ address: address(PROGRAM.name), bytes: PROGRAM.bytes }),
  template: { page: address(PROGRAM.template), program: address(PROGRAM.name) },
  first: "",
  files: [],
  keeps: true,
});
const app = new App(host);
app.start();
// Without a network the page still opens. Where this is not to be had, such as on an insecure address, it needs one.
const offline = navigator.serviceWorker as ServiceWorkerContainer | undefined;
const script = (document.currentScript as HTMLScriptElement).src;
const look = (kept?: ServiceWorkerRegistration): void => void kept?.update().catch(() => {});
offline?.register("offline.js").then(
  kept => document.addEventListener("visibilitychange", () => look(kept)),
  () => {},
);
// A new version of the page says what it consists of.
offline?.addEventListener("message", ({ data }: MessageEvent<string[]>) => {
  if (!data.some(file => script.endsWith(file))) {
    app.offerReload();
  }
});
