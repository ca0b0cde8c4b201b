// Documentation from the language server contains texts of the user's files, so only harmless HTML is kept.

const TEXT = "A B BLOCKQUOTE BR CODE DD DEL DL DT EM H1 H2 H3 H4 H5 H6 HR I IMG LI OL P PRE S SPAN STRONG UL";
const ELEMENTS = new Set(`${TEXT} TABLE TBODY TD TH THEAD TR`.split(" "));
const ATTRIBUTES = new Set(["alt", "class", "height", "href", "src", "title", "width"]);

export function sanitize(html: string): string {
  const { body } = new DOMParser().parseFromString(html, "text/html");
  for (const element of [...body.querySelectorAll("*")]) {
    if (!ELEMENTS.has(element.tagName)) {
      element.remove();
      continue;
    }
    for (const { name, value } of [...element.attributes]) {
      if (!ATTRIBUTES.has(name) || !isHarmless(name, value)) {
        element.removeAttribute(name);
      }
    }
  }
  return body.innerHTML;
}

/** Pictures are in the text itself, and links lead to the web. */
function isHarmless(name: string, value: string): boolean {
  return name === "src" ? value.startsWith("data:image/") : name !== "href" || /^https?:/.test(value);
}
