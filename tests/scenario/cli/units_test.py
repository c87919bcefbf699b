#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""units_test.py STRAKE: one part in files of several units, and a unit and an upward axis for each file."""
import json

from scenario import Scenario, main

CORNERS = [(x, y, z) for z in (0, 1) for y in (0, 1) for x in (0, 1)]
FACES = [(0, 2, 3, 1), (4, 5, 7, 6), (0, 1, 5, 4), (2, 6, 7, 3), (0, 4, 6, 2), (1, 3, 7, 5)]
SIZE_MM = (120, 80, 35)


def stl(size):
    """A text STL: a box of that size with a corner at 0."""
    lines = ['solid part']
    for a, b, c, d in FACES:
        for corners in ((a, b, c), (a, c, d)):
            lines += ['facet normal 0 0 0', 'outer loop']
            for corner in corners:
                lines.append('vertex ' + ' '.join(repr(u * s) for u, s in zip(CORNERS[corner], size)))
            lines += ['endloop', 'endfacet']
    return '\n'.join(lines + ['endsolid part', ''])


class Units(Scenario):
    def parts(self, **mm):
        """A file NAME.stl with the part in each unit of so many mm."""
        for name, length in mm.items():
            self.write(f'{name}.stl', stl([s / length for s in SIZE_MM]))

    def info(self, *arguments):
        done = self.run_strake('info', *arguments, '--json')
        self.assertEqual(done.returncode, 0, done.stderr)
        return json.loads(done.stdout), done.stderr

    def clash(self, *arguments):
        done = self.run_strake('clash', *arguments, '-o', 'x.json')
        self.assertEqual(done.returncode, 0, done.stderr)
        return json.loads((self.folder / 'x.json').read_text(encoding='utf-8')), done.stderr

    def draw(self, *arguments):
        done = self.run_strake('draw', *arguments, '--view', 'top', '-o', 'x.json')
        self.assertEqual(done.returncode, 0, done.stderr)
        return json.loads((self.folder / 'x.json').read_text(encoding='utf-8')), done.stderr

    def test_a_unit_is_doubted_until_it_is_stated(self):
        self.parts(one_mm=1, one_m=1000, one_in=25.4)
        for other, unit in (('one_m.stl', 'm'), ('one_in.stl', 'in')):
            for run in (self.info, self.clash, self.draw):
                with self.subTest(unit=unit, run=run.__name__):
                    reported = run('one_mm.stl', other)[1]
                    self.assertIn('warning unit-doubtful: one_mm.stl: ', reported)
                    self.assertIn(f"--unit '{other}={unit}'", reported)
                    self.assertNotIn('unit-doubtful', run('one_mm.stl', other, '--unit', f'{other}={unit}')[1])

    def test_parts_of_unlike_size_are_not_doubted(self):
        self.parts(one_mm=1)
        self.write('other.stl', stl([s / f for s, f in zip(SIZE_MM, (1000, 1000, 1500))]))
        self.write('tenth.stl', stl([s / 10 for s in SIZE_MM]))
        for other in ('other.stl', 'tenth.stl'):
            self.assertNotIn('unit-doubtful', self.info('one_mm.stl', other)[1])

    def test_info_states_which_unit_was_taken_of_each_file(self):
        self.parts(one_mm=1, one_m=1000, one_in=25.4)
        reported, _ = self.info('one_mm.stl', 'one_m.stl', 'one_in.stl', '--unit', 'one_m.stl=m', '--unit', 'one_in.stl=in')
        self.assertEqual({f['file']: f['unit'] for f in reported['files']},
                         {'one_mm.stl': 'mm (assumed)', 'one_m.stl': 'm (given)', 'one_in.stl': 'in (given)'})
        for axis, size in enumerate(SIZE_MM):
            self.assertAlmostEqual(reported['total']['extents_mm']['hi'][axis], size, delta=.01)

    def test_clash_finds_the_part_in_itself(self):
        self.parts(one_mm=1, one_m=1000)
        doubted, _ = self.clash('one_mm.stl', 'one_m.stl')
        self.assertEqual([m['code'] for m in doubted['messages'] if m['code'] == 'unit-doubtful'], ['unit-doubtful'])
        for stated in (['--unit', 'one_m.stl=m'], ['--unit', 'm', '--unit', 'one_mm.stl=mm']):
            with self.subTest(stated=stated):
                result, _ = self.clash('one_mm.stl', 'one_m.stl', *stated)
                self.assertEqual([r['class'] for r in result['results']], ['HIT'])
                # The deepest point of a box is half its thickness in.
                self.assertAlmostEqual(result['results'][0]['d_mm'], -SIZE_MM[2] / 2, delta=.01)
                self.assertEqual({f['label']: f['unit'].split()[0] for f in result['files']},
                                 {'one_mm.stl': 'mm', 'one_m.stl': 'm'})

    def test_draw_puts_both_on_each_other(self):
        """Every line of the one is one of the other only where both have the unit that is theirs."""
        self.parts(one_mm=1, one_m=1000)
        self.assertGreater(self.draw('one_mm.stl', 'one_m.stl', '--unit', 'one_m.stl=m')[0]['counts']['duplicate'],
                           self.draw('one_mm.stl', 'one_m.stl')[0]['counts']['duplicate'])

    def test_each_file_has_its_axis(self):
        self.parts(z_up=1)
        x, y, z = SIZE_MM
        self.write('y_up.stl', stl((x, z, y)))
        extents = self.info('z_up.stl', 'y_up.stl', '--up-axis', 'y_up.stl=y')[0]['total']['extents_mm']
        self.assertEqual((extents['lo'], extents['hi']), ([0, -y, 0], [x, y, z]))

    def test_names_of_files(self):
        for folder in ('hull', 'rev=2'):
            (self.folder / folder).mkdir()
            self.write(f'{folder}/a.stl', stl(SIZE_MM))
        for stated, units in (('hull/a.stl=m', ('m (given)', 'mm (assumed)')),
                            ('rev=2/a.stl=m', ('mm (assumed)', 'm (given)'))):
            reported, _ = self.info('hull/a.stl', 'rev=2/a.stl', '--unit', stated)
            self.assertEqual(tuple(f['unit'] for f in reported['files']), units)
        for stated, why in (('a.stl=m', 'write more of the path'), ('b.stl=m', 'none of the files'), ('=m', 'part.stl=m'),
                          ('hull/a.stl=', 'um, mm')):
            for option in (['info'], ['clash'], ['draw', '-o', 'x.svg']):
                with self.subTest(stated=stated, option=option):
                    done = self.run_strake(*option, 'hull/a.stl', 'rev=2/a.stl', '--unit', stated)
                    self.assertEqual(done.returncode, 2, done.stderr)
                    self.assertIn(why, done.stderr)
                    self.assertIn('--unit', done.stderr)
        done = self.run_strake('info', 'hull/a.stl', '--unit', 'm', '--unit', 'mm')
        self.assertEqual(done.returncode, 2, done.stderr)
        self.assertIn('more than once', done.stderr)


if __name__ == '__main__':
    main()
