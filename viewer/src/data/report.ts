// SPDX-License-Identifier: Apache-2.0
// The report that the page is about: the decoded payload, and questions on it that several views ask.
import type { Head } from '../payload/head.ts';
import {
  type Boxes, BOXES_ID, CLASSES, decodeBoxes, decodeGroups, decodeInstances, decodeObjects, decodeRegions, decodeResults, decodeShapes,
  type Groups, GROUPS_ID, INSTANCES_ID, type Model, NONE16, type Objects, OBJECTS_ID, type Regions, REGIONS_ID, type Results,
  RESULTS_ID, SHAPES_ID,
} from '../payload/payload.ts';
import { PayloadError } from '../payload/errors.ts';
import { dropBlock, findBlock, unpack } from '../payload/unpack.ts';

/** What hides in a name is made to show: control characters, and marks that turn the direction of writing. */
export function shown(text: string): string {
  return text.replace(/[\p{Cc}\u061c\u200b-\u200f\u2028-\u202e\u2060-\u2069\ufeff]/gu, '\ufffd');
}

/** What people wrote, in their lines. */
export function shownLines(text: string): string {
  return text.split(/\r\n?|\n/).map(shown).join('\n');
}

export interface Report {
  head: Head;
  objects: Objects | undefined;
  results: Results | undefined;
  groups: Groups | undefined;
  regions: Regions | undefined;
}

function sizeOf(head: Head, id: string): number | undefined {
  return head.blocks.find((b) => b.id === id)?.bytes;
}

/** Unpacks a block that the head lists. */
async function open(head: Head, id: string): Promise<Uint8Array<ArrayBuffer> | undefined> {
  const size = sizeOf(head, id);
  if (size === undefined) return undefined;
  const bytes = await unpack(id, findBlock(id), size);
  dropBlock(id);
  return bytes;
}

async function need(head: Head, id: string): Promise<Uint8Array<ArrayBuffer>> {
  const bytes = await open(head, id);
  if (!bytes) throw new PayloadError(id, 'the head does not list it');
  return bytes;
}

/** Reads what the table needs. Throws PayloadError. */
export async function openReport(head: Head): Promise<Report> {
  const { counts } = head;
  const objects = counts.objects > 0 ? decodeObjects(await need(head, OBJECTS_ID), head) : undefined;
  const results = counts.results > 0 ? decodeResults(await need(head, RESULTS_ID), head) : undefined;
  const groups = counts.groups > 0 ? decodeGroups(await need(head, GROUPS_ID), head) : undefined;
  const regions = await open(head, REGIONS_ID);
  return { head, objects, results, groups, regions: regions && decodeRegions(regions, head) };
}

/** Reads the model, which the table does not wait for. Throws PayloadError. */
export async function openModel(head: Head): Promise<Model | undefined> {
  if (!head.scene) return undefined;
  const shapes = decodeShapes(await need(head, SHAPES_ID));
  const instances = decodeInstances(await need(head, INSTANCES_ID), head, shapes);
  const packed = await open(head, BOXES_ID);
  const boxes: Boxes | undefined = packed && decodeBoxes(packed, head);
  return { shapes, instances, boxes };
}

/** Why a page without a model has none, and what helps. */
export function withoutModel(head: Head): [string, string | undefined] {
  const { why, remedy } = head.no_model ?? { why: 'This page has the lists without the model.' };
  return [shown(why), remedy === undefined ? undefined : shown(remedy)];
}

/** Reads the text of a drawing. Throws PayloadError. */
export async function openDrawing(head: Head, number: number): Promise<string> {
  const id = `strake-drawing-${number}`;
  try {
    return new TextDecoder('utf-8', { fatal: true }).decode(await need(head, id));
  } catch (error) {
    if (error instanceof PayloadError) throw error;
    throw new PayloadError(id, 'it is no text');
  }
}

const NAME_IS_ID = 2;

export function objectId(objects: Objects, object: number): string {
  return objects.id.at(object);
}

/** The name of an object, with what would not show replaced; never blank. */
export function objectName(objects: Objects, object: number): string {
  const name = shown((objects.flags[object]! & NAME_IS_ID) !== 0 ? objects.id.at(object) : objects.names.at(object));
  if (name.trim() !== '') return name;
  const id = shown(objects.id.at(object));
  return id.trim() !== '' ? id : '(no name)';
}

export function fileName(report: Report, object: number): string {
  return shown(report.head.files[report.objects!.file[object]!] ?? '');
}

/** Of what discipline a side of a result is, as a number into head.disciplines, or -1. */
export function disciplineOf(report: Report, result: number, side: 'a' | 'b'): number {
  const results = report.results!;
  const own = (side === 'a' ? results.discipline_a : results.discipline_b)?.[result];
  const number = own ?? report.objects!.discipline?.[results[side][result]!] ?? NONE16;
  return number === NONE16 ? -1 : number;
}

/** Whether the matrix goes by disciplines; else it goes by files. */
export function hasDisciplines(report: Report): boolean {
  return report.head.disciplines.length > 0 && (report.results?.discipline_a !== undefined || report.objects?.discipline !== undefined);
}

/** The row and column of the matrix that a side belongs to, -1 for what has no discipline. */
export function cellOf(report: Report, result: number, side: 'a' | 'b', byDiscipline: boolean): number {
  return byDiscipline ? disciplineOf(report, result, side) : report.objects!.file[report.results![side][result]!]!;
}

export function className(cls: number): string {
  return CLASSES[cls] ?? '';
}

/** Sums of all tests, as the document counts them. */
export function totals(head: Head): Record<'HIT' | 'CONTACT' | 'CLEARANCE_VIOLATION' | 'ALLOWED', number> {
  const sum = { HIT: 0, CONTACT: 0, CLEARANCE_VIOLATION: 0, ALLOWED: 0 };
  for (const test of head.clash?.tests ?? []) for (const name of ['HIT', 'CONTACT', 'CLEARANCE_VIOLATION', 'ALLOWED'] as const) sum[name] += test.counts[name];
  return sum;
}
