// A way to the program: texts go both ways, and frames of the swarm come.

import { Observable } from "./observable";
import type { Contents, KeptFiles } from "./tab/files";

export interface Line {
  send: (text: string) => void;
  close: () => void;
}

export interface LineEvents {
  opened: () => void;
  received: (data: string | ArrayBuffer) => void;
  /** The line is lost, or was never opened. It is of no use any more. */
  closed: () => void;
}

export type Dial = (events: LineEvents) => Line;

export interface BrowserFolder {
  files: () => KeptFiles;
  insert: (path: string, contents: Contents) => void;
  remove: (path: string) => void;
}

export interface Ways {
  live: Dial;
  language: Dial;
  /** The address of a file that an answer names. */
  file: (address: string) => string;
  prepare: () => Promise<void>;
  /** What the page waits for, or what is unusual about its program; empty for nothing. */
  status: Observable<string>;
  /** The folder, if it is in the browser. */
  folder: BrowserFolder | null;
  /** Whether the address of the page has no secret in it. */
  isPublic: boolean;
}

export const SERVER: Ways = {
  live: events => socket("live", events),
  language: events => socket("language", events),
  file: address => new URL(address, document.baseURI).href,
  prepare: () => Promise.resolve(),
  status: new Observable(""),
  folder: null,
  isPublic: false,
};

function socket(name: string, events: LineEvents): Line {
  const address = new URL(name, document.baseURI);
  address.protocol = address.protocol === "https:" ? "wss:" : "ws:";
  const socket = new WebSocket(address);
  socket.binaryType = "arraybuffer";
  socket.onopen = events.opened;
  socket.onmessage = message => events.received(message.data as string | ArrayBuffer);
  socket.onclose = events.closed;
  return {
    send: text => {
      if (socket.readyState === WebSocket.OPEN) {
        socket.send(text);
      }
    },
    close: () => socket.close(),
  };
}
