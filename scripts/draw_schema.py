#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""draw_schema.py PROJECT OUT: the tables of a project file as a picture, OUT.svg: a box for each with its columns, an arrow for
each reference. docs/pictures/project-schema.svg is made by it, and a test sees to it that it is that of today."""
import contextlib
import html
import sqlite3
import sys
from pathlib import Path

# What stands below each other, and what the columns of the picture are about.
COLUMNS = [('The model', ['file', 'map_place', 'file_block', 'shape_pack', 'model_seal']),
           ('What became of it', ['revision', 'changed_file', 'changed_object']),
            ('Tests', ['test', 'report', 'report_part', 'snapshot_part', 'test_objects', 'run', 'run_test', 'run_report', 'run_result']),
            ('Clashes', ['clash', 'event', 'said', 'former', 'unseen']),
           ('Views', ['view', 'drawing', 'drawing_part', 'drawing_objects'])]
WIDTH, BETWEEN, LINE, MARGIN = 176, 52, 15, 16
STYLE = """text { font: 11px sans-serif; fill: #222 } .table { font-weight: bold } .part { font-size: 13px; fill: #555 }
.box { fill: #fff; stroke: #888 } .head { fill: #dde7f0; stroke: #888 } .type { fill: #888; text-anchor: end }
.key { font-weight: bold } .to { fill: none; stroke: #36648b; marker-end: url(#arrow) }"""


def tables_of(database):
    """Of each table its columns (name, type, whether it is the key) and references (column, table)."""
    names = [name for name, in database.execute(
        "SELECT name FROM sqlite_schema WHERE type = 'table' AND name NOT LIKE 'sqlite_%' ORDER BY name")]
    return {name: ([(row[1], row[2].lower(), bool(row[5])) for row in database.execute(f'PRAGMA table_info({name})')],
                   [(row[3], row[2]) for row in database.execute(f'PRAGMA foreign_key_list({name})')]) for name in names}


class Picture:
    """Boxes at their places, then the arrows between them."""

    def __init__(self, tables):
        self.tables, self.out, self.at, self.height = tables, [], {}, 0
        placed = [name for _, names in COLUMNS for name in names]
        if sorted(placed) != sorted(tables):
            sys.exit(f'{Path(__file__).name}: its columns do not have the tables that there are: {sorted(set(placed) ^ set(tables))}')

    def text(self, x, y, words, kind='plain'):
        self.out.append(f'<text class="{kind}" x="{x}" y="{y}">{html.escape(words)}</text>')

    def box(self, name, x, y):
        columns, _ = self.tables[name]
        height = LINE * (len(columns) + 1) + 8
        self.out.append(f'<rect class="box" x="{x}" y="{y}" width="{WIDTH}" height="{height}"/>')
        self.out.append(f'<rect class="head" x="{x}" y="{y}" width="{WIDTH}" height="{LINE + 3}"/>')
        self.text(x + 6, y + 13, name, 'table')
        self.at[name] = (x, y + 9)
        for number, (column, kind, key) in enumerate(columns, 1):
            row = y + LINE * number + 16
            self.at[name, column] = (x, row - 4)
            self.text(x + 6, row, column, 'key' if key else '')
            self.text(x + WIDTH - 6, row, kind, 'type')
        self.height = max(self.height, y + height)
        return height

    def arrow(self, start, end):
        """From the side of a row to the side of a head: the sides that look at each other, or both left."""
        (x, y), (to_x, to_y) = start, end
        leave, come = (26, -26) if x < to_x else (-26, 26) if x > to_x else (-26, -26)
        x += WIDTH if leave > 0 else 0
        to_x += WIDTH if come > 0 else 0
        self.out.append(f'<path class="to" d="M {x} {y} C {x + leave} {y}, {to_x + come} {to_y}, {to_x} {to_y}"/>')

    def svg(self):
        for number, (title, names) in enumerate(COLUMNS):
            x, y = MARGIN + 26 + number * (WIDTH + BETWEEN), 44
            self.text(x, 28, title, 'part')
            for name in names:
                y += self.box(name, x, y) + 22
        for name, (_, references) in self.tables.items():
            for column, other in sorted(references):
                self.arrow(self.at[name, column], self.at[other])
        width = 2 * MARGIN + 26 + len(COLUMNS) * (WIDTH + BETWEEN) - BETWEEN
        return '\n'.join([
            f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width} {self.height + MARGIN}" width="{width}">',
            f'<style>{STYLE}</style>',
            '<defs><marker id="arrow" viewBox="0 0 8 8" refX="8" refY="4" markerWidth="8" markerHeight="8" orient="auto">'
            '<path d="M 0 0 L 8 4 L 0 8 Z" fill="#36648b"/></marker></defs>',
            f'<rect width="{width}" height="{self.height + MARGIN}" fill="#fff"/>', *self.out, '</svg>', ''])


def main():
    project, out = sys.argv[1:]
    with contextlib.closing(sqlite3.connect(f'file:{Path(project).resolve()}?mode=ro', uri=True)) as database:
        Path(out).write_text(Picture(tables_of(database)).svg(), encoding='utf-8')


if __name__ == '__main__':
    main()
