// The program in a tab answers as the one that serves: the same requests get the same texts, to the last digit, from the
// served program, from WebAssembly in Node and from a worker in Chromium. NBC_SITE names the folder of the tab's page.

import assert from "node:assert/strict";
import { readFileSync, readdirSync } from "node:fs";
import path from "node:path";
import { after, before, test } from "node:test";
import { gunzipSync } from "node:zlib";

import { build } from "esbuild";

import { closeBrowser, visit } from "./browser.mjs";
import { serveFiles } from "./files.mjs";
import { SITE, folderWith, serve } from "./program.mjs";

const skip = (SITE === undefined || process.env.NBC === undefined) && "NBC and NBC_SITE do not name both programs";
const CIRCUITS = new URL("../../circuits/", import.meta.url);
const source = name => readFileSync(new URL(`${name}.nb`, CIRCUITS), "utf8");
/** Programs that take long at the level of logic, or need files of others. */
const LEFT_OUT = ["computer", "digits", "riscv"];

/** Requests without their numbers, and how many cycles the swarm has done before one is sent. */
function conversations() {
  const gallery = readdirSync(CIRCUITS)
    .filter(name => name.endsWith(".nb"))
    .map(name => name.slice(0, -3))
    .filter(name => !LEFT_OUT.includes(name));
  const program = name => ({ do: "program", path: `${name}.nb`, text: source(name) });
  const tested = (name, level, test = 0) => ({ do: "test", path: `${name}.nb`, test, level });
  return {
    "the gallery at the level of logic": gallery.flatMap(name => [program(name), tested(name, "logic")]),
    "latch and counter in physics": ["latch", "counter"].flatMap(name => [program(name), tested(name, "physics")]),
    "a run of the latch as a table and as waveforms": [
      program("latch"),
      { do: "compile", path: "latch.nb", circuit: "d_latch", swarm: null },
      { do: "inputs", bits: "11" },
      { do: "step", cycles: 12, wait: true },
      { do: "take", what: "csv", cycles: 12 },
      { do: "take", what: "vcd", cycles: 12 },
      { do: "take", what: "svg", cycles: 12 },
    ],
    // The table begins with what the robots were after four cycles.
    "a run of a counter, of which others simulate parts": [
      program("counter"),
      { do: "compile", path: "counter.nb", circuit: "counter", swarm: null },
      { do: "step", cycles: 6, wait: true },
      { do: "take", what: "csv", cycles: 2 },
    ],
    "three generations of an evolution": [{ do: "evolve", body: null, box: [4, 4], generations: 3, seed: 7 }],
    "the robots and the lessons": [{ do: "robots", path: null }, { do: "lessons" }],
  };
}

/** Whether a message is of work that goes on: when it comes, and so what it says, depends on the time. */
const isInterim = message => "progress" in message || "found" in message;

/** Talks to a program: `send` a text, and `receive` is called with each text. Files are fetched by `fetched`. */
async function talk(requests, { send, listen, frames, fetched }) {
  const said = [];
  let id = 0;
  for (const { wait, ...request } of requests) {
    id += 1;
    const answer = new Promise(done => {
      listen(text => {
        const message = JSON.parse(text);
        if (!isInterim(message)) {
          said.push(text);
          if (message.id === id) {
            done(message);
          }
        }
      });
    });
    send(JSON.stringify({ id, ...request }));
    const { ok } = await answer;
    if (ok?.url !== undefined) {
      said.push(await fetched(ok.url));
    }
    if (wait) {
      await frames(request.cycles);
    }
  }
  return said;
}

let served, folder, decode, Engine;

before(async () => {
  if (skip) {
    return;
  }
  folder = folderWith({});
  served = await serve(folder.folder);
  const modules = { bundle: true, format: "esm", write: false };
  const load = async file => {
    const built = await build({ ...modules, entryPoints: [new URL(file, import.meta.url).pathname] });
    return import(`data:text/javascript;base64,${Buffer.from(built.outputFiles[0].text).toString("base64")}`);
  };
  ({ Engine } = await load("../src/tab/engine.ts"));
  ({ decodeFrame: decode } = await load("../src/frame.ts"));
});
after(async () => {
  await closeBrowser();
  await served?.stop();
  folder?.remove();
});

/** Waits until a frame shows this many cycles. */
function waiter() {
  let shown = 0;
  let done = () => {};
  let goal = Infinity;
  return {
    frame: buffer => {
      shown = decode(buffer, 2, 2).now;
      if (shown >= goal) {
        done();
      }
    },
    until: cycles =>
      new Promise(resolve => {
        [goal, done] = [cycles, resolve];
        if (shown >= goal) {
          done();
        }
      }),
  };
}

async function ofServer(requests) {
  const socket = new WebSocket(new URL("live", served.url).href.replace("http", "ws"));
  socket.binaryType = "arraybuffer";
  await new Promise(done => (socket.onopen = done));
  const frames = waiter();
  let hear = () => {};
  socket.onmessage = ({ data }) => (typeof data === "string" ? hear(data) : frames.frame(data));
  const said = await talk(requests, {
    send: text => socket.send(text),
    listen: listener => (hear = listener),
    frames: frames.until,
    fetched: async url => (await fetch(new URL(url, served.url))).text(),
  });
  socket.close();
  return said;
}

async function ofNode(requests) {
  const name = siteFile(/\.bin$/);
  const module = await WebAssembly.compile(gunzipSync(readFileSync(path.join(SITE, name))));
  const engine = await Engine.start(module, message => assert.fail(message));
  engine.begin("", performance.now());
  // Three others do parts of simulations that are large enough.
  const start = () => Engine.start(module, message => assert.fail(message));
  const assistants = await Promise.all([start(), start(), start()]);
  engine.crew(assistants.length);
  const frames = waiter();
  const files = new Map();
  let [hear, ended, parts] = [() => {}, false, 0];
  const work = () => {
    engine.advance(performance.now());
    for (let message = engine.next(true); message !== null; message = engine.next(true)) {
      if (message.kind === "kept") {
        files.set(message.address, Buffer.from(message.bytes).toString());
      } else if (message.kind === "part") {
        parts += 1;
        const assistant = assistants[message.number % assistants.length];
        engine.receivePart(message.number, assistant.simulate(message.bytes));
      } else if (typeof message.data === "string") {
        hear(message.data);
      } else if (message.kind === "page") {
        frames.frame(message.data);
      }
    }
    if (!ended) {
      setImmediate(work);
    }
  };
  work();
  const said = await talk(requests, {
    send: text => engine.receive(text, performance.now()),
    listen: listener => (hear = listener),
    frames: frames.until,
    fetched: async url => files.get(url),
  });
  ended = true;
  const isLarge = ({ do: verb, circuit }) => circuit === "counter" || verb === "evolve";
  assert.ok(parts > 0 || !requests.some(isLarge), "others do parts");
  return said;
}

function siteFile(name) {
  return readdirSync(SITE).find(file => name.test(file));
}

/** The same in Chromium. The cycle of a frame is its second number (docs/play-protocol.md). */
async function ofChromium(requests, page) {
  await page.exposeFunction("workers", () => page.workers().length);
  return page.evaluate(
    async ([requests, program, script]) => {
      const worker = new Worker(script);
      const files = new Map();
      let hear = () => {};
      let see = () => {};
      let shown = 0;
      let helper = null;
      worker.onmessage = ({ data }) => {
        if (data.say === "file") {
          files.set(data.address, new Blob([data.bytes]).text());
        } else if (data.say === "ready") {
          const { port1, port2 } = new MessageChannel();
          helper = new Worker(script);
          helper.postMessage({ say: "assist", module: data.module, port: port1 }, [port1]);
          worker.postMessage({ say: "crew", ports: [port2] }, [port2]);
        } else if (data.say === "live" && typeof data.data === "string") {
          hear(data.data);
        } else if (data.say === "live") {
          shown = new DataView(data.data).getUint32(4, true);
          see();
          worker.postMessage({ say: "drawn" });
        }
      };
      worker.postMessage({ say: "begin", program, first: "", files: [], keeps: false });
      const said = [];
      let id = 0;
      for (const { wait, ...request } of requests) {
        id += 1;
        const answer = new Promise(done => {
          hear = text => {
            const message = JSON.parse(text);
            if (!("progress" in message || "found" in message)) {
              said.push(text);
              if (message.id === id) {
                done(message);
              }
            }
          };
        });
        // Those who simulate parts come later than the program.
        while (wait && (await window.workers()) < 2) {
          await new Promise(requestAnimationFrame);
        }
        worker.postMessage({ say: "live", text: JSON.stringify({ id, ...request }) });
        const { ok } = await answer;
        if (wait) {
          await new Promise(done => {
            see = () => shown >= request.cycles && done();
            see();
          });
        }
        if (ok?.url !== undefined) {
          said.push(await files.get(ok.url));
        }
      }
      worker.terminate();
      helper.terminate();
      return said;
    },
    [requests, { address: siteFile(/\.bin$/), bytes: 1 }, siteFile(/^worker/)],
  );
}

/** Texts without the numbers of taken files, which a program counts over all its pages. */
function unnumbered(texts) {
  return texts.map(text => text.replace(/"take\/\d+\//, '"take/'));
}

for (const [title, requests] of Object.entries(conversations())) {
  test(`${title}: the same texts`, { skip }, async t => {
    const expected = unnumbered(await ofServer(requests));
    assert.ok(expected.length >= requests.length);
    assert.deepEqual(unnumbered(await ofNode(requests)), expected);
    const site = await serveFiles(SITE);
    const page = await visit(site.address);
    assert.deepEqual(unnumbered(await ofChromium(requests, page)), expected);
    await page.leave();
    await site.stop();
    t.diagnostic(`${expected.length} texts, ${expected.join("").length} letters`);
  });
}
