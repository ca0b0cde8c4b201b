// Links to programs: made in one page, opened in that of another server, and nothing that was there is lost.

import assert from "node:assert/strict";
import { after, before, test } from "node:test";

import { closeBrowser, setInput, typeProgram, visit, walking } from "./browser.mjs";
import { LATCH, folderWith, needs, play } from "./program.mjs";

const TWO = `circuit first(a, b) -> (q) {
    q = a and b
}

circuit second(a[2], b) -> (q) {
    q = a[1] nand b
}
`;

const permissions = { permissions: ["clipboard-read", "clipboard-write"] };
const here = {};

before(async () => {
  here.places = [folderWith({ "two.nb": TWO }), folderWith({ "two.nb": LATCH, "latch.nb": LATCH })];
  here.sender = await play(here.places[0].folder, "two.nb");
  here.receiver = await play(here.places[1].folder, "latch.nb");
  here.page = await visit(here.sender.url, permissions);
  await walking(here.page);
});

after(async () => {
  await here.page?.leave();
  await closeBrowser();
  await here.sender?.stop();
  await here.receiver?.stop();
  here.places?.forEach(place => place.remove());
});

const text = page =>
  page.evaluate(() => document.querySelector(".editor").shadowRoot.querySelector(".cm-content").textContent);
const file = (page, name) => page.waitForFunction(want => document.querySelector(".file").textContent === want, name);

async function copied(page, what) {
  await page.locator(".take summary").click();
  await page.locator(`[data-take="${what}"]`).click();
  await page.locator(".links .status", { hasText: "copied" }).waitFor();
  await page.keyboard.press("Escape");
  return page.evaluate(() => navigator.clipboard.readText());
}

test("a link has the program, its circuit and its inputs, and the secret only if it is for this server", async () => {
  await here.page.locator("select.circuit").selectOption({ label: "second" });
  await here.page.locator('[data-input="a[1]"]').waitFor();
  await setInput(here.page, "a[1]", 1);
  await setInput(here.page, "b", 1);
  here.link = await copied(here.page, "link");
  here.code = await copied(here.page, "any-link");
  assert.ok(here.link.startsWith(`${here.sender.address}#share=`), here.link);
  assert.ok(here.code.startsWith("#share=") && here.link.endsWith(here.code), here.code);
  assert.ok(here.code.length < 600, `${here.code.length} letters`);
});

test("behind the address of another server it opens as a draft, with the circuit and the inputs", async () => {
  const page = await visit(`${here.receiver.address}${here.code}`);
  await page.locator("[data-notice=shared]").waitFor();
  assert.equal(await page.locator(".file").textContent(), "two_2.nb", "the folder has another program of that name");
  assert.equal(await page.locator(".file").getAttribute("data-unsaved"), "true");
  assert.match(await text(page), /second/);
  await walking(page);
  assert.equal(await page.locator("select.circuit option:checked").textContent(), "second");
  for (const [name, on] of Object.entries({ "a[1]": "true", "a[0]": "false", b: "true" })) {
    assert.equal(await page.locator(`button[data-input="${name}"]`).getAttribute("aria-checked"), on, name);
  }
  await page.locator('[data-lamp="q"][data-value="0"]').waitFor();
  assert.ok(!page.url().includes("share="), "a reload does not open the link again");
  await page.reload();
  await file(page, "two_2.nb");
  assert.match(await text(page), /second/);
  await page.leave();
});

test("a link that is opened in a page loses nothing of the program that is there", async () => {
  const page = await visit(here.receiver.url);
  await walking(page);
  await typeProgram(page, "circuit mine(a) -> (q) { q = not a }");
  await page.locator('.file[data-unsaved="true"]').waitFor();
  // As pasted into the field for addresses.
  await page.evaluate(code => (location.hash = code), here.code);
  await file(page, "two_2.nb");
  await page.getByRole("button", { name: "Back to latch.nb" }).click();
  await file(page, "latch.nb");
  assert.match(await text(page), /circuit mine/);
  await page.leave();
});

test("a link can be pasted where programs are opened, and a wrong one says what is wrong", async () => {
  const page = await visit(here.receiver.url);
  await walking(page);
  await page.locator("[data-do=open]").click();
  const field = page.getByLabel("Link to a shared program");
  for (const [wrong, expected] of [
    ["latch", /not a link/],
    [here.code.slice(0, -9), /damaged/],
    [`#share=${"A".repeat(100_001)}`, /too long/],
  ]) {
    await field.fill(wrong);
    await page.locator("[data-do=open-shared]").click();
    await page.locator(".files .fail", { hasText: expected }).waitFor();
  }
  await field.fill(here.link);
  await page.locator("[data-do=open-shared]").click();
  await file(page, "two_2.nb");
  await page.leave();
});

test("a public page that is known has links, too", { skip: needs("server") }, async () => {
  const publicPage = "https://robots.example/nbc/";
  const program = await play(here.places[0].folder, "two.nb", { more: ["--public-page", publicPage] });
  const page = await visit(program.url, permissions);
  await walking(page);
  const link = await copied(page, "public-link");
  assert.ok(link.startsWith(`${publicPage}#share=`), link);
  const markdown = await copied(page, "markdown");
  assert.ok(markdown.startsWith("```nb\n") && markdown.includes(`[two.nb](${publicPage}#share=`), markdown);
  assert.equal(await here.page.locator('[data-take="public-link"]').count(), 0, "where none is known");
  await page.leave();
  await program.stop();
});

test("a hostile address opens the page as usual, with a notice, and runs nothing", async () => {
  const script = '<img src=x onerror="window.harmed=1"><script>window.harmed=1</script>';
  for (const fragment of ["share=", "share=%3Cscript%3E", "share=AAAA", "%", "%E0%A4%A"]) {
    const page = await visit(`${here.receiver.address}#${fragment}`);
    await walking(page);
    assert.equal(await page.locator(".file").textContent(), "latch.nb");
    assert.equal(await page.locator("[data-notice=shared]").count(), fragment.startsWith("share=") ? 1 : 0, fragment);
    await page.leave();
  }
  const page = await visit(here.receiver.url);
  await walking(page);
  const link = await page.evaluate(async given => {
    const json = {
      format: 1,
      file: given,
      text: `// ${given}\n`,
      circuit: given,
      swarm: given,
      inputs: { [given]: "1" },
      tab: given,
    };
    const stream = new Blob([JSON.stringify(json)]).stream().pipeThrough(new CompressionStream("deflate-raw"));
    const bytes = new Uint8Array(await new Response(stream).arrayBuffer());
    return `share=${btoa(String.fromCharCode(...bytes))
      .replaceAll("+", "-")
      .replaceAll("/", "_")
      .replaceAll("=", "")}`;
  }, script);
  await page.evaluate(fragment => (location.hash = fragment), link);
  await page.locator("[data-notice=shared]").waitFor();
  assert.match(await text(page), /onerror/);
  assert.equal(await page.evaluate(() => window.harmed), undefined);
  await page.leave();
});
