// SPDX-License-Identifier: Apache-2.0
// Makes elements. Texts become text nodes, so that no name of an object is ever taken for markup.

type Child = Node | string | undefined | false;
type Handlers = { [K in keyof HTMLElementEventMap as `on${K}`]?: (event: HTMLElementEventMap[K]) => void };
export type Props = Handlers & {
  class?: string;
  /** any other attribute; false and undefined leave it out */
  [attribute: string]: unknown;
};

export function h<K extends keyof HTMLElementTagNameMap>(tag: K, props: Props = {}, ...children: Child[]): HTMLElementTagNameMap[K] {
  const element = document.createElement(tag);
  for (const [name, value] of Object.entries(props)) {
    if (value === undefined || value === false) continue;
    if (name.startsWith('on')) element.addEventListener(name.slice(2), value as EventListener);
    else element.setAttribute(name, value === true ? '' : String(value));
  }
  add(element, ...children);
  return element;
}

export function add(parent: Node, ...children: Child[]): void {
  for (const child of children) {
    if (child === undefined || child === false) continue;
    parent.appendChild(typeof child === 'string' ? document.createTextNode(child) : child);
  }
}

export function fill(parent: Element, ...children: Child[]): void {
  parent.replaceChildren();
  add(parent, ...children);
}

const SVG = 'http://www.w3.org/2000/svg';

export function svg(tag: string, attributes: Record<string, string | number>, ...children: (Node | string)[]): SVGElement {
  const element = document.createElementNS(SVG, tag);
  for (const [name, value] of Object.entries(attributes)) element.setAttribute(name, String(value));
  for (const child of children) element.appendChild(typeof child === 'string' ? document.createTextNode(child) : child);
  return element;
}

/** A switch: pressed or not. */
export function toggle(label: string, pressed: boolean, change: (pressed: boolean) => void, props: Props = {}): HTMLButtonElement {
  const button = h('button', { type: 'button', 'aria-pressed': String(pressed), ...props, class: `toggle ${props.class ?? ''}` }, label);
  button.addEventListener('click', () => {
    const now = button.getAttribute('aria-pressed') !== 'true';
    button.setAttribute('aria-pressed', String(now));
    change(now);
  });
  return button;
}

/** The mark of a class: its colour and a form of its own, so that it is told apart without colours. */
export function classMark(cls: number): HTMLElement {
  return h('span', { class: `mark mark-${['hit', 'contact', 'near'][cls]}`, 'aria-hidden': 'true' });
}

const END = 9;

const TWO_LINES = 40;

/** A name that takes two lines where it has to, or, where even these are too few, loses its middle. */
export function wrappedName(name: string): HTMLElement {
  return name.length > TWO_LINES ? shortName(name) : h('span', { class: 'object-name wrapped' }, name);
}

/** A name that loses its middle where there is no room: ends tell names apart. */
export function shortName(name: string): HTMLElement {
  if (name.length < 2 * END) return h('span', { class: 'object-name' }, name);
  // A character of two units is not cut in two.
  const at = name.length - END - (name.charCodeAt(name.length - END) >> 10 === 0x37 ? 1 : 0);
  return h('span', { class: 'object-name two' }, h('span', { class: 'start' }, name.slice(0, at)), h('span', {}, name.slice(at)));
}
