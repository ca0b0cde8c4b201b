// What must be refused: wrong tokens, foreign pages, paths outside of the folder, and messages that are too large.

import assert from "node:assert/strict";
import { request } from "node:http";
import { connect } from "node:net";
import { after, before, test } from "node:test";

import { LATCH, folderWith, play } from "./program.mjs";

let place, program;

before(async () => {
  place = folderWith({ "latch.nb": LATCH });
  program = await play(place.folder, "latch.nb");
});

after(async () => {
  await program?.stop();
  place?.remove();
});

/** The status of a request, with the path as it is written. */
function statusOf(path, headers = {}) {
  return new Promise((resolve, reject) => {
    const sent = request({ host: "127.0.0.1", port: program.port, path, headers }, answer => {
      answer.resume();
      resolve(answer.statusCode);
    });
    sent.once("error", reject);
    sent.end();
  });
}

/** A web socket by hand, so that every header and byte is ours. */
function socketTo(path, headers = {}) {
  const all = {
    Host: `127.0.0.1:${program.port}`,
    Origin: `http://127.0.0.1:${program.port}`,
    Upgrade: "websocket",
    Connection: "Upgrade",
    "Sec-WebSocket-Version": "13",
    "Sec-WebSocket-Key": "dGhlIHNhbXBsZSBub25jZQ==",
    ...headers,
  };
  const lines = Object.entries(all)
    .filter(([, value]) => value !== null)
    .map(([name, value]) => `${name}: ${value}\r\n`);
  return new Promise((resolve, reject) => {
    const socket = connect(program.port, "127.0.0.1", () =>
      socket.write(`GET ${path} HTTP/1.1\r\n${lines.join("")}\r\n`),
    );
    socket.once("error", reject);
    let read = Buffer.alloc(0);
    // The head may come in several parts, and messages together with the last of them.
    const begin = data => {
      read = Buffer.concat([read, data]);
      const end = read.indexOf("\r\n\r\n");
      if (end >= 0) {
        socket.off("data", begin);
        const status = Number(/^HTTP\/1.1 (\d+)/.exec(read.toString("latin1"))?.[1]);
        resolve({ socket, status, rest: read.subarray(end + 4) });
      }
    };
    socket.on("data", begin);
    socket.once("close", () => resolve({ socket, status: 0 }));
  });
}

/** A masked text message. */
function textFrame(text) {
  const payload = Buffer.from(text);
  const head = Buffer.alloc(14);
  head[0] = 0x81;
  head[1] = 0x80 | 127;
  head.writeBigUInt64BE(BigInt(payload.length), 2);
  // A mask of zeros leaves the text as it is.
  return Buffer.concat([head, payload]);
}

const own = path => `/${program.token}/${path}`;

test("the page is there with its token, and strict about what it loads", async () => {
  const policy = await new Promise(resolve => {
    request({ host: "127.0.0.1", port: program.port, path: own("") }, answer => {
      answer.resume();
      resolve(answer.headers["content-security-policy"]);
    }).end();
  });
  assert.match(policy, /default-src 'none'/);
  assert.match(policy, /script-src 'self'/);
  assert.doesNotMatch(policy, /unsafe-eval/);
});

test("without the right token there is nothing", async () => {
  for (const path of [
    "/",
    "/app.js",
    "/wrong/",
    `/${program.token}x/`,
    `/${program.token.slice(0, -1)}/`,
    "/wrong/live",
  ]) {
    assert.ok((await statusOf(path)) >= 400, path);
  }
  const { socket, status } = await socketTo("/wrong/live");
  assert.notEqual(status, 101);
  socket.destroy();
});

test("pages of other origins and other host names are refused", async () => {
  for (const headers of [
    { Origin: "http://evil.example" },
    { Origin: "null" },
    { Host: "evil.example" },
    { Host: `evil.example:${program.port}` },
  ]) {
    for (const path of ["live", "language"]) {
      const { socket, status } = await socketTo(own(path), headers);
      assert.notEqual(status, 101, JSON.stringify(headers));
      socket.destroy();
    }
  }
  assert.ok((await statusOf(own(""), { Host: "evil.example" })) >= 400);
  const { socket, status } = await socketTo(own("live"));
  assert.equal(status, 101);
  socket.destroy();
});

test("paths lead nowhere else", async () => {
  for (const path of [
    "../../etc/passwd",
    "..%2f..%2fetc%2fpasswd",
    "%2e%2e/%2e%2e/etc/passwd",
    "take/1/../../../etc/passwd",
  ]) {
    assert.ok((await statusOf(own(path))) >= 400, path);
  }
});

test("files outside of the folder are neither read nor written", async () => {
  const socket = new WebSocketClient(own("live"));
  await socket.opened;
  for (const path of ["../outside.nb", "/etc/passwd", "a/../../outside.nb", "latch.yaml"]) {
    assert.ok((await socket.ask({ do: "read", path })).error !== undefined, path);
    assert.ok((await socket.ask({ do: "save", path, text: "", stamp: null })).error !== undefined, path);
  }
  assert.equal((await socket.ask({ do: "read", path: "latch.nb" })).ok.text, LATCH);
  socket.close();
});

test("a message that is too large ends its connection, and the others go on", async () => {
  const good = new WebSocketClient(own("live"));
  await good.opened;
  const { socket, status } = await socketTo(own("live"));
  assert.equal(status, 101);
  const ended = new Promise(resolve => socket.once("close", resolve));
  socket.on("error", () => {});
  socket.write(textFrame(JSON.stringify({ id: 1, do: "program", path: "a.nb", text: "x".repeat(3 << 20) })));
  await ended;
  assert.ok((await good.ask({ do: "files" })).ok.length > 0);
  good.close();
});

test("nonsense is answered by errors", async () => {
  const socket = new WebSocketClient(own("live"));
  await socket.opened;
  assert.ok((await socket.ask({ do: "no such thing" })).error !== undefined);
  assert.ok((await socket.ask({ do: "compile", path: 7 })).error !== undefined);
  assert.ok((await socket.ask({ do: "step", cycles: 1 })).error !== undefined);
  assert.ok((await socket.ask({ do: "files" })).ok.length > 0);
  socket.close();
});

/** Requests and answers over a socket by hand; messages of the server are not masked. */
class WebSocketClient {
  #next = 1;
  #waiting = new Map();
  #rest = Buffer.alloc(0);

  constructor(path) {
    this.opened = socketTo(path).then(({ socket, status, rest }) => {
      assert.equal(status, 101);
      this.socket = socket;
      this.#receive(rest);
      socket.on("data", data => this.#receive(data));
      socket.on("error", () => {});
    });
  }

  ask(fields) {
    const id = this.#next++;
    this.socket.write(textFrame(JSON.stringify({ id, ...fields })));
    return new Promise(resolve => this.#waiting.set(id, resolve));
  }

  close() {
    this.socket.destroy();
  }

  #receive(data) {
    this.#rest = Buffer.concat([this.#rest, data]);
    for (let message = this.#take(); message !== null; message = this.#take()) {
      if (message.text) {
        const answer = JSON.parse(message.payload.toString());
        this.#waiting.get(answer.id)?.(answer);
      }
    }
  }

  #take() {
    const data = this.#rest;
    if (data.length < 2) {
      return null;
    }
    const short = data[1] & 127;
    const head = short === 126 ? 4 : short === 127 ? 10 : 2;
    if (data.length < head) {
      return null;
    }
    const size = short === 126 ? data.readUInt16BE(2) : short === 127 ? Number(data.readBigUInt64BE(2)) : short;
    if (data.length < head + size) {
      return null;
    }
    this.#rest = data.subarray(head + size);
    return { text: (data[0] & 15) === 1, payload: data.subarray(head, head + size) };
  }
}
