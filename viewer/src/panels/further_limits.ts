// SPDX-License-Identifier: Apache-2.0
// What the list is limited to besides class and status: the pair of disciplines, the depth, the test.
import type { Filter } from '../data/filter.ts';
import { hasDisciplines, type Report, shown } from '../data/report.ts';
import { exact } from '../data/words.ts';
import { h } from '../ui/dom.ts';

/** A limit in words, and what takes it away. */
export type Pill = [string, () => void];

export class FurtherLimits {
  readonly element: HTMLDetailsElement;
  private readonly names: readonly string[];
  private readonly sides: HTMLSelectElement[];
  private readonly depths: HTMLInputElement[];
  private readonly test: HTMLSelectElement | undefined;
  private filter: Filter | undefined;

  /** `changed` is called when a limit of the filter that was told was set. */
  constructor(
    private readonly report: Report,
    changed: () => void,
  ) {
    const { head } = report;
    this.names = hasDisciplines(report) ? head.disciplines : head.files;
    const what = hasDisciplines(report) ? 'Discipline' : 'File';
    const set = (change: (filter: Filter) => void): void => {
      if (!this.filter) return;
      change(this.filter);
      changed();
    };
    this.sides = [0, 1].map((side) => select(`${what} of ${side === 0 ? 'one' : 'the other'} object`, this.names, (value) => set((f) => (f.cell[side] = value))));
    this.depths = [0, 1].map((end) => {
      const field = h('input', { type: 'number', step: 'any', inputmode: 'decimal', 'aria-label': end === 0 ? 'd from, in millimetres' : 'd to, in millimetres' });
      field.addEventListener('input', () => set((f) => (f.d[end] = Number.isFinite(field.valueAsNumber) ? field.valueAsNumber : undefined)));
      return field;
    });
    const tests = head.clash?.tests ?? [];
    if (tests.length > 1) this.test = select('Test', tests.map((t) => t.name), (value) => set((f) => (f.test = value)));
    this.element = h('details', { class: 'further' }, h('summary', {}, 'More limits'), h('div', { class: 'further-fields' },
      this.names.length > 1 && h('span', {}, 'Between ', this.sides[0]!, ' and ', this.sides[1]!),
      h('span', {}, 'd from ', this.depths[0]!, ' to ', this.depths[1]!, ' mm ', h('span', { class: 'hint' }, '(less than 0: how deep in each other)')),
      this.test && h('span', {}, 'Test ', this.test)));
  }

  /** Shows the limits of a filter, which the fields set from now on. */
  update(filter: Filter): void {
    this.filter = filter;
    this.sides.forEach((field, side) => (field.value = String(filter.cell[side] ?? '')));
    this.depths.forEach((field, end) => (field.value = filter.d[end] === undefined ? '' : String(filter.d[end])));
    if (this.test) this.test.value = String(filter.test ?? '');
  }

  /** The limits that are set. */
  pills(filter: Filter): Pill[] {
    const list: Pill[] = [];
    const [p, q] = filter.cell;
    const name = (side: number): string => shown(this.names[side]!).slice(0, 80);
    if (p !== undefined && q !== undefined) list.push([`${name(p)} with ${name(q)}`, () => (filter.cell = [undefined, undefined])]);
    else if (p !== undefined || q !== undefined) list.push([`With ${name((p ?? q)!)}`, () => (filter.cell = [undefined, undefined])]);
    const [least, most] = filter.d;
    const ends = [least !== undefined && `from ${exact(least)}`, most !== undefined && `to ${exact(most)}`].filter(Boolean);
    if (ends.length > 0) list.push([`d ${ends.join(' ')} mm`, () => (filter.d = [undefined, undefined])]);
    if (filter.test !== undefined) list.push([`Test: ${shown(this.report.head.clash!.tests[filter.test]!.name).slice(0, 80) || 'the only one'}`, () => (filter.test = undefined)]);
    return list;
  }
}

function select(label: string, names: readonly string[], changed: (value: number | undefined) => void): HTMLSelectElement {
  const field = h('select', { 'aria-label': label }, h('option', { value: '' }, 'any'), ...names.map((name, i) => h('option', { value: i }, shown(name).slice(0, 60) || '–')));
  field.addEventListener('change', () => changed(field.value === '' ? undefined : Number(field.value)));
  return field;
}
