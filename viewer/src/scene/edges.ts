// SPDX-License-Identifier: Apache-2.0
// The sharp edges of a mesh, for the outlines of the two objects of a clash. A click waits for them, so they are found by
// tables of numbers: three's own EdgesGeometry makes three texts of each corner, which takes ten times as long.
import type { Mesh } from './items.ts';

/** A table that numbers what it is asked for: 32-bit words, a few for each entry. */
class Numbers {
  count = 0;
  private readonly slots: Int32Array;
  private readonly words: Uint32Array;

  constructor(
    most: number,
    private readonly width: number,
  ) {
    this.slots = new Int32Array(2 ** Math.ceil(Math.log2(2 * most + 2))).fill(-1);
    this.words = new Uint32Array(most * width);
  }

  /** The number of an entry, a new one where it is new. */
  of(a: number, b: number, c = 0): number {
    const { slots, words, width } = this;
    let hash = Math.imul(a, 0x9e3779b1) ^ Math.imul(b, 0x85ebca6b) ^ Math.imul(c, 0xc2b2ae35);
    hash ^= hash >>> 15;
    for (let at = hash & (slots.length - 1); ; at = (at + 1) & (slots.length - 1)) {
      const number = slots[at]!;
      if (number < 0) {
        slots[at] = this.count;
        words[width * this.count] = a;
        words[width * this.count + 1] = b;
        if (width > 2) words[width * this.count + 2] = c;
        return this.count++;
      }
      const from = width * number;
      if (words[from] === a >>> 0 && words[from + 1] === b >>> 0 && (width < 3 || words[from + 2] === c >>> 0)) return number;
    }
  }
}

/** Which vertices stand at the same place: of each the number of its place. */
function weld(position: Float32Array): Uint32Array {
  // The bits of 0 and -0 differ.
  const bits = new Uint32Array(position.map((v) => v + 0).buffer);
  const places = new Numbers(position.length / 3, 3);
  return Uint32Array.from({ length: position.length / 3 }, (_, v) => places.of(bits[3 * v]!, bits[3 * v + 1]!, bits[3 * v + 2]!));
}

const [RIM, FLAT, SHARP] = [1, 2, 3];

/** The ends of edges of one triangle, and of those whose two triangles turn by more than an angle in degrees. */
export function sharpEdges(mesh: Mesh, degrees: number): Float32Array<ArrayBuffer> {
  const { position, index } = mesh;
  const flat = Math.cos((degrees * Math.PI) / 180);
  const place = weld(position);
  const edges = new Numbers(index.length, 2);
  // Of each edge the corners that it goes from and to, its first triangle, and what is known of it.
  const ends = new Uint32Array(2 * index.length);
  const first = new Int32Array(index.length);
  const kind = new Uint8Array(index.length);
  const normal = new Float64Array(index.length);
  for (let t = 0; t < index.length; t += 3) {
    const [a, b, c] = [3 * index[t]!, 3 * index[t + 1]!, 3 * index[t + 2]!];
    const [ux, uy, uz] = [position[b]! - position[a]!, position[b + 1]! - position[a + 1]!, position[b + 2]! - position[a + 2]!];
    const [vx, vy, vz] = [position[c]! - position[a]!, position[c + 1]! - position[a + 1]!, position[c + 2]! - position[a + 2]!];
    const [nx, ny, nz] = [uy * vz - uz * vy, uz * vx - ux * vz, ux * vy - uy * vx];
    const length = Math.sqrt(nx * nx + ny * ny + nz * nz);
    if (length === 0) continue;
    normal[t] = nx / length;
    normal[t + 1] = ny / length;
    normal[t + 2] = nz / length;
    for (let k = 0; k < 3; ++k) {
      const [p, q] = [index[t + k]!, index[t + ((k + 1) % 3)]!];
      const [i, j] = [place[p]!, place[q]!];
      const before = edges.count;
      const edge = edges.of(Math.min(i, j), Math.max(i, j));
      if (edge === before) {
        ends[2 * edge] = p;
        ends[2 * edge + 1] = q;
        first[edge] = t;
        kind[edge] = RIM;
        continue;
      }
      const f = first[edge]!;
      const turn = normal[f]! * normal[t]! + normal[f + 1]! * normal[t + 1]! + normal[f + 2]! * normal[t + 2]!;
      if (turn <= flat) kind[edge] = SHARP;
      else if (kind[edge] === RIM) kind[edge] = FLAT;
    }
  }
  let count = 0;
  for (let edge = 0; edge < edges.count; ++edge) if (kind[edge] !== FLAT) ++count;
  const out = new Float32Array(6 * count);
  let at = 0;
  for (let edge = 0; edge < edges.count; ++edge) {
    if (kind[edge] === FLAT) continue;
    for (const end of [ends[2 * edge]!, ends[2 * edge + 1]!]) {
      out.set(position.subarray(3 * end, 3 * end + 3), at);
      at += 3;
    }
  }
  return out;
}
