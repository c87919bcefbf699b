// SPDX-License-Identifier: Apache-2.0
// The table of results: sorted by a click on a column, gone through with the keys.
import { add, classMark, h } from '../ui/dom.ts';
import { VirtualRows } from './virtual_rows.ts';

/** A column; its id is what the table is sorted by. */
export interface Column<Id extends string> {
  id: Id;
  /** it has no order */
  unsorted?: boolean;
  label: string;
  title: string;
  /** how wide, as CSS grids have it */
  width: string;
  right?: boolean;
  cell(row: number): Node | string;
}

export interface TableEvents<Id extends string> {
  chosen(row: number): void;
  opened(row: number): void;
  sorted(column: Id, down: boolean): void;
  /** the space bar, where rows can be marked */
  marked?(row: number): void;
}

export const ROW_HEIGHT = 38;

/** A table of rows, which are numbers in the payload. */
export class ResultTable<Id extends string> {
  readonly element: HTMLElement;
  private readonly body = h('div', { role: 'rowgroup', class: 'rows' });
  private readonly header = h('div', { role: 'row', class: 'row header', 'aria-rowindex': 1 });
  private readonly virtual: VirtualRows;
  private rows = new Uint32Array(0);
  private current = -1;
  /** before which row steps go on while none is chosen */
  private next = 0;
  private sort: { column: Id | undefined; down: boolean } = { column: undefined, down: false };

  constructor(
    label: string,
    private readonly columns: readonly Column<Id>[],
    private readonly events: TableEvents<Id>,
    private readonly prefix: string,
  ) {
    const template = columns.map((c) => c.width).join(' ');
    this.header.style.gridTemplateColumns = template;
    this.element = h('div', {
      role: 'grid', class: `table table-${prefix} columns-${columns.length}`, tabindex: 0, 'aria-label': label, 'aria-colcount': columns.length,
      onkeydown: (event) => this.key(event),
    });
    add(this.element, h('div', { role: 'rowgroup', class: 'head' }, this.header), this.body);
    this.virtual = new VirtualRows(this.element, this.body, ROW_HEIGHT, ROW_HEIGHT, (index) => this.row(index, template));
    this.makeHeader();
  }

  show(rows: Uint32Array<ArrayBuffer>, keep: number): void {
    this.rows = rows;
    this.element.setAttribute('aria-rowcount', String(rows.length + 1));
    this.current = keep < 0 ? -1 : rows.indexOf(keep);
    this.next = 0;
    this.virtual.reset(rows.length);
    if (this.current >= 0) this.virtual.reveal(this.current);
    this.activate();
  }

  /** Leaves rows out. Who goes through the table goes on where they are. */
  keep(rows: Uint32Array<ArrayBuffer>): void {
    const chosen = this.rows[this.current];
    if (chosen !== undefined) {
      const left = new Set(rows);
      this.next = this.rows.subarray(0, this.current).filter((row) => left.has(row)).length;
    }
    this.rows = rows;
    this.element.setAttribute('aria-rowcount', String(rows.length + 1));
    this.current = chosen === undefined ? -1 : rows.indexOf(chosen);
    this.virtual.reset(rows.length, false);
    this.activate();
  }

  get shown(): Uint32Array {
    return this.rows;
  }

  setSort(column: Id, down: boolean): void {
    this.sort = { column, down };
    this.makeHeader();
  }

  /** Marks a row as the chosen one, where it is in the table. */
  choose(row: number): void {
    this.current = this.rows.indexOf(row);
    if (this.current >= 0) this.virtual.reveal(this.current);
    this.activate();
  }

  /** Goes on by so many rows. */
  step(by: number): void {
    if (this.rows.length === 0) return;
    // The one that was left out stood before the next.
    const from = this.current >= 0 ? this.current : by > 0 ? this.next - 1 : this.next;
    this.goTo(Math.min(this.rows.length - 1, Math.max(0, from + by)));
  }

  refresh(): void {
    this.virtual.refresh();
    this.activate();
  }

  private goTo(index: number): void {
    this.current = index;
    this.virtual.reveal(index);
    this.activate();
    this.events.chosen(this.rows[index]!);
  }

  private activate(): void {
    for (const row of this.body.querySelectorAll('[aria-selected="true"]')) row.setAttribute('aria-selected', 'false');
    const row = this.virtual.row(this.current);
    if (row) {
      row.setAttribute('aria-selected', 'true');
      this.element.setAttribute('aria-activedescendant', row.id);
    } else {
      this.element.removeAttribute('aria-activedescendant');
    }
  }

  private makeHeader(): void {
    this.header.replaceChildren(
      ...this.columns.map((column, i) => {
        const sorted = this.sort.column === column.id;
        return h(
          'div',
          { role: 'columnheader', 'aria-colindex': i + 1, 'aria-sort': column.unsorted ? undefined : sorted ? (this.sort.down ? 'descending' : 'ascending') : 'none', class: column.right ? 'right' : '' },
          column.unsorted ? h('span', { class: 'unsorted', title: column.title }, column.label) : h('button', { type: 'button', title: column.title, onclick: () => this.events.sorted(column.id, sorted && !this.sort.down) }, column.label, sorted && h('span', { 'aria-hidden': 'true', class: 'arrow' }, this.sort.down ? '▾' : '▴')),
        );
      }),
    );
  }

  private row(index: number, template: string): HTMLElement {
    const number = this.rows[index]!;
    const row = h('div', {
      role: 'row', class: 'row', id: `${this.prefix}-row-${index}`, 'aria-rowindex': index + 2, 'aria-selected': String(index === this.current),
      onclick: () => this.goTo(index), ondblclick: () => this.events.opened(number),
    });
    row.style.gridTemplateColumns = template;
    this.columns.forEach((column, i) => {
      const cell = h('div', { role: 'gridcell', 'aria-colindex': i + 1, class: column.right ? 'right' : '' });
      const content = column.cell(number);
      add(cell, content);
      if (typeof content === 'string' && content.length > 8) cell.title = content.slice(0, 300);
      row.append(cell);
    });
    return row;
  }

  private key(event: KeyboardEvent): void {
    if (event.target !== this.element || event.ctrlKey || event.metaKey || event.altKey) return;
    const page = this.virtual.rowsInView();
    const moves: Record<string, number> = { ArrowDown: 1, ArrowUp: -1, PageDown: page, PageUp: -page, Home: -Infinity, End: Infinity };
    const by = moves[event.key];
    if (by !== undefined) {
      event.preventDefault();
      this.step(by);
    } else if (event.key === 'Enter' && this.current >= 0) {
      event.preventDefault();
      this.events.opened(this.rows[this.current]!);
    } else if (event.key === ' ' && this.current >= 0 && this.events.marked) {
      event.preventDefault();
      this.events.marked(this.rows[this.current]!);
    }
  }
}

export function classCell(cls: number, word: string): HTMLElement {
  return h('span', { class: 'class-cell' }, classMark(cls), word);
}
