// The workers that help another: parts go to those that are ready, in turn, and one that fails ends all.

import assert from "node:assert/strict";
import { test } from "node:test";

import { Crew } from "../src/tab/crew";
import type { FromWorker, ToWorker } from "../src/tab/messages";

class FakeWorker {
  static all: FakeWorker[] = [];
  readonly said: ToWorker[] = [];
  isEnded = false;
  onmessage: (event: { data: FromWorker }) => void = () => {};
  onerror: (event: { preventDefault: () => void }) => void = () => {};

  constructor() {
    FakeWorker.all.push(this);
  }

  postMessage(message: ToWorker): void {
    this.said.push(message);
  }

  terminate(): void {
    this.isEnded = true;
  }

  say(data: FromWorker): void {
    this.onmessage({ data });
  }

  /** The numbers of the parts that it was given. */
  get parts(): number[] {
    return this.said.flatMap(message => (message.say === "part" ? [message.number] : []));
  }
}

function crew(processors: number): { made: Crew; workers: FakeWorker[]; sizes: number[]; done: number[] } {
  FakeWorker.all = [];
  const place = { location: { href: "worker.js" }, navigator: { hardwareConcurrency: processors }, Worker: FakeWorker };
  for (const [name, value] of Object.entries(place)) {
    Object.defineProperty(globalThis, name, { value, configurable: true });
  }
  const [sizes, done]: [number[], number[]] = [[], []];
  const made = new Crew(
    {} as WebAssembly.Module,
    size => sizes.push(size),
    number => done.push(number),
  );
  return { made, workers: FakeWorker.all, sizes, done };
}

test("there is one for each other processor, and at most seven", () => {
  assert.deepEqual(
    [1, 2, 4, 64].map(processors => crew(processors).workers.length),
    [0, 1, 3, 7],
  );
});

test("several have parts in turn, as soon as they are ready", () => {
  const { made, workers, sizes, done } = crew(4);
  workers.forEach(worker => assert.deepEqual(worker.said, [{ say: "assist", module: {} }]));
  workers[2]?.say({ say: "assisting" });
  made.give(5, new ArrayBuffer(0));
  assert.deepEqual([sizes, workers.map(worker => worker.parts)], [[1], [[], [], [5]]]);
  workers[0]?.say({ say: "assisting" });
  workers[1]?.say({ say: "assisting" });
  [6, 7, 8, 9].forEach(number => made.give(number, new ArrayBuffer(0)));
  const parts = workers.map(worker => worker.parts.slice(worker === workers[2] ? 1 : 0));
  assert.deepEqual(parts.flat().sort(), [6, 7, 8, 9]);
  assert.ok(parts.every(given => given.length > 0));
  workers[1]?.say({ say: "part", number: 7, bytes: new ArrayBuffer(0) });
  assert.deepEqual([sizes, done], [[1, 2, 3], [7]]);
});

test("without one of them the program goes on alone", () => {
  const { made, workers, sizes, done } = crew(4);
  workers.forEach(worker => worker.say({ say: "assisting" }));
  workers[1]?.say({ say: "failed", message: "no memory" });
  assert.deepEqual([sizes.at(-1), workers.map(worker => worker.isEnded)], [0, [true, true, true]]);
  workers[0]?.say({ say: "part", number: 1, bytes: new ArrayBuffer(0) });
  made.give(2, new ArrayBuffer(0));
  assert.deepEqual([done, workers.flatMap(worker => worker.parts)], [[], []]);
});
