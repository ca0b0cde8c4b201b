// Whether two texts are the same program.

/** Whether they differ at most in comments and space, so that the swarm need not be compiled again. */
export function sameProgram(a: string, b: string): boolean {
  return a === b || essence(a) === essence(b);
}

function essence(text: string): string {
  return text
    .split("\n")
    .map(line => withoutComment(line).trim().replace(/\s+/g, " "))
    .filter(line => line !== "")
    .join("\n");
}

function withoutComment(line: string): string {
  return /^(?:[^"/]|"[^"]*"|\/(?!\/))*/.exec(line)?.[0] ?? line;
}
