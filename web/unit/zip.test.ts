import assert from "node:assert/strict";
import { test } from "node:test";

import { ZipError, unzip, zip } from "../src/tab/zip";

const FILES: [string, string][] = [
  ["latch.nb", "circuit latch(d, e) -> (q) {}\n".repeat(100)],
  ["sub/folder/größe 逻辑.nb", "// ü\n"],
  ["empty.nb", ""],
];

/** Made by zipfile of Python: a folder, files deflated and stored, hidden ones, and one that is no text. */
const FOREIGN =
  "UEsDBBQAAAAAAAAAIQAAAAAAAAAAAAAAAAAJAAAAY2lyY3VpdHMvUEsDBBQAAAgIAINEe11mWPHVIwAAAHgAAAATAAAAY2lyY3VpdHMvZ3LD" +
  "tsOfZS5uYkvOLEouzSxRSNdI1FTQtVPQKNRUqFYoVLBVSFSo5UqmmSwAUEsDBBQAAAAAAINEe13VI9JTCAAAAAgAAAANAAAAcm9ib3RzL2Eu" +
  "eWFtbG5hbWU6IGEKUEsDBBQAAAAAAINEe12DFtyMAQAAAAEAAAAMAAAAX19NQUNPU1gvLl9heFBLAwQUAAAAAACDRHtdgxbcjAEAAAABAAAA" +
  "CwAAAC5naXQvY29uZmlneFBLAwQUAAAAAACDRHtdWr1RdwYAAAAGAAAACwAAAHBpY3R1cmUucG5niVBOR//+UEsBAhQDFAAAAAAAAAAhAAAA" +
  "AAAAAAAAAAAAAAkAAAAAAAAAAAAAAIABAAAAAGNpcmN1aXRzL1BLAQIUAxQAAAgIAINEe11mWPHVIwAAAHgAAAATAAAAAAAAAAAAAACAAScA" +
  "AABjaXJjdWl0cy9ncsO2w59lLm5iUEsBAhQDFAAAAAAAg0R7XdUj0lMIAAAACAAAAA0AAAAAAAAAAAAAAIABewAAAHJvYm90cy9hLnlhbWxQ" +
  "SwECFAMUAAAAAACDRHtdgxbcjAEAAAABAAAADAAAAAAAAAAAAAAAgAGuAAAAX19NQUNPU1gvLl9hUEsBAhQDFAAAAAAAg0R7XYMW3IwBAAAA" +
  "AQAAAAsAAAAAAAAAAAAAAIAB2QAAAC5naXQvY29uZmlnUEsBAhQDFAAAAAAAg0R7XVq9UXcGAAAABgAAAAsAAAAAAAAAAAAAAIABAwEAAHBp" +
  "Y3R1cmUucG5nUEsFBgAAAAAGAAYAXwEAADIBAAAAAA==";

function bytesOf(base64: string): Uint8Array {
  return Uint8Array.from(atob(base64), letter => letter.charCodeAt(0));
}

/** The reason for which an archive is refused. */
function refusal(bytes: Uint8Array): string {
  try {
    unzip(bytes);
  } catch (error) {
    assert.ok(error instanceof ZipError, String(error));
    return error.message;
  }
  return "";
}

function changed(bytes: Uint8Array, change: (view: DataView) => void): Uint8Array {
  const copy = bytes.slice();
  change(new DataView(copy.buffer));
  return copy;
}

/** Where the directory begins. */
function directoryOf(bytes: Uint8Array): number {
  return new DataView(bytes.buffer, bytes.byteOffset).getUint32(bytes.length - 6, true);
}

test("files come back with their names and texts, and the same files give the same archive", () => {
  const packed = zip(FILES);
  assert.deepEqual(unzip(packed), FILES);
  assert.deepEqual(zip(FILES), packed);
  assert.ok(packed.length < 1000, `${packed.length} bytes`);
  assert.deepEqual(unzip(zip([])), []);
  assert.deepEqual(unzip(zip(unzip(bytesOf(FOREIGN)))), unzip(bytesOf(FOREIGN)));
});

test("an archive of another program is read, without what systems hide", () => {
  assert.deepEqual(unzip(bytesOf(FOREIGN)), [
    ["circuits/größe.nb", "circuit g(a) -> (q) { q = a }\n".repeat(4)],
    ["robots/a.yaml", "name: a\n"],
    ["picture.png", new Uint8Array([0x89, 0x50, 0x4e, 0x47, 0xff, 0xfe])],
  ]);
});

test("a broken archive is refused, wherever it ends and whatever byte is wrong", () => {
  const packed = zip(FILES);
  for (let length = 0; length < packed.length; length += 7) {
    assert.notEqual(refusal(packed.subarray(0, length)), "", `${length} bytes`);
  }
  for (let at = 0; at < packed.length; at++) {
    // Whatever it says, it ends.
    refusal(changed(packed, view => view.setUint8(at, view.getUint8(at) ^ 0xff)));
  }
  assert.match(refusal(new TextEncoder().encode("no zip")), /not a zip archive/);
});

test("what is too large or outside of the folder is refused", () => {
  const packed = zip(FILES);
  const at = directoryOf(packed);
  assert.match(refusal(new Uint8Array(20_000_001)), /larger than 20 MB/);
  assert.match(refusal(changed(packed, view => view.setUint16(at + 10, 9, true))), /damaged/);
  // Fewer bytes than the directory says.
  assert.match(refusal(changed(packed, view => view.setUint32(at + 24, 100_000, true))), /damaged/);
  const many = Array.from({ length: 1001 }, (_, i): [string, string] => [`f${i}.nb`, ""]);
  assert.match(refusal(zip(many)), /more than 1000/);
  assert.match(refusal(zip([["large.nb", "a".repeat(1_000_001)]])), /large.nb is larger than 1 MB/);
  assert.match(refusal(zip([["../latch.nb", ""]])), /outside of its folder/);
  assert.match(refusal(zip([["/etc/latch.nb", ""]])), /outside of its folder/);
});
