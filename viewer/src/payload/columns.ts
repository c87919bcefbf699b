// SPDX-License-Identifier: Apache-2.0
import { PayloadError } from './errors.ts';

/** Texts that are decoded when they are asked for: a million names are not all looked at. */
export class TextColumn {
  private readonly decoder = new TextDecoder('utf-8');

  constructor(
    private readonly bytes: Uint8Array,
    private readonly ends: Float64Array | Uint32Array,
  ) {}

  get length(): number {
    return this.ends.length;
  }

  at(index: number): string {
    const to = this.ends[index];
    if (to === undefined) return '';
    const from = index === 0 ? 0 : this.ends[index - 1]!;
    return this.decoder.decode(this.bytes.subarray(from, to));
  }
}

export const KEY_LENGTH = 26;

/** Keys of results and groups, 26 characters each. */
export class KeyColumn {
  constructor(private readonly bytes: Uint8Array) {}

  get length(): number {
    return this.bytes.length / KEY_LENGTH;
  }

  at(index: number): string {
    const from = index * KEY_LENGTH;
    return String.fromCharCode(...this.bytes.subarray(from, from + KEY_LENGTH));
  }

  /** The first row with this key, or -1. */
  find(key: string): number {
    if (key.length !== KEY_LENGTH) return -1;
    const wanted = Uint8Array.from(key, (c) => c.charCodeAt(0));
    for (let from = 0; from < this.bytes.length; from += KEY_LENGTH) {
      let i = 0;
      while (i < KEY_LENGTH && this.bytes[from + i] === wanted[i]) ++i;
      if (i === KEY_LENGTH) return from / KEY_LENGTH;
    }
    return -1;
  }
}

export interface ColumnTypes {
  u8: Uint8Array;
  u16: Uint16Array;
  u32: Uint32Array;
  f32: Float32Array;
  f64: Float64Array;
  nm: Float64Array;
  key: KeyColumn;
  text: TextColumn;
}
export type ColumnType = keyof ColumnTypes;

interface Entry {
  name: string;
  type: ColumnType;
  count: number;
  from: number;
  bytes: number;
}

const WIDTHS: Record<Exclude<ColumnType, 'text'>, number> = { u8: 1, u16: 2, u32: 4, f32: 4, f64: 8, nm: 8, key: KEY_LENGTH };
const NM_PER_MM = 1e6;

function isType(type: unknown): type is ColumnType {
  return typeof type === 'string' && (type === 'text' || Object.hasOwn(WIDTHS, type));
}

function isCount(value: unknown): value is number {
  return typeof value === 'number' && Number.isSafeInteger(value) && value >= 0;
}

/** A block of columns (docs/formats/page.md). Every method throws PayloadError where the block is not what was asked for. */
export class Block {
  private readonly entries = new Map<string, Entry>();

  constructor(
    private readonly id: string,
    private readonly bytes: Uint8Array<ArrayBuffer>,
  ) {
    const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
    if (bytes.length < 8 || view.getUint32(0, false) !== 0x53434f4c) throw new PayloadError(id, 'it is no block of columns');
    const length = view.getUint32(4, true);
    if (8 + length > bytes.length) throw new PayloadError(id, 'its directory is cut off');
    let directory: unknown;
    try {
      directory = JSON.parse(new TextDecoder('utf-8', { fatal: true }).decode(bytes.subarray(8, 8 + length)));
    } catch {
      throw new PayloadError(id, 'its directory cannot be read');
    }
    const columns = (directory as { columns?: unknown } | null)?.columns;
    if (!Array.isArray(columns)) throw new PayloadError(id, 'its directory has no columns');
    let from = 8 + length;
    for (const column of columns as { name?: unknown; type?: unknown; count?: unknown; bytes?: unknown }[]) {
      const { name, type, count } = column;
      if (typeof name !== 'string' || !isType(type) || !isCount(count)) throw new PayloadError(id, 'its directory is damaged');
      if (this.entries.has(name)) throw new PayloadError(id, `column ${name} is there twice`);
      const size = type === 'text' ? (isCount(column.bytes) ? 4 * count + column.bytes : -1) : WIDTHS[type] * count;
      if (size < 0) throw new PayloadError(id, 'its directory is damaged');
      this.entries.set(name, { name, type, count, from, bytes: size });
      from += size;
    }
    if (from !== bytes.length) throw new PayloadError(id, 'its columns are not as long as its directory says');
  }

  has(name: string): boolean {
    return this.entries.has(name);
  }

  /** The type of a column, or undefined where it is missing. */
  type(name: string): ColumnType | undefined {
    return this.entries.get(name)?.type;
  }

  /** Throws where there is a column that `known` does not name: a newer writer means something by it. */
  allow(known: readonly string[]): void {
    for (const name of this.entries.keys()) if (!known.includes(name)) throw new PayloadError(this.id, `column ${name} is not known`);
  }

  /** A column that must be there, with `count` values if that is given. */
  get<T extends ColumnType>(name: string, type: T, count?: number): ColumnTypes[T] {
    const entry = this.entries.get(name);
    if (!entry) throw new PayloadError(this.id, `column ${name} is missing`);
    if (entry.type !== type) throw new PayloadError(this.id, `column ${name} is ${entry.type} and not ${type}`);
    if (count !== undefined && entry.count !== count) throw new PayloadError(this.id, `column ${name} has ${entry.count} values and not ${count}`);
    return this.read(entry) as ColumnTypes[T];
  }

  /** A column that may be missing. */
  find<T extends ColumnType>(name: string, type: T, count?: number): ColumnTypes[T] | undefined {
    return this.has(name) ? this.get(name, type, count) : undefined;
  }

  private read(entry: Entry): ColumnTypes[ColumnType] {
    const { from, count } = entry;
    const slice = (): ArrayBuffer => this.bytes.buffer.slice(this.bytes.byteOffset + from, this.bytes.byteOffset + from + entry.bytes);
    switch (entry.type) {
      case 'u8':
        return new Uint8Array(slice());
      case 'u16':
        return new Uint16Array(slice());
      case 'u32':
        return new Uint32Array(slice());
      case 'f32':
        return new Float32Array(slice());
      case 'f64':
        return new Float64Array(slice());
      case 'nm':
        return millimetres(this.bytes, from, count);
      case 'key':
        return new KeyColumn(new Uint8Array(slice()));
      case 'text':
        return this.texts(entry, slice());
    }
  }

  private texts(entry: Entry, buffer: ArrayBuffer): TextColumn {
    const lengths = new Uint32Array(buffer, 0, entry.count);
    const bytes = new Uint8Array(buffer, 4 * entry.count);
    let end = 0;
    for (let i = 0; i < lengths.length; ++i) {
      end += lengths[i]!;
      if (end > bytes.length) break;
      lengths[i] = end;
    }
    if (end !== bytes.length) throw new PayloadError(this.id, `the texts of column ${entry.name} are not as long as it says`);
    return new TextColumn(bytes, lengths);
  }
}

function millimetres(bytes: Uint8Array, from: number, count: number): Float64Array {
  const out = new Float64Array(count);
  const plane = (k: number): Uint8Array => bytes.subarray(from + k * count, from + (k + 1) * count);
  const [p0, p1, p2, p3, p4, p5, p6, p7] = [0, 1, 2, 3, 4, 5, 6, 7].map(plane) as [
    Uint8Array, Uint8Array, Uint8Array, Uint8Array, Uint8Array, Uint8Array, Uint8Array, Uint8Array,
  ];
  for (let i = 0; i < count; ++i) {
    const low = (p0[i]! | (p1[i]! << 8) | (p2[i]! << 16) | (p3[i]! << 24)) >>> 0;
    const high = p4[i]! | (p5[i]! << 8) | (p6[i]! << 16) | (p7[i]! << 24);
    // Both are exact in a double, and so a division rounds as reading the decimal does.
    out[i] = (high * 4294967296 + low) / NM_PER_MM;
  }
  return out;
}
