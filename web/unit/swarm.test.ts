import assert from "node:assert/strict";
import { test } from "node:test";

import type { Connection } from "../src/connection";
import { situationOf } from "../src/learn/situation";
import { halfOf, pulse } from "../src/live/clock";
import { LiveSwarm } from "../src/live/swarm";
import { Observable } from "../src/observable";
import type { ShownSwarm } from "../src/protocol";
import { encodeFrame } from "./encode";

const SWARM = {
  number: 1,
  circuit: "c",
  swarm: null,
  inputs: [
    { name: "a", width: 1 },
    { name: "b", width: 1 },
  ],
  outputs: [],
  robots: [],
  gates: 0,
  registers: [],
  listing: null,
  shown: [],
  looks: [],
  schematic: { sheets: [], bodies: [], homes: [] },
  timing: "",
  hold: 2,
  clocks: [],
  start: 1,
  ground: [],
  frames: 12,
  own_clocks: [],
  waves: null,
  script: null,
} satisfies ShownSwarm;

/** A server that notes what it is asked, and answers when the test says so. */
class Server {
  readonly events = new Observable(null);
  readonly asked: { verb: string; fields: Record<string, unknown>; answer: () => void }[] = [];
  onframe: (buffer: ArrayBuffer) => void = () => {};

  request(verb: string, fields: Record<string, unknown>): Promise<unknown> {
    return new Promise(resolve => this.asked.push({ verb, fields, answer: () => resolve({}) }));
  }

  tell(verb: string, fields: Record<string, unknown>): void {
    this.asked.push({ verb, fields, answer: () => {} });
  }

  /** A paused swarm that has done four cycles with the inputs 00, 10, 01 and 11. */
  static withRun(): { server: Server; swarm: LiveSwarm } {
    const server = new Server();
    const swarm = new LiveSwarm(server as unknown as Connection);
    swarm.begin(SWARM);
    server.run(1, ["00", "10", "01", "11"], false);
    server.asked.length = 0;
    return { server, swarm };
  }

  /** The frame of cycles with these inputs. */
  run(from: number, inputs: string[], running = true): void {
    const log = inputs.map(bits => ({ inputs: [...bits].map(Number), robots: [], outputs: [], places: [] }));
    this.onframe(encodeFrame({ now: from + log.length - 1, from, running, log }));
  }

  /** The frame of a moment in the log. */
  show(now: number): void {
    this.onframe(encodeFrame({ now, last: 4, from: 5 }));
  }

  /** The inputs that the server was told to use since the run. */
  told(): unknown[] {
    return this.asked.filter(({ verb }) => verb === "inputs").map(({ fields }) => fields["bits"]);
  }
}

test("a pulse is as long as asked for, however late it begins", () => {
  const { server, swarm } = Server.withRun();
  server.run(5, ["00"]);
  pulse(swarm, 0, 2);
  const raised = server.told();
  server.run(6, ["00", "00"]);
  server.run(8, ["00", "10"]);
  assert.deepEqual(server.told(), raised);
  server.run(10, ["10"]);
  assert.deepEqual(server.told(), [...raised, "00"]);
});

test("a rewind takes over the inputs of its cycle, whatever frames are still on their way", () => {
  for (const [sought, late] of [
    [[2], [4, 2]],
    [[3], [4, 4, 3]],
    [
      [1, 2, 3],
      [4, 1, 2, 3],
    ],
    [
      [3, 2],
      [3, 2],
    ],
  ] as const) {
    const { server, swarm } = Server.withRun();
    sought.forEach(cycle => void swarm.seek(cycle));
    late.forEach(now => server.show(now));
    const expected = ["00", "10", "01", "11"][(sought.at(-1) ?? 0) - 1];
    assert.equal(swarm.inputs.value, expected, `${sought.join()} with the frames ${late.join()}`);
    // The server takes them over by itself.
    assert.deepEqual(server.told(), []);
  }
});

test("a switch that is flipped after a rewind stays flipped", () => {
  const { server, swarm } = Server.withRun();
  void swarm.seek(2);
  swarm.setBit(1, 1);
  server.show(2);
  assert.equal(swarm.inputs.value, "11");
  assert.deepEqual(server.told(), ["11"]);
});

test("a cycle that the page was not sent is taken over when it comes", () => {
  const server = new Server();
  const swarm = new LiveSwarm(server as unknown as Connection);
  swarm.begin(SWARM);
  server.onframe(encodeFrame({ now: 900, last: 900, from: 901 }));
  void swarm.seek(7);
  server.onframe(encodeFrame({ now: 900, last: 900, from: 901 }));
  const log = [{ inputs: [1, 0], robots: [], outputs: [], places: [] }];
  server.onframe(encodeFrame({ now: 7, last: 900, from: 7, log }));
  assert.equal(swarm.inputs.value, "10");
});

test("a lesson learns nothing from the swarm of another program", () => {
  const { swarm } = Server.withRun();
  const design = { body: [], probe: null };
  const search = { running: false, niches: [], chosen: null };
  const parts = (shown: string, state = "ready"): Parameters<typeof situationOf>[0] =>
    ({
      program: {
        path: { value: "lesson.nb" },
        shown,
        text: "",
        checked: { value: null },
        isChecked: true,
        stage: { value: { state } },
      },
      swarm,
      tests: { states: { value: new Map() }, claims: { states: { value: new Map() } } },
      robots: { designer: { design: { value: design } }, evolution: { search: { value: search } } },
    }) as unknown as Parameters<typeof situationOf>[0];
  assert.equal(situationOf(parts("lesson.nb")).port("a", 4), 1);
  assert.equal(situationOf(parts("other.nb")).port("a", 4), null);
  assert.equal(situationOf(parts("other.nb")).now, 0);
  // Robots count only where they are those of the present text.
  assert.equal(situationOf(parts("lesson.nb")).circuit, "c");
  assert.equal(situationOf(parts("lesson.nb", "compiling")).circuit, null);
  assert.equal(situationOf(parts("other.nb")).circuit, null);
});

test("the inputs of a test are shown while it runs, until a switch is flipped", () => {
  const server = new Server();
  const swarm = new LiveSwarm(server as unknown as Connection);
  swarm.begin({ ...SWARM, script: { title: "", cycles: 4, environment: null } }, true);
  const show = (now: number, bits: string): void => {
    const log = [{ inputs: [...bits].map(Number), robots: [], outputs: [], places: [] }];
    server.onframe(encodeFrame({ now, from: now, log, running: true }));
  };
  show(1, "10");
  assert.equal(swarm.inputs.value, "10");
  show(2, "01");
  assert.equal(swarm.inputs.value, "01");
  swarm.setBit(0, 1);
  show(3, "01");
  assert.deepEqual([swarm.inputs.value, swarm.scripted.value, server.told()], ["11", 0, ["11"]]);
});

test("a clock changes as soon as its registers permit, and another input when all has settled", () => {
  const swarm = { clocks: [{ bit: 1, half: 12 }], hold: 22 };
  assert.deepEqual(
    [0, 1].map(bit => halfOf(swarm, bit)),
    [22, 12],
  );
});

test("a robot with a clock of its own changes within a cycle, and its dial shows how much of its own cycle is over", () => {
  const server = new Server();
  const swarm = new LiveSwarm(server as unknown as Connection);
  const robots = [{ net: "q" }] as unknown as (typeof SWARM)["robots"];
  swarm.begin({ ...SWARM, robots, own_clocks: [[21, 20_000]] });
  const cycle = (bit: number, ...flips: [number, number][]): Parameters<typeof encodeFrame>[0]["log"] => [
    { inputs: [0, 0], robots: [bit], outputs: [], places: [0], flips },
  ];
  server.onframe(encodeFrame({ now: 1, from: 1, log: cycle(0) }));
  server.onframe(encodeFrame({ now: 2, from: 2, log: cycle(1, [0, 42]) }));
  const source = { robot: 0 };
  assert.deepEqual(swarm.edges([source], 2), [2.5]);
  assert.deepEqual(
    [2, 2.4, 2.5, 2.9].map(time => swarm.valueAt(source, time)),
    [0, 0, 1, 1],
  );
  assert.equal(swarm.valueAt({ input: 0 }, 2.5), 0);
  swarm.playback.time = 1;
  assert.ok(Math.abs((swarm.ownCycle(0) ?? 0) - 0.27) < 1e-9);
  swarm.begin(SWARM);
  assert.equal(swarm.ownCycle(0), null);
});
