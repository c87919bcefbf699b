// SPDX-License-Identifier: Apache-2.0
// The pieces of the model (instances, then boxes), each with its box, and which object has which. No drawing here.
import type { SceneHead } from '../payload/head.ts';
import type { Model } from '../payload/payload.ts';

export type Vec = [number, number, number];

export interface Items {
  model: Model;
  count: number;
  /** instances stand before boxes */
  instances: number;
  /** of each item least and greatest corner, relative to the scene's origin */
  box: Float32Array;
  object: Uint32Array;
  /** items of object o: list[first[o]] to list[first[o + 1] - 1] */
  first: Uint32Array;
  list: Uint32Array;
  bounds: Float32Array;
}

/** Of each shape the box of its vertices. */
function shapeBoxes(model: Model): Float32Array {
  const { shapes } = model;
  const out = new Float32Array(6 * shapes.count);
  for (let s = 0; s < shapes.count; ++s) {
    const least = [65535, 65535, 65535];
    const most = [0, 0, 0];
    for (let v = 3 * shapes.firstVertex[s]!; v < 3 * (shapes.firstVertex[s]! + shapes.vertices[s]!); v += 3) {
      for (let k = 0; k < 3; ++k) {
        const q = shapes.position[v + k]!;
        if (q < least[k]!) least[k] = q;
        if (q > most[k]!) most[k] = q;
      }
    }
    for (let k = 0; k < 3; ++k) {
      out[6 * s + k] = shapes.min[k]![s]! + shapes.step[s]! * least[k]!;
      out[6 * s + 3 + k] = shapes.min[k]![s]! + shapes.step[s]! * most[k]!;
    }
  }
  return out;
}

/** Works out where everything is. */
export function makeItems(model: Model, scene: SceneHead, objects: number): Items {
  const instances = model.instances.count;
  const count = instances + (model.boxes?.count ?? 0);
  const box = new Float32Array(6 * count);
  const object = new Uint32Array(count);
  const local = shapeBoxes(model);
  const { matrix, shape } = model.instances;
  for (let i = 0; i < instances; ++i) {
    object[i] = model.instances.object[i]!;
    const s = 6 * shape[i]!;
    for (let row = 0; row < 3; ++row) {
      const m = 12 * i + 4 * row;
      let [low, high] = [matrix[m + 3]!, matrix[m + 3]!];
      for (let k = 0; k < 3; ++k) {
        const [p, q] = [matrix[m + k]! * local[s + k]!, matrix[m + k]! * local[s + 3 + k]!];
        low += Math.min(p, q);
        high += Math.max(p, q);
      }
      box[6 * i + row] = low;
      box[6 * i + 3 + row] = high;
    }
  }
  if (model.boxes && scene.boxes) {
    const { min, step } = scene.boxes;
    for (let i = 0; i < model.boxes.count; ++i) {
      object[instances + i] = model.boxes.object[i]!;
      for (let k = 0; k < 6; ++k) box[6 * (instances + i) + k] = min[k % 3]! + step * model.boxes.box[6 * i + k]!;
    }
  }
  const first = new Uint32Array(objects + 1);
  for (const o of object) ++first[o + 1]!;
  for (let o = 0; o < objects; ++o) first[o + 1]! += first[o]!;
  const next = first.slice();
  const list = new Uint32Array(count);
  for (let i = 0; i < count; ++i) list[next[object[i]!]!++] = i;
  const bounds = new Float32Array([Infinity, Infinity, Infinity, -Infinity, -Infinity, -Infinity]);
  for (let i = 0; i < 6 * count; i += 6) {
    for (let k = 0; k < 3; ++k) {
      bounds[k] = Math.min(bounds[k]!, box[i + k]!);
      bounds[3 + k] = Math.max(bounds[3 + k]!, box[i + 3 + k]!);
    }
  }
  return { model, count, instances, box, object, first, list, bounds };
}

/** The box of all items of an object, or undefined where it has none in the page. */
export function objectBox(items: Items, object: number): { min: Vec; max: Vec } | undefined {
  const from = items.first[object];
  const to = items.first[object + 1];
  if (from === undefined || to === undefined || from === to) return undefined;
  const min: Vec = [Infinity, Infinity, Infinity];
  const max: Vec = [-Infinity, -Infinity, -Infinity];
  for (let at = from; at < to; ++at) {
    const b = 6 * items.list[at]!;
    for (let k = 0; k < 3; ++k) {
      min[k] = Math.min(min[k]!, items.box[b + k]!);
      max[k] = Math.max(max[k]!, items.box[b + 3 + k]!);
    }
  }
  return { min, max };
}

const CORNERS = [0, 1, 2, 3, 4, 5, 6, 7].map((i): Vec => [i & 1, (i >> 1) & 1, (i >> 2) & 1]);
const FACES = [0, 2, 1, 1, 2, 3, 4, 5, 6, 5, 7, 6, 0, 1, 4, 1, 5, 4, 2, 6, 3, 3, 6, 7, 0, 4, 2, 2, 4, 6, 1, 3, 5, 3, 7, 5];

export interface Mesh {
  position: Float32Array;
  index: Uint32Array;
}

/** Whether an item is made of lines: triangles whose second and third corners are one vertex. */
export function isLine(items: Items, item: number): boolean {
  if (item >= items.instances) return false;
  const { shapes, instances } = items.model;
  const shape = instances.shape[item]!;
  const first = shapes.firstIndex[shape]!;
  return shapes.triangles[shape]! > 0 && shapes.index[first + 1] === shapes.index[first + 2];
}

/** The two ends of each line of a mesh that is made of lines. */
export function lineEnds(mesh: Mesh): Uint32Array<ArrayBuffer> {
  const ends = new Uint32Array((mesh.index.length / 3) * 2);
  for (let i = 0; i < ends.length; ++i) ends[i] = mesh.index[3 * (i >> 1) + (i & 1)]!;
  return ends;
}

const MAX_PIECES = 64;

/** The ends of the lines of a mesh, as points, in pieces no longer than a length (or as many as are of use). */
export function linePieces(mesh: Mesh, longest: number): Float32Array<ArrayBuffer> {
  const ends = lineEnds(mesh);
  const out: number[] = [];
  for (let i = 0; i < ends.length; i += 2) {
    const at = (end: number, k: number): number => mesh.position[3 * ends[i + end]! + k]!;
    const length = Math.hypot(at(1, 0) - at(0, 0), at(1, 1) - at(0, 1), at(1, 2) - at(0, 2));
    const pieces = Math.min(MAX_PIECES, Math.max(1, Math.ceil(length / longest)));
    for (let piece = 0; piece < pieces; ++piece) {
      for (const step of [piece, piece + 1]) for (let k = 0; k < 3; ++k) out.push(at(0, k) + ((at(1, k) - at(0, k)) * step) / pieces);
    }
  }
  return new Float32Array(out);
}

export function itemTriangles(items: Items, item: number): number {
  return item < items.instances ? items.model.shapes.triangles[items.model.instances.shape[item]!]! : 12;
}

export function itemVertices(items: Items, item: number): number {
  return item < items.instances ? items.model.shapes.vertices[items.model.instances.shape[item]!]! : 8;
}

/** Writes an item's triangles, in the scene, into a mesh. */
export function writeItem(items: Items, item: number, mesh: Mesh, vertex: number, index: number): void {
  if (item >= items.instances) {
    CORNERS.forEach((corner, v) => {
      for (let k = 0; k < 3; ++k) mesh.position[3 * (vertex + v) + k] = items.box[6 * item + 3 * corner[k]! + k]!;
    });
    FACES.forEach((f, i) => (mesh.index[index + i] = vertex + f));
    return;
  }
  const { shapes, instances } = items.model;
  const s = instances.shape[item]!;
  const m = 12 * item;
  const { matrix } = instances;
  const step = shapes.step[s]!;
  const [mx, my, mz] = [shapes.min[0][s]!, shapes.min[1][s]!, shapes.min[2][s]!];
  let out = 3 * vertex;
  for (let v = 3 * shapes.firstVertex[s]!; v < 3 * (shapes.firstVertex[s]! + shapes.vertices[s]!); v += 3) {
    const x = mx + step * shapes.position[v]!;
    const y = my + step * shapes.position[v + 1]!;
    const z = mz + step * shapes.position[v + 2]!;
    mesh.position[out++] = matrix[m]! * x + matrix[m + 1]! * y + matrix[m + 2]! * z + matrix[m + 3]!;
    mesh.position[out++] = matrix[m + 4]! * x + matrix[m + 5]! * y + matrix[m + 6]! * z + matrix[m + 7]!;
    mesh.position[out++] = matrix[m + 8]! * x + matrix[m + 9]! * y + matrix[m + 10]! * z + matrix[m + 11]!;
  }
  const from = shapes.firstIndex[s]!;
  for (let i = 0; i < 3 * shapes.triangles[s]!; ++i) mesh.index[index + i] = vertex + shapes.index[from + i]!;
}

/** One mesh of several items. */
export function meshOf(items: Items, list: ArrayLike<number>): Mesh {
  let [vertices, triangles] = [0, 0];
  for (let i = 0; i < list.length; ++i) {
    vertices += itemVertices(items, list[i]!);
    triangles += itemTriangles(items, list[i]!);
  }
  const mesh: Mesh = { position: new Float32Array(3 * vertices), index: new Uint32Array(3 * triangles) };
  let [vertex, index] = [0, 0];
  for (let i = 0; i < list.length; ++i) {
    writeItem(items, list[i]!, mesh, vertex, index);
    vertex += itemVertices(items, list[i]!);
    index += 3 * itemTriangles(items, list[i]!);
  }
  return mesh;
}

/** The items of an object. */
export function itemsOf(items: Items, object: number): Uint32Array {
  return items.list.subarray(items.first[object], items.first[object + 1]);
}
