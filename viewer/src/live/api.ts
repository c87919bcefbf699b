// SPDX-License-Identifier: Apache-2.0
// What a page that 'strake view' serves asks its server (docs/view.md): what changed, and that something be decided.
import { STATUSES } from '../payload/payload.ts';

/** A clash as the project has it now. */
export interface ClashState {
  key: string;
  /** number into STATUSES */
  status: number;
  by: string;
  on: string;
  assignee: string;
  comment: string;
}

export interface ProjectState {
  run: number;
  event: number;
  /** more changed than is told */
  tooMany: boolean;
  clashes: ClashState[];
  refused: { key: string; why: string }[];
}

/** What is decided; what is absent stays as it is, an empty text takes back what was there. */
export interface Decision {
  status?: string;
  assignee?: string;
  comment?: string;
}

/** Why nothing came of a question: the server is not there, does not know this page, or says no. */
export class ApiError extends Error {
  constructor(
    readonly kind: 'silent' | 'unknown' | 'refused',
    message: string,
  ) {
    super(message);
    this.name = 'ApiError';
  }
}

const TOKEN = 'strake-token';
const LONGEST_MS = 60_000;

/** Takes the token out of the address, where it would be seen and copied, and keeps it for this tab. */
export function takeToken(): string | undefined {
  const url = new URL(location.href);
  const given = url.searchParams.get('token');
  try {
    if (given === null) return sessionStorage.getItem(TOKEN) ?? undefined;
    sessionStorage.setItem(TOKEN, given);
  } catch {
    // A browser that lets pages keep nothing: then the address keeps it, and opens the page again.
    return given ?? undefined;
  }
  url.searchParams.delete('token');
  history.replaceState(null, '', url.pathname + url.search + url.hash);
  return given;
}

function bad(): never {
  throw new ApiError('silent', 'What answers at this address is no ‘strake view’.');
}

function text(value: unknown): string {
  return typeof value === 'string' ? value : bad();
}

function number(value: unknown): number {
  return Number.isSafeInteger(value) ? (value as number) : bad();
}

function list(value: unknown): Record<string, unknown>[] {
  return Array.isArray(value) && value.every((v) => typeof v === 'object' && v !== null) ? value : bad();
}

/** Reads an answer strictly. */
export function decodeState(value: unknown): ProjectState {
  if (typeof value !== 'object' || value === null) return bad();
  const { run, event, too_many, clashes, refused } = value as Record<string, unknown>;
  return {
    run: number(run),
    event: number(event),
    tooMany: too_many === true,
    clashes: list(clashes).map((c) => {
      const status = (STATUSES as readonly string[]).indexOf(text(c.status));
      return status < 0 ? bad() : { key: text(c.key), status, by: text(c.by), on: text(c.on), assignee: text(c.assignee), comment: text(c.comment) };
    }),
    refused: refused === undefined ? [] : list(refused).map((r) => ({ key: text(r.key), why: text(r.why) })),
  };
}

export class Api {
  constructor(private readonly token: string) {}

  /** What changed after an event. Throws ApiError. */
  async state(event: number): Promise<ProjectState> {
    return this.request(`/api/state?event=${event}`, {});
  }

  /** Decides about the clashes that are as they were seen. Throws ApiError. */
  async decide(known: { run: number; event: number }, keys: string[], decision: Decision): Promise<ProjectState> {
    return this.request('/api/decide', { method: 'POST', headers: { 'Content-Type': 'application/json' }, body: JSON.stringify({ ...known, keys, ...decision }) });
  }

  private async request(path: string, options: RequestInit): Promise<ProjectState> {
    let answer: Response;
    let body: unknown;
    try {
      answer = await fetch(path, { ...options, headers: { ...options.headers, 'Strake-Token': this.token }, credentials: 'omit', redirect: 'error', cache: 'no-store', signal: AbortSignal.timeout(LONGEST_MS) });
      if (answer.status === 403) throw new ApiError('unknown', 'The server does not know this page.');
      body = await answer.json();
    } catch (error) {
      if (error instanceof ApiError) throw error;
      throw new ApiError('silent', '‘strake view’ does not answer.');
    }
    if (answer.ok || answer.status === 409) return decodeState(body);
    const { error, mend } = (body ?? {}) as { error?: unknown; mend?: unknown };
    const why = typeof error === 'string' ? error : `The server says ${answer.status}.`;
    throw new ApiError('refused', typeof mend === 'string' && mend !== '' ? `${why} (${mend})` : why);
  }
}
