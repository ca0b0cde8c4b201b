// A value that others can follow.

export type Listener<T> = (value: T) => void;

export class Observable<T> {
  readonly #listeners = new Set<Listener<T>>();
  #value: T;

  constructor(value: T) {
    this.#value = value;
  }

  get value(): T {
    return this.#value;
  }

  set(value: T): void {
    if (!Object.is(this.#value, value)) {
      this.#value = value;
      this.notify();
    }
  }

  /** Tells all listeners, after a change inside the value. */
  notify(): void {
    for (const listener of [...this.#listeners]) {
      listener(this.#value);
    }
  }

  /** Calls `listener` after each change; the result ends this. */
  on(listener: Listener<T>): () => void {
    this.#listeners.add(listener);
    return () => this.#listeners.delete(listener);
  }

  /** Calls `listener` now and after each change. */
  follow(listener: Listener<T>): () => void {
    listener(this.#value);
    return this.on(listener);
  }
}
