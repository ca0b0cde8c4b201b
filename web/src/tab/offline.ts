// Keeps the files of the page, so that it opens without a network after the first visit. A new version replaces them
// all at once.

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
  clients: { claim: () => Promise<void> };
}

scope.addEventListener("install", event => {
  event.waitUntil(
    caches
      .open(NAME)
      .then(cache => cache.addAll(FILES))
      .then(() => scope.skipWaiting()),
  );
});
scope.addEventListener("activate", event => {
  const old = (name: string): boolean => name.startsWith("nbc-") && name !== NAME;
  event.waitUntil(
    caches
      .keys()
      .then(names => Promise.all(names.filter(old).map(name => caches.delete(name))))
      .then(() => scope.clients.claim()),
  );
});
scope.addEventListener("fetch", event => {
  event.respondWith(caches.match(event.request, { ignoreSearch: true }).then(kept => kept ?? fetch(event.request)));
});
export {};
