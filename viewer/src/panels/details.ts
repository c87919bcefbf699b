// SPDX-License-Identifier: Apache-2.0
// All that is known of one clash, or of one object.
import { disciplineOf, fileName, objectName, type Report, shown, shownLines } from '../data/report.ts';
import { CLASS_WORDS, count, coordinate, exact, FLAG_MEANINGS, length, plural, RELATION_WORDS, sentence, STATUS_WORDS } from '../data/words.ts';
import { DEPTH_INCOMPLETE, LEVELS, NONE16, NONE32, NONE8, REOPENED } from '../payload/payload.ts';
import { classMark, h } from '../ui/dom.ts';

export interface DetailEvents {
  step(by: number): void;
  fly(): void;
  object(object: number): void;
  showAllOf(object: number): void;
  group(group: number): void;
  link(key: string): string;
}

type Pair = [string, string | Node | undefined | false];

function pairs(list: Pair[]): HTMLElement {
  return h('dl', { class: 'pairs' }, ...list.filter(([, value]) => value !== undefined && value !== false && value !== '').flatMap(([name, value]) => [h('dt', {}, name), h('dd', {}, value as string | Node)]));
}

function copyButton(label: string, text: () => string): HTMLElement {
  const button = h('button', { type: 'button', class: 'small' }, label);
  button.addEventListener('click', () => {
    void copy(text()).then((done) => {
      button.textContent = done ? 'Copied' : 'Cannot copy';
      setTimeout(() => (button.textContent = label), 1500);
    });
  });
  return button;
}

async function copy(text: string): Promise<boolean> {
  try {
    await navigator.clipboard.writeText(text);
    return true;
  } catch {
    // A file that was opened from disk may not have the clipboard; the old way works.
    const field = h('textarea', { class: 'offscreen', 'aria-hidden': 'true' });
    field.value = text;
    document.body.append(field);
    field.select();
    const done = document.execCommand('copy');
    field.remove();
    return done;
  }
}

/** The text of a number column that counts into texts. */
function text(report: Report, column: Uint32Array | undefined, row: number): string {
  const at = column?.[row] ?? 0;
  return at > 0 ? shownLines(report.results!.texts?.at(at) ?? '') : '';
}

export function resultDetails(report: Report, row: number, events: DetailEvents): HTMLElement {
  const results = report.results!;
  const cls = results.class[row]!;
  const d = results.d[row]!;
  const flags = results.flags[row]!;
  const key = results.key.at(row);
  const test = report.head.clash!.tests[results.test[row]!]!;
  const clearance = results.clearance && results.clearance[row]! >= 0 ? results.clearance[row]! : test.settings.clearance_mm;
  const volume = results.volume?.[row];
  const status = results.status?.[row] ?? NONE8;
  const allowed = results.allowed?.[row] ?? NONE16;
  const mayBe = results.may_be?.[row] ?? NONE8;
  const regions = results.region_count?.[row] ?? 0;
  const group = results.group?.[row] ?? NONE32;
  const comment = text(report, results.comment, row);
  const place = [results.x[row]!, results.y[row]!, results.z[row]!];
  return h(
    'div',
    { class: 'details' },
    h('div', { class: 'details-head' },
      h('h2', {}, classMark(cls), ` ${CLASS_WORDS[cls]}`, h('span', { class: 'depth' }, `${length(d)} mm`)),
      h('div', { class: 'buttons' },
        h('button', { type: 'button', class: 'small', title: 'The one before (K)', 'aria-label': 'The clash before', onclick: () => events.step(-1) }, '‹'),
        h('button', { type: 'button', class: 'small', title: 'The next one (J)', 'aria-label': 'The next clash', onclick: () => events.step(1) }, '›'),
        h('button', { type: 'button', class: 'small', title: 'Fly there (Enter)', onclick: () => events.fly() }, 'Show'),
        copyButton('Copy link', () => events.link(key)))),
    h('p', { class: 'sentence' }, sentence(cls, d, results.relation[row]!, clearance)),
    mayBe !== NONE8 && h('p', { class: 'note' }, `It may be a ${CLASS_WORDS[mayBe]!.toLowerCase()}: the numbers leave that open.`),
    allowed !== NONE16 && h('p', { class: 'note' }, `Allowed by the rule “${shown(report.head.rules[allowed]!)}”.`),
    h('div', { class: 'both' }, side(report, row, 'a', events), side(report, row, 'b', events)),
    status !== NONE8 &&
      h('section', {}, h('h3', {}, 'Decision'),
        pairs([
          ['Status', h('span', { class: `chip status-${status}` }, STATUS_WORDS[status]!)],
          ['Came back', (results.reopened?.[row] ?? 0) > 0 && REOPENED[results.reopened![row]!]],
          ['By', text(report, results.decided_by, row)],
          ['On', text(report, results.decided_on, row)],
          ['For', text(report, results.assignee, row)],
          ['Comment', comment !== '' && h('span', { class: 'lines' }, comment)],
        ])),
    h('section', {}, h('h3', {}, 'Numbers'),
      pairs([
        [d < 0 ? 'Depth, d' : 'Distance, d', `${exact(d)} mm`],
        ['Certainly within', `${exact(results.d_low[row]!)} to ${exact(results.d_high[row]!)} mm`],
        ['Place', `x ${exact(place[0]!)}, y ${exact(place[1]!)}, z ${exact(place[2]!)} mm`],
        ['Relation', RELATION_WORDS[results.relation[row]!]],
        ['Way out', wayOut(report, row)],
        ['Has to keep', cls === 2 && `${exact(clearance)} mm`],
        ['Places', regions === NONE32 ? 'too many to tell apart' : regions > 1 && count(regions)],
        ['Volume', volume !== undefined && volume >= 0 && `${exact(volume)} mm³`],
        ['Test', shown(test.name) || 'the only one'],
        ['Group', group !== NONE32 && report.groups && h('button', { type: 'button', class: 'link', onclick: () => events.group(group) }, shown(report.groups.name.at(group)))],
        ['Key', h('code', {}, key)],
      ])),
    flagNotes(flags),
    places(report, row),
  );
}

function wayOut(report: Report, row: number): string | undefined {
  const { witness, d } = report.results!;
  if (!witness || witness.kind[row] !== 1) return undefined;
  return `A moved by ${exact(-d[row]!)} mm along (${witness.q.map((q) => exact(q[row]!)).join(', ')})`;
}

function flagNotes(flags: number): HTMLElement | undefined {
  const notes = FLAG_MEANINGS.filter((_, i) => flags & (1 << i));
  if (flags & DEPTH_INCOMPLETE) notes.push('the search for the depth was cut short: it may be more');
  if (notes.length === 0) return undefined;
  return h('ul', { class: 'note' }, ...notes.map((n) => h('li', {}, n)));
}

function places(report: Report, row: number): HTMLElement | undefined {
  const { regions } = report;
  if (!regions) return undefined;
  let from = 0;
  let to = regions.count;
  while (from < to) {
    const middle = (from + to) >> 1;
    if (regions.result[middle]! < row) from = middle + 1;
    else to = middle;
  }
  const rows: HTMLElement[] = [];
  for (let i = from; i < regions.count && regions.result[i] === row; ++i) {
    const rule = regions.allowed[i]!;
    rows.push(h('tr', {},
      h('td', {}, classMark(regions.class[i]!), ` ${CLASS_WORDS[regions.class[i]!]}`),
      h('td', { class: 'right' }, `${length(regions.d[i]!)} mm`),
      h('td', { class: 'right' }, `${coordinate(regions.x[i]!)}, ${coordinate(regions.y[i]!)}, ${coordinate(regions.z[i]!)}`),
      h('td', {}, rule === NONE16 ? '' : `allowed: ${shown(report.head.rules[rule]!)}`)));
  }
  return rows.length > 0 ? h('section', {}, h('h3', {}, 'Where they meet'), h('table', { class: 'plain' }, h('tbody', {}, ...rows))) : undefined;
}

function side(report: Report, row: number, which: 'a' | 'b', events: DetailEvents): HTMLElement {
  const results = report.results!;
  const object = results[which][row]!;
  const discipline = disciplineOf(report, row, which);
  const level = LEVELS[(which === 'a' ? results.level_a : results.level_b)?.[row] ?? 0];
  const part = (which === 'a' ? results.part_a : results.part_b)?.[row];
  return h(
    'section',
    { class: `side side-${which}` },
    h('h3', {}, h('span', { class: `swatch swatch-${which}`, 'aria-hidden': 'true' }), which.toUpperCase(), ' ', h('span', { class: 'object-name' }, objectName(report.objects!, object).slice(0, 500))),
    objectPairs(report, object, [
      ['Discipline', discipline >= 0 && shown(report.head.disciplines[discipline]!)],
      ['Counts as', level],
      ['Part', part !== undefined && part > 0 && count(part)],
    ]),
    h('div', { class: 'buttons' },
      h('button', { type: 'button', class: 'small', onclick: () => events.object(object) }, 'Only this one'),
      h('button', { type: 'button', class: 'small', onclick: () => events.showAllOf(object) }, 'Its clashes'),
      copyButton('Copy id', () => report.objects!.id.at(object))),
  );
}

function objectPairs(report: Report, object: number, more: Pair[]): HTMLElement {
  const objects = report.objects!;
  const id = shown(objects.id.at(object));
  return pairs([
    ['Id', id !== objectName(objects, object) && id.slice(0, 500)],
    ['File', fileName(report, object)],
    ['Id is', (objects.flags[object]! & 1) !== 0 && 'only a position in the file: it may change'],
    ...more,
    ...report.head.columns.map((name, i): Pair => {
      const at = objects.attributes[i]?.[object] ?? 0;
      return [shown(name), at > 0 && shown(objects.texts?.at(at) ?? '')];
    }),
  ]);
}

export function objectDetails(report: Report, object: number, geometry: boolean, events: DetailEvents): HTMLElement {
  const { objects, results, head } = report;
  const counts = [0, 0, 0];
  if (results) for (let i = 0; i < results.count; ++i) if (results.a[i] === object || results.b[i] === object) ++counts[results.class[i]!]!;
  const discipline = objects!.discipline?.[object] ?? NONE16;
  return h(
    'div',
    { class: 'details' },
    h('div', { class: 'details-head' }, h('h2', {}, h('span', { class: 'swatch swatch-picked', 'aria-hidden': 'true' }), ' ', h('span', { class: 'object-name' }, objectName(objects!, object).slice(0, 500)))),
    objectPairs(report, object, [['Discipline', discipline !== NONE16 && shown(head.disciplines[discipline]!)]]),
    !geometry && h('p', { class: 'note' }, 'This object has no shape in this page.'),
    results && h('p', {}, `${plural(counts[0]!, 'hit')}, ${count(counts[2]!)} too close, ${plural(counts[1]!, 'contact')}.`),
    h('div', { class: 'buttons' },
      results && h('button', { type: 'button', class: 'small', onclick: () => events.showAllOf(object) }, 'Its clashes'),
      geometry && h('button', { type: 'button', class: 'small', onclick: () => events.fly() }, 'Show'),
      copyButton('Copy id', () => objects!.id.at(object))),
  );
}

/** What is told of clashes that are marked in the list. */
export function markedDetails(count: number): HTMLElement {
  return h('div', { class: 'details' }, h('div', { class: 'details-head' }, h('h2', {}, plural(count, 'marked clash', 'marked clashes'))));
}

export function groupDetails(report: Report, group: number, events: DetailEvents): HTMLElement {
  const groups = report.groups!;
  const cls = groups.class[group]!;
  const volume = groups.volume?.[group] ?? NaN;
  const corner = (ends: readonly Float64Array[]): string => ends.map((v) => exact(v[group]!)).join(', ');
  return h(
    'div',
    { class: 'details' },
    h('div', { class: 'details-head' }, h('h2', {}, classMark(cls), ' ', h('span', { class: 'object-name' }, shown(groups.name.at(group)).slice(0, 500))),
      h('div', { class: 'buttons' }, h('button', { type: 'button', class: 'small', onclick: () => events.group(group) }, 'List its results'))),
    pairs([
      ['Results', count(groups.results[group]!)],
      ['Of these', `${plural(groups.hits[group]!, 'hit')}, ${count(groups.clearance_violations[group]!)} too close, ${plural(groups.contacts[group]!, 'contact')}`],
      ['Worst', `${CLASS_WORDS[cls]}, ${exact(groups.d[group]!)} mm`],
      ['Volume', !Number.isNaN(volume) && `${exact(volume)} mm³`],
      ['From', `${corner(groups.min)} mm`],
      ['To', `${corner(groups.max)} mm`],
      ['Id', h('code', {}, groups.id.at(group))],
    ]),
  );
}
