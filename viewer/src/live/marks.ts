// SPDX-License-Identifier: Apache-2.0
// Rows of the list that are marked, to be decided about together.
import { plural } from '../data/words.ts';
import { fill, h } from '../ui/dom.ts';

export interface MarkEvents {
  /** the rows that the list shows, in its order */
  shown(): Uint32Array;
  /** rows look otherwise now */
  changed(): void;
  decide(rows: Uint32Array): void;
}

export class Marks {
  readonly bar = h('div', { class: 'marks buttons', role: 'group', 'aria-label': 'Marked clashes' });
  private readonly status = h('span', { role: 'status', class: 'marks-told' });
  private readonly marked = new Set<number>();
  private last = -1;

  constructor(private readonly events: MarkEvents) {
    this.updateStatus();
  }

  /** A cell with the mark of its row before what it says. */
  cell(row: number, content: HTMLElement): HTMLElement {
    const box = h('input', { type: 'checkbox', tabindex: -1, class: 'mark-box', 'aria-label': 'Marked' });
    box.checked = this.marked.has(row);
    box.addEventListener('click', (event) => {
      event.stopPropagation();
      if (event.shiftKey) this.range(row, box.checked);
      else this.set([row], box.checked);
      this.last = row;
    });
    box.addEventListener('dblclick', (event) => event.stopPropagation());
    return h('span', { class: 'marked-cell' }, box, content);
  }

  toggle(row: number): void {
    this.set([row], !this.marked.has(row));
    this.last = row;
  }

  clear(): void {
    this.marked.clear();
    this.updateStatus();
    this.events.changed();
  }

  private set(rows: Iterable<number>, on: boolean): void {
    for (const row of rows) {
      if (on) this.marked.add(row);
      else this.marked.delete(row);
    }
    this.updateStatus();
    this.events.changed();
  }

  /** From the row that was marked last to this one, as they are listed. */
  private range(row: number, on: boolean): void {
    const rows = this.events.shown();
    const [from, to] = [rows.indexOf(this.last), rows.indexOf(row)];
    this.set(from < 0 ? [row] : rows.subarray(Math.min(from, to), Math.max(from, to) + 1), on);
  }

  private updateStatus(): void {
    const count = this.marked.size;
    this.status.textContent = count === 0 ? '' : `${plural(count, 'clash', 'clashes')} marked`;
    const button = (label: string, title: string, act: () => void): HTMLElement => h('button', { type: 'button', class: 'small', title, onclick: act }, label);
    const focused = this.bar.contains(document.activeElement) ? document.activeElement!.textContent : undefined;
    fill(
      this.bar,
      button('Mark all', 'Mark all clashes that the list shows', () => this.set(this.events.shown(), true)),
      count > 0 && button('Mark none', 'Take all marks away', () => this.clear()),
      count > 0 && button('Decide', 'Decide about the marked clashes', () => this.events.decide(Uint32Array.from(this.marked).sort())),
      this.status,
    );
    if (focused !== undefined) ([...this.bar.querySelectorAll('button')].find((b) => b.textContent === focused) ?? this.bar.querySelector('button'))?.focus();
  }
}
