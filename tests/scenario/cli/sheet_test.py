#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""sheet_test.py STRAKE EXAMPLES: sheets as a user draws them: the example, threads, and what goes wrong."""
import re
import shutil
import subprocess
import sys
import xml.etree.ElementTree as ElementTree
from pathlib import Path

from scenario import Scenario, cube, main

EXAMPLES = None
SVG = '{http://www.w3.org/2000/svg}'
SHEET = '{urn:strake:sheet:1}'
SETTINGS = ['--unit', 'mm', '--up-axis', 'z']


class Sheet(Scenario):
    def draw(self, *more, model='m.obj', sheet='s.toml', out='s.svg'):
        return self.run_strake('draw', model, *SETTINGS, '--sheet', sheet, '-o', out, *more)

    def small(self, sheet):
        self.write('m.obj', cube('a', 0, (0, 0, 0), 1000) + cube('b', 1, (1500, 0, 0), 500))
        self.write('s.toml', sheet)

    def root(self, name='s.svg'):
        return ElementTree.parse(self.folder / name).getroot()

    def test_the_example_is_a_sheet_of_four_views(self):
        done = self.run_strake('generate', 'ship', '--objects', 1200, '--seed', 1, '-o', 'ship.glb')
        self.assertEqual(done.returncode, 0, done.stderr)
        expected = None
        for threads in (1, 2, 3, 8, 64):
            done = self.run_strake('draw', 'ship.glb', '--sheet', EXAMPLES / 'ship_sheet.toml', '-o', 's.svg',
                                   '--threads', threads)
            self.assertEqual(done.returncode, 0, done.stderr)
            got = (self.folder / 's.svg').read_bytes()
            expected = expected or got
            self.assertEqual(got, expected, threads)
        # Nothing is amiss but what the model itself brings along.
        self.assertEqual([line for line in done.stderr.splitlines() if line.startswith('warning')
                          and 'mesh-inverted' not in line], [])
        root = self.root()
        self.assertEqual((root.get('width'), root.get('height')), ('594mm', '420mm'))
        views = root.findall(f'.//{SHEET}view')
        self.assertEqual([view.get('name') for view in views], ['front', 'top', 'left', 'iso'])
        self.assertEqual({view.get('scale') for view in views}, {'1:100'})
        for view in views:
            reported = re.search(rf"view '{view.get('name')}': (\d+) visible of", done.stderr)
            self.assertEqual(reported[1], view.get('visible'))
            self.assertGreater(int(reported[1]), 1000)
        texts = [text.text for text in root.iter(f'{SVG}text')]
        for wanted in ('STR-1200-001', '1:100', 'A2', 'DECK 1', 'ISOMETRIC VIEW', 'ENG-B0001-L00-D01-0001', 'CL'):
            self.assertIn(wanted, texts)
        ids = [element.get('id') for element in root.iter() if element.get('id')]
        self.assertEqual(len(ids), len(set(ids)))

    def test_the_deck_has_match_lines_balloons_and_texts_along_pipes_in_every_format(self):
        done = self.run_strake('generate', 'ship', '--objects', 1200, '--seed', 1, '-o', 'ship.glb')
        self.assertEqual(done.returncode, 0, done.stderr)
        outputs, expected = ('d.svg', 'd.pdf', 'd.dxf'), {}
        for threads in (1, 2, 3, 8):
            done = self.run_strake('draw', 'ship.glb', '--sheet', EXAMPLES / 'ship_deck.toml', '--threads', threads,
                                   *(word for out in outputs for word in ('-o', out)))
            self.assertEqual(done.returncode, 0, done.stderr)
            for out in outputs:
                got = (self.folder / out).read_bytes()
                self.assertEqual(got, expected.setdefault(out, got), (out, threads))
        self.assertEqual([line for line in done.stderr.splitlines() if line.startswith('warning')
                          and 'mesh-inverted' not in line], [])
        self.assertIn('note tag-not-along', done.stderr)
        root = self.root('d.svg')
        layers = {element.get('id'): element for element in root.iter() if element.get('id')}
        rows = [text.text for text in layers['sheet-notes'].iter(f'{SVG}text')]
        numbers = rows[rows.index('QTY') + 1::3]
        self.assertEqual(numbers, [str(n) for n in range(1, len(numbers) + 1)])
        tags = [element for view in (1, 2) for element in layers[f'view-{view}-tags']]
        self.assertEqual(sorted(e.text for e in tags if e.tag == f'{SVG}text' and e.text.isdigit()), sorted(numbers))
        self.assertEqual([e.get('r') for e in tags if e.tag == f'{SVG}circle'], ['3.5'] * len(numbers))
        # Many pipes have their names along them, without leaders; the others have no room for them.
        pipes = [e.text for e in tags if e.tag == f'{SVG}text' and e.text.startswith('PIP')]
        leaders = [e for e in tags if e.tag == f'{SVG}path' and 'filled' in e.get('class')]
        self.assertGreater(len(pipes) - (len(leaders) - len(numbers)), 20)
        for view, other in ((1, 'FRAMES 12 TO 24'), (2, 'FRAMES 0 TO 12')):
            texts = [text.text for text in layers[f'view-{view}-match-lines'].iter(f'{SVG}text')]
            self.assertEqual(texts, [f'MATCH LINE, SEE VIEW {other}'])

    def test_tags_without_room_are_reported_and_the_others_are_the_same_for_any_team(self):
        side = 9
        self.write('m.obj', ''.join(cube(f'cube-{i}', i, (i % side * 150, i // side * 150, 0), 100)
                                    for i in range(side * side)))
        self.write('s.toml', '[sheet]\nsize = "A4"\n[[view]]\nname = "v"\ndirection = "top"\nscale = "1:10"\n'
                             '[[tag]]\nselect = "*"\ntext = "A TEXT THAT IS MUCH TOO LONG FOR {{name}}"\n')
        expected = None
        for threads in (1, 2, 8):
            done = self.draw('--threads', threads)
            self.assertEqual(done.returncode, 0, done.stderr)
            got = (self.folder / 's.svg').read_bytes()
            expected = expected or got
            self.assertEqual(got, expected, threads)
        reported = re.search(r"warning tag-no-room: s.toml, line \d+: \[\[tag\]\], the view 'v': (\d+) objects are without "
                         r"their tags, as 'A TEXT THAT IS MUCH TOO LONG FOR cube-\d+'", done.stderr)
        self.assertTrue(reported, done.stderr)
        tags = [text.text for text in self.root().iter(f'{SVG}text') if 'TOO LONG' in (text.text or '')]
        self.assertEqual(len(tags) + int(reported[1]), side * side)
        self.assertGreater(len(tags), 10)

    def test_a_template_is_never_overwritten(self):
        template = '<svg width="420mm" height="297mm" viewBox="0 0 420 297"><text>{{title}}</text></svg>'
        self.small('[sheet]\ntemplate = "frame.svg"\n[[view]]\nname = "v"\ndirection = "top"\n')
        self.write('frame.svg', template)
        (self.folder / 'link.svg').symlink_to('frame.svg')
        for out in ('frame.svg', './frame.svg', 'link.svg'):
            done = self.draw(out=out)
            self.assertEqual(done.returncode, 2, done.stderr)
            self.assertIn('overwritten', done.stderr)
            self.assertEqual((self.folder / 'frame.svg').read_text(encoding='utf-8'), template)
        self.write('frame.svg', template.replace('<text>', '<g id="a">\n<use href="#a"/></g><text>'))
        done = self.draw()
        self.assertEqual(done.returncode, 3, done.stderr)
        self.assertRegex(done.stderr, r"frame\.svg, line 2.*'#a' is drawn within itself")

    def test_notes_are_drawn_and_what_does_not_show_is_reported(self):
        sheet = ('[arrangement]\nviews = ["front", "top", "left"]\n[arrangement.front]\nsections = "y=500mm"\n'
                 'section_mark = "A"\n[levels]\nz = ["0m", ["SKY", "9m"]]\n[scale_bar]\n[north]\n'
                 '[[parts_list]]\nselect = "*"\ncolumns = [["NAME", "{{name}}"]]\n'
                 '[[revision]]\nrevision = "A"\ntext = "<script>alert(1)</script>"\n')
        self.small(sheet)
        expected = None
        for threads in (1, 2, 8):
            done = self.draw('--threads', threads)
            self.assertEqual(done.returncode, 0, done.stderr)
            got = (self.folder / 's.svg').read_bytes()
            expected = expected or got
            self.assertEqual(got, expected, threads)
        self.assertRegex(done.stderr, r"warning level-nowhere: s.toml, line \d+: \[levels\]: the level 'SKY \+9.000' shows in no view")
        root = self.root()
        texts = [text.text for text in root.iter(f'{SVG}text')]
        for wanted in ('SECTION A-A', 'A', '\u00b10.000', 'N', 'POS', 'a', 'b', '<script>alert(1)</script>'):
            self.assertIn(wanted, texts)
        self.assertEqual([e for e in root.iter() if e.tag.endswith('script')], [])
        layers = {element.get('id') for element in root.iter() if element.get('id')}
        self.assertTrue({'sheet-notes', 'view-1-notes', 'view-2-notes'} <= layers, layers)

    def test_views_have_sections(self):
        self.small('[[view]]\nname = "v"\ndirection = "top"\nsections = ["z>400mm", "y<100mm"]\n')
        done = self.draw()
        self.assertEqual(done.returncode, 0, done.stderr)
        text = (self.folder / 's.svg').read_text(encoding='utf-8')
        for layer in ('visible section', 'visible hatch'):
            self.assertIn(f'class="{layer}"', text)
        self.small('[[view]]\nname = "v"\ndirection = "top"\nsections = "z>4m"\n')
        self.assertIn('section-misses', self.draw().stderr)
        self.small('[[view]]\nname = "v"\ndirection = "top"\nsections = ["y=4m"]\n')
        done = self.draw()
        self.assertEqual(done.returncode, 3, done.stderr)
        self.assertRegex(done.stderr, r"line 4.*in the view 'v' the plane \"y=4m\" is seen edge-on")
        self.small('[[view]]\nname = "v"\ndirection = "top"\nuncut = "type = box"\n')
        self.assertRegex(self.draw().stderr, r'warning uncut-without-sections.*line 4')
        done = self.draw('--section', 'z>1m')
        self.assertEqual(done.returncode, 2, done.stderr)

    def test_far_objects_are_reported_and_left_out_of_all_arranged_views(self):
        self.write('m.obj', ''.join(cube(f'a{i}', i, (1500 * i, 0, 0), 1000) for i in range(5))
                   + cube('lost', 5, (0, 1000000, 0), 1000))
        self.write('s.toml', 'arrangement = "first-angle"\n')
        reported = self.draw().stderr
        self.assertEqual(re.findall(r"warning far-object: .* lies (\d+) m from the rest: the view '(\w+)'", reported),
                         [('999', 'top'), ('999', 'left'), ('701', 'iso')])  # the front view looks along the way to it
        self.assertEqual(self.root().findall(f'.//{SHEET}far-object'), [])
        self.assertEqual({view.get('scale') for view in self.root().findall(f'.//{SHEET}view')}, {'1:5000'})
        self.write('s.toml', 'arrangement = "first-angle"\n[defaults]\nlimits = "auto"\n')
        reported = self.draw().stderr
        self.assertNotIn('warning', reported)
        self.assertEqual(len(re.findall('note far-object-left-out: ', reported)), 4)
        views = self.root().findall(f'.//{SHEET}view')
        self.assertEqual([[far.get('name') for far in view] for view in views], [['lost']] * 4)
        self.assertEqual({view.get('objects') for view in views}, {'5'})
        self.assertIn(views[0].get('scale'), {'1:25', '1:50'})
        self.small('[[view]]\nname = "v"\nlimits = "none"\n')
        self.assertIn("'limits' of [[view]] 'v' is neither a box nor \"auto\"", self.draw().stderr)

    def test_hidden_lines_and_the_solver(self):
        self.small('arrangement = "first-angle"\n[defaults]\nhidden = "dashed"\n')
        self.assertEqual(self.draw().returncode, 0)
        ways = (self.folder / 's.svg').read_bytes()
        self.assertIn(b'class="hidden sharp"', ways)
        self.assertEqual(self.draw('--solver', 'brute-force').returncode, 0)
        self.assertEqual((self.folder / 's.svg').read_bytes(), ways)

    def test_what_is_amiss_is_reported(self):
        self.small('[[view]]\nname = "v"\nselect = "nobody"\n[fields]\ncolour = "red"\n')
        done = self.draw()
        self.assertEqual(done.returncode, 0, done.stderr)
        for code in ('selection-matches-nothing', 'view-empty', 'field-not-filled', 'field-not-in-template'):
            self.assertIn(f'warning {code}: s.toml, line', done.stderr)
        self.assertEqual(self.draw('--strict').returncode, 4)

    def test_a_fault_leaves_no_output_and_keeps_the_last(self):
        self.small('arrangement = "first-angle"\n')
        self.assertEqual(self.draw().returncode, 0)
        before = (self.folder / 's.svg').read_bytes()
        for sheet, words in (('arrangement = "first-angle"\nsize = "A3"\n', "s.toml, line 2, column 1: the file has no key"),
                             ('[[view]]\n', "s.toml, line 1, column 1: [[view]] has no 'name'"),
                             ('[sheet]\ntemplate = "t.svg"\narrangement = 3', 't.svg'),
                             ('', 'the sheet has no views'),
                             ('[sheet]\nsize = ["100mm", "100mm"]\n[arrangement]\ngap = "90mm"\n', 'no room on the sheet')):
            self.write('s.toml', sheet)
            done = self.draw()
            self.assertEqual(done.returncode, 3, done.stderr)
            self.assertIn(words, done.stderr)
            self.assertEqual((self.folder / 's.svg').read_bytes(), before)
            self.assertEqual(self.files(), ['m.obj', 's.svg', 's.toml'])

    def test_templates_beside_the_sheet(self):
        (self.folder / 'yard').mkdir()
        self.small('')
        frame = ('<svg xmlns="http://www.w3.org/2000/svg" width="297mm" height="210mm" viewBox="0 0 297 210">'
                 '<path d="M5 5H292V205H5Z" fill="none" stroke="#000"/><text x="200" y="200">{{title}} {{scale}}</text></svg>')
        self.write('yard/a4.svg', frame)
        self.write('yard/s.toml', '[sheet]\ntemplate = "a4.svg"\n[fields]\ntitle = "T"\n[[view]]\nname = "v"\n')
        done = self.draw(sheet='yard/s.toml')
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertNotIn('warning', done.stderr)
        root = self.root()
        self.assertEqual(root.get('width'), '297mm')
        self.assertIn('T 1:20', [text.text for text in root.iter(f'{SVG}text')])
        for hostile, words in ((frame.replace('<path', '<script>x()</script><path'), 'a4.svg, line 1 (the template of s.toml)'),
                               ('<!DOCTYPE svg [<!ENTITY a SYSTEM "file:///etc/passwd">]>' + frame, 'a document type'),
                               ('no svg at all', 'is it SVG?')):
            self.write('yard/a4.svg', hostile)
            done = self.draw(sheet='yard/s.toml')
            self.assertEqual(done.returncode, 3, done.stderr)
            self.assertIn(words, done.stderr)

    def test_a_sheet_states_itself_what_options_state_otherwise(self):
        self.small('arrangement = "first-angle"\n')
        for more in (['--view', 'top'], ['--scale', '1:50'], ['--paper', 'A1'], ['--select', 'a'], ['--hidden', 'all'], ['--title', 'x'],
                     ['--json'], ['-o', 's.json'], ['-o', 's.toml']):
            self.assertEqual(self.draw(*more).returncode, 2, more)
        self.assertEqual(self.run_strake('draw', 'm.obj', '--sheet', 's.toml').returncode, 2)
        self.assertEqual(self.draw(sheet='none.toml').returncode, 3)
        self.assertFalse((self.folder / 's.svg').exists())

    def test_it_renders(self):
        if not shutil.which('rsvg-convert'):
            self.skipTest('no rsvg-convert')
        self.small('arrangement = "third-angle"\n')
        self.assertEqual(self.draw().returncode, 0)
        subprocess.run(['rsvg-convert', '--width', '800', '-o', 's.png', 's.svg'], cwd=self.folder, check=True)
        self.assertGreater((self.folder / 's.png').stat().st_size, 5000)


if __name__ == '__main__':
    EXAMPLES = Path(sys.argv.pop(2)).resolve()
    main()
