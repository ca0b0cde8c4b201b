// Which nets of a circuit depend on which.

import type { PageCell } from "../protocol";

/** What is marked with a robot: its wires, or all that it depends on, or all that depends on it. */
export type Reach = "wires" | "before" | "after";

export class Nets {
  readonly #drivers: Map<string, number>;
  /** The robots that sense each net. */
  readonly #readers = new Map<string, number[]>();

  constructor(private readonly cells: PageCell[]) {
    this.#drivers = new Map(cells.map((cell, robot) => [cell.net, robot]));
    cells.forEach(({ reads }, robot) => {
      for (const net of reads) {
        const readers = this.#readers.get(net) ?? [];
        readers.push(robot);
        this.#readers.set(net, readers);
      }
    });
  }

  /** The robot that drives a net; none drives an input. */
  driver(net: string): number | undefined {
    return this.#drivers.get(net);
  }

  /** The inputs that robots sense. */
  inputs(): string[] {
    return [...this.#readers.keys()].filter(net => !this.#drivers.has(net));
  }

  /** Some nets with what is marked with them; several together have no wires of their own. */
  reached(nets: string[], reach: Reach): Set<string> {
    if (reach === "wires") {
      return new Set([...nets, ...(nets.length === 1 ? nets.flatMap(net => this.#before(net)) : [])]);
    }
    // A set goes on with what is added while it is passed.
    const found = new Set(nets);
    for (const net of found) {
      (reach === "after" ? this.#after(net) : this.#before(net)).forEach(next => found.add(next));
    }
    return found;
  }

  #before(net: string): string[] {
    return this.cells[this.#drivers.get(net) ?? -1]?.reads ?? [];
  }

  #after(net: string): string[] {
    return (this.#readers.get(net) ?? []).flatMap(robot => this.cells[robot]?.net ?? []);
  }
}
