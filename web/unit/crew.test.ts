// The workers that help another: parts go to those that are ready, in turn, and one that fails ends all.

import assert from "node:assert/strict";
import { test } from "node:test";

import { Assistants } from "../src/tab/assistants";
import { Crew } from "../src/tab/crew";
import type { Part, ToWorker } from "../src/tab/messages";

class FakeWorker {
  port: MessagePort | null = null;
  isEnded = false;
  onmessage: (event: Event) => void = () => {};
  onerror: (event: Event) => void = () => {};

  postMessage(message: ToWorker): void {
    assert.equal(message.say, "assist");
    this.port = message.say === "assist" ? message.port : null;
  }

  terminate(): void {
    this.isEnded = true;
    this.port?.close();
  }
}

/** Workers for so many processors, and what the ports to them were. */
function assistants(processors: number): { made: Assistants; workers: FakeWorker[]; led: MessagePort[][] } {
  Object.defineProperty(globalThis, "navigator", { value: { hardwareConcurrency: processors }, configurable: true });
  const [workers, led]: [FakeWorker[], MessagePort[][]] = [[], []];
  const start = (): Worker => {
    workers.push(new FakeWorker());
    return workers.at(-1) as unknown as Worker;
  };
  const made = new Assistants({} as WebAssembly.Module, start, ports => led.push(ports));
  return { made, workers, led };
}

/** What has been posted has come. */
const delivered = (): Promise<void> => new Promise(done => setTimeout(done, 20));

test("there is one for each other processor, and at most seven", () => {
  for (const [processors, count] of [
    [1, 0],
    [2, 1],
    [4, 3],
    [64, 7],
  ] as const) {
    const { made, workers, led } = assistants(processors);
    assert.deepEqual([workers.length, led.map(ports => ports.length)], [count, [count]]);
    made.end();
    assert.ok(workers.every(worker => worker.isEnded));
  }
});

test("several have parts in turn, as soon as they are ready", async () => {
  const { made, workers, led } = assistants(4);
  const [sizes, done, given]: [number[], number[], number[][]] = [[], [], [[], [], []]];
  const crew = new Crew(
    led[0] as MessagePort[],
    size => sizes.push(size),
    ({ number }) => done.push(number),
  );
  const part = (number: number): Part => ({ number, bytes: new ArrayBuffer(0) });
  workers.forEach(({ port }, i) => {
    (port as MessagePort).onmessage = ({ data }: MessageEvent<Part>) => given[i]?.push(data.number);
  });
  crew.give(part(4));
  workers[2]?.port?.postMessage("ready");
  await delivered();
  crew.give(part(5));
  await delivered();
  assert.deepEqual(
    [sizes, given],
    [
      [0, 1],
      [[], [], [5]],
    ],
  );
  workers[0]?.port?.postMessage("ready");
  workers[1]?.port?.postMessage("ready");
  await delivered();
  [6, 7, 8, 9].forEach(number => crew.give(part(number)));
  workers[1]?.port?.postMessage(part(7));
  await delivered();
  assert.deepEqual([sizes, done], [[0, 1, 2, 3], [7]]);
  assert.deepEqual(given.flat().sort(), [5, 6, 7, 8, 9]);
  assert.ok(given.every(numbers => numbers.length > 0));
  crew.close();
  workers[1]?.port?.postMessage(part(6));
  await delivered();
  assert.deepEqual(done, [7]);
  made.end();
});

test("without one of them the program goes on alone", () => {
  const { workers, led } = assistants(4);
  workers[1]?.onmessage(new Event("message"));
  assert.deepEqual(
    [led.map(ports => ports.length), workers.map(worker => worker.isEnded)],
    [
      [3, 0],
      [true, true, true],
    ],
  );
});
