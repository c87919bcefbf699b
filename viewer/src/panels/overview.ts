// SPDX-License-Identifier: Apache-2.0
// The first page: what was found, between whom, how it went on from run to run, and what was not looked at.
import { cellOf, hasDisciplines, type Report, shown, totals, withoutModel } from '../data/report.ts';
import { CLASS_MEANINGS, CLASS_PLURALS, count, exact, plural, STATUS_WORDS } from '../data/words.ts';
import type { TestSummary, TrendRun } from '../payload/head.ts';
import { NONE8 } from '../payload/payload.ts';
import { classMark, h, svg } from '../ui/dom.ts';

export interface OverviewEvents {
  showClass(cls: number): void;
  showCell(cell: [number, number]): void;
  showTest(test: number): void;
  showStatus(status: number): void;
}

const CLASS_KEYS = ['HIT', 'CONTACT', 'CLEARANCE_VIOLATION'] as const;

export function overview(report: Report, events: OverviewEvents): HTMLElement {
  const { head } = report;
  const { clash } = head;
  return h(
    'div',
    { class: 'overview' },
    clash && cards(report, events),
    clash && !report.results && nothingListed(report),
    clash && decided(report, events),
    clash && notCompared(report),
    report.results && matrix(report, events),
    clash && tests(report, clash.tests, events),
    head.trend && head.trend.length > 1 && trend(head.trend),
    model(report),
    clash && messages(report),
  );
}

function section(title: string, ...children: (Node | string | undefined | false)[]): HTMLElement {
  return h('section', { class: 'card' }, h('h2', {}, title), ...children);
}

/** What a page without a row in its list says. */
function nothingListed(report: Report): HTMLElement {
  const sum = totals(report.head);
  const found = sum.HIT + sum.CLEARANCE_VIOLATION + sum.CONTACT + sum.ALLOWED;
  return section('No clashes', h('p', {}, found === 0
    ? 'No two of the objects that were compared run into each other, touch or come too close.'
    : 'None of these results is listed in this page; only how many there are was asked for.'));
}

function cards(report: Report, events: OverviewEvents): HTMLElement {
  const sum = totals(report.head);
  const order = [0, 2, 1];
  return h(
    'div',
    { class: 'figures' },
    ...order.map((cls) =>
      h(report.results ? 'button' : 'div', { ...(report.results ? { type: 'button', onclick: () => events.showClass(cls) } : {}), class: `figure figure-${cls}` },
        h('span', { class: 'figure-number' }, count(sum[CLASS_KEYS[cls]!])),
        h('span', { class: 'figure-label' }, classMark(cls), CLASS_PLURALS[cls]!),
        h('span', { class: 'figure-note' }, CLASS_MEANINGS[cls]!)),
    ),
    sum.ALLOWED > 0 && h('div', { class: 'figure' }, h('span', { class: 'figure-number' }, count(sum.ALLOWED)), h('span', { class: 'figure-label' }, 'Allowed'), h('span', { class: 'figure-note' }, 'A rule says that they are meant.')),
  );
}

function decided(report: Report, events: OverviewEvents): HTMLElement | undefined {
  const status = report.results?.status;
  if (!status) return undefined;
  const counts = STATUS_WORDS.map(() => 0);
  for (const s of status) if (s !== NONE8) ++counts[s]!;
  const decisions = report.head.clash?.decisions;
  const reopened = Object.values(decisions?.reopened ?? {}).reduce((a, b) => a + b, 0);
  return section(
    'Decisions',
    h('div', { class: 'chips' }, ...STATUS_WORDS.map((word, s) => h('button', { type: 'button', class: `chip status-${s}`, onclick: () => events.showStatus(s) }, `${word} `, h('b', {}, count(counts[s]!))))),
    decisions && h('p', {}, `From ${shown(decisions.file)}.`, reopened > 0 ? ` ${plural(reopened, 'decision does', 'decisions do')} not settle the matter any more.` : '',
      decisions.not_found.length > 0 ? ` ${plural(decisions.not_found.length, 'decision is', 'decisions are')} about clashes that this run did not find.` : ''),
  );
}

function notCompared(report: Report): HTMLElement | undefined {
  const clash = report.head.clash!;
  const early = clash.files.filter((f) => f.ends_early);
  const missing = clash.not_compared ?? [];
  const unlisted = clash.tests.reduce((n, t) => n + (t.unlisted ? t.unlisted.CONTACT + t.unlisted.ALLOWED : 0), 0);
  if (early.length === 0 && missing.length === 0 && unlisted === 0 && !clash.classes) return undefined;
  const listed = missing.slice(0, 100);
  return h(
    'section',
    { class: 'card warning' },
    h('h2', {}, 'Not everything was looked at'),
    h('p', {}, 'A clash may be missing from this report where something could not be compared or is left out of the list.'),
    h('ul', {},
      ...early.map((f) => h('li', {}, `The file ${shown(f.label)} ends too soon: the rest of it is not known.`)),
      unlisted > 0 && h('li', {}, `${plural(unlisted, 'contact is', 'contacts are')} counted but not listed.`),
      clash.classes && h('li', {}, `Results are limited to: ${clash.classes.join(', ')}.`),
      ...listed.map((n) => h('li', {}, `${shown(n.a.name || n.a.id)}${n.b ? ` and ${shown(n.b.name || n.b.id)}` : ''}: ${REASONS[n.code] ?? n.code}`)),
      missing.length > listed.length && h('li', {}, `… and ${count(missing.length - listed.length)} more`)),
  );
}

const REASONS: Record<string, string> = {
  'shape-unplaceable': 'too far away, or its numbers make no sense',
  'shape-vanished': 'nothing is left of it',
  'body-unplaceable': 'a part of it is too far away',
  'body-without-shape': 'a part of it has no shape',
  'mesh-bad-triangle': 'a triangle of it has numbers that are none',
  'polyline-bad-point': 'a line of it has numbers that are none',
  'object-incomplete': 'part of it cannot be read',
  'object-skipped': 'nothing of it can be read',
  'pair-too-large': 'the two are too large to be compared',
  'pair-in-open-surface': 'one lies within the other, whose surface is not closed',
};

/** Counts of results between each two disciplines, or files. */
export function matrixCounts(report: Report, byDiscipline: boolean): { names: string[]; counts: Float64Array } {
  const names = (byDiscipline ? report.head.disciplines : report.head.files).map(shown);
  const n = names.length;
  const counts = new Float64Array(3 * n * n);
  const results = report.results!;
  for (let i = 0; i < results.count; ++i) {
    const [p, q] = [cellOf(report, i, 'a', byDiscipline), cellOf(report, i, 'b', byDiscipline)];
    if (p < 0 || q < 0) continue;
    ++counts[3 * (Math.min(p, q) * n + Math.max(p, q)) + results.class[i]!]!;
  }
  return { names, counts };
}

function matrix(report: Report, events: OverviewEvents): HTMLElement | undefined {
  const byDiscipline = hasDisciplines(report);
  const { names, counts } = matrixCounts(report, byDiscipline);
  const used = names.map((_, i) => i).filter((i) => names.some((__, j) => [0, 1, 2].some((c) => counts[3 * (Math.min(i, j) * names.length + Math.max(i, j)) + c]! > 0)));
  // A single one says nothing that the figures do not say.
  if (used.length < 2 || used.length > 40) return undefined;
  const at = (i: number, j: number, cls: number): number => counts[3 * (Math.min(i, j) * names.length + Math.max(i, j)) + cls]!;
  const most = Math.max(1, ...used.flatMap((i) => used.map((j) => at(i, j, 0))));
  const cell = (i: number, j: number): HTMLElement => {
    const [hits, contacts, near] = [at(i, j, 0), at(i, j, 1), at(i, j, 2)];
    if (hits + contacts + near === 0) return h('td', { class: 'none' }, '–');
    const heat = hits === 0 ? 0 : 1 + Math.min(4, Math.floor((4 * Math.log1p(hits)) / Math.log1p(most)));
    const words = `${names[i]} and ${names[j]}: ${plural(hits, 'hit')}, ${count(near)} too close, ${plural(contacts, 'contact')}`;
    const unseen = (text: string): HTMLElement => h('span', { class: 'unseen' }, text);
    return h('td', {}, h('button', { type: 'button', class: `heat heat-${heat}`, title: words, onclick: () => events.showCell([i, j]) },
      unseen(`${names[i]} and ${names[j]}: `), h('b', {}, count(hits)), unseen(' hits, '), h('span', { class: 'heat-rest' }, `${count(near)} · ${count(contacts)}`), unseen(' too close and contacts')));
  };
  return section(
    byDiscipline ? 'Between disciplines' : 'Between files',
    h('p', { class: 'hint' }, 'Large: hits. Small: too close · contacts. A click shows them.'),
    h('div', { class: 'scroll-x', tabindex: 0, role: 'region', 'aria-label': 'Matrix of clashes' },
      h('table', { class: 'matrix' },
        h('thead', {}, h('tr', {}, h('td', {}), ...used.map((j) => h('th', { scope: 'col', title: names[j] }, names[j]!)))),
        h('tbody', {}, ...used.map((i, r) => h('tr', {}, h('th', { scope: 'row', title: names[i] }, names[i]!), ...used.map((j, c) => (c < r ? h('td', { class: 'mirror' }) : cell(i, j)))))))),
  );
}

/** Which objects a test compares. */
function setsOf({ sets }: TestSummary): string {
  if (sets.a === '*' && sets.b === '*') return 'all with all';
  const words = (set: string): string => (set === '*' ? 'all' : shown(set));
  return `${words(sets.a)} with ${words(sets.b)}`;
}

function tests(report: Report, list: TestSummary[], events: OverviewEvents): HTMLElement {
  const cell = (n: number): HTMLElement => h('td', { class: 'right' }, count(n));
  return section(
    list.length === 1 ? 'The test' : 'Tests',
    h('div', { class: 'scroll-x', tabindex: 0, role: 'region', 'aria-label': 'Tests' },
      h('table', { class: 'plain' },
        h('thead', {}, h('tr', {}, ...['Test', 'Objects A', 'Objects B', 'Hits', 'Too close', 'Contacts', 'Allowed', 'Clearance mm', 'Touching mm'].map((t, i) => h('th', { scope: 'col', class: i > 0 ? 'right' : '' }, t)))),
        h('tbody', {}, ...list.map((t, i) =>
          h('tr', {},
            h('th', { scope: 'row' }, report.results ? h('button', { type: 'button', class: 'link', onclick: () => events.showTest(i) }, shown(t.name) || 'All results') : shown(t.name) || 'The test', h('div', { class: 'hint' }, setsOf(t))),
            cell(t.objects.a), cell(t.objects.b), cell(t.counts.HIT), cell(t.counts.CLEARANCE_VIOLATION), cell(t.counts.CONTACT), cell(t.counts.ALLOWED),
            h('td', { class: 'right' }, exact(t.settings.clearance_mm) + (t.settings.clearance_attribute ? ` + ${shown(t.settings.clearance_attribute)}` : '')),
            h('td', { class: 'right' }, `−${exact(t.settings.touch_overlap_mm)} to ${exact(t.settings.touch_gap_mm)}`)))))),
    ...list.filter((t) => t.exempted.length + t.allowed.length > 0).map((t) =>
      h('details', {}, h('summary', {}, `Rules of ${shown(t.name) || 'the test'}`),
        h('ul', {},
          ...t.exempted.map((e) => h('li', {}, `${shown(e.rule)}: ${plural(e.pairs, 'pair')} left out`)),
          ...t.allowed.map((a) => h('li', {}, `${shown(a.rule)}: ${count(a.pairs)} of ${plural(a.candidates, 'pair')} allowed`))))),
    report.head.clash?.rules && h('p', { class: 'hint' }, `Rules: ${shown(report.head.clash.rules.file)}`),
  );
}

/** The runs of a project, tests added up. */
export function runsOf(trend: readonly TrendRun[]): TrendRun[] {
  const runs = new Map<number, TrendRun>();
  for (const row of trend) {
    const sum = runs.get(row.run);
    if (!sum) {
      runs.set(row.run, { ...row });
      continue;
    }
    for (const name of ['hit', 'contact', 'clearance_violation', 'allowed', 'appeared', 'gone', 'new', 'active', 'reviewed', 'approved', 'resolved', 'cannot_tell'] as const) sum[name] += row[name];
  }
  return [...runs.values()];
}

function chart(title: string, series: { label: string; values: number[]; style: string }[], labels: string[]): HTMLElement {
  const [width, height, left, bottom] = [460, 150, 44, 22];
  const most = Math.max(1, ...series.flatMap((s) => s.values));
  const x = (i: number): number => left + (i * (width - left - 10)) / Math.max(1, labels.length - 1);
  const y = (v: number): number => 10 + (1 - v / most) * (height - bottom - 10);
  const last = series.map((s) => `${s.label} ${count(s.values.at(-1)!)}`).join(', ');
  const picture = svg('svg', { viewBox: `0 0 ${width} ${height}`, class: 'chart', role: 'img', 'aria-label': `${title}, in the last run: ${last}` });
  for (const share of [0, 0.5, 1]) {
    picture.append(svg('line', { x1: left, x2: width - 10, y1: y(most * share), y2: y(most * share), class: 'grid' }));
    picture.append(svg('text', { x: left - 6, y: y(most * share) + 4, 'text-anchor': 'end' }, count(Math.round(most * share))));
  }
  picture.append(svg('text', { x: left, y: height - 5 }, labels[0]!), svg('text', { x: width - 10, y: height - 5, 'text-anchor': 'end' }, labels.at(-1)!));
  for (const s of series) {
    picture.append(svg('polyline', { points: s.values.map((v, i) => `${x(i).toFixed(1)},${y(v).toFixed(1)}`).join(' '), class: `line ${s.style}` }));
    s.values.forEach((v, i) => picture.append(svg('circle', { cx: x(i), cy: y(v), r: 3, class: s.style }, svg('title', {}, `${labels[i]}: ${s.label} ${count(v)}`))));
  }
  return h('figure', { class: 'trend' }, h('figcaption', {}, title, ...series.map((s) => h('span', { class: `legend ${s.style}` }, s.label))), picture);
}

function trend(rows: TrendRun[]): HTMLElement {
  const runs = runsOf(rows);
  const labels = runs.map((r) => shown(r.started).slice(0, 10));
  const of = (get: (r: TrendRun) => number): number[] => runs.map(get);
  return section(
    'From run to run',
    h('div', { class: 'trends' },
      chart('Found', [{ label: 'Hits', values: of((r) => r.hit), style: 's-hit' }, { label: 'Too close', values: of((r) => r.clearance_violation), style: 's-near' }], labels),
      chart('Decided', [{ label: 'Open', values: of((r) => r.new + r.active + r.reviewed), style: 's-open' }, { label: 'Approved or resolved', values: of((r) => r.approved + r.resolved), style: 's-done' }], labels),
      chart('Changed', [{ label: 'Appeared', values: of((r) => r.appeared), style: 's-hit' }, { label: 'Gone', values: of((r) => r.gone), style: 's-done' }], labels)),
  );
}

function model(report: Report): HTMLElement {
  const { scene, clash, files } = report.head;
  const rows: [string, string][] = (clash?.files ?? files.map((label) => ({ label, format: '', unit: '' }))).map((f) => [shown(f.label), [f.format, f.unit].filter(Boolean).map(shown).join(', ')]);
  return section(
    'The model',
    h('dl', { class: 'pairs' }, ...rows.flatMap(([name, what]) => [h('dt', {}, name), h('dd', {}, what || '–')])),
    scene
      ? h('p', {}, `${plural(scene.objects, 'object')}; in this page ${count(scene.objects_as_shapes)} with their shape`,
          scene.objects_as_boxes > 0 ? `, ${count(scene.objects_as_boxes)} as boxes` : '', scene.objects_left_out > 0 ? `, ${count(scene.objects_left_out)} left out` : '',
          `; ${plural(scene.triangles, 'triangle')}.`, scene.note ? ` ${shown(scene.note)}` : '')
      : h('p', {}, withoutModel(report.head).filter(Boolean).join(' ')),
  );
}

function messages(report: Report): HTMLElement | undefined {
  const { messages: list, diagnostics } = report.head.clash!;
  if (diagnostics.length === 0) return undefined;
  const total = diagnostics.reduce((n, d) => n + d.count, 0);
  return section(
    'Messages',
    h('details', {}, h('summary', {}, plural(total, 'message')),
      h('ul', { class: 'messages' }, ...list.slice(0, 500).map((m) => h('li', { class: `severity-${['note', 'warning', 'skipped'].indexOf(m.severity)}` }, h('b', {}, shown(m.where)), `: ${shown(m.message)}`)))),
  );
}
