// The language server at the end of a line. A lost one is replaced when the program is there again.

import { LSPClient, languageServerExtensions } from "@codemirror/lsp-client";

import type { Dial, Line } from "../line";
import { Observable } from "../observable";
import { quickFixes } from "./fixes";
import { sanitize } from "./sanitize";

/** For an answer, in milliseconds. A lost line ends all requests, so that a busy machine may take its time. */
const TIMEOUT = 120_000;

export class LanguageServer {
  readonly client = new Observable<LSPClient | null>(null);
  #line: Line | null = null;

  constructor(private readonly dial: Dial) {}

  connect(rootUri: string): void {
    this.#line?.close();
    const handlers = new Set<(message: string) => void>();
    const line: Line = this.dial({
      opened: () => {
        const client = new LSPClient({
          rootUri,
          timeout: TIMEOUT,
          extensions: [...languageServerExtensions(), quickFixes()],
          sanitizeHTML: sanitize,
        });
        const transport = {
          send: line.send,
          subscribe: (handler: (message: string) => void) => handlers.add(handler),
          unsubscribe: (handler: (message: string) => void) => handlers.delete(handler),
        };
        this.client.set(client.connect(transport));
      },
      received: data => handlers.forEach(handler => handler(data as string)),
      closed: () => {
        if (this.#line === line) {
          this.client.set(null);
        }
      },
    });
    this.#line = line;
  }
}
