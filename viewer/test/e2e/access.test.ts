// SPDX-License-Identifier: Apache-2.0
// The page for those who use no mouse or see little: axe in every panel, and all of the model by keys.
import assert from 'node:assert/strict';
import { after, before, test } from 'node:test';
import type { Browser, Page } from 'playwright-core';
import { violations } from '../support/axe.ts';
import { Folder, launch, openPage, places, settle } from '../support/browser.ts';
import { COLOUR_A_HEX, COLOUR_B_HEX } from '../support/colours.ts';
import { pageWith, payload } from '../support/encode.ts';
import { ship } from '../support/ship.ts';
import { SIZES } from '../support/write_page.ts';

let browser: Browser;
const folder = new Folder();
let url = '';
let bare = '';
before(async () => {
  const small = ship(SIZES.small!);
  url = folder.write('small.html', pageWith(payload(small.head, small.blocks)));
  const none = ship({ objects: 30, results: 0, tested: true });
  bare = folder.write('bare.html', pageWith(payload({ ...none.head, no_model: { why: 'It changed.', remedy: 'Test it again.' } }, none.blocks)));
  browser = await launch();
});
after(async () => {
  await browser.close();
  folder.remove();
});

/** Goes through all panels of a page; calls `look` in each. */
async function panels(page: Page, look: (panel: string) => Promise<void>): Promise<void> {
  await page.waitForSelector('.figure');
  await look('overview');
  await page.click('#tab-list');
  await page.click('.further summary');
  await page.click('#results-row-0');
  await settle(page);
  await look('list with a clash');
  await page.keyboard.press('b');
  await page.keyboard.press('m');
  await page.click('.details >> text=Only this one');
  await look('object, section, measuring');
  await page.keyboard.press('m');
  await page.click('.segments >> text=Groups');
  await page.click('#groups-row-0');
  await look('groups');
  await page.fill('.list-head input[type=search]', 'nothing has this name');
  await page.waitForFunction(() => document.querySelector('.counted')!.textContent!.startsWith('0 of'));
  await look('empty list');
  await page.click('#tab-drawings');
  await page.waitForSelector('.paper svg');
  await look('drawings');
  await page.keyboard.press('?');
  await look('help');
}

for (const [scheme, width] of [['light', 1440], ['dark', 1440], ['light', 400], ['dark', 400]] as const) {
  test(`axe finds nothing, ${scheme}, ${width} pixels wide`, async () => {
    const options = { colorScheme: scheme, viewport: { width, height: 850 } };
    const { page } = await openPage(browser, url, options);
    await panels(page, async (panel) => assert.deepEqual(await violations(page), [], panel));
    await page.context().close();
    const { page: none } = await openPage(browser, bare, options);
    await none.waitForSelector('.figure');
    assert.deepEqual(await violations(none), [], 'overview without a clash');
    await none.context().close();
  });
}

test('everything in the model is done by keys', async () => {
  const { page, faults } = await openPage(browser, url);
  await page.waitForSelector('.figure');
  await page.keyboard.press('j');
  await settle(page);
  const names = await page.locator('.side .object-name').allTextContents();
  // From the list the model is a few steps of Tab on.
  await page.focus('.table-results');
  let steps = 0;
  while (!(await page.evaluate(() => document.activeElement instanceof HTMLCanvasElement))) {
    assert.ok(++steps < 60, 'the model is reached');
    await page.keyboard.press('Tab');
  }
  assert.ok(await page.locator('.cross').isVisible());
  // Each way of turning, moving and coming nearer makes another picture.
  const picture = (): Promise<string> => page.evaluate(() => document.querySelector('canvas')!.toDataURL());
  let last = await picture();
  for (const keys of ['ArrowLeft', 'ArrowUp', 'Shift+ArrowRight', 'Shift+ArrowDown', '+', '-', '1', '2', '3', '4', 'f', 'g', 'g', 'b']) {
    await page.keyboard.press(keys);
    await settle(page);
    const now = await picture();
    assert.notEqual(now, last, keys);
    last = now;
  }
  await page.keyboard.press('b');
  await page.keyboard.press('g');
  // The clash is flown to from the list, and what is in the middle is picked.
  await page.keyboard.press('k');
  await settle(page);
  const [a, b] = [await places(page, COLOUR_A_HEX), await places(page, COLOUR_B_HEX)];
  assert.ok(a.count > 100 && b.count > 100);
  await page.keyboard.press('Enter');
  const picked = (await page.textContent('.details h2 .object-name'))!;
  assert.ok(names.includes(picked), picked);
  assert.equal(await page.textContent('.stage .unseen'), `Picked: ${picked}`);
  // Two points in the middle, the model moved between them.
  await page.keyboard.press('m');
  await page.keyboard.press('Enter');
  await page.keyboard.press('Shift+ArrowUp');
  await page.keyboard.press(' ');
  assert.match((await page.textContent('.measure'))!, /mm Δx/);
  await page.keyboard.press('Escape');
  assert.equal(await page.locator('.measure').isVisible(), false);
  assert.deepEqual(faults, []);
  await page.context().close();
});
