import assert from "node:assert/strict";
import { test } from "node:test";

import {
  LinkError,
  MOST_LINK,
  MOST_TEXT,
  decodeShare,
  encodeShare,
  isShare,
  safeName,
  type SharedProgram,
} from "../src/share/link";
import { decodeBase64Url, encodeBase64Url, pack, unpack } from "../src/share/packed";
import { sharedBits } from "../src/share/share";
import type { ShownSwarm } from "../src/protocol";

const LATCH: SharedProgram = {
  file: "latch.nb",
  text: "circuit n(a) -> (q) { q = not a } // é 🤖\n",
  circuit: "n",
  swarm: null,
  inputs: new Map([["a", "1"]]),
  tab: "swarm",
};

async function linkOf(value: unknown): Promise<string> {
  return `share=${encodeBase64Url(await pack(new TextEncoder().encode(JSON.stringify(value))))}`;
}

const refused = (link: string): Promise<void> => assert.rejects(decodeShare(link), LinkError);

test("a program comes back from its link, behind any address and without one", async () => {
  const code = await encodeShare(LATCH);
  assert.ok(isShare(code) && /^share=[\w-]+$/.test(code));
  for (const link of [code, `#${code}`, `http://127.0.0.1:8000/abc/#${code}`, `  http://[::1]:1/x/#${code}\n`]) {
    assert.deepEqual(await decodeShare(link), LATCH);
  }
});

test("a path of a program is no share", () => {
  assert.ok(!isShare("latch.nb") && !isShare("share=x.nb") && !isShare(""));
});

test("what is too long for a link is refused, and says so", async () => {
  const letters = Array.from({ length: MOST_TEXT }, (_, i) =>
    String.fromCharCode(33 + (((i * i * 7919 + i) % 9973) % 90)),
  );
  await assert.rejects(encodeShare({ ...LATCH, text: "a".repeat(MOST_TEXT + 1) }), /too long/);
  await assert.rejects(
    encodeShare({
      ...LATCH,
      text: letters
        .map((letter, i) => letter + ((i * 2_654_435_761) >>> 7))
        .join("")
        .slice(0, MOST_TEXT),
    }),
    new RegExp(`more than ${MOST_LINK}`),
  );
  assert.equal(
    (await decodeShare(await encodeShare({ ...LATCH, text: "a".repeat(MOST_TEXT) }))).text.length,
    MOST_TEXT,
  );
  await refused(`share=${"A".repeat(MOST_LINK + 1)}`);
});

test("few letters cannot become very many", async () => {
  const bomb = await linkOf({ format: 1, file: "a.nb", text: "a".repeat(20_000_000) });
  assert.ok(bomb.length < 50_000);
  await assert.rejects(decodeShare(bomb), /too long/);
  assert.equal(await unpack(await pack(new Uint8Array(5000)), 4999), null);
});

test("damaged and hostile links are refused", async () => {
  const code = await encodeShare(LATCH);
  for (const link of ["", "latch.nb", "share=", "share=%00", "share=!!!!", "share=AAAAA"]) {
    await refused(link);
  }
  for (let lost = 1; lost < code.length - 6; lost++) {
    await assert.rejects(decodeShare(code.slice(0, -lost)), /damaged/, `without the last ${lost} letters`);
  }
  const packed = encodeBase64Url(await pack(new Uint8Array([0xff, 0xfe, 0x22])));
  await refused(`share=${packed}`);
  for (const value of [
    null,
    1,
    "x",
    [],
    {},
    { format: 1 },
    { format: 1, file: 1, text: "" },
    { format: 1, file: "a", text: {} },
  ]) {
    await refused(await linkOf(value));
  }
  await assert.rejects(decodeShare(await linkOf({ format: 2, file: "a", text: "" })), /newer/);
});

test("no bytes at all make anything but a program or a refusal", async () => {
  let seed = 1;
  const random = (most: number): number => (seed = (seed * 48_271) % 2_147_483_647) % most;
  const code = await encodeShare(LATCH);
  for (let round = 0; round < 300; round++) {
    const letters = [...code];
    for (let change = random(4) + 1; change > 0; change--) {
      letters[6 + random(letters.length - 6)] = "ABCDEFabcdef0123-_"[random(18)] ?? "A";
    }
    await decodeShare(letters.join("")).catch(error => assert.ok(error instanceof LinkError, String(error)));
  }
});

test("odd fields are left out, not trusted", async () => {
  const odd = { format: 1, file: "../../etc/x.nb", text: "t", circuit: 5, swarm: "s".repeat(999), tab: {} };
  const shared = await decodeShare(await linkOf({ ...odd, inputs: { a: "2", b: "01", __proto__x: 1, c: [], d: "" } }));
  assert.deepEqual(shared, {
    file: "x.nb",
    text: "t",
    circuit: null,
    swarm: null,
    tab: null,
    inputs: new Map([["b", "01"]]),
  });
});

test("the name of a file stays in its folder", () => {
  assert.equal(safeName("/a/b/latch.nb"), "latch.nb");
  assert.equal(safeName("..\\..\\c:\\boot"), "boot.nb");
  assert.equal(safeName(".ssh"), "ssh.nb");
  assert.equal(safeName("<img src=x>.nb"), "img_src_x.nb");
  assert.equal(safeName("größe.v"), "größe.v");
  assert.equal(safeName("..."), "shared.nb");
  assert.equal(safeName(`${"x".repeat(5000)}.nb`).length, 83);
});

test("inputs are found by the names of their ports", () => {
  const swarm = {
    circuit: "n",
    inputs: [
      { name: "b", width: 2 },
      { name: "a", width: 1 },
    ],
  } as unknown as ShownSwarm;
  assert.equal(sharedBits(LATCH, swarm), "001");
  assert.equal(sharedBits({ ...LATCH, inputs: new Map([["b", "111"]]) }, swarm), "000", "another width");
  assert.equal(sharedBits({ ...LATCH, circuit: "m" }, swarm), null);
});

test("bytes survive the letters of an address", () => {
  const bytes = Uint8Array.from({ length: 256 }, (_, i) => i);
  for (const size of [0, 1, 2, 3, 4, 255, 256]) {
    const text = encodeBase64Url(bytes.slice(0, size));
    assert.ok(size === 0 || /^[\w-]+$/.test(text));
    assert.deepEqual(size === 0 ? new Uint8Array() : decodeBase64Url(text), bytes.slice(0, size));
  }
  assert.throws(() => decodeBase64Url("a+/="));
});
