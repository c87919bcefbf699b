// SPDX-License-Identifier: Apache-2.0
// The model with its tools. What cannot be drawn is said in its place, and the rest of the page goes on.
import { openModel, objectName, type Report, withoutModel } from '../data/report.ts';
import { length } from '../data/words.ts';
import type { Vec } from '../scene/items.ts';
import type { Others, Shown } from '../scene/view.ts';
import { View } from '../scene/view.ts';
import { fill, h, toggle } from '../ui/dom.ts';

export interface SceneEvents {
  picked(object: number | undefined): void;
}

const OTHERS: [Others, string][] = [['ghost', 'Ghosts'], ['solid', 'Solid'], ['hide', 'Hidden']];

/** What is drawn of a result. */
export function shownOf(report: Report, row: number): Shown {
  const results = report.results!;
  const at: Vec = [results.x[row]!, results.y[row]!, results.z[row]!];
  const d = results.d[row]!;
  const { witness } = results;
  const kind = witness?.kind[row];
  let arrow: Shown['arrow'];
  if (witness && kind === 0) {
    arrow = { from: witness.p.map((p) => p[row]!) as Vec, to: witness.q.map((q) => q[row]!) as Vec, depth: false };
  } else if (witness && kind === 1) {
    arrow = { from: at, to: at.map((v, k) => v - witness.q[k]![row]! * d) as Vec, depth: true };
  }
  return { a: results.a[row]!, b: results.b[row]!, at, arrow };
}

export class ScenePanel {
  readonly element = h('div', { class: 'scene' });
  private readonly stage = h('div', { class: 'stage' });
  private readonly canvas = h('canvas', { tabindex: 0, role: 'application', 'aria-label': 'The model. Arrow keys turn it, with Shift they move it, plus and minus bring it nearer and farther, Enter picks what is in the middle.' });
  /** where Enter picks, as long as the keys are in the model */
  private readonly cross = h('div', { class: 'cross', 'aria-hidden': 'true' });
  private readonly picked = h('div', { class: 'unseen', role: 'status' });
  private readonly label = h('div', { class: 'depth-label', hidden: true });
  private readonly note = h('div', { class: 'stage-note', role: 'status' });
  private readonly legend = h('div', { class: 'legend-pair', hidden: true });
  private readonly measured = h('div', { class: 'measure', role: 'status', hidden: true });
  private readonly sectionSize = h('input', { type: 'range', min: 0, max: 100, value: 45 });
  private readonly sectionTools = h('label', { class: 'section-tools', hidden: true }, 'Size of the box ', this.sectionSize);
  private sectionButton: HTMLButtonElement | undefined;
  private measureButton: HTMLButtonElement | undefined;
  private othersButtons: HTMLButtonElement[] = [];
  private view: View | undefined;
  private row: number | undefined;
  private wanted: (() => void) | undefined;

  constructor(
    private readonly report: Report,
    private readonly events: SceneEvents,
  ) {
    this.stage.append(this.canvas, this.cross, this.label, this.legend, this.sectionTools, this.measured, this.note, this.picked);
    this.element.append(this.tools(), this.stage);
    this.sectionSize.addEventListener('input', () => this.placeSection());
    this.canvas.addEventListener('keydown', (event) => this.key(event));
  }

  get ready(): boolean {
    return this.view !== undefined;
  }

  /** Reads the model and draws it; what goes wrong is told where the picture would be. */
  async open(): Promise<void> {
    const { head } = this.report;
    if (!head.scene) return this.showWithout(...withoutModel(head));
    this.showNote('Opening the model…');
    // The list is drawn before the model is unpacked.
    await new Promise((done) => setTimeout(done, 0));
    try {
      const model = await openModel(head);
      this.view = new View(this.canvas, model!, head.scene, head.counts.objects, {
        picked: (object) => this.events.picked(object),
        measured: (points) => this.showMeasured(points),
        drawn: () => this.placeLabel(),
        lost: (lost) => this.showLost(lost),
      });
    } catch (error) {
      const words = error instanceof Error ? error.message : String(error);
      if (/webgl/i.test(words)) return this.showWithout('This browser cannot show 3D: it has no WebGL 2, or it is switched off. The lists and drawings work without it.', 'Another browser may show it, or this one where “hardware acceleration” is on in its settings.');
      return this.showWithout(`The model cannot be shown. ${words}`, 'Copy the file again, or write it anew.');
    }
    this.element.classList.add('ready');
    this.note.hidden = true;
    this.theme();
    this.view.fit();
    if (this.view.items.count === 0) this.showNote('Nothing of this model has a shape.');
    this.wanted?.();
  }

  theme(): void {
    const style = getComputedStyle(document.documentElement);
    this.view?.setTheme(style.getPropertyValue('--stage').trim(), style.getPropertyValue('--ghost').trim(), style.getPropertyValue('--ink').trim());
  }

  showResult(row: number, fly: boolean): void {
    this.row = row;
    this.wanted = () => this.showResult(row, fly);
    if (!this.view) return;
    const shown = shownOf(this.report, row);
    this.view.show(shown, fly);
    const missing = [shown.a, shown.b].filter((o) => !this.view!.has(o));
    this.showLegend(shown.a, shown.b);
    if (missing.length > 0) this.showNote(missing.length === 2 ? 'Neither of the two has a shape in this page.' : 'One of the two has no shape in this page.');
    else this.note.hidden = true;
    this.placeLabel();
  }

  showObject(object: number, fly: boolean): void {
    this.row = undefined;
    this.wanted = () => this.showObject(object, fly);
    this.view?.showObject(object, fly);
    this.legend.hidden = true;
    this.note.hidden = this.ready;
    this.picked.textContent = `Picked: ${objectName(this.report.objects!, object).slice(0, 200)}`;
  }

  showNothing(): void {
    this.row = undefined;
    this.wanted = undefined;
    this.view?.show(undefined, false);
    this.legend.hidden = true;
    this.note.hidden = this.ready;
  }

  /** Shows a place, with a result that stands for those there. */
  showPlace(row: number | undefined, min: Vec, max: Vec): void {
    if (row === undefined) this.showNothing();
    else this.showResult(row, false);
    this.wanted = () => this.showPlace(row, min, max);
    this.view?.showBox(min, max);
  }

  /** What is seen, for paper, with the names of the two; undefined where nothing is. */
  print(): HTMLElement | undefined {
    if (!this.ready || this.canvas.clientWidth === 0) return undefined;
    return h('figure', {}, h('img', { src: this.canvas.toDataURL('image/png'), alt: 'The model' }));
  }

  fly(): void {
    if (this.row === undefined) this.view?.fit();
    else this.view?.flyToShown();
  }

  hasShape(object: number): boolean {
    return this.view?.has(object) ?? false;
  }

  /** Does what a key asks for; false where it asks for nothing here. */
  shortcut(key: string): boolean {
    const { view } = this;
    if (!view) return false;
    const sides = { 1: 'top', 2: 'front', 3: 'side', 4: 'iso' } as const;
    if (key in sides) view.viewFrom(sides[key as unknown as 1]);
    else if (key === 'f') view.fit();
    else if (key === 'g') this.setOthers(OTHERS[(OTHERS.findIndex(([o]) => o === view.others) + 1) % OTHERS.length]![0]);
    else if (key === 'b') this.sectionButton?.click();
    else if (key === 'm') this.measureButton?.click();
    else return false;
    return true;
  }

  /** Ends what is under way; false where nothing is. */
  giveUp(): boolean {
    if (!this.view?.measuring) return false;
    this.measureButton?.click();
    return true;
  }

  private tools(): HTMLElement {
    const tool = (label: string, title: string, act: () => void): HTMLElement => h('button', { type: 'button', class: 'small', title, onclick: act }, label);
    this.othersButtons = OTHERS.map(([others, label]) => h('button', { type: 'button', 'aria-pressed': String(others === 'ghost'), onclick: () => this.setOthers(others) }, label));
    this.sectionButton = toggle('Section', false, (on) => {
      this.sectionTools.hidden = !on;
      this.placeSection();
    }, { title: 'Only what is near the clash (B)', class: 'small' });
    this.measureButton = toggle('Measure', false, (on) => {
      if (!this.view) return;
      this.view.measuring = on;
      this.canvas.classList.toggle('measuring', on);
      if (on) this.showMeasured([]);
      else this.view.clearMeasure();
      this.measured.hidden = !on;
    }, { title: 'The distance of two points (M)', class: 'small' });
    return h(
      'div',
      { class: 'tools', role: 'toolbar', 'aria-label': 'View of the model' },
      this.report.results && tool('Clash', 'Fly to the clash (Enter)', () => this.fly()),
      tool('All', 'The whole model (F)', () => this.view?.fit()),
      h('span', { class: 'gap' }),
      tool('Top', 'From the top (1)', () => this.view?.viewFrom('top')),
      tool('Front', 'From the front (2)', () => this.view?.viewFrom('front')),
      tool('Side', 'From the side (3)', () => this.view?.viewFrom('side')),
      tool('Iso', 'Askew (4)', () => this.view?.viewFrom('iso')),
      h('span', { class: 'gap' }),
      h('div', { class: 'segments', role: 'group', 'aria-label': 'Other objects', title: 'Other objects (G)' }, ...this.othersButtons),
      this.sectionButton,
      this.measureButton,
    );
  }

  private setOthers(others: Others): void {
    if (this.view) this.view.others = others;
    this.othersButtons.forEach((button, i) => button.setAttribute('aria-pressed', String(OTHERS[i]![0] === others)));
  }

  /** From a hand's breadth to a hall, the same share more at each step. */
  private placeSection(): void {
    this.view?.section(this.sectionTools.hidden ? undefined : 50 * 400 ** (Number(this.sectionSize.value) / 100));
  }

  private showNote(text: string): void {
    this.note.hidden = false;
    fill(this.note, text);
  }

  /** Says why there is no picture, and what helps. */
  private showWithout(why: string, remedy: string | undefined): void {
    this.element.classList.add('without');
    this.note.hidden = false;
    fill(this.note, h('p', {}, why), remedy !== undefined && h('p', { class: 'hint' }, remedy));
  }

  private showLost(lost: boolean): void {
    this.element.classList.toggle('lost', lost);
    if (lost) this.showNote('The graphics card stopped drawing. The picture comes back by itself as soon as the card does; if it does not, open the page again. The lists go on.');
    else this.note.hidden = true;
  }

  private showLegend(a: number, b: number): void {
    const objects = this.report.objects!;
    this.legend.hidden = false;
    fill(this.legend,
      ...([['a', a], ['b', b]] as const).map(([side, object]) => h('div', {}, h('span', { class: `swatch swatch-${side}`, 'aria-hidden': 'true' }), ` ${side.toUpperCase()} `, objectName(objects, object).slice(0, 120))));
  }

  private showMeasured(points: Vec[]): void {
    if (points.length < 2) {
      fill(this.measured, `${points.length === 0 ? 'Click the first point' : 'Click the second point'}, or bring it to the middle and press Enter.`);
      return;
    }
    const [p, q] = points as [Vec, Vec];
    const off = p.map((v, k) => q[k]! - v);
    fill(this.measured, h('b', {}, `${length(Math.hypot(...off))} mm`), ` Δx ${length(off[0]!)}, Δy ${length(off[1]!)}, Δz ${length(off[2]!)}`);
  }

  /** The depth stands beside the place, wherever that is on the screen. */
  private placeLabel(): void {
    const { view } = this;
    this.stage.classList.toggle('settled', view?.settled ?? false);
    if (!view?.shown || this.row === undefined) {
      this.label.hidden = true;
      return;
    }
    const at = view.project(view.shown.at);
    this.label.hidden = !at;
    if (!at) return;
    const d = this.report.results!.d[this.row]!;
    const words = d < 0 ? `${length(-d)} mm deep` : d === 0 ? 'touching' : `${length(d)} mm apart`;
    if (this.label.textContent !== words) this.label.textContent = words;
    this.label.dataset.x = at.x.toFixed(1);
    this.label.dataset.y = at.y.toFixed(1);
    this.label.style.transform = `translate(${at.x + 14}px, ${at.y - 30}px)`;
  }

  private key(event: KeyboardEvent): void {
    const { view } = this;
    if (!view || event.ctrlKey || event.metaKey || event.altKey) return;
    const ways: Record<string, [number, number]> = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] };
    const way = ways[event.key];
    if (way && event.shiftKey) view.move(0.05 * way[0], 0.05 * way[1]);
    else if (way) view.turn(0.12 * way[0], 0.12 * way[1]);
    else if (event.key === '+') view.zoom(0.8);
    else if (event.key === '-') view.zoom(1.25);
    else if (event.key === 'Enter' || event.key === ' ') view.pressMiddle();
    else return;
    event.preventDefault();
  }
}
