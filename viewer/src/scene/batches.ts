// SPDX-License-Identifier: Apache-2.0
// Puts items together for drawing: many instances of a shape as one instanced batch, the rest of a neighbourhood as one
// mesh. A batch holds things that are near each other, so that what is near can be drawn first and what is out of view left out.
import { sortByValue } from '../data/order.ts';
import { isLine, type Items, itemTriangles } from './items.ts';

export interface Batch {
  /** the shape that all items are instances of; -1: boxes; -2: a mesh of several shapes; -3: lines */
  shape: number;
  items: Uint32Array;
  triangles: number;
  box: Float32Array;
}

export const BOXES = -1;
export const MERGED = -2;
export const LINES = -3;

// As much as software rendering draws within a frame or two.
const TRIANGLES_IN_BATCH = 6000;
// Fewer instances of a shape than this are merged with their neighbours: a call of the driver costs as much as some.
const FEWEST_INSTANCES = 16;

/** Ten bits of a number, two empty ones between each. */
function spread(bits: number): number {
  let x = bits & 1023;
  x = (x | (x << 16)) & 0x030000ff;
  x = (x | (x << 8)) & 0x0300f00f;
  x = (x | (x << 4)) & 0x030c30c3;
  return (x | (x << 2)) & 0x09249249;
}

/** Of each item a number that is alike for items that are near each other: the bits of the three coordinates of its middle in turn. */
function curve(items: Items): Uint32Array {
  const { box, bounds } = items;
  const scale = [0, 1, 2].map((k) => (bounds[3 + k]! > bounds[k]! ? 1024 / (bounds[3 + k]! - bounds[k]!) : 0));
  const codes = new Uint32Array(items.count);
  for (let i = 0; i < items.count; ++i) {
    let code = 0;
    for (let k = 0; k < 3; ++k) {
      const middle = (box[6 * i + k]! + box[6 * i + 3 + k]!) / 2;
      code |= spread(Math.min(1023, Math.max(0, Math.floor((middle - bounds[k]!) * scale[k]!)))) << (2 - k);
    }
    codes[i] = code;
  }
  return codes;
}

export function makeBatches(items: Items): Batch[] {
  const codes = curve(items);
  const uses = new Uint32Array(items.model.shapes.count);
  for (let i = 0; i < items.instances; ++i) ++uses[items.model.instances.shape[i]!]!;
  const kind = (item: number): number => {
    if (item >= items.instances) return BOXES;
    if (isLine(items, item)) return LINES;
    const shape = items.model.instances.shape[item]!;
    return uses[shape]! >= FEWEST_INSTANCES ? shape : MERGED;
  };
  const byKind = new Map<number, number[]>();
  for (let i = 0; i < items.count; ++i) {
    const k = kind(i);
    const list = byKind.get(k);
    if (list) list.push(i);
    else byKind.set(k, [i]);
  }
  const batches: Batch[] = [];
  for (const [shape, unsorted] of byKind) {
    const list = sortByValue(Uint32Array.from(unsorted), (item) => codes[item]!);
    let from = 0;
    let triangles = 0;
    for (let i = 0; i < list.length; ++i) {
      const more = itemTriangles(items, list[i]!);
      if (i > from && triangles + more > TRIANGLES_IN_BATCH) {
        batches.push(batchOf(items, shape, list.slice(from, i), triangles));
        from = i;
        triangles = 0;
      }
      triangles += more;
    }
    if (from < list.length) batches.push(batchOf(items, shape, list.slice(from), triangles));
  }
  return batches;
}

function batchOf(items: Items, shape: number, list: Uint32Array, triangles: number): Batch {
  const box = new Float32Array([Infinity, Infinity, Infinity, -Infinity, -Infinity, -Infinity]);
  for (const item of list) {
    for (let k = 0; k < 3; ++k) {
      box[k] = Math.min(box[k]!, items.box[6 * item + k]!);
      box[3 + k] = Math.max(box[3 + k]!, items.box[6 * item + 3 + k]!);
    }
  }
  return { shape, items: list, triangles, box };
}

/** How far a point is from a box. */
export function distanceTo(box: Float32Array, point: readonly [number, number, number]): number {
  let sum = 0;
  for (let k = 0; k < 3; ++k) {
    const off = Math.max(box[k]! - point[k]!, 0, point[k]! - box[3 + k]!);
    sum += off * off;
  }
  return Math.sqrt(sum);
}
