// The text of a program, as far as checks of lessons look at it.

interface Declaration {
  kind: string;
  text: string;
}

const KINDS =
  "circuit|environment|prove|test|swarm|library|enum|let|use|world|simulate|schedule|stimulus|images|material|" +
  "evolution|file";
const BEGINNING = new RegExp(`^\\s*(${KINDS})\\b`);
const GATES = /\b(?:not|and|or|xor|nand|nor|xnor)\b/g;

/** The declarations of a text, without comments. */
function declarations(text: string): Declaration[] {
  const found: Declaration[] = [];
  let depth = 0;
  for (const line of text.split("\n")) {
    const code = /^(?:[^"/]|"[^"]*"|\/(?!\/))*/.exec(line)?.[0] ?? line;
    const kind = depth === 0 ? BEGINNING.exec(code)?.[1] : undefined;
    if (kind !== undefined) {
      found.push({ kind, text: "" });
    }
    const last = found.at(-1);
    if (last !== undefined) {
      last.text += `${code}\n`;
    }
    const plain = code.replace(/"[^"]*"/g, "");
    depth = Math.max(0, depth + count(plain, /\{/g) - count(plain, /\}/g));
  }
  return found;
}

function count(text: string, what: RegExp): number {
  return [...text.matchAll(what)].length;
}

function textOf(text: string, kind: string): string {
  return declarations(text)
    .filter(declaration => declaration.kind === kind)
    .map(declaration => declaration.text)
    .join("\n");
}

/** The gates that are written in the circuits of a program. */
export function gatesWritten(text: string): number {
  return count(textOf(text, "circuit"), GATES);
}

/** Whether a word or a sign is in the circuits of a program. */
export function circuitsHave(text: string, word: string): boolean {
  const circuits = textOf(text, "circuit").replaceAll("->", " ");
  return /^\w+$/.test(word) ? new RegExp(`\\b${word}\\b`).test(circuits) : circuits.includes(word);
}

/** The lines of the tests and claims of a program, with the same space between their words. */
export function testLines(text: string): Set<string> {
  const lines = `${textOf(text, "test")}\n${textOf(text, "prove")}`.split("\n");
  return new Set(lines.map(line => line.trim().replace(/\s+/g, " ")).filter(line => line !== ""));
}

/** The names of the outputs of all circuits in a text. */
export function outputNames(text: string): string[] {
  return [...text.matchAll(/->\s*\(([^)]*)\)/g)].flatMap(([, list = ""]) =>
    [...list.matchAll(/([A-Za-z_]\w*)(?:\[[^\]]*\])?\s*(?::[^,]*)?(?:,|$)/g)].map(([, name = ""]) => name),
  );
}
