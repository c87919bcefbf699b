// SPDX-License-Identifier: Apache-2.0
// Writes blocks as docs/formats/page.md has them, for tests.
import { gzipSync } from 'node:zlib';
import { readFileSync } from 'node:fs';
import type { ColumnType } from '../../src/payload/columns.ts';

export interface Column {
  name: string;
  type: ColumnType;
  values: ArrayLike<number> | readonly string[];
}

export const col = (name: string, type: ColumnType, values: ArrayLike<number> | readonly string[]): Column => ({ name, type, values });

function planes(values: ArrayLike<number>): Uint8Array {
  const n = values.length;
  const out = new Uint8Array(8 * n);
  for (let i = 0; i < n; ++i) {
    const units = Math.round(values[i]! * 1e6);
    const high = Math.floor(units / 4294967296);
    const low = units - high * 4294967296;
    for (let k = 0; k < 4; ++k) {
      out[k * n + i] = (low / 2 ** (8 * k)) & 255;
      out[(k + 4) * n + i] = (high >> (8 * k)) & 255;
    }
  }
  return out;
}

function bytesOf(column: Column): Uint8Array {
  const { type, values } = column;
  const numbers = values as ArrayLike<number>;
  const raw = (array: { buffer: ArrayBufferLike; byteOffset: number; byteLength: number }): Uint8Array => new Uint8Array(array.buffer, array.byteOffset, array.byteLength);
  switch (type) {
    case 'u8':
      return Uint8Array.from(numbers);
    case 'u16':
      return raw(Uint16Array.from(numbers));
    case 'u32':
      return raw(Uint32Array.from(numbers));
    case 'f32':
      return raw(Float32Array.from(numbers));
    case 'f64':
      return raw(Float64Array.from(numbers));
    case 'nm':
      return planes(numbers);
    case 'key':
      return Buffer.from((values as readonly string[]).join(''), 'latin1');
    case 'text': {
      const texts = (values as readonly string[]).map((t) => Buffer.from(t, 'utf8'));
      return Buffer.concat([raw(Uint32Array.from(texts, (t) => t.length)), ...texts]);
    }
  }
}

/** A block of columns. */
export function block(columns: readonly Column[]): Uint8Array<ArrayBuffer> {
  const parts = columns.map(bytesOf);
  const directory = Buffer.from(
    JSON.stringify({
      columns: columns.map(({ name, type, values }, i) => ({
        name,
        type,
        count: values.length,
        ...(type === 'text' ? { bytes: parts[i]!.length - 4 * values.length } : {}),
      })),
    }),
  );
  const start = Buffer.alloc(8);
  start.write('SCOL', 'latin1');
  start.writeUInt32LE(directory.length, 4);
  const all = Buffer.concat([start, directory, ...parts]);
  const out = new Uint8Array(new ArrayBuffer(all.length));
  out.set(all);
  return out;
}

export type Blocks = Map<string, Uint8Array>;

/** One element of the payload. */
export function element(id: string, bytes: Uint8Array, packed = true): string {
  const text = Buffer.from(packed ? gzipSync(bytes, { level: 6 }) : bytes).toString('base64');
  return `<script type="application/octet-stream${packed ? '+gzip' : ''}" id="${id}">${text}</script>\n`;
}

/** Where the payload of a built page goes. */
export const PLACE = '<!--strake:payload-->';
export const TEMPLATE = new URL('../../built/report.html', import.meta.url);

/** The payload of a head and its blocks; `blocks` of the head is filled in. */
export function payload(head: object, blocks: Blocks, packed = true): string {
  const listed = [...blocks].map(([id, bytes]) => ({ id, bytes: bytes.length }));
  const text = Buffer.from(JSON.stringify({ ...head, blocks: listed }), 'utf8');
  return element('strake-head', text, packed) + [...blocks].map(([id, bytes]) => element(id, bytes, packed)).join('');
}

/** The built page with a payload. */
export function pageWith(text: string): string {
  return readFileSync(TEMPLATE, 'utf8').replace(PLACE, () => text);
}
