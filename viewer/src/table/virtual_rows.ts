// SPDX-License-Identifier: Apache-2.0
// A list of any number of rows of one height, of which only those in view are elements. Browsers clip what is higher than
// some ten million pixels, so a longer list is scrolled in proportion: its bar moves through all rows, and the wheel and the
// keys still go row by row. (Libraries for this keep a record of every row: 1.5 million take hundreds of megabytes.)

/** What any browser scrolls. */
export const HIGHEST = 8_000_000;

/** How far a list is scrolled, in pixels of all its rows, as its bar stands at `top`. */
export function offsetOf(top: number, total: number, view: number): number {
  if (total <= HIGHEST) return top;
  return (top / (HIGHEST - view)) * (total - view);
}

/** Where the bar stands, as a list is scrolled by `offset`. */
export function topOf(offset: number, total: number, view: number): number {
  if (total <= HIGHEST) return offset;
  return (offset / (total - view)) * (HIGHEST - view);
}

export class VirtualRows {
  private readonly spacer = document.createElement('div');
  private readonly made = new Map<number, HTMLElement>();
  private offset = 0;
  private expected = -1;
  private count_ = 0;
  private scheduled = false;

  constructor(
    private readonly scroller: HTMLElement,
    private readonly host: HTMLElement,
    readonly height: number,
    /** what of the scroller a header covers that stays in view */
    private readonly covered: number,
    private readonly make: (index: number) => HTMLElement,
  ) {
    this.spacer.className = 'spacer';
    scroller.append(this.spacer);
    host.classList.add('rows-host');
    scroller.addEventListener('scroll', () => {
      // Its own setting of the bar, rounded to a pixel, must not move it by rows.
      if (Math.abs(scroller.scrollTop - this.expected) > 1) {
        this.offset = offsetOf(scroller.scrollTop, this.total, this.view);
        this.expected = scroller.scrollTop;
      }
      this.schedule();
    });
    scroller.addEventListener(
      'wheel',
      (event) => {
        if (this.total <= HIGHEST || event.ctrlKey || event.deltaY === 0) return;
        event.preventDefault();
        this.scrollTo(this.offset + event.deltaY * (event.deltaMode === 1 ? this.height : event.deltaMode === 2 ? this.view : 1));
      },
      { passive: false },
    );
    new ResizeObserver(() => this.schedule()).observe(scroller);
  }

  get count(): number {
    return this.count_;
  }

  /** Other rows; the list stays where it is as far as it can. */
  reset(count: number, toTop = true): void {
    this.count_ = count;
    for (const row of this.made.values()) row.remove();
    this.made.clear();
    this.spacer.style.height = `${Math.min(this.total, HIGHEST)}px`;
    this.scrollTo(toTop ? 0 : this.offset);
    this.draw();
  }

  /** Makes the rows in view anew. */
  refresh(): void {
    for (const row of this.made.values()) row.remove();
    this.made.clear();
    this.draw();
  }

  /** Scrolls so far that a row is in view. */
  reveal(index: number): void {
    const [from, to] = [index * this.height, (index + 1) * this.height];
    if (from < this.offset) this.scrollTo(from);
    else if (to > this.offset + this.view) this.scrollTo(to - this.view);
    this.draw();
  }

  rowsInView(): number {
    return Math.max(1, Math.floor(this.view / this.height));
  }

  row(index: number): HTMLElement | undefined {
    return this.made.get(index);
  }

  private get total(): number {
    return this.count_ * this.height;
  }

  private get view(): number {
    return this.scroller.clientHeight - this.covered;
  }

  private scrollTo(offset: number): void {
    this.offset = Math.min(Math.max(0, offset), Math.max(0, this.total - this.view));
    this.scroller.scrollTop = topOf(this.offset, this.total, this.view);
    this.expected = this.scroller.scrollTop;
    this.schedule();
  }

  private schedule(): void {
    if (this.scheduled) return;
    this.scheduled = true;
    requestAnimationFrame(() => {
      this.scheduled = false;
      this.draw();
    });
  }

  private draw(): void {
    const from = Math.max(0, Math.floor(this.offset / this.height) - 4);
    const to = Math.min(this.count_, Math.ceil((this.offset + this.view) / this.height) + 4);
    for (const [index, row] of this.made) {
      if (index >= from && index < to) continue;
      row.remove();
      this.made.delete(index);
    }
    const shift = this.scroller.scrollTop - this.offset;
    let before: HTMLElement | null = this.host.firstElementChild as HTMLElement | null;
    for (let index = from; index < to; ++index) {
      let row = this.made.get(index);
      if (!row) {
        row = this.make(index);
        this.made.set(index, row);
        this.host.insertBefore(row, before);
      } else {
        before = row.nextElementSibling as HTMLElement | null;
      }
      row.style.transform = `translateY(${index * this.height + shift}px)`;
    }
  }
}
