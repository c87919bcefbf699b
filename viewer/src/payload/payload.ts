// SPDX-License-Identifier: Apache-2.0
// What the payload of a page says (docs/formats/page.md), read strictly: what is damaged is told and not guessed.
import { Block, type KeyColumn, type TextColumn } from './columns.ts';
import { PayloadError } from './errors.ts';
import type { Head } from './head.ts';

export const CLASSES = ['HIT', 'CONTACT', 'CLEARANCE_VIOLATION'] as const;
export const RELATIONS = ['SEPARATE', 'ABUT_OUTSIDE', 'ABUT_INSIDE', 'INTERFERE', 'A_IN_B', 'B_IN_A', 'DUPLICATE', 'CROSS'] as const;
export const FLAGS = ['BORDERLINE', 'UNCERTAIN', 'OPEN', 'INVERTED'] as const;
export const DEPTH_INCOMPLETE = 16;
export const LEVELS = ['', 'hard', 'soft', 'insulation'] as const;
export const STATUSES = ['new', 'active', 'reviewed', 'approved', 'resolved'] as const;
export const REOPENED = ['', 'severer', 'deeper', 'more places', 'found again'] as const;
export const NONE8 = 255;
export const NONE16 = 65535;
export const NONE32 = 4294967295;

export interface Objects {
  count: number;
  id: TextColumn;
  names: TextColumn;
  file: Uint32Array;
  flags: Uint8Array;
  discipline: Uint16Array | undefined;
  attributes: (Uint32Array | undefined)[];
  texts: TextColumn | undefined;
}

export interface Results {
  count: number;
  key: KeyColumn;
  test: Uint16Array;
  a: Uint32Array;
  b: Uint32Array;
  class: Uint8Array;
  relation: Uint8Array;
  flags: Uint8Array;
  d: Float64Array;
  d_low: Float64Array;
  d_high: Float64Array;
  x: Float64Array;
  y: Float64Array;
  z: Float64Array;
  part_a: Uint32Array | undefined;
  part_b: Uint32Array | undefined;
  witness: Witness | undefined;
  group: Uint32Array | undefined;
  allowed: Uint16Array | undefined;
  may_be: Uint8Array | undefined;
  level_a: Uint8Array | undefined;
  level_b: Uint8Array | undefined;
  discipline_a: Uint16Array | undefined;
  discipline_b: Uint16Array | undefined;
  clearance: Float64Array | undefined;
  region_count: Uint32Array | undefined;
  allowed_region_count: Uint32Array | undefined;
  /** mm³; NaN: absent, less than 0: null */
  volume: Float64Array | undefined;
  status: Uint8Array | undefined;
  reopened: Uint8Array | undefined;
  decided_by: Uint32Array | undefined;
  decided_on: Uint32Array | undefined;
  comment: Uint32Array | undefined;
  assignee: Uint32Array | undefined;
  texts: TextColumn | undefined;
}

export interface Witness {
  kind: Uint8Array;
  p: [Float64Array, Float64Array, Float64Array];
  q: [Float64Array, Float64Array, Float64Array];
}

export interface Regions {
  count: number;
  result: Uint32Array;
  allowed: Uint16Array;
  class: Uint8Array;
  flags: Uint8Array;
  d: Float64Array;
  x: Float64Array;
  y: Float64Array;
  z: Float64Array;
  part_a: Uint32Array;
  part_b: Uint32Array;
}

export interface Groups {
  count: number;
  id: KeyColumn;
  name: TextColumn;
  results: Uint32Array;
  hits: Uint32Array;
  contacts: Uint32Array;
  clearance_violations: Uint32Array;
  class: Uint8Array;
  d: Float64Array;
  volume: Float64Array | undefined;
  min: [Float64Array, Float64Array, Float64Array];
  max: [Float64Array, Float64Array, Float64Array];
}

export interface Model {
  shapes: Shapes;
  instances: Instances;
  boxes: Boxes | undefined;
}

export interface Shapes {
  count: number;
  vertices: Uint32Array;
  triangles: Uint32Array;
  /** of each shape, where its vertices and its indices begin */
  firstVertex: Uint32Array;
  firstIndex: Uint32Array;
  min: [Float32Array, Float32Array, Float32Array];
  step: Float32Array;
  position: Uint16Array;
  index: Uint16Array | Uint32Array;
}

export interface Instances {
  count: number;
  shape: Uint32Array;
  object: Uint32Array;
  matrix: Float32Array;
  colour: Uint32Array | undefined;
}

export interface Boxes {
  count: number;
  object: Uint32Array;
  box: Uint16Array;
}

/** Throws where a value is not below `limit`, unless it is `none`. */
function below(id: string, name: string, values: ArrayLike<number> | undefined, limit: number, none = -1): void {
  if (!values) return;
  for (let i = 0; i < values.length; ++i) {
    const value = values[i]!;
    if (value >= limit && value !== none) throw new PayloadError(id, `column ${name} names ${value}, and there are ${limit}`);
  }
}

const LETTERS = ['x', 'y', 'z'] as const;
type Triple<T> = [T, T, T];
const triple = <T>(get: (letter: string) => T): Triple<T> => LETTERS.map(get) as Triple<T>;

export const OBJECTS_ID = 'strake-objects';
export function decodeObjects(bytes: Uint8Array<ArrayBuffer>, head: Head): Objects {
  const block = new Block(OBJECTS_ID, bytes);
  const columns = head.columns.map((_, i) => `attribute_${i}`);
  block.allow(['id', 'name', 'file', 'flags', 'discipline', 'texts', ...columns]);
  const count = head.counts.objects;
  const texts = block.find('texts', 'text');
  const objects: Objects = {
    count,
    id: block.get('id', 'text', count),
    names: block.get('name', 'text', count),
    file: block.get('file', 'u32', count),
    flags: block.get('flags', 'u8', count),
    discipline: block.find('discipline', 'u16', count),
    attributes: columns.map((name) => block.find(name, 'u32', count)),
    texts,
  };
  below(OBJECTS_ID, 'file', objects.file, head.files.length);
  below(OBJECTS_ID, 'discipline', objects.discipline, head.disciplines.length, NONE16);
  objects.attributes.forEach((values, i) => below(OBJECTS_ID, columns[i]!, values, texts?.length ?? 0));
  return objects;
}

const RESULT_COLUMNS = [
  'key', 'test', 'a', 'b', 'class', 'relation', 'flags', 'd', 'd_low', 'd_high', 'x', 'y', 'z', 'part_a', 'part_b', 'witness',
  'p_x', 'p_y', 'p_z', 'q_x', 'q_y', 'q_z', 'group', 'allowed', 'may_be', 'level_a', 'level_b', 'discipline_a', 'discipline_b',
  'clearance', 'region_count', 'allowed_region_count', 'volume', 'volume_mm3', 'status', 'reopened', 'decided_by', 'decided_on',
  'comment', 'assignee', 'texts',
] as const;

/** Volumes as millionths have -1 and -2 for what is not known; both mean it exactly. */
function volumes(block: Block, count: number): Float64Array | undefined {
  const plain = block.find('volume_mm3', 'f64', count);
  if (plain) return plain;
  const volume = block.find('volume', 'nm', count);
  return volume?.map((v) => (v === -2e-6 ? NaN : v === -1e-6 ? -1 : v));
}

export const RESULTS_ID = 'strake-results';
export function decodeResults(bytes: Uint8Array<ArrayBuffer>, head: Head): Results {
  const block = new Block(RESULTS_ID, bytes);
  block.allow(RESULT_COLUMNS);
  const count = head.counts.results;
  const kind = block.find('witness', 'u8', count);
  const results: Results = {
    count,
    key: block.get('key', 'key', count),
    test: block.get('test', 'u16', count),
    a: block.get('a', 'u32', count),
    b: block.get('b', 'u32', count),
    class: block.get('class', 'u8', count),
    relation: block.get('relation', 'u8', count),
    flags: block.get('flags', 'u8', count),
    d: block.get('d', 'nm', count),
    d_low: block.get('d_low', 'nm', count),
    d_high: block.get('d_high', 'nm', count),
    x: block.get('x', 'nm', count),
    y: block.get('y', 'nm', count),
    z: block.get('z', 'nm', count),
    part_a: block.find('part_a', 'u32', count),
    part_b: block.find('part_b', 'u32', count),
    witness: kind && {
      kind,
      p: triple((l) => block.get(`p_${l}`, 'nm', count)),
      q: triple((l) => block.get(`q_${l}`, 'nm', count)),
    },
    group: block.find('group', 'u32', count),
    allowed: block.find('allowed', 'u16', count),
    may_be: block.find('may_be', 'u8', count),
    level_a: block.find('level_a', 'u8', count),
    level_b: block.find('level_b', 'u8', count),
    discipline_a: block.find('discipline_a', 'u16', count),
    discipline_b: block.find('discipline_b', 'u16', count),
    clearance: block.find('clearance', 'nm', count),
    region_count: block.find('region_count', 'u32', count),
    allowed_region_count: block.find('allowed_region_count', 'u32', count),
    volume: volumes(block, count),
    status: block.find('status', 'u8', count),
    reopened: block.find('reopened', 'u8', count),
    decided_by: block.find('decided_by', 'u32', count),
    decided_on: block.find('decided_on', 'u32', count),
    comment: block.find('comment', 'u32', count),
    assignee: block.find('assignee', 'u32', count),
    texts: block.find('texts', 'text'),
  };
  const { disciplines, rules, counts } = head;
  const check = (name: keyof Results & string, limit: number, none = -1): void =>
    below(RESULTS_ID, name, results[name] as ArrayLike<number> | undefined, limit, none);
  check('test', head.clash?.tests.length ?? 0);
  check('a', counts.objects);
  check('b', counts.objects);
  check('class', CLASSES.length);
  check('relation', RELATIONS.length);
  check('group', counts.groups, NONE32);
  check('allowed', rules.length, NONE16);
  check('may_be', CLASSES.length, NONE8);
  check('level_a', LEVELS.length);
  check('level_b', LEVELS.length);
  check('discipline_a', disciplines.length, NONE16);
  check('discipline_b', disciplines.length, NONE16);
  check('status', STATUSES.length, NONE8);
  check('reopened', REOPENED.length);
  for (const name of ['decided_by', 'decided_on', 'comment', 'assignee'] as const) check(name, results.texts?.length ?? 0);
  below(RESULTS_ID, 'witness', kind, 3);
  return results;
}

export const REGIONS_ID = 'strake-regions';
export function decodeRegions(bytes: Uint8Array<ArrayBuffer>, head: Head): Regions {
  const block = new Block(REGIONS_ID, bytes);
  block.allow(['result', 'allowed', 'class', 'flags', 'd', 'd_low', 'd_high', 'x', 'y', 'z', 'part_a', 'part_b']);
  const result = block.get('result', 'u32');
  const count = result.length;
  const regions: Regions = {
    count,
    result,
    allowed: block.get('allowed', 'u16', count),
    class: block.get('class', 'u8', count),
    flags: block.get('flags', 'u8', count),
    d: block.get('d', 'nm', count),
    x: block.get('x', 'nm', count),
    y: block.get('y', 'nm', count),
    z: block.get('z', 'nm', count),
    part_a: block.get('part_a', 'u32', count),
    part_b: block.get('part_b', 'u32', count),
  };
  below(REGIONS_ID, 'result', result, head.counts.results);
  for (let i = 1; i < count; ++i) if (result[i]! < result[i - 1]!) throw new PayloadError(REGIONS_ID, 'it is not sorted by result');
  below(REGIONS_ID, 'allowed', regions.allowed, head.rules.length, NONE16);
  below(REGIONS_ID, 'class', regions.class, CLASSES.length);
  return regions;
}

export const GROUPS_ID = 'strake-groups';
export function decodeGroups(bytes: Uint8Array<ArrayBuffer>, head: Head): Groups {
  const block = new Block(GROUPS_ID, bytes);
  const corner = (end: string): string[] => LETTERS.map((l) => `${end}_${l}`);
  block.allow(['id', 'name', 'results', 'hits', 'contacts', 'clearance_violations', 'class', 'd', 'volume', ...corner('min'), ...corner('max')]);
  const count = head.counts.groups;
  const groups: Groups = {
    count,
    id: block.get('id', 'key', count),
    name: block.get('name', 'text', count),
    results: block.get('results', 'u32', count),
    hits: block.get('hits', 'u32', count),
    contacts: block.get('contacts', 'u32', count),
    clearance_violations: block.get('clearance_violations', 'u32', count),
    class: block.get('class', 'u8', count),
    d: block.get('d', 'nm', count),
    volume: block.find('volume', 'nm', count)?.map((v) => (v < 0 ? NaN : v)),
    min: triple((l) => block.get(`min_${l}`, 'nm', count)),
    max: triple((l) => block.get(`max_${l}`, 'nm', count)),
  };
  below(GROUPS_ID, 'class', groups.class, CLASSES.length);
  return groups;
}

export const SHAPES_ID = 'strake-shapes';
export function decodeShapes(bytes: Uint8Array<ArrayBuffer>): Shapes {
  const block = new Block(SHAPES_ID, bytes);
  block.allow(['vertices', 'triangles', 'min_x', 'min_y', 'min_z', 'step', 'position', 'index']);
  const vertices = block.get('vertices', 'u32');
  const count = vertices.length;
  const triangles = block.get('triangles', 'u32', count);
  const firstVertex = new Uint32Array(count);
  const firstIndex = new Uint32Array(count);
  let vertex = 0;
  let index = 0;
  for (let i = 0; i < count; ++i) {
    firstVertex[i] = vertex;
    firstIndex[i] = index;
    vertex += vertices[i]!;
    index += 3 * triangles[i]!;
  }
  const indices = block.type('index') === 'u16' ? block.get('index', 'u16', index) : block.get('index', 'u32', index);
  for (let i = 0; i < count; ++i) {
    for (let k = firstIndex[i]!; k < firstIndex[i]! + 3 * triangles[i]!; ++k) {
      if (indices[k]! >= vertices[i]!) throw new PayloadError(SHAPES_ID, `shape ${i} has no vertex ${indices[k]!}`);
    }
  }
  return {
    count,
    vertices,
    triangles,
    firstVertex,
    firstIndex,
    min: triple((l) => block.get(`min_${l}`, 'f32', count)),
    step: block.get('step', 'f32', count),
    position: block.get('position', 'u16', 3 * vertex),
    index: indices,
  };
}

export const INSTANCES_ID = 'strake-instances';
export function decodeInstances(bytes: Uint8Array<ArrayBuffer>, head: Head, shapes: Shapes): Instances {
  const block = new Block(INSTANCES_ID, bytes);
  block.allow(['shape', 'object', 'matrix', 'colour']);
  const shape = block.get('shape', 'u32');
  const count = shape.length;
  const instances: Instances = {
    count,
    shape,
    object: block.get('object', 'u32', count),
    matrix: block.get('matrix', 'f32', 12 * count),
    colour: block.find('colour', 'u32', count),
  };
  below(INSTANCES_ID, 'shape', shape, shapes.count);
  below(INSTANCES_ID, 'object', instances.object, head.counts.objects);
  for (const value of instances.matrix) if (!Number.isFinite(value)) throw new PayloadError(INSTANCES_ID, 'a place is no number');
  return instances;
}

export const BOXES_ID = 'strake-boxes';
export function decodeBoxes(bytes: Uint8Array<ArrayBuffer>, head: Head): Boxes {
  const block = new Block(BOXES_ID, bytes);
  block.allow(['object', 'box']);
  const object = block.get('object', 'u32');
  const boxes: Boxes = { count: object.length, object, box: block.get('box', 'u16', 6 * object.length) };
  below(BOXES_ID, 'object', object, head.counts.objects);
  if (!head.scene?.boxes) throw new PayloadError(BOXES_ID, 'the head does not say where they are');
  return boxes;
}
