// Counts in texts of the page.

/** A count with its noun, whose plural adds an s: `1 robot`, `2 robots`. */
export function counted(count: number, noun: string): string {
  return count === 1 ? `1 ${noun}` : `${count} ${noun}s`;
}
