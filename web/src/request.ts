// What a page can request, by verb, and the error of a request that is refused.

import type { Finding, Nothing, Request, ServerMessage } from "./protocol";

export type Verb = Request["do"];
export type Fields<V extends Verb> = Omit<Extract<Request, { do: V }>, "id" | "do">;
export type Result<V extends Verb> = [Extract<ServerMessage, { to: V }>] extends [{ ok: infer R }] ? R : Nothing;

export class RequestError extends Error {
  constructor(
    message: string,
    readonly code: string | null,
    readonly help: string | null,
    readonly diagnostics: Finding[],
    /** The path that could be saved at instead. */
    readonly instead: string | null = null,
  ) {
    super(message);
  }
}
