// Tests of the highlighting: the cases in test/grammar, and those programs of the gallery that have a snapshot, which
// together have every kind of word. With --update, the snapshots are written again.

import { spawnSync } from "node:child_process";
import { copyFileSync, mkdirSync, readdirSync, rmSync } from "node:fs";
import path from "node:path";

const [gallery, snapshots, build] = ["../../circuits", "test/snapshots", "build/grammar"];
const update = process.argv.includes("--update");

function run(name, args) {
  const script = path.join("node_modules/vscode-tmgrammar-test/dist", name);
  const { status } = spawnSync(process.execPath, [script, ...args], { stdio: "inherit" });
  if (status !== 0) {
    process.exit(1);
  }
}

// Snapshots must be beside the programs.
rmSync(build, { recursive: true, force: true });
mkdirSync(build, { recursive: true });
const known = readdirSync(snapshots);
const programs = known.map(name => name.replace(/\.snap$/, ""));
programs.forEach(name => copyFileSync(path.join(gallery, name), path.join(build, name)));
if (!update) {
  known.forEach(name => copyFileSync(path.join(snapshots, name), path.join(build, name)));
}

run("unit.js", ["test/grammar/*.nb"]);
run("snapshot.js", [...(update ? ["--updateSnapshot"] : []), `${build}/*.nb`]);
if (update) {
  programs.forEach(name => copyFileSync(path.join(build, `${name}.snap`), path.join(snapshots, `${name}.snap`)));
}
