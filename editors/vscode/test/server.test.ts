// The real server, by the protocol library that is in the bundle.

import assert from "node:assert/strict";
import { spawn } from "node:child_process";
import { readFileSync } from "node:fs";
import * as path from "node:path";
import { test } from "node:test";
import { pathToFileURL } from "node:url";

import {
  createProtocolConnection,
  DidOpenTextDocumentNotification,
  ExitNotification,
  HoverRequest,
  InitializedNotification,
  InitializeRequest,
  PublishDiagnosticsNotification,
  type PublishDiagnosticsParams,
  ShutdownRequest,
  StreamMessageReader,
  StreamMessageWriter,
} from "vscode-languageserver-protocol/node";

import { NBC, ROOT } from "./nbc";

test("the server checks a text and answers", async () => {
  const child = spawn(NBC, ["lsp"], { stdio: ["pipe", "pipe", "ignore"] });
  const connection = createProtocolConnection(
    new StreamMessageReader(child.stdout),
    new StreamMessageWriter(child.stdin),
  );
  const published = new Map<string, (params: PublishDiagnosticsParams) => void>();
  connection.onNotification(PublishDiagnosticsNotification.type, params => published.get(params.uri)?.(params));
  connection.listen();
  const options = { codeLenses: true, pictures: false, inlayHints: { widths: true, parameters: true, robots: true } };
  const initialized = await connection.sendRequest(InitializeRequest.type, {
    processId: process.pid,
    rootUri: null,
    capabilities: {},
    initializationOptions: options,
  });
  assert.equal(initialized.serverInfo?.name, "nbc");
  await connection.sendNotification(InitializedNotification.type, {});

  const uri = pathToFileURL(path.join(ROOT, "circuits/latch.nb")).href;
  const text = readFileSync(path.join(ROOT, "circuits/latch.nb"), "utf8").replace("nand(not d, e)", "nand(not dd, e)");
  const diagnostics = new Promise<PublishDiagnosticsParams>(resolve => published.set(uri, resolve));
  const document = { uri, languageId: "nb", version: 1, text };
  await connection.sendNotification(DidOpenTextDocumentNotification.type, { textDocument: document });
  const [fault] = (await diagnostics).diagnostics;
  assert.equal(String(fault!.message).split("\n")[0], "no net is called `dd`");
  const hover = await connection.sendRequest(HoverRequest.type, {
    textDocument: { uri },
    position: fault!.range.start,
  });
  assert.ok(hover === null || typeof hover.contents === "object");

  await connection.sendRequest(ShutdownRequest.type);
  await connection.sendNotification(ExitNotification.type);
  assert.equal(await new Promise(resolve => child.on("close", resolve)), 0);
  connection.dispose();
});
