// SPDX-License-Identifier: Apache-2.0
import { CLASS_MEANINGS, CLASS_WORDS } from '../data/words.ts';
import { classMark, h } from '../ui/dom.ts';

export const KEYS: [string, string][] = [
  ['?', 'this help'],
  ['/', 'search'],
  ['J, K', 'next clash, the one before'],
  ['↑ ↓, Page, Home, End', 'through the table, where it has the focus'],
  ['Enter', 'fly to the clash'],
  ['F', 'the whole model'],
  ['1, 2, 3, 4', 'from the top, the front, the side, askew'],
  ['G', 'other objects: ghosts, solid, hidden'],
  ['B', 'section box round the clash'],
  ['M', 'measure between two points; Esc ends it'],
  ['Arrows, + and −', 'turn the model, nearer and farther, where it has the focus'],
  ['Shift and arrows', 'move the model'],
  ['Enter in the model', 'pick, or measure from, what is in the middle'],
  ['P', 'print'],
  ['Esc', 'close, or give up what is chosen'],
];

export function helpDialog(): HTMLDialogElement {
  const dialog = h('dialog', { class: 'help', 'aria-labelledby': 'help-title' });
  dialog.append(
    h('div', { class: 'details-head' }, h('h2', { id: 'help-title' }, 'How to use this page'), h('button', { type: 'button', class: 'small', 'aria-label': 'Close the help', onclick: () => dialog.close() }, '✕')),
    h('p', {}, 'Choose a clash in the list: the model flies to it, object A is orange, object B is blue. Click an object in the model or in a drawing to see what it is. Nothing of this page goes over the network.'),
    h('h3', {}, 'What the words mean'),
    h('ul', { class: 'plain-list' }, ...CLASS_WORDS.map((word, i) => h('li', {}, classMark(i), h('b', {}, ` ${word}: `), CLASS_MEANINGS[i]!)), h('li', {}, h('b', {}, 'd: '), 'how far the two are apart, in millimetres; less than 0 is how deep they are in each other.')),
    h('h3', {}, 'Mouse and fingers'),
    h('p', {}, 'Drag to turn, drag with the right button or two fingers to move, wheel or pinch to come nearer.'),
    h('h3', {}, 'Keys'),
    h('dl', { class: 'pairs keys' }, ...KEYS.flatMap(([key, what]) => [h('dt', {}, h('kbd', {}, key)), h('dd', {}, what)])),
  );
  return dialog;
}
