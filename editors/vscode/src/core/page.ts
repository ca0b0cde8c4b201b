// Pages for the panel. A report page of `nbc` has all of its data and scripts, and loads nothing. In the panel, only
// its own scripts may run, and it follows the theme of the editor.

export interface Frame {
  /** A random word for the scripts of the page. */
  nonce: string;
  dark: boolean;
}

const POLICY = /<meta http-equiv="Content-Security-Policy"[^>]*>/;

export function reportPage(report: string, frame: Frame): string {
  if (!POLICY.test(report)) {
    return messagePage("This file is not a report page of nbc.");
  }
  const scripts = frame.nonce;
  return (
    report
      .replace(POLICY, policy(`script-src 'nonce-${scripts}'; `))
      // Users' texts in the page are escaped, so that each of these is an element of nbc.
      .replaceAll(/<script(?=[ >])/g, `<script nonce="${scripts}"`)
      // The style of a page may be minified.
      .replace(/color-scheme: ?light dark;/, `color-scheme:${frame.dark ? "dark" : "light"};`)
      .replaceAll(/@media ?\(prefers-color-scheme: ?dark\)/g, frame.dark ? "@media all" : "@media not all")
  );
}

/** A drawing, as SVG, which has a heading of its own. */
export function drawingPage(heading: string, svg: string): string {
  const image = `data:image/svg+xml;base64,${Buffer.from(svg).toString("base64")}`;
  // Drawings are made for paper.
  const style = "body { background: #ffffff; color: #1a1a1a; } img { max-width: none; }";
  const title = escape(heading);
  return page(style, `<img alt="${title}" src="${image}">`);
}

export function textPage(heading: string, text: string): string {
  return page("", `<h1>${escape(heading)}</h1><pre>${escape(text)}</pre>`);
}

export function messagePage(sentence: string): string {
  return page("", `<p>${escape(sentence)}</p>`);
}

/** Text for an element or an attribute. */
export function escape(text: string): string {
  return text.replaceAll("&", "&amp;").replaceAll("<", "&lt;").replaceAll(">", "&gt;").replaceAll('"', "&quot;");
}

function page(style: string, body: string): string {
  const head = `<meta charset="utf-8">${policy("")}<style>${style}</style>`;
  return `<!doctype html>\n<html lang="en">\n<head>${head}</head>\n<body>${body}</body>\n</html>\n`;
}

function policy(scripts: string): string {
  const content = `default-src 'none'; ${scripts}style-src 'unsafe-inline'; img-src data:`;
  return `<meta http-equiv="Content-Security-Policy" content="${content}">`;
}
