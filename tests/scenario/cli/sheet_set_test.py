#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""sheet_set_test.py STRAKE EXAMPLES: several sheets from one file, and styles of disciplines, in every format that sheets have."""
import json
import re
import subprocess
import sys
import xml.etree.ElementTree as ElementTree
from pathlib import Path

from dxf_file import object_of, read
from page_file import PageFile
from scenario import Scenario, cube, main

EXAMPLES = None
SVG = '{http://www.w3.org/2000/svg}'
LABEL = '{http://www.inkscape.org/namespaces/inkscape}label'
SETTINGS = ['--unit', 'mm', '--up-axis', 'z']
SET = '''
[fields]
owner = "YARD"
[[style]]
name = "Pipes / hot"
select = "name = 'pipe*'"
color = "#c00000"
pen = "0.7mm"
line = "dashed"
[[sheet]]
name = "plan"
size = "A4"
[[sheet.view]]
name = "v"
direction = "top"
hidden = "all"
[[sheet]]
name = "front"
size = "A3"
scale = "1:50"
[sheet.fields]
title = "THE FRONT"
owner = "US"
[[sheet.style]]
select = "name = 'pipe-1'"
color = "#0000c0"
[[sheet.view]]
name = "v"
direction = "front"
[[sheet.revision]]
revision = "A"
'''


def tool(*command):
    return subprocess.run(list(map(str, command)), capture_output=True, check=False)


class SheetSet(Scenario):
    def models(self):
        self.write('m.obj', cube('wall', 0, (0, 0, 0), 2000) + cube('pipe-1', 1, (2500, 0, 0), 500)
                   + cube('pipe-2', 2, (500, 500, -900), 400))
        self.write('s.toml', SET)

    def draw(self, *outputs, sheet='s.toml'):
        more = [part for out in outputs for part in ('-o', out)]
        return self.run_strake('draw', 'm.obj', *SETTINGS, '--sheet', sheet, *more)

    def texts(self, name):
        return [text.text for text in ElementTree.parse(self.folder / name).getroot().iter(f'{SVG}text')]

    def test_each_sheet_is_a_page_a_layout_or_a_file(self):
        self.models()
        done = self.draw('s.pdf', 's.dxf', 's.html', 'of-{sheet}.svg')
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("sheet 'front', view 'v': ", done.stderr)
        # Fields that sheets have in common are missing on each of them.
        for sheet in ('plan', 'front'):
            self.assertRegex(done.stderr, f"field-not-filled: s.toml, line \\d+: \\[fields\\], sheet '{sheet}': ")
        pages = tool('pdfinfo', '-l', 2, self.folder / 's.pdf').stdout.decode()
        self.assertEqual(re.findall(r'\((A\d)\)', pages), ['A4', 'A3'])
        outline = json.loads(tool('qpdf', '--json=2', '--json-key=outlines', self.folder / 's.pdf').stdout)['outlines']
        self.assertEqual([(mark['title'], mark['destpageposfrom1']) for mark in outline], [('plan', 1), ('front', 2)])
        self.assertEqual(tool('qpdf', '--check', self.folder / 's.pdf').returncode, 0)
        self.assertIn('1 of 2', self.texts('of-plan.svg'))
        self.assertIn('YARD', self.texts('of-plan.svg'))
        for wanted in ('2 of 2', 'THE FRONT', 'US'):
            self.assertIn(wanted, self.texts('of-front.svg'))
        document, faults = read(self.folder / 's.dxf')
        self.assertEqual(faults, [])
        self.assertEqual(document.layout_names_in_taborder(), ['Model', 'plan', 'front'])
        for name, size, word in (('plan', (297, 210), '1 of 2'), ('front', (420, 297), '2 of 2')):
            layout = document.layouts.get(name)
            self.assertEqual((layout.dxf.paper_width, layout.dxf.paper_height), size)
            self.assertIn(word, [text.dxf.text for text in layout.query('TEXT')])
            self.assertEqual(len(layout.query('VIEWPORT')), 2)
        page = PageFile(self.folder / 's.html')
        self.assertEqual([drawing['title'] for drawing in page.head['drawings']], ['plan', 'front'])

    def test_windows_of_layouts_show_their_own_views(self):
        self.models()
        self.assertEqual(self.draw('s.dxf').returncode, 0)
        document, _ = read(self.folder / 's.dxf')
        windows = []
        for name in ('plan', 'front'):
            window = document.layouts.get(name).query('VIEWPORT')[1].dxf
            half = (window.view_height * window.width / window.height / 2, window.view_height / 2)
            windows.append([window.view_center_point[k] - half[k] for k in (0, 1)]
                           + [window.view_center_point[k] + half[k] for k in (0, 1)])
        counts_of = [0, 0]
        for entity in document.modelspace().query('LINE LWPOLYLINE'):
            points = [entity.dxf.start, entity.dxf.end] if entity.dxftype() == 'LINE' else list(entity.vertices())
            for p in points:
                within = [i for i, box in enumerate(windows) if box[0] <= p[0] <= box[2] and box[1] <= p[1] <= box[3]]
                self.assertEqual(len(within), 1, p)
                counts_of[within[0]] += 1
        self.assertTrue(all(count > 10 for count in counts_of), counts_of)

    def test_the_bytes_are_the_same_for_any_team_and_a_single_sheet_is_as_ever(self):
        self.models()
        expected = {}
        for threads in (1, 3, 8):
            done = self.run_strake('draw', 'm.obj', *SETTINGS, '--sheet', 's.toml', '--threads', threads,
                                   *(part for out in ('s.pdf', 's.dxf', 's.html', '{sheet}.svg') for part in ('-o', out)))
            self.assertEqual(done.returncode, 0, done.stderr)
            for name in ('s.pdf', 's.dxf', 's.html', 'plan.svg', 'front.svg'):
                got = (self.folder / name).read_bytes()
                self.assertEqual(got, expected.setdefault(name, got), (name, threads))

    def test_styles_are_layers_in_every_format(self):
        self.models()
        done = self.draw('s.pdf', 's.dxf', '{sheet}.svg')
        self.assertEqual(done.returncode, 0, done.stderr)
        root = ElementTree.parse(self.folder / 'plan.svg').getroot()
        styled = [group for group in root.iter(f'{SVG}g') if group.get('data-style') == 'Pipes / hot']
        self.assertTrue(styled)
        self.assertIn('Visible sharp, Pipes / hot', [group.get(LABEL) for group in styled])
        self.assertEqual({g.get('data-name') for group in styled for g in group.iter(f'{SVG}g') if g.get('data-name')},
                         {'pipe-1', 'pipe-2'})
        others = {g.get('data-name') for g in root.iter(f'{SVG}g') if g.get('data-name')}
        self.assertEqual(others, {'pipe-1', 'pipe-2', 'wall'})
        css = root.find(f'{SVG}style').text
        self.assertRegex(css, r'\.strake \.visible\.sharp \.style-1 path \{ stroke: #c00000; stroke-width: 0\.7;')
        # Hidden lines have the colour, keep their dashes and are half as wide.
        self.assertRegex(css, r'\.strake \.hidden\.sharp \.style-1 path \{ stroke: #c00000; stroke-width: 0\.35;')
        document, _ = read(self.folder / 's.dxf')
        of_layer = {}
        for entity in document.modelspace():
            of_layer.setdefault(entity.dxf.layer, set()).add(object_of(entity)[1])
        hot = {layer: names for layer, names in of_layer.items() if layer.startswith('PIPES___HOT_')}
        self.assertEqual({'pipe-1', 'pipe-2'}, set().union(*hot.values()), of_layer)
        layer = document.layers.get('PIPES___HOT_AM_0_EDGE')
        self.assertEqual((layer.rgb, layer.dxf.lineweight), ((0xc0, 0, 0), 70))
        self.assertNotEqual(layer.dxf.linetype, 'Continuous')
        # The style of a sheet comes before those of all: pipe-1 is blue in the front view.
        blue = [layer for layer in document.layers if layer.rgb == (0, 0, 0xc0)]
        self.assertEqual(set().union(*(of_layer[layer.dxf.name] for layer in blue)), {'pipe-1'})
        found = json.loads(tool('qpdf', '--json=2', '--json-key=qpdf', self.folder / 's.pdf').stdout)['qpdf'][1]
        names = [item['value']['/Name'] for item in found.values() if isinstance(item.get('value'), dict)
                 and item['value'].get('/Type') == '/OCG']
        self.assertEqual(names.count('u:Pipes / hot'), 2, names)

    def test_a_drawing_without_sheet_has_styles(self):
        self.models()
        style = 'name=HOT,color=#c00000,pen=0.5mm,line=dash-dot: name = "pipe*"'
        done = self.run_strake('draw', 'm.obj', *SETTINGS, '--view', 'top', '--hidden', 'dashed', '--style', style,
                               *(part for out in ('d.svg', 'd.pdf', 'd.dxf', 'd.json') for part in ('-o', out)))
        self.assertEqual(done.returncode, 0, done.stderr)
        text = (self.folder / 'd.svg').read_text(encoding='utf-8')
        self.assertRegex(text, r'\.visible\.sharp \.style-1 path \{ stroke: #c00000; stroke-width: 0\.5;')
        document, faults = read(self.folder / 'd.dxf')
        self.assertEqual(faults, [])
        self.assertEqual(document.layers.get('HOT_AM_0_EDGE').rgb, (0xc0, 0, 0))
        self.assertEqual(tool('qpdf', '--check', self.folder / 'd.pdf').returncode, 0)
        # The neutral drawing knows of no pens.
        done = self.run_strake('draw', 'm.obj', *SETTINGS, '--view', 'top', '-o', 'plain.json')
        self.assertEqual((self.folder / 'plain.json').read_bytes(), (self.folder / 'd.json').read_bytes())
        done = self.run_strake('draw', 'd.json', '--style', style, '-o', 'again.svg')
        self.assertEqual(done.returncode, 2)
        self.assertIn('--style', done.stderr)

    def test_a_template_is_drawn_in_a_layout(self):
        self.models()
        self.write('f.svg', '<svg width="210mm" height="297mm" viewBox="0 0 210 297">'
                            '<rect x="5" y="5" width="200" height="287" fill="none" stroke="#c00000" stroke-width="0.7"/>'
                            '<g transform="translate(20 250)"><circle cx="10" cy="10" r="8" fill="none" stroke="#000"/>'
                            '<text x="100" y="20" font-size="7" text-anchor="middle">{{number}}</text></g>'
                            '<path d="M20 280h20v5h-20z" fill="#0000c0"/><image href="data:image/png;base64,AA==" width="5" height="5"/></svg>')
        self.write('t.toml', '[sheet]\ntemplate = "f.svg"\n[fields]\nnumber = "N-100%"\n[[view]]\nname = "v"\ndirection = "top"\n')
        done = self.draw('t.dxf', sheet='t.toml')
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertRegex(done.stderr, r'template-part-left-out.*the DXF has the template without this: <image>')
        document, faults = read(self.folder / 't.dxf')
        self.assertEqual(faults, [])
        layout = document.layouts.get('Sheet')
        border = next(entity for entity in layout.query('LWPOLYLINE') if entity.dxf.layer == 'AM_BOR' and entity.rgb == (0xc0, 0, 0))
        self.assertEqual(border.dxf.lineweight, 70)
        self.assertEqual([tuple(round(v, 3) for v in p[:2]) for p in border.get_points()][:3], [(5, 292), (205, 292), (205, 5)])
        text = next(text for text in layout.query('TEXT') if 'N-100' in text.dxf.text)
        self.assertEqual((round(text.dxf.align_point.x, 3), round(text.dxf.align_point.y, 3), text.dxf.height, text.dxf.halign), (120, 27, 5, 1))
        hatch = next(iter(layout.query('HATCH')))
        self.assertEqual(hatch.rgb, (0, 0, 0xc0))
        circle = [entity for entity in layout.query('LWPOLYLINE') if len(entity) > 20]
        self.assertTrue(any(all(abs(((p[0] - 30) ** 2 + (p[1] - 37) ** 2) ** 0.5 - 8) < 0.01 for p in entity.get_points()) for entity in circle))

    def test_what_is_wrong_is_reported(self):
        self.models()
        done = self.draw('s.svg')
        self.assertEqual(done.returncode, 2)
        self.assertIn("'s.svg' holds one sheet, and 2 are given", done.stderr)
        self.assertIn("'NAME-{sheet}.svg'", done.stderr)
        view = '[[sheet.view]]\nname = "v"\n'
        for text, reported in (
                ('[[sheet]]\nname = "a"\n' + view + '[[sheet]]\nname = "a"\n' + view, r"line 5.*'a' is given to two sheets"),
                ('[[sheet]]\nname = "a/b"\n' + view, r"line 2.*cannot be part of the name of a file"),
                # As the name of a folder in -o '{sheet}/plan.svg' it would lead out of where files are to lie.
                ('[[sheet]]\nname = ".."\n' + view, r"line 2.*cannot be part of the name of a file"),
                ('[[sheet]]\n' + view, r"\[\[sheet\]\] has no 'name'"),
                ('[[sheet]]\n' * 101, r"a file of more than 100 sheets"),
                ('[fields]\n' + ''.join(f'f{i} = ""\n' for i in range(1001)) + '[[view]]\nname = "v"\n',
                 r"line 1.*a sheet of more than 1000 fields"),
                ('[[sheet]]\nname = "a"\n', r"line 1.*the sheet 'a' has no views"),
                ('sheet = []\n', r'has no sheets'),
                ('[[view]]\nname = "v"\n[[sheet]]\nname = "a"\n' + view, r"'view' stands beside \[\[sheet\]\], and belongs to one"),
                ('[[sheet]]\nname = "a"\nx = 1\n' + view, r"\[\[sheet\]\] 'a' has no key 'x'"),
                ('[[style]]\nselect = "*"\ncolor = "red"\n[[view]]\nname = "v"\n', r"line 3.*'red' is no colour"),
                ('[[style]]\nselect = "*"\nline = "wavy"\n[[view]]\nname = "v"\n', r"line 3.*'wavy' is no type of line"),
                ('[[style]]\nselect = "*"\nline = ["1mm"]\n[[view]]\nname = "v"\n', r"line 3.*no list of dashes and gaps"),
                ('[[style]]\nselect = "*"\npen = "2m"\n[[view]]\nname = "v"\n', r"line 3.*'2m' is no width of a pen"),
                ('[[style]]\ncolor = "#000000"\n[[view]]\nname = "v"\n', r"has no 'select'")):
            self.write('wrong.toml', text)
            done = self.draw('w.svg', sheet='wrong.toml')
            self.assertEqual(done.returncode, 3, (text, done.stderr))
            self.assertRegex(done.stderr, reported)
        for style, reported in (('color=#c00000', 'does not say whose lines'), ('colour=#c00000: *', "has no 'colour'"),
                            ('red: *', 'no part of a style'), ('color=red: *', 'no colour'), ('pen=1m: *', 'no width of a pen'),
                            ('pen=1mm,pen=2mm: *', 'comes again'),
                            ('name=a,name=b: *', 'comes again'), ('line=wavy: *', 'no type of line')):
            done = self.run_strake('draw', 'm.obj', *SETTINGS, '--style', style, '-o', 'w.svg')
            self.assertEqual(done.returncode, 2, style)
            self.assertIn(reported, done.stderr)

    def test_the_example_is_three_sheets(self):
        done = self.run_strake('generate', 'ship', '--objects', 1200, '--seed', 1, '-o', 'ship.glb')
        self.assertEqual(done.returncode, 0, done.stderr)
        done = self.run_strake('draw', 'ship.glb', '--sheet', EXAMPLES / 'ship_set.toml', '-o', 'ship.pdf', '-o', 'ship-{sheet}.svg')
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual([line for line in done.stderr.splitlines() if line.startswith('warning')
                          and 'mesh-inverted' not in line], [])
        for number, name in enumerate(('general', 'deck', 'section')):
            self.assertIn(f'{number + 1} of 3', self.texts(f'ship-{name}.svg'))


if __name__ == '__main__':
    EXAMPLES = Path(sys.argv.pop(2)).resolve()
    main()
