// SPDX-License-Identifier: Apache-2.0
// A page that 'strake view' serves, in Chromium: what is set there is in the project, and the other way round.
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { createRequire } from 'node:module';
import { after, before, test } from 'node:test';
import type { Browser, BrowserContextOptions, Page } from 'playwright-core';
import { launch } from '../support/browser.ts';
import { PROGRAM, ServedProject } from '../support/served.ts';

const skip = PROGRAM === undefined && 'STRAKE_PROGRAM does not name the program';
const axe = readFileSync(createRequire(import.meta.url).resolve('axe-core/axe.min.js'), 'utf8');
let browser: Browser;
let project: ServedProject;
let address = '';

before(async () => {
  if (skip) return;
  project = new ServedProject();
  address = await project.serve();
  browser = await launch();
});
after(async () => {
  if (skip) return;
  await browser.close();
  await project.remove();
});

interface Served {
  page: Page;
  faults: string[];
}

async function open(url = address, options: BrowserContextOptions = {}): Promise<Served> {
  const page = await (await browser.newContext({ viewport: { width: 1440, height: 900 }, ...options })).newPage();
  page.setDefaultTimeout(40000);
  const faults: string[] = [];
  page.on('pageerror', (error) => faults.push(String(error)));
  page.on('request', (request) => {
    if (!/^(data|blob):/.test(request.url()) && new URL(request.url()).origin !== new URL(address).origin) faults.push(`asked for ${request.url()}`);
  });
  await page.goto(url);
  await page.waitForSelector('.figure');
  return { page, faults };
}

async function choose(page: Page, row: number): Promise<string> {
  await page.click('#tab-list');
  await page.click(`#results-row-${row} > :nth-child(2)`);
  await page.waitForSelector('.decide');
  return (await page.textContent('.details code'))!;
}

// ‘Not saved for’ is something else.
const saved = (page: Page): Promise<unknown> => page.waitForFunction(() => document.querySelector('.decide-told')?.textContent?.startsWith('Saved for'));

test('what is set is in the project, the list and the overview', { skip }, async () => {
  const { page, faults } = await open();
  assert.doesNotMatch(page.url(), /token/, 'the token is not left in the address');
  const key = await choose(page, 0);
  await page.selectOption('#decide-status', 'reviewed');
  await page.fill('#decide-assignee', 'Bob <b>');
  await page.fill('#decide-comment', 'move it "up"');
  await page.click('.decide button[type=submit]');
  await saved(page);
  assert.deepEqual(project.clash(key), { status: 'reviewed', assignee: 'Bob <b>', comment: 'move it "up"' });
  assert.equal(await page.textContent('#results-row-0 .chip'), 'Reviewed');
  assert.match((await page.textContent('.details'))!, /move it "up"/);
  assert.match((await page.textContent('.view-overview .chip.status-2'))!, /Reviewed 1/);
  // A filter by status finds it, and a second page has it from the start.
  await page.click('.filters .status-2');
  assert.match((await page.textContent('.counted'))!, /^1 of /);
  const second = await open();
  await choose(second.page, 0);
  await second.page.waitForFunction(() => document.querySelector('.view-overview .chip.status-2')?.textContent === 'Reviewed 1');
  assert.deepEqual([...faults, ...second.faults], []);
  await page.context().close();
  await second.page.context().close();
});

test('who approves one clash after another stays where they are in the list', { skip }, async () => {
  const { page, faults } = await open();
  const keys = [await choose(page, 14)];
  const approve = async (): Promise<void> => {
    await page.selectOption('#decide-status', 'approved');
    await page.click('.decide button[type=submit]');
    await saved(page);
    await page.focus('.table-results');
  };
  await approve();
  assert.equal(await page.textContent('#results-row-14 .chip'), 'Approved');
  await page.keyboard.press('j');
  keys.push((await page.textContent('.details code'))!);
  assert.equal(await page.getAttribute('#results-row-15', 'aria-selected'), 'true');
  // Where the list leaves out what is approved, the next one follows all the same.
  await page.getByRole('button', { name: 'Open only' }).click();
  const row = Number((await page.getAttribute('.table-results [aria-selected=true]', 'id'))!.replace('results-row-', ''));
  const after = await page.textContent(`#results-row-${row + 1}`);
  await approve();
  await page.keyboard.press('j');
  assert.equal(await page.textContent(`#results-row-${row}[aria-selected=true]`), after);
  for (const key of keys) assert.equal(project.clash(key).status, 'approved');
  assert.deepEqual(faults, []);
  await page.context().close();
});

test('what was not saved is told to who has gone on', { skip }, async () => {
  const { page, faults } = await open();
  const key = await choose(page, 8);
  await page.route('**/api/state*', (route) => route.abort());
  await page.waitForSelector('.live-bar:has-text("does not answer")');
  project.run('clash', 'set', '-p', 'ship.strake', key, '--status', 'resolved', '--by', 'Eve');
  let goOn = (): void => undefined;
  const gone = new Promise<void>((done) => (goOn = done));
  await page.route('**/api/decide', async (route) => {
    await gone;
    await route.continue();
  });
  await page.selectOption('#decide-status', 'approved');
  await page.click('.decide button[type=submit]');
  await page.click('#results-row-9 > :nth-child(2)');
  goOn();
  await page.waitForSelector('.decide-told [role=alert]:has-text("Eve made it resolved meanwhile")');
  await page.unroute('**/api/decide');
  assert.equal(project.clash(key).status, 'resolved');
  assert.deepEqual(faults, []);
  await page.context().close();
});

test('several are marked with the keys and decided about at once', { skip }, async () => {
  const { page, faults } = await open();
  await choose(page, 3);
  await page.focus('.table-results');
  for (let i = 0; i < 3; ++i) {
    await page.keyboard.press('Space');
    await page.keyboard.press('ArrowDown');
  }
  assert.equal(await page.textContent('.marks-told'), '3 clashes marked');
  await page.locator('#results-row-7 .mark-box').click();
  await page.locator('#results-row-9 .mark-box').click({ modifiers: ['Shift'] });
  assert.equal(await page.textContent('.marks-told'), '6 clashes marked');
  await page.getByRole('button', { name: 'Decide', exact: true }).click();
  assert.match((await page.textContent('.details h2'))!, /6 marked clashes/);
  await page.selectOption('#decide-status', 'approved');
  await page.focus('#decide-status');
  await page.keyboard.press('Tab');
  await page.keyboard.type('jkpg');
  assert.equal(await page.inputValue('#decide-assignee'), 'jkpg', 'letters are no shortcuts here');
  await page.keyboard.press('Control+Enter');
  await page.waitForSelector('.decide-told:has-text("Saved for 6 clashes")');
  assert.match(project.run('clash', 'list', '-p', 'ship.strake', '--status', 'approved', '--json'), /(?:jkpg[^]*){6}/);
  assert.deepEqual(faults, []);
  await page.context().close();
});

test('a group is decided about', { skip }, async () => {
  const { page, faults } = await open();
  await page.click('#tab-list');
  await page.getByRole('button', { name: 'Groups', exact: true }).click();
  await page.click('#groups-row-0 > :nth-child(3)');
  await page.waitForSelector('.decide');
  await page.fill('#decide-comment', 'as a group');
  await page.click('.decide button[type=submit]');
  await saved(page);
  const count = Number(/Saved for (\d+)/.exec((await page.textContent('.decide-told'))!)![1]);
  const listed = JSON.parse(project.run('clash', 'list', '-p', 'ship.strake', '--json')) as { clashes: { comment?: string }[] };
  assert.equal(listed.clashes.filter((c) => c.comment === 'as a group').length, count);
  assert.ok(count > 0);
  assert.deepEqual(faults, []);
  await page.context().close();
});

test('what others decide shows, and is not overwritten unseen', { skip }, async () => {
  const { page, faults } = await open();
  const key = await choose(page, 12);
  project.run('clash', 'set', '-p', 'ship.strake', key, '--status', 'resolved', '--by', 'Eve');
  await page.waitForFunction(() => document.querySelector('#results-row-12 .chip')?.textContent === 'Resolved');
  // The next time the page does not know of it yet.
  await page.route('**/api/state*', (route) => route.abort());
  await page.waitForSelector('.live-bar:has-text("does not answer")');
  project.run('clash', 'set', '-p', 'ship.strake', key, '--status', 'active', '--by', 'Eve');
  await page.selectOption('#decide-status', 'approved');
  await page.click('.decide button[type=submit]');
  await page.waitForSelector('.decide-told [role=alert]');
  assert.match((await page.textContent('.decide-told'))!, /Eve made it active meanwhile/);
  assert.equal(project.clash(key).status, 'active');
  await page.click('.decide button[type=submit]');
  await saved(page);
  assert.equal(project.clash(key).status, 'approved');
  assert.deepEqual(faults, []);
  await page.context().close();
});

test('a new run is told and loaded', { skip }, async () => {
  const { page, faults } = await open();
  const key = await choose(page, 10);
  project.run('clash', '-p', 'ship.strake', '--clearance', '25mm', '--group-by', 'element');
  await page.waitForSelector('.live-bar:has-text("Run 2 has tested this project")');
  await Promise.all([page.waitForEvent('load'), page.click('.live-bar button')]);
  await page.waitForSelector('.decide');
  assert.equal(await page.textContent('.details code'), key, 'the clash that was looked at');
  assert.equal(await page.textContent('.live-bar'), '');
  assert.deepEqual(faults, []);
  await page.context().close();
});

test('axe finds nothing wrong, light or dark, wide or narrow', { skip }, async () => {
  for (const [colorScheme, width] of [['light', 1440], ['dark', 1440], ['light', 400]] as const) {
    const { page } = await open(address, { colorScheme, viewport: { width, height: 900 }, reducedMotion: 'reduce' });
    await choose(page, 0);
    await page.locator('#results-row-1 .mark-box').click();
    await page.evaluate(axe);
    const wrong = await page.evaluate(async () => {
      const result = await (window as any).axe.run(document, { resultTypes: ['violations'] });
      return result.violations.map((v: any) => `${v.id}: ${v.nodes.map((n: any) => `${n.target} ${n.failureSummary}`).join(' | ').slice(0, 600)}`);
    });
    assert.deepEqual(wrong, [], `${colorScheme} ${width}`);
    await page.context().close();
  }
});

test('pages of others and the file itself set nothing', { skip }, async () => {
  const context = await browser.newContext();
  const page = await context.newPage();
  // Another origin on this machine asks as a browser lets it.
  await page.route('http://evil.example/', (route) => route.fulfill({ body: '<title>evil</title>', contentType: 'text/html' }));
  await page.goto('http://evil.example/');
  const { origin } = new URL(address);
  const token = new URL(address).searchParams.get('token')!;
  const asked = await page.evaluate(async ([at, secret]) => {
    const tries: string[] = [];
    for (const options of [{}, { mode: 'no-cors' }, { headers: { 'Strake-Token': secret! } }, { method: 'POST', body: '{}', headers: { 'Content-Type': 'text/plain' } }] as RequestInit[]) {
      tries.push(await fetch(`${at}/api/state?event=0`, options).then((answer) => `${answer.type} ${answer.status}`, () => 'refused'));
    }
    return tries;
  }, [origin, token]);
  assert.deepEqual(asked.filter((answer) => !['refused', 'opaque 0'].includes(answer)), []);
  // The page that is saved has no controls.
  project.run('report', '-p', 'ship.strake', '-o', 'report.html');
  await page.goto(`file://${project.folder}/report.html`);
  await page.click('#tab-list');
  await page.click('#results-row-0');
  await page.waitForSelector('.details .depth');
  assert.equal(await page.locator('.decide, .marks, .mark-box, .live-bar').count(), 0);
  await context.close();
});

test('a server that has ended is told', { skip }, async () => {
  const { page } = await open();
  await choose(page, 0);
  assert.equal(await project.stop(), 0);
  await page.waitForSelector('.live-bar:has-text("does not answer")');
  await page.fill('#decide-comment', 'too late');
  await page.click('.decide button[type=submit]');
  await page.waitForSelector('.decide-told [role=alert]:has-text("It is not known whether it was saved")');
  await page.context().close();
});
