// SPDX-License-Identifier: Apache-2.0
// A real Chromium with WebGL in software, and pages opened from disk.
import { mkdtempSync, readFileSync, readdirSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { chromium, type Browser, type BrowserContextOptions, type Page } from 'playwright-core';

const GPU = ['--use-gl=angle', '--use-angle=swiftshader', '--enable-unsafe-swiftshader'];
export const CHROMIUM = process.env.STRAKE_CHROMIUM ?? '/usr/bin/chromium';

export async function launch(webgl = true): Promise<Browser> {
  return chromium.launch({ executablePath: CHROMIUM, args: ['--no-sandbox', ...(webgl ? GPU : ['--disable-gpu', '--disable-3d-apis'])] });
}

export class Folder {
  readonly path = mkdtempSync(join(tmpdir(), 'strake-page-'));
  write(name: string, text: string): string {
    const file = join(this.path, name);
    writeFileSync(file, text);
    return `file://${file}`;
  }
  remove(): void {
    rmSync(this.path, { recursive: true });
  }
}

export interface Opened {
  page: Page;
  /** what a page must never do: errors, and requests beyond itself */
  faults: string[];
}

export async function openPage(browser: Browser, url: string, options: BrowserContextOptions = {}): Promise<Opened> {
  const context = await browser.newContext({ viewport: { width: 1440, height: 900 }, ...options });
  const page = await context.newPage();
  page.setDefaultTimeout(40000);
  const faults: string[] = [];
  page.on('pageerror', (error) => faults.push(String(error)));
  page.on('console', (message) => {
    if (message.type() === 'error') faults.push(message.text());
  });
  page.on('request', (request) => {
    if (request.url() !== url.replace(/#.*/, '') && !request.url().startsWith('data:')) faults.push(`asked for ${request.url()}`);
  });
  await page.goto(url);
  return { page, faults };
}

/** Waits until the model is drawn whole. */
export async function settle(page: Page): Promise<void> {
  await page.waitForSelector('.scene.ready');
  // What was just asked for is drawn from the next frame on.
  await page.evaluate(() => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done))));
  await page.waitForSelector('.stage.settled');
}

/** The colour of a place of the canvas, in its pixels from the top left. */
export async function pixel(page: Page, x: number, y: number): Promise<[number, number, number]> {
  return page.evaluate(([px, py]) => {
    const canvas = document.querySelector('canvas')!;
    const gl = canvas.getContext('webgl2')!;
    const out = new Uint8Array(4);
    const ratio = canvas.width / canvas.clientWidth;
    gl.readPixels(Math.round(px! * ratio), canvas.height - 1 - Math.round(py! * ratio), 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, out);
    return [out[0], out[1], out[2]] as [number, number, number];
  }, [x, y]);
}

/** Places of the canvas whose colour is like an object's: red, green and blue as shares of their sum. */
export async function places(page: Page, rgb: number): Promise<{ count: number; x: number; y: number }> {
  return page.evaluate((wanted) => {
    const canvas = document.querySelector('canvas')!;
    const gl = canvas.getContext('webgl2')!;
    const { width, height } = canvas;
    const out = new Uint8Array(4 * width * height);
    gl.readPixels(0, 0, width, height, gl.RGBA, gl.UNSIGNED_BYTE, out);
    const [r, g, b] = [(wanted >> 16) & 255, (wanted >> 8) & 255, wanted & 255];
    const length = Math.hypot(r, g, b);
    const found: number[] = [];
    for (let i = 0; i < out.length; i += 4) {
      const [p, q, s] = [out[i]!, out[i + 1]!, out[i + 2]!];
      const size = Math.hypot(p, q, s);
      if (size > 60 && (p * r + q * g + s * b) / (size * length) > 0.9995) found.push(i / 4);
    }
    const middle = found[Math.floor(found.length / 2)] ?? 0;
    const ratio = width / canvas.clientWidth;
    return { count: found.length, x: (middle % width) / ratio, y: (height - 1 - Math.floor(middle / width)) / ratio };
  }, rgb);
}

/** CPU seconds of all processes that this one started, so far. */
export function cpuSeconds(): number {
  const parents = new Map<number, { parent: number; ticks: number }>();
  for (const name of readdirSync('/proc')) {
    if (!/^\d+$/.test(name)) continue;
    try {
      const fields = readFileSync(`/proc/${name}/stat`, 'utf8').replace(/^.*\) /, '').split(' ');
      parents.set(Number(name), { parent: Number(fields[1]), ticks: Number(fields[11]) + Number(fields[12]) });
    } catch {
      // It ended meanwhile.
    }
  }
  let ticks = 0;
  for (const [id, own] of parents) {
    let at = id;
    while (at > 1 && at !== process.pid) at = parents.get(at)?.parent ?? 0;
    if (at === process.pid && id !== process.pid) ticks += own.ticks;
  }
  return ticks / 100;
}
