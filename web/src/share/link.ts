// A program with its state as a part of an address, after `#`: a browser sends that part to no server. It is JSON,
// compressed, in the letters of base64url. Whatever is read from a link may be hostile: it is checked here.

import { decodeBase64Url, encodeBase64Url, pack, unpack } from "./packed";

export interface SharedProgram {
  /** The name of the file, without folders. */
  file: string;
  text: string;
  circuit: string | null;
  swarm: string | null;
  /** The bits of each input port, the most significant first. */
  inputs: Map<string, string>;
  tab: string | null;
}

export class LinkError extends Error {}

const MARK = "share=";
const FORMAT = 1;
/** The longest program, in letters, and the longest link: some programs cut longer addresses off. */
export const MOST_TEXT = 200_000;
export const MOST_LINK = 100_000;
/** The most bytes of the JSON: a few letters can stand for very many. */
const MOST_BYTES = 1_000_000;
const MOST_NAME = 200;
const MOST_PORTS = 1000;
const LONGEST_FILE = 80;

export async function encodeShare(shared: SharedProgram): Promise<string> {
  if (shared.text.length > MOST_TEXT) {
    throw new LinkError(`the program is too long for a link, which has room for ${MOST_TEXT} letters; send the file`);
  }
  const { file, text, circuit, swarm, inputs, tab } = shared;
  const json = JSON.stringify({ format: FORMAT, file, text, circuit, swarm, inputs: Object.fromEntries(inputs), tab });
  const code = MARK + encodeBase64Url(pack(new TextEncoder().encode(json)));
  if (code.length > MOST_LINK) {
    throw new LinkError(`the link would have ${code.length} letters, more than ${MOST_LINK}; send the file`);
  }
  return code;
}

/** Whether the part of an address from after `#` is a shared program. A path of a program ends with `.nb` or `.v`. */
export function isShare(fragment: string): boolean {
  return fragment.startsWith(MARK) && !fragment.includes(".");
}

/** Reads a link: a whole address, what is after its `#`, or with the `#`. */
export async function decodeShare(link: string): Promise<SharedProgram> {
  const text = link.trim();
  const at = text.lastIndexOf(MARK);
  if (at < 0) {
    throw new LinkError("this is not a link to a shared program: no part of it begins with `#share=`");
  }
  const code = text.slice(at + MARK.length);
  if (code.length > MOST_LINK) {
    throw new LinkError(`the link is too long: it has more than ${MOST_LINK} letters`);
  }
  return checked(await parsed(code));
}

async function parsed(code: string): Promise<unknown> {
  try {
    const json = unpack(decodeBase64Url(code), MOST_BYTES);
    if (json !== null) {
      return JSON.parse(new TextDecoder("utf-8", { fatal: true }).decode(json));
    }
  } catch {
    throw damaged();
  }
  throw new LinkError("the program in the link is too long");
}

function damaged(): LinkError {
  return new LinkError("the link is damaged: a part of it may be missing. Ask for it again");
}

function checked(value: unknown): SharedProgram {
  if (typeof value !== "object" || value === null || Array.isArray(value)) {
    throw damaged();
  }
  const given = value as Record<string, unknown>;
  if (typeof given["format"] === "number" && given["format"] > FORMAT) {
    throw new LinkError("the link was made by a newer nbc; update nbc to open it");
  }
  const { format, file, text, inputs } = given;
  if (format !== FORMAT || typeof file !== "string" || typeof text !== "string") {
    throw damaged();
  }
  if (text.length > MOST_TEXT) {
    throw new LinkError("the program in the link is too long");
  }
  return {
    file: safeName(file),
    text,
    circuit: nameOf(given["circuit"]),
    swarm: nameOf(given["swarm"]),
    inputs: inputsOf(inputs),
    tab: nameOf(given["tab"]),
  };
}

function nameOf(value: unknown): string | null {
  return typeof value === "string" && value.length <= MOST_NAME ? value : null;
}

function inputsOf(value: unknown): Map<string, string> {
  if (typeof value !== "object" || value === null) {
    return new Map();
  }
  const valid = Object.entries(value).filter(
    ([name, bits]) => name.length <= MOST_NAME && typeof bits === "string" && /^[01]{1,1024}$/.test(bits),
  );
  return new Map(valid.slice(0, MOST_PORTS) as [string, string][]);
}

/** The name of a file in the folder itself: no other folder, nothing hidden, no signs that a system may not know. */
export function safeName(file: string): string {
  const last = file.split(/[/\\]/).at(-1) ?? "";
  const [, stem, ending] = /^(.*?)(\.nb|\.s?v)?$/i.exec(last.slice(0, 4 * LONGEST_FILE)) ?? [];
  const plain = (stem ?? "").replace(/[^\p{L}\p{N}_-]+/gu, "_").replace(/^_+|_+$/g, "");
  return `${plain.slice(0, LONGEST_FILE) || "shared"}${(ending ?? ".nb").toLowerCase()}`;
}
