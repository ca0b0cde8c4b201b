// The tests that a program declares, with the lines of their rows, and its claims, with the lines of their properties.
// This needs no `nbc`, so that the test explorer has items before anything ran. `nbc test --format json` and `nbc prove
// --format json` report the same lines.

/** A `test` or `prove` declaration. Lines count from 0. */
export interface DeclaredTest {
  kind: "test" | "prove";
  /** The circuit as it is written, with its arguments: `ripple[3]`. */
  circuit: string;
  title: string;
  line: number;
  endLine: number;
  /** The rows that are written, or the properties but for assumptions; a test of all inputs or for ever has none. */
  rows: DeclaredRow[];
}

export interface DeclaredRow {
  line: number;
  /** The row as it is written, with single spaces. */
  text: string;
}

/** The name by which `--only` chooses a test or a claim: its title, or its circuit without arguments. */
export function nameOf({ title, circuit }: DeclaredTest): string {
  return title === "" ? circuit.split("[")[0]!.trim() : title;
}

interface Token {
  kind: "word" | "text" | "sign";
  text: string;
  line: number;
  start: number;
}

const TOKEN = /\/\/.*|"[^"]*"|\w+|[^\s\w]/g;

/** The tests and claims of a program, in order. A program with errors may have fewer. */
export function declaredTests(source: string): DeclaredTest[] {
  const tokens = source.split(/\r?\n/).flatMap(tokensOf);
  const tests: DeclaredTest[] = [];
  let depth = 0;
  for (let at = 0; at < tokens.length; at++) {
    const found = depth === 0 ? readDeclaration(tokens, at) : undefined;
    if (found !== undefined) {
      tests.push(found.test);
      at = found.last;
    } else {
      depth = Math.max(0, depth + nesting(tokens[at], "{", "}"));
    }
  }
  return tests;
}

function tokensOf(text: string, line: number): Token[] {
  const words = [...text.matchAll(TOKEN)].filter(match => !match[0].startsWith("//"));
  return words.map(match => ({ kind: kindOf(match[0]), text: match[0], line, start: match.index }));
}

function kindOf(text: string): Token["kind"] {
  return text.startsWith('"') && text.length > 1 ? "text" : /^\w/.test(text) ? "word" : "sign";
}

function is(token: Token | undefined, text: string): boolean {
  return token !== undefined && token.kind !== "text" && token.text === text;
}

function nesting(token: Token | undefined, open: string, close: string): number {
  return is(token, open) ? 1 : is(token, close) ? -1 : 0;
}

/** Reads the test or claim that begins with the word at `start`; `last` is its last token. */
function readDeclaration(tokens: Token[], start: number): { test: DeclaredTest; last: number } | undefined {
  const kind = (["test", "prove"] as const).find(word => is(tokens[start], word));
  if (kind === undefined || tokens[start + 1]?.kind !== "word") {
    return undefined;
  }
  const name = afterInstance(tokens, start + 1);
  const circuit = written(tokens.slice(start + 1, name + 1));
  const titled = tokens[name + 1]?.kind === "text";
  const title = titled ? tokens[name + 1]!.text.slice(1, -1) : "";
  const at = afterClauses(tokens, name + (titled ? 2 : 1));
  const allInputs = is(tokens[at], "for");
  const body = allInputs ? at + 3 : at;
  if (kind === "prove" && is(tokens[at], "{")) {
    const last = closing(tokens, at, "{", "}");
    const rows = propertiesOf(tokens.slice(at + 1, last));
    return { test: { kind, circuit, title, line: tokens[start]!.line, endLine: tokens[last]!.line, rows }, last };
  }
  const against = is(tokens[body], "against");
  const fromFile = is(tokens[body], "from") && tokens[body + 1]?.kind === "text";
  if (kind === "prove" || (!against && !fromFile && !is(tokens[body], "{"))) {
    return undefined;
  }
  const last = against
    ? afterEver(tokens, afterInstance(tokens, body + 1))
    : fromFile
      ? afterShare(tokens, body + 1)
      : closing(tokens, body, "{", "}");
  const rows = against || allInputs || fromFile ? [] : rowsOf(tokens.slice(body + 1, last));
  const endLine = tokens[last]!.line;
  return { test: { kind, circuit, title, line: tokens[start]!.line, endLine, rows }, last };
}

/** The token after what a test says before its rows: what answers it, and its worlds. */
function afterClauses(tokens: Token[], at: number): number {
  if (is(tokens[at], "with")) {
    return afterClauses(tokens, afterInstance(tokens, at + 1) + 1);
  }
  if (is(tokens[at], "in")) {
    return (is(tokens[at + 1], "[") ? closing(tokens, at + 1, "[", "]") : at + 1) + 1;
  }
  return at;
}

/** The last token of the words `for ever` after `at`, if they are there. */
function afterEver(tokens: Token[], at: number): number {
  return is(tokens[at + 1], "for") && is(tokens[at + 2], "ever") ? at + 2 : at;
}

/** The last token of a file at `at` and of the share of its rows that must hold: `at least 93%`. */
function afterShare(tokens: Token[], at: number): number {
  if (!is(tokens[at + 1], "at") || !is(tokens[at + 2], "least")) {
    return at;
  }
  const rest = tokens.slice(at + 3);
  const other = rest.findIndex(({ text }) => !/^(\d+|[.%])$/.test(text));
  return at + 2 + (other < 0 ? rest.length : other);
}

/** The last token of an instance such as `adder[8]`. */
function afterInstance(tokens: Token[], at: number): number {
  return is(tokens[at + 1], "[") ? closing(tokens, at + 1, "[", "]") : Math.min(at, tokens.length - 1);
}

/** The token that closes the bracket at `open`, or the last one. */
function closing(tokens: Token[], open: number, opening: string, closing: string): number {
  let depth = 0;
  for (let at = open; at < tokens.length; at++) {
    depth += nesting(tokens[at], opening, closing);
    if (depth === 0) {
      return at;
    }
  }
  return tokens.length - 1;
}

/** The properties of a claim but for its assumptions: each begins with a word that nothing else is. */
function propertiesOf(tokens: Token[]): DeclaredRow[] {
  const begins = (token: Token) => ["always", "never", "assume"].some(word => is(token, word));
  const starts = tokens.flatMap((token, at) => (begins(token) ? [at] : []));
  const parts = starts.map((start, at) => tokens.slice(start, starts[at + 1]));
  const wanted = parts.filter(([word]) => !is(word, "assume"));
  return wanted.map(part => ({ line: part[0]!.line, text: written(part) }));
}

/** The lines after the first one, which names the columns, without the braces of repetitions. */
function rowsOf(tokens: Token[]): DeclaredRow[] {
  const byLine = new Map<number, Token[]>();
  for (const token of tokens) {
    byLine.set(token.line, [...(byLine.get(token.line) ?? []), token]);
  }
  const rows = [...byLine].slice(1).map(([line, row]) => ({ line, text: written(withoutRepetition(row)) }));
  return rows.filter(row => row.text !== "");
}

/** A line without `repeat 3 {` before the row and `}` after it. */
function withoutRepetition(row: Token[]): Token[] {
  const open = is(row[0], "repeat") ? row.findIndex(token => is(token, "{")) : -1;
  let rest = row.slice(open + 1);
  while (rest.reduce((depth, token) => depth + nesting(token, "{", "}"), 0) < 0 && is(rest.at(-1), "}")) {
    rest = rest.slice(0, -1);
  }
  return open >= 0 ? withoutRepetition(rest) : rest;
}

/** Tokens as they are written, with single spaces for blanks and line ends. */
function written(tokens: Token[]): string {
  let text = "";
  let end: { line: number; column: number } | undefined;
  for (const token of tokens) {
    const apart = end !== undefined && (end.line !== token.line || end.column !== token.start);
    text += apart ? ` ${token.text}` : token.text;
    end = { line: token.line, column: token.start + token.text.length };
  }
  return text;
}
