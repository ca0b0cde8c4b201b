// What most tests begin with: a program in a folder of its own, and a page of it on which robots walk.

import { after, before } from "node:test";

import { closeBrowser, visit, walking } from "./browser.mjs";
import { folderWith, play } from "./program.mjs";

/** Serves `first`, one of `files`, during the tests of a file. What it returns is filled in before them. */
export function served(files, first, options = {}) {
  const here = {};
  before(async () => {
    here.place = folderWith(files);
    here.program = await play(here.place.folder, first, options);
  });
  after(async () => {
    await closeBrowser();
    await here.program?.stop();
    here.place?.remove();
  });
  return here;
}

/**
 * Opens `first`, one of `files`, before the tests of a file, and closes all after them. What it returns is filled in
 * then, and the page made `ready`.
 */
export function opened(files, first, ready = () => {}) {
  const here = {};
  before(async () => {
    here.place = folderWith(files);
    here.program = await play(here.place.folder, first);
    here.page = await visit(here.program.url);
    await walking(here.page);
    await ready(here.page);
  });
  after(async () => {
    await here.page?.leave();
    await closeBrowser();
    await here.program?.stop();
    here.place?.remove();
  });
  return here;
}
