// Bundles the page into dist/, with the licenses of the packages in it, and the page of exported files, which uses no
// package; with --tests, the unit tests into build/unit/.
// The bytes depend only on the sources and the locked packages, so that they can be committed and compared.

import { createHash } from "node:crypto";
import { mkdirSync, readdirSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import path from "node:path";
import { fileURLToPath } from "node:url";

import { build } from "esbuild";

process.chdir(path.dirname(fileURLToPath(import.meta.url)));

const common = { bundle: true, logLevel: "warning", charset: "utf8", sourcemap: false };

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
  writeFileSync("dist/player.html", await player());
}

/**
 * The page for a file of its own. It contains its script and style, and its policy permits these alone: nothing can be
 * loaded, and nothing that the program adds can be a script.
 */
async function player() {
  const bundle = async (options, entry) =>
    (await build({ ...options, entryPoints: [entry], write: false, outdir: "dist" })).outputFiles[0].text.trim();
  const code = (await bundle(script, "src/player/main.ts")).replaceAll("</script", "<\\/script");
  const style = await bundle({ ...common, minify: true }, "src/style/player.css");
  const hash = text => `'sha256-${createHash("sha256").update(text).digest("base64")}'`;
  const policy =
    `default-src 'none'; script-src ${hash(code)}; style-src ${hash(style)}; img-src data: blob:; ` +
    "base-uri 'none'; form-action 'none'";
  const parts = { policy, style, script: code };
  return readFileSync("src/player/index.html", "utf8").replace(/\{\{(\w+)\}\}/g, (_, name) => parts[name]);
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

await (process.argv.includes("--tests") ? unitTests() : page());
