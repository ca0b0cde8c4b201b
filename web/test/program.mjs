// Starts the program named by NBC with a folder of its own. It serves its own page, or that of the folder NBC_PAGE. With
// NBC_SITE, the folder of the page that needs no program is served instead, and begins with the files of the folder.

import { spawn } from "node:child_process";
import { mkdtempSync, readdirSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import path from "node:path";

import { serveFiles } from "./files.mjs";

/** The folder of the page that needs no program. */
export const SITE = process.env.NBC_SITE && path.resolve(process.env.NBC_SITE);
const PROGRAM = process.env.NBC;
const PAGE = process.env.NBC_PAGE && path.resolve(process.env.NBC_PAGE);
if (PROGRAM === undefined && SITE === undefined) {
  throw new Error("NBC must name the program, for example NBC=../target/release/nbc");
}

export const LATCH = readFileSync(new URL("../../circuits/latch.nb", import.meta.url), "utf8");

/** A folder with files, removed at the end. */
export function folderWith(files) {
  const folder = mkdtempSync(path.join(tmpdir(), "nbc-play-"));
  for (const [name, text] of Object.entries(files)) {
    writeFileSync(path.join(folder, name), text);
  }
  return { folder, remove: () => rmSync(folder, { recursive: true, force: true }) };
}

/** The files with which the page at an address begins in a browser that has none, and a document beside it. */
const seeds = new Map();

export function seedOf(url) {
  return seeds.get(url.replace(/#.*/, "")) ?? null;
}

/** Whether a test needs what a browser tab does not have: the reason to skip it there. */
export function needs(what) {
  return SITE !== undefined && `a browser tab has no ${what}`;
}

async function playSite(folder, file) {
  const { address, stop } = await serveFiles(SITE);
  const url = file === undefined ? address : `${address}#${encodeURI(file)}`;
  const names = readdirSync(folder).filter(name => /\.\w+$/.test(name));
  const files = names.map(name => [name, readFileSync(path.join(folder, name), "utf8")]);
  seeds.set(address, { at: `${address}NOTICES.txt`, files });
  return { url, address, stop };
}

/** Serves a folder, and opens its `file` first. `more` are further options. */
export async function play(folder, file, { port = 0, token, more = [] } = {}) {
  return SITE === undefined ? serve(folder, file, { port, token, more }) : playSite(folder, file);
}

/** Serves a folder with the program. */
export async function serve(folder, file, { port = 0, token, more = [] } = {}) {
  const options = [
    "--no-open",
    "--port",
    String(port),
    ...option("--token", token),
    ...option("--page", PAGE),
    ...more,
  ];
  const child = spawn(path.resolve(PROGRAM), ["play", ...(file === undefined ? [] : [file]), ...options], {
    cwd: folder,
    stdio: ["ignore", "pipe", "inherit"],
  });
  const ended = new Promise(resolve => child.once("exit", resolve));
  const output = { text: "" };
  const url = await addressOf(child, output);
  return {
    url,
    /** The address without a file. */
    address: url,
    port: Number(new URL(url).port),
    token: new URL(url).pathname.split("/")[1],
    /** The address of the teacher's page, if there is a class. */
    teacher: () => /(\S+) \(for the teacher\)/.exec(output.text)?.[1],
    stop: async () => {
      child.kill("SIGTERM");
      await ended;
    },
  };
}

function option(name, value) {
  return value ? [name, value] : [];
}

function addressOf(child, output) {
  return new Promise((resolve, reject) => {
    child.stdout.on("data", part => {
      output.text += part;
      const found = /http:\/\/\S+/.exec(output.text);
      if (found !== null) {
        resolve(found[0]);
      }
    });
    child.once("exit", code => reject(new Error(`the program ended with ${code} before it printed its address`)));
  });
}
