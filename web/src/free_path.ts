// A path that nothing has.

/** A path like the wished one that is not taken: itself, or with a number. */
export function freePath(wished: string, isTaken: (path: string) => boolean): string {
  const [, stem = wished, ending = ""] = /^(.*?)(\.\w+)?$/.exec(wished) ?? [];
  let path = wished;
  for (let number = 2; isTaken(path); number++) {
    path = `${stem}_${number}${ending}`;
  }
  return path;
}
