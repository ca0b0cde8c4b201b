// Bundles the extension into dist/, with the notices of the packages that are in it; with --tests, the tests into build/.

import { readdirSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import path from "node:path";

import { build } from "esbuild";

const common = { bundle: true, platform: "node", target: "node20", logLevel: "warning" };

async function extension(production) {
  const result = await build({
    ...common,
    entryPoints: ["src/extension.ts"],
    outfile: "dist/extension.js",
    format: "cjs",
    external: ["vscode"],
    minify: production,
    sourcemap: production ? false : "linked",
    metafile: true,
  });
  writeFileSync("dist/NOTICES.txt", notices(Object.keys(result.metafile.inputs)));
}

/** The licenses of the packages of which files are in the bundle. */
function notices(files) {
  const folders = files.map(file => /^(.*node_modules\/(?:@[^/]+\/)?[^/]+)\//.exec(file)?.[1]);
  const packages = [...new Set(folders.filter(folder => folder !== undefined))].sort();
  const sections = packages.map(folder => {
    const { name, version, license } = JSON.parse(readFileSync(path.join(folder, "package.json"), "utf8"));
    const text = readdirSync(folder).find(file => /^licen[cs]e/i.test(file));
    if (text === undefined) {
      throw new Error(`${name} has no text of its license`);
    }
    return `${name} ${version} (${license})\n\n${readFileSync(path.join(folder, text), "utf8").trim()}\n`;
  });
  return `Packages that are part of this extension, with their licenses.\n\n${sections.join("\n----\n\n")}`;
}

async function tests() {
  // What is there is run, so tests of before must not be.
  rmSync("build/test", { recursive: true, force: true });
  const files = readdirSync("test").filter(file => file.endsWith(".test.ts"));
  await build({
    ...common,
    entryPoints: files.map(file => `test/${file}`),
    outdir: "build/test",
    format: "esm",
    outExtension: { ".js": ".mjs" },
    banner: {
      js: "import { createRequire as requireOf } from 'node:module'; const require = requireOf(import.meta.url);",
    },
    sourcemap: "inline",
  });
}

if (process.argv.includes("--tests")) {
  await tests();
}
await extension(process.argv.includes("--production"));
