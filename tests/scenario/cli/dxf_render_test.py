#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""dxf_render_test.py STRAKE: LibreCAD draws of the DXF the picture that rsvg-convert draws of the SVG.

Without LibreCAD, rsvg-convert or pdftoppm the script ends with 77: skipped."""
import os
import re
import shutil
import subprocess
import sys

from scenario import Scenario, main, rvm_of_round_things

DOTS_PER_INCH = 100
# How far ink may be from ink of the other, in dots: two programs do not round alike, and pens differ a little.
NEAR = 2
# The share of dots that may be farther away: ends of lines are round in one program and square in the other.
ODD = .002


class Render(Scenario):
    def run_tool(self, *command):
        subprocess.run(command, cwd=self.folder, check=True, capture_output=True, timeout=120,
                       env={**os.environ, 'QT_QPA_PLATFORM': 'offscreen', 'HOME': str(self.folder),
                            'XDG_RUNTIME_DIR': str(self.folder)})

    def without_sheet(self, name):
        """The DXF without what lies on paper, which LibreCAD draws over model space; the SVG without its title."""
        lines = (self.folder / f'{name}.dxf').read_text(encoding='utf-8').split('\n')
        records, record = [], []
        for code, value in zip(lines[::2], lines[1::2]):
            if code == '0' and record:
                records.append(record)
                record = []
            record.append((code, value))
        records.append(record)
        kept = [record for record in records if ('67', '1') not in record or record[0][1] in ('BLOCK', 'ENDBLK')]
        self.write(f'{name}.dxf', ''.join(f'{code}\n{value}\n' for record in kept for code, value in record))
        svg = (self.folder / f'{name}.svg').read_text(encoding='utf-8')
        self.write(f'{name}.svg', re.sub(r'<g [^>]*id="title".*?</g>', '', svg, flags=re.DOTALL))

    def rows(self, name):
        """The ink of a page as a number for each row of dots, from the corner of what is drawn."""
        self.run_tool('pdftoppm', '-r', str(DOTS_PER_INCH), '-gray', '-singlefile', f'{name}.pdf', name)
        _, size, _, dots = (self.folder / f'{name}.pgm').read_bytes().split(b'\n', 3)
        width, height = map(int, size.split())
        dark = [[x for x in range(width) if dots[y * width + x] < 255] for y in range(height)]
        left = min(row[0] for row in dark if row)
        inked = [y for y, row in enumerate(dark) if row]
        return [sum(1 << (x - left) for x in row) for row in dark[inked[0]:inked[-1] + 1]]

    @staticmethod
    def centred(rows, others):
        """The rows moved so that what is drawn has its middle where the other has it: pens are not as wide."""
        down = max(0, len(others) - len(rows)) // 2
        wider = max(row.bit_length() for row in others) - max(row.bit_length() for row in rows)
        return [0] * down + [row << max(0, wider) // 2 for row in rows]

    @staticmethod
    def far(rows, others):
        """The share of ink that has no ink of the other near it."""
        for _ in range(NEAR):
            others = [row | row << 1 | row >> 1 for row in others]
        grown = [0] * max(len(rows), len(others) + NEAR)
        for y, row in enumerate(others):
            for near in range(max(0, y - NEAR), min(len(grown), y + NEAR + 1)):
                grown[near] |= row
        return sum((row & ~grown[y]).bit_count() for y, row in enumerate(rows)) / sum(row.bit_count() for row in rows)

    def test_two_programs_draw_one_picture(self):
        self.write_rvm('round.rvm', rvm_of_round_things())
        self.text('generate', 'ship', '--objects', 200, '--seed', 4, '-o', 'ship.glb', '--quiet')
        for name, scale, arguments in (('ship_top', 50, ['ship.glb', '--view', 'top']),
                                       ('ship_iso', 50, ['ship.glb', '--view', 'iso']),
                                       ('ship_cut', 50, ['ship.glb', '--view', 'front', '--section', 'y=1m']),
                                       ('round_top', 10, ['round.rvm', '--view', 'top']),
                                       ('round_iso', 10, ['round.rvm', '--view', 'iso']),
                                       ('round_askew', 10, ['round.rvm', '--direction', '3,-7,2'])):
            with self.subTest(name):
                self.text('draw', *arguments, '--scale', f'1:{scale}', '--paper', 'A0', '-o', f'{name}.dxf', '-o',
                          f'{name}.svg', '--quiet')
                self.without_sheet(name)
                self.run_tool('librecad', 'dxf2pdf', '-c', '-m', '-s', str(1 / scale), '-p', '1189x841', f'{name}.dxf')
                cad = self.rows(name)
                self.run_tool('rsvg-convert', '-f', 'pdf', '-o', f'{name}.pdf', f'{name}.svg')
                svg = self.rows(name)
                self.assertLess(abs(len(cad) - len(svg)), 2 * NEAR)
                cad, svg = self.centred(cad, svg), self.centred(svg, cad)
                self.assertLess(self.far(cad, svg), ODD)
                self.assertLess(self.far(svg, cad), ODD)


if __name__ == '__main__':
    if not all(map(shutil.which, ('librecad', 'rsvg-convert', 'pdftoppm'))):
        sys.exit(77)
    main()
