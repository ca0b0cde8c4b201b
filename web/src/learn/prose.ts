// The texts of lessons: plain text, with code between backticks.

import { element, type Child } from "../element";

export function prose(text: string): Child[] {
  return text.split("`").map((part, i) => (i % 2 === 1 ? element("code", {}, part) : part));
}
