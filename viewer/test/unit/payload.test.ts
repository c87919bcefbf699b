// SPDX-License-Identifier: Apache-2.0
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { gzipSync } from 'node:zlib';
import { Block } from '../../src/payload/columns.ts';
import { PayloadError } from '../../src/payload/errors.ts';
import { decodeHead, type Head } from '../../src/payload/head.ts';
import { decodeBoxes, decodeInstances, decodeObjects, decodeResults, decodeShapes } from '../../src/payload/payload.ts';
import { unpack } from '../../src/payload/unpack.ts';
import { block, col } from '../support/encode.ts';
import { key, seeded, ship } from '../support/ship.ts';

const fails = (what: RegExp, act: () => unknown): void => void assert.throws(act, (e) => e instanceof PayloadError && what.test(e.message));

function headOf(head: object): Head {
  return decodeHead(new TextEncoder().encode(JSON.stringify({ ...head, blocks: [] })));
}

test('a length in millionths is the double that its decimal reads as', () => {
  const random = seeded(3);
  const texts = ['0', '-0.000001', '2100000.123456', '-160.531', '8.1', '0.1', '-2147483.648001', '9007.199254'];
  for (let i = 0; i < 2000; ++i) texts.push(((random() - 0.5) * 10 ** Math.floor(random() * 7)).toFixed(6));
  const bytes = block([col('d', 'nm', texts.map(Number))]);
  const read = new Block('x', bytes).get('d', 'nm');
  texts.forEach((text, i) => assert.equal(read[i], Number(text) + 0));
});

test('columns are read back, whatever they hold', () => {
  const names = ['', 'a', 'Ångström 💥', '</script>', '\u0000\u202e'];
  const b = new Block('x', block([col('t', 'text', names), col('k', 'key', [key(1), key(2)]), col('f', 'f64', [NaN, -0.5]), col('u', 'u32', [4294967295])]));
  assert.deepEqual(names.map((_, i) => b.get('t', 'text').at(i)), names);
  assert.equal(b.get('k', 'key').at(1), key(2));
  assert.equal(b.get('k', 'key').find(key(2)), 1);
  assert.equal(b.get('k', 'key').find(key(3)), -1);
  assert.equal(b.get('k', 'key').find('short'), -1);
  assert.equal(b.get('u', 'u32')[0], 4294967295);
});

test('what is damaged is told', () => {
  const good = block([col('t', 'text', ['one', 'two']), col('u', 'u8', [1, 2, 3])]);
  fails(/no block/, () => new Block('x', good.slice(0, 4)));
  fails(/directory is cut/, () => new Block('x', good.slice(0, 20)));
  fails(/not as long/, () => new Block('x', good.slice(0, good.length - 1)));
  fails(/missing/, () => new Block('x', good).get('v', 'u8'));
  fails(/and not u16/, () => new Block('x', good).get('u', 'u16'));
  fails(/3 values/, () => new Block('x', good).get('u', 'u8', 2));
  fails(/not known/, () => new Block('x', good).allow(['t']));
  const at = good.indexOf(3, 8 + new DataView(good.buffer).getUint32(4, true));
  const lied = good.slice();
  lied[at] = 200;
  fails(/texts of column t/, () => new Block('x', lied).get('t', 'text'));
});

test('every cut and every changed byte of a block is read or told, and nothing else happens', () => {
  const { head, blocks } = ship({ objects: 12, results: 9, groups: 2 });
  const whole = blocks.get('strake-results') as Uint8Array<ArrayBuffer>;
  const read = headOf(head);
  const tries = (bytes: Uint8Array<ArrayBuffer>): void => {
    try {
      decodeResults(bytes, read);
    } catch (error) {
      assert.ok(error instanceof PayloadError, String(error));
    }
  };
  for (let n = 0; n < whole.length; n += 7) tries(whole.slice(0, n));
  const random = seeded(11);
  for (let i = 0; i < 3000; ++i) {
    const changed = whole.slice();
    changed[Math.floor(random() * changed.length)] = Math.floor(random() * 256);
    tries(changed);
  }
});

test('numbers that name nothing are told', () => {
  const { head, blocks } = ship({ objects: 4, results: 3, scene: true, boxes: 2 });
  const read = headOf(head);
  const bytes = (id: string): Uint8Array<ArrayBuffer> => blocks.get(id) as Uint8Array<ArrayBuffer>;
  assert.equal(decodeObjects(bytes('strake-objects'), read).count, 6);
  assert.equal(decodeResults(bytes('strake-results'), read).count, 3);
  const shapes = decodeShapes(bytes('strake-shapes'));
  assert.equal(decodeInstances(bytes('strake-instances'), read, shapes).count, 4);
  assert.equal(decodeBoxes(bytes('strake-boxes'), read).count, 2);
  fails(/names/, () => decodeResults(bytes('strake-results'), { ...read, counts: { ...read.counts, objects: 1 } }));
  fails(/values and not/, () => decodeResults(bytes('strake-results'), { ...read, counts: { ...read.counts, results: 4 } }));
  fails(/names/, () => decodeObjects(bytes('strake-objects'), { ...read, files: ['one'] }));
  fails(/names/, () => decodeInstances(bytes('strake-instances'), read, { ...shapes, count: 1 }));
  const bad = block([
    col('vertices', 'u32', [3]), col('triangles', 'u32', [1]), col('min_x', 'f32', [0]), col('min_y', 'f32', [0]), col('min_z', 'f32', [0]),
    col('step', 'f32', [1]), col('position', 'u16', [0, 0, 0, 1, 0, 0, 0, 1, 0]), col('index', 'u16', [0, 1, 3]),
  ]);
  fails(/no vertex 3/, () => decodeShapes(bad));
});

test('a head that lacks something is told, with its place', () => {
  const { head } = ship({ objects: 4, results: 3 });
  const say = (change: (h: any) => void): (() => unknown) => () => {
    const copy = structuredClone(head) as any;
    change(copy);
    return headOf(copy);
  };
  fails(/version 2/, say((h) => (h.version = 2)));
  fails(/not the head/, say((h) => (h.format = 'other')));
  fails(/head\.clash\.tests\[0\]\.counts\.HIT/, say((h) => delete h.clash.tests[0].counts.HIT));
  fails(/head\.counts\.results/, say((h) => (h.counts.results = -1)));
  fails(/head\.files\[1\]/, say((h) => (h.files[1] = 7)));
  fails(/no JSON/, () => decodeHead(new TextEncoder().encode('{"format"')));
});

test('blocks are unpacked, and packed ones that are not whole are told', async () => {
  const bytes = new TextEncoder().encode('abc'.repeat(1000));
  const packed = gzipSync(bytes).toString('base64');
  assert.deepEqual(await unpack('x', { text: packed, packed: true }, bytes.length), bytes);
  assert.deepEqual(await unpack('x', { text: Buffer.from(bytes).toString('base64'), packed: false }, bytes.length), bytes);
  const rejects = (what: RegExp, text: string, size = bytes.length): Promise<void> =>
    assert.rejects(unpack('x', { text, packed: true }, size), (e) => e instanceof PayloadError && what.test(e.message));
  await rejects(/larger/, packed, 10);
  await rejects(/smaller/, packed, bytes.length + 1);
  await rejects(/cannot be unpacked|smaller/, packed.slice(0, 40));
  await rejects(/cut off/, packed.slice(0, 41));
  await rejects(/not base64/, `!${packed.slice(1)}`);
  await rejects(/cannot be unpacked/, `${packed.slice(0, 30)}${packed[30] === 'A' ? 'B' : 'A'}${packed.slice(31)}`);
  await assert.rejects(unpack('x', undefined, 1), /missing/);
});
