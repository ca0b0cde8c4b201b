import assert from "node:assert/strict";
import { test } from "node:test";

import { decodeFrame, type Frame } from "../src/frame";
import { LiveSwarm } from "../src/live/swarm";
import { encodeFrame } from "../src/player/encode";
import { Engine, type Timers } from "../src/player/engine";
import { readRecording } from "../src/player/exported";
import { Machine } from "../src/player/machine";
import { runRows } from "../src/player/rows";
import type { ExportedRobot, ExportedSwarm, SwarmRobot } from "../src/protocol";

/** Time that passes only when a test lets it. */
class Hand implements Timers {
  time = 0;
  #waiting: { at: number; work: () => void }[] = [];

  now = (): number => this.time;

  later = (work: () => void, milliseconds: number): void => {
    this.#waiting.push({ at: this.time + milliseconds, work });
  };

  pass(milliseconds: number): void {
    const end = this.time + milliseconds;
    for (;;) {
      this.#waiting.sort((a, b) => a.at - b.at);
      const next = this.#waiting[0];
      if (next === undefined || next.at > end) {
        this.time = end;
        return;
      }
      this.#waiting.shift();
      this.time = Math.max(this.time, next.at);
      next.work();
    }
  }
}

/** Poses of one point that is half a voxel high. */
function poses(frames: number): string {
  const bytes = new Uint8Array(Int16Array.from({ length: 2 * frames }, (_, i) => (i % 2 === 0 ? 0 : 50)).buffer);
  return btoa(String.fromCharCode(...bytes));
}

function recording(given: {
  robots: (Partial<SwarmRobot> & Partial<ExportedRobot> & { letters: string })[];
  shown: ExportedSwarm["swarm"]["shown"];
  inputs?: number;
  hold?: number;
  start?: number;
  beat?: number;
}): Machine {
  const { robots, shown, inputs = 1, hold = 4, start = 1, beat = 1 } = given;
  const walks = robots.map(({ letters }) => ({
    letters,
    strides: [...letters].map(letter => ({ shift: letter === "R" ? 0.5 : -0.25, poses: poses(4) })),
  }));
  return new Machine({
    version: "0",
    file: "a.nb",
    beat,
    walks,
    robots: robots.map(({ delay = 1, held = ["", ""], start: first = false }, walk) => ({
      walk,
      start: first,
      delay,
      held,
    })),
    tests: [],
    swarm: {
      number: 1,
      circuit: "c",
      swarm: null,
      inputs: [{ name: "a", width: inputs }],
      outputs: [{ name: "q", width: shown.length }],
      shown,
      robots: robots.map(({ senses = [] }) => ({ senses, points: 1 })),
      looks: [],
      schematic: { sheets: [], bodies: [], homes: [] },
      timing: "",
      hold,
      start,
      ground: [],
      frames: 4,
      waves: null,
      script: null,
    } as unknown as ExportedSwarm["swarm"],
  });
}

const no = { constant: false };
const inverter = (delay: number): Machine =>
  recording({ robots: [{ letters: "RRLL", senses: [{ input: 0 }, no], delay, start: true }], shown: [{ robot: 0 }] });

test("a robot answers when its stimuli have been the same for as long as it needs", () => {
  const logic = inverter(3).logic();
  const bits = [0, 0, 0, 1, 1, 1, 0, 1, 0, 0, 0].map(bit => {
    logic.step([bit]);
    return logic.state.bits[0];
  });
  assert.deepEqual(bits, [1, 1, 1, 1, 1, 0, 0, 0, 0, 0, 1], "shorter changes do not reach its output");
});

test("robots sense each other one cycle later, and start values until the start is over", () => {
  const chain = recording({
    robots: [
      { letters: "RRLL", senses: [{ input: 0 }, no], start: true },
      { letters: "RRLL", senses: [{ robot: 0 }, no] },
    ],
    shown: [{ robot: 1 }, { input: 0 }],
    start: 3,
  });
  const logic = chain.logic();
  const seen = Array.from({ length: 5 }, () => {
    logic.step([1]);
    return [...logic.state.bits].join("") + [...logic.values(chain.swarm.shown, [1])].join("");
  });
  assert.deepEqual(seen, ["0001", "0001", "0001", "0111", "0111"]);
});

test("what is held at first is sensed in the place of the source, and a beat keeps what is sensed", () => {
  const wave = recording({
    robots: [{ letters: "LLRR", senses: [{ robot: 0 }, no], held: ["10", ""], start: false }],
    shown: [{ robot: 0 }],
    beat: 2,
    start: 2,
  });
  const logic = wave.logic();
  const bits = Array.from({ length: 6 }, () => {
    logic.step([0]);
    return logic.state.bits[0];
  });
  // It takes over what was sensed at the end of each beat.
  assert.deepEqual(bits, [1, 0, 0, 0, 0, 0]);
});

test("a latch keeps its bit through the rows of a test", () => {
  const latch = recording({
    inputs: 2,
    robots: [
      { letters: "RRRL", senses: [{ input: 0 }, { robot: 1 }], delay: 2 },
      { letters: "RRRL", senses: [{ input: 1 }, { robot: 0 }], delay: 1, start: true },
    ],
    shown: [{ robot: 0 }, { robot: 1 }],
    hold: 8,
    start: 2,
  });
  const rows = ["10", "11", "01", "11", "10", "11"].map((inputs, i) => ({
    inputs,
    expected: ["01", "0-", "10", "10", "01", "1-"][i] ?? "",
  }));
  const ends = runRows(latch, { title: "", rows });
  assert.deepEqual(
    ends.map(end => end.observed),
    ["01", "01", "10", "10", "01", "01"],
  );
  assert.deepEqual(
    ends.map(end => end.passed),
    [true, true, true, true, true, false],
  );
});

test("a frame that is written is read as it was", () => {
  const frame: Frame = {
    posesPerCycle: 2,
    robots: 9,
    now: 70_000,
    first: 69_000,
    last: 70_001,
    rate: 4,
    running: true,
    from: 70_000,
    log: [0, 1].map(bit => ({
      inputs: Uint8Array.of(bit, 1),
      robots: Uint8Array.from({ length: 9 }, (_, i) => (i + bit) % 2),
      outputs: Uint8Array.of(1),
      places: Float32Array.from({ length: 9 }, (_, i) => i - 0.5),
    })),
    poses: new Map([[8, { points: 1, origin: -2.5, coordinates: Int16Array.of(1, -2, 3, 400) }]]),
  };
  assert.deepEqual(decodeFrame(encodeFrame(frame, 1), 2, 1), frame);
});

test("the engine runs, pauses, steps and goes back as the server does", async () => {
  const hand = new Hand();
  const machine = inverter(1);
  const engine = new Engine(machine, hand);
  const swarm = new LiveSwarm(engine);
  const settle = async (milliseconds: number): Promise<void> => {
    hand.pass(milliseconds);
    await Promise.resolve();
    await Promise.resolve();
  };
  swarm.begin(machine.swarm);
  await settle(50);
  assert.equal(swarm.frame.value?.now, 0);
  swarm.play();
  await settle(2010);
  assert.equal(swarm.frame.value?.now, 9, "four cycles a second, the first at once");
  assert.ok(swarm.running.value);
  assert.deepEqual([...(swarm.log.at(9)?.outputs ?? [])], [1]);
  assert.ok(Math.abs((swarm.log.at(9)?.places[0] ?? 0) - 4.5) < 1e-6, "half a voxel in each cycle");
  swarm.setBit(0, 1);
  swarm.pause();
  await settle(500);
  swarm.step(3);
  await settle(100);
  assert.deepEqual([swarm.frame.value?.now, swarm.running.value], [12, false]);
  assert.deepEqual([...(swarm.log.at(12)?.outputs ?? [])], [0]);
  assert.equal(await swarm.seek(4), true);
  await settle(50);
  assert.deepEqual([swarm.frame.value?.now, swarm.frame.value?.last, swarm.inputs.value], [4, 12, "0"]);
  assert.equal(await swarm.seek(99), false);
  swarm.step();
  await settle(50);
  assert.deepEqual([swarm.frame.value?.now, swarm.frame.value?.last], [5, 5], "what came after is replaced");
  swarm.reset();
  await settle(50);
  assert.deepEqual([swarm.frame.value?.now, swarm.frame.value?.last], [0, 0]);
  await assert.rejects(engine.request("files", {}), /no server/);
});

test("an input that changes by itself does so in the engine", async () => {
  const hand = new Hand();
  const machine = inverter(1);
  const swarm = new LiveSwarm(new Engine(machine, hand));
  swarm.begin(machine.swarm);
  swarm.setClock({ bit: 0, half: 2 });
  swarm.step(8);
  hand.pass(100);
  const bits = Array.from({ length: 8 }, (_, i) => swarm.log.at(i + 1)?.inputs[0]);
  assert.deepEqual(bits, [0, 0, 1, 1, 0, 0, 1, 1]);
});

test("a long run forgets its first cycles and can still be wound back", async () => {
  const hand = new Hand();
  const machine = inverter(1);
  const swarm = new LiveSwarm(new Engine(machine, hand));
  swarm.begin(machine.swarm);
  for (let i = 0; i < 4; i++) {
    swarm.step(1000);
    hand.pass(100);
  }
  const { now, first } = swarm.frame.value ?? { now: 0, first: 0 };
  assert.equal(now, 4000);
  assert.ok(first >= 2700 && first <= 3001, `from ${first}`);
  assert.equal(await swarm.seek(first), true);
});

test("robots stand on the ground and pass from one gait to the other without a jump", () => {
  const hand = new Hand();
  const machine = inverter(1);
  const swarm = new LiveSwarm(new Engine(machine, hand));
  swarm.begin(machine.swarm);
  swarm.step(1);
  hand.pass(20);
  const end = swarm.playback.outline(0);
  swarm.setBit(0, 1);
  swarm.step(1);
  hand.pass(20);
  swarm.playback.time = 1.0001;
  const begin = swarm.playback.outline(0);
  assert.ok(end !== null && begin !== null && Math.abs((end[0] ?? 9) - (begin[0] ?? 0)) < 0.01);
  assert.equal(begin[1], 0.5);
});

test("the data of a page is unpacked", async () => {
  const packed = new Blob([JSON.stringify({ version: "1" })]).stream().pipeThrough(new CompressionStream("deflate"));
  const bytes = new Uint8Array(await new Response(packed).arrayBuffer());
  assert.equal((await readRecording(btoa(String.fromCharCode(...bytes)))).version, "1");
  await assert.rejects(readRecording("AAAA"));
});
