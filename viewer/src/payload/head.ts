// SPDX-License-Identifier: Apache-2.0
import { PayloadError } from './errors.ts';

/** The parts of the clash document that the page shows (schemas/clash.schema.json). */
export interface Counts {
  HIT: number;
  CONTACT: number;
  CLEARANCE_VIOLATION: number;
  ALLOWED: number;
}

export interface Tolerances {
  clearance_mm: number;
  touch_gap_mm: number;
  touch_overlap_mm: number;
  thickness_cap: boolean;
  clearance_attribute?: string;
}

export interface MatrixCell {
  a: string;
  b: string;
  checked: boolean;
  settings?: Tolerances;
  counts?: Counts;
}

export interface TestSummary {
  name: string;
  settings: Tolerances & { contact_distance_mm: number };
  sets: { a: string; b: string };
  objects: { a: number; b: number };
  counts: Counts;
  unlisted?: { CONTACT: number; ALLOWED: number };
  not_reported?: { by: string; counts: Counts }[];
  exempted: { rule: string; pairs: number }[];
  allowed: { rule: string; candidates: number; pairs: number; places?: number }[];
  matrix?: { disciplines: { name: string; objects: number }[]; cells: MatrixCell[] };
  hash: string;
}

export interface Named {
  id: string;
  name: string;
  file: string;
}

export interface ClashDocument {
  files: { label: string; format: string; unit: string; ends_early?: true }[];
  classes?: string[];
  rules?: { file: string; hash: string; profile?: string };
  tests: TestSummary[];
  hash: string;
  diagnostics: { code: string; severity: string; count: number }[];
  messages: { code: string; severity: string; where: string; message: string }[];
  not_compared?: { test: number; code: string; a: Named; b?: Named }[];
  exempted?: { test: number; rule: string; a: Named; b: Named }[];
  decisions?: {
    file: string;
    deeper_mm: number;
    counts: Record<string, number>;
    reopened: Record<string, number>;
    not_found: { key: string; status: string; by?: string; date?: string; comment?: string }[];
  };
  groups?: { by: string; distance_mm?: number };
}

export interface TrendRun {
  run: number;
  started: string;
  test: string;
  hit: number;
  contact: number;
  clearance_violation: number;
  allowed: number;
  appeared: number;
  gone: number;
  new: number;
  active: number;
  reviewed: number;
  approved: number;
  resolved: number;
  cannot_tell: number;
}

export type Point = [number, number, number];

export interface SceneHead {
  origin_mm: Point;
  box_mm: [Point, Point];
  objects: number;
  objects_as_shapes: number;
  objects_as_boxes: number;
  objects_left_out: number;
  triangles: number;
  boxes?: { min: Point; step: number };
  note?: string;
}

export interface Head {
  format: 'strake-page';
  version: 1;
  title: string;
  program: string;
  made?: string;
  counts: { results: number; groups: number; objects: number };
  blocks: { id: string; bytes: number }[];
  clash?: ClashDocument;
  files: string[];
  disciplines: string[];
  rules: string[];
  columns: string[];
  trend?: TrendRun[];
  scene?: SceneHead;
  /** why there is no scene, and what to do about it */
  no_model?: { why: string; remedy?: string };
  drawings: { title: string; objects: number }[];
  /** of a page that is served: what of the project it shows, and who decides in it */
  served?: { run: number; event: number; by: string };
}

type Shape = 'text' | 'number' | 'count' | 'boolean' | 'point' | { list: Shape } | { members: Record<string, Shape>; may?: Record<string, Shape> };

const counts: Shape = { members: { HIT: 'count', CONTACT: 'count', CLEARANCE_VIOLATION: 'count', ALLOWED: 'count' } };
const tolerances: Record<string, Shape> = { clearance_mm: 'number', touch_gap_mm: 'number', touch_overlap_mm: 'number', thickness_cap: 'boolean' };
const named: Shape = { members: { id: 'text', name: 'text', file: 'text' } };
const texts: Shape = { list: 'text' };

const test: Shape = {
  members: {
    name: 'text',
    settings: { members: { ...tolerances, contact_distance_mm: 'number' } },
    sets: { members: { a: 'text', b: 'text' } },
    objects: { members: { a: 'count', b: 'count' } },
    counts,
    exempted: { list: { members: { rule: 'text', pairs: 'count' } } },
    allowed: { list: { members: { rule: 'text', candidates: 'count', pairs: 'count' } } },
    hash: 'text',
  },
  may: {
    unlisted: { members: { CONTACT: 'count', ALLOWED: 'count' } },
    not_reported: { list: { members: { by: 'text', counts } } },
    matrix: {
      members: {
        disciplines: { list: { members: { name: 'text', objects: 'count' } } },
        cells: { list: { members: { a: 'text', b: 'text', checked: 'boolean' }, may: { settings: { members: tolerances }, counts } } },
      },
    },
  },
};

const statuses: Record<string, Shape> = { new: 'count', active: 'count', reviewed: 'count', approved: 'count', resolved: 'count' };

const clash: Shape = {
  members: {
    files: { list: { members: { label: 'text', format: 'text', unit: 'text' } } },
    tests: { list: test },
    hash: 'text',
    diagnostics: { list: { members: { code: 'text', severity: 'text', count: 'count' } } },
    messages: { list: { members: { code: 'text', severity: 'text', where: 'text', message: 'text' } } },
  },
  may: {
    classes: texts,
    rules: { members: { file: 'text', hash: 'text' }, may: { profile: 'text' } },
    not_compared: { list: { members: { test: 'count', code: 'text', a: named }, may: { b: named } } },
    exempted: { list: { members: { test: 'count', rule: 'text', a: named, b: named } } },
    decisions: {
      members: {
        file: 'text',
        deeper_mm: 'number',
        counts: { members: statuses },
        reopened: { members: {} },
        not_found: { list: { members: { key: 'text', status: 'text' }, may: { by: 'text', date: 'text', comment: 'text' } } },
      },
    },
    groups: { members: { by: 'text' }, may: { distance_mm: 'number' } },
  },
};

const head: Shape = {
  members: {
    title: 'text',
    program: 'text',
    counts: { members: { results: 'count', groups: 'count', objects: 'count' } },
    blocks: { list: { members: { id: 'text', bytes: 'count' } } },
    files: texts,
    disciplines: texts,
    rules: texts,
    columns: texts,
    drawings: { list: { members: { title: 'text', objects: 'count' } } },
  },
  may: {
    made: 'text',
    served: { members: { run: 'count', event: 'count', by: 'text' } },
    clash,
    trend: {
      list: {
        members: {
          run: 'count', started: 'text', test: 'text', hit: 'count', contact: 'count', clearance_violation: 'count',
          allowed: 'count', appeared: 'count', gone: 'count', cannot_tell: 'count', ...statuses,
        },
      },
    },
    scene: {
      members: {
        origin_mm: 'point',
        box_mm: { list: 'point' },
        objects: 'count', objects_as_shapes: 'count', objects_as_boxes: 'count', objects_left_out: 'count', triangles: 'count',
      },
      may: { boxes: { members: { min: 'point', step: 'number' } }, note: 'text' },
    },
    no_model: { members: { why: 'text' }, may: { remedy: 'text' } },
  },
};

/** Where a value is not of a shape, or undefined. */
function fault(value: unknown, shape: Shape, at: string): string | undefined {
  if (shape === 'text') return typeof value === 'string' ? undefined : at;
  if (shape === 'boolean') return typeof value === 'boolean' ? undefined : at;
  if (shape === 'number') return typeof value === 'number' ? undefined : at;
  if (shape === 'count') return Number.isSafeInteger(value) && (value as number) >= 0 ? undefined : at;
  if (shape === 'point') {
    return Array.isArray(value) && value.length === 3 && value.every((v) => typeof v === 'number') ? undefined : at;
  }
  if ('list' in shape) {
    if (!Array.isArray(value)) return at;
    for (let i = 0; i < value.length; ++i) {
      const found = fault(value[i], shape.list, `${at}[${i}]`);
      if (found) return found;
    }
    return undefined;
  }
  if (typeof value !== 'object' || value === null || Array.isArray(value)) return at;
  const members = value as Record<string, unknown>;
  for (const [name, inner] of Object.entries(shape.members)) {
    const found = fault(members[name], inner, `${at}.${name}`);
    if (found) return found;
  }
  for (const [name, inner] of Object.entries(shape.may ?? {})) {
    if (members[name] === undefined) continue;
    const found = fault(members[name], inner, `${at}.${name}`);
    if (found) return found;
  }
  return undefined;
}

export const HEAD_ID = 'strake-head';

/** Reads the head. Throws PayloadError. */
export function decodeHead(bytes: Uint8Array): Head {
  let value: unknown;
  try {
    value = JSON.parse(new TextDecoder('utf-8', { fatal: true }).decode(bytes));
  } catch {
    throw new PayloadError(HEAD_ID, 'it is no JSON');
  }
  const { format, version } = (value ?? {}) as { format?: unknown; version?: unknown };
  if (format !== 'strake-page') throw new PayloadError(HEAD_ID, 'it is not the head of such a page');
  if (version !== 1) throw new PayloadError(HEAD_ID, `it is of version ${String(version)}, and this page reads version 1`);
  const found = fault(value, head, 'head');
  if (found) throw new PayloadError(HEAD_ID, `${found} is missing or is not what it should be`);
  const read = value as Head;
  if (read.scene && read.scene.box_mm.length !== 2) throw new PayloadError(HEAD_ID, 'head.scene.box_mm is not two corners');
  return read;
}
