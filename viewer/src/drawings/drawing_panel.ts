// SPDX-License-Identifier: Apache-2.0
// Drawings in tabs: layers to switch, moved and enlarged like a map, objects to pick.
import { openDrawing, type Report, shown } from '../data/report.ts';
import { plural } from '../data/words.ts';
import { fill, h, toggle } from '../ui/dom.ts';
import { type CleanDrawing, cleanSvg, type DrawingLayer } from './clean_svg.ts';
import { adopt } from './drawing_styles.ts';

export interface DrawingEvents {
  /** an object of a drawing, as a number of the page; undefined: it is not in the page */
  picked(object: number | undefined): void;
}

/** A switch for each style of objects, as a discipline is, in whatever layers its lines are. */
function styleToggles({ styles }: CleanDrawing): HTMLElement[] {
  return [...styles].map(([name, groups]) => toggle(shown(name), !groups[0]!.classList.contains('off-style'), (on) => {
    for (const group of groups) group.classList.toggle('off-style', !on);
  }, { class: 'style' }));
}

/** A switch for each layer; those of a view of a sheet are folded together. */
function layerToggles(layers: DrawingLayer[]): HTMLElement[] {
  const switchOf = ({ label, group }: DrawingLayer, text = label): HTMLElement =>
    toggle(shown(text), !group.classList.contains('off'), (on) => group.classList.toggle('off', !on));
  const all: HTMLElement[] = [];
  for (let i = 0; i < layers.length;) {
    const outer = layers[i]!;
    let end = i + 1;
    while (end < layers.length && layers[end]!.depth > outer.depth) ++end;
    const within = layers.slice(i + 1, end);
    const isView = outer.group.classList.contains('view');
    if (isView) all.push(h('details', { class: 'view-layers' }, h('summary', {}, shown(outer.label)), h('div', {}, switchOf(outer, 'All of it'), ...within.map((layer) => switchOf(layer)))));
    else all.push(switchOf(outer), ...within.map((layer) => switchOf(layer)));
    i = end;
  }
  return all;
}

export class DrawingPanel {
  readonly element = h('div', { class: 'drawings' });
  private readonly tabs = h('div', { class: 'tabs', role: 'tablist', 'aria-label': 'Drawings' });
  private readonly layers = h('fieldset', { class: 'layers' });
  private readonly paper = h('div', { class: 'paper', id: 'drawing-paper', role: 'tabpanel', tabindex: 0, 'aria-label': 'Drawing' });
  private readonly opened = new Map<number, CleanDrawing | string>();
  private current = -1;
  private marked: SVGElement[] = [];
  private wanted: number[] = [];
  private numbers: Map<string, number> | undefined;
  private box = { x: 0, y: 0, width: 1, height: 1 };

  constructor(
    private readonly report: Report,
    private readonly events: DrawingEvents,
  ) {
    const { drawings } = report.head;
    this.tabs.append(...drawings.map((drawing, i) =>
      h('button', { type: 'button', role: 'tab', 'aria-selected': 'false', 'aria-controls': 'drawing-paper', title: plural(drawing.objects, 'object'), onclick: () => void this.show(i) }, shown(drawing.title))));
    this.element.append(h('div', { class: 'drawing-bar' }, this.tabs, h('div', { class: 'buttons' },
      h('button', { type: 'button', class: 'small', title: 'Larger (+)', 'aria-label': 'Larger', onclick: () => this.zoom(0.7) }, '+'),
      h('button', { type: 'button', class: 'small', title: 'Smaller (−)', 'aria-label': 'Smaller', onclick: () => this.zoom(1.4) }, '−'),
      h('button', { type: 'button', class: 'small', title: 'The whole drawing (0)', onclick: () => this.fit() }, 'Fit'))), this.layers, this.paper);
    this.listen();
  }

  async show(number = Math.max(0, this.current)): Promise<void> {
    this.current = number;
    [...this.tabs.children].forEach((tab, i) => tab.setAttribute('aria-selected', String(i === number)));
    let drawing = this.opened.get(number);
    if (!drawing) {
      fill(this.paper, h('p', { class: 'opening' }, 'Opening the drawing…'));
      try {
        drawing = cleanSvg(await openDrawing(this.report.head, number), `drawing-${number}`) ?? 'This drawing is damaged: it is no SVG.';
        if (typeof drawing !== 'string') adopt(drawing.rules);
      } catch (error) {
        drawing = `This drawing cannot be shown. ${error instanceof Error ? error.message : ''}`;
      }
      this.opened.set(number, drawing);
      if (this.current !== number) return;
    }
    if (typeof drawing === 'string') {
      fill(this.paper, h('p', { class: 'opening', role: 'alert' }, drawing));
      fill(this.layers);
      return;
    }
    const { svg } = drawing;
    svg.setAttribute('aria-label', shown(this.report.head.drawings[number]!.title));
    svg.setAttribute('role', 'img');
    fill(this.paper, svg);
    fill(this.layers, h('legend', {}, 'Layers'), ...styleToggles(drawing), ...layerToggles(drawing.layers));
    this.fit();
    this.mark(this.wanted);
  }

  /** The drawing that is shown, all of it, for paper; undefined where none is. */
  copy(): HTMLElement | undefined {
    const drawing = this.opened.get(this.current);
    if (!drawing || typeof drawing === 'string') return undefined;
    const svg = drawing.svg.cloneNode(true) as SVGSVGElement;
    const { whole } = drawing.svg.dataset;
    if (whole) svg.setAttribute('viewBox', whole);
    return h('div', { class: 'paper print-drawing' }, svg, h('p', {}, 'Fitted to this paper: do not measure on it.'));
  }

  /** Marks objects in the drawing. */
  mark(objects: number[]): void {
    this.wanted = objects;
    for (const element of this.marked) element.classList.remove('marked', 'marked-b', 'marked-one');
    this.marked = [];
    const drawing = this.opened.get(this.current);
    if (!drawing || typeof drawing === 'string') return;
    for (const { id, file, element } of drawing.objects) {
      const number = this.numberOf(id, file);
      const at = number === undefined ? -1 : objects.indexOf(number);
      if (at < 0) continue;
      element.classList.add('marked');
      if (objects.length === 1) element.classList.add('marked-one');
      else if (at === 1) element.classList.add('marked-b');
      this.marked.push(element);
    }
  }

  zoom(factor: number): void {
    const { box } = this;
    this.view(box.x + (box.width * (1 - factor)) / 2, box.y + (box.height * (1 - factor)) / 2, box.width * factor, box.height * factor);
  }

  fit(): void {
    const drawing = this.opened.get(this.current);
    if (!drawing || typeof drawing === 'string') return;
    const given = (drawing.svg.dataset.whole ??= drawing.svg.getAttribute('viewBox') ?? '0 0 420 297').split(/[\s,]+/).map(Number);
    const [x, y, width, height] = given.length === 4 && given.every(Number.isFinite) ? (given as [number, number, number, number]) : [0, 0, 420, 297];
    drawing.svg.removeAttribute('width');
    drawing.svg.removeAttribute('height');
    this.view(x, y, width, height);
  }

  private view(x: number, y: number, width: number, height: number): void {
    const drawing = this.opened.get(this.current);
    if (!drawing || typeof drawing === 'string') return;
    this.box = { x, y, width, height };
    drawing.svg.setAttribute('viewBox', `${x} ${y} ${width} ${height}`);
  }

  private numberOf(id: string, file: string): number | undefined {
    if (!this.numbers) {
      this.numbers = new Map();
      const { objects, head } = this.report;
      for (let i = 0; objects && i < objects.count; ++i) this.numbers.set(`${head.files[objects.file[i]!]}\n${objects.id.at(i)}`, i);
    }
    return this.numbers.get(`${file}\n${id}`);
  }

  /** Pixels to the drawing's own units. */
  private unit(): number {
    return Math.max(this.box.width / Math.max(1, this.paper.clientWidth), this.box.height / Math.max(1, this.paper.clientHeight));
  }

  /** What has a line near a place of the screen, the nearest first: a line is thinner than a finger. */
  private near(x: number, y: number): SVGElement | undefined {
    for (let radius = 2; radius <= 8; radius += 2) {
      for (let i = 0; i < 12; ++i) {
        const found = document.elementFromPoint(x + radius * Math.cos((i * Math.PI) / 6), y + radius * Math.sin((i * Math.PI) / 6));
        const object = found?.closest<SVGElement>('.paper [data-id]');
        if (object) return object;
      }
    }
    return undefined;
  }

  private listen(): void {
    const fingers = new Map<number, { x: number; y: number }>();
    let moved = 0;
    this.paper.addEventListener('pointerdown', (e) => {
      fingers.set(e.pointerId, { x: e.clientX, y: e.clientY });
      moved = 0;
    });
    this.paper.addEventListener('pointermove', (e) => {
      const before = fingers.get(e.pointerId);
      if (!before) return;
      const now = { x: e.clientX, y: e.clientY };
      moved += Math.hypot(now.x - before.x, now.y - before.y);
      if (moved > 4) this.paper.setPointerCapture(e.pointerId);
      if (fingers.size === 1) {
        this.view(this.box.x - (now.x - before.x) * this.unit(), this.box.y - (now.y - before.y) * this.unit(), this.box.width, this.box.height);
      } else {
        const other = [...fingers].find(([id]) => id !== e.pointerId)![1];
        const was = Math.hypot(before.x - other.x, before.y - other.y);
        const is = Math.hypot(now.x - other.x, now.y - other.y);
        if (is > 1) this.zoom(was / is);
      }
      fingers.set(e.pointerId, now);
    });
    const up = (e: PointerEvent): void => {
      const was = fingers.delete(e.pointerId);
      if (!was || moved > 4 || e.type === 'pointercancel') return;
      const object = (e.target as Element).closest<SVGElement>('[data-id]') ?? this.near(e.clientX, e.clientY);
      this.events.picked(object ? this.numberOf(object.dataset.id!, object.dataset.file ?? '') : undefined);
    };
    this.paper.addEventListener('pointerup', up);
    this.paper.addEventListener('pointercancel', up);
    this.paper.addEventListener('wheel', (e) => {
      e.preventDefault();
      const frame = this.paper.getBoundingClientRect();
      const factor = Math.exp(e.deltaY * 0.0015);
      const unit = this.unit();
      const [x, y] = [this.box.x + this.box.width / 2 + (e.clientX - frame.left - frame.width / 2) * unit, this.box.y + this.box.height / 2 + (e.clientY - frame.top - frame.height / 2) * unit];
      this.view(x + (this.box.x - x) * factor, y + (this.box.y - y) * factor, this.box.width * factor, this.box.height * factor);
    }, { passive: false });
    this.paper.addEventListener('keydown', (e) => {
      const step = this.box.width / 12;
      const moves: Record<string, [number, number]> = { ArrowLeft: [-step, 0], ArrowRight: [step, 0], ArrowUp: [0, -step], ArrowDown: [0, step] };
      const by = moves[e.key];
      if (by) this.view(this.box.x + by[0], this.box.y + by[1], this.box.width, this.box.height);
      else if (e.key === '+') this.zoom(0.7);
      else if (e.key === '-') this.zoom(1.4);
      else if (e.key === '0') this.fit();
      else return;
      e.preventDefault();
    });
  }
}
