#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""draw_sections_test.py STRAKE: sections, what they leave whole, hatches, and what stays open where limits cut."""
import json

from scenario import Scenario, cube, main


class Sections(Scenario):
    def test_sections_cut_away_what_they_state(self):
        self.write('a.obj', cube('a', 0, (0, 0, 0), 100))

        def cut(*options):
            done = self.run_strake('draw', 'a.obj', *options, '-o', 'x.json', '-o', 'x.svg')
            self.assertEqual(done.returncode, 0, done.stderr)
            return json.loads((self.folder / 'x.json').read_text(encoding='utf-8'))['pieces'], done.stderr

        def heights(pieces):
            return {end[2] for piece in pieces if piece['state'] != 'clipped'
                    for end in (piece['a_mm'], piece['b_mm'])}

        self.assertEqual(heights(cut('--section', 'z>40mm')[0]), {0, 40})
        self.assertEqual(heights(cut('--section', 'z < 40mm')[0]), {40, 100})
        self.assertEqual(heights(cut('--view', 'top', '--section', 'z=40mm')[0]), {0, 40})
        self.assertEqual(heights(cut('--view', 'bottom', '--section', 'z=4cm')[0]), {40, 100})
        outline = [piece for piece in cut('--section', 'z>40mm', '--threads', '3')[0] if piece['kind'] == 'section']
        self.assertEqual(len(outline), 4)
        self.assertIn('id="visible-section"', (self.folder / 'x.svg').read_text(encoding='utf-8'))
        # Three planes leave a corner; with a normal of decimals the rounding is reported.
        self.assertEqual(len({p['edge'] for p in cut('--section', 'x>40mm', '--section', 'y>40mm', '--section',
                                                     'z>40mm')[0] if p['kind'] == 'section'}), 9)
        self.assertIn('is taken as normal', cut('--section', '0.3333333,1,0>20mm')[1])
        self.assertIn('section-misses', cut('--section', 'z>9m')[1])
        self.assertIn('cuts away everything', cut('--section', 'z>-9m')[1])

    def test_sections_leave_chosen_objects_whole(self):
        self.write('a.obj', cube('plate', 0, (0, 0, 0), 100) + cube('BOLT-1', 1, (40, 40, 20), 20)
                   + cube('BOLT-2', 2, (40, 40, 70), 20))

        def cut(*options):
            done = self.run_strake('draw', 'a.obj', '--view', 'top', '--section', 'z=30mm', *options, '-o', 'x.json',
                                   '-o', 'x.svg')
            self.assertEqual(done.returncode, 0, done.stderr)
            drawing = json.loads((self.folder / 'x.json').read_text(encoding='utf-8'))
            kinds = {}
            for piece in drawing['pieces']:
                kinds.setdefault(piece['object'], set()).add((piece['kind'], piece['state']))
            return drawing, kinds, done.stderr

        plain, kinds, stated = cut()
        self.assertIn('section', {kind for kind, _ in kinds['BOLT-1']})
        self.assertNotIn('uncut', plain['settings'])
        self.assertNotIn('objects_uncut', plain['counts'])
        self.assertNotIn('left whole', stated)
        for selection in (['BOLT*'], ['name = "BOLT-1"', 'BOLT-2']):
            drawing, kinds, stated = cut(*[word for text in selection for word in ('--uncut', text)])
            self.assertEqual({kind for kind, _ in kinds['BOLT-1']} & {'section', 'hatch'}, set())
            self.assertNotIn('clipped', {state for _, state in kinds['BOLT-1']})
            # What lies wholly beyond the plane is cut away like everything else.
            self.assertEqual({state for _, state in kinds['BOLT-2']}, {'clipped'})
            self.assertIn('hatch', {kind for kind, _ in kinds['plate']})
            self.assertEqual(drawing['counts']['objects_uncut'], 1)
            self.assertEqual(drawing['settings']['uncut'], sorted(selection))
            self.assertIn('1 object is left whole by the sections', stated)
            self.assertIn(' objects-uncut="1"', (self.folder / 'x.svg').read_text(encoding='utf-8'))
        self.assertIn('0 objects are left whole', cut('--uncut', 'BOLT-2')[2])
        # Which ones are left whole is a setting that a comparison names; their order says nothing.
        for name, selection in (('a', ('BOLT-1', 'plate')), ('b', ('plate', 'BOLT-1', 'plate')), ('c', ('BOLT-1',))):
            cut(*[word for text in selection for word in ('--uncut', text)])
            (self.folder / 'x.json').rename(self.folder / f'{name}.json')
        self.assertNotIn('settings.uncut', self.run_strake('draw', 'diff', 'a.json', 'b.json').stdout)
        self.assertIn('settings.uncut: was ["BOLT-1","plate"], is ["BOLT-1"]',
                      self.run_strake('draw', 'diff', 'a.json', 'c.json').stdout)
        done = self.run_strake('draw', 'a.obj', '--uncut', 'BOLT*', '-o', 'x.svg')
        self.assertEqual(done.returncode, 2, done.stderr)
        self.assertIn('--section', done.stderr)

    def test_hatches_are_what_the_table_states(self):
        self.write('a.obj', cube('a', 0, (0, 0, 0), 100) + cube('b', 1, (200, 0, 0), 100))

        def hatch(*options):
            done = self.run_strake('draw', 'a.obj', '--view', 'top', '--section', 'z=50mm', *options, '-o', 'x.json')
            self.assertEqual(done.returncode, 0, done.stderr)
            pieces = json.loads((self.folder / 'x.json').read_text(encoding='utf-8'))['pieces']
            return [(p['object'], p['a_mm'], p['b_mm']) for p in pieces if p['kind'] == 'hatch']

        # Level lines 10 mm apart through the origin: at 10 to 100 mm, the one along the rim counts as within.
        level = hatch('--hatch', '0deg,10mm')
        self.assertEqual({a[1] for _, a, b in level}, {b[1] for _, a, b in level})
        self.assertIn(len(level), (18, 20, 22))
        some = hatch('--hatch', '90deg,20mm: a', '--hatch', 'off')
        self.assertEqual({o for o, _, _ in some}, {level[0][0]})
        self.assertTrue(all(a[0] == b[0] and a[0] % 20 == 0 for _, a, b in some))
        self.assertGreater(len(hatch()), 10)
        self.assertEqual(hatch('--hatch', 'off'), [])
        self.assertEqual(hatch('--hatch', '80mm,30deg'), hatch('--hatch', '30deg,80mm'))
        self.assertEqual(hatch('--hatch', '30'), hatch('--hatch', '30deg'))
        for wrong in ('200deg', '-1mm', '0mm', '30furlongs', '', '30deg,', '1nm', '30,80', '30deg,80', '30deg,40deg', '80mm,90mm', '80mm,30', '1,5mm', '1e300mm',
                      '45deg: nobody', '45deg: ((', 'nan'):
            done = self.run_strake('draw', 'a.obj', '--section', 'z>50mm', '--hatch', wrong, '-o', 'x.json')
            self.assertEqual(done.returncode, 2, (wrong, done.stderr))
            self.assertIn('--hatch', done.stderr, wrong)

    def test_sections_that_make_no_sense_are_reported(self):
        self.write('a.obj', cube('a', 0, (0, 0, 0), 100))
        for plane, words in (('0,0,0>1mm', 'neither an axis nor the normal'), ('z', 'no section plane'),
                             ('z>nan', 'nan'), ('z>12furlong', 'unit'), ('z>4,5m', 'write 4.5m'), ('nan,0,1>1mm', 'neither an axis'),
                             ('w>1mm', 'neither an axis'), ('z>1e300km', '--section'),
                             ('x=10mm', 'edge-on'), ('z>', '--section')):
            done = self.run_strake('draw', 'a.obj', '--view', 'top', '--section', plane, '-o', 'x.svg')
            self.assertEqual(done.returncode, 2, (plane, done.stderr))
            self.assertIn(words, done.stderr, plane)
            self.assertIn('--section', done.stderr, plane)

    def test_what_limits_cut_stays_open_and_sections_close_it(self):
        self.write('a.obj', cube('a', 0, (0, 0, 0), 100))
        kinds = []
        for cut in (['--limits', '-1m,-1m,-1m,1m,1m,5cm'], ['--section', 'z=50']):
            done = self.run_strake('draw', 'a.obj', '--view', 'top', *cut, '-o', 'x.json')
            self.assertEqual(done.returncode, 0, done.stderr)
            kinds.append({p['kind'] for p in json.loads((self.folder / 'x.json').read_text(encoding='utf-8'))['pieces']})
        self.assertNotIn('section', kinds[0])
        self.assertIn('section', kinds[1])
        help_text = ' '.join(self.text('draw', '--help').split())
        self.assertIn('What it cuts stays open; --section closes it', help_text)


if __name__ == '__main__':
    main()
