// What this browser remembers of the page, under names of its own.

let prefix = "nbc:";

/** Keeps what this page remembers apart from other pages of the same place, as files of a folder are. */
export function rememberApart(name: string): void {
  prefix = `nbc:${name}:`;
}

export function recall<T>(name: string): T | null {
  try {
    const text = localStorage.getItem(prefix + name);
    return text === null ? null : (JSON.parse(text) as T);
  } catch {
    return null;
  }
}

/** Remembers a value; null forgets it. A browser that forbids this only forgets. */
export function remember(name: string, value: unknown): void {
  try {
    if (value === null) {
      localStorage.removeItem(prefix + name);
    } else {
      localStorage.setItem(prefix + name, JSON.stringify(value));
    }
  } catch {
    // The page works without a memory.
  }
}
