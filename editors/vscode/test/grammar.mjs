// Tests of the highlighting: the cases in test/grammar, and the gallery against its snapshots. With --update, the
// snapshots are written again.

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
const programs = readdirSync(gallery).filter(name => name.endsWith(".nb"));
programs.forEach(name => copyFileSync(path.join(gallery, name), path.join(build, name)));
if (!update) {
  const known = readdirSync(snapshots);
  const expected = programs.map(name => `${name}.snap`);
  const different = [
    ...known.filter(name => !expected.includes(name)),
    ...expected.filter(name => !known.includes(name)),
  ];
  if (different.length > 0) {
    console.error(`npm run snapshots; programs without a snapshot, or the reverse: ${different.join(", ")}`);
    process.exit(1);
  }
  known.forEach(name => copyFileSync(path.join(snapshots, name), path.join(build, name)));
}

run("unit.js", ["test/grammar/*.nb"]);
run("snapshot.js", [...(update ? ["--updateSnapshot"] : []), `${build}/*.nb`]);
if (update) {
  rmSync(snapshots, { recursive: true, force: true });
  mkdirSync(snapshots);
  programs.forEach(name => copyFileSync(path.join(build, `${name}.snap`), path.join(snapshots, `${name}.snap`)));
}
