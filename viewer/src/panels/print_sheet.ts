// SPDX-License-Identifier: Apache-2.0
// What is printed: the figures, and the rows that the list is limited to.
import { objectName, type Report, shown, totals } from '../data/report.ts';
import { CLASS_WORDS, coordinate, count, length, STATUS_WORDS } from '../data/words.ts';
import { NONE8 } from '../payload/payload.ts';
import { h } from '../ui/dom.ts';

// Some forty pages; more is for a program, not for paper.
const MOST_ROWS = 2000;

/** `chosen` is what is told of the chosen clash, where there is one. */
export function printSheet(report: Report, rows: Uint32Array, chosen: HTMLElement | undefined): HTMLElement {
  const { head, results, objects } = report;
  const sum = totals(head);
  const listed = rows.subarray(0, MOST_ROWS);
  const status = !!results?.status;
  return h(
    'div',
    { class: 'print-sheet' },
    h('h1', {}, shown(head.title)),
    h('p', {}, [shown(head.program), head.made && shown(head.made)].filter(Boolean).join(', ')),
    head.clash && h('p', {}, `${count(sum.HIT)} hits, ${count(sum.CLEARANCE_VIOLATION)} too close, ${count(sum.CONTACT)} contacts, ${count(sum.ALLOWED)} allowed.`),
    chosen,
    results && h('p', {}, `${count(rows.length)} of ${count(results.count)} results are in the list${listed.length < rows.length ? `; the first ${count(listed.length)} are printed` : ''}.`),
    results && h('table', {},
      h('thead', {}, h('tr', {}, ...['Class', 'd mm', 'Object A', 'Object B', 'x mm', 'y mm', 'z mm', ...(status ? ['Status'] : [])].map((t) => h('th', { scope: 'col', class: t.endsWith(' mm') ? 'right' : '' }, t)))),
      h('tbody', {}, ...Array.from(listed, (r) => {
        const s = results.status?.[r] ?? NONE8;
        return h('tr', {},
          h('td', {}, CLASS_WORDS[results.class[r]!]!), h('td', { class: 'right' }, length(results.d[r]!)),
          h('td', {}, objectName(objects!, results.a[r]!).slice(0, 120)), h('td', {}, objectName(objects!, results.b[r]!).slice(0, 120)),
          ...[results.x, results.y, results.z].map((v) => h('td', { class: 'right' }, coordinate(v[r]!))),
          status && h('td', {}, s === NONE8 ? '' : STATUS_WORDS[s]!));
      }))),
  );
}
