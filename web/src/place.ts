// Where one is in the page, as the history of the browser has it: what is after `#` in the address, and the tab.

import type { TabName } from "./layout";
import { isShare } from "./share/link";

interface Place {
  fragment: string;
  tab: TabName | null;
}

export class Places {
  #isNoted = false;
  #fragment: string | null = null;
  #tab: TabName | null = null;
  #replaces = false;

  /** Calls `shows` with the tab of a place to which the browser goes back or forth. */
  constructor(shows: (tab: TabName) => void) {
    addEventListener("popstate", () => {
      const { tab } = present();
      if (tab !== null) {
        shows(tab);
      }
    });
  }

  /** Whether the present place is one of this page, to which the browser has come back, rather than a new address. */
  get isKnown(): boolean {
    return present().tab !== null;
  }

  /** Notes where one is now: Back leads to the place before. What changes at once is one place. */
  note({ fragment, tab }: Partial<Place>): void {
    if (!this.#isNoted) {
      this.#isNoted = true;
      queueMicrotask(() => this.#commit());
    }
    this.#fragment = fragment ?? this.#fragment;
    this.#tab = tab ?? this.#tab;
  }

  rename(fragment: string): void {
    this.#replaces = true;
    this.note({ fragment });
  }

  #commit(): void {
    const before = present();
    const after: Place = { fragment: this.#fragment ?? before.fragment, tab: this.#tab };
    const replaces = this.#replaces || before.tab === null || before.fragment === "" || isShare(before.fragment);
    this.#isNoted = false;
    this.#fragment = null;
    this.#replaces = false;
    if (after.fragment !== before.fragment || after.tab !== before.tab) {
      history[replaces ? "replaceState" : "pushState"]({ tab: after.tab }, "", `#${after.fragment}`);
    }
  }
}

function present(): Place {
  const state = history.state as { tab?: TabName } | null;
  return { fragment: location.hash.slice(1), tab: state?.tab ?? null };
}
