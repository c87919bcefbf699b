// SPDX-License-Identifier: Apache-2.0
// Takes of an SVG what draws, and nothing that does anything else: elements and attributes of a list, made anew.

import { styleRules } from './drawing_styles.ts';

const SVG = 'http://www.w3.org/2000/svg';

const ATTRIBUTES_OF_ALL = ['class', 'id', 'transform', 'data-id', 'data-name', 'data-file', 'data-view', 'data-scale', 'data-style'];
const ELEMENTS: Record<string, readonly string[]> = {
  svg: ['viewBox', 'width', 'height'],
  g: [],
  path: ['d'],
  rect: ['x', 'y', 'width', 'height', 'rx', 'ry'],
  circle: ['cx', 'cy', 'r'],
  ellipse: ['cx', 'cy', 'rx', 'ry'],
  line: ['x1', 'y1', 'x2', 'y2'],
  polyline: ['points'],
  polygon: ['points'],
  text: ['x', 'y', 'dx', 'dy', 'text-anchor', 'font-size', 'textLength', 'lengthAdjust'],
  tspan: ['x', 'y', 'dx', 'dy'],
  title: [],
};
const PAINT = ['fill', 'stroke', 'stroke-width', 'stroke-dasharray', 'stroke-linecap', 'stroke-linejoin', 'fill-rule', 'fill-opacity'];
// A paint that names a place elsewhere is none.
const PLAIN_PAINT = /^[#\w\s.,%()-]*$/;
const INKSCAPE = 'http://www.inkscape.org/namespaces/inkscape';

export interface DrawingLayer {
  label: string;
  group: SVGGElement;
  /** how many layers it lies in */
  depth: number;
}

export interface CleanDrawing {
  svg: SVGSVGElement;
  /** in the order of the file, those within another behind it */
  layers: DrawingLayer[];
  /** what lies in the layers of a style of objects, as a discipline is, by its name */
  styles: Map<string, SVGGElement[]>;
  /** its pens and colours */
  rules: string;
  /** what can be picked: id, file, element */
  objects: { id: string; file: string; element: SVGElement }[];
}

/** Reads a drawing, or returns undefined where it is no SVG. It gets a class of its own, for its rules. */
export function cleanSvg(text: string, ownClass: string): CleanDrawing | undefined {
  // Styles would not be taken either; this spares the browser a complaint about each that the page forbids it.
  const plain = text.replace(/<style>[^<]*<\/style>/g, '').replace(/ style="stroke-dasharray:/g, ' data-dash="');
  const parsed = new DOMParser().parseFromString(plain, 'image/svg+xml');
  const root = parsed.documentElement;
  if (root.localName !== 'svg' || root.namespaceURI !== SVG || parsed.querySelector('parsererror')) return undefined;
  const found: CleanDrawing = { svg: undefined as unknown as SVGSVGElement, layers: [], styles: new Map(), rules: styleRules(text, `.paper .${ownClass}`), objects: [] };
  found.svg = taken(root, found, 0, 0) as SVGSVGElement;
  found.svg.classList.add(ownClass);
  return found;
}

// Drawings of this program are six deep; more would only fill the stack.
const DEEPEST = 64;

function taken(from: Element, found: CleanDrawing, depth: number, layers: number): SVGElement {
  const name = from.localName;
  const element = document.createElementNS(SVG, name) as SVGElement;
  for (const attribute of [...ATTRIBUTES_OF_ALL, ...ELEMENTS[name]!]) {
    const value = from.getAttribute(attribute);
    // Ids of a drawing would be those of the page.
    if (value !== null) element.setAttribute(attribute === 'id' ? 'data-layer' : attribute, value);
  }
  for (const attribute of PAINT) {
    const value = from.getAttribute(attribute);
    if (value !== null && PLAIN_PAINT.test(value) && !/url/i.test(value)) element.setAttribute(attribute, value);
  }
  // Dashes are fitted to each line, and stand at it.
  const dashes = /^([\d. ]+|none)$/.exec(from.getAttribute('data-dash') ?? '')?.[1];
  if (dashes !== undefined) element.style.strokeDasharray = dashes;
  if (name === 'g' && from.getAttributeNS(INKSCAPE, 'groupmode') === 'layer') {
    found.layers.push({ label: from.getAttributeNS(INKSCAPE, 'label') ?? from.id, group: element as SVGGElement, depth: layers });
    ++layers;
    const style = from.getAttribute('data-style');
    if (style !== null) found.styles.set(style, [...found.styles.get(style) ?? [], element as SVGGElement]);
  }
  const id = from.getAttribute('data-id');
  if (id !== null) found.objects.push({ id, file: from.getAttribute('data-file') ?? '', element });
  for (const child of from.childNodes) {
    if (child.nodeType === Node.TEXT_NODE && (name === 'text' || name === 'tspan' || name === 'title')) element.append(child.textContent ?? '');
    else if (child instanceof Element && child.namespaceURI === SVG && Object.hasOwn(ELEMENTS, child.localName) && depth < DEEPEST) element.append(taken(child, found, depth + 1, layers));
  }
  return element;
}
