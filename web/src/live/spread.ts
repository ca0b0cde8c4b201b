// Names that must not cover each other.

/** Moves places apart until each is `gap` below the one before, within `top` and `bottom` if there is room. */
export function spread(ends: { y: number }[], gap: number, top: number, bottom: number): void {
  ends.sort((a, b) => a.y - b.y);
  let least = top;
  for (const end of ends) {
    end.y = Math.max(end.y, least);
    least = end.y + gap;
  }
  let most = bottom;
  for (const end of [...ends].reverse()) {
    end.y = Math.min(end.y, most);
    most = end.y - gap;
  }
}
