// Firefox by WebDriver BiDi, as far as a test of lessons needs it: no package drives the Firefox of a distribution.

import { spawn } from "node:child_process";
import { existsSync, mkdtempSync, rmSync } from "node:fs";
import { createRequire } from "node:module";
import { tmpdir } from "node:os";
import path from "node:path";

const PLACES = [process.env.FIREFOX, "/usr/bin/firefox-esr", "/usr/bin/firefox"];

/** The Firefox of this machine; undefined if there is none. */
export const FIREFOX = PLACES.find(place => place !== undefined && existsSync(place));

/** The web sockets of Node, or those in playwright-core for a Node without them. */
function socketClass() {
  return globalThis.WebSocket ?? createRequire(import.meta.url)("playwright-core/lib/utilsBundle").ws;
}

/** Opens an address in a new Firefox. Scripts run in the page by `run`, which returns what they return. */
export async function firefox(url) {
  const profile = mkdtempSync(path.join(tmpdir(), "nbc-firefox-"));
  const options = ["--headless", "--no-remote", "--profile", profile, "--remote-debugging-port", "0"];
  const child = spawn(FIREFOX, options, { stdio: ["ignore", "ignore", "pipe"] });
  const ended = new Promise(resolve => child.once("exit", resolve));
  const address = await new Promise((resolve, reject) => {
    let text = "";
    child.stderr.on("data", part => {
      text += part;
      const found = /WebDriver BiDi listening on (ws:\/\/\S+)/.exec(text);
      if (found !== null) {
        resolve(found[1]);
      }
    });
    child.once("exit", code => reject(new Error(`Firefox ended with ${code}:\n${text}`)));
  });
  const Socket = socketClass();
  const socket = new Socket(`${address}/session`);
  const pending = new Map();
  const errors = [];
  socket.onmessage = ({ data }) => {
    const message = JSON.parse(data);
    if (message.type === "event" && message.params.level === "error") {
      errors.push(message.params.text);
    }
    const waiting = pending.get(message.id);
    pending.delete(message.id);
    if (message.type === "error") {
      waiting?.reject(new Error(`${message.error}: ${message.message}`));
    } else {
      waiting?.resolve(message.result);
    }
  };
  await new Promise((resolve, reject) => Object.assign(socket, { onopen: resolve, onerror: reject }));
  let last = 0;
  const send = (method, params) =>
    new Promise((resolve, reject) => {
      pending.set(++last, { resolve, reject });
      socket.send(JSON.stringify({ id: last, method, params }));
    });
  await send("session.new", { capabilities: {} });
  await send("session.subscribe", { events: ["log.entryAdded"] });
  const { context } = await send("browsingContext.create", { type: "tab" });
  await send("browsingContext.setViewport", { context, viewport: { width: 1440, height: 900 } });
  await send("browsingContext.navigate", { context, url, wait: "complete" });
  const run = async (script, ...values) => {
    const { result, exceptionDetails } = await send("script.callFunction", {
      functionDeclaration: `async (text) => JSON.stringify(await (${script})(...JSON.parse(text)) ?? null)`,
      arguments: [{ type: "string", value: JSON.stringify(values) }],
      target: { context },
      awaitPromise: true,
    });
    if (exceptionDetails !== undefined) {
      throw new Error(exceptionDetails.text);
    }
    return JSON.parse(result.value);
  };
  return {
    run,
    errors,
    /** Waits until a script returns something true. */
    until: async (script, ...values) => {
      const end = Date.now() + 120_000;
      while (!(await run(script, ...values))) {
        if (Date.now() > end) {
          throw new Error(`timeout: ${script} ${values.join(" ")}`);
        }
        await new Promise(resolve => setTimeout(resolve, 100));
      }
    },
    go: url => send("browsingContext.navigate", { context, url, wait: "complete" }),
    reload: () => send("browsingContext.reload", { context, wait: "complete" }),
    /** Clicks the middle of an element. */
    click: async selector => {
      const [x, y] = await run(wanted => {
        const element = document.querySelector(wanted);
        element.scrollIntoView({ block: "center" });
        const box = element.getBoundingClientRect();
        return [Math.round(box.x + box.width / 2), Math.round(box.y + box.height / 2)];
      }, selector);
      const press = { type: "pointerDown", button: 0 };
      const actions = [{ type: "pointerMove", x, y }, press, { type: "pointerUp", button: 0 }];
      await send("input.performActions", { context, actions: [{ type: "pointer", id: "mouse", actions }] });
    },
    /** Presses keys, one after the other. */
    keys: async keys => {
      const actions = [...keys].flatMap(value => [
        { type: "keyDown", value },
        { type: "keyUp", value },
      ]);
      await send("input.performActions", { context, actions: [{ type: "key", id: "keys", actions }] });
    },
    picture: async () => {
      const { data } = await send("browsingContext.captureScreenshot", { context });
      return Buffer.from(data, "base64");
    },
    leave: async () => {
      await send("session.end", {}).catch(() => {});
      socket.close();
      child.kill("SIGTERM");
      await ended;
      rmSync(profile, { recursive: true, force: true });
    },
  };
}
