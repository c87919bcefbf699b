// SPDX-License-Identifier: Apache-2.0
// What is printed: the figures, and the rows that the list is limited to.
import type { GroupCounts } from '../data/groups.ts';
import { objectName, type Report, shown, totals } from '../data/report.ts';
import { CLASS_WORDS, coordinate, count, length, plural, STATUS_WORDS } from '../data/words.ts';
import { NONE8 } from '../payload/payload.ts';
import { h } from '../ui/dom.ts';

// Some forty pages; more is for a program, not for paper.
const MAX_ROWS = 2000;

/** What is listed: rows of results, or groups with what the limits leave of them. */
export interface Listed {
  rows: Uint32Array;
  groups: { list: Uint32Array; counts: GroupCounts } | undefined;
}

/** `chosen` is what is told of the chosen clash, where there is one. */
export function printSheet(report: Report, listed: Listed, chosen: HTMLElement | undefined): HTMLElement {
  const { head, results } = report;
  const sum = totals(head);
  return h(
    'div',
    { class: 'print-sheet' },
    h('h1', {}, shown(head.title).slice(0, 400)),
    h('p', {}, [shown(head.program), head.made && shown(head.made)].filter(Boolean).join(', ')),
    head.clash && h('p', {}, `${plural(sum.HIT, 'hit')}, ${count(sum.CLEARANCE_VIOLATION)} too close, ${plural(sum.CONTACT, 'contact')}, ${count(sum.ALLOWED)} allowed.`),
    chosen,
    ...(results ? (listed.groups ? groupTable(report, listed.groups) : resultTable(report, listed.rows)) : []),
  );
}

function countLine(listed: number, all: number, what: string): HTMLElement {
  return h('p', {}, `${count(listed)} of ${plural(all, what)} ${listed === 1 ? 'is' : 'are'} in the list${listed > MAX_ROWS ? `; the first ${count(MAX_ROWS)} are printed` : ''}.`);
}

/** Heads that begin with > stand over numbers. */
function table(heads: string[], rows: HTMLElement[]): HTMLElement {
  const head = (text: string): HTMLElement => h('th', { scope: 'col', class: text.startsWith('>') ? 'right' : '' }, text.replace('>', ''));
  return h('table', {}, h('thead', {}, h('tr', {}, ...heads.map(head))), h('tbody', {}, ...rows));
}

const right = (text: string): HTMLElement => h('td', { class: 'right' }, text);

function resultTable(report: Report, rows: Uint32Array): HTMLElement[] {
  const results = report.results!;
  const objects = report.objects!;
  const status = !!results.status;
  return [
    countLine(rows.length, results.count, 'result'),
    table(['Class', '>d mm', 'Object A', 'Object B', '>x mm', '>y mm', '>z mm', ...(status ? ['Status'] : [])], Array.from(rows.subarray(0, MAX_ROWS), (r) => {
      const s = results.status?.[r] ?? NONE8;
      return h('tr', {},
        h('td', {}, CLASS_WORDS[results.class[r]!]!), right(length(results.d[r]!)),
        h('td', {}, objectName(objects, results.a[r]!).slice(0, 120)), h('td', {}, objectName(objects, results.b[r]!).slice(0, 120)),
        ...[results.x, results.y, results.z].map((v) => right(coordinate(v[r]!))),
        status && h('td', {}, s === NONE8 ? '' : STATUS_WORDS[s]!));
    })),
  ];
}

function groupTable(report: Report, { list, counts }: { list: Uint32Array; counts: GroupCounts }): HTMLElement[] {
  const groups = report.groups!;
  return [
    countLine(list.length, groups.count, 'group'),
    table(['Worst', '>d mm', 'Group', '>Results', '>Hits', '>Too close', '>Contacts'], Array.from(list.subarray(0, MAX_ROWS), (g) =>
      h('tr', {},
        h('td', {}, CLASS_WORDS[counts.class[g]!]!), right(length(counts.d[g]!)), h('td', {}, shown(groups.name.at(g)).slice(0, 200)),
        right(counts.limited ? `${count(counts.results[g]!)} of ${count(groups.results[g]!)}` : count(counts.results[g]!)),
        ...[counts.hits, counts.near, counts.contacts].map((n) => right(count(n[g]!)))))),
  ];
}
