// What a page can request, by verb, and the error of a request that is refused.

import type { Finding, Nothing, Refusal, Request, ServerMessage } from "./protocol";

export type Verb = Request["do"];
export type Fields<V extends Verb> = Omit<Extract<Request, { do: V }>, "id" | "do">;
export type Result<V extends Verb> = [Extract<ServerMessage, { to: V }>] extends [{ ok: infer R }] ? R : Nothing;

export class RequestError extends Error {
  readonly code: string | null;
  readonly help: string | null;
  /** The path that could be saved at instead. */
  readonly instead: string | null;
  readonly diagnostics: Finding[];

  constructor({ message, code, help, instead, diagnostics }: Partial<Refusal>) {
    super(message);
    this.code = code ?? null;
    this.help = help ?? null;
    this.instead = instead ?? null;
    this.diagnostics = diagnostics ?? [];
  }

  /** The message with its help. */
  get words(): string {
    return this.help === null ? this.message : `${this.message}; ${this.help}`;
  }
}
