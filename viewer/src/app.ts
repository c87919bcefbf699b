// SPDX-License-Identifier: Apache-2.0
// Puts the panels together: what is chosen in one is shown in the others, and stands in the address.
import { noFilter, rowsOf, worstOf } from './data/filter.ts';
import { type Report, shown } from './data/report.ts';
import { DrawingPanel } from './drawings/drawing_panel.ts';
import { Live } from './live/live.ts';
import { groupDetails, markedDetails, objectDetails, resultDetails, type DetailEvents } from './panels/details.ts';
import { helpDialog } from './panels/help.ts';
import { ListPanel } from './panels/list_panel.ts';
import { overview } from './panels/overview.ts';
import { printSheet } from './panels/print_sheet.ts';
import { ScenePanel } from './panels/scene_panel.ts';
import { fill, h } from './ui/dom.ts';
import type { Vec } from './scene/items.ts';

/** Whether letters are typed into it. */
function isField(target: HTMLElement): boolean {
  return target instanceof HTMLSelectElement || target instanceof HTMLTextAreaElement || (target instanceof HTMLInputElement && target.type !== 'range');
}

type Place = 'overview' | 'list' | 'drawings';
const THEMES = ['auto', 'light', 'dark'] as const;

export class App {
  private readonly scene: ScenePanel;
  private readonly list: ListPanel | undefined;
  private readonly drawings: DrawingPanel | undefined;
  private readonly details = h('aside', { class: 'details-panel', 'aria-label': 'Details', tabindex: 0 });
  private readonly views: Partial<Record<Place, HTMLElement>> = {};
  private readonly tabs: Partial<Record<Place, HTMLButtonElement>> = {};
  private readonly help = helpDialog();
  private readonly live: Live | undefined;
  private readonly printed = h('div', { class: 'print-only' });
  private place: Place = 'overview';
  private row: number | undefined;
  private addressTimer: ReturnType<typeof setTimeout> | undefined;
  /** what the details tell, and of which results */
  private shownDetails: { rows: ArrayLike<number>; make(): HTMLElement } | undefined;

  constructor(
    private readonly report: Report,
    private readonly root: HTMLElement,
  ) {
    this.scene = new ScenePanel(report, { picked: (object) => this.pick(object) });
    this.live = Live.of(report, {
      shown: () => this.list?.listed.rows ?? new Uint32Array(0),
      changed: () => this.list?.refresh(),
      decide: (rows) => this.showDetails(rows, () => markedDetails(rows.length)),
      decided: (rows) => this.redecided(rows),
    });
    this.live?.explain(this.help);
    if (report.results) {
      this.list = new ListPanel(report, {
        chosen: (row) => this.choose(row, true),
        opened: (row) => {
          this.choose(row, true);
          this.scene.fly();
        },
        group: (group) => this.showGroup(group),
      }, this.live?.marks);
    }
    if (report.head.drawings.length > 0) this.drawings = new DrawingPanel(report, { picked: (object) => this.pick(object) });
    this.build();
    this.listen();
  }

  start(): void {
    this.list?.update();
    this.showHint();
    const { clash, scene } = this.report.head;
    if (!this.followAddress()) this.go(clash ? 'overview' : this.drawings ? 'drawings' : scene ? 'list' : 'overview');
    void this.scene.open();
    this.live?.start();
  }

  private build(): void {
    const { head } = this.report;
    const names: [Place, string, boolean][] = [['overview', 'Overview', true], ['list', this.list ? 'Clashes' : 'Model', !!this.list || !!head.scene], ['drawings', 'Drawings', !!this.drawings]];
    for (const [place, label, there] of names) {
      if (there) this.tabs[place] = h('button', { type: 'button', role: 'tab', 'aria-selected': 'false', id: `tab-${place}`, 'aria-controls': `view-${place}`, onclick: () => this.go(place) }, label);
    }
    const panel = (place: Place, content: HTMLElement): HTMLElement => {
      const element = h('div', { role: 'tabpanel', id: `view-${place}`, class: `view view-${place}`, 'aria-labelledby': `tab-${place}`, hidden: true }, content);
      this.views[place] = element;
      return element;
    };
    const theme = h('button', { type: 'button', class: 'small', onclick: () => this.nextTheme(theme) }, 'Auto');
    theme.setAttribute('aria-label', 'Auto: light or dark as the system has it');
    fill(
      this.root,
      h('header', { class: 'top' },
        h('div', { class: 'brand' }, h('span', { class: 'logo', 'aria-hidden': 'true' }), h('h1', {}, shown(head.title).slice(0, 200))),
        h('div', { class: 'tabs main-tabs', role: 'tablist', 'aria-label': 'Parts of the report' }, ...Object.values(this.tabs)),
        h('div', { class: 'buttons' },
          theme,
          h('button', { type: 'button', class: 'small', title: 'Print (P)', onclick: () => window.print() }, 'Print'),
          h('button', { type: 'button', class: 'small', title: 'Help (?)', onclick: () => this.help.showModal() }, 'Help'))),
      this.live?.bar,
      h('main', {},
        panel('overview', this.overview()),
        panel('list', h('div', { class: `work${this.list ? '' : ' no-list'}` }, this.list?.element, h('div', { class: 'right-side' }, this.scene.element, this.details))),
        ...(this.drawings ? [panel('drawings', this.drawings.element)] : [])),
      h('footer', { class: 'foot' }, [shown(head.program), head.made && shown(head.made).slice(0, 40), 'all lengths in millimetres'].filter(Boolean).join(' · ')),
      this.help,
      this.printed,
    );
  }

  private overview(): HTMLElement {
    return overview(this.report, {
      showClass: (cls) => this.limit((f) => f.classes.add(cls)),
      showCell: (cell) => this.limit((f) => (f.cell = cell)),
      showTest: (test) => this.limit((f) => (f.test = test)),
      showStatus: (status) => this.limit((f) => f.statuses.add(status)),
    });
  }

  /** Decisions about rows are others now. */
  private redecided(rows: readonly number[]): void {
    const before = this.views.overview!;
    const { scrollTop } = before.firstElementChild!;
    fill(before, this.overview());
    before.firstElementChild!.scrollTop = scrollTop;
    this.list?.redecided();
    const shownDetails = this.shownDetails;
    if (!shownDetails) return;
    const changed = new Set(rows);
    for (let i = 0; i < shownDetails.rows.length; ++i) {
      if (!changed.has(shownDetails.rows[i]!)) continue;
      this.live?.keepFocus(() => this.fillDetails());
      return;
    }
  }

  /** Tells something in the details. Where that is about results, these can be decided about. */
  private showDetails(rows: ArrayLike<number>, make: () => HTMLElement): void {
    this.shownDetails = { rows, make };
    this.live?.about(rows);
    this.fillDetails();
    this.details.scrollTop = 0;
  }

  private fillDetails(): void {
    const { rows, make } = this.shownDetails!;
    const details = make();
    if (rows.length > 0) this.live?.place(details);
    fill(this.details, details);
  }

  private listen(): void {
    window.addEventListener('hashchange', () => this.followAddress());
    window.addEventListener('keydown', (event) => this.key(event));
    window.addEventListener('beforeprint', () => this.print());
    window.addEventListener('afterprint', () => fill(this.printed));
    window.matchMedia('(prefers-color-scheme: dark)').addEventListener('change', () => this.scene.theme());
  }

  /** What is looked at is printed: the drawing, or the list, with the chosen clash before it. */
  private print(): void {
    const drawing = this.place === 'drawings' ? this.drawings?.copy() : undefined;
    const chosen = this.place === 'list' && this.row !== undefined
      ? h('div', { class: 'print-chosen' }, this.scene.print(), resultDetails(this.report, this.row, this.detailEvents()))
      : undefined;
    fill(this.printed, drawing ?? printSheet(this.report, this.list?.listed ?? { rows: new Uint32Array(0), groups: undefined }, chosen));
  }

  private go(place: Place): void {
    this.place = place;
    for (const [name, view] of Object.entries(this.views)) view.hidden = name !== place;
    for (const [name, tab] of Object.entries(this.tabs)) tab.setAttribute('aria-selected', String(name === place));
    // The details go where they are looked at.
    (place === 'drawings' ? this.views.drawings! : this.views.list?.querySelector('.right-side'))?.append(this.details);
    if (place === 'drawings') void this.drawings?.show();
    if (place === 'list') this.list?.refresh();
  }

  private limit(change: (filter: ReturnType<typeof noFilter>) => unknown): void {
    this.list?.limit((filter) => {
      Object.assign(filter, noFilter());
      change(filter);
    });
    this.go('list');
  }

  /** Shows a clash everywhere. */
  private choose(row: number, fly: boolean): void {
    this.row = row;
    const results = this.report.results!;
    this.showDetails([row], () => resultDetails(this.report, row, this.detailEvents()));
    this.scene.showResult(row, fly);
    this.drawings?.mark([results.a[row]!, results.b[row]!]);
    this.setAddress(`#clash=${results.key.at(row)}`);
  }

  private pick(object: number | undefined): void {
    if (object === undefined) {
      this.clear();
      return;
    }
    this.row = undefined;
    this.showDetails([], () => objectDetails(this.report, object, this.scene.hasShape(object), this.detailEvents(object)));
    this.scene.showObject(object, false);
    this.drawings?.mark([object]);
  }

  private clear(): void {
    this.row = undefined;
    this.scene.showNothing();
    this.drawings?.mark([]);
    this.showHint();
    this.setAddress(' ');
  }

  /** The address is a link to what is chosen. Whoever runs through the list does not wait for it. */
  private setAddress(address: string): void {
    clearTimeout(this.addressTimer);
    this.addressTimer = setTimeout(() => {
      try {
        history.replaceState(null, '', address);
      } catch {
        // A browser that has had enough of it keeps the address; the page has a button for the link.
      }
    }, 100);
  }

  private showHint(): void {
    this.showDetails([], () => h('p', { class: 'hint' }, `Choose ${[this.list && 'a clash in the list', this.report.head.scene && 'an object in the model', this.drawings && 'an object in a drawing'].filter(Boolean).join(', or ')}.`));
  }

  private detailEvents(object?: number): DetailEvents {
    return {
      step: (by) => this.list?.step(by),
      fly: () => {
        this.go('list');
        if (object === undefined) this.scene.fly();
        else this.scene.showObject(object, true);
      },
      object: (o) => this.pick(o),
      showAllOf: (o) => this.limit((f) => (f.object = o)),
      group: (g) => this.limit((f) => (f.group = g)),
      link: (key) => `${location.href.replace(/#.*$/, '')}#clash=${key}`,
    };
  }

  private showGroup(group: number): void {
    const groups = this.report.groups!;
    this.row = undefined;
    const results = this.report.results!;
    this.showDetails(rowsOf(results, group), () => groupDetails(this.report, group, this.detailEvents()));
    const worst = worstOf(results, group);
    // One of the group stands for it, in colour, amid the place of all of them.
    this.drawings?.mark(worst === undefined ? [] : [results.a[worst]!, results.b[worst]!]);
    this.scene.showPlace(worst, groups.min.map((v) => v[group]!) as Vec, groups.max.map((v) => v[group]!) as Vec);
  }

  /** Goes where the address says; false where it says nothing. */
  private followAddress(): boolean {
    const key = /^#clash=([0-9a-z]+)$/.exec(location.hash)?.[1];
    if (!key || !this.report.results) return false;
    const row = this.report.results.key.find(key);
    this.go('list');
    if (row < 0) {
      this.showDetails([], () => h('p', { class: 'note', role: 'alert' }, 'This report has no clash of the key that the link names. It may be mended, or the link is of another model.'));
      return true;
    }
    this.choose(row, true);
    this.list?.choose(row);
    return true;
  }

  private nextTheme(button: HTMLButtonElement): void {
    const now = document.documentElement.dataset.theme ?? 'auto';
    const next = THEMES[(THEMES.indexOf(now as 'auto') + 1) % THEMES.length]!;
    if (next === 'auto') delete document.documentElement.dataset.theme;
    else document.documentElement.dataset.theme = next;
    button.textContent = next[0]!.toUpperCase() + next.slice(1);
    button.setAttribute('aria-label', next === 'auto' ? 'Auto: light or dark as the system has it' : `${button.textContent}: always ${next}`);
    this.scene.theme();
  }

  private key(event: KeyboardEvent): void {
    const target = event.target as HTMLElement;
    // A panel has taken it already.
    if (event.defaultPrevented || event.ctrlKey || event.metaKey || event.altKey || this.help.open) return;
    if (event.key === 'Escape') {
      if (isField(target)) target.blur();
      else if (!this.scene.giveUp()) this.clear();
      return;
    }
    if (isField(target)) return;
    const key = event.key.toLowerCase();
    if (event.key === '?') this.help.showModal();
    else if (event.key === '/' && this.list) {
      this.go('list');
      this.list.search.focus();
    } else if (key === 'j' || key === 'k') {
      this.go('list');
      this.list?.step(key === 'j' ? 1 : -1);
    } else if (key === 'p') window.print();
    else if (event.key === 'Enter' && this.row !== undefined && !target.closest('button, a, summary')) this.scene.fly();
    else if (this.place !== 'list' || !this.scene.shortcut(key)) return;
    event.preventDefault();
  }
}
