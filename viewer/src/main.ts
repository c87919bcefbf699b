// SPDX-License-Identifier: Apache-2.0
import { App } from './app.ts';
import { openReport, shown } from './data/report.ts';
import { PayloadError } from './payload/errors.ts';
import { decodeHead, HEAD_ID } from './payload/head.ts';
import { dropBlock, findBlock, unpackHead } from './payload/unpack.ts';
import { fill, h } from './ui/dom.ts';

/** Says in the page why there is no report. */
function showError(root: HTMLElement, error: unknown): void {
  const damaged = error instanceof PayloadError;
  fill(
    root,
    h('div', { class: 'failure', role: 'alert' },
      h('h1', {}, damaged ? 'This report is damaged' : 'This report cannot be shown'),
      h('p', {}, damaged
        ? 'A part of the file is missing or was changed, as by a copy that was cut short. Nothing of it is shown, since it might be wrong. Copy the file again, or write it anew.'
        : 'Something went wrong while it was opened. A newer browser may help.'),
      h('p', { class: 'hint' }, damaged ? `${error.block}: ${error.what}` : String(error))),
  );
}

async function open(root: HTMLElement): Promise<void> {
  try {
    if (typeof DecompressionStream === 'undefined') throw new Error('This browser is too old: it needs DecompressionStream.');
    const head = decodeHead(await unpackHead(HEAD_ID, findBlock(HEAD_ID)));
    dropBlock(HEAD_ID);
    document.title = `${shown(head.title).slice(0, 200)} – Strake`;
    const report = await openReport(head);
    new App(report, root).start();
    document.documentElement.dataset.ready = performance.now().toFixed(0);
  } catch (error) {
    showError(root, error);
  }
}

void open(document.getElementById('app')!);
