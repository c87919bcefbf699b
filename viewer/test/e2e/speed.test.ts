// SPDX-License-Identifier: Apache-2.0
// Large pages work, and what they take is printed: seconds of the CPU of all of the browser, less what it takes for a page
// without a payload, since a clock on a shared machine says little. No test depends on them.
import assert from 'node:assert/strict';
import { after, before, test } from 'node:test';
import type { Browser, Page } from 'playwright-core';
import { cpuSeconds, Folder, launch, openPage, settle } from '../support/browser.ts';
import { pageWith } from '../support/encode.ts';
import { pageOf } from '../support/write_page.ts';

let browser: Browser;
let empty = 0;
const folder = new Folder();
before(async () => {
  browser = await launch();
  const url = folder.write('empty.html', pageWith(''));
  for (let i = 0; i < 2; ++i) {
    const start = cpuSeconds();
    const { page } = await openPage(browser, url);
    await page.waitForSelector('.failure');
    empty = cpuSeconds() - start;
    await page.context().close();
  }
});
after(async () => {
  await browser.close();
  folder.remove();
});

/** Clicks through rows, each until the first picture with the two objects is there. Seconds of CPU for each. */
async function clicks(page: Page, rows: number): Promise<number> {
  const start = cpuSeconds();
  for (let i = 0; i < rows; ++i) {
    await page.evaluate(async (row) => {
      const gl = document.querySelector('canvas')!.getContext('webgl2')!;
      document.getElementById(`results-row-${row}`)!.click();
      await new Promise((done) => requestAnimationFrame(done));
      gl.readPixels(0, 0, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, new Uint8Array(4));
    }, i);
  }
  return (cpuSeconds() - start) / rows;
}

test('a platform of 20,000 objects and 35,000 results', async (t) => {
  const text = pageOf('platform');
  const url = folder.write('platform.html', text);
  const before_ = cpuSeconds();
  const { page, faults } = await openPage(browser, url);
  await page.waitForSelector('html[data-ready]');
  const open = cpuSeconds() - before_ - empty;
  const ready = await page.evaluate(() => document.documentElement.dataset.ready);
  await page.click('#tab-list');
  await settle(page);
  const model = cpuSeconds() - before_ - empty;
  await clicks(page, 4);
  const click = await clicks(page, 15);
  t.diagnostic(`${(text.length / 1e6).toFixed(1)} MB; list ${open.toFixed(2)} s of CPU, (${ready} ms by the clock), model drawn ${model.toFixed(2)} s, a click ${(1000 * click).toFixed(0)} ms`);
  assert.deepEqual(faults, []);
  await page.context().close();
});

test('a list of 1.5 million rows, to its end', async (t) => {
  const text = pageOf('rows');
  const url = folder.write('rows.html', text);
  const before_ = cpuSeconds();
  const { page, faults } = await openPage(browser, url);
  await page.waitForSelector('html[data-ready]');
  const open = cpuSeconds() - before_ - empty;
  await page.click('#tab-list');
  await page.focus('.table-results');
  await page.keyboard.press('End');
  await page.waitForSelector('#results-row-1499999[aria-selected=true]');
  const box = (await page.locator('#results-row-1499999').boundingBox())!;
  const view = (await page.locator('.table-results').boundingBox())!;
  assert.ok(box.y >= view.y && box.y + box.height <= view.y + view.height + 1, 'the last row is in view');
  await page.keyboard.press('ArrowUp');
  await page.waitForSelector('#results-row-1499998[aria-selected=true]');
  // The bar reaches every part, and the wheel goes row by row.
  await page.evaluate(() => {
    const s = document.querySelector('.table-results')!;
    s.scrollTop = s.scrollHeight / 2;
  });
  const middle = async (): Promise<number> => page.locator('.rows .row').evaluateAll((rows) => Math.min(...rows.map((r) => Number(r.id.replace('results-row-', '')))));
  await page.waitForFunction(() => [...document.querySelectorAll('.rows .row')].some((r) => Math.abs(Number(r.id.replace('results-row-', '')) - 750000) < 2000));
  const at = await middle();
  await page.mouse.move(view.x + 50, view.y + 100);
  await page.mouse.wheel(0, 380);
  await page.waitForTimeout(300);
  assert.ok(Math.abs((await middle()) - at - 10) <= 1, 'ten rows on');
  assert.ok((await page.locator('.rows .row').count()) < 60);
  const sorting = cpuSeconds();
  await page.click('.table-results [role=columnheader] >> text=Place');
  await page.waitForSelector('.table-results [aria-sort=ascending] >> text=Place');
  t.diagnostic(`${(text.length / 1e6).toFixed(1)} MB; list ${open.toFixed(2)} s of CPU, sorted in ${(cpuSeconds() - sorting).toFixed(2)} s`);
  assert.deepEqual(faults, []);
  await page.context().close();
});

test('a ship of a million objects and 15,000 clashes', async (t) => {
  const text = pageOf('ship');
  assert.ok(text.length < 60e6, `${text.length} bytes`);
  const url = folder.write('ship.html', text);
  const before_ = cpuSeconds();
  const { page, faults } = await openPage(browser, url);
  await page.waitForSelector('html[data-ready]');
  const open = cpuSeconds() - before_ - empty;
  await page.click('#tab-list');
  await page.click('#results-row-0');
  await page.waitForSelector('.scene.ready');
  const model = cpuSeconds() - before_ - empty;
  await settle(page);
  await clicks(page, 4);
  const click = await clicks(page, 10);
  t.diagnostic(`${(text.length / 1e6).toFixed(1)} MB; list ${open.toFixed(2)} s of CPU, model ${model.toFixed(2)} s, a click ${(1000 * click).toFixed(0)} ms`);
  assert.deepEqual(faults, []);
  await page.context().close();
});
