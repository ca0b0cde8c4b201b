// What is claimed of the circuits of the program: prove it, and watch the run that refutes a property.

import { CANCELLED, type Connection } from "../connection";
import { button, element, fill } from "../element";
import { Observable } from "../observable";
import type { Program } from "../program";
import type { ClaimEntry, DecidedProperty } from "../protocol";
import { RequestError } from "../request";

/** What is known of a claim. */
export type ClaimState =
  | { state: "running"; work: AbortController }
  | { state: "done"; properties: DecidedProperty[] }
  | { state: "failed"; message: string };

/** Where a claim leads to. */
export interface ClaimLeads {
  line: (line: number) => void;
  /** Waits for the check of the present text. */
  settle: () => Promise<void>;
  /** Shows the swarm of a circuit while a test, given as text, gives its inputs. */
  watch: (circuit: string, test: string) => void;
  /** Puts a test at the end of the program. */
  append: (test: string) => void;
}

const SIGNS = { proved: "✓ proved", refuted: "✗ refuted", undecided: "? undecided" };

export class ClaimCards {
  readonly host = element("div", { class: "list" });
  /** What is known of the claims by their numbers, for the present text. */
  readonly states = new Observable(new Map<number, ClaimState>());

  constructor(
    private readonly connection: Connection,
    private readonly program: Program,
    private readonly leads: ClaimLeads,
  ) {
    program.checked.on(() => {
      for (const state of this.states.value.values()) {
        if (state.state === "running") {
          state.work.abort();
        }
      }
      this.states.set(new Map());
    });
    this.states.follow(() => fill(this.host, ...this.#claims().map(claim => this.#card(claim))));
  }

  #claims(): ClaimEntry[] {
    return this.program.checked.value?.claims ?? [];
  }

  #set(index: number, state: ClaimState): void {
    this.states.value.set(index, state);
    this.states.notify();
  }

  async #prove({ circuit, title, index }: ClaimEntry): Promise<void> {
    await this.leads.settle();
    const same = this.#claims().filter(claim => claim.circuit === circuit && claim.title === title);
    const claim = (same.find(claim => claim.index === index) ?? same[0])?.index;
    if (claim === undefined) {
      return;
    }
    const work = new AbortController();
    const states = this.states.value;
    this.#set(claim, { state: "running", work });
    try {
      const fields = { path: this.program.path.value, claim };
      const { properties } = await this.connection.request("prove", fields, { signal: work.signal });
      // After an edit the result is about a claim that is no longer there.
      if (states === this.states.value) {
        this.#set(claim, { state: "done", properties });
      }
    } catch (error) {
      if (error instanceof RequestError && states === this.states.value) {
        const help = error.help === null ? "" : `; ${error.help}`;
        this.#set(claim, {
          state: "failed",
          message: error.code === CANCELLED ? "stopped" : `${error.message}${help}`,
        });
      }
    }
  }

  #card(claim: ClaimEntry): HTMLElement {
    const state = this.states.value.get(claim.index);
    const known = state?.state === "done" ? state.properties : null;
    const passed = known === null ? "" : String(known.every(({ verdict }) => verdict === "proved"));
    return element(
      "article",
      { class: "card test", "data-claim": claim.index, "data-state": state?.state ?? "none", "data-passed": passed },
      element(
        "header",
        {},
        element(
          "h3",
          {},
          button(claim.circuit, () => this.leads.line(claim.line), { class: "link" }),
        ),
        element("span", { class: "title" }, claim.title),
        element("span", { class: "count" }, "for ever"),
      ),
      element(
        "div",
        { class: "bar" },
        button("Prove", () => void this.#prove(claim), { "data-do": "prove", disabled: state?.state === "running" }),
        state?.state === "failed" && element("span", { class: "verdict fail" }, state.message),
        state?.state === "running" &&
          element(
            "span",
            { class: "verdict" },
            element("progress", { "aria-label": "Progress" }),
            button("Stop", () => state.work.abort(), { "data-do": "stop" }),
          ),
      ),
      element(
        "ul",
        { class: "properties" },
        ...claim.properties.map(({ property, line }, at) =>
          element(
            "li",
            { "data-verdict": known?.[at]?.verdict ?? "none" },
            button(property, () => this.leads.line(line), { class: "link", title: `Line ${line}` }),
            ...this.#known(claim, known?.[at]),
          ),
        ),
      ),
    );
  }

  /** What is known of a property, and the test that refutes it. */
  #known({ circuit }: ClaimEntry, known: DecidedProperty | undefined): (HTMLElement | null)[] {
    if (known === undefined) {
      return [];
    }
    const { verdict, how, test } = known;
    return [
      element("span", { class: `verdict ${verdict === "proved" ? "pass" : "fail"}` }, `${SIGNS[verdict]} ${how}`),
      test === undefined
        ? null
        : element(
            "div",
            {},
            element("pre", {}, test.trimEnd()),
            element(
              "div",
              { class: "bar" },
              button("Watch", () => this.leads.watch(circuit, test), {
                "data-do": "watch",
                title: "Shows the robots while the test gives their inputs",
              }),
              button("Add to the program", () => this.leads.append(test.trimEnd()), { "data-do": "append" }),
            ),
          ),
    ];
  }
}
