// The answers of the server's commands, which the lenses run.

import * as path from "node:path";

/** The commands of the server. Their argument is an object with the `uri` of an open text, and what to run of it. */
export type Order = "nbc.run" | "nbc.test" | "nbc.prove" | "nbc.schematic" | "nbc.timing";

export type Shown =
  | { kind: "report"; title: string; file: string }
  /** A picture that `nbc` wrote, as SVG. */
  | { kind: "drawing"; title: string; file: string }
  | { kind: "text"; title: string; text: string };

/** What to show of the answer to a command; `undefined` if it is not an answer of `nbc`. */
export function shownOf(order: string, argument: unknown, answer: unknown): Shown | undefined {
  if (typeof answer !== "object" || answer === null) {
    return undefined;
  }
  const { text, path: file } = answer as { text?: unknown; path?: unknown };
  const title = titleOf(argument);
  if (typeof file === "string") {
    return { kind: file.endsWith(".svg") ? "drawing" : "report", title, file };
  }
  return typeof text === "string" && ["nbc.prove", "nbc.timing"].includes(order)
    ? { kind: "text", title, text }
    : undefined;
}

function titleOf(argument: unknown): string {
  const { uri, circuit, swarm } = (argument ?? {}) as { uri?: unknown; circuit?: unknown; swarm?: unknown };
  const named = [swarm, circuit].find(name => typeof name === "string");
  return String(named ?? path.posix.basename(decodeURIComponent(String(uri ?? "nbc"))));
}
