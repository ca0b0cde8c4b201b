// Keeps the files of the page, so that it opens without a network after the first visit. All names but that of the
// document contain a hash, so a kept file is never stale; the document comes from the network wherever there is one.

declare const VERSION: string;
declare const FILES: string[];

const NAME = `nbc-${VERSION}`;
declare const self: ServiceWorkerGlobalScope;

async function install(): Promise<void> {
  const cache = await caches.open(NAME);
  // A browser may take the document of the version before from its own cache.
  await cache.addAll(FILES.map(file => new Request(file, { cache: "reload" })));
  await self.skipWaiting();
}

/** The files of the version before stay for the tabs that are open. */
async function activate(): Promise<void> {
  const kept = (await caches.keys()).filter(name => name.startsWith("nbc-") && name !== NAME);
  await Promise.all(kept.slice(0, -1).map(name => caches.delete(name)));
  await self.clients.claim();
  (await self.clients.matchAll()).forEach(tab => tab.postMessage(FILES));
}

async function newest(): Promise<Response> {
  const found = await fetch(self.registration.scope, { cache: "no-cache" }).catch(() => null);
  const kept = found?.ok === true ? undefined : await (await caches.open(NAME)).match("./");
  return kept ?? found ?? Response.error();
}

async function kept(request: Request): Promise<Response> {
  return (await caches.match(request)) ?? fetch(request);
}

self.addEventListener("install", event => event.waitUntil(install()));
self.addEventListener("activate", event => event.waitUntil(activate()));
self.addEventListener("fetch", event => {
  const isDocument = event.request.url.replace(/[?#].*/, "") === self.registration.scope;
  event.respondWith(isDocument ? newest() : kept(event.request));
});
export {};
