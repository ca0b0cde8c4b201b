// Running `nbc` as a child process that can be stopped.

import { execFile, spawn } from "node:child_process";
import { accessSync, constants, realpathSync } from "node:fs";

import type { Prober } from "./locate";

export interface Finished {
  /** The exit status; null after a signal. */
  status: number | null;
  stdout: string;
  stderr: string;
  stopped: boolean;
}

/** A request to stop, such as the editor's `CancellationToken`. */
export interface Stop {
  isCancellationRequested: boolean;
  onCancellationRequested(call: () => void): { dispose(): unknown };
}

/** Seconds in which a program must answer what it is. */
const PATIENCE = 10;

/** Seconds between the request to stop and a kill. */
const GRACE = 3;

/** Runs a program to its end. Rejects if it cannot be started. */
export function run(program: string, args: string[], folder: string, stop?: Stop): Promise<Finished> {
  return new Promise((resolve, reject) => {
    const child = spawn(program, args, { cwd: folder, stdio: ["ignore", "pipe", "pipe"], windowsHide: true });
    const output = { stdout: "", stderr: "" };
    for (const name of ["stdout", "stderr"] as const) {
      child[name].setEncoding("utf8").on("data", (text: string) => (output[name] += text));
    }
    let stopped = false;
    let force: NodeJS.Timeout | undefined;
    const end = () => {
      stopped = true;
      child.kill("SIGINT");
      force = setTimeout(() => child.kill("SIGKILL"), GRACE * 1000);
    };
    const request = stop?.onCancellationRequested(end);
    if (stop?.isCancellationRequested) {
      end();
    }
    const clean = () => {
      clearTimeout(force);
      request?.dispose();
    };
    child.on("error", error => {
      clean();
      reject(error);
    });
    child.on("close", status => {
      clean();
      resolve({ status, ...output, stopped });
    });
  });
}

export const machine: Prober = {
  real(program) {
    try {
      accessSync(program, constants.F_OK);
      return realpathSync(program);
    } catch {
      return undefined;
    }
  },
  output(program, args) {
    return new Promise((resolve, reject) => {
      const options = { timeout: PATIENCE * 1000, windowsHide: true };
      execFile(program, args, options, (error, stdout) => (error ? reject(error) : resolve(stdout)));
    });
  },
};
