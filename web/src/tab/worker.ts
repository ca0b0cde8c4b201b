// The worker of a page without a server: it has the program, and does its work in portions, so that messages are never
// kept waiting for long. As an assistant it does parts of simulations for another worker.

import { Crew } from "./crew";
import { Engine } from "./engine";
import { FileStore, type Contents } from "./files";
import type { FromAssistant, FromWorker, LiveParts, Part, Source, ToWorker } from "./messages";

const pause = new MessageChannel();
let engine: Engine | null = null;
let crew: Crew | null = null;
let store: FileStore | null = null;
const waiting: ToWorker[] = [];
let hasRoom = true;
let timer: ReturnType<typeof setTimeout> | undefined;
let isPosted = false;

pause.port1.onmessage = () => {
  isPosted = false;
  work();
};
onmessage = ({ data }: MessageEvent<ToWorker>) => {
  if (data.say === "begin" || data.say === "assist") {
    const starting = data.say === "begin" ? begin(data) : assist(data);
    starting.catch((error: unknown) => fail(String(error)));
    return;
  }
  const started = engine;
  if (started === null) {
    waiting.push(data);
  } else {
    guard(() => take(started, data));
    soon();
  }
};

function say(message: FromWorker, transfer: Transferable[] = []): void {
  postMessage(message, { transfer });
}

function fail(message: string): void {
  engine = null;
  say({ say: "failed", message });
}

async function begin({ program, first, files, keeps }: Extract<ToWorker, { say: "begin" }>): Promise<void> {
  const compiling =
    "module" in program ? Promise.resolve(program.module) : WebAssembly.compileStreaming(await read(program));
  store = keeps ? await FileStore.open() : null;
  const all = [...files, ...((await store?.all()) ?? [])];
  let panic: string | null = null;
  const module = await compiling;
  const started = await Engine.start(module, message => (panic = message));
  failing = () => panic;
  started.begin(first, performance.now());
  all.forEach(([path, text]) => started.insert(path, text));
  store?.follow((path, text) => {
    engine?.insert(path, text);
    say({ say: "wrote", path, text });
  });
  engine = started;
  say({ say: "ready", keeps: store !== null, module, files: all });
  guard(() => waiting.splice(0).forEach(message => take(started, message)));
  work();
}

/** Takes these assistants in the place of those before. */
function lead(ports: MessagePort[]): void {
  const tell = (call: (engine: Engine) => void): void => {
    const told = engine;
    if (told !== null) {
      guard(() => call(told));
      soon();
    }
  };
  crew?.close();
  crew = new Crew(
    ports,
    size => tell(engine => engine.crew(size)),
    ({ number, bytes }) => tell(engine => engine.receivePart(number, bytes)),
  );
}

async function assist({ module, port }: Extract<ToWorker, { say: "assist" }>): Promise<void> {
  const assistant = await Engine.start(module, () => {});
  const tell = (message: FromAssistant, transfer: Transferable[] = []): void => port.postMessage(message, transfer);
  port.onmessage = ({ data }: MessageEvent<Part>) => {
    const bytes = assistant.simulate(data.bytes);
    tell({ number: data.number, bytes }, [bytes]);
  };
  tell("ready");
}

let failing: () => string | null = () => null;

/** The program as a response that the browser compiles while it comes. */
async function read(program: Exclude<Source, { module: unknown }>): Promise<Response> {
  const packed = "packed" in program ? new Blob([program.packed]).stream() : await fetched(program);
  return new Response(packed.pipeThrough(new DecompressionStream("gzip")), {
    headers: { "content-type": "application/wasm" },
  });
}

/** The bytes of the program. The page learns how many have come. */
async function fetched({ address, bytes }: { address: string; bytes: number }): Promise<ReadableStream<BufferSource>> {
  const response = await fetch(address);
  if (!response.ok || response.body === null) {
    throw new Error(`${address}: ${response.status} ${response.statusText}`);
  }
  let done = 0;
  const count = new TransformStream<Uint8Array<ArrayBuffer>, BufferSource>({
    transform(part, out) {
      done += part.length;
      say({ say: "loading", done, all: bytes });
      out.enqueue(part);
    },
  });
  return response.body.pipeThrough(count);
}

/** Gives the program the page that live exports are made of. Without it the program says that they cannot be made. */
async function template(engine: Engine, { page, program }: LiveParts): Promise<void> {
  const answers = await Promise.all([page, program].map(part => fetch(part).catch(() => null)));
  const [text, packed] = await Promise.all(
    answers.map(answer => (answer?.ok === true ? answer.blob() : Promise.resolve(null))),
  );
  if (text && packed) {
    const [, letters = ""] = new FileReaderSync().readAsDataURL(packed).split(",");
    const whole = (await text.text()).replace("{{program}}", letters);
    guard(() => engine.template(whole));
  }
  say({ say: "template" });
}

function keep(path: string, text: Contents | null): void {
  if (text === null) {
    store?.remove(path);
    return;
  }
  store?.put(path, text, isKept => say({ say: "kept", path, isKept }));
}

function take(engine: Engine, message: ToWorker): void {
  const now = performance.now();
  switch (message.say) {
    case "live":
      engine.receive(message.text, now);
      break;
    case "language":
      engine.receiveLanguage(message.text, now);
      break;
    case "greet":
      engine.greet();
      break;
    case "crew":
      lead(message.ports);
      break;
    case "insert":
      engine.insert(message.path, message.text);
      keep(message.path, message.text);
      break;
    case "template":
      void template(engine, message);
      break;
    case "drawn":
      hasRoom = true;
      break;
  }
}

/** Works on after the messages that have come. A timer would wait for some milliseconds. */
function soon(): void {
  if (!isPosted) {
    isPosted = true;
    pause.port2.postMessage(null);
  }
}

function work(): void {
  clearTimeout(timer);
  const working = engine;
  if (working !== null) {
    guard(() => advance(working));
  }
}

function advance(engine: Engine): void {
  const due = engine.advance(performance.now());
  for (let message = engine.next(hasRoom); message !== null; message = engine.next(hasRoom)) {
    pass(message);
  }
  if (due <= 0) {
    soon();
  } else {
    timer = setTimeout(work, due);
  }
}

/** Calls the program. If it fails, its memory may be in any state, so it is given up. */
function guard(call: () => void): void {
  try {
    call();
  } catch (error) {
    fail(failing() ?? String(error));
  }
}

function pass(message: NonNullable<ReturnType<Engine["next"]>>): void {
  switch (message.kind) {
    case "page":
      if (typeof message.data === "string") {
        say({ say: "live", data: message.data });
      } else {
        hasRoom = false;
        say({ say: "live", data: message.data }, [message.data]);
      }
      break;
    case "language":
      say({ say: "language", text: message.text });
      break;
    case "written":
      keep(message.path, message.text);
      say({ say: "wrote", path: message.path, text: message.text });
      break;
    case "part":
      crew?.give({ number: message.number, bytes: message.bytes });
      break;
    case "kept":
      say({ say: "file", address: message.address, type: message.type, bytes: message.bytes }, [message.bytes]);
      break;
  }
}
