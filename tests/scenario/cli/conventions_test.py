#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""conventions_test.py STRAKE: dense lines thinned, break lines at limits, pipes as single lines; in every format and in sheets."""
import json
import re
import zlib

from dxf_file import read
from scenario import Scenario, cube, main, rvm, rvm_of_round_things


def corrugated(name, folds, step, height):
    """A wall of one sheet, folded every `step` along x, as high as `height`."""
    lines = [f'o {name}']
    for i in range(folds + 1):
        lines += [f'v {i * step} {step if i % 2 else 0} {z}' for z in (0, height)]
    lines += [f'f {2 * i + 1} {2 * i + 3} {2 * i + 4} {2 * i + 2}' for i in range(folds)]
    return '\n'.join(lines) + '\n'


def pdf_streams(content):
    found = [zlib.decompress(part) for part in re.findall(rb'/FlateDecode[^>]*>>\s*stream\r?\n(.*?)\r?\nendstream', content, re.S)]
    return b''.join(found)


class Conventions(Scenario):
    RUN = ['--unit', 'mm', '--up-axis', 'z', '--view', 'front', '--scale', '1:50']

    def drawn(self, *more, outputs=('x.svg',)):
        done = self.run_strake('draw', *more, *(part for name in outputs for part in ('-o', name)))
        self.assertEqual(done.returncode, 0, done.stderr)
        return done.stderr, [(self.folder / name).read_bytes() for name in outputs]

    def test_a_corrugated_wall_does_not_fill_to_black(self):
        self.write('wall.obj', corrugated('wall', 400, 10, 2000))
        outputs = ('x.svg', 'x.pdf', 'x.dxf', 'x.json')
        _, plain = self.drawn('wall.obj', *self.RUN, outputs=outputs)
        expected = None
        for threads in (1, 3, 8):
            reported, thinned = self.drawn('wall.obj', *self.RUN, '--thin', '1mm', '--threads', threads, outputs=outputs)
            expected = expected or thinned
            self.assertEqual(thinned, expected, threads)
        # Folds 0.2 mm apart on paper: of 401 upright lines every fifth stays.
        self.assertIn('320 lines of 1 object too near to each other on paper are left out or shortened (1 mm)', reported)
        self.assertIn(b'lines-thinned="320"', thinned[0])
        upright = [len(re.findall(rb'M[\d.]+ [\d.]+V', text[0]) or re.findall(rb'M', text[0])) for text in (plain, thinned)]
        self.assertLess(upright[1], upright[0] / 3)
        self.assertLess(len(pdf_streams(thinned[1])), len(pdf_streams(plain[1])))
        # Model space at true size, and the neutral drawing, have every line.
        self.assertEqual(thinned[2], plain[2])
        self.assertEqual(thinned[3], plain[3])
        _, (requested,) = self.drawn('wall.obj', *self.RUN, '--thin', '1mm+dxf', outputs=('x.dxf',))
        self.assertLess(len(requested), len(plain[2]) / 2)
        # A neutral drawing is thinned when it is written again.
        self.drawn('wall.obj', *self.RUN, outputs=('w.json',))
        _, (again,) = self.drawn('w.json', '--thin', '1mm')
        self.assertEqual(again, thinned[0])

    def test_break_lines_close_what_limits_cut(self):
        self.write('m.obj', cube('beam', 0, (0, 0, 0), 1000) + cube('whole', 8, (2000, 0, 0), 300))
        run = ['m.obj', *self.RUN, '--limits', '-100,-5m,-5m,500,5m,5m']
        _, (off,) = self.drawn(*run)
        self.assertNotIn(b'break', off)
        expected = None
        for threads in (1, 4):
            _, made = self.drawn(*run, '--break-lines', 'on', '--threads', threads, outputs=('x.svg', 'x.pdf', 'x.dxf'))
            expected = expected or made
            self.assertEqual(made, expected)
        layer = re.search(rb'id="break-lines" class="break">\n<path d="([^"]*)"/>', made[0])
        self.assertTrue(layer)
        self.assertEqual(layer[1].count(b'M'), 1)
        self.assertEqual(made[0].replace(layer[0], b'').count(b'break'), 1)  # and the style
        self.assertIn(b'Break lines', made[1])
        document, faults = read(self.folder / 'x.dxf')
        self.assertEqual(faults, [])
        self.assertEqual(len([entity for entity in document.modelspace() if entity.dxf.layer == 'AM_4_BREAK']), 1)
        _, (beside, _) = self.drawn(*run, '--break-lines', 'on', outputs=('x.svg', 'w.json'))
        _, (again,) = self.drawn('w.json', '--break-lines', 'on')
        self.assertEqual(again, beside)
        # Clipped lines that no output lists are not in the hash.
        self.assertEqual(*(re.sub(rb' hash="[0-9a-f]+"', b'', svg) for svg in (beside, made[0])))

    def test_thin_pipes_are_single_lines(self):
        self.folder.joinpath('round.rvm').write_bytes(rvm(rvm_of_round_things()))
        run = ['round.rvm', '--view', 'front', '--scale', '1:10', '--single-line', '105mm']
        expected = None
        for threads in (1, 4):
            reported, made = self.drawn(*run, '--threads', threads, outputs=('x.svg', 'x.pdf', 'x.dxf', 'x.json', 'x.view'))
            expected = expected or made
            self.assertEqual(made, expected)
        self.assertIn('2 pieces of pipes drawn as single lines (up to 105 mm)', reported)
        self.assertIn(b'class="visible single_line"', made[0])
        pieces = [p for p in json.loads(made[3])['pieces'] if p['kind'] == 'single_line']
        self.assertEqual(len({p['object'] for p in pieces}), 2)
        for piece in pieces:
            self.assertEqual(piece['a_mm'][:2], piece['b_mm'][:2])  # upright pipes
        done = self.run_strake('draw', 'x.json', '--single-line', '105mm', '-o', 'y.svg')
        self.assertEqual(done.returncode, 2, done.stderr)
        self.assertIn('--single-line', done.stderr)
        _, (again,) = self.drawn('x.view', outputs=('x.json',))
        self.assertEqual(again, made[3])
        # Which pipes are lines is a setting that a comparison tells.
        self.assertEqual(json.loads(made[3])['settings']['single_line_mm'], 105)
        self.drawn(*run[:-2], outputs=('plain.json',))
        done = self.run_strake('draw', 'diff', 'plain.json', 'x.json')
        self.assertIn('settings.single_line_mm', done.stdout)

    def test_a_project_keeps_them(self):
        self.folder.joinpath('round.rvm').write_bytes(rvm(rvm_of_round_things()))
        self.run_strake('project', 'new', 'p.strake', 'round.rvm')
        more = ['--view', 'front', '--scale', '1:10', '--single-line', '105mm', '--break-lines', 'on', '--thin', 'on',
                '--limits', '-5m,-5m,-5m,5m,5m,100']
        # A stored view keeps its hidden lines, as a run with an output that has them does.
        _, (alone, _) = self.drawn('round.rvm', *more, outputs=('x.svg', 'x.json'))
        _, (saved,) = self.drawn('-p', 'p.strake', '--save', 'v', *more)
        reported, (stored,) = self.drawn('-p', 'p.strake', '--stored', 'v', '--verify')
        self.assertIn('unchanged', reported)
        self.assertEqual(saved, alone)
        self.assertEqual(stored, alone)

    def test_sheets_have_them_by_view(self):
        self.folder.joinpath('round.rvm').write_bytes(rvm(rvm_of_round_things()))
        self.write('s.toml', '''[sheet]
size = "A2"
scale = "1:10"
[fields]
title = ""
[styles]
single_line = { width = "1.4mm" }
break_line = { color = "#ff0000" }
[[view]]
name = "lines"
direction = "front"
position = ["150mm", "200mm"]
limits = { min = ["-5m", "-5m", "-5m"], max = ["5m", "5m", "0.1m"] }
single_line = "DN90"
break_lines = "on"
thin = "0.5mm"
[[view]]
name = "whole"
direction = "front"
position = ["400mm", "200mm"]
''')
        done = self.run_strake('draw', 'round.rvm', '--sheet', 's.toml', '-o', 'x.svg')
        self.assertEqual(done.returncode, 3, done.stderr)
        self.assertIn('DN6 to DN600', done.stderr)
        self.write('s.toml', (self.folder / 's.toml').read_text(encoding='utf-8').replace('DN90', '105mm'))
        expected = None
        for threads in (1, 3):
            made = []
            for name in ('x.svg', 'x.pdf', 'x.dxf'):
                done = self.run_strake('draw', 'round.rvm', '--sheet', 's.toml', '--threads', threads, '-o', name)
                self.assertEqual(done.returncode, 0, done.stderr)
                made.append((self.folder / name).read_bytes())
            expected = expected or made
            self.assertEqual(made, expected)
        text = made[0].decode()
        self.assertIn('id="view-1-visible-single_line"', text)
        self.assertNotIn('id="view-2-visible-single_line"', text)
        self.assertIn('id="view-1-break-lines"', text)
        self.assertNotIn('id="view-2-break-lines"', text)
        self.assertIn('stroke: #ff0000', text)
        self.assertIn('stroke-width: 1.4', text)

    def test_styles_hold_for_them(self):
        self.folder.joinpath('round.rvm').write_bytes(rvm(rvm_of_round_things()))
        run = ['round.rvm', '--view', 'front', '--scale', '1:10', '--single-line', '105mm', '--break-lines', 'on',
               '--limits', '-5m,-5m,-5m,5m,5m,100', '--style', 'name=PIPING,color=#c00000,pen=1mm,line=dashed: *']
        _, made = self.drawn(*run, outputs=('x.svg', 'x.pdf', 'x.dxf'))
        text = made[0].decode()
        single = re.search(r'[.]visible[.]single_line [.]style-1 path {([^}]*)}', text)[1]
        broken = re.search(r'[.]break [.]style-1 path {([^}]*)}', text)[1]
        self.assertIn('stroke: #c00000; stroke-width: 1;', single)
        self.assertIn('stroke: #c00000; stroke-width: 0.5; stroke-dasharray: none;', broken)
        self.assertIn('id="visible-single_line-style-1" class="style-1" data-style="PIPING"', text)
        self.assertIn('id="break-lines-style-1" class="style-1" data-style="PIPING"', text)
        self.assertIn(b'PIPING', made[1])
        document, faults = read(self.folder / 'x.dxf')
        self.assertEqual(faults, [])
        layers = {entity.dxf.layer for entity in document.modelspace()}
        self.assertIn('PIPING_AM_0_PIPE', layers)
        broken = [entity for entity in document.modelspace() if entity.dxf.layer == 'PIPING_AM_4_BREAK']
        self.assertTrue(broken)
        self.assertEqual(document.layers.get('PIPING_AM_4_BREAK').dxf.linetype, 'Continuous')
        self.assertNotEqual(document.layers.get('PIPING_AM_0_PIPE').dxf.linetype, 'Continuous')
        self.assertEqual({layer for layer in layers if not layer.startswith('PIPING_')}, set())

    def test_what_is_thinned_on_paper_has_its_layer_in_model_space(self):
        self.write('wall.obj', corrugated('wall', 400, 10, 2000))
        style = ['--style', 'name=WALL,pen=1mm: *']
        self.drawn('wall.obj', *self.RUN, *style, outputs=('x.dxf',))
        _, (thinned,) = self.drawn('wall.obj', *self.RUN, *style, '--thin', 'on', outputs=('y.dxf',))
        self.assertEqual(thinned, (self.folder / 'x.dxf').read_bytes())

    def test_wrong_values_are_reported(self):
        self.write('m.obj', cube('beam', 0, (0, 0, 0), 1000))
        for option, wrong in (('--thin', 'yes'), ('--thin', '0mm'), ('--thin', '5'), ('--break-lines', 'zigzag'),
                              ('--single-line', 'on'), ('--single-line', 'DN51'), ('--single-line', '60')):
            done = self.run_strake('draw', 'm.obj', *self.RUN, option, wrong, '-o', 'y.svg')
            self.assertEqual(done.returncode, 2, done.stderr)
            self.assertIn(option, done.stderr)
            self.assertFalse((self.folder / 'y.svg').exists())


if __name__ == '__main__':
    main()
