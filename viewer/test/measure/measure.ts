// SPDX-License-Identifier: Apache-2.0
// Measures pages in a real Chromium with WebGL in software: how long they take to open, and to answer a click.
//
//   npm run measure -- [--runs N] [--clicks N] [--program FILE]... PAGE...
//
// A PAGE is a file that Strake wrote, or the name of a synthetic one (small, platform, ship). With --program its program is taken out of that
// file, as viewer/built/report.html; several are measured in turn, run by run, so that what else the machine does meets all alike.
// Medians of the runs: by the clock, and in seconds of CPU of the page's own process (renderer), of the one that draws
// (GPU, which in software is the graphics card as well) and of all of the browser.
import { readFileSync, statSync } from 'node:fs';
import { parseArgs } from 'node:util';
import type { Browser, Page } from 'playwright-core';
import { PLACE } from '../support/encode.ts';
import { Folder, launch, settle } from '../support/browser.ts';
import { pageOf, SIZES } from '../support/write_page.ts';

interface Cpu {
  renderer: number;
  gpu: number;
  all: number;
}

interface Run {
  list: number;
  model: number;
  opening: Cpu;
  /** milliseconds until each click was answered on the screen */
  clicks: number[];
  /** of one click, with the pictures that follow until the next one */
  click: Cpu;
}

const ELEMENTS = /<script type="application\/octet-stream(?:\+gzip)?" id="strake-[^\n]*<\/script>\n/g;

/** A page with the payload of one file and the program of another. */
function withProgram(page: string, program: string | undefined): string {
  if (program === undefined) return page;
  const payload = (page.match(ELEMENTS) ?? []).join('');
  const text = readFileSync(program, 'utf8').replace(ELEMENTS, '');
  // A page that was written has no place any more; its payload stood before the program.
  return text.includes(PLACE) ? text.replace(PLACE, () => payload) : text.replace('<script>', () => `${payload}<script>`);
}

const TICKS = 100;

/** CPU seconds of the processes of a browser so far. */
async function cpu(browser: Browser): Promise<Cpu> {
  const session = await browser.newBrowserCDPSession();
  const { processInfo } = await session.send('SystemInfo.getProcessInfo');
  await session.detach();
  const sum: Cpu = { renderer: 0, gpu: 0, all: 0 };
  for (const { type, id } of processInfo) {
    const fields = readFileSync(`/proc/${id}/stat`, 'utf8').replace(/^.*\) /, '').split(' ');
    const seconds = (Number(fields[11]) + Number(fields[12])) / TICKS;
    sum.all += seconds;
    if (type === 'renderer') sum.renderer += seconds;
    if (type === 'GPU') sum.gpu += seconds;
  }
  return sum;
}

function less(after: Cpu, before: Cpu, shares = 1): Cpu {
  const of = (name: keyof Cpu): number => (after[name] - before[name]) / shares;
  return { renderer: of('renderer'), gpu: of('gpu'), all: of('all') };
}

function median(values: number[]): number {
  const sorted = values.slice().sort((p, q) => p - q);
  return (sorted[(sorted.length - 1) >> 1]! + sorted[sorted.length >> 1]!) / 2;
}

/** Clicks on a row as a hand does; milliseconds until what came of it was on the screen, as the browser itself tells it. */
async function click(page: Page, row: number): Promise<number> {
  const box = (await page.locator(`#results-row-${row}`).boundingBox())!;
  const before = await page.evaluate(() => (window as any).seen.clicks.length as number);
  await page.mouse.click(box.x + 20, box.y + box.height / 2);
  await page.waitForFunction((n) => (window as any).seen.clicks.length > n, before);
  return page.evaluate(() => (window as any).seen.clicks.at(-1) as number);
}

async function run(url: string, clicks: number): Promise<Run> {
  const browser = await launch();
  try {
    const page = await (await browser.newContext({ viewport: { width: 1440, height: 900 } })).newPage();
    page.setDefaultTimeout(180000);
    await page.addInitScript(() => {
      const seen = ((window as any).seen = { clicks: [] } as { list?: number; model?: number; clicks: number[] });
      new PerformanceObserver((list) => {
        for (const entry of list.getEntries()) if (entry.name === 'click') seen.clicks.push(entry.duration);
      }).observe({ type: 'event', durationThreshold: 16 } as PerformanceObserverInit);
      new MutationObserver(() => {
        if (document.documentElement?.dataset.ready) seen.list ??= performance.now();
        if (document.querySelector('.scene.ready')) seen.model ??= performance.now();
      }).observe(document, { subtree: true, attributes: true, childList: true });
    });
    // What the browser does as it starts is none of the page's.
    await page.goto('about:blank');
    await page.waitForTimeout(300);
    const before = await cpu(browser);
    await page.goto(url);
    await page.waitForSelector('.scene.ready', { state: 'attached' });
    await page.evaluate(() => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done))));
    const opening = less(await cpu(browser), before);
    const { list, model } = (await page.evaluate(() => (window as any).seen)) as { list: number; model: number };
    await page.click('#tab-list');
    // The first clicks compile programs. The whole of a large model is not waited for.
    for (let i = 0; i < 4; ++i) await click(page, i);
    await settle(page);
    const start = await cpu(browser);
    const times: number[] = [];
    for (let i = 0; i < clicks; ++i) times.push(await click(page, i % 14));
    return { list, model, opening, clicks: times, click: less(await cpu(browser), start, clicks) };
  } finally {
    await browser.close();
  }
}

const { values, positionals } = parseArgs({
  options: { runs: { type: 'string', default: '5' }, clicks: { type: 'string', default: '28' }, program: { type: 'string', multiple: true } },
  allowPositionals: true,
});
if (positionals.length === 0) throw new Error('measure.ts [--runs N] [--clicks N] [--program FILE]... PAGE...');
const programs = values.program ?? [undefined];
const folder = new Folder();
const ms = (seconds: number): string => (1000 * seconds).toFixed(0);
console.log('| page | program | MB | list, s | model, s | CPU to open, s: renderer, GPU, all | click, ms | worst of ten | CPU of a click, ms: renderer, GPU, all |');
console.log('|---|---|---:|---:|---:|---:|---:|---:|---:|');
try {
  for (const name of positionals) {
    const text = name in SIZES ? pageOf(name) : readFileSync(name, 'utf8');
    const urls = programs.map((program, i) => folder.write(`${i}.html`, withProgram(text, program)));
    const runs: Run[][] = urls.map(() => []);
    for (let r = 0; r < Number(values.runs); ++r) for (const [i, url] of urls.entries()) runs[i]!.push(await run(url, Number(values.clicks)));
    for (const [i, list] of runs.entries()) {
      const of = (get: (r: Run) => number): number => median(list.map(get));
      const three = (get: (r: Run) => Cpu, form: (s: number) => string): string => (['renderer', 'gpu', 'all'] as const).map((k) => form(of((r) => get(r)[k]))).join(', ');
      const times = list.flatMap((r) => r.clicks).sort((p, q) => p - q);
      const size = statSync(new URL(urls[i]!)).size / 1e6;
      console.log(`| ${name.replace(/^.*\//, '')} | ${programs[i]?.replace(/^.*\//, '') ?? 'its own'} | ${size.toFixed(1)} | ${(of((r) => r.list) / 1000).toFixed(2)} | ${(of((r) => r.model) / 1000).toFixed(2)} | ${three((r) => r.opening, (s) => s.toFixed(2))} | ${median(times).toFixed(0)} | ${times[Math.floor(times.length * 0.9)]!.toFixed(0)} | ${three((r) => r.click, ms)} |`);
    }
  }
} finally {
  folder.remove();
}
