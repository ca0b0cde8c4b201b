// The manifest agrees with the sources, and the pure parts need no editor.

import assert from "node:assert/strict";
import { existsSync, readdirSync, readFileSync } from "node:fs";
import { test } from "node:test";

const manifest = JSON.parse(readFileSync("package.json", "utf8"));
const sources = ["src", "src/core", "src/editor"].flatMap(folder =>
  readdirSync(folder)
    .filter(name => name.endsWith(".ts"))
    .map(name => ({ name: `${folder}/${name}`, text: readFileSync(`${folder}/${name}`, "utf8") })),
);

test("the core knows no editor", () => {
  const core = sources.filter(({ name }) => name.startsWith("src/core/"));
  assert.ok(core.length > 5);
  core.forEach(({ name, text }) => assert.doesNotMatch(text, /from "(vscode|\.\.\/)(?!.*\/web\/src\/protocol")/, name));
});

test("every command is registered, and every registered command is in the manifest", () => {
  const extension = sources.find(({ name }) => name === "src/extension.ts")!.text;
  const registered = [...extension.matchAll(/command\("(nbc\.\w+)"/g)].map(match => match[1]!).sort();
  const declared = manifest.contributes.commands.map(({ command }: { command: string }) => command).sort();
  assert.deepEqual(registered, declared);
  const listed = manifest.contributes.menus.commandPalette.map(({ command }: { command: string }) => command);
  listed.forEach((command: string) => assert.ok(declared.includes(command), command));
});

test("every setting is described in the README", () => {
  const readme = readFileSync("README.md", "utf8");
  const settings = Object.keys(manifest.contributes.configuration.properties);
  settings.forEach(name => assert.ok(readme.includes(`\`${name}\``), name));
  manifest.contributes.commands.forEach(({ title }: { title: string }) => assert.ok(readme.includes(title), title));
});

test("the version is that of the project, and the files of the manifest exist", () => {
  const cargo = readFileSync("../../Cargo.toml", "utf8");
  assert.equal(manifest.version, /^version = "([^"]*)"/m.exec(cargo)![1]);
  const { languages, grammars, snippets } = manifest.contributes;
  const files = [manifest.icon, languages[0].configuration, grammars[0].path, snippets[0].path, "LICENSE"];
  files.forEach(file => assert.ok(existsSync(file), file));
});

test("the bundle has the notices of its packages", () => {
  const notices = readFileSync("dist/NOTICES.txt", "utf8");
  const bundle = JSON.parse(readFileSync("package-lock.json", "utf8")).packages;
  const packed = Object.entries<{ dev?: boolean; version: string }>(bundle).filter(([name, { dev }]) => name && !dev);
  assert.ok(packed.length > 5);
  for (const [folder, { version }] of packed) {
    assert.ok(notices.includes(`\n${folder.replace("node_modules/", "")} ${version} (`), folder);
  }
});

test("a workspace that is not trusted cannot name the program", () => {
  const { supported, restrictedConfigurations } = manifest.capabilities.untrustedWorkspaces;
  assert.equal(supported, "limited");
  assert.deepEqual(restrictedConfigurations, ["nbc.path"]);
});

test("every file has a description and narrow lines", () => {
  const tests = readdirSync("test").filter(name => name.endsWith(".ts"));
  const all = [...sources, ...tests.map(name => ({ name, text: readFileSync(`test/${name}`, "utf8") }))];
  for (const { name, text } of all) {
    assert.match(text, /^\/\/ [A-Z]/, name);
    text.split("\n").forEach((line, at) => assert.ok(line.length <= 120, `${name}:${at + 1}`));
  }
});
