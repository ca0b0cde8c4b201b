// What this browser remembers of the page, under names of its own.

let prefix = "nbc:";

/** Keeps what this page remembers apart from other pages of the same place, as files of a folder are. */
export function rememberApart(name: string): void {
  prefix = `nbc:${name}:`;
}

const LEARNER = "class-name";

/** The name in the class of the learner at this tab, until it is closed. */
export function learner(): string | null {
  try {
    return sessionStorage.getItem(LEARNER);
  } catch {
    return null;
  }
}

/** Sets it. A browser that forbids this asks for the name again. */
export function setLearner(name: string | null): void {
  try {
    if (name === null) {
      sessionStorage.removeItem(LEARNER);
    } else {
      sessionStorage.setItem(LEARNER, name);
    }
  } catch {
    // Then there is none.
  }
}

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

export function recallText(name: string): string | null {
  try {
    return localStorage.getItem(prefix + name);
  } catch {
    return null;
  }
}

export function rememberText(name: string, text: string | null): void {
  try {
    if (text === null) {
      localStorage.removeItem(prefix + name);
    } else {
      localStorage.setItem(prefix + name, text);
    }
  } catch {
    // A browser that forbids this only forgets: the page works without a memory.
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
