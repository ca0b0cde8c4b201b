// Counts in texts of the page.

/** A count with its noun, whose plural adds an s: `1 robot`, `2 robots`. */
export const counted = (count: number, noun: string): string => `${count} ${noun}${count === 1 ? "" : "s"}`;
