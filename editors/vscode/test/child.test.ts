// Running programs to their end, or until they are stopped.

import assert from "node:assert/strict";
import { test } from "node:test";

import { run } from "../src/core/child";

/** A request to stop that is made by a call. */
function stopper() {
  let call: (() => void) | undefined;
  let disposed = 0;
  return {
    isCancellationRequested: false,
    onCancellationRequested(wanted: () => void) {
      call = wanted;
      return { dispose: () => disposed++ };
    },
    stop: () => call!(),
    disposed: () => disposed,
  };
}

/** A program that prints a line when it is ready, and then waits. */
const WAITING = "process.stdout.write('ready'); setInterval(() => {}, 1000);";

test("both outputs and the status are returned", async () => {
  const source = "process.stdout.write('é'); process.stderr.write('b'); process.exitCode = 3;";
  const finished = await run(process.execPath, ["-e", source], ".");
  assert.deepEqual(finished, { status: 3, stdout: "é", stderr: "b", stopped: false });
});

test("a program that does not exist is an error", async () => {
  await assert.rejects(run("/no/such/program", [], "."), /ENOENT/);
});

test("a run is stopped by an interrupt", async () => {
  const token = stopper();
  const running = run(process.execPath, ["-e", WAITING], ".", token);
  token.stop();
  const finished = await running;
  assert.equal(finished.stopped, true);
  assert.notEqual(finished.status, 0);
  assert.equal(token.disposed(), 1);
});

test("a run that was stopped before it began ends too", async () => {
  const token = { ...stopper(), isCancellationRequested: true };
  const finished = await run(process.execPath, ["-e", WAITING], ".", token);
  assert.equal(finished.stopped, true);
});

test("a program that ignores the interrupt is ended by force", async () => {
  const token = stopper();
  const source = `process.on('SIGINT', () => {}); ${WAITING}`;
  const running = run(process.execPath, ["-e", source], ".", token);
  token.stop();
  assert.equal((await running).stopped, true);
});
