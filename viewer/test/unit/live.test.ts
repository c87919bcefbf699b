// SPDX-License-Identifier: Apache-2.0
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { ApiError, type ClashState, decodeState } from '../../src/live/api.ts';
import { Decisions, GrowingTexts } from '../../src/live/decisions.ts';
import type { Head } from '../../src/payload/head.ts';
import { decodeResults, NONE8 } from '../../src/payload/payload.ts';
import { key, ship } from '../support/ship.ts';

function results(decisions: boolean): ReturnType<typeof decodeResults> {
  const { head, blocks } = ship({ objects: 60, results: 40, decisions });
  return decodeResults(blocks.get('strake-results') as Uint8Array<ArrayBuffer>, head as unknown as Head);
}

const said = (number: number, more: Partial<ClashState> = {}): ClashState => ({ key: key(number), status: 3, by: 'Ann', on: '2026-01-02', assignee: '', comment: '', ...more });

test('decisions are written over those of the page', () => {
  const page = results(true);
  const decisions = new Decisions(page);
  const before = page.comment!.slice();
  assert.deepEqual(decisions.apply([said(5, { comment: 'as agreed', assignee: 'Bob' }), said(7, { comment: 'as agreed' })]), [5, 7]);
  assert.equal(page.status![5], 3);
  assert.equal(page.texts!.at(page.comment![5]!), 'as agreed');
  assert.equal(page.comment![5], page.comment![7], 'one text once');
  assert.equal(page.texts!.at(page.assignee![5]!), 'Bob');
  assert.equal(page.texts!.at(page.decided_on![7]!), '2026-01-02');
  for (let row = 0; row < 40; ++row) if (row !== 5 && row !== 7) assert.equal(page.comment![row], before[row]);
});

test('a page on which nobody has decided gets the columns', () => {
  const page = results(false);
  const decisions = new Decisions(page);
  assert.ok(page.status!.every((status, row) => status === ((page.allowed?.[row] ?? 65535) === 65535 ? 0 : NONE8)));
  decisions.apply([said(1, { status: 2 })]);
  assert.equal(page.status![1], 2);
  assert.equal(page.texts!.at(page.decided_by![1]!), 'Ann');
  assert.equal(page.texts!.at(page.decided_by![0]!), '');
});

test('a clash that the page does not have changes nothing', () => {
  assert.deepEqual(new Decisions(results(true)).apply([said(0, { key: 'z'.repeat(26) })]), []);
});

test('what rows have in common', () => {
  const decisions = new Decisions(results(false));
  decisions.apply([said(1, { comment: 'x' }), said(2, { comment: 'x' }), said(3, { comment: 'y', status: 2 })]);
  assert.equal(decisions.common('comment', [1, 2]), 'x');
  assert.equal(decisions.common('comment', [1, 3]), undefined);
  assert.equal(decisions.commonStatus([1, 2]), 3);
  assert.equal(decisions.commonStatus([1, 3]), undefined);
});

test('texts grow behind those of the page', () => {
  const texts = new GrowingTexts(undefined);
  assert.equal(texts.number(''), 0);
  const one = texts.number('one');
  assert.equal(texts.number('one'), one);
  assert.equal(texts.at(one), 'one');
  assert.equal(texts.length, 2);
  assert.equal(texts.at(99), '');
});

test('an answer is read strictly', () => {
  const whole = { run: 2, event: 7, too_many: false, clashes: [{ key: 'k', status: 'approved', by: 'a', on: '', assignee: '', comment: '' }] };
  assert.deepEqual(decodeState(whole), { run: 2, event: 7, tooMany: false, clashes: [{ key: 'k', status: 3, by: 'a', on: '', assignee: '', comment: '' }], refused: [] });
  for (const wrong of [null, 'x', [], {}, { ...whole, run: '2' }, { ...whole, event: 0.5 }, { ...whole, clashes: {} }, { ...whole, clashes: [{ key: 'k', status: 'done' }] }, { ...whole, refused: [1] }]) {
    assert.throws(() => decodeState(wrong), ApiError, JSON.stringify(wrong));
  }
});
