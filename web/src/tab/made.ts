// The files that the program has made, until the page has fetched them.

/** The page fetches each at once. */
const MOST = 8;

export class MadeFiles {
  readonly #addresses = new Map<string, string>();

  address(name: string): string {
    return this.#addresses.get(name) ?? name;
  }

  add(name: string, type: string, bytes: ArrayBuffer): void {
    this.#addresses.set(name, URL.createObjectURL(new Blob([bytes], { type })));
    const [oldest] = this.#addresses;
    if (oldest !== undefined && this.#addresses.size > MOST) {
      this.#addresses.delete(oldest[0]);
      URL.revokeObjectURL(oldest[1]);
    }
  }
}
