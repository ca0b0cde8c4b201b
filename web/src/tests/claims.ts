// What is claimed of the circuits of the program: prove it, and watch the run that refutes a property.

import type { Connection } from "../connection";
import { button, element, fill } from "../element";
import type { Program } from "../program";
import type { Claim, DecidedProperty } from "../protocol";
import { type Attempt, attemptBar, Attempts, placeOf } from "./attempts";

/** A claim with its number in the program. */
type NumberedClaim = Claim & { index: number };

export type ClaimState = Attempt<{ properties: DecidedProperty[] }>;

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
  readonly #attempts = new Attempts<{ properties: DecidedProperty[] }>();
  readonly states = this.#attempts.states;

  constructor(
    private readonly connection: Connection,
    private readonly program: Program,
    private readonly leads: ClaimLeads,
  ) {
    program.checked.on(() => this.#attempts.clear());
    this.states.follow(() => fill(this.host, ...this.#claims().map(claim => this.#card(claim))));
  }

  #claims(): NumberedClaim[] {
    return (this.program.checked.value?.claims ?? []).map((claim, index) => ({ ...claim, index }));
  }

  async #prove(declared: NumberedClaim): Promise<void> {
    await this.leads.settle();
    const claim = placeOf(declared, this.#claims());
    if (claim !== undefined) {
      const fields = { path: this.program.path.value, claim };
      await this.#attempts.run(claim, ({ signal }) => this.connection.request("prove", fields, { signal }));
    }
  }

  #card(claim: NumberedClaim): HTMLElement {
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
        attemptBar(state),
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
  #known({ circuit }: Claim, known: DecidedProperty | undefined): (HTMLElement | null)[] {
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
