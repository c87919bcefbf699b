#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""pdf_test.py STRAKE EXAMPLES: drawings and sheets as PDF, judged by programs of others: valid, of exactly the paper's size, with
the layers of the SVG, and the same picture."""
import json
import re
import subprocess
import sys
import xml.etree.ElementTree as ElementTree
from pathlib import Path

from scenario import Scenario, cube, gltf, main, rvm_of_round_things, sheet_with_all_notes

EXAMPLES = None
SVG = '{http://www.w3.org/2000/svg}'
LABEL = '{http://www.inkscape.org/namespaces/inkscape}label'
CAUSES = {'Hidden by other objects', 'Hidden by the object itself'}
DPI = 100
# The most by which the mean darkness of a cell of 4 mm may differ, and that of the whole sheet: of 1, which is black.
CELL_PX, TOLERANCE, MEAN_TOLERANCE = 16, 0.08, 0.001


def tool(*command):
    return subprocess.run(list(map(str, command)), capture_output=True, check=False)


def cells(pgm):
    """The mean darkness of cells of a picture, row by row, from 0 to 1, and how many are in a row."""
    head = re.match(rb'P5\s+(\d+)\s+(\d+)\s+255\s', pgm)
    width, height = int(head[1]), int(head[2])
    rows = [pgm[head.end() + y * width:head.end() + (y + 1) * width] for y in range(height)]
    return [1 - sum(sum(row[x:x + CELL_PX]) for row in rows[y:y + CELL_PX]) / (255 * CELL_PX * CELL_PX)
            for y in range(0, height - CELL_PX, CELL_PX) for x in range(0, width - CELL_PX, CELL_PX)], width // CELL_PX


class Pdf(Scenario):
    def objects(self, name):
        """The objects of a file as QPDF reads them, by "obj:N 0 R", and its catalog."""
        done = tool('qpdf', '--json=2', '--json-key=qpdf', self.folder / name)
        self.assertEqual(done.returncode, 0, done.stderr)
        found = json.loads(done.stdout)['qpdf'][1]
        trailer = found['trailer']['value']
        return found, found[f"obj:{trailer['/Root']}"]['value'], trailer

    def layers(self, name):
        """The names of layers in their order, nested as they are."""
        found, catalog, _ = self.objects(name)

        def named(order):
            return [named(item) if isinstance(item, list) else
                    item[2:] if item.startswith('u:') else found[f'obj:{item}']['value']['/Name'][2:] for item in order]
        return named(catalog['/OCProperties']['/D']['/Order'])

    def bookmarks(self, name):
        done = tool('qpdf', '--json=2', '--json-key=outlines', self.folder / name)
        return [(item['title'], item['destpageposfrom1'], [kid['title'] for kid in item['kids']])
                for item in json.loads(done.stdout)['outlines']]

    def check(self, name):
        """Valid for QPDF, whose words are the only ones; returns what pdfinfo says."""
        done = tool('qpdf', '--check', self.folder / name)
        self.assertEqual((done.returncode, done.stderr), (0, b''), name)
        done = tool('pdfinfo', self.folder / name)
        self.assertEqual((done.returncode, done.stderr), (0, b''), name)
        return dict(re.split(r':\s*', line, maxsplit=1) for line in done.stdout.decode().splitlines())

    def size_mm(self, name):
        """The size of the first page, from its MediaBox: pdfinfo rounds to a hundredth of a point."""
        found, _, _ = self.objects(name)
        page = next(item['value'] for item in found.values() if item.get('value') and isinstance(item['value'], dict)
                    and item['value'].get('/Type') == '/Page')
        scale = 25.4 / 72 * page.get('/UserUnit', 1)
        return page['/MediaBox'][2] * scale, page['/MediaBox'][3] * scale

    def text_of(self, name):
        return tool('pdftotext', '-layout', self.folder / name, '-').stdout.decode()

    def same_picture(self, svg, pdf):
        """Compares what librsvg makes of the SVG with the PDF, both painted by one program: how programs grey the rims of
        lines, and how they widen the thinnest, is left out of it."""
        drawn = tool('rsvg-convert', '--format', 'pdf', '--output', self.folder / 'rsvg.pdf', self.folder / svg)
        self.assertEqual(drawn.returncode, 0, drawn.stderr)
        painted = [tool('pdftoppm', '-gray', '-r', DPI, '-singlefile', self.folder / name) for name in (pdf, 'rsvg.pdf')]
        for done in painted:
            self.assertEqual((done.returncode, done.stderr), (0, b''), pdf)
        (ours, in_row), (theirs, in_row_of_theirs) = (cells(done.stdout) for done in painted)
        self.assertEqual((len(ours), in_row), (len(theirs), in_row_of_theirs))
        worst = max(range(len(ours)), key=lambda cell: abs(ours[cell] - theirs[cell]))
        self.assertLess(abs(ours[worst] - theirs[worst]), TOLERANCE, (pdf, divmod(worst, in_row)))
        ink = [sum(picture) / len(picture) for picture in (ours, theirs)]
        self.assertGreater(min(ink), 0.001, 'there is nothing to see')
        self.assertLess(abs(ink[0] - ink[1]), MEAN_TOLERANCE, pdf)

    def labels(self, svg):
        root = ElementTree.parse(self.folder / svg).getroot()
        return root, [group.get(LABEL) for group in root.iter() if group.get(LABEL)]

    def both(self, *command, paper=None):
        """Draws as SVG and as PDF in one run, and compares the two."""
        done = self.run_strake('draw', *command, '-o', 'd.svg', '-o', 'd.pdf')
        self.assertEqual(done.returncode, 0, done.stderr)
        self.check('d.pdf')
        root, labels = self.labels('d.svg')
        size = [float(root.get(side)[:-2]) for side in ('width', 'height')]
        if paper:
            self.assertEqual(size, list(paper))
        for ours, theirs in zip(self.size_mm('d.pdf'), size):
            self.assertAlmostEqual(ours, theirs, places=5)

        def flat(order):
            for item in order:
                yield from flat(item) if isinstance(item, list) else [item]
        if root.find(f".//{SVG}svg[@id='sheet-frame']") is not None:
            labels.append('Frame')  # a template, which is one layer here
        # What hides lines is within their layers in SVG, and beside them in PDF.
        labels = [label for label in labels if not label.endswith((', by others', ', by the object itself'))]
        self.assertEqual(sorted(name for name in flat(self.layers('d.pdf')) if name not in CAUSES), sorted(labels))
        self.same_picture('d.svg', 'd.pdf')
        return done

    def ship(self):
        done = self.run_strake('generate', 'ship', '--objects', 300, '--seed', 3, '-o', 'ship.glb')
        self.assertEqual(done.returncode, 0, done.stderr)

    def test_drawings_are_the_pictures_that_svg_is(self):
        self.ship()
        for more, paper in ((['--view', 'top'], (420, 297)), (['--view', 'front', '--hidden', 'dashed'], (420, 297)),
                            (['--view', 'left', '--hidden', 'all'], None), (['--view', 'back', '--paper', 'A4'], (297, 210)),
                            (['--view', 'iso', '--paper', 'A2,portrait'], (420, 594)), (['--direction', '1,-2,1'], None),
                            (['--view', 'top', '--section', 'z=4m'], None), (['--view', 'front', '--section', 'y=1m',
                                                                             '--hidden', 'dashed'], None),
                            (['--view', 'iso', '--limits', '0,0,0,12m,9m,3m'], None),
                            (['--eye', '2m,-9m,6m', '--target', '9m,0,3m'], None),
                            (['--view', 'top', '--smooth', 'on'], None), (['--view', 'iso', '--stage', 'none'], None),
                            (['--view', 'top', '--select', "name = 'TNK*'", '--hidden', 'dashed'], None),
                            (['--view', 'right', '--intersections', 'off', '--scale', '1:200'], None),
                            (['--view', 'top', '--hidden', 'all', '--hidden-layers', 'two'], None),
                            (['--view', 'bottom', '--paper', '900mmx420mm'], (900, 420))):
            with self.subTest(more=more):
                self.both('ship.glb', *more, paper=paper)
        self.both('ship.glb', '--view', 'top', '--paper', 'A0', '--title', 'ΔΛΩ Живот Größe Élan')
        self.assertIn('ΔΛΩ Живот Größe Élan', self.text_of('d.pdf'))

    def test_sheets_are_the_pictures_that_svg_is(self):
        self.ship()
        views = '[[view]]\nname = "plan"\ndirection = "top"\nhidden = "dashed"\n'
        frame = ('<svg xmlns="http://www.w3.org/2000/svg" width="210mm" height="297mm" viewBox="0 0 420 594">'
                 '<style>.thin { stroke: #000; stroke-width: .5; fill: none } text { font-family: sans-serif }</style>'
                 '<rect class="thin" x="20" y="20" width="380" height="554" rx="8"/>'
                 '<g transform="translate(300,500) rotate(30)"><path d="M0 0h40v20H0zM50 10a10 10 0 1 1 20 0" fill="#c00"/>'
                 '<ellipse cx="90" cy="0" rx="20" ry="8" style="fill:none;stroke:blue;stroke-width:2"/></g>'
                 '<text x="210" y="560" text-anchor="middle" font-size="14">No. {{number}} <tspan fill="red">Ω</tspan></text>'
                 '<polyline class="thin" points="30,30 60,30 60,60" stroke-dasharray="4 2"/></svg>')
        self.write('frame.svg', frame)
        sheets = {'plain': 'arrangement = "first-angle"\n',
                  'third': '[sheet]\nsize = "A1"\n[arrangement]\nprojection = "third-angle"\n',
                  'no frame': '[sheet]\nframe = false\nsize = ["500mm", "300mm"]\n' + views,
                  'tags': views + '[[tag]]\nselect = "name = \'TNK*\'"\ntext = "{{name}}"\n[grid]\nx = [["A", "1m"], ["B", "5m"]]\n',
                  'styles': views + '[styles]\noutline = { width = "1mm", color = "#a00000" }\n'
                                    'edge = { dash = ["5mm", "2mm"] }\nhidden = { dash = ["3mm", "1mm"], color = "#0000ff" }\n',
                  'template': '[sheet]\ntemplate = "frame.svg"\n[fields]\nnumber = "ÄÖ-1"\n' + views,
                  'perspective': '[[view]]\nname = "seen"\neye = ["2m", "-9m", "6m"]\ntarget = ["9m", 0, "3m"]\n',
                  'portrait': '[sheet]\nsize = "A3"\norientation = "portrait"\nscale = "1:200"\n' + views}
        for name, text in sheets.items():
            with self.subTest(name):
                self.write('s.toml', text)
                self.both('ship.glb', '--sheet', 's.toml')
        self.write('s.toml', sheets['template'])
        self.both('ship.glb', '--sheet', 's.toml', paper=(210, 297))
        self.assertIn('No. ÄÖ-1 Ω', self.text_of('d.pdf'))

    def test_a_sheet_with_all_notes_is_the_picture_that_svg_is(self):
        self.write_rvm('round.rvm', rvm_of_round_things())
        self.write('s.toml', sheet_with_all_notes())
        self.both('round.rvm', '--sheet', 's.toml')
        order = self.layers('d.pdf')
        self.assertEqual(order[:2], ['Frame', 'Notes'])
        below = order[order.index('top') + 1]
        for layer in ('Centre lines', 'Grid', 'Notes', 'Tags', 'Title', *CAUSES):
            self.assertIn(layer, below if layer != 'Hidden by the object itself' else order[order.index('front') + 1])
        whole = self.ink_without('d.pdf')
        for layer in ('Centre lines', 'Notes'):
            self.assertLess(self.ink_without('d.pdf', layer), .99 * whole, layer)
        words = self.text_of('d.pdf')
        for word in ('SECTION A-A', 'ROOF +0.600', '750', 'PARTS', 'Nozzle moved'):
            self.assertIn(word, words)
        for view in ('front', 'top', 'iso'):
            self.both('round.rvm', '--view', view, '--hidden', 'all', '--centre-lines', 'on')
            self.assertIn('Centre lines', self.layers('d.pdf'))

    def test_the_example_has_its_layers_below_its_views(self):
        done = self.run_strake('generate', 'ship', '--objects', 1200, '--seed', 1, '-o', 'ship.glb')
        self.assertEqual(done.returncode, 0, done.stderr)
        expected = None
        for threads in (1, 2, 3, 8):
            done = self.run_strake('draw', 'ship.glb', '--sheet', EXAMPLES / 'ship_sheet.toml', '-o', 's.pdf', '-o', 's.svg',
                                   '--threads', threads)
            self.assertEqual(done.returncode, 0, done.stderr)
            got = (self.folder / 's.pdf').read_bytes()
            expected = expected or got
            self.assertEqual(got, expected, threads)
        self.assertEqual(self.check('s.pdf')['Page size'], '1683.78 x 1190.55 pts (A2)')
        self.same_picture('s.svg', 's.pdf')
        order = self.layers('s.pdf')
        self.assertEqual([item for item in order if isinstance(item, str)], ['Frame', 'front', 'top', 'left', 'iso'])
        below = dict(zip((item for item in order if isinstance(item, str) and item != 'Frame'),
                         (item for item in order if isinstance(item, list))))
        self.assertLess({'Visible sharp', 'Visible outline', 'Grid', 'Title'}, set(below['top']))
        self.assertEqual(self.bookmarks('s.pdf')[0][2], ['FRONT VIEW', 'DECK 1', 'LEFT VIEW', 'ISOMETRIC VIEW'])
        words = self.text_of('s.pdf')
        for word in ('STR-1200-001', 'DECK 1', 'ISOMETRIC VIEW', 'ENG-B0001-L00-D01-0001'):
            self.assertIn(word, words)

    def test_several_sheets_make_one_file(self):
        self.write('m.obj', cube('a', 0, (0, 0, 0), 1000) + cube('b', 1, (1500, 0, 0), 500))
        for name, size in (('a', 'A4'), ('b', 'A3')):
            self.write(f'{name}.toml', f'[sheet]\nsize = "{size}"\n[fields]\ntitle = "Sheet {name}"\n'
                                       f'[[view]]\nname = "{name}-view"\ndirection = "top"\n')
        sheets = ['m.obj', '--unit', 'mm', '--up-axis', 'z', '--sheet', 'a.toml', '--sheet', 'b.toml']
        done = self.run_strake('draw', *sheets, '-o', 'set.pdf')
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("b.toml, view 'b-view': 8 visible", done.stderr)
        self.assertEqual(self.check('set.pdf')['Pages'], '2')
        pages = tool('pdfinfo', '-l', 2, self.folder / 'set.pdf').stdout.decode()
        self.assertEqual(re.findall(r'\((A\d)\)', pages), ['A4', 'A3'])
        marks = self.bookmarks('set.pdf')
        self.assertEqual([mark[1:] for mark in marks], [(1, ['a-view']), (2, ['b-view'])])
        order = self.layers('set.pdf')
        self.assertEqual([part[0] for part in order], [mark[0] for mark in marks])
        words = self.text_of('set.pdf')
        for count in ('1 of 2', '2 of 2'):
            self.assertIn(count, words)
        done = self.run_strake('draw', *sheets, '-o', 'set.svg')
        self.assertEqual(done.returncode, 2, done.stderr)
        self.assertIn("'set.svg' holds one sheet, and 2 are given", done.stderr)
        self.assertFalse((self.folder / 'set.svg').exists())

    def test_hidden_lines_are_switched_by_what_hides_them(self):
        self.write('m.obj', cube('near', 0, (0, 0, 0), 1000) + cube('far', 1, (300, 1500, 300), 400))
        done = self.run_strake('draw', 'm.obj', '--unit', 'mm', '--up-axis', 'z', '--view', 'front', '--hidden', 'all',
                               '-o', 'h.pdf')
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn('Hidden by other objects', self.layers('h.pdf'))
        names = self.contents('h.pdf')
        self.assertIn('/Name(far)', names)
        done = self.run_strake('draw', 'm.obj', '--unit', 'mm', '--up-axis', 'z', '--view', 'iso', '--hidden', 'all',
                               '--select', 'near', '-o', 'h.pdf')
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual([name for name in self.layers('h.pdf') if name in CAUSES], ['Hidden by the object itself'])

    def ink_without(self, name, *off):
        """How dark the page is with these layers switched off."""
        done = tool('qpdf', '--json=2', '--json-key=qpdf', self.folder / name)
        head, found = json.loads(done.stdout)['qpdf']
        root = f"obj:{found['trailer']['value']['/Root']}"
        layers = found[root]['value']['/OCProperties']
        layers['/D']['/OFF'] = [item for item in layers['/OCGs'] if found[f'obj:{item}']['value']['/Name'][2:] in off]
        self.assertGreaterEqual(len(layers['/D']['/OFF']), len(off))
        self.write('off.json', json.dumps({'qpdf': [head, {root: found[root]}]}))
        done = tool('qpdf', self.folder / name, '--update-from-json=' + str(self.folder / 'off.json'), self.folder / 'off.pdf')
        self.assertEqual(done.returncode, 0, done.stderr)
        picture, _ = cells(tool('pdftoppm', '-gray', '-r', DPI, '-singlefile', self.folder / 'off.pdf').stdout)
        return sum(picture)

    def test_layers_that_are_off_are_not_seen(self):
        self.write('m.obj', cube('near', 0, (0, 0, 0), 1000) + cube('far', 1, (300, 1500, 300), 400))
        view = '[[view]]\nname = "{}"\nposition = ["{}", "150mm"]\ndirection = "{}"\nhidden = "all"\ntitle = ""\n'
        self.write('s.toml', '[sheet]\nframe = false\nscale = "1:10"\n' + view.format('a', '100mm', 'front') +
                   view.format('b', '300mm', '1,-2,1'))
        done = self.run_strake('draw', 'm.obj', '--unit', 'mm', '--up-axis', 'z', '--sheet', 's.toml', '-o', 's.pdf')
        self.assertEqual(done.returncode, 0, done.stderr)
        whole = self.ink_without('s.pdf')
        a, b, visible = (self.ink_without('s.pdf', off) for off in ('a', 'b', 'Visible sharp'))
        hidden = self.ink_without('s.pdf', *CAUSES)
        for part in (a, b, visible, hidden):
            self.assertLess(0.01 * whole, part)
            self.assertLess(part, 0.99 * whole)
        self.assertEqual(self.ink_without('s.pdf', 'a', 'b'), 0)
        kinds = [name for name in self.layers('s.pdf')[1] if name.startswith('Hidden') and name not in CAUSES]
        self.assertAlmostEqual(self.ink_without('s.pdf', *kinds), hidden)

    def contents(self, name):
        done = tool('qpdf', '--qdf', '--object-streams=disable', self.folder / name, '-')
        self.assertEqual(done.returncode, 0, done.stderr)
        return done.stdout.decode('latin-1')

    def test_drawings_written_again_have_the_same_bytes(self):
        self.ship()
        more = ['--hidden', 'dashed', '--title', 'T']
        done = self.run_strake('draw', 'ship.glb', '--view', 'iso', *more, '-o', 'a.pdf', '-o', 'a.view', '-o', 'a.json')
        self.assertEqual(done.returncode, 0, done.stderr)
        expected = (self.folder / 'a.pdf').read_bytes()
        for file in ('a.view', 'a.json'):
            done = self.run_strake('draw', file, *more, '-o', 'b.pdf')
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertEqual((self.folder / 'b.pdf').read_bytes(), expected, file)
        done = self.run_strake('project', 'new', 'p.strake', 'ship.glb')
        self.assertEqual(done.returncode, 0, done.stderr)
        for command in (['--save', 'iso', '--view', 'iso', *more, '-o', 'c.json'], ['--stored', 'iso', '-o', 'c.pdf']):
            done = self.run_strake('draw', '-p', 'p.strake', *command)
            self.assertEqual(done.returncode, 0, done.stderr)
        self.check('c.pdf')
        self.assertEqual(self.layers('c.pdf'), self.layers('a.pdf'))
        done = self.run_strake('draw', 'a.view', '--paper', 'A1', '--scale', '1:200', '-o', 'd.pdf')
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(self.check('d.pdf')['Page size'], '2383.94 x 1683.78 pts (A1)')

    def test_hostile_names_are_text(self):
        names = ['line\nbreak', '\x1b[2J', '\u202egpj.exe\u202c', ')>> endobj trailer <<(', '(((', '\\', '</script>', '=1+1',
                 'Ж' * 10_000, 'ä' * 30_000, '船', 'שלום', '', ' ', '\U0001f6a2', '\ufeff', '%PDF-1.7', 'endstream']
        (self.folder / 'm.gltf').write_text(gltf(('root', {}, None, [(name, {}, .2 * i, []) for i, name in enumerate(names)])),
                                            encoding='utf-8')
        self.write('s.toml', '[[view]]\nname = "(v)"\ndirection = "top"\n[[tag]]\nselect = "name = \'*\'"\ntext = "{{name}}"\n')
        done = self.run_strake('draw', 'm.gltf', '--title', names[3], '--hidden', 'all', '-o', 'd.pdf', encoding='utf-8')
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(self.check('d.pdf')['Pages'], '1')
        self.assertIn(names[3], self.text_of('d.pdf'))
        done = self.run_strake('draw', 'm.gltf', '--sheet', 's.toml', '-o', 's.pdf', encoding='utf-8')
        self.assertEqual(done.returncode, 0, done.stderr)
        self.check('s.pdf')
        for name in ('d.pdf', 's.pdf'):  # QPDF looks into no contents
            done_by_poppler = tool('pdftoppm', '-gray', '-r', 20, '-singlefile', self.folder / name)
            self.assertEqual((done_by_poppler.returncode, done_by_poppler.stderr), (0, b''), name)
        self.assertIn('text-character-missing', done.stderr)
        self.assertIn('U+8239', done.stderr)
        words = self.text_of('s.pdf')
        for shown in ('=1+1', '</script>', '船', 'endstream'):
            self.assertIn(shown, words)

    def test_what_a_template_has_beyond_lines_and_texts_is_reported(self):
        self.write('m.obj', cube('a', 0, (0, 0, 0), 1000))
        self.write('t.svg', '<svg width="210mm" height="297mm" viewBox="0 0 210 297"><image href="data:image/png;base64,AA=="/>'
                            '<rect width="9" height="9" fill="url(#g)"/><text>{{title}}</text></svg>')
        self.write('s.toml', '[sheet]\ntemplate = "t.svg"\n[fields]\ntitle = "T"\n[[view]]\nname = "v"\ndirection = "top"\n')
        done = self.run_strake('draw', 'm.obj', '--unit', 'mm', '--up-axis', 'z', '--sheet', 's.toml', '-o', 's.pdf')
        self.assertEqual(done.returncode, 0, done.stderr)
        self.check('s.pdf')
        for what in ('<image>', 'fill: url(#g)'):
            self.assertIn(f'template-part-left-out: the template: the PDF has the template without this: {what}', done.stderr)


if __name__ == '__main__':
    EXAMPLES = Path(sys.argv.pop(2)).resolve()
    main()
