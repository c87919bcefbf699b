// SPDX-License-Identifier: Apache-2.0
// Groups under the same limits as results: a group is there where a result of it is, and counts those alone.
import { NONE32 } from '../payload/payload.ts';
import { type Filter, isUnlimited, type Rows, SEVERITY } from './filter.ts';
import { sortByValue } from './order.ts';
import { type Report, shown } from './report.ts';

/** Of each group what the limits let through; without limits the numbers of the document. */
export interface GroupCounts {
  /** whether the numbers are of some of the results only */
  limited: boolean;
  results: Uint32Array;
  hits: Uint32Array;
  contacts: Uint32Array;
  near: Uint32Array;
  /** class and distance of the worst result */
  class: Uint8Array;
  d: Float64Array;
}

function ofDocument(report: Report): GroupCounts {
  const groups = report.groups!;
  return {
    limited: false, results: groups.results, hits: groups.hits, contacts: groups.contacts, near: groups.clearance_violations,
    class: groups.class, d: groups.d,
  };
}

function empty(count: number): GroupCounts {
  const numbers = (): Uint32Array => new Uint32Array(count);
  return { limited: true, results: numbers(), hits: numbers(), contacts: numbers(), near: numbers(), class: new Uint8Array(count), d: new Float64Array(count) };
}

/** Adds up rows whose group is wanted. */
function addUp(report: Report, rows: Uint32Array, into: GroupCounts, wanted: (group: number) => boolean): void {
  const results = report.results!;
  for (const row of rows) {
    const group = results.group?.[row] ?? NONE32;
    if (group === NONE32 || !wanted(group)) continue;
    const cls = results.class[row]!;
    const first = into.results[group] === 0;
    ++into.results[group]!;
    ++[into.hits, into.contacts, into.near][cls]![group]!;
    const worse = first ? -1 : SEVERITY[cls]! - SEVERITY[into.class[group]!]! || results.d[row]! - into.d[group]!;
    if (worse < 0) {
      into.class[group] = cls;
      into.d[group] = results.d[row]!;
    }
  }
}

/** Groups by whose name a search finds them, whatever their results are called. */
export function namedGroups(report: Report, text: string): Set<number> {
  const words = text.toLowerCase().split(/\s+/).filter(Boolean);
  const found = new Set<number>();
  if (words.length === 0) return found;
  const groups = report.groups!;
  for (let g = 0; g < groups.count; ++g) {
    const name = shown(groups.name.at(g)).toLowerCase();
    if (words.every((word) => name.includes(word))) found.add(g);
  }
  return found;
}

/** The groups that a filter lets through, in the order of the document, and what it leaves of each. */
export function filterGroups(rows: Rows, filter: Filter): { list: Uint32Array; counts: GroupCounts } {
  const { report } = rows;
  const groups = report.groups!;
  const all = Uint32Array.from({ length: groups.count }, (_, g) => g);
  if (isUnlimited(filter)) return { list: all, counts: ofDocument(report) };
  const counts = empty(groups.count);
  const named = namedGroups(report, filter.text);
  addUp(report, rows.filter(filter), counts, (group) => !named.has(group));
  if (named.size > 0) addUp(report, rows.filter({ ...filter, text: '' }), counts, (group) => named.has(group));
  return { list: all.filter((g) => counts.results[g]! > 0), counts };
}

export type GroupColumn = 'worst' | 'class' | 'd' | 'name' | 'results' | 'hits' | 'near';

/** Groups in an order; `worst` is the severest first, the deepest of several, as the document has them. */
export function sortGroups(report: Report, list: Uint32Array, counts: GroupCounts, column: GroupColumn, down: boolean): Uint32Array {
  const sign = down ? -1 : 1;
  if (column === 'name') {
    const collator = new Intl.Collator('en', { numeric: true });
    const names = new Map(Array.from(list, (g) => [g, report.groups!.name.at(g)]));
    return list.slice().sort((p, q) => sign * collator.compare(names.get(p)!, names.get(q)!) || p - q);
  }
  const severity = (g: number): number => SEVERITY[counts.class[g]!]!;
  if (column === 'worst' && !counts.limited) return list;
  if (column === 'worst') return sortByValue(sortByValue(list, (g) => counts.d[g]!), severity);
  const value: Record<'class' | 'd' | 'results' | 'hits' | 'near', (g: number) => number> = {
    class: severity, d: (g) => counts.d[g]!, results: (g) => counts.results[g]!, hits: (g) => counts.hits[g]!, near: (g) => counts.near[g]!,
  };
  return sortByValue(list, (g) => sign * value[column](g));
}
