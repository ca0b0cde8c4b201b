// Bundles the page into dist/, with the licenses of the packages in it and, in report/, the scripts and the style of
// the pages of results, which use no package; with --tests, the unit tests into build/unit/;
// with --tab PROGRAM FOLDER, the page that needs no server into a folder, with the program as WebAssembly.
// The bytes depend only on the sources and the locked packages, so that they can be committed and compared.

import { createHash } from "node:crypto";
import { mkdirSync, readdirSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import path from "node:path";
import { fileURLToPath } from "node:url";
import { deflateRawSync, gzipSync } from "node:zlib";

import { build } from "esbuild";

const [task, ...named] = process.argv.slice(2);
const given = named.map(name => path.resolve(name));
process.chdir(path.dirname(fileURLToPath(import.meta.url)));

// Whoever starts this may be in another folder.
const common = { absWorkingDir: process.cwd(), bundle: true, logLevel: "warning", charset: "utf8", sourcemap: false };

const script = {
  ...common,
  format: "iife",
  platform: "browser",
  target: "es2022",
  minify: true,
  legalComments: "none",
  metafile: true,
};

async function page() {
  rmSync("dist", { recursive: true, force: true });
  mkdirSync("dist");
  const bundled = await build({ ...script, entryPoints: ["src/main.ts"], outfile: "dist/app.js" });
  await build({ ...script, metafile: false, entryPoints: ["src/class/main.ts"], outfile: "dist/class.js" });
  for (const sheet of ["app", "class"]) {
    await build({ ...common, entryPoints: [`src/style/${sheet}.css`], outfile: `dist/${sheet}.css`, minify: true });
  }
  writeFileSync("dist/index.html", readFileSync("src/index.html"));
  writeFileSync("dist/class.html", readFileSync("src/class.html"));
  writeFileSync("dist/NOTICES.txt", notices(Object.keys(bundled.metafile.inputs)));
  mkdirSync("dist/report");
  for (const report of ["run", "evolution", "sheets"]) {
    writeFileSync(`dist/report/${report}.js`, await bundle(script, `src/report/${report}.ts`));
  }
  writeFileSync("dist/report/report.css", await bundle(sheet, "src/style/report.css"));
}

/** What stands in a live page for its program: the page that makes one has that already. */
const PLACE = "{{program}}";

/**
 * The page of a browser tab as a file of its own: only the program and the sources of a circuit are missing. It contains its script and
 * style, both packed, and its policy permits these alone: nothing can be loaded, and nothing that the program adds can
 * be a script.
 */
async function livePage() {
  const inside = {
    style: await bundle(sheet, "src/style/app.css"),
    script: await bundle(script, "src/tab/alone.ts"),
    worker: await bundle(script, "src/tab/worker.ts"),
  };
  const page = deflateRawSync(JSON.stringify(inside), { level: 9 });
  const parts = {
    script: await bundle(script, "src/tab/unpack.ts"),
    style: "",
    data: [
      inert("sources", "application/json"),
      inert("page", "application/octet-stream", page.toString("base64")),
      inert("program", "application/octet-stream", PLACE),
    ].join("\n"),
  };
  return alone(parts, {
    scripts: ` ${sourceOf(inside.script)} 'wasm-unsafe-eval'`,
    styles: ` ${sourceOf(inside.style)}`,
    more: " worker-src blob:;",
  });
}

/** An element with data, which a browser does not run. */
function inert(id, type, text = "") {
  return `<script type="${type}" id="${id}">${text}</script>`;
}

const sheet = { ...common, minify: true };

async function bundle(options, entry) {
  const built = await build({ ...options, entryPoints: [entry], write: false, outdir: "dist" });
  return built.outputFiles[0].text.trim().replaceAll("</script", "<\\/script");
}

/** A script or a style in a policy. */
function sourceOf(text) {
  return `'sha256-${createHash("sha256").update(text).digest("base64")}'`;
}

/** A document with its parts in it, and a policy that permits these. */
function alone(parts, { scripts = "", styles = "", more = "" } = {}) {
  const policy =
    `default-src 'none'; script-src ${sourceOf(parts.script)}${scripts};${more} ` +
    `style-src ${sourceOf(parts.style)}${styles}; ` +
    "img-src data: blob:; base-uri 'none'; form-action 'none'";
  const all = { ...parts, policy };
  return readFileSync("src/alone.html", "utf8").replace(/\{\{(\w+)\}\}/g, (_, name) => all[name]);
}

/** The licenses of the packages of which files are in the bundle. */
function notices(files) {
  const folders = files.map(file => /^(.*node_modules\/(?:@[^/]+\/)?[^/]+)\//.exec(file)?.[1]);
  const packages = [...new Set(folders.filter(folder => folder !== undefined))].sort();
  const sections = packages.map(folder => {
    const { name, version, license } = JSON.parse(readFileSync(path.join(folder, "package.json"), "utf8"));
    const text = readdirSync(folder)
      .sort()
      .find(file => /^licen[cs]e/i.test(file));
    if (text === undefined) {
      throw new Error(`${name} has no text of its license`);
    }
    return `${name} ${version} (${license})\n\n${readFileSync(path.join(folder, text), "utf8").trim()}\n`;
  });
  return `Packages that are part of this page, with their licenses.\n\n${sections.join("\n----\n\n")}`;
}

async function unitTests() {
  rmSync("build/unit", { recursive: true, force: true });
  const files = readdirSync("unit")
    .filter(file => file.endsWith(".test.ts"))
    .sort();
  await build({
    ...common,
    entryPoints: files.map(file => `unit/${file}`),
    outdir: "build/unit",
    format: "esm",
    platform: "node",
    target: "node20",
    outExtension: { ".js": ".mjs" },
  });
}

/**
 * The page that has its program in itself: for any server of files, in any folder. The names of what the document
 * loads contain a hash, so that a browser never takes a file of another version.
 */
async function tab(program, folder) {
  rmSync(folder, { recursive: true, force: true });
  mkdirSync(folder, { recursive: true });
  const packed = gzipSync(readFileSync(program), { level: 9 });
  const name = `program-${digest(packed)}.bin`;
  writeFileSync(path.join(folder, name), packed);
  const hashed = { outdir: folder, entryNames: "[name]-[hash]", metafile: true };
  const made = async options =>
    path.basename(Object.keys((await build({ ...options, ...hashed })).metafile.outputs)[0]);
  const worker = await made({ ...script, entryPoints: ["src/tab/worker.ts"] });
  const live = await livePage();
  const template = `alone-${digest(live)}.html`;
  writeFileSync(path.join(folder, template), live);
  // For a program that is built with it.
  writeFileSync(path.join(folder, "alone.html"), live.replace(PLACE, packed.toString("base64")));
  const define = { PROGRAM: JSON.stringify({ name, bytes: packed.length, worker, template }) };
  const app = await made({ ...script, define, entryPoints: { app: "src/tab/main.ts" } });
  const style = await made({ ...sheet, entryPoints: ["src/style/app.css"] });
  writeFileSync(path.join(folder, "index.html"), tabDocument({ "app.js": app, "app.css": style }));
  writeFileSync(path.join(folder, "NOTICES.txt"), readFileSync("dist/NOTICES.txt"));
  const files = ["./", style, app, worker, template, name];
  const version = digest(readFileSync(path.join(folder, "index.html")));
  const offline = { VERSION: JSON.stringify(version), FILES: JSON.stringify(files) };
  await build({ ...script, metafile: false, outdir: folder, define: offline, entryPoints: ["src/tab/offline.ts"] });
}

/** The document of the tab, with the names of its files, and with the policy that a server would send. */
function tabDocument(names) {
  const policy =
    "default-src 'none'; script-src 'self' 'wasm-unsafe-eval'; worker-src 'self'; style-src 'self'; " +
    "img-src 'self' data: blob:; connect-src 'self'; font-src 'self'; base-uri 'none'; form-action 'none'";
  const meta = `<meta http-equiv="content-security-policy" content="${policy}">`;
  return readFileSync("src/index.html", "utf8")
    .replace('<meta charset="utf-8">', `$&\n${meta}`)
    .replace(/app\.(js|css)/g, name => names[name]);
}

/** A short name of some bytes. */
function digest(parts) {
  const hash = createHash("sha256");
  [parts].flat().forEach(part => hash.update(part));
  return hash.digest("hex").slice(0, 16);
}

const tasks = { "--tests": unitTests, "--tab": () => tab(...given) };
await (tasks[task] ?? page)();
