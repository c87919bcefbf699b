// SPDX-License-Identifier: Apache-2.0
// Builds built/report.html: the page with its program and styles in it, and the place for the payload.
// With --check it only looks whether the committed page is what a build from these sources gives.
import { createHash } from 'node:crypto';
import { readFile, writeFile } from 'node:fs/promises';
import { build, transform } from 'esbuild';

const here = new URL('.', import.meta.url);
const output = new URL('built/report.html', here);
const read = (name) => readFile(new URL(name, here), 'utf8');
const hash = (text) => `'sha256-${createHash('sha256').update(text, 'utf8').digest('base64')}'`;

async function script() {
  const result = await build({
    entryPoints: [new URL('src/main.ts', here).pathname],
    absWorkingDir: here.pathname,
    bundle: true,
    minify: true,
    write: false,
    format: 'iife',
    target: ['chrome111', 'firefox115', 'safari16.4'],
    charset: 'ascii',
    legalComments: 'eof',
  });
  // What would end the element that the program stands in, or begin a comment of the markup.
  return result.outputFiles[0].text.replaceAll('</script', '<\\/script').replaceAll('<!--', '<\\!--');
}

async function style() {
  return (await transform((await read('src/style.css')) + (await read('src/live/live.css')), { loader: 'css', minify: true, target: ['chrome111', 'firefox115', 'safari16.4'] })).code;
}

async function page() {
  const parts = { STYLE: await style(), SCRIPT: await script() };
  // Nothing is loaded and nothing is sent; of scripts and styles these two alone are run.
  parts.CSP = `default-src 'none'; script-src ${hash(parts.SCRIPT)}; style-src ${hash(parts.STYLE)}; img-src data: blob:; base-uri 'none'; form-action 'none'`;
  const text = (await read('src/page.html')).replace(/%(STYLE|SCRIPT|CSP)%/g, (_, name) => parts[name]);
  if (text.split('<!--strake:payload-->').length !== 2) throw new Error('the page must have one place for the payload');
  return text;
}

const text = await page();
if (process.argv.includes('--check')) {
  if ((await read('built/report.html').catch(() => '')) !== text) {
    console.error('viewer/built/report.html is not what a build gives: npm run build');
    process.exit(1);
  }
  console.log('viewer/built/report.html is what a build gives');
} else {
  await writeFile(output, text);
  console.log(`viewer/built/report.html: ${(text.length / 1000).toFixed(0)} kB`);
}
