// Pages in the panel: a strict policy, the theme of the editor, and texts of users that stay texts.

import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { mkdtempSync, readFileSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import * as path from "node:path";
import { test } from "node:test";

import { drawingPage, messagePage, reportPage, textPage } from "../src/core/page";
import { NBC, ROOT } from "./nbc";

/** The report page of the latch. */
const REPORT = (() => {
  const folder = mkdtempSync(path.join(tmpdir(), "nbc-editor-"));
  const latch = path.join(ROOT, "circuits/latch.nb");
  execFileSync(NBC, ["run", latch, "--out", folder, "--format", "json"], { stdio: ["ignore", "ignore", "ignore"] });
  const page = readFileSync(path.join(folder, "report.html"), "utf8");
  rmSync(folder, { recursive: true });
  return page;
})();

test("only the scripts of the page run, and nothing is loaded", () => {
  const page = reportPage(REPORT, { nonce: "abc", dark: true });
  const policies = [...page.matchAll(/http-equiv="Content-Security-Policy" content="([^"]*)"/g)].map(match => match[1]);
  assert.deepEqual(policies, ["default-src 'none'; script-src 'nonce-abc'; style-src 'unsafe-inline'; img-src data:"]);
  const scripts = [...page.matchAll(/<script\b[^>]*>/g)].map(match => match[0]);
  assert.ok(scripts.length === 2 && scripts.every(script => script.includes(' nonce="abc"')), scripts.join());
  assert.deepEqual(page.match(/(src|href)="(?!data:)[^"]*"/g), null);
  assert.deepEqual(page.match(/<[a-z][^>]*\son[a-z]+=/g), null, "handlers in attributes would not run");
});

test("the page follows the theme of the editor", () => {
  const dark = reportPage(REPORT, { nonce: "a", dark: true });
  const light = reportPage(REPORT, { nonce: "a", dark: false });
  assert.ok(dark.includes("@media all{") && dark.includes("color-scheme:dark;"));
  assert.ok(light.includes("@media not all{") && light.includes("color-scheme:light;"));
  assert.ok([dark, light].every(page => !/@media ?\(prefers|light dark/.test(page)));
});

test("a file that is no report is not shown", () => {
  const page = reportPage("<script>alert(1)</script>", { nonce: "a", dark: false });
  assert.ok(!page.includes("<script"), page);
});

test("drawings are images, and texts are escaped", () => {
  const drawing = drawingPage('<a "b">', "<svg><script>1</script></svg>");
  assert.ok(drawing.includes('alt="&lt;a &quot;b&quot;&gt;"'));
  assert.ok(drawing.includes("default-src 'none'; style-src") && !drawing.includes("<script"), drawing);
  const encoded = /base64,([^"]*)"/.exec(drawing)![1]!;
  assert.equal(Buffer.from(encoded, "base64").toString(), "<svg><script>1</script></svg>");
  assert.ok(messagePage("a < b & c").includes("<p>a &lt; b &amp; c</p>"));
  assert.ok(textPage("t", "a  <b>").includes("<pre>a  &lt;b&gt;</pre>"));
});
