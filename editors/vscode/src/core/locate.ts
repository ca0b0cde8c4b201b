// Finding the program `nbc`: the setting, then PATH, then ~/.cargo/bin, then target/release of the workspace.

import * as path from "node:path";

export interface Surroundings {
  /** The setting `nbc.path`; empty if it is not set. */
  setting: string;
  searchPath: string;
  home: string;
  workspaces: string[];
  /** Whether programs of the workspace may be started. */
  trusted: boolean;
  windows: boolean;
}

export interface Rejected {
  program: string;
  reason: string;
}

export type Located =
  { kind: "found"; program: string; version: string } | { kind: "missing"; rejected: Rejected[]; setting: boolean };

export interface Prober {
  /** The path without links, if it is a file. */
  real(program: string): string | undefined;
  /** Standard output of the program with these arguments; rejects unless it exits 0. */
  output(program: string, args: string[]): Promise<string>;
}

/** The paths at which `nbc` may be, in the order in which they are tried. */
export function candidates(around: Surroundings): string[] {
  if (around.setting !== "") {
    return [expanded(around.setting, around)];
  }
  const name = around.windows ? "nbc.exe" : "nbc";
  const folders = around.searchPath
    .split(around.windows ? ";" : ":")
    // A relative folder would mean another program in each workspace.
    .filter(folder => path.isAbsolute(folder))
    .concat(path.join(around.home, ".cargo", "bin"))
    .concat(around.trusted ? around.workspaces.map(folder => path.join(folder, "target", "release")) : []);
  return [...new Set(folders.map(folder => path.join(folder, name)))];
}

/** Tries the candidates until one is `nbc` with a language server. */
export async function locate(around: Surroundings, prober: Prober): Promise<Located> {
  const rejected: Rejected[] = [];
  const setting = around.setting !== "";
  for (const program of candidates(around)) {
    const real = prober.real(program);
    if (real === undefined) {
      if (setting) {
        rejected.push({ program, reason: "there is no such file" });
      }
      continue;
    }
    if (!around.trusted && around.workspaces.some(folder => contains(prober.real(folder) ?? folder, real))) {
      rejected.push({ program, reason: "it is in the workspace, which is not trusted" });
      continue;
    }
    const found = await probe(program, prober);
    if (typeof found === "object") {
      return { kind: "found", program, version: found.version };
    }
    rejected.push({ program, reason: found });
  }
  return { kind: "missing", rejected, setting };
}

/** The version of a program, or the reason why it cannot be used. */
async function probe(program: string, prober: Prober): Promise<{ version: string } | string> {
  let printed: string;
  try {
    printed = await prober.output(program, ["--version"]);
  } catch (error) {
    return `it cannot be started: ${error instanceof Error ? error.message : String(error)}`;
  }
  const version = /^nbc (\d+\.\d+\.\d+\S*)\s*$/.exec(printed)?.[1];
  if (version === undefined) {
    return "it is another program of this name";
  }
  try {
    await prober.output(program, ["lsp", "--help"]);
  } catch {
    return `version ${version} has no language server; a newer one is needed`;
  }
  return { version };
}

export function explain(missing: Extract<Located, { kind: "missing" }>): string {
  if (missing.rejected.length === 0) {
    return "`nbc` was not found. Highlighting and snippets work without it; errors, tests and runs need it.";
  }
  const list = missing.rejected.map(({ program, reason }) => `\`${program}\`: ${reason}`).join("; ");
  const where = missing.setting ? "`nbc.path` cannot be used" : "`nbc` was not found";
  return `${where} (${list}).`;
}

function expanded(setting: string, around: Surroundings): string {
  const home = setting.replace(/^~(?=[\\/]|$)/, () => around.home);
  const whole = home.replaceAll("${workspaceFolder}", () => around.workspaces[0] ?? "");
  return path.resolve(around.workspaces[0] ?? around.home, whole);
}

function contains(folder: string, file: string): boolean {
  const relative = path.relative(folder, file);
  return relative !== "" && relative.split(path.sep)[0] !== ".." && !path.isAbsolute(relative);
}
