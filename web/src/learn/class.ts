// The class: a learner can join it with a name, so that the teacher's page shows how far they are, and can leave it.

import type { Connection } from "../connection";
import { button, element, fill } from "../element";
import { learner, recall, remember, setLearner } from "../memory";
import { RequestError } from "../request";

interface Place {
  lesson: string;
  done: number;
  size: number | null;
}

const LONGEST = 24;

export class ClassPanel {
  readonly host = element("section", { class: "class card", "aria-label": "Class", hidden: true });
  readonly #problem = element("p", { class: "fail", role: "alert" });
  #joined: string | null = null;
  #told: { place: Place | null; finished: number } = { place: null, finished: 0 };

  constructor(private readonly connection: Connection) {}

  /** Shows whether the server has a class. A learner who had joined joins again. */
  async open(hasClass: boolean): Promise<void> {
    this.host.hidden = !hasClass;
    this.#joined = null;
    this.#show();
    const name = learner();
    if (hasClass && name !== null) {
      await this.#join(name);
    }
  }

  tell(place: Place | null, finished: number): void {
    if (JSON.stringify({ place, finished }) === JSON.stringify(this.#told)) {
      return;
    }
    this.#told = { place, finished };
    this.#send();
  }

  #send(): void {
    if (this.#joined !== null) {
      this.connection.tell("progress", { ...this.#told });
    }
  }

  async #join(name: string): Promise<void> {
    this.#problem.textContent = "";
    try {
      const key = keyOf(name);
      const joined = await this.connection.request("join", key === null ? { name } : { name, key });
      keepKey(name, joined.key);
      this.#joined = name;
      if (learner() !== name) {
        become(name);
      }
      this.#send();
    } catch (error) {
      if (!(error instanceof RequestError)) {
        throw error;
      }
      this.#problem.textContent = error.words;
    }
    this.#show();
  }

  #leave(): void {
    this.connection.tell("leave", {});
    if (this.#joined !== null) {
      keepKey(this.#joined, null);
    }
    this.#joined = null;
    become(null);
    this.#show();
  }

  #show(): void {
    if (this.#joined !== null) {
      fill(
        this.host,
        element("h3", {}, `You are in the class as ${this.#joined}`),
        element("p", {}, SEEN),
        button("Leave the class", () => this.#leave(), { "data-do": "leave-class" }),
      );
      return;
    }
    const field = element("input", {
      type: "text",
      maxlength: LONGEST,
      "aria-label": "Your name in the class",
      placeholder: "A name",
      autocomplete: "off",
      spellcheck: "false",
      "data-do": "class-name",
      value: learner() ?? "",
    });
    const join = (): void => void this.#join(field.value.trim());
    // A handler that returns false would swallow the key.
    field.addEventListener("keydown", event => {
      if (event.key === "Enter") {
        join();
      }
    });
    fill(
      this.host,
      element("h3", {}, "This is a class"),
      element("p", {}, `You can join it with a name. ${SEEN}`),
      element("p", { class: "row" }, field, button("Join the class", join, { "data-do": "join" })),
      this.#problem,
    );
  }
}

const SEEN =
  "The teacher's page shows your name, the lesson and step at which you are, the size of your smallest circuit in it, " +
  "and how many lessons you have finished. It may be on a projector, so that the whole class sees it. Your programs " +
  "are not shown. You can leave the class at any time.";

const KEYS = "class-keys";
const MOST_KEYS = 20;

function keyOf(name: string): string | null {
  return (recall<[string, string][]>(KEYS) ?? []).find(([other]) => other === name)?.[1] ?? null;
}

function keepKey(name: string, key: string | null): void {
  const others = (recall<[string, string][]>(KEYS) ?? []).filter(([other]) => other !== name);
  remember(KEYS, [...(key === null ? [] : [[name, key]]), ...others].slice(0, MOST_KEYS));
}

/**
 * Makes the page that of a learner, with drafts and progress of their own. What the page shows of others goes away with
 * a reload, where the browser can remember who it is.
 */
function become(name: string | null): void {
  setLearner(name);
  if (learner() === name) {
    location.reload();
  }
}
