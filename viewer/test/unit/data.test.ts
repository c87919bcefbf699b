// SPDX-License-Identifier: Apache-2.0
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { type Filter, isUnlimited, noFilter, Rows, SEVERITY, worstOf } from '../../src/data/filter.ts';
import { filterGroups, sortGroups } from '../../src/data/groups.ts';
import { sortByValue } from '../../src/data/order.ts';
import { objectName, type Report, shown, shownLines } from '../../src/data/report.ts';
import { sentence } from '../../src/data/words.ts';
import { matrixCounts, runsOf } from '../../src/panels/overview.ts';
import { decodeHead } from '../../src/payload/head.ts';
import { decodeGroups, decodeObjects, decodeResults } from '../../src/payload/payload.ts';
import { HIGHEST, offsetOf, topOf } from '../../src/table/virtual_rows.ts';
import { key, seeded, ship, type Ship, type Sizes } from '../support/ship.ts';

function report(sizes: Sizes): { report: Report; made: Ship } {
  const made = ship(sizes);
  const head = decodeHead(new TextEncoder().encode(JSON.stringify({ ...made.head, blocks: [] })));
  const bytes = (id: string): Uint8Array<ArrayBuffer> => made.blocks.get(id) as Uint8Array<ArrayBuffer>;
  return {
    made,
    report: {
      head,
      objects: decodeObjects(bytes('strake-objects'), head),
      results: decodeResults(bytes('strake-results'), head),
      groups: sizes.groups ? decodeGroups(bytes('strake-groups'), head) : undefined,
      regions: undefined,
    },
  };
}

test('sorting is that of the language, stable, with what is no number last', () => {
  const random = seeded(5);
  const values = Array.from({ length: 5000 }, () => (random() < 0.3 ? Math.round(random() * 5) : (random() - 0.5) * 10 ** Math.floor(random() * 20 - 10)));
  values.push(0, -0, Infinity, -Infinity, 5e-324, -5e-324);
  const rows = Uint32Array.from(values.keys());
  const expected = [...rows].sort((p, q) => values[p]! - values[q]! || p - q);
  assert.deepEqual([...sortByValue(rows, (r) => values[r]!)], expected);
  const mixed = [3, NaN, -1];
  assert.deepEqual([...sortByValue(Uint32Array.of(0, 1, 2), (r) => mixed[r]!)], [2, 0, 1]);
  assert.equal(sortByValue(new Uint32Array(0), () => 0).length, 0);
});

test('a filter lets through what each of its parts does', () => {
  const { report: r, made } = report({ objects: 200, results: 900, groups: 7, decisions: true });
  const rows = new Rows(r);
  const all = [...Array(900).keys()];
  const only = (change: (f: ReturnType<typeof noFilter>) => void): number[] => {
    const f = noFilter();
    change(f);
    return Array.from(rows.filter(f));
  };
  assert.deepEqual(only(() => {}), all);
  assert.deepEqual(only((f) => f.classes.add(0)), all.filter((i) => made.cls[i] === 0));
  assert.deepEqual(only((f) => (f.object = 17)), all.filter((i) => made.a[i] === 17 || made.b[i] === 17));
  assert.deepEqual(only((f) => (f.group = 3)), all.filter((i) => made.cls[i] !== 1 && i % 7 === 3));
  assert.deepEqual(only((f) => f.statuses.add(3)), all.filter((i) => r.results!.status![i] === 3));
  assert.deepEqual(only((f) => (f.settled = false)), all.filter((i) => r.results!.status![i] !== 3));
  assert.deepEqual(only((f) => (f.uncertain = true)), all.filter((i) => r.results!.flags[i]! & 2));
  const d = r.objects!.discipline!;
  assert.deepEqual(only((f) => (f.cell = [0, 2])), all.filter((i) => [d[made.a[i]!]!, d[made.b[i]!]!].sort().join() === '0,2'));
  assert.deepEqual(only((f) => (f.cell = [undefined, 2])), all.filter((i) => d[made.a[i]!] === 2 || d[made.b[i]!] === 2));
  assert.deepEqual(only((f) => (f.cell = [2, 2])), all.filter((i) => d[made.a[i]!] === 2 && d[made.b[i]!] === 2));
  assert.deepEqual(only((f) => (f.d = [-40, undefined])), all.filter((i) => made.d[i]! >= -40));
  assert.deepEqual(only((f) => (f.d = [-90.5, -40])), all.filter((i) => made.d[i]! >= -90.5 && made.d[i]! <= -40));
  assert.deepEqual(only((f) => (f.text = 'larsen tuesday')), all.filter((i) => r.results!.comment![i]! > 0));
  r.results!.reopened = Uint8Array.from(all, (i) => (i % 11 === 0 ? 2 : 0));
  assert.deepEqual(only((f) => (f.reopened = true)), all.filter((i) => i % 11 === 0));
  const name = r.objects!.id.at(17);
  assert.deepEqual(only((f) => (f.text = name.toUpperCase())), all.filter((i) => made.a[i] === 17 || made.b[i] === 17));
  assert.deepEqual(only((f) => (f.text = key(5))), [5]);
  assert.deepEqual(only((f) => (f.text = `${name} nothing-has-this`)), []);
});

const LIMITS: Record<string, (f: Filter) => unknown> = {
  class: (f) => f.classes.add(2), classes: (f) => f.classes.add(0).add(2), status: (f) => f.statuses.add(3), cell: (f) => (f.cell = [0, 2]), side: (f) => (f.cell = [undefined, 1]),
  depth: (f) => (f.d = [-80, -20]), open: (f) => (f.settled = false), uncertain: (f) => (f.uncertain = true), object: (f) => (f.object = 17), test: (f) => (f.test = 0),
  several: (f) => {
    f.statuses.add(1);
    f.cell = [0, undefined];
    f.d = [undefined, 0];
  },
};

test('every limit of the list limits groups, which count what it leaves', () => {
  const { report: r, made } = report({ objects: 200, results: 900, groups: 7, decisions: true });
  const rows = new Rows(r);
  const { group } = r.results!;
  for (const [name, change] of Object.entries(LIMITS)) {
    const f = noFilter();
    change(f);
    assert.equal(isUnlimited(f), false, name);
    const listed = Array.from(rows.filter(f));
    const { list, counts } = filterGroups(rows, f);
    const members = Array.from({ length: 7 }, (_, g) => listed.filter((i) => group![i] === g));
    assert.deepEqual([...list], members.flatMap((m, g) => (m.length > 0 ? [g] : [])), name);
    for (const g of list) {
      const of = (cls: number): number => members[g]!.filter((i) => made.cls[i] === cls).length;
      assert.deepEqual([counts.results[g], counts.hits[g], counts.contacts[g], counts.near[g]], [members[g]!.length, of(0), of(1), of(2)], name);
      const worst = members[g]!.slice().sort((p, q) => SEVERITY[made.cls[p]!]! - SEVERITY[made.cls[q]!]! || made.d[p]! - made.d[q]!)[0]!;
      assert.deepEqual([counts.class[g], counts.d[g]], [made.cls[worst], made.d[worst]], name);
    }
  }
});

test('without a limit groups have the numbers of the document, which are those of their results', () => {
  const { report: r } = report({ objects: 200, results: 900, groups: 7, decisions: true });
  const rows = new Rows(r);
  const { list, counts } = filterGroups(rows, noFilter());
  assert.deepEqual([...list], [0, 1, 2, 3, 4, 5, 6]);
  assert.equal(counts.limited, false);
  // A limit that everything keeps to makes the page count itself.
  const counted = filterGroups(rows, { ...noFilter(), d: [-1e9, 1e9] }).counts;
  assert.ok(counted.limited);
  for (const column of ['results', 'hits', 'contacts', 'near', 'class', 'd'] as const) assert.deepEqual([...counted[column]], [...counts[column]], column);
});

test('a search finds groups by their names, with all their results, and by names in their results', () => {
  const { report: r } = report({ objects: 200, results: 900, groups: 7 });
  const rows = new Rows(r);
  const name = r.groups!.name.at(3);
  const { list, counts } = filterGroups(rows, { ...noFilter(), text: name.toLowerCase() });
  assert.ok(list.includes(3));
  assert.equal(counts.results[3], r.groups!.results[3]);
  const object = r.objects!.id.at(150);
  const found = filterGroups(rows, { ...noFilter(), text: object });
  const expected = new Set(Array.from(rows.filter({ ...noFilter(), text: object })).map((i) => r.results!.group![i]!).filter((g) => g < 7));
  assert.deepEqual([...found.list], [...expected].sort((p, q) => p - q));
  const hits = sortGroups(r, list, counts, 'hits', true);
  for (let i = 1; i < hits.length; ++i) assert.ok(counts.hits[hits[i - 1]!]! >= counts.hits[hits[i]!]!);
});

test('worst first: hits by depth, then what is too close, then contacts; what is settled behind', () => {
  const { report: r, made } = report({ objects: 200, results: 900, decisions: true });
  const rows = new Rows(r);
  const sorted = rows.sort(rows.filter(noFilter()), 'worst', false);
  const rank = (i: number): number => (r.results!.status![i] === 3 ? 10 : 0) + SEVERITY[made.cls[i]!]!;
  for (let i = 1; i < sorted.length; ++i) {
    const [p, q] = [sorted[i - 1]!, sorted[i]!];
    assert.ok(rank(p) < rank(q) || (rank(p) === rank(q) && made.d[p]! <= made.d[q]!));
  }
  const byName = rows.sort(rows.filter(noFilter()), 'a', true);
  const names = [...byName].map((i) => r.objects!.id.at(made.a[i]!));
  const collator = new Intl.Collator('en', { numeric: true });
  for (let i = 1; i < names.length; ++i) assert.ok(collator.compare(names[i - 1]!, names[i]!) >= 0);
});

test('the matrix counts every result once', () => {
  const { report: r, made } = report({ objects: 200, results: 900 });
  const { counts, names } = matrixCounts(r, true);
  assert.equal(counts.reduce((a, b) => a + b, 0), 900);
  const n = names.length;
  for (const cell of r.head.clash!.tests[0]!.matrix!.cells) {
    const [i, j] = [names.indexOf(cell.a), names.indexOf(cell.b)];
    const at = 3 * (Math.min(i, j) * n + Math.max(i, j));
    assert.deepEqual([counts[at], counts[at + 1], counts[at + 2]], [cell.counts!.HIT, cell.counts!.CONTACT, cell.counts!.CLEARANCE_VIOLATION]);
  }
  assert.equal(counts.filter((_, i) => i % 3 === 0).reduce((a, b) => a + b, 0), made.cls.filter((c) => c === 0).length);
});

test('tests of a run are added up', () => {
  const row = { run: 1, started: 'x', test: 'a', hit: 2, contact: 3, clearance_violation: 4, allowed: 0, appeared: 1, gone: 1, new: 1, active: 1, reviewed: 0, approved: 0, resolved: 0, cannot_tell: 0 };
  const runs = runsOf([row, { ...row, test: 'b', hit: 5 }, { ...row, run: 2 }]);
  assert.deepEqual(runs.map((r) => [r.run, r.hit]), [[1, 7], [2, 2]]);
});

test('a list of a million and a half rows reaches its last row', () => {
  const [total, view] = [1500000 * 38, 640];
  assert.ok(total > HIGHEST);
  assert.equal(offsetOf(HIGHEST - view, total, view), total - view);
  assert.equal(offsetOf(0, total, view), 0);
  for (const offset of [0, 12345, total / 3, total - view]) assert.ok(Math.abs(offsetOf(topOf(offset, total, view), total, view) - offset) < 1e-6);
  assert.equal(offsetOf(500, 10000, view), 500);
});

test('what does not show is made to show', () => {
  assert.equal(shown('RIGHT\u202eLEFT\u0000'), 'RIGHT\ufffdLEFT\ufffd');
  assert.equal(shown('Ångström –'), 'Ångström –');
  assert.equal(shown('a\u061cb\u2028c'), 'a\ufffdb\ufffdc');
  assert.equal(shownLines('one\r\ntwo\n\u202ethree'), 'one\ntwo\n\ufffdthree');
});

test('a result is told in a sentence', () => {
  assert.equal(sentence(0, -160.5, 3, 25), 'They overlap: 160.5 mm at the deepest place.');
  assert.equal(sentence(2, 8, 0, 25), 'They are 8.0 mm apart. They have to keep 25 mm.');
  assert.equal(sentence(1, 0, 1, 25), 'They touch.');
  assert.equal(sentence(0, -20, 6, 25), 'The same body stands here twice (20.0 mm deep).');
});

test('a group stands for its severest result', () => {
  const { report: r } = report({ objects: 300, results: 420, groups: 12 });
  const { results, groups } = r;
  for (let g = 0; g < groups!.count; ++g) {
    const rows = [...results!.d.keys()].filter((i) => results!.group![i] === g);
    rows.sort((p, q) => SEVERITY[results!.class[p]!]! - SEVERITY[results!.class[q]!]! || results!.d[p]! - results!.d[q]! || p - q);
    assert.equal(worstOf(results!, g), rows[0]);
  }
  assert.equal(worstOf(results!, groups!.count), undefined);
});

test('no object is without words', () => {
  const column = (...texts: string[]): any => ({ at: (i: number) => texts[i]! });
  const objects = { flags: Uint8Array.of(0, 0, 2), names: column('pipe', ' \u2003', ''), id: column('p1', 'node 1', '  ') } as any;
  assert.deepEqual([0, 1, 2].map((o) => objectName(objects, o)), ['pipe', 'node 1', '(no name)']);
});
