// SPDX-License-Identifier: Apache-2.0
// Synthetic payloads of any size: decks with pipes, beams and boxes, and clashes between neighbours. The same
// sizes give the same bytes.
import { type Blocks, block, col } from './encode.ts';

export interface Sizes {
  objects: number;
  results: number;
  /** the model in the page; without it the table alone */
  scene?: boolean;
  /** objects that are boxes only, behind the others */
  boxes?: number;
  groups?: number;
  trend?: number;
  decisions?: boolean;
  drawings?: number;
  hostile?: boolean;
  /** ten kilometres from the origin */
  far?: boolean;
  /** objects without any size */
  points?: boolean;
  /** objects that were tested, though nothing was found */
  tested?: boolean;
}

const DIGITS = '0123456789abcdefghjkmnpqrstvwxyz';

/** Numbers that look random, the same in every run. */
export function seeded(seed: number): () => number {
  let state = seed >>> 0;
  return () => {
    state = (state + 0x6d2b79f5) >>> 0;
    let t = state;
    t = Math.imul(t ^ (t >>> 15), t | 1);
    t ^= t + Math.imul(t ^ (t >>> 7), t | 61);
    return ((t ^ (t >>> 14)) >>> 0) / 4294967296;
  };
}

export function key(number: number): string {
  let text = '';
  let x = number + 1;
  for (let i = 0; i < 25; ++i) {
    x = (Math.imul(x, 1664525) + 1013904223) >>> 0;
    text += DIGITS[(x >>> 11) & 31];
  }
  return DIGITS[number & 7]! + text;
}

export const HOSTILE = [
  '<img src=x onerror="document.title=\'owned\'">',
  '</script><script>document.title="owned"</script>',
  '=HYPERLINK("http://example.org")',
  'RIGHT\u202eLEFT\u0000\u0007',
  'long '.repeat(2000),
];

const KINDS = ['PIP', 'BEA', 'CAB', 'EQU'] as const;
const DISCIPLINES = ['PIPING', 'STRUCTURE', 'ELECTRICAL', 'EQUIPMENT'];

function box(): { vertices: number[]; index: number[] } {
  const vertices: number[] = [];
  for (let i = 0; i < 8; ++i) vertices.push(i & 1 ? 65535 : 0, i & 2 ? 65535 : 0, i & 4 ? 65535 : 0);
  const index = [0, 2, 1, 1, 2, 3, 4, 5, 6, 5, 7, 6, 0, 1, 4, 1, 5, 4, 2, 6, 3, 3, 6, 7, 0, 4, 2, 2, 4, 6, 1, 3, 5, 3, 7, 5];
  return { vertices, index };
}

function cylinder(sides: number): { vertices: number[]; index: number[] } {
  const vertices: number[] = [];
  const index: number[] = [];
  for (let i = 0; i < sides; ++i) {
    const t = (2 * Math.PI * i) / sides;
    const [x, y] = [(Math.cos(t) + 1) * 32767.5, (Math.sin(t) + 1) * 32767.5];
    vertices.push(Math.round(x), Math.round(y), 0, Math.round(x), Math.round(y), 65535);
    const [a, b, c, d] = [2 * i, 2 * ((i + 1) % sides), 2 * i + 1, 2 * ((i + 1) % sides) + 1];
    index.push(a, b, c, b, d, c);
    if (i > 0 && i < sides - 1) index.push(0, d - 1, a, 1, c, d);
  }
  return { vertices, index };
}

export interface Ship {
  head: Record<string, unknown>;
  blocks: Blocks;
  /** what the tests hold the page against */
  d: Float64Array;
  cls: Uint8Array;
  a: Uint32Array;
  b: Uint32Array;
  centre: Float64Array;
  /** the discipline of each object */
  kind: Uint8Array;
}

/** Makes the head and the blocks of a page. */
export function ship(sizes: Sizes): Ship {
  const random = seeded(7);
  const { objects, results } = sizes;
  const boxes = sizes.boxes ?? 0;
  const all = objects + boxes;
  const groups = sizes.groups ?? 0;
  const side = Math.max(1, Math.ceil(Math.cbrt(all)));
  const origin: [number, number, number] = sizes.far ? [1e7, -1e7, 12500] : [52000, -3000, 12500];
  const centre = new Float64Array(3 * all);
  const size = new Float64Array(3 * all);
  const kind = new Uint8Array(all);
  for (let i = 0; i < all; ++i) {
    kind[i] = Math.floor(random() * 4);
    const along = Math.floor(random() * 3);
    for (let k = 0; k < 3; ++k) {
      const place = k === 0 ? i % side : k === 1 ? Math.floor(i / side) % side : Math.floor(i / (side * side));
      centre[3 * i + k] = (place - side / 2) * 420 + random() * 60;
      const long = kind[i]! < 2 ? k === along : false;
      size[3 * i + k] = sizes.points ? 0 : long ? 500 : kind[i] === 0 ? 80 : 140 + random() * 160;
    }
  }

  const d = new Float64Array(results);
  const cls = new Uint8Array(results);
  const relation = new Uint8Array(results);
  const flags = new Uint8Array(results);
  const a = new Uint32Array(results);
  const b = new Uint32Array(results);
  const place = [0, 1, 2].map(() => new Float64Array(results));
  const other = [0, 1, 2].map(() => new Float64Array(results));
  const witness = new Uint8Array(results);
  const group = new Uint32Array(results).fill(4294967295);
  const status = new Uint8Array(results);
  const by = new Uint32Array(results);
  const comment = new Uint32Array(results);
  const regionCount = new Uint32Array(results).fill(1);
  const round = (v: number): number => Math.round(v * 1e3) / 1e3;
  for (let i = 0; i < results; ++i) {
    a[i] = i % objects;
    b[i] = (a[i]! + 1 + Math.floor(i / objects)) % objects;
    if (a[i] === b[i]) b[i] = (b[i]! + 1) % objects;
    const r = random();
    cls[i] = r < 0.04 ? 0 : r < 0.9 ? 1 : 2;
    d[i] = cls[i] === 0 ? -round(1 + random() * 160) : cls[i] === 1 ? 0 : round(1 + random() * 24);
    relation[i] = cls[i] === 0 ? (random() < 0.8 ? 3 : 4) : cls[i] === 1 ? 1 : 0;
    flags[i] = random() < 0.02 ? 2 : 0;
    witness[i] = cls[i] === 0 ? 1 : 0;
    for (let k = 0; k < 3; ++k) {
      const at = (centre[3 * a[i]! + k]! + centre[3 * b[i]! + k]!) / 2 + origin[k]!;
      place[k]![i] = round(at);
      other[k]![i] = cls[i] === 0 ? (k === 2 ? 1 : 0) : round(at + (k === 2 ? Math.abs(d[i]!) : 0));
    }
    if (groups > 0 && cls[i] !== 1) group[i] = i % groups;
    if (sizes.decisions) {
      status[i] = cls[i] === 1 ? 0 : Math.floor(random() * 4.5);
      if (status[i]! > 1) {
        by[i] = 1;
        comment[i] = 2;
      }
    }
  }

  const discipline = Uint16Array.from(kind);
  const name = (i: number): string => {
    if (sizes.hostile && i < HOSTILE.length) return HOSTILE[i]!;
    return `${KINDS[kind[i]!]}-B${String(i % 60).padStart(4, '0')}-L${String(i % 9).padStart(2, '0')}-${String(i).padStart(6, '0')}`;
  };
  const names = Array.from({ length: all }, (_, i) => name(i));
  const blocks: Blocks = new Map();
  blocks.set('strake-objects', block([
    col('id', 'text', names),
    col('name', 'text', names.map(() => '')),
    col('file', 'u32', names.map((_, i) => (i % 5 === 0 ? 1 : 0))),
    col('flags', 'u8', names.map(() => 2)),
    col('discipline', 'u16', discipline),
  ]));
  const counts = { HIT: 0, CONTACT: 0, CLEARANCE_VIOLATION: 0, ALLOWED: 0 };
  for (const c of cls) ++counts[(['HIT', 'CONTACT', 'CLEARANCE_VIOLATION'] as const)[c]!];
  if (results > 0) {
    blocks.set('strake-results', block([
      col('key', 'key', Array.from({ length: results }, (_, i) => key(i))),
      col('test', 'u16', new Uint16Array(results)),
      col('a', 'u32', a), col('b', 'u32', b), col('class', 'u8', cls), col('relation', 'u8', relation), col('flags', 'u8', flags),
      col('d', 'nm', d), col('d_low', 'nm', d.map((v) => v - 0.002)), col('d_high', 'nm', d.map((v) => v + 0.002)),
      col('x', 'nm', place[0]!), col('y', 'nm', place[1]!), col('z', 'nm', place[2]!),
      col('witness', 'u8', witness),
      col('p_x', 'nm', place[0]!), col('p_y', 'nm', place[1]!), col('p_z', 'nm', place[2]!),
      col('q_x', 'nm', other[0]!), col('q_y', 'nm', other[1]!), col('q_z', 'nm', other[2]!),
      col('group', 'u32', group),
      col('region_count', 'u32', regionCount),
      ...(sizes.decisions
        ? [
            col('status', 'u8', status), col('decided_by', 'u32', by), col('comment', 'u32', comment),
            col('texts', 'text', ['', 'K. Larsen', sizes.hostile ? HOSTILE[0]! : 'Move the pipe 200 mm aft; agreed in the meeting of Tuesday.']),
          ]
        : []),
    ]));
  }
  if (groups > 0) {
    const members = Array.from({ length: groups }, (): number[] => []);
    group.forEach((g, i) => g < groups && members[g]!.push(i));
    const count = (c: number): number[] => members.map((m) => m.filter((i) => cls[i] === c).length);
    const extent = (k: number, least: boolean): number[] =>
      members.map((m) => m.reduce((v, i) => (least ? Math.min(v, place[k]![i]!) : Math.max(v, place[k]![i]!)), least ? Infinity : -Infinity)).map((v) => (Number.isFinite(v) ? v : 0));
    const worst = members.map((m) => (m.some((i) => cls[i] === 0) ? 0 : 2));
    blocks.set('strake-groups', block([
      col('id', 'key', members.map((_, g) => key(g + 1000000))),
      col('name', 'text', members.map((_, g) => names[g % objects]!)),
      col('results', 'u32', members.map((m) => m.length)),
      col('hits', 'u32', count(0)), col('contacts', 'u32', count(1)), col('clearance_violations', 'u32', count(2)),
      col('class', 'u8', worst),
      col('d', 'nm', members.map((m, g) => m.filter((i) => cls[i] === worst[g]).reduce((v, i) => Math.min(v, d[i]!), Infinity)).map((v) => (Number.isFinite(v) ? v : 0))),
      col('min_x', 'nm', extent(0, true)), col('min_y', 'nm', extent(1, true)), col('min_z', 'nm', extent(2, true)),
      col('max_x', 'nm', extent(0, false)), col('max_y', 'nm', extent(1, false)), col('max_z', 'nm', extent(2, false)),
    ]));
  }

  let scene: object | undefined;
  if (sizes.scene) {
    const shapes = [box(), cylinder(24)];
    const matrix = new Float32Array(12 * objects);
    const half = (side / 2 + 1) * 420;
    let triangles = 0;
    const shapeOf = Uint32Array.from({ length: objects }, (_, i) => (kind[i] === 0 ? 1 : 0));
    for (let i = 0; i < objects; ++i) {
      // A cylinder stands along the longest side of its object.
      const s = [0, 1, 2].map((k) => size[3 * i + k]!);
      const long = s.indexOf(Math.max(...s));
      const axes = shapeOf[i] === 1 ? [(long + 1) % 3, (long + 2) % 3, long] : [0, 1, 2];
      axes.forEach((axis, column) => (matrix[12 * i + 4 * axis + column] = s[axis]!));
      for (let k = 0; k < 3; ++k) matrix[12 * i + 4 * k + 3] = centre[3 * i + k]!;
      triangles += shapes[shapeOf[i]!]!.index.length / 3;
    }
    const palette = [0x4f7f5a, 0x8a8f98, 0x9a7b4f, 0x6f83a8];
    blocks.set('strake-shapes', block([
      col('vertices', 'u32', shapes.map((s) => s.vertices.length / 3)),
      col('triangles', 'u32', shapes.map((s) => s.index.length / 3)),
      ...['x', 'y', 'z'].map((l) => col(`min_${l}`, 'f32', shapes.map(() => -0.5))),
      col('step', 'f32', shapes.map(() => 1 / 65535)),
      col('position', 'u16', shapes.flatMap((s) => s.vertices)),
      col('index', 'u16', shapes.flatMap((s) => s.index)),
    ]));
    blocks.set('strake-instances', block([
      col('shape', 'u32', shapeOf),
      col('object', 'u32', Uint32Array.from({ length: objects }, (_, i) => i)),
      col('matrix', 'f32', matrix),
      col('colour', 'u32', Uint32Array.from({ length: objects }, (_, i) => palette[kind[i]!]!)),
    ]));
    const step = (2 * half) / 65535;
    if (boxes > 0) {
      const corners = new Uint16Array(6 * boxes);
      for (let i = 0; i < boxes; ++i) {
        for (let k = 0; k < 3; ++k) {
          const at = centre[3 * (objects + i) + k]!;
          const reach = size[3 * (objects + i) + k]! / 2;
          corners[6 * i + k] = Math.max(0, Math.floor((at - reach + half) / step));
          corners[6 * i + 3 + k] = Math.min(65535, Math.ceil((at + reach + half) / step));
        }
      }
      blocks.set('strake-boxes', block([col('object', 'u32', Uint32Array.from({ length: boxes }, (_, i) => objects + i)), col('box', 'u16', corners)]));
    }
    scene = {
      origin_mm: origin,
      box_mm: [origin.map((o) => o - half), origin.map((o) => o + half)],
      objects: all, objects_as_shapes: objects, objects_as_boxes: boxes, objects_left_out: 0, triangles,
      ...(boxes > 0 ? { boxes: { min: [-half, -half, -half], step }, note: 'Only what is near a clash is shown as it is; the rest are boxes.' } : {}),
    };
  }

  const drawings = Array.from({ length: sizes.drawings ?? 0 }, (_, i) => ({ title: ['Top 1:100', 'Front 1:100', 'Side 1:100'][i % 3]!, objects: Math.min(objects, 400) }));
  drawings.forEach((_, n) => blocks.set(`strake-drawing-${n}`, new TextEncoder().encode(drawing(names, centre, size, side, n, Math.min(objects, 400)))));

  const matrixCounts = (x: number, y: number): Record<string, number> => {
    const c = { HIT: 0, CONTACT: 0, CLEARANCE_VIOLATION: 0, ALLOWED: 0 };
    for (let i = 0; i < results; ++i) {
      const [p, q] = [kind[a[i]!]!, kind[b[i]!]!];
      if ((p === x && q === y) || (p === y && q === x)) ++c[(['HIT', 'CONTACT', 'CLEARANCE_VIOLATION'] as const)[cls[i]!]!];
    }
    return c;
  };
  const settings = { clearance_mm: 25, touch_gap_mm: 1, touch_overlap_mm: 1, thickness_cap: true, contact_distance_mm: 0.003, curves: false };
  const clash = {
    schema_version: 2,
    files: [
      { label: 'hull.rvm', format: 'RVM', unit: 'mm (stated)' },
      { label: 'machinery.glb', format: 'GLB', unit: 'm (stated)', ends_early: true },
    ],
    tests: [{
      name: sizes.hostile ? HOSTILE[0]! : 'Ship, all against all', settings, sets: { a: '*', b: '*' }, objects: { a: all, b: all }, counts,
      exempted: [{ rule: 'insulation against itself', pairs: 12 }],
      allowed: [],
      matrix: {
        disciplines: DISCIPLINES.map((n, k) => ({ name: n, objects: kind.reduce((c, v) => c + (v === k ? 1 : 0), 0) })),
        cells: DISCIPLINES.flatMap((n, x) => DISCIPLINES.slice(x).map((m, dy) => ({ a: n, b: m, checked: true, settings, counts: matrixCounts(x, x + dy) }))),
      },
      hash: 'd15aec3b93c03f2cbd0b36e6a1b4ff54',
    }],
    hash: '58ba5f481c90deef56e051916158b79e',
    diagnostics: [{ code: 'mesh-inverted', severity: 'warning', count: 2 }, { code: 'unknown-sag', severity: 'note', count: 1 }],
    messages: [
      { code: 'mesh-inverted', severity: 'warning', where: 'hull.rvm: CRT-B0005', message: 'a solid had its faces pointing inwards; they were flipped' },
      { code: 'unknown-sag', severity: 'note', where: 'machinery.glb', message: 'meshes are used as they are; their deviation from the original surfaces is unknown' },
    ],
    not_compared: [{ test: 0, code: 'object-incomplete', a: { id: names[0]!, name: names[0]!, file: 'hull.rvm' } }],
    ...(groups > 0 ? { groups: { by: 'element' } } : {}),
    ...(sizes.decisions
      ? {
          decisions: {
            file: 'decided.csv', deeper_mm: 1,
            counts: Object.fromEntries(['new', 'active', 'reviewed', 'approved', 'resolved'].map((n, s) => [n, status.reduce((c, v) => c + (v === s ? 1 : 0), 0)])),
            reopened: { severer: 0, deeper: 1, more_places: 0, found_again: 0 },
            not_found: [],
          },
        }
      : {}),
  };
  const trend = Array.from({ length: sizes.trend ?? 0 }, (_, i) => {
    const share = 1 + ((sizes.trend ?? 0) - 1 - i) * 0.08;
    return {
      run: i + 1, started: `2026-11-${String(i + 1).padStart(2, '0')}T22:00:00Z`, test: 'Ship, all against all',
      hit: Math.round(counts.HIT * share), contact: Math.round(counts.CONTACT * (1 + (i % 3) * 0.01)), clearance_violation: Math.round(counts.CLEARANCE_VIOLATION * share),
      allowed: 0, appeared: i % 4, gone: (i * 3) % 7, new: i % 4, active: Math.round(counts.HIT * share), reviewed: i, approved: 2 * i, resolved: 3 * i, cannot_tell: i % 2,
    };
  });
  const head = {
    format: 'strake-page', version: 1, title: sizes.hostile ? HOSTILE[1]! : 'Ship section 12', program: 'Strake 0.1.0', made: '2026-11-28T12:00:00Z',
    counts: { results, groups, objects: all },
    ...(results > 0 || sizes.tested ? { clash } : {}),
    files: ['hull.rvm', 'machinery.glb'], disciplines: DISCIPLINES, rules: [], columns: [],
    ...(trend.length > 0 ? { trend } : {}),
    ...(scene ? { scene } : {}),
    drawings,
  };
  return { head, blocks, d, cls, a, b, centre, kind };
}

function escape(text: string): string {
  // XML has no control characters; the program writes U+FFFD for them.
  return text.replace(/\p{Cc}/gu, '\ufffd').replaceAll('&', '&amp;').replaceAll('<', '&lt;').replaceAll('"', '&quot;');
}

function drawing(names: readonly string[], centre: Float64Array, size: Float64Array, side: number, view: number, most: number): string {
  const [u, v] = [[0, 1], [0, 2], [1, 2]][view % 3] as [number, number];
  const scale = 250 / (side * 420);
  const layer = (label: string, cls: string, inset: number): string => {
    let out = `<g inkscape:groupmode="layer" inkscape:label="${label}" id="${cls.replace(' ', '-')}-${view}" class="${cls}">\n`;
    for (let i = 0; i < most; ++i) {
      const at = (k: number, end: number): string => (((centre[3 * i + k]! + (end * size[3 * i + k]!) / 2) * (k === v ? -1 : 1) * scale) + (k === v ? 148 : 210) + inset).toFixed(3);
      const id = escape(names[i]!);
      out += `<g data-id="${id}" data-name="${id}" data-file="${i % 5 === 0 ? 'machinery.glb' : 'hull.rvm'}"><path d="M${at(u, -1)} ${at(v, -1)}L${at(u, 1)} ${at(v, -1)} ${at(u, 1)} ${at(v, 1)} ${at(u, -1)} ${at(v, 1)}Z"/></g>\n`;
    }
    return `${out}</g>\n`;
  };
  return `<?xml version="1.0" encoding="UTF-8"?>
<svg xmlns="http://www.w3.org/2000/svg" xmlns:inkscape="http://www.inkscape.org/namespaces/inkscape" width="420mm" height="297mm" viewBox="0 0 420 297">
<title>view ${view}</title>
<style>path { stroke: red; }</style>
<rect class="sheet" width="420" height="297"/>
<g class="view" id="view" data-view="top" data-scale="1:100" onclick="document.title='owned'">
${layer('Hidden sharp', 'hidden sharp', 0.6)}${layer('Visible sharp', 'visible sharp', 0)}</g>
<script>document.title='owned'</script>
</svg>
`;
}
