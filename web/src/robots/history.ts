// What can be undone and done again.

const DEPTH = 200;

export class History<T> {
  #past: T[] = [];
  #future: T[] = [];

  constructor(public present: T) {}

  get canUndo(): boolean {
    return this.#past.length > 0;
  }

  get canRedo(): boolean {
    return this.#future.length > 0;
  }

  /** Makes `value` the present. With `merge` it becomes part of the step before, such as the same stroke. */
  push(value: T, merge = false): void {
    if (value === this.present) {
      return;
    }
    if (!merge) {
      this.#past = [...this.#past, this.present].slice(-DEPTH);
    }
    this.#future = [];
    this.present = value;
  }

  undo(): void {
    const before = this.#past.pop();
    if (before !== undefined) {
      this.#future.push(this.present);
      this.present = before;
    }
  }

  redo(): void {
    const after = this.#future.pop();
    if (after !== undefined) {
      this.#past.push(this.present);
      this.present = after;
    }
  }
}
