// SPDX-License-Identifier: Apache-2.0
import { PayloadError } from './errors.ts';

/** The text of a block's element, and whether gzip packed it. */
export interface PackedBlock {
  text: string;
  packed: boolean;
}

const PACKED = 'application/octet-stream+gzip';
const PLAIN = 'application/octet-stream';

/** Finds the element of a block in the document, or undefined. */
export function findBlock(id: string): PackedBlock | undefined {
  const element = document.getElementById(id);
  if (!(element instanceof HTMLScriptElement)) return undefined;
  if (element.type !== PACKED && element.type !== PLAIN) return undefined;
  return { text: element.textContent ?? '', packed: element.type === PACKED };
}

/** Forgets the text of a block that was unpacked: of a large page it is most of the memory. */
export function dropBlock(id: string): void {
  document.getElementById(id)?.remove();
}

// A text of 40 MB at once would stand in memory twice more; a multiple of four digits is whole bytes.
const DIGITS_AT_ONCE = 1 << 20;

function bytesOfBase64(id: string, text: string): Uint8Array<ArrayBuffer> {
  const digits = text.trim();
  if (digits.length % 4 !== 0) throw new PayloadError(id, 'its text is cut off');
  const padding = digits.endsWith('==') ? 2 : digits.endsWith('=') ? 1 : 0;
  const bytes = new Uint8Array((digits.length / 4) * 3 - padding);
  let at = 0;
  for (let from = 0; from < digits.length; from += DIGITS_AT_ONCE) {
    let piece: string;
    try {
      piece = atob(digits.slice(from, from + DIGITS_AT_ONCE));
    } catch {
      throw new PayloadError(id, 'its text is not base64');
    }
    if (at + piece.length > bytes.length) throw new PayloadError(id, 'its text is not base64');
    for (let i = 0; i < piece.length; ++i) bytes[at++] = piece.charCodeAt(i);
  }
  if (at !== bytes.length) throw new PayloadError(id, 'its text is not base64');
  return bytes;
}

async function gunzip(id: string, bytes: Uint8Array<ArrayBuffer>, size: number): Promise<Uint8Array<ArrayBuffer>> {
  const out = new Uint8Array(size);
  let at = 0;
  try {
    const reader = new Blob([bytes]).stream().pipeThrough(new DecompressionStream('gzip')).getReader();
    for (;;) {
      const { done, value } = await reader.read();
      if (done) break;
      // What says that it is larger than the head tells is not unpacked: it may not end.
      if (at + value.length > size) throw new PayloadError(id, 'it is larger than the page says');
      out.set(value, at);
      at += value.length;
    }
  } catch (error) {
    if (error instanceof PayloadError) throw error;
    throw new PayloadError(id, 'it cannot be unpacked');
  }
  if (at !== size) throw new PayloadError(id, 'it is smaller than the page says');
  return out;
}

/** Unpacks a block of a known size. Throws PayloadError. */
export async function unpack(id: string, block: PackedBlock | undefined, size: number): Promise<Uint8Array<ArrayBuffer>> {
  if (!block) throw new PayloadError(id, 'it is missing');
  const bytes = bytesOfBase64(id, block.text);
  if (block.packed) return gunzip(id, bytes, size);
  if (bytes.length !== size) throw new PayloadError(id, 'it has another size than the page says');
  return bytes;
}

// The head is small text; more than this is no head.
const LARGEST_HEAD = 1 << 28;

/** Unpacks the head, whose size nothing says. Throws PayloadError. */
export async function unpackHead(id: string, block: PackedBlock | undefined): Promise<Uint8Array> {
  if (!block) throw new PayloadError(id, 'it is missing');
  const bytes = bytesOfBase64(id, block.text);
  if (!block.packed) return bytes;
  // gzip ends with the size of what it packed.
  if (bytes.length < 18) throw new PayloadError(id, 'it cannot be unpacked');
  const size = new DataView(bytes.buffer).getUint32(bytes.length - 4, true);
  if (size > LARGEST_HEAD) throw new PayloadError(id, 'it cannot be unpacked');
  return gunzip(id, bytes, size);
}
