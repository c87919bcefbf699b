#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""dxf_test.py STRAKE EXAMPLES: thirty drawings as DXF, which ezdxf audits and reads back beside the neutral JSON."""
import json
import sys
import xml.etree.ElementTree as ElementTree
from pathlib import Path

from dxf_file import View, differences, object_of, read
from scenario import Scenario, cube, gltf, main, rvm_of_round_things, sheet_with_all_notes

EXAMPLES = None
SETTINGS = ['--unit', 'mm', '--up-axis', 'z']
NAMES = ['plain', 'two\nlines\r\n0\nSECTION', '100%%d %%%', '^J ^M^', '\\U+202E \\M+1A2B4', 'R\u00f8r \u6f22 \U0001f6a2',
         '\u202eright to left', '<>/\\":;?*|,=`', 'x' * 10000, '\u2028line\u2029', '{\\fArial;MTEXT}\\P', '\x01\x7f']


class Dxf(Scenario):
    def models(self):
        self.two_files()
        self.write_rvm('round.rvm', rvm_of_round_things())
        self.write('names.gltf', gltf(('all', {}, None, [(name, {}, i / 5, []) for i, name in enumerate(NAMES)])))
        self.text('generate', 'ship', '--objects', 150, '--seed', 4, '-o', 'ship.glb', '--quiet')
        # Far from the origin, as models in coordinates of a map are.
        self.write('far.obj', cube('far', 0, (600000000, 6700000000, 1000), 4567.8))

    def drawings(self):
        """(name, arguments) of the drawings; --hidden all where hidden lines are looked at, too."""
        boxes, ship = ['a.obj', 'b.obj', *SETTINGS], ['ship.glb']
        for view in ('top', 'front', 'left', 'iso'):
            yield f'boxes-{view}', [*boxes, '--view', view, '--hidden', 'all']
            yield f'round-{view}', ['round.rvm', '--view', view]
            yield f'round-hidden-{view}', ['round.rvm', '--view', view, '--hidden', 'all']
            yield f'ship-{view}', [*ship, '--view', view]
        yield 'ship-hidden', [*ship, '--hidden', 'all', '--stage', 'local']
        yield 'ship-section', [*ship, '--view', 'top', '--section', 'z=1500mm']
        yield 'ship-smooth', [*ship, '--view', 'left', '--smooth', 'on', '--hidden', 'all', '--scale', '1:20']
        yield 'round-section', ['round.rvm', '--view', 'front', '--section', 'y>10mm', '--hidden', 'all']
        yield 'round-askew', ['round.rvm', '--direction', '3,-7,2', '--scale', '1:2', '--hidden', 'all']
        yield 'round-enlarged', ['round.rvm', '--direction', '1,2,3', '--select', "name = '*PIN'", '--scale', '10:1']
        yield 'round-limits', ['round.rvm', '--view', 'top', '--limits', '0,0,-900,900,900,900']
        yield 'round-a4', ['round.rvm', '--view', 'top', '--paper', 'A4,portrait']
        yield 'perspective', [*ship, '--eye', '2m,-9m,6m', '--target', '9m,0,1m', '--hidden', 'all']
        yield 'perspective-round', ['round.rvm', '--eye', '2m,-3m,2m', '--target', '0,0,0']
        yield 'far', ['far.obj', *SETTINGS, '--view', 'iso', '--hidden', 'all']
        yield 'far-top', ['far.obj', *SETTINGS, '--view', 'top']
        yield 'names', ['names.gltf', '--view', 'front', '--title', NAMES[1]]
        yield 'names-percent', ['names.gltf', '--title', NAMES[2]]
        yield 'empty', [*boxes, '--limits', '5000,5000,5000,6000,6000,6000']

    def test_thirty_drawings_hold_the_lines_of_the_view_and_no_others(self):
        self.models()
        count = arcs = 0
        for name, arguments in self.drawings():
            with self.subTest(drawing=name):
                self.text('draw', *arguments, '-o', f'{name}.dxf', '-o', f'{name}.json', '--quiet')
                document, faults = read(self.folder / f'{name}.dxf')
                self.assertEqual(faults, [])
                view = json.loads((self.folder / f'{name}.json').read_text(encoding='utf-8'))
                reported = differences(document, View(view, '--hidden' in arguments), view['settings'].get('sag_mm') or .5)
                self.assertEqual(reported[:5], [], f'{len(reported)} differences')
                arcs += len(document.modelspace().query('ARC CIRCLE ELLIPSE'))
                self.check_sheet(document, view)
                count += 1
        self.assertEqual(count, 31)
        self.assertGreater(arcs, 80)

    def check_sheet(self, document, view):
        """The layout is the sheet, and its window shows the view at the scale of the drawing."""
        sheet = document.layouts.get('Sheet')
        self.assertEqual(document.header['$INSUNITS'], 4)
        self.assertEqual((sheet.dxf.paper_width, sheet.dxf.paper_height),
                         (view['sheet']['width_mm'], view['sheet']['height_mm']))
        windows = sheet.query('VIEWPORT')[1:]
        self.assertEqual(len(windows), 1 if len(document.modelspace()) else 0)
        scale = 1 if view['view']['projection'] == 'perspective' else view['sheet']['scale']
        for window in windows:
            self.assertAlmostEqual(window.dxf.view_height / window.dxf.height / scale, 1, 12)

    def test_names_are_shown_as_they_are(self):
        self.models()
        self.text('draw', 'names.gltf', '--view', 'front', '--title', NAMES[2], '-o', 'n.dxf', '--quiet')
        content = (self.folder / 'n.dxf').read_bytes().decode()
        for character in '\x01\x7f\r\u202e\u2028\u2029':
            self.assertNotIn(character, content)
        document, faults = read(self.folder / 'n.dxf')
        self.assertEqual(faults, [])
        names = {object_of(entity)[1] for entity in document.modelspace()}
        self.assertEqual(len(names), len(NAMES))
        for name in ('plain', 'two\ufffdlines\ufffd\ufffd0\ufffdSECTION', '100%%d %%%', NAMES[3], NAMES[4], NAMES[5], NAMES[7],
                     'x' * 252 + '\u2026', NAMES[10]):
            self.assertIn(name, names)
        for entity in document.modelspace():
            self.assertLessEqual(max(len(value.encode()) for value in object_of(entity)), 255)
        title = next(text for text in document.layouts.get('Sheet').query('TEXT') if '100' in text.dxf.text)
        self.assertEqual(title.dxf.text, '100%%%%%%d %%%%%%%%%')

    def test_the_bytes_are_the_same_for_any_team(self):
        self.models()
        expected = {}
        for threads in (1, 2, 3, 8):
            for name, more in (('v.dxf', ['--hidden', 'dashed']), ('s.dxf', ['--sheet', EXAMPLES / 'ship_sheet.toml'])):
                self.text('draw', 'ship.glb', *more, '-o', name, '--threads', threads, '--quiet')
                got = (self.folder / name).read_bytes()
                self.assertEqual(got, expected.setdefault(name, got), (name, threads))

    def test_a_drawing_is_issued_again_from_its_neutral_form_and_from_a_project(self):
        self.models()
        self.text('draw', 'round.rvm', '-o', 'v.dxf', '-o', 'v.json', '-o', 'v.view', '--quiet')
        for form in ('v.json', 'v.view'):
            self.text('draw', form, '-o', 'again.dxf', '--quiet')
            self.assertEqual((self.folder / 'again.dxf').read_bytes(), (self.folder / 'v.dxf').read_bytes(), form)
        self.text('draw', 'v.view', '-o', 'larger.dxf', '--scale', '1:2', '--paper', 'A1', '--quiet')
        document, faults = read(self.folder / 'larger.dxf')
        self.assertEqual(faults, [])
        view = json.loads((self.folder / 'v.json').read_text(encoding='utf-8'))
        self.assertEqual(differences(document, View(view, False), view['settings'].get('sag_mm') or .5), [])
        self.text('project', 'new', 'p.strake', 'round.rvm')
        self.text('draw', '-p', 'p.strake', '--save', 'all', '-o', 'saved.dxf', '--quiet')
        self.text('draw', '-p', 'p.strake', '--stored', 'all', '-o', 'stored.dxf', '--quiet')
        self.assertEqual((self.folder / 'stored.dxf').read_bytes(), (self.folder / 'saved.dxf').read_bytes())

    def check_windows(self, document):
        """Each line of model space is seen in one window; returns what these see."""
        found = []
        for window in document.layouts.get('Sheet').query('VIEWPORT')[1:]:
            half = window.dxf.view_height / 2, window.dxf.view_height / window.dxf.height * window.dxf.width / 2
            x, y, *_ = window.dxf.view_center_point
            found.append((x - half[1], y - half[0], x + half[1], y + half[0]))
        for entity in document.modelspace().query('LINE'):
            for p in (entity.dxf.start, entity.dxf.end):
                within = [box for box in found if box[0] <= p.x <= box[2] and box[1] <= p.y <= box[3]]
                self.assertEqual(len(within), 1, p)
        return found

    def test_views_of_a_sheet_lie_side_by_side_and_its_windows_show_them(self):
        self.models()
        self.text('draw', 'ship.glb', '--sheet', EXAMPLES / 'ship_sheet.toml', '-o', 's.dxf', '--quiet')
        document, faults = read(self.folder / 's.dxf')
        self.assertEqual(faults, [])
        sheet = document.layouts.get('Sheet')
        self.assertEqual((sheet.dxf.paper_width, sheet.dxf.paper_height), (594, 420))
        found = self.check_windows(document)
        self.assertEqual(len(found), 4)
        front, top = found[:2]
        self.assertAlmostEqual(front[0], top[0], 2, 'a view below another is in line with it')
        texts = [text.dxf.text for text in sheet.query('TEXT')]
        for wanted in ('STR-1200-001', 'DECK 1', 'CL', 'A2'):
            self.assertIn(wanted, texts)
        self.assertGreater(len(sheet.query('CIRCLE')), 10)
        for text in sheet.query('TEXT'):
            self.assertGreaterEqual(text.dxf.height, 1.8)
            self.assertEqual(text.dxf.style, 'STRAKE')

    def test_labels_and_match_lines_of_a_deck_are_on_their_layers(self):
        self.text('generate', 'ship', '--objects', 1200, '--seed', 1, '-o', 'ship.glb', '--quiet')
        self.text('draw', 'ship.glb', '--sheet', EXAMPLES / 'ship_deck.toml', '-o', 's.dxf', '-o', 's.svg', '--quiet')
        document, faults = read(self.folder / 's.dxf')
        self.assertEqual(faults, [])
        sheet = document.layouts.get('Sheet')
        texts = {text.dxf.text: text for text in sheet.query('TEXT')}
        match = texts['MATCH LINE, SEE VIEW FRAMES 12 TO 24']
        self.assertEqual((match.dxf.layer, round(match.dxf.rotation)), ('AM_11_MATCH', 90))
        self.assertEqual(len([e for e in sheet if e.dxf.layer == 'AM_11_MATCH' and e.dxftype() in ('LINE', 'LWPOLYLINE')]), 2)
        self.assertEqual(document.layers.get('AM_11_MATCH').dxf.linetype, 'PHANTOM_AM_11_MATCH')
        circles = [circle for circle in sheet.query('CIRCLE') if circle.dxf.layer == 'AM_5_TAG']
        svg = ElementTree.parse(self.folder / 's.svg').getroot()
        self.assertEqual(len(circles), len([e for e in svg.iter() if e.tag.endswith('}circle') and e.get('class') == 'leader']))
        self.assertEqual({round(circle.dxf.radius, 3) for circle in circles}, {3.5})
        self.assertEqual(sorted(text.text for text in svg.iter() if text.tag.endswith('}text')),
                         sorted(text.dxf.text for text in sheet.query('TEXT')))

    def test_a_sheet_with_all_notes_has_each_on_a_layer_of_its_own(self):
        self.models()
        self.write('s.toml', sheet_with_all_notes())
        self.text('draw', 'round.rvm', '--sheet', 's.toml', '-o', 's.dxf', '-o', 's.svg', '--quiet')
        document, faults = read(self.folder / 's.dxf')
        self.assertEqual(faults, [])
        sheet = document.layouts.get('Sheet')
        layers = {layer.dxf.name: layer for layer in document.layers}
        texts = {text.dxf.text: text.dxf.layer for text in sheet.query('TEXT')}
        for text, layer in (('\u00b10.000', 'AM_5_NOTE'), ('N', 'AM_5_NOTE'), ('500 mm', 'AM_5_NOTE'), ('PARTS', 'AM_5_NOTE'),
                            ('750', 'AM_5'), ('/CAP', 'AM_5_TAG'), ('BL', 'AM_7_TEXT'), ('TOP VIEW', 'AM_6'), ('FRONT VIEW', 'AM_11')):
            self.assertEqual(texts.get(text), layer, text)
        svg = ElementTree.parse(self.folder / 's.svg').getroot()
        self.assertEqual(sorted(text.text for text in svg.iter() if text.tag.endswith('}text')),
                         sorted(text.dxf.text for text in sheet.query('TEXT')))
        for layer, lines, count in (('AM_10', 'CENTER_AM_7', 3), ('AM_11', 'PHANTOM_AM_11', 2), ('AM_7_GRID', 'CENTER_AM_7', 11)):
            self.assertEqual(layers[layer].dxf.linetype, lines)
            self.assertEqual(len([e for e in sheet if e.dxf.layer == layer and e.dxftype() in ('LINE', 'LWPOLYLINE')]), count)
        self.assertEqual(len(self.check_windows(document)), 4)
        # As long as SVG has them on paper, which is 1:10, or 1:50 in the key plan.
        self.assertEqual((document.header['$LTSCALE'], document.header['$PSLTSCALE']), (1, 1))
        self.assertEqual([layers[name].rgb for name in ('AM_3', 'AM_3_SELF', 'AM_7')], [(160, 0, 0), (0, 160, 0), (0, 0, 192)])
        for layer, class_ in (('AM_7', 'centre'), ('AM_3', 'by-other'), ('AM_3_SELF', 'by-self')):
            pattern = document.linetypes.get(layers[layer].dxf.linetype).pattern_tags.tags
            first = next(tag.value for tag in pattern if tag.code == 49)
            ours = {0 if e.dxf.linetype == 'Continuous' else round(first * e.dxf.ltscale, 3)
                    for e in document.modelspace() if e.dxf.layer == layer}
            groups = [group for group in svg.iter() if class_ in group.get('class', '').split()]
            styles = [path.get('style') for group in groups for path in group.iter() if path.get('style')]
            theirs = {0 if style.endswith('none') else round(float(style.split(':')[1].split()[0]), 3) for style in styles}
            self.assertGreater(len(theirs), 2)
            # Hidden lines of all kinds are joined on one layer, and an arc is an entity of its own: few have other dashes.
            self.assertLess(len(ours ^ theirs), 1 if layer == 'AM_7' else len(ours & theirs), layer)

    def test_centre_lines_lie_where_the_parts_are(self):
        self.models()
        self.text('draw', 'round.rvm', '--view', 'top', '--centre-lines', 'on', '-o', 'c.dxf', '--quiet')
        document, faults = read(self.folder / 'c.dxf')
        self.assertEqual(faults, [])
        lines = [e for e in document.modelspace().query('LINE') if e.dxf.layer == 'AM_7']
        for name, centre in (('/BALL', (800, 0)), ('/PIPE', (400, 50))):
            of_part = [line for line in lines if object_of(line)[1] == name]
            self.assertEqual(len(of_part), 2, name)
            for line in of_part:
                middle = (line.dxf.start + line.dxf.end) / 2
                self.assertLess(max(abs(middle.x - centre[0]), abs(middle.y - centre[1])), .01, name)
        window = document.layouts.get('Sheet').query('VIEWPORT')[1]
        half = window.dxf.view_height / window.dxf.height * window.dxf.width / 2
        self.assertLess(max(line.dxf.end.x for line in lines), window.dxf.view_center_point.x + half)


if __name__ == '__main__':
    EXAMPLES = Path(sys.argv.pop(2)).resolve()
    main()
