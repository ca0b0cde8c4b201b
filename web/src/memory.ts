// What this browser remembers of the page, under names of its own.

const PREFIX = "nbc:";

export function recall<T>(name: string): T | null {
  try {
    const text = localStorage.getItem(PREFIX + name);
    return text === null ? null : (JSON.parse(text) as T);
  } catch {
    return null;
  }
}

/** Remembers a value; null forgets it. A browser that forbids this only forgets. */
export function remember(name: string, value: unknown): void {
  try {
    if (value === null) {
      localStorage.removeItem(PREFIX + name);
    } else {
      localStorage.setItem(PREFIX + name, JSON.stringify(value));
    }
  } catch {
    // The page works without a memory.
  }
}
