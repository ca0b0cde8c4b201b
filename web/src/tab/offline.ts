// Keeps the files of the page, so that it opens without a network after the first visit. All names but that of the
// document contain a hash, so a kept file is never stale; the document comes from the network wherever there is one.

declare const VERSION: string;
declare const FILES: string[];

const NAME = `nbc-${VERSION}`;
const scope = globalThis as unknown as ServiceWorkerScope;

interface ExtendableEvent extends Event {
  waitUntil: (work: Promise<unknown>) => void;
}

interface FetchEvent extends ExtendableEvent {
  request: Request;
  respondWith: (response: Promise<Response>) => void;
}

interface ServiceWorkerScope {
  addEventListener: ((name: "install" | "activate", listener: (event: ExtendableEvent) => void) => void) &
    ((name: "fetch", listener: (event: FetchEvent) => void) => void);
  skipWaiting: () => Promise<void>;
  registration: { scope: string };
  clients: { claim: () => Promise<void>; matchAll: () => Promise<{ postMessage: (files: string[]) => void }[]> };
}

async function install(): Promise<void> {
  const cache = await caches.open(NAME);
  // A browser may take the document of the version before from its own cache.
  await cache.addAll(FILES.map(file => new Request(file, { cache: "reload" })));
  await scope.skipWaiting();
}

/** The files of the version before stay for the tabs that are open. */
async function activate(): Promise<void> {
  const kept = (await caches.keys()).filter(name => name.startsWith("nbc-") && name !== NAME);
  await Promise.all(kept.slice(0, -1).map(name => caches.delete(name)));
  await scope.clients.claim();
  (await scope.clients.matchAll()).forEach(tab => tab.postMessage(FILES));
}

async function newest(): Promise<Response> {
  const found = await fetch(scope.registration.scope, { cache: "no-cache" }).catch(() => null);
  const kept = found?.ok === true ? undefined : await (await caches.open(NAME)).match("./");
  return kept ?? found ?? Response.error();
}

async function kept(request: Request): Promise<Response> {
  return (await caches.match(request)) ?? fetch(request);
}

scope.addEventListener("install", event => event.waitUntil(install()));
scope.addEventListener("activate", event => event.waitUntil(activate()));
scope.addEventListener("fetch", event => {
  const isDocument = event.request.url.replace(/[?#].*/, "") === scope.registration.scope;
  event.respondWith(isDocument ? newest() : kept(event.request));
});
export {};
