// The tests of a step that the page does not show: each runs once the learner's own tests pass.

import type { Connection } from "../connection";
import type { Program } from "../program";
import type { TestAnswer } from "../protocol";
import { RequestError } from "../request";

export class HiddenTests {
  /** Why the program fails each test, null if it passes. */
  readonly failures = new Map<string, string | null>();
  #text = "";

  constructor(
    private readonly connection: Connection,
    private readonly program: Program,
    private readonly changed: () => void,
  ) {}

  async run(test: string): Promise<void> {
    const { path, text } = this.program;
    if (this.#text !== text) {
      this.#text = text;
      this.failures.clear();
    }
    if (this.failures.has(test)) {
      return;
    }
    this.failures.set(test, "it is being tried");
    const found = await this.connection
      .request("test", { path: path.value, test, level: "logic" })
      .then(failureOf, (error: RequestError) => error.diagnostics[0]?.message ?? error.message);
    if (this.#text === text) {
      this.failures.set(test, found);
      this.changed();
    }
  }
}

function failureOf({ results }: TestAnswer): string | null {
  for (const { outputs, rows } of results) {
    const row = rows.find(({ passed }) => !passed);
    for (const [i, { bits, text }] of row?.expected.entries() ?? []) {
      const seen = row?.observed[i];
      if (seen !== undefined && [...bits].some((bit, at) => bit !== "-" && bit !== seen.bits[at])) {
        return `after ${row?.inputs.map(value => value.text).join(" ")}, ${outputs[i]?.name} is ${seen.text}, not ${text}`;
      }
    }
  }
  return null;
}
