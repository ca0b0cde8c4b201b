// Finding `nbc`: the order of places, programs that are not it, and workspaces that are not trusted.

import assert from "node:assert/strict";
import { test } from "node:test";

import { machine } from "../src/core/child";
import { candidates, explain, locate, type Prober, type Surroundings } from "../src/core/locate";
import { NBC } from "./nbc";

const HERE: Surroundings = {
  setting: "",
  searchPath: "/usr/bin:bin::/opt/bin",
  home: "/home/ada",
  workspaces: ["/work"],
  trusted: true,
  windows: false,
};

/** A machine with these files, each with its version; programs without a language server end with `!`. */
function made(files: Record<string, string>): Prober {
  return {
    real: program => (program in files || program === "/work" ? program : undefined),
    output: async (program, args) => {
      const version = files[program]!;
      if (args[0] === "--version") {
        return version.replace("!", "\n");
      }
      assert.deepEqual(args, ["lsp", "--help"]);
      if (version.endsWith("!")) {
        throw new Error("exit status 2");
      }
      return "Serve editors";
    },
  };
}

test("the places are tried in order, and relative folders of PATH are not among them", () => {
  assert.deepEqual(candidates(HERE), [
    "/usr/bin/nbc",
    "/opt/bin/nbc",
    "/home/ada/.cargo/bin/nbc",
    "/work/target/release/nbc",
  ]);
  assert.equal(candidates({ ...HERE, windows: true, searchPath: "" })[0], "/home/ada/.cargo/bin/nbc.exe");
});

test("the setting is the only place if it is set", () => {
  assert.deepEqual(candidates({ ...HERE, setting: "~/nbc" }), ["/home/ada/nbc"]);
  assert.deepEqual(candidates({ ...HERE, setting: "${workspaceFolder}/x/nbc" }), ["/work/x/nbc"]);
  assert.deepEqual(candidates({ ...HERE, setting: "x/nbc" }), ["/work/x/nbc"]);
});

test("other programs of this name and versions without a server are passed over", async () => {
  const prober = made({
    "/usr/bin/nbc": "Next Byte Codes Compiler version 1.2",
    "/opt/bin/nbc": "nbc 0.1.0!",
    "/home/ada/.cargo/bin/nbc": "nbc 0.2.0\n",
  });
  const found = await locate(HERE, prober);
  assert.deepEqual(found, { kind: "found", program: "/home/ada/.cargo/bin/nbc", version: "0.2.0" });
});

test("what was rejected is explained", async () => {
  const prober = made({ "/usr/bin/nbc": "Next Byte Codes", "/opt/bin/nbc": "nbc 0.1.0!" });
  const missing = await locate(HERE, prober);
  assert.ok(missing.kind === "missing");
  assert.equal(
    explain(missing),
    "`nbc` was not found (`/usr/bin/nbc`: it is another program of this name; `/opt/bin/nbc`: version 0.1.0 has no " +
      "language server; a newer one is needed).",
  );
  const none = await locate(HERE, made({}));
  assert.ok(none.kind === "missing");
  assert.match(explain(none), /^`nbc` was not found\. Highlighting/);
  const wrong = await locate({ ...HERE, setting: "/no/nbc" }, made({}));
  assert.ok(wrong.kind === "missing");
  assert.equal(explain(wrong), "`nbc.path` cannot be used (`/no/nbc`: there is no such file).");
});

test("a program of an untrusted workspace is never started", async () => {
  const prober: Prober = {
    real: program => (program.startsWith("/link") ? program.replace("/link", "/work") : program),
    output: () => assert.fail("it was started"),
  };
  const untrusted = { ...HERE, trusted: false, searchPath: "/work/bin:/link/bin", home: "/work" };
  const missing = await locate(untrusted, prober);
  assert.ok(missing.kind === "missing");
  assert.deepEqual(
    missing.rejected.map(({ program, reason }) => [program, reason]),
    ["/work/bin/nbc", "/link/bin/nbc", "/work/.cargo/bin/nbc"].map(program => [
      program,
      "it is in the workspace, which is not trusted",
    ]),
  );
  const setting = await locate({ ...untrusted, setting: "/work/nbc" }, prober);
  assert.equal(setting.kind, "missing");
});

test("the real program is found", async () => {
  const found = await locate({ ...HERE, setting: NBC }, machine);
  assert.ok(found.kind === "found", JSON.stringify(found));
  assert.match(found.version, /^\d+\.\d+\.\d+$/);
});

test("a file that is no program is rejected", async () => {
  const missing = await locate({ ...HERE, setting: process.cwd() + "/package.json" }, machine);
  assert.ok(missing.kind === "missing");
  assert.match(explain(missing), /it cannot be started: .*EACCES/);
});
