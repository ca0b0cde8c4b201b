// The language server behind a socket. A lost one is replaced when the program is there again.

import { LSPClient, languageServerExtensions, type Transport } from "@codemirror/lsp-client";

import { Observable } from "../observable";
import { quickFixes } from "./fixes";
import { sanitize } from "./sanitize";

const TIMEOUT = 10_000;

export class LanguageServer {
  /** The client of the present connection. */
  readonly client = new Observable<LSPClient | null>(null);
  #socket: WebSocket | null = null;

  constructor(private readonly address: URL) {}

  connect(rootUri: string): void {
    this.#socket?.close();
    const socket = new WebSocket(this.address);
    this.#socket = socket;
    socket.onopen = () => {
      const client = new LSPClient({
        rootUri,
        timeout: TIMEOUT,
        extensions: [...languageServerExtensions(), quickFixes()],
        sanitizeHTML: sanitize,
      });
      this.client.set(client.connect(transportOver(socket)));
    };
    socket.onclose = () => {
      if (this.#socket === socket) {
        this.client.set(null);
      }
    };
  }
}

function transportOver(socket: WebSocket): Transport {
  const handlers = new Set<(message: string) => void>();
  socket.onmessage = message => handlers.forEach(handler => handler(message.data as string));
  return {
    send: message => {
      if (socket.readyState === WebSocket.OPEN) {
        socket.send(message);
      }
    },
    subscribe: handler => handlers.add(handler),
    unsubscribe: handler => handlers.delete(handler),
  };
}
