// SPDX-License-Identifier: Apache-2.0
// The decisions of a report as they are now: the columns of the page, written over as the project tells changes.
import { TextColumn } from '../payload/columns.ts';
import { NONE16, NONE8, type Results } from '../payload/payload.ts';
import type { ClashState } from './api.ts';

/** Texts of the page with more behind them. */
export class GrowingTexts extends TextColumn {
  private readonly more: string[] = [];
  private readonly numbers = new Map<string, number>();

  constructor(private readonly base: TextColumn | undefined) {
    super(new Uint8Array(0), new Uint32Array(0));
    // Number 0 is no text, as in pages that have some.
    if (!base || base.length === 0) this.more.push('');
  }

  override get length(): number {
    return (this.base?.length ?? 0) + this.more.length;
  }

  override at(index: number): string {
    const count = this.base?.length ?? 0;
    return index < count ? this.base!.at(index) : (this.more[index - count] ?? '');
  }

  /** The number of a text. */
  number(text: string): number {
    if (text === '') return 0;
    const known = this.numbers.get(text);
    if (known !== undefined) return known;
    const made = this.length;
    this.more.push(text);
    this.numbers.set(text, made);
    return made;
  }
}

const ACTIVE = 1;

export class Decisions {
  private readonly texts: GrowingTexts;
  private rows: Map<string, number> | undefined;

  constructor(private readonly results: Results) {
    const { count, allowed } = results;
    this.texts = new GrowingTexts(results.texts);
    results.texts = this.texts;
    results.status ??= new Uint8Array(count).map((_, row) => ((allowed?.[row] ?? NONE16) === NONE16 ? 0 : NONE8));
    for (const name of ['decided_by', 'decided_on', 'assignee', 'comment'] as const) results[name] ??= new Uint32Array(count);
  }

  /** The row of a clash, or undefined where the page does not have it. */
  row(key: string): number | undefined {
    if (!this.rows) {
      this.rows = new Map();
      for (let row = this.results.count; row-- > 0;) this.rows.set(this.results.key.at(row), row);
    }
    return this.rows.get(key);
  }

  /** Writes what clashes say now, and returns the rows that changed. */
  apply(clashes: readonly ClashState[]): number[] {
    const { results, texts } = this;
    const changed: number[] = [];
    for (const clash of clashes) {
      const row = this.row(clash.key);
      if (row === undefined) continue;
      changed.push(row);
      const untouched = clash.status <= ACTIVE && clash.by === '' && clash.assignee === '' && clash.comment === '';
      const isAllowed = (results.allowed?.[row] ?? NONE16) !== NONE16;
      results.status![row] = untouched && isAllowed ? NONE8 : clash.status;
      if (results.reopened) results.reopened[row] = 0;
      results.decided_by![row] = texts.number(clash.by);
      results.decided_on![row] = texts.number(clash.on);
      results.assignee![row] = texts.number(clash.assignee);
      results.comment![row] = texts.number(clash.comment);
    }
    return changed;
  }

  /** What several rows have in common of a text; undefined where they differ. */
  common(column: 'assignee' | 'comment', rows: ArrayLike<number>): string | undefined {
    const numbers = this.results[column]!;
    const first = this.texts.at(numbers[rows[0]!]!);
    for (let i = 1; i < rows.length; ++i) if (numbers[rows[i]!] !== numbers[rows[0]!] && this.texts.at(numbers[rows[i]!]!) !== first) return undefined;
    return first;
  }

  /** The status that several rows have; undefined where they differ, or have none. */
  commonStatus(rows: ArrayLike<number>): number | undefined {
    const status = this.results.status!;
    for (let i = 0; i < rows.length; ++i) if (status[rows[i]!] !== status[rows[0]!] || status[rows[i]!] === NONE8) return undefined;
    return status[rows[0]!];
  }
}
