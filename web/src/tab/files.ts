// The files of the page, kept by the browser in a database of its own. Other tabs learn of what is written.

const NAME = "nbc";
const STORE = "files";

/** Text, or the bytes of a file that is none. */
export type Contents = string | Uint8Array<ArrayBuffer>;
export type KeptFiles = [path: string, contents: Contents][];

export class FileStore {
  readonly #channel = new BroadcastChannel("nbc-files");

  private constructor(private readonly database: IDBDatabase) {}

  /** The database of this browser; null where it keeps nothing, as in private windows. */
  static open(): Promise<FileStore | null> {
    return new Promise(resolve => {
      try {
        const opening = indexedDB.open(NAME, 1);
        opening.onupgradeneeded = () => opening.result.createObjectStore(STORE);
        opening.onsuccess = () => resolve(new FileStore(opening.result));
        opening.onerror = () => resolve(null);
        opening.onblocked = () => resolve(null);
      } catch {
        resolve(null);
      }
    });
  }

  all(): Promise<KeptFiles> {
    return new Promise(resolve => {
      const store = this.database.transaction(STORE).objectStore(STORE);
      const found: KeptFiles = [];
      const walk = store.openCursor();
      walk.onsuccess = () => {
        const at = walk.result;
        if (at === null) {
          resolve(found);
        } else {
          found.push([String(at.key), at.value as Contents]);
          at.continue();
        }
      };
      walk.onerror = () => resolve(found);
    });
  }

  /** Keeps a file. Calls `done` with whether that was possible: a browser may have no room, or forbid it. */
  put(path: string, contents: Contents, done: (isKept: boolean) => void): void {
    const change = this.database.transaction(STORE, "readwrite");
    change.oncomplete = () => done(true);
    change.onabort = () => done(false);
    change.objectStore(STORE).put(contents, path);
    this.#channel.postMessage([path, contents]);
  }

  remove(path: string): void {
    this.database.transaction(STORE, "readwrite").objectStore(STORE).delete(path);
    this.#channel.postMessage([path, null]);
  }

  /** Calls `take` for each file that another tab writes, or deletes, with no contents. */
  follow(take: (path: string, contents: Contents | null) => void): void {
    this.#channel.onmessage = ({ data }) => take(...(data as [string, Contents | null]));
  }
}
