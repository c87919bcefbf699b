// SPDX-License-Identifier: Apache-2.0
// Which results the table shows, and in what order.
import { NONE16, NONE32, NONE8, type Results } from '../payload/payload.ts';
import { cellOf, hasDisciplines, objectName, type Report, shown } from './report.ts';
import { sortByValue } from './order.ts';

export interface Filter {
  /** by class; none chosen is all */
  classes: Set<number>;
  statuses: Set<number>;
  test: number | undefined;
  /** row and column of the matrix, in either order; undefined: any */
  cell: [number | undefined, number | undefined];
  /** least and greatest d in millimetres; undefined: no limit */
  d: [number | undefined, number | undefined];
  group: number | undefined;
  object: number | undefined;
  /** only what is not certain */
  uncertain: boolean;
  /** only what came back after a decision */
  reopened: boolean;
  /** what a rule allows or people approved is shown, too */
  settled: boolean;
  text: string;
}

export function noFilter(): Filter {
  return {
    classes: new Set(), statuses: new Set(), test: undefined, cell: [undefined, undefined], d: [undefined, undefined], group: undefined, object: undefined,
    uncertain: false, reopened: false, settled: true, text: '',
  };
}

/** Whether a filter lets everything through. */
export function isUnlimited(filter: Filter): boolean {
  const given = [filter.test, filter.group, filter.object, ...filter.cell, ...filter.d];
  return filter.classes.size + filter.statuses.size === 0 && given.every((value) => value === undefined) && !filter.uncertain && !filter.reopened && filter.settled && filter.text.trim() === '';
}

/** Whether the two sides of a result are of a cell of the matrix. */
function inCell(sides: readonly [number, number], cell: Filter['cell']): boolean {
  const is = (side: number, wanted: number | undefined): boolean => wanted === undefined || side === wanted;
  return (is(sides[0], cell[0]) && is(sides[1], cell[1])) || (is(sides[1], cell[0]) && is(sides[0], cell[1]));
}

export type SortColumn = 'worst' | 'number' | 'class' | 'd' | 'relation' | 'a' | 'b' | 'place' | 'status';

const APPROVED = 3;
const UNCERTAIN = 2;

/** A rule allows it, or people approved of it and nothing made it worse since. */
export function isSettled(report: Report, row: number): boolean {
  const results = report.results!;
  if ((results.allowed?.[row] ?? NONE16) !== NONE16) return true;
  return results.status?.[row] === APPROVED && (results.reopened?.[row] ?? 0) === 0;
}

/** Keeps what was worked out of all objects, which a second search or sort asks again. */
export class Rows {
  private names: string[] | undefined;
  private ranks: Float64Array | undefined;

  constructor(readonly report: Report) {}

  /** The rows that a filter lets through, in the order of the document. */
  filter(filter: Filter): Uint32Array {
    const { report } = this;
    const results = report.results;
    if (!results) return new Uint32Array(0);
    const matches = this.matcher(filter.text);
    const rows = new Uint32Array(results.count);
    const byDiscipline = hasDisciplines(report);
    const anyCell = filter.cell.some((wanted) => wanted !== undefined);
    const [least, most] = filter.d;
    let n = 0;
    for (let i = 0; i < results.count; ++i) {
      if (filter.classes.size > 0 && !filter.classes.has(results.class[i]!)) continue;
      if (filter.statuses.size > 0 && !filter.statuses.has(results.status?.[i] ?? NONE8)) continue;
      if (filter.test !== undefined && results.test[i] !== filter.test) continue;
      if (filter.group !== undefined && (results.group?.[i] ?? NONE32) !== filter.group) continue;
      if (filter.object !== undefined && results.a[i] !== filter.object && results.b[i] !== filter.object) continue;
      if (least !== undefined && results.d[i]! < least) continue;
      if (most !== undefined && results.d[i]! > most) continue;
      if (filter.uncertain && (results.flags[i]! & UNCERTAIN) === 0) continue;
      if (filter.reopened && (results.reopened?.[i] ?? 0) === 0) continue;
      if (!filter.settled && isSettled(report, i)) continue;
      if (anyCell && !inCell([cellOf(report, i, 'a', byDiscipline), cellOf(report, i, 'b', byDiscipline)], filter.cell)) continue;
      if (matches && !matches(i)) continue;
      rows[n++] = i;
    }
    return rows.subarray(0, n);
  }

  /** Rows in an order. `worst` is what people have to decide about first. */
  sort(rows: Uint32Array, column: SortColumn, down: boolean): Uint32Array {
    const results = this.report.results;
    if (!results) return rows;
    const sign = down ? -1 : 1;
    const by = (value: (row: number) => number): Uint32Array => sortByValue(rows, (row) => sign * value(row));
    switch (column) {
      case 'number':
        return by((row) => row);
      case 'class':
        return by((row) => SEVERITY[results.class[row]!]!);
      case 'd':
        return by((row) => results.d[row]!);
      case 'relation':
        return by((row) => results.relation[row]!);
      case 'a':
        return by((row) => this.rank(results.a[row]!));
      case 'b':
        return by((row) => this.rank(results.b[row]!));
      case 'place':
        return by((row) => results.x[row]!);
      case 'status':
        return by((row) => results.status?.[row] ?? NONE8);
      case 'worst': {
        const deep = sortByValue(rows, (row) => results.d[row]!);
        return sortByValue(deep, (row) => SEVERITY[results.class[row]!]! + (isSettled(this.report, row) ? 10 : 0));
      }
    }
  }

  private name(object: number): string {
    this.names ??= Array.from<string>({ length: this.report.objects!.count });
    return (this.names[object] ??= objectName(this.report.objects!, object));
  }

  /** Objects that results name, in the order of their names. */
  private rank(object: number): number {
    if (!this.ranks) {
      const { objects, results } = this.report;
      const used = new Set<number>();
      for (let i = 0; i < results!.count; ++i) used.add(results!.a[i]!).add(results!.b[i]!);
      const collator = new Intl.Collator('en', { numeric: true });
      const sorted = [...used].sort((p, q) => collator.compare(this.name(p), this.name(q)) || p - q);
      this.ranks = new Float64Array(objects!.count);
      sorted.forEach((object_, i) => (this.ranks![object_] = i));
    }
    return this.ranks[object]!;
  }

  /** All words must stand in the names, ids, files, the key, the comment or the people of a result. */
  private matcher(text: string): ((row: number) => boolean) | undefined {
    const words = text.toLowerCase().split(/\s+/).filter(Boolean);
    if (words.length === 0) return undefined;
    const { objects, results, head } = this.report;
    const fileHas = head.files.map((file) => words.map((word) => shown(file).toLowerCase().includes(word)));
    // Of each object a bit for each word that it has; 0x80000000 marks one that was looked at.
    const found = new Uint32Array(objects!.count);
    const bitsOf = (object: number): number => {
      if (found[object] === 0) {
        const name = this.name(object).toLowerCase();
        const id = objects!.flags[object]! & 2 ? name : shown(objects!.id.at(object)).toLowerCase();
        let bits = 0x80000000;
        words.forEach((word, k) => {
          if (name.includes(word) || id.includes(word) || fileHas[objects!.file[object]!]![k]) bits |= 1 << k;
        });
        found[object] = bits >>> 0;
      }
      return found[object]!;
    };
    const lowerCase = new Map<number, string>();
    const textOf = (number: number): string => {
      if (!lowerCase.has(number)) lowerCase.set(number, shown(results!.texts?.at(number) ?? '').toLowerCase());
      return lowerCase.get(number)!;
    };
    const columns = [results!.comment, results!.assignee, results!.decided_by].filter((column) => column !== undefined);
    return (row) => {
      const bits = bitsOf(results!.a[row]!) | bitsOf(results!.b[row]!);
      return words.every((word, k) => {
        if (k < 31 && (bits >>> k) & 1) return true;
        if (columns.some((column) => column[row]! > 0 && textOf(column[row]!).includes(word))) return true;
        return word.length > 3 && results!.key.at(row).includes(word);
      });
    };
  }
}

/** The results of a group, in the order of the document. */
export function rowsOf(results: Results, group: number): Uint32Array {
  const rows: number[] = [];
  for (let i = 0; i < results.count; ++i) if (results.group?.[i] === group) rows.push(i);
  return Uint32Array.from(rows);
}

/** The severest result of a group, the deepest of several, or undefined where it has none. */
export function worstOf(results: Results, group: number): number | undefined {
  let worst: number | undefined;
  for (let i = 0; i < results.count; ++i) {
    if (results.group?.[i] !== group) continue;
    const more = worst === undefined ? -1 : SEVERITY[results.class[i]!]! - SEVERITY[results.class[worst]!]! || results.d[i]! - results.d[worst]!;
    if (more < 0) worst = i;
  }
  return worst;
}

/** HIT first, then what is too close; what touches is mostly meant. */
export const SEVERITY: readonly number[] = [0, 2, 1];
