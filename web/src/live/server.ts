// What a swarm needs of a server: requests, frames and events. The page of `nbc play` has a connection to a program,
// an exported page has a small engine of its own.

import type { Observable } from "../observable";
import type { PlayEvent } from "../protocol";
import type { Fields, Result, Verb } from "../request";

export interface SwarmServer {
  /** Receives each frame. */
  onframe: (buffer: ArrayBuffer) => void;
  readonly events: Observable<PlayEvent | null>;
  request<V extends Verb>(verb: V, fields: Fields<V>): Promise<Result<V>>;
  /** Sends what has no answer worth waiting for. */
  tell<V extends Verb>(verb: V, fields: Fields<V>): void;
}
