// What this browser remembers of the page, under names of its own.

let prefix = "nbc:";

/** Keeps what this page remembers apart from other pages of the same place, as files of a folder are. */
export function rememberApart(name: string): void {
  prefix = `nbc:${name}:`;
}

const LEARNER = "class-name";

/** The name in the class of the learner at this tab, until it is closed. A browser that forbids this asks again. */
export const learner = (): string | null => read(() => sessionStorage, LEARNER);
export const setLearner = (name: string | null): void => write(() => sessionStorage, LEARNER, name);

/** The name of what is the learner's own: those who use the same browser one after the other do not share it. */
export function own(name: string): string {
  const who = learner();
  return who === null ? name : `learner:${who}:${name}`;
}

export function recall<T>(name: string): T | null {
  try {
    return JSON.parse(recallText(name) ?? "null") as T | null;
  } catch {
    return null;
  }
}

export function remember(name: string, value: unknown): void {
  rememberText(name, value === null ? null : JSON.stringify(value));
}

export const recallText = (name: string): string | null => read(() => localStorage, prefix + name);
export const rememberText = (name: string, text: string | null): void => write(() => localStorage, prefix + name, text);

function read(storage: () => Storage, name: string): string | null {
  try {
    return storage().getItem(name);
  } catch {
    return null;
  }
}

/** A browser that forbids this only forgets: the page works without a memory. */
function write(storage: () => Storage, name: string, text: string | null): void {
  try {
    if (text === null) {
      storage().removeItem(name);
    } else {
      storage().setItem(name, text);
    }
  } catch {
    return;
  }
}

export function recalled(): string[] {
  try {
    const names = Object.keys(localStorage).filter(name => name.startsWith(prefix));
    return names.map(name => name.slice(prefix.length));
  } catch {
    return [];
  }
}
