// SPDX-License-Identifier: Apache-2.0
// What may go wrong around a page: no model, no clash, a model without size or far away, a graphics card that gives up, paper.
import assert from 'node:assert/strict';
import { after, before, test } from 'node:test';
import type { Browser, Page } from 'playwright-core';
import { Folder, launch, openPage, places, settle } from '../support/browser.ts';
import { COLOUR_A_HEX, COLOUR_B_HEX } from '../support/colours.ts';
import { pageWith, payload } from '../support/encode.ts';
import { HOSTILE, key, ship, type Sizes } from '../support/ship.ts';
import { SIZES } from '../support/write_page.ts';

let browser: Browser;
const folder = new Folder();
before(async () => {
  browser = await launch();
});
after(async () => {
  await browser.close();
  folder.remove();
});

function pageOf(name: string, sizes: Sizes, members: object = {}): string {
  const made = ship(sizes);
  return folder.write(`${name}.html`, pageWith(payload({ ...made.head, ...members }, made.blocks)));
}

/** Pixels of the two objects. */
async function pair(page: Page): Promise<[number, number]> {
  return [(await places(page, COLOUR_A_HEX)).count, (await places(page, COLOUR_B_HEX)).count];
}

test('a page without a model says why, and what helps', async () => {
  const why = `The model changed. ${HOSTILE[0]!}\u202e`;
  const { page, faults } = await openPage(browser, pageOf('without', { objects: 50, results: 60 }, { no_model: { why, remedy: "'strake clash -p ship.strake' tests it." } }));
  await page.click('#tab-list');
  const told = (await page.textContent('.stage-note'))!;
  assert.ok(told.includes(`The model changed. ${HOSTILE[0]!}\ufffd`) && told.includes("'strake clash -p ship.strake' tests it."), told);
  assert.equal(await page.locator('.tools').isVisible(), false);
  await page.click('#results-row-0');
  assert.ok(await page.locator('.details .sentence').isVisible());
  assert.ok(await page.locator('.stage-note').isVisible(), 'it stays');
  for (const shortcut of ['f', '1', 'g', 'b', 'm', 'Enter']) await page.keyboard.press(shortcut);
  await page.click('#tab-overview');
  assert.ok((await page.textContent('.overview'))!.includes('The model changed.'));
  assert.deepEqual(faults, []);
  await page.context().close();
  const { page: older } = await openPage(browser, pageOf('older', { objects: 50, results: 60 }));
  await older.click('#tab-list');
  assert.match((await older.textContent('.stage-note'))!, /without the model/);
  await older.context().close();
});

test('a run that found nothing', async () => {
  const { page, faults } = await openPage(browser, pageOf('nothing', { objects: 30, results: 0, tested: true, scene: true }));
  await page.waitForSelector('.figure');
  assert.deepEqual(await page.locator('.figure-number').allTextContents(), ['0', '0', '0']);
  assert.match((await page.textContent('.overview'))!, /No two of the objects/);
  assert.equal(await page.textContent('#tab-list'), 'Model');
  await page.click('#tab-list');
  await settle(page);
  await page.locator('canvas').click();
  for (const shortcut of ['j', '/', 'Enter', 'Escape', 'b', 'm']) await page.keyboard.press(shortcut);
  await page.evaluate(() => window.dispatchEvent(new Event('beforeprint')));
  assert.match((await page.textContent('.print-sheet'))!, /0 hits/);
  assert.deepEqual(faults, []);
  await page.context().close();
});

test('a single clash', async () => {
  const { page, faults } = await openPage(browser, pageOf('one', { objects: 2, results: 1, scene: true, groups: 1 }));
  await page.click('#tab-list');
  assert.equal(await page.textContent('.counted'), '1 result');
  await page.keyboard.press('j');
  await page.keyboard.press('j');
  await settle(page);
  assert.ok((await pair(page)).every((n) => n > 100));
  assert.deepEqual(faults, []);
  await page.context().close();
});

test('objects without size: no number is lost, and the place is shown', async () => {
  const { page, faults } = await openPage(browser, pageOf('points', { objects: 40, results: 60, scene: true, boxes: 40, points: true }));
  await page.click('#tab-list');
  await page.click('#results-row-0');
  await settle(page);
  assert.ok(await page.locator('.depth-label').isVisible());
  for (const shortcut of ['b', 'f', '1', '2', '3', '4', 'Enter']) await page.keyboard.press(shortcut);
  await settle(page);
  const label = await page.locator('.depth-label').evaluate((e) => [Number((e as HTMLElement).dataset.x), Number((e as HTMLElement).dataset.y)]);
  assert.ok(label.every((v) => Number.isFinite(v)), String(label));
  await page.click('.details >> text=Only this one');
  assert.deepEqual(faults, []);
  await page.context().close();
});

test('a model ten kilometres away is drawn, picked and measured as one at hand', async () => {
  const seen: unknown[] = [];
  for (const far of [false, true]) {
    const { page, faults } = await openPage(browser, pageOf(`far-${far}`, { ...SIZES.small!, far }));
    await page.click('#tab-list');
    await page.click('#results-row-0');
    await settle(page);
    const [a, b] = [await places(page, COLOUR_A_HEX), await places(page, COLOUR_B_HEX)];
    assert.ok(a.count > 1000 && b.count > 1000);
    await page.keyboard.press('m');
    await page.locator('canvas').click({ position: { x: a.x, y: a.y } });
    await page.locator('canvas').click({ position: { x: b.x, y: b.y } });
    const measured = await page.textContent('.measure');
    await page.keyboard.press('m');
    await page.locator('canvas').click({ position: { x: a.x, y: a.y } });
    seen.push([a, b, measured, await page.textContent('.details h2 .object-name')]);
    assert.deepEqual(faults, []);
    await page.context().close();
  }
  assert.deepEqual(seen[1], seen[0]);
});

test('a graphics card that gives up is told, and the picture comes back', async () => {
  const { page, faults } = await openPage(browser, pageOf('lost', SIZES.small!));
  await page.click('#tab-list');
  await page.click('#results-row-0');
  await settle(page);
  const before_ = await pair(page);
  await page.evaluate(() => ((window as any).loss = document.querySelector('canvas')!.getContext('webgl2')!.getExtension('WEBGL_lose_context'))!.loseContext());
  await page.waitForFunction(() => document.querySelector('.stage-note')!.textContent!.includes('graphics card'));
  assert.ok(await page.locator('.stage-note').isVisible());
  // The list goes on meanwhile.
  await page.click('#results-row-1');
  await page.click('#results-row-0');
  assert.ok(await page.locator('.details .sentence').isVisible());
  await page.evaluate(() => (window as any).loss.restoreContext());
  await page.waitForFunction(() => !document.querySelector('.scene')!.classList.contains('lost'));
  await settle(page);
  assert.deepEqual(await pair(page), before_);
  assert.equal(await page.locator('.stage-note').isVisible(), false);
  assert.deepEqual(faults.filter((f) => !f.includes('Context Lost')), []);
  await page.context().close();
});

test('a page that may keep nothing and tell no address', async () => {
  const url = pageOf('kept', SIZES.small!);
  const context = await browser.newContext({ viewport: { width: 1440, height: 900 } });
  const page = await context.newPage();
  const faults: string[] = [];
  page.on('pageerror', (error) => faults.push(String(error)));
  await page.addInitScript(() => {
    for (const store of ['localStorage', 'sessionStorage', 'indexedDB', 'caches']) {
      Object.defineProperty(window, store, { get() {
        throw new DOMException('refused', 'SecurityError');
      } });
    }
    Object.assign(history, { replaceState() {
      throw new DOMException('refused', 'SecurityError');
    } });
  });
  await page.goto(url);
  await page.click('#tab-list');
  await page.click('#results-row-0');
  await page.waitForTimeout(300);
  await page.click('text=Auto');
  await page.keyboard.press('Escape');
  await page.waitForTimeout(300);
  assert.deepEqual(faults, []);
  await context.close();
});

test('a link to a clash that is no more says so, and the list goes on', async () => {
  for (const gone of [key(424242), 'short', 'x'.repeat(10000)]) {
    const { page, faults } = await openPage(browser, `${pageOf('gone', SIZES.small!)}#clash=${gone}`);
    assert.match((await page.textContent('.details-panel [role=alert]'))!, /no clash of the key/);
    await page.keyboard.press('j');
    assert.ok(await page.locator('.details .sentence').isVisible());
    assert.equal(await page.locator('.details-panel [role=alert]').count(), 0);
    assert.deepEqual(faults, []);
    await page.context().close();
  }
});

test('several hundred rows on paper: all of them, on many sheets', async () => {
  const { page } = await openPage(browser, pageOf('paper', { ...SIZES.small!, results: 640, hostile: true }));
  await page.click('#tab-list');
  await page.evaluate(() => window.dispatchEvent(new Event('beforeprint')));
  assert.equal(await page.locator('.print-sheet tbody tr').count(), 640);
  // Nothing is wider than the paper: it would be cut off.
  await page.emulateMedia({ media: 'print' });
  await page.setViewportSize({ width: 1032, height: 700 });
  const wide = await page.locator('.print-sheet').evaluate((sheet) => sheet.scrollWidth - sheet.clientWidth);
  assert.ok(wide <= 0, `${wide} pixels too wide`);
  await page.emulateMedia({ media: null });
  const paper = await page.pdf({ preferCSSPageSize: true });
  const sheets = paper.toString('latin1').match(/\/Type\s*\/Page\b(?!s)/g)!.length;
  assert.ok(sheets > 10 && sheets < 60, `${sheets} sheets`);
  await page.context().close();
});

test('names of ten thousand characters bend nothing, at three widths', async () => {
  const url = pageOf('long', SIZES.hostile!);
  for (const width of [1440, 800, 390]) {
    const { page, faults } = await openPage(browser, url, { viewport: { width, height: 850 } });
    await page.click('#tab-list');
    await page.fill('.list-head input[type=search]', 'long');
    await page.waitForFunction(() => / of /.test(document.querySelector('.counted')!.textContent!));
    await page.click('#results-row-0');
    const fits = (): Promise<boolean> => page.evaluate(() => document.documentElement.scrollWidth <= innerWidth && [...document.querySelectorAll('.details-panel, .list, .scene')].every((e) => e.scrollWidth <= e.clientWidth + 1));
    assert.ok(await fits(), `a clash, ${width}`);
    await page.click('.segments >> text=Groups');
    if ((await page.locator('#groups-row-0').count()) > 0) await page.click('#groups-row-0');
    assert.ok(await fits(), `groups, ${width}`);
    assert.deepEqual(faults.filter((f) => !f.includes('The action has been blocked')), []);
    await page.context().close();
  }
});
