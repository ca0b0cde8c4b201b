// Unpacks the page of a file of its own, and starts it. The document's policy permits its script and style by their
// hashes.

import { inflateSync } from "fflate";

import { decodeBase64 } from "../share/packed";

interface PackedPage {
  style: string;
  script: string;
  worker: string;
}

function add(tag: "style" | "script", text: string, attributes: Record<string, string> = {}): void {
  const made = document.createElement(tag);
  Object.entries(attributes).forEach(([name, value]) => made.setAttribute(name, value));
  made.textContent = text;
  document.head.append(made);
}

const packed = decodeBase64(document.getElementById("page")?.textContent ?? "");
const { style, script, worker } = JSON.parse(new TextDecoder().decode(inflateSync(packed))) as PackedPage;
add("style", style);
add("script", worker, { type: "text/plain", id: "worker" });
add("script", script);
