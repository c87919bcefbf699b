// SPDX-License-Identifier: Apache-2.0
// Writes a synthetic page: npx tsx test/support/write_page.ts small|platform|rows|ship FILE.html
import { writeFileSync } from 'node:fs';
import { pageWith, payload } from './encode.ts';
import { ship, type Sizes } from './ship.ts';

export const SIZES: Record<string, Sizes> = {
  small: { objects: 300, results: 420, scene: true, groups: 12, trend: 9, decisions: true, drawings: 2 },
  hostile: { objects: 60, results: 80, scene: true, groups: 6, decisions: true, drawings: 1, hostile: true },
  platform: { objects: 20000, results: 35000, scene: true, groups: 400, trend: 30 },
  rows: { objects: 20000, results: 1500000 },
  ship: { objects: 40000, boxes: 960000, results: 15000, scene: true, groups: 900 },
};

/** The text of a page of one of the sizes. */
export function pageOf(name: string): string {
  const sizes = SIZES[name];
  if (!sizes) throw new Error(`no such page: ${name}`);
  const { head, blocks } = ship(sizes);
  return pageWith(payload(head, blocks));
}

if (process.argv[1]?.endsWith('write_page.ts')) {
  const [name, file] = process.argv.slice(2);
  if (!name || !file) throw new Error('write_page.ts NAME FILE');
  writeFileSync(file, pageOf(name));
}
