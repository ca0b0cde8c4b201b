// A server of files, as plain as there are.

import { createReadStream, existsSync } from "node:fs";
import { createServer } from "node:http";
import path from "node:path";

const TYPES = { ".html": "text/html", ".js": "text/javascript", ".css": "text/css", ".txt": "text/plain" };

/** Serves a folder, as the folder `sub` of the server if that is not empty. `rate` is in bytes a second. */
export async function serveFiles(folder, { sub = "", rate = Infinity } = {}) {
  const server = createServer((request, response) => {
    let name = decodeURIComponent(new URL(request.url, "http://here").pathname);
    name = name.endsWith("/") ? `${name}index.html` : name;
    const file = path.join(folder, name.slice(sub.length));
    if (!name.startsWith(`${sub}/`) || !existsSync(file)) {
      response.writeHead(404).end();
      return;
    }
    response.writeHead(200, { "content-type": TYPES[path.extname(file)] ?? "application/octet-stream" });
    slowly(createReadStream(file, { highWaterMark: 16_384 }), response, rate);
  });
  await new Promise(done => server.listen(0, "127.0.0.1", done));
  return {
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
