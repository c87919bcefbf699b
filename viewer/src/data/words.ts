// SPDX-License-Identifier: Apache-2.0
// What the page says, in plain words.

export const CLASS_WORDS = ['Hit', 'Contact', 'Too close'] as const;
export const CLASS_PLURALS = ['Hits', 'Contacts', 'Too close'] as const;
export const CLASS_MEANINGS = [
  'The two run into each other.',
  'The two touch.',
  'The two are nearer than they may be.',
] as const;

export const RELATION_WORDS: readonly string[] = [
  'apart', 'touching', 'touching from inside', 'cutting into each other', 'A lies inside B', 'B lies inside A', 'the same body twice', 'surfaces that cross',
];

export const STATUS_WORDS = ['New', 'Active', 'Reviewed', 'Approved', 'Resolved'] as const;

export const FLAG_MEANINGS: readonly string[] = [
  'close to a limit: a small change may make it another class',
  'not certain: it may be of a severer class',
  'one of the two is an open surface',
  'faces of one of the two point the wrong way',
];

/** A length as the JSON document has it, all its digits. */
export function exact(mm: number): string {
  return String(mm);
}

const grouped = new Intl.NumberFormat('en-GB', { maximumFractionDigits: 0 });
const tenths = new Intl.NumberFormat('en-GB', { minimumFractionDigits: 1, maximumFractionDigits: 1 });

/** A whole number with commas between thousands. */
export function count(n: number): string {
  return grouped.format(n);
}

/** A length for a table. */
export function length(mm: number): string {
  return tenths.format(mm).replace(/^-0\.0$/, '0.0');
}

/** A coordinate for a table: whole millimetres, no commas, since several stand side by side. */
export function coordinate(mm: number): string {
  return String(Math.round(mm) + 0);
}

export function plural(n: number, one: string, many = `${one}s`): string {
  return `${count(n)} ${n === 1 ? one : many}`;
}

/** What a result says, in one sentence. */
export function sentence(cls: number, d: number, relation: number, clearance: number | undefined): string {
  if (cls === 0) {
    if (relation === 6) return `The same body stands here twice (${length(-d)} mm deep).`;
    if (relation === 4) return `A lies inside B, ${length(-d)} mm deep.`;
    if (relation === 5) return `B lies inside A, ${length(-d)} mm deep.`;
    if (relation === 7) return d < 0 ? `The surfaces cross, ${length(-d)} mm deep.` : 'The surfaces cross.';
    return `They overlap: ${length(-d)} mm at the deepest place.`;
  }
  if (cls === 1) return d === 0 ? 'They touch.' : d < 0 ? `They touch, ${length(-d)} mm into each other.` : `They touch, but for ${length(d)} mm.`;
  const needed = clearance !== undefined && clearance > 0 ? ` They have to keep ${exact(clearance)} mm.` : '';
  return `They are ${length(d)} mm apart.${needed}`;
}
