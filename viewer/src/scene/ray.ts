// SPDX-License-Identifier: Apache-2.0
// Finds what a ray meets first: the boxes of all items, then the triangles of those that it goes through, the nearest
// box first. A million boxes take some milliseconds, and it needs no picture.
import { isLine, type Items, meshOf, type Vec } from './items.ts';

export interface Ray {
  from: Vec;
  along: Vec;
}

export interface Hit {
  item: number;
  object: number;
  distance: number;
  point: Vec;
  /** the triangle that was met */
  corners: [Vec, Vec, Vec];
}

export interface Limits {
  /** what lies outside of the section box is not there */
  min?: Vec;
  max?: Vec;
  visible?: (object: number) => boolean;
  /** how far beside a line the ray may pass, as a share of how far away that is */
  slack?: number;
}

/** Where a ray enters a box that is grown to all sides, or Infinity where it passes by. */
export function enters(box: Float32Array, at: number, ray: Ray, grown = 0): number {
  let near = 0;
  let far = Infinity;
  for (let k = 0; k < 3; ++k) {
    const d = ray.along[k]!;
    const [low, high] = [box[at + k]! - grown - ray.from[k]!, box[at + 3 + k]! + grown - ray.from[k]!];
    if (d === 0) {
      if (low > 0 || high < 0) return Infinity;
      continue;
    }
    const [p, q] = [low / d, high / d];
    near = Math.max(near, Math.min(p, q));
    far = Math.min(far, Math.max(p, q));
    if (near > far) return Infinity;
  }
  return near;
}

/** Where a ray meets a triangle of either side, or Infinity. */
export function meets(p: Float32Array, a: number, b: number, c: number, ray: Ray): number {
  const [ax, ay, az] = [p[a]!, p[a + 1]!, p[a + 2]!];
  const [ux, uy, uz] = [p[b]! - ax, p[b + 1]! - ay, p[b + 2]! - az];
  const [vx, vy, vz] = [p[c]! - ax, p[c + 1]! - ay, p[c + 2]! - az];
  const [dx, dy, dz] = ray.along;
  const [hx, hy, hz] = [dy * vz - dz * vy, dz * vx - dx * vz, dx * vy - dy * vx];
  const det = ux * hx + uy * hy + uz * hz;
  if (det === 0) return Infinity;
  const [sx, sy, sz] = [ray.from[0] - ax, ray.from[1] - ay, ray.from[2] - az];
  const u = (sx * hx + sy * hy + sz * hz) / det;
  if (u < 0 || u > 1) return Infinity;
  const [qx, qy, qz] = [sy * uz - sz * uy, sz * ux - sx * uz, sx * uy - sy * ux];
  const v = (dx * qx + dy * qy + dz * qz) / det;
  if (v < 0 || u + v > 1) return Infinity;
  const t = (vx * qx + vy * qy + vz * qz) / det;
  return t >= 0 ? t : Infinity;
}

/** Where a ray passes a line near enough, or Infinity. */
export function passes(p: Float32Array, a: number, b: number, ray: Ray, slack: number): number {
  const at = (i: number): Vec => [p[i]!, p[i + 1]!, p[i + 2]!];
  const dot = (x: Vec, y: Vec): number => x[0] * y[0] + x[1] * y[1] + x[2] * y[2];
  const { from, along } = ray;
  const off = at(a).map((v, k) => v - from[k]!) as Vec;
  const line = at(b).map((v, k) => v - p[a + k]!) as Vec;
  const [square, beside] = [dot(line, line), dot(line, along)];
  const turn = square - beside * beside;
  const s = turn > 0 ? Math.min(1, Math.max(0, (beside * dot(along, off) - dot(line, off)) / turn)) : 0;
  const t = dot(along, off) + s * beside;
  return t > 0 && Math.hypot(...along.map((v, k) => t * v - off[k]! - s * line[k]!)) <= slack * t ? t : Infinity;
}

/** How far the farthest corner of a box is. */
function farthest(box: Float32Array, at: number, from: Vec): number {
  return Math.hypot(...from.map((v, k) => Math.max(Math.abs(box[at + k]! - v), Math.abs(box[at + 3 + k]! - v))));
}

/** The first thing that a ray meets. `along` is of length one. */
export function pick(items: Items, ray: Ray, limits: Limits = {}): Hit | undefined {
  const { slack = 0 } = limits;
  const found: { item: number; near: number }[] = [];
  for (let item = 0; item < items.count; ++item) {
    const grown = slack > 0 && isLine(items, item) ? slack * farthest(items.box, 6 * item, ray.from) : 0;
    const near = enters(items.box, 6 * item, ray, grown);
    if (near === Infinity) continue;
    if (limits.visible && !limits.visible(items.object[item]!)) continue;
    found.push({ item, near });
  }
  found.sort((a, b) => a.near - b.near || a.item - b.item);
  const inside = (x: Vec): boolean => {
    const { min, max } = limits;
    return !min || !max || x.every((v, k) => v >= min[k]! && v <= max[k]!);
  };
  let best: Hit | undefined;
  for (const { item, near } of found) {
    if (best && near > best.distance) break;
    const { position, index } = meshOf(items, [item]);
    for (let i = 0; i < index.length; i += 3) {
      const [a, b, c] = [3 * index[i]!, 3 * index[i + 1]!, 3 * index[i + 2]!];
      const t = b === c ? passes(position, a, b, ray, slack) : meets(position, a, b, c, ray);
      if (t === Infinity || (best && t >= best.distance)) continue;
      const point = ray.from.map((v, k) => v + t * ray.along[k]!) as Vec;
      if (!inside(point)) continue;
      const corner = (at: number): Vec => [position[at]!, position[at + 1]!, position[at + 2]!];
      best = { item, object: items.object[item]!, distance: t, point, corners: [corner(a), corner(b), corner(c)] };
    }
  }
  return best;
}
