// SPDX-License-Identifier: Apache-2.0
// The list of results or of groups, with what it is limited to.
import { type Filter, isSettled, noFilter, Rows, type SortColumn } from '../data/filter.ts';
import { filterGroups, type GroupColumn, type GroupCounts, namedGroups, sortGroups } from '../data/groups.ts';
import { disciplineOf, fileName, objectName, type Report, shown } from '../data/report.ts';
import { CLASS_PLURALS, CLASS_WORDS, coordinate, count, length, plural, STATUS_WORDS } from '../data/words.ts';
import { NONE8 } from '../payload/payload.ts';
import type { Marks } from '../live/marks.ts';
import { classCell, type Column, ResultTable } from '../table/result_table.ts';
import { classMark, fill, h, shortName, toggle, wrappedName } from '../ui/dom.ts';
import { FurtherLimits } from './further_limits.ts';
import type { Listed } from './print_sheet.ts';

export interface ListEvents {
  chosen(row: number): void;
  opened(row: number): void;
  group(group: number): void;
}

/** How many characters the longest of some coordinates has: one that is cut would read as another number. */
function mostDigits(values: Float64Array): number {
  let [least, most] = [0, 0];
  for (const v of values) {
    if (v < least) least = v;
    else if (v > most) most = v;
  }
  return Math.max(coordinate(least).length, coordinate(most).length);
}

export class ListPanel {
  readonly element: HTMLElement;
  readonly search = h('input', { type: 'search', placeholder: 'Search names, ids, files, comments', 'aria-label': 'Search', spellcheck: 'false', autocomplete: 'off' });
  readonly rows: Rows;
  filter: Filter = noFilter();
  private readonly table: ResultTable<SortColumn>;
  private readonly groupTable: ResultTable<GroupColumn | 'list'> | undefined;
  private readonly further: FurtherLimits;
  private readonly bar = h('div', { class: 'filters' });
  private readonly pills = h('div', { class: 'pills' });
  private readonly counted = h('p', { class: 'counted', role: 'status' });
  private readonly holder = h('div', { class: 'table-holder' });
  private sort: { column: SortColumn; down: boolean } = { column: 'worst', down: false };
  private groupSort: { column: GroupColumn; down: boolean } = { column: 'worst', down: false };
  private groupCounts: GroupCounts | undefined;
  private groupsShown = false;
  private current = -1;
  private timer: ReturnType<typeof setTimeout> | undefined;

  constructor(
    private readonly report: Report,
    events: ListEvents,
    private readonly marks?: Marks,
  ) {
    this.rows = new Rows(report);
    this.table = new ResultTable('Results', this.columns(), {
      chosen: (row) => {
        this.current = row;
        events.chosen(row);
      },
      opened: (row) => events.opened(row),
      ...(marks && { marked: (row: number) => marks.toggle(row) }),
      sorted: (column, down) => {
        this.sort = { column, down };
        this.table.setSort(column, down);
        this.update();
      },
    }, 'results');
    if (report.groups) {
      this.groupTable = new ResultTable('Groups', this.groupColumns(), {
        chosen: (group) => events.group(group),
        opened: (group) => this.showGroup(group),
        sorted: (column, down) => {
          if (column === 'list') return;
          this.groupSort = { column, down };
          this.groupTable!.setSort(column, down);
          this.update();
        },
      }, 'groups');
    }
    this.search.addEventListener('input', () => {
      clearTimeout(this.timer);
      this.timer = setTimeout(() => {
        this.filter.text = this.search.value;
        this.update();
      }, report.head.counts.results > 100000 ? 250 : 80);
    });
    this.further = new FurtherLimits(report, () => this.update());
    this.further.update(this.filter);
    this.makeBar();
    fill(this.holder, this.table.element);
    this.element = h('div', { class: 'list' }, h('div', { class: 'list-head' }, this.search, this.bar, this.pills, h('div', { class: 'list-foot' }, this.counted, this.further.element), marks?.bar), this.holder);
  }

  /** Limits the list, and shows it. */
  limit(change: (filter: Filter) => void): void {
    change(this.filter);
    this.search.value = this.filter.text;
    this.groupsShown = false;
    this.makeBar();
    this.further.update(this.filter);
    this.update();
  }

  /** Applies the filter and the order. */
  update(): void {
    const rows = this.rows.sort(this.rows.filter(this.filter), this.sort.column, this.sort.down);
    this.table.show(rows as Uint32Array<ArrayBuffer>, this.current);
    this.makePills();
    fill(this.holder, this.groupsShown && this.groupTable ? this.groupTable.element : this.table.element);
    this.updateCount(rows.length);
  }

  /** Says how much is listed, and lists the groups where these are looked at. */
  private updateCount(results: number): void {
    if (this.groupsShown) this.updateGroups(results);
    else this.setCount(results, this.report.head.counts.results, 'result');
  }

  /** What is listed now. */
  get listed(): Listed {
    return { rows: this.table.shown, groups: this.groupsShown ? { list: this.groupTable!.shown, counts: this.groupCounts! } : undefined };
  }

  choose(row: number): void {
    this.current = row;
    this.table.choose(row);
  }

  step(by: number): void {
    this.table.step(by);
  }

  refresh(): void {
    if (this.groupsShown) this.groupTable?.refresh();
    else this.table.refresh();
  }

  /** Shows other decisions. What is listed keeps its order, for who goes through it: what the limits do not let through any more is left out. */
  redecided(): void {
    const isLet = new Uint8Array(this.report.head.counts.results);
    const rows = this.rows.filter(this.filter);
    for (const row of rows) isLet[row] = 1;
    const { shown } = this.table;
    const kept = shown.filter((row) => isLet[row] === 1);
    if (kept.length < rows.length) this.update();
    else if (kept.length === shown.length) this.refresh();
    else {
      this.table.keep(kept);
      this.updateCount(kept.length);
    }
  }

  private setCount(shownRows: number, all: number, what: string): void {
    this.counted.textContent = shownRows === all ? plural(all, what) : `${count(shownRows)} of ${plural(all, what)}`;
  }

  /** Lists the results of a group that the table of groups counts. */
  private showGroup(group: number): void {
    const named = namedGroups(this.report, this.filter.text).has(group);
    this.limit((f) => Object.assign(f, { group }, named ? { text: '' } : {}));
  }

  private updateGroups(results: number): void {
    const { list, counts } = filterGroups(this.rows, this.filter);
    this.groupCounts = counts;
    this.groupTable!.show(sortGroups(this.report, list, counts, this.groupSort.column, this.groupSort.down) as Uint32Array<ArrayBuffer>, -1);
    this.setCount(list.length, this.report.groups!.count, 'group');
    if (counts.limited) this.counted.append(`, by ${plural(results, 'result')}`);
  }

  private makeBar(): void {
    const { report, filter } = this;
    const change = (): void => this.update();
    const counts = [0, 0, 0];
    for (const c of report.results?.class ?? []) ++counts[c]!;
    const kinds = [0, 2, 1].map((cls) => {
      const button = toggle('', filter.classes.has(cls), (on) => {
        if (on) filter.classes.add(cls);
        else filter.classes.delete(cls);
        change();
      });
      button.append(classMark(cls), ` ${CLASS_PLURALS[cls]} `, h('b', {}, count(counts[cls]!)));
      return button;
    });
    const statuses = report.results?.status ? STATUS_WORDS.map((word, s) => toggle(word, filter.statuses.has(s), (on) => {
      if (on) filter.statuses.add(s);
      else filter.statuses.delete(s);
      change();
    }, { class: `status-${s}` })) : [];
    const anySettled = !!report.results?.status || !!report.results?.allowed;
    fill(
      this.bar,
      this.groupTable && h('div', { class: 'segments', role: 'group', 'aria-label': 'Results or groups' },
        ...[false, true].map((groups) => h('button', { type: 'button', 'aria-pressed': String(this.groupsShown === groups), onclick: () => {
          this.groupsShown = groups;
          // One looks for a group, not into one.
          if (groups) this.filter.group = undefined;
          this.makeBar();
          this.update();
        } }, groups ? 'Groups' : 'Results'))),
      ...kinds,
      ...statuses,
      anySettled && toggle('Open only', !filter.settled, (on) => {
        filter.settled = !on;
        change();
      }, { title: 'Without what a rule allows or people approved' }),
      toggle('Uncertain', filter.uncertain, (on) => {
        filter.uncertain = on;
        change();
      }, { title: 'Only results that may be of a severer class' }),
      report.results?.reopened && toggle('Came back', filter.reopened, (on) => {
        filter.reopened = on;
        change();
      }, { title: 'Only what was decided once and is worse or there again' }),
    );
  }

  private makePills(): void {
    const { filter, report } = this;
    const pill = (label: string, clear: () => void): HTMLElement =>
      h('button', { type: 'button', class: 'pill', title: 'Take this limit away', onclick: () => {
        clear();
        this.further.update(filter);
        this.update();
      } }, label, h('span', { 'aria-hidden': 'true' }, ' ✕'));
    const list: HTMLElement[] = this.further.pills(filter).map(([label, clear]) => pill(label, clear));
    if (filter.group !== undefined) list.push(pill(`Group: ${shown(report.groups!.name.at(filter.group)).slice(0, 80)}`, () => (filter.group = undefined)));
    if (filter.object !== undefined) list.push(pill(`Object: ${objectName(report.objects!, filter.object).slice(0, 80)}`, () => (filter.object = undefined)));
    fill(this.pills, ...list);
  }

  private classOf(row: number): HTMLElement {
    const cls = this.report.results!.class[row]!;
    const cell = classCell(cls, CLASS_WORDS[cls]!);
    return this.marks ? this.marks.cell(row, cell) : cell;
  }

  private columns(): Column<SortColumn>[] {
    const results = this.report.results!;
    const objects = this.report.objects!;
    const name = (object: number, row: number, side: 'a' | 'b'): Node => {
      const discipline = disciplineOf(this.report, row, side);
      const below = discipline >= 0 ? shown(this.report.head.disciplines[discipline]!) : this.report.head.files.length > 1 ? fileName(this.report, object) : '';
      const words = objectName(objects, object).slice(0, 200);
      return h('span', { class: 'object-cell' }, below === '' ? wrappedName(words) : shortName(words), below !== '' && h('small', {}, below.slice(0, 60)));
    };
    const widest = [results.x, results.y, results.z].reduce((n, v) => n + mostDigits(v), 4);
    const columns: Column<SortColumn>[] = [
      { id: 'class', label: 'Class', title: 'What it is', width: this.marks ? '7.4rem' : '6rem', cell: (r) => this.classOf(r) },
      { id: 'd', label: 'd mm', title: 'Distance; less than 0 is depth', width: '4.6rem', right: true, cell: (r) => length(results.d[r]!) },
      { id: 'a', label: 'Object A', title: 'The one object', width: 'minmax(5rem, 1fr)', cell: (r) => name(results.a[r]!, r, 'a') },
      { id: 'b', label: 'Object B', title: 'The other object', width: 'minmax(5rem, 1fr)', cell: (r) => name(results.b[r]!, r, 'b') },
      { id: 'place', label: 'Place mm', title: 'x, y, z', width: `${Math.max(7, 0.54 * widest + 0.6).toFixed(1)}rem`, right: true, cell: (r) => `${coordinate(results.x[r]!)}  ${coordinate(results.y[r]!)}  ${coordinate(results.z[r]!)}` },
    ];
    if (results.status || results.allowed) {
      columns.push({ id: 'status', label: 'Status', title: 'What was decided', width: '5.6rem', cell: (r) => {
        const status = results.status?.[r] ?? NONE8;
        if (status !== NONE8) return h('span', { class: `chip status-${status}` }, STATUS_WORDS[status]!);
        return isSettled(this.report, r) ? h('span', { class: 'chip' }, 'Allowed') : '';
      } });
    }
    return columns;
  }

  private groupColumns(): Column<GroupColumn | 'list'>[] {
    const groups = this.report.groups!;
    // The numbers of what the limits let through; how many there are of all stands beside them.
    const of = (g: number, get: (counts: GroupCounts) => ArrayLike<number>): number => get(this.groupCounts!)[g]!;
    const number = (id: 'hits' | 'near', label: string, title: string, width: string): Column<GroupColumn> => ({ id, label, title, width, right: true, cell: (g) => count(of(g, (c) => c[id])) });
    return [
      { id: 'class', label: 'Worst', title: 'The worst class in it', width: '6.6rem', cell: (g) => classCell(of(g, (c) => c.class), CLASS_WORDS[of(g, (c) => c.class)]!) },
      { id: 'd', label: 'd mm', title: 'The least of the worst class', width: '4.6rem', right: true, cell: (g) => length(of(g, (c) => c.d)) },
      { id: 'name', label: 'Group', title: 'What it is about', width: 'minmax(8rem, 2fr)', cell: (g) => shortName(shown(groups.name.at(g)).slice(0, 200)) },
      { id: 'results', label: 'Results', title: 'How many results it has', width: '5.6rem', right: true, cell: (g) => {
        const [some, all] = [of(g, (c) => c.results), groups.results[g]!];
        return some === all ? count(all) : `${count(some)} of ${count(all)}`;
      } },
      number('hits', 'Hits', 'How many of them are hits', '4rem'),
      number('near', 'Too close', 'How many of them are too close', '5.4rem'),
      { id: 'list', unsorted: true, label: 'Show', title: 'Its results', width: '4.4rem', cell: (g) => h('button', { type: 'button', class: 'small', tabindex: -1, onclick: (event) => {
        event.stopPropagation();
        this.showGroup(g);
      } }, 'List') },
    ];
  }
}
