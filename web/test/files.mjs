// A server of files, as plain as there are.

import { createHash } from "node:crypto";
import { createReadStream, existsSync, readFileSync } from "node:fs";
import { createServer } from "node:http";
import path from "node:path";

const TYPES = { ".html": "text/html", ".js": "text/javascript", ".css": "text/css", ".txt": "text/plain" };

/** What a server says of files that are ten days old: without a Cache-Control, browsers do not ask for them again. */
function dated(file) {
  const etag = `"${createHash("sha256").update(readFileSync(file)).digest("hex")}"`;
  return { "last-modified": new Date(Date.now() - 10 * 86_400_000).toUTCString(), etag };
}

/**
 * Serves a folder, as the folder `sub` of the server if that is not empty. `rate` is in bytes a second. `isOld` is
 * whether the files are ten days old. Another folder can be deployed in its place.
 */
export async function serveFiles(folder, { sub = "", rate = Infinity, isOld = false } = {}) {
  let present = folder;
  const server = createServer((request, response) => {
    let name = decodeURIComponent(new URL(request.url, "http://here").pathname);
    name = name.endsWith("/") ? `${name}index.html` : name;
    const file = path.join(present, name.slice(sub.length));
    if (!name.startsWith(`${sub}/`) || !existsSync(file)) {
      response.writeHead(404).end();
      return;
    }
    const date = isOld ? dated(file) : {};
    if (isOld && request.headers["if-none-match"] === date.etag) {
      response.writeHead(304, date).end();
      return;
    }
    const type = TYPES[path.extname(file)] ?? "application/octet-stream";
    response.writeHead(200, { "content-type": type, ...date });
    slowly(createReadStream(file, { highWaterMark: 16_384 }), response, rate);
  });
  await new Promise(done => server.listen(0, "127.0.0.1", done));
  return {
    deploy: next => (present = next),
    address: `http://127.0.0.1:${server.address().port}${sub}/`,
    stop: () =>
      new Promise(done => {
        server.close(done);
        server.closeAllConnections();
      }),
  };
}

async function slowly(from, to, rate) {
  for await (const part of from) {
    to.write(part);
    if (rate !== Infinity) {
      await new Promise(done => setTimeout(done, (1000 * part.length) / rate));
    }
  }
  to.end();
}
