// SPDX-License-Identifier: Apache-2.0
import assert from 'node:assert/strict';
import { after, before, test } from 'node:test';
import type { Browser } from 'playwright-core';
import { COLOUR_A_HEX, COLOUR_B_HEX } from '../support/colours.ts';
import { Folder, launch, openPage, pixel, places, settle } from '../support/browser.ts';
import { element, pageWith, payload } from '../support/encode.ts';
import type { Head } from '../../src/payload/head.ts';
import { decodeResults } from '../../src/payload/payload.ts';
import { HOSTILE, key, ship } from '../support/ship.ts';
import { SIZES } from '../support/write_page.ts';

let browser: Browser;
const folder = new Folder();
const small = ship(SIZES.small!);
let url = '';

before(async () => {
  url = folder.write('small.html', pageWith(payload(small.head, small.blocks)));
  browser = await launch();
});
after(async () => {
  await browser.close();
  folder.remove();
});

/** Hits that nobody approved, the deepest first: the first rows of the list. */
const APPROVED = 3;
const statuses = decodeResults(small.blocks.get('strake-results') as Uint8Array<ArrayBuffer>, small.head as unknown as Head).status!;
const deepest = [...small.d.keys()].filter((i) => small.cls[i] === 0 && statuses[i] !== APPROVED).sort((p, q) => small.d[p]! - small.d[q]!);

test('the figures are those of the document', async () => {
  const { page, faults } = await openPage(browser, url);
  await page.waitForSelector('.figure');
  const numbers = await page.locator('.figure-number').allTextContents();
  const count = (c: number): string => String(small.cls.filter((v) => v === c).length);
  assert.deepEqual(numbers, [count(0), count(2), count(1)]);
  assert.equal(await page.title(), 'Ship section 12 – Strake');
  assert.equal(await page.locator('.chart').count(), 3);
  assert.deepEqual(faults, []);
  await page.context().close();
});

test('a click in the matrix lists those clashes', async () => {
  const { page, faults } = await openPage(browser, url);
  const cell = (small.head.clash as any).tests[0].matrix.cells.find((c: any) => c.a === 'PIPING' && c.b === 'ELECTRICAL').counts;
  await page.click('[title^="PIPING and ELECTRICAL"]');
  const all = cell.HIT + cell.CONTACT + cell.CLEARANCE_VIOLATION;
  assert.equal(await page.textContent('.counted'), `${all} of 420 results`);
  await page.click('.pill');
  assert.equal(await page.textContent('.counted'), '420 results');
  assert.deepEqual(faults, []);
  await page.context().close();
});

test('a chosen clash is shown with all its digits, and coloured in the model', async () => {
  const { page, faults } = await openPage(browser, url);
  await page.click('#tab-list');
  await settle(page);
  assert.equal((await places(page, COLOUR_A_HEX)).count, 0);
  await page.click('#results-row-0');
  await settle(page);
  const words = await page.textContent('.details');
  assert.ok(words!.includes(`${small.d[deepest[0]!]!} mm`), words!);
  const [a, b] = [await places(page, COLOUR_A_HEX), await places(page, COLOUR_B_HEX)];
  assert.ok(a.count > 2000 && b.count > 2000, `${a.count} and ${b.count} pixels`);
  // The address is a link to it.
  await page.waitForURL(/#clash=/);
  const link = page.url();
  assert.match(link, /#clash=[0-9a-z]{26}$/);
  const second = await openPage(browser, link);
  await second.page.waitForSelector('.details .depth');
  assert.equal(await second.page.textContent('.details'), words);
  assert.deepEqual([...faults, ...second.faults], []);
  await page.context().close();
  await second.page.context().close();
});

test('the object that is clicked in the model is the one that is told', async () => {
  const { page, faults } = await openPage(browser, url);
  await page.click('#tab-list');
  await page.click('#results-row-0');
  await settle(page);
  const names = await page.locator('.side .object-name').allTextContents();
  for (const [i, colour] of [COLOUR_A_HEX, COLOUR_B_HEX].entries()) {
    await page.click('#results-row-1');
    await page.click('#results-row-0');
    await settle(page);
    const at = await places(page, colour);
    await page.locator('canvas').click({ position: { x: at.x, y: at.y } });
    assert.equal(await page.textContent('.details h2 .object-name'), names[i]);
  }
  assert.deepEqual(faults, []);
  await page.context().close();
});

test('others are hidden, solid, cut away', async () => {
  const { page } = await openPage(browser, url);
  await page.click('#tab-list');
  await page.click('#results-row-0');
  await settle(page);
  const away = async (): Promise<number> =>
    page.evaluate(() => {
      const canvas = document.querySelector('canvas')!;
      const gl = canvas.getContext('webgl2')!;
      const out = new Uint8Array(4 * canvas.width * canvas.height);
      gl.readPixels(0, 0, canvas.width, canvas.height, gl.RGBA, gl.UNSIGNED_BYTE, out);
      let n = 0;
      for (let i = 0; i < out.length; i += 4) if (out[i] === 0xe9 && out[i + 1] === 0xed && out[i + 2] === 0xf1) ++n;
      return n / (canvas.width * canvas.height);
    });
  const ghosts = await away();
  await page.keyboard.press('g');
  await settle(page);
  const solid = await away();
  await page.keyboard.press('g');
  await settle(page);
  const hidden = await away();
  assert.ok(hidden > 0.6 && hidden > ghosts && Math.abs(solid - ghosts) < 0.4, `${ghosts} ${solid} ${hidden}`);
  await page.keyboard.press('g');
  await page.keyboard.press('b');
  await settle(page);
  await page.locator('.section-tools input').fill('10');
  await settle(page);
  assert.ok((await away()) > hidden, 'the section leaves less than the two objects');
  await page.context().close();
});

test('two points are measured', async () => {
  const { page } = await openPage(browser, url);
  await page.click('#tab-list');
  await page.click('#results-row-0');
  await settle(page);
  const [a, b] = [await places(page, COLOUR_A_HEX), await places(page, COLOUR_B_HEX)];
  await page.keyboard.press('m');
  await page.locator('canvas').click({ position: { x: a.x, y: a.y } });
  assert.match((await page.textContent('.measure'))!, /second point/);
  await page.locator('canvas').click({ position: { x: b.x, y: b.y } });
  const words = (await page.textContent('.measure'))!;
  const [, whole, x, y, z] = /([\d,.]+) mm Δx (-?[\d,.]+), Δy (-?[\d,.]+), Δz (-?[\d,.]+)/.exec(words)!.map((s) => Number(s.replaceAll(',', '')));
  assert.ok(whole! > 10 && Math.abs(Math.hypot(x!, y!, z!) - whole!) < 0.2, words);
  await page.keyboard.press('Escape');
  assert.equal(await page.locator('.measure').isVisible(), false);
  await page.context().close();
});

test('search, sorting, groups and keys', async () => {
  const { page, faults } = await openPage(browser, url);
  await page.waitForSelector('.figure');
  await page.keyboard.press('/');
  await page.keyboard.type('000017');
  await page.waitForFunction(() => / of /.test(document.querySelector('.counted')!.textContent!));
  const expected = [...small.a.keys()].filter((i) => small.a[i] === 17 || small.b[i] === 17).length;
  assert.equal(await page.textContent('.counted'), `${expected} of 420 results`);
  await page.fill('.list-head input[type=search]', '');
  await page.waitForFunction(() => document.querySelector('.counted')!.textContent === '420 results');
  await page.click('.table-results [role=columnheader] >> text=d mm');
  const first = await page.textContent('#results-row-0 [aria-colindex="2"]');
  assert.equal(Number(first), Math.round(Math.min(...small.d) * 10) / 10);
  await page.click('.table-results [role=columnheader] >> text=d mm');
  assert.equal(await page.getAttribute('.table-results [role=columnheader]:nth-child(2)', 'aria-sort'), 'descending');
  await page.focus('.table-results');
  await page.keyboard.press('End');
  await page.waitForSelector('#results-row-419[aria-selected=true]');
  await page.keyboard.press('ArrowUp');
  await page.waitForSelector('#results-row-418[aria-selected=true]');
  await page.keyboard.press('j');
  await page.waitForSelector('#results-row-419[aria-selected=true]');
  await page.click('text=Groups');
  assert.equal(await page.textContent('.counted'), '12 groups');
  await page.click('#groups-row-0 button');
  const listed = Number(/^(\d+) of/.exec((await page.textContent('.counted'))!)![1]);
  assert.ok(listed > 0 && listed < 30);
  await page.keyboard.press('?');
  assert.ok(await page.locator('dialog[open]').isVisible());
  await page.keyboard.press('Escape');
  assert.deepEqual(faults, []);
  await page.context().close();
});

test('groups keep to the limits of the list', async () => {
  const { page, faults } = await openPage(browser, url);
  const results = decodeResults(small.blocks.get('strake-results') as Uint8Array<ArrayBuffer>, small.head as unknown as Head);
  const of = (keeps: (i: number) => boolean): { groups: number; results: number; first: number } => {
    const rows = [...small.d.keys()].filter(keeps);
    const groups = new Set(rows.map((i) => results.group![i]!).filter((g) => g < 12));
    return { groups: groups.size, results: rows.length, first: rows.filter((i) => results.group![i] === Math.min(...groups)).length };
  };
  const counted = (): Promise<string | null> => page.textContent('.counted');
  const words = (e: { groups: number; results: number }): string => `${e.groups === 12 ? '12 groups' : `${e.groups} of 12 groups`}, by ${e.results} ${e.results === 1 ? 'result' : 'results'}`;
  await page.click('#tab-list');
  await page.click('.segments >> text=Groups');
  assert.equal(await counted(), '12 groups');
  await page.click('.filters >> text=Too close');
  assert.equal(await counted(), words(of((i) => small.cls[i] === 2)));
  await page.click('.filters >> text=Too close');
  await page.click('.filters .status-1');
  assert.equal(await counted(), words(of((i) => statuses[i] === 1)));
  await page.click('.filters .status-1');
  await page.click('.further summary');
  await page.fill('[aria-label="d to, in millimetres"]', '-120');
  const deep = of((i) => small.d[i]! <= -120);
  assert.ok(deep.groups > 0 && deep.groups < 12, 'the depth tells groups apart');
  assert.equal(await counted(), words(deep));
  assert.equal(await page.textContent('.pill'), 'd to -120 mm ✕');
  // The list of a group has as many rows as its line says.
  await page.locator('.table-groups [role=columnheader] >> text=Group').click();
  const said = Number(/^\d+/.exec((await page.textContent('#groups-row-0 [aria-colindex="4"]'))!)![0]);
  await page.click('#groups-row-0 button');
  assert.equal(await counted(), `${said} of 420 results`);
  await page.click('.pill >> text=d to');
  await page.click('.segments >> text=Groups');
  assert.equal(await counted(), '12 groups');
  await page.selectOption('[aria-label="Discipline of one object"]', { label: 'PIPING' });
  const disciplines = [...small.a.keys()].map((i) => [small.a[i]!, small.b[i]!].map((o) => small.kind[o]!));
  assert.equal(await counted(), words(of((i) => disciplines[i]!.includes(0))));
  await page.selectOption('[aria-label="Discipline of the other object"]', { label: 'EQUIPMENT' });
  assert.equal(await counted(), words(of((i) => disciplines[i]!.includes(0) && disciplines[i]!.includes(3))));
  assert.equal(await page.textContent('.pill'), 'PIPING with EQUIPMENT ✕');
  assert.deepEqual(faults, []);
  await page.context().close();
});

test('drawings: layers, and objects that are picked in both', async () => {
  const { page, faults } = await openPage(browser, url);
  await page.click('#tab-list');
  await page.click('#results-row-0');
  const names = await page.locator('.side .object-name').allTextContents();
  await page.click('#tab-drawings');
  await page.waitForSelector('.paper svg');
  const marked = await page.locator('.paper .marked').evaluateAll((list) => list.map((e) => (e as SVGElement).dataset.id));
  assert.deepEqual([...new Set(marked)].sort(), [...names].sort());
  assert.equal(await page.locator('.paper script, .paper style, .paper [onclick]').count(), 0);
  // The test's drawing has a script and a handler, which the page's policy blocks even before they are left out.
  const own = (list: string[]): string[] => list.filter((f) => !f.includes('The action has been blocked'));
  assert.equal(await page.locator('.layers button').count(), 2);
  await page.click('.layers button >> nth=0');
  assert.equal(await page.locator('.paper .hidden.off').count(), 1);
  const target = page.locator('.paper .visible [data-id]').nth(40);
  const id = await target.getAttribute('data-id');
  await target.dispatchEvent('pointerdown', { pointerId: 1, clientX: 5, clientY: 5 });
  await target.dispatchEvent('pointerup', { pointerId: 1, clientX: 5, clientY: 5 });
  assert.equal(await page.textContent('.details h2 .object-name'), id);
  assert.equal(await page.locator('.paper .marked-one').count(), 2, 'it is marked in both layers');
  // A click a few pixels beside a line means the line; one on empty paper means nothing.
  const line = (await page.locator('.paper .visible .marked-one path').boundingBox())!;
  await page.mouse.click(3 + (await page.locator('.paper').boundingBox())!.x, 3 + (await page.locator('.paper').boundingBox())!.y);
  assert.equal(await page.locator('.paper .marked').count(), 0);
  await page.mouse.click(line.x + line.width / 2, line.y - 3);
  assert.ok((await page.locator('.paper .marked-one').count()) > 0);
  const picked = await page.textContent('.details h2 .object-name');
  assert.ok(names.length === 2 && picked!.length > 0);
  await page.click('.details >> text=Show');
  await settle(page);
  assert.ok((await places(page, 0x009e73)).count > 100, 'it is coloured in the model');
  assert.deepEqual(own(faults), []);
  await page.context().close();
});

test('hostile names are text', async () => {
  const made = ship(SIZES.hostile!);
  const { page, faults } = await openPage(browser, folder.write('hostile.html', pageWith(payload(made.head, made.blocks))));
  await page.waitForSelector('.figure');
  await page.click('#tab-list');
  for (const name of HOSTILE.slice(0, 3)) {
    await page.fill('.list-head input[type=search]', name.split(' ')[0]!);
    await page.waitForTimeout(200);
    await page.click('#results-row-0');
    assert.ok((await page.textContent('.rows'))!.includes(name), name);
  }
  await page.fill('.list-head input[type=search]', '');
  await page.waitForTimeout(200);
  for (let i = 0; i < 12; ++i) await page.keyboard.press('j');
  await page.click('#tab-drawings');
  await page.waitForSelector('.paper svg');
  assert.ok(!(await page.title()).startsWith('owned'));
  assert.equal(await page.locator('main img, main script').count(), 0);
  assert.ok(!(await page.textContent('body'))!.includes('\u202e'));
  // Nothing is wider than the window, however long a name is.
  assert.ok(await page.evaluate(() => document.documentElement.scrollWidth <= innerWidth));
  assert.deepEqual(faults.filter((f) => !f.includes('The action has been blocked')), []);
  await page.context().close();
});

test('a damaged page says so', async () => {
  const text = payload(small.head, small.blocks);
  const lines = text.trimEnd().split('\n');
  const without = (id: string): string => lines.filter((l) => !l.includes(`id="${id}"`)).join('\n');
  const changed = lines.map((l) => (l.includes('id="strake-results"') ? `${l.slice(0, 400)}${l[400] === 'A' ? 'B' : 'A'}${l.slice(401)}` : l)).join('\n');
  const cases: [string, string][] = [
    ['', 'strake-head: it is missing'],
    [without('strake-results'), 'strake-results: it is missing'],
    [changed, 'strake-results: it'],
    [element('strake-head', new TextEncoder().encode('{"format":"strake-page","version":9}')), 'version 9'],
    [element('strake-head', new TextEncoder().encode('{"format":"strake-page","version":1}')), 'head.title'],
  ];
  for (const [i, [damaged, words]] of cases.entries()) {
    const { page } = await openPage(browser, folder.write(`damaged-${i}.html`, pageWith(damaged)));
    const told = (await page.textContent('.failure'))!;
    assert.ok(told.includes('damaged') && told.includes(words), told);
    await page.context().close();
  }
});

test('a page that was cut short says so by itself', async () => {
  const text = pageWith(payload(small.head, small.blocks));
  const context = await browser.newContext();
  const page = await context.newPage();
  await page.goto(folder.write('cut.html', text.slice(0, text.indexOf('strake-results'))));
  const late = page.locator('.late');
  assert.equal(await late.isVisible(), false);
  await late.evaluate((element) => element.getAnimations().forEach((animation) => animation.finish()));
  assert.match((await late.textContent())!, /cut short/);
  assert.ok(await late.isVisible());
  await context.close();
});

test('a damaged model is told in its place, and the lists work', async () => {
  const lines = payload(small.head, small.blocks).trimEnd().split('\n').filter((l) => !l.includes('id="strake-shapes"') && !l.includes('id="strake-drawing-0"'));
  const { page } = await openPage(browser, folder.write('no-model.html', pageWith(lines.join('\n'))));
  await page.click('#tab-list');
  await page.waitForFunction(() => document.querySelector('.stage-note')!.textContent!.includes('strake-shapes: it is missing'));
  await page.click('#results-row-0');
  assert.ok(await page.locator('.details .sentence').isVisible());
  await page.click('#tab-drawings');
  await page.waitForFunction(() => document.querySelector('.paper')!.textContent!.includes('strake-drawing-0: it is missing'));
  await page.context().close();
});

test('without WebGL the lists work and the page says so', async () => {
  const plain = await launch(false);
  const { page } = await openPage(plain, url);
  await page.click('#tab-list');
  await page.waitForFunction(() => document.querySelector('.stage-note')!.textContent!.includes('no WebGL'));
  await page.click('#results-row-0');
  assert.ok(await page.locator('.details .sentence').isVisible());
  await plain.close();
});

test('a page of drawings alone', async () => {
  const made = ship({ objects: 40, results: 0, drawings: 2 });
  const { page, faults } = await openPage(browser, folder.write('drawing.html', pageWith(payload(made.head, made.blocks, false))));
  await page.waitForSelector('.paper svg');
  assert.deepEqual(faults.filter((f) => !f.includes('The action has been blocked')), []);
  await page.context().close();
});

test('what is printed has the rows of the list', async () => {
  const { page } = await openPage(browser, url);
  await page.click('.figure-0');
  await page.evaluate(() => window.dispatchEvent(new Event('beforeprint')));
  await page.emulateMedia({ media: 'print' });
  const hits = small.cls.filter((c) => c === 0).length;
  assert.equal(await page.locator('.print-sheet tbody tr').count(), hits);
  assert.ok(await page.locator('.print-sheet').isVisible());
  assert.equal(await page.locator('main').isVisible(), false);
  await page.context().close();
});

test('groups are printed where groups are listed', async () => {
  const { page } = await openPage(browser, url);
  await page.click('#tab-list');
  await page.click('.segments >> text=Groups');
  await page.click('.filters >> text=Hits');
  const listed = Number(/^\d+/.exec((await page.textContent('.counted'))!)![0]);
  await page.evaluate(() => window.dispatchEvent(new Event('beforeprint')));
  assert.equal(await page.locator('.print-sheet tbody tr').count(), listed);
  assert.equal(await page.textContent('.print-sheet tbody tr:first-child td:nth-child(4)'), await page.textContent('#groups-row-0 [aria-colindex="4"]'));
  await page.context().close();
});

test('a drawing that is looked at is printed, and a chosen clash before the list', async () => {
  const { page } = await openPage(browser, url);
  const print = (): Promise<boolean> => page.evaluate(() => window.dispatchEvent(new Event('beforeprint')));
  await page.click('#tab-drawings');
  await page.waitForSelector('.paper svg');
  await page.click('[aria-label=Larger]');
  await print();
  assert.equal(await page.locator('.print-sheet').count(), 0);
  const whole = await page.getAttribute('.drawings .paper svg', 'data-whole');
  assert.equal(await page.getAttribute('.print-drawing svg', 'viewBox'), whole);
  assert.ok((await page.locator('.print-drawing path').count()) > 0);
  await page.click('#tab-list');
  await page.click('#results-row-0');
  await settle(page);
  await print();
  assert.equal(await page.locator('.print-drawing').count(), 0);
  assert.equal(await page.locator('.print-chosen img').evaluate((img: HTMLImageElement) => img.decode().then(() => img.naturalWidth > 100)), true);
  assert.ok((await page.textContent('.print-chosen'))!.includes(`${small.d[deepest[0]!]!} mm`));
  await page.context().close();
});

test('a group that is chosen shows its worst clash in colour', async () => {
  const { page, faults } = await openPage(browser, url);
  await page.click('#tab-list');
  await page.click('text=Groups');
  await page.click('#groups-row-0');
  await settle(page);
  assert.ok(await page.locator('.legend-pair').isVisible());
  const [a, b] = [await places(page, COLOUR_A_HEX), await places(page, COLOUR_B_HEX)];
  assert.ok(a.count + b.count > 50, `${a.count} and ${b.count} pixels`);
  assert.deepEqual(faults, []);
  await page.context().close();
});

test('the place of a result is never cut', async () => {
  const far = ship({ ...SIZES.small!, far: true });
  const { page } = await openPage(browser, folder.write('far.html', pageWith(payload(far.head, far.blocks))), { viewport: { width: 1500, height: 900 } });
  await page.click('#tab-list');
  const cut = await page.locator('.table-results .rows .row > .right').evaluateAll((cells) => cells.filter((c) => c.scrollWidth > c.clientWidth).map((c) => c.textContent));
  assert.deepEqual(cut, []);
  assert.match((await page.textContent('#results-row-0 [aria-colindex="5"]'))!, /\d{8}/);
  await page.context().close();
});

test('light and dark are switched, in the model as well', async () => {
  const { page } = await openPage(browser, url, { colorScheme: 'light' });
  await page.click('#tab-list');
  await page.click('#results-row-0');
  await page.keyboard.press('g');
  await page.keyboard.press('g');
  await settle(page);
  assert.deepEqual(await pixel(page, 2, 2), [0xe9, 0xed, 0xf1]);
  await page.click('text=Auto');
  await page.click('header >> text=Light');
  await settle(page);
  assert.deepEqual(await pixel(page, 2, 2), [0x13, 0x1b, 0x23]);
  await page.context().close();
});

test('a link that names no clash is told', async () => {
  const { page } = await openPage(browser, `${url}#clash=${key(424242)}`);
  await page.waitForSelector('.details-panel [role=alert]');
  await page.context().close();
});
