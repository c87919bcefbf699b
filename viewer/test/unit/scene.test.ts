// SPDX-License-Identifier: Apache-2.0
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { distanceForBox, VIEW_DIRECTIONS, makeCamera } from '../../src/scene/camera.ts';
import { BufferAttribute, BufferGeometry, EdgesGeometry, Vector3 } from 'three';
import { distanceTo, LINES, makeBatches } from '../../src/scene/batches.ts';
import { sharpEdges } from '../../src/scene/edges.ts';
import { isLine, itemsOf, lineEnds, linePieces, makeItems, meshOf, objectBox, type Items, type Mesh, type Vec } from '../../src/scene/items.ts';
import { meets, passes, pick, type Ray } from '../../src/scene/ray.ts';
import { decodeHead } from '../../src/payload/head.ts';
import { decodeBoxes, decodeInstances, decodeShapes } from '../../src/payload/payload.ts';
import { block, col } from '../support/encode.ts';
import { seeded, ship } from '../support/ship.ts';

function scene(objects: number, boxes: number): Items {
  const made = ship({ objects, boxes, results: 5, scene: true });
  const head = decodeHead(new TextEncoder().encode(JSON.stringify({ ...made.head, blocks: [] })));
  const bytes = (id: string): Uint8Array<ArrayBuffer> => made.blocks.get(id) as Uint8Array<ArrayBuffer>;
  const shapes = decodeShapes(bytes('strake-shapes'));
  const model = { shapes, instances: decodeInstances(bytes('strake-instances'), head, shapes), boxes: boxes > 0 ? decodeBoxes(bytes('strake-boxes'), head) : undefined };
  return makeItems(model, head.scene!, head.counts.objects);
}

test('the box of an item holds its triangles, and touches them', () => {
  const items = scene(60, 20);
  for (let item = 0; item < items.count; ++item) {
    const { position } = meshOf(items, [item]);
    for (let k = 0; k < 3; ++k) {
      const values = [...position].filter((_, i) => i % 3 === k);
      assert.ok(Math.abs(Math.min(...values) - items.box[6 * item + k]!) < 1e-2);
      assert.ok(Math.abs(Math.max(...values) - items.box[6 * item + 3 + k]!) < 1e-2);
    }
  }
});

test('each object has its items', () => {
  const items = scene(60, 20);
  for (let o = 0; o < 80; ++o) assert.deepEqual([...itemsOf(items, o)], [o]);
  assert.equal(objectBox(items, 80), undefined);
});

test('batches have every item once and hold what is in them', () => {
  const items = scene(900, 300);
  const seen = new Uint8Array(items.count);
  for (const batch of makeBatches(items)) {
    for (const item of batch.items) {
      ++seen[item]!;
      for (let k = 0; k < 3; ++k) assert.ok(items.box[6 * item + k]! >= batch.box[k]! && items.box[6 * item + 3 + k]! <= batch.box[3 + k]!);
    }
  }
  assert.ok(seen.every((n) => n === 1));
  assert.equal(distanceTo(new Float32Array([0, 0, 0, 1, 1, 1]), [4, 5, 1]), 5);
  assert.equal(distanceTo(new Float32Array([0, 0, 0, 1, 1, 1]), [0.5, 0.5, 0.5]), 0);
});

test('a ray finds what a search through all triangles finds', () => {
  const items = scene(300, 40);
  const all = meshOf(items, Uint32Array.from({ length: items.count }, (_, i) => i));
  const random = seeded(9);
  let found = 0;
  for (let i = 0; i < 60; ++i) {
    const from = [0, 1, 2].map(() => (random() - 0.5) * 12000) as Vec;
    const to = [0, 1, 2].map(() => (random() - 0.5) * 2000);
    const length = Math.hypot(...to.map((v, k) => v - from[k]!));
    const ray: Ray = { from, along: to.map((v, k) => (v - from[k]!) / length) as Vec };
    let best = Infinity;
    for (let t = 0; t < all.index.length; t += 3) best = Math.min(best, meets(all.position, 3 * all.index[t]!, 3 * all.index[t + 1]!, 3 * all.index[t + 2]!, ray));
    const hit = pick(items, ray);
    assert.equal(hit?.distance ?? Infinity, best);
    if (hit) ++found;
  }
  assert.ok(found > 10);
});

test('what a section or a choice leaves out is not met', () => {
  const items = scene(27, 0);
  const box = objectBox(items, 13)!;
  const middle = box.min.map((v, k) => (v + box.max[k]!) / 2) as Vec;
  const ray: Ray = { from: [middle[0], middle[1], 99999], along: [0, 0, -1] };
  const top = pick(items, ray)!;
  const only = pick(items, ray, { visible: (o) => o === 13 })!;
  assert.equal(only.object, 13);
  assert.ok(top.point[2] >= only.point[2]);
  const cut = pick(items, ray, { min: [-1e9, -1e9, -1e9], max: [1e9, 1e9, only.point[2] - 1] });
  assert.ok(!cut || cut.point[2] <= only.point[2] - 1);
});

/** A square sheet and, a metre above it, a line of two pieces: objects 0 and 1. */
function sheetAndLine(): Items {
  const bytes = (...columns: Parameters<typeof block>[0]): Uint8Array<ArrayBuffer> => block(columns) as Uint8Array<ArrayBuffer>;
  const shapes = decodeShapes(bytes(
    col('vertices', 'u32', Uint32Array.of(4, 3)), col('triangles', 'u32', Uint32Array.of(2, 2)),
    col('min_x', 'f32', Float32Array.of(0, 0)), col('min_y', 'f32', Float32Array.of(0, 0)), col('min_z', 'f32', Float32Array.of(0, 0)),
    col('step', 'f32', Float32Array.of(1, 1)),
    col('position', 'u16', Uint16Array.of(0, 0, 0, 1000, 0, 0, 1000, 1000, 0, 0, 1000, 0, 0, 500, 0, 500, 500, 0, 500, 1000, 0)),
    col('index', 'u16', Uint16Array.of(0, 1, 2, 0, 2, 3, 0, 1, 1, 1, 2, 2))));
  const head = { counts: { results: 0, groups: 0, objects: 2 } } as any;
  const at = (z: number): number[] => [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, z];
  const instances = decodeInstances(bytes(
    col('shape', 'u32', Uint32Array.of(0, 1)), col('object', 'u32', Uint32Array.of(0, 1)), col('matrix', 'f32', Float32Array.of(...at(0), ...at(1000)))), head, shapes);
  return makeItems({ shapes, instances, boxes: undefined }, {} as any, 2);
}

test('lines are told from triangles, drawn by their ends and picked from beside them', () => {
  const items = sheetAndLine();
  assert.deepEqual([isLine(items, 0), isLine(items, 1)], [false, true]);
  assert.deepEqual([...lineEnds(meshOf(items, [1]))], [0, 1, 1, 2]);
  assert.deepEqual([...linePieces(meshOf(items, [1]), 300)], [
    0, 500, 1000, 250, 500, 1000, 250, 500, 1000, 500, 500, 1000, 500, 500, 1000, 500, 750, 1000, 500, 750, 1000, 500, 1000, 1000]);
  assert.ok(makeBatches(items).some((batch) => batch.shape === LINES && batch.items.length === 1 && batch.items[0] === 1));
  const down = (x: number, y: number): Ray => ({ from: [x, y, 3000], along: [0, 0, -1] });
  // Two metres below the eye, a hundredth of that is 20 mm.
  assert.equal(pick(items, down(200, 515), { slack: 0.01 })?.object, 1);
  assert.equal(pick(items, down(200, 525), { slack: 0.01 })?.object, 0);
  assert.equal(pick(items, down(485, 900), { slack: 0.01 })?.distance, 2000);
  assert.equal(pick(items, down(500, 1015), { slack: 0.01 })?.object, 1);
  assert.equal(pick(items, down(200, 515))?.object, 0);
  const along: Ray = { from: [-100, 500, 1000], along: [1, 0, 0] };
  assert.ok(passes(meshOf(items, [1]).position, 0, 3, along, 0.01) < Infinity, 'from its end');
});

test('a box fits into the picture, from every side and in every form', () => {
  for (const size of [[30000, 8000, 12000], [10, 20000, 10], [500, 500, 500]] as Vec[]) {
    for (const view of Object.values(VIEW_DIRECTIONS)) {
      for (const aspect of [0.6, 1, 2.2]) {
        const camera = makeCamera();
        camera.aspect = aspect;
        camera.far = 1e7;
        camera.updateProjectionMatrix();
        camera.lookAt(new Vector3(...view));
        const direction = camera.getWorldDirection(new Vector3());
        camera.position.copy(direction).multiplyScalar(-distanceForBox(camera, new Vector3(...size)));
        camera.updateMatrixWorld();
        let most = 0;
        for (let i = 0; i < 8; ++i) {
          const p = new Vector3(...(size.map((v, k) => ((i >> k) & 1 ? v : -v) / 2) as Vec)).project(camera);
          most = Math.max(most, Math.abs(p.x), Math.abs(p.y));
        }
        assert.ok(most < 1 && most > 0.85, `${size} ${view} ${aspect}: ${most}`);
      }
    }
  }
});

test('outlines are those of three, of round, square and rough things, corners shared or not', () => {
  const segments = (points: ArrayLike<number>): string[] => {
    const ends = Array.from({ length: points.length / 3 }, (_, i) => [0, 1, 2].map((k) => points[3 * i + k]!.toFixed(3)).join(' '));
    return Array.from({ length: ends.length / 2 }, (_, i) => [ends[2 * i]!, ends[2 * i + 1]!].sort().join(' - ')).sort();
  };
  const items = scene(60, 20);
  const random = seeded(3);
  const rough = 12;
  const hills: Mesh = { position: new Float32Array(3 * rough * rough), index: new Uint32Array(6 * (rough - 1) ** 2) };
  for (let i = 0; i < rough * rough; ++i) hills.position.set([100 * (i % rough), 100 * Math.floor(i / rough), 80 * random()], 3 * i);
  let at = 0;
  for (let y = 0; y + 1 < rough; ++y) for (let x = 0; x + 1 < rough; ++x) {
    const p = y * rough + x;
    for (const corner of [p, p + 1, p + rough, p + 1, p + rough + 1, p + rough]) hills.index[at++] = corner;
  }
  const meshes = [hills, ...[0, 1, 2, 3, 65].map((item) => meshOf(items, [item]))];
  for (const mesh of meshes) {
    const apart: Mesh = { position: new Float32Array(3 * mesh.index.length), index: Uint32Array.from(mesh.index.keys()) };
    mesh.index.forEach((v, i) => apart.position.set(mesh.position.subarray(3 * v, 3 * v + 3), 3 * i));
    for (const one of [mesh, apart]) {
      const geometry = new BufferGeometry().setAttribute('position', new BufferAttribute(one.position, 3)).setIndex(new BufferAttribute(one.index, 1));
      const expected = segments(new EdgesGeometry(geometry, 30).getAttribute('position').array);
      assert.ok(expected.length > 0);
      assert.deepEqual(segments(sharpEdges(one, 30)), expected);
    }
  }
  assert.equal(sharpEdges({ position: new Float32Array(9), index: Uint32Array.of(0, 1, 2) }, 30).length, 0, 'what has no face has no edge');
});
