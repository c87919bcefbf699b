#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""project_draw_test.py STRAKE: views that a project remembers, and drawings written again from their neutral form."""
import contextlib
import json
import sqlite3

from scenario import Scenario, cube, main

WAYS = ('--unit', 'mm', '--up-axis', 'z')
VIEW = ('--view', 'iso', '--hidden', 'dashed')


def hall(moved=0):
    """Thirty cubes in rows that hide each other; one of them may stand elsewhere."""
    places = [(120 * (n % 6), 150 * (n // 6), 0) for n in range(30)]
    places[17] = (places[17][0] + moved, places[17][1], places[17][2])
    return ''.join(cube(f'c{n:02}', n, at, 100) for n, at in enumerate(places))


class ProjectDraw(Scenario):
    def setUp(self):
        super().setUp()
        self.write('m.obj', hall())
        self.text('project', 'new', 'p.strake', 'm.obj', *WAYS)

    def reported(self, *arguments, exit_code=0):
        """What a run in the project says on standard error."""
        done = self.run_strake('draw', '-p', 'p.strake', *arguments)
        self.assertEqual(done.returncode, exit_code, done.stderr)
        return done.stderr

    def refused(self, *arguments, code=2):
        done = self.run_strake('draw', *arguments)
        self.assertEqual(done.returncode, code, done.stderr)
        return done.stderr

    def same(self, one, other):
        self.assertEqual((self.folder / one).read_bytes(), (self.folder / other).read_bytes(), f'{one} is not {other}')

    def fresh(self, *view):
        self.text('draw', 'm.obj', *WAYS, *view, '-o', 'f.json', '-o', 'f.svg', '-o', 'f.view')

    def save(self, *view):
        return self.reported('--save', 'hall', *view, '-o', 'p.json', '-o', 'p.svg', '-o', 'p.view')

    def update(self, moved):
        self.write('m.obj', hall(moved))
        self.text('project', 'update', 'p.strake')

    def test_a_view_is_solved_once(self):
        self.fresh(*VIEW)
        self.assertRegex(self.save(*VIEW), r"view 'hall': new view: .*edges? of 30 objects solved in ")
        for name in ('json', 'svg', 'view'):
            self.same(f'p.{name}', f'f.{name}')
        reported = self.reported('--stored', 'hall', '--stats', '-o', 'a.json', '-o', 'a.svg', '-o', 'a.view')
        self.assertRegex(reported, r"view 'hall': existing view, unchanged: none of 30 objects changed, nothing solved again, "
                         r"\d+ edges kept")
        self.assertRegex(reported, r'no local and no global step; [\d.]+ s to find what changed, [\d.]+ s to read')
        self.assertIn('signatures', reported)
        for name in ('json', 'svg', 'view'):
            self.same(f'a.{name}', f'f.{name}')
        # Defined again alike, it is not solved again either.
        self.assertIn('nothing solved again', self.save(*VIEW))
        self.assertRegex(self.reported('--stored', 'hall', '--full'), r'view in full: as asked: .* solved in')
        self.assertIn('hall', self.text('project', 'list', 'p.strake', 'views'))

    def test_what_changed_is_solved(self):
        self.save(*VIEW)
        for moved in (20, 0, -60):
            self.update(moved)
            self.fresh(*VIEW)
            reported = self.reported('--stored', 'hall', '--verify', '-o', 'a.json', '-o', 'a.svg', '-o', 'a.view')
            self.assertRegex(reported, r"view 'hall': (existing view with changes: 1 of 30 objects changed, .* edges? solved again in |"
                             r'view in full: .* solved in )')
            self.assertIn('the same lines in full', reported)
            for name in ('json', 'svg', 'view'):
                self.same(f'a.{name}', f'f.{name}')
            self.assertIn('nothing solved again', self.reported('--stored', 'hall'))

    def figures(self, *arguments):
        """The statistics of a run, which are the last line of standard error."""
        return json.loads(self.reported(*arguments, '--stats', '--json').splitlines()[-1])

    def test_what_it_did_and_what_it_cost_is_reported(self):
        self.fresh(*VIEW)
        self.assertRegex(self.save(*VIEW), r'[\d.]+ s of preparation, [\d.]+ s of the local step for 30 objects, of which '
                                           r'\d+ instances share results, [\d.]+ s of the global step for 30 objects; ')
        kept = self.figures('--stored', 'hall')
        self.assertEqual(kept['words']['view'], 'existing view, unchanged')
        for name in ('objects changed', 'objects solved locally', 'objects solved globally', 'edges solved'):
            self.assertEqual(kept['counters'][name], 0, name)
        self.update(-60)
        changed = self.figures('--stored', 'hall')
        self.assertIn(changed['words']['view'], ('existing view with changes', 'view in full'))
        self.assertEqual(changed['counters']['objects changed'], 1)
        self.assertGreater(changed['counters']['objects solved locally'], 0)
        self.assertTrue({'view preparation', 'local hidden lines', 'global hidden lines'} <=
                        {stage['name'] for stage in changed['stages']})
        # A view that is not global has no global step; another view is new.
        local = self.figures('--save', 'hall', '--view', 'iso', '--stage', 'local')
        self.assertEqual(local['words']['view'], 'new view')
        self.assertEqual(local['counters']['objects solved locally'], 30)
        self.assertEqual(local['counters']['objects solved globally'], 0)
        self.assertNotIn('global hidden lines', {stage['name'] for stage in local['stages']})

    def test_sections_and_eyes_follow_changes(self):
        for view in (('--view', 'top', '--section', 'z=50mm'), ('--eye', '-500,-900,700', '--target', '300,300,0')):
            self.update(0)
            self.save(*view)
            (self.folder / 'm.obj').rename(self.folder / 'b.obj')
            self.text('project', 'update', 'p.strake', 'b.obj', '--match-files', 'm.obj=b.obj')
            self.assertIn('nothing solved again', self.reported('--stored', 'hall', '--verify'))
            self.write('b.obj', hall(20))
            self.text('project', 'update', 'p.strake')
            reported = self.reported('--stored', 'hall', '--verify', '-o', 'a.json')
            self.assertIn('existing view with changes: 1 of 30 objects changed', reported)
            self.assertIn('the same lines in full', reported)
            self.text('draw', 'b.obj', *WAYS, *view, '-o', 'f.json')
            self.same('a.json', 'f.json')
            (self.folder / 'b.obj').rename(self.folder / 'm.obj')
            self.text('project', 'update', 'p.strake', 'm.obj', '--match-files', 'b.obj=m.obj')

    def test_a_file_of_another_name_is_not_solved_again(self):
        self.save(*VIEW)
        (self.folder / 'm.obj').rename(self.folder / 'b.obj')
        self.text('project', 'update', 'p.strake', 'b.obj', '--match-files', 'm.obj=b.obj')
        self.assertIn('nothing solved again', self.reported('--stored', 'hall', '-o', 'a.svg', '-o', 'a.json'))
        self.text('draw', 'b.obj', *WAYS, *VIEW, '-o', 'f.svg', '-o', 'f.json')
        self.same('a.svg', 'f.svg')
        self.same('a.json', 'f.json')

    def test_the_file_alone_holds_all(self):
        self.save(*VIEW)
        for command in (('project', 'info', 'p.strake'), ('draw', '-p', 'p.strake', '--stored', 'hall', '-o', 'a.svg'),
                        ('project', 'check', 'p.strake'), ('draw', 'p.strake', '--view', 'top', '-o', 'a.svg')):
            self.text(*command)
            self.assertEqual([path.name for path in self.folder.glob('*.strake*')], ['p.strake'], command)
        self.assertIn('nothing solved again', self.reported('--stored', 'hall'))

    def test_another_view_of_the_name_has_its_own_lines(self):
        self.save(*VIEW)
        for view in (('--view', 'front'), ('--view', 'iso', '--section', 'z=50mm', '--select', 'c1*'),
                     ('--eye', '-500,-900,700', '--target', '300,300,0'), ('--view', 'top', '--visible-only')):
            self.fresh(*view)
            self.save(*view)
            self.same('p.json', 'f.json')
            self.same('p.svg', 'f.svg')
            self.reported('--stored', 'hall', '-o', 'a.svg')
            self.same('a.svg', 'f.svg')

    def test_the_sheet_and_ink_may_be_others(self):
        self.save(*VIEW)
        style = ('--scale', '1:20', '--paper', 'A2', '--title', 'Hall "B"', '--hidden', 'all')
        reported = self.reported('--stored', 'hall', *style, '-o', 'a.svg', '-o', 'a.json')
        self.assertIn('nothing solved again', reported)
        self.fresh('--view', 'iso', *style)
        self.same('a.svg', 'f.svg')
        self.same('a.json', 'f.json')
        # What was saved stays as it was.
        self.fresh(*VIEW)
        self.reported('--stored', 'hall', '-o', 'a.svg')
        self.same('a.svg', 'f.svg')

    def test_lines_that_are_damaged_serve_nobody(self):
        self.save(*VIEW)
        with contextlib.closing(sqlite3.connect(self.folder / 'p.strake')) as other:
            other.execute("UPDATE drawing SET lines = x'0102'")
            other.commit()
        reported = self.reported('--stored', 'hall', '-o', 'a.svg')
        self.assertIn('all lines are solved anew', reported)
        self.fresh(*VIEW)
        self.same('a.svg', 'f.svg')
        self.assertIn('nothing solved again', self.reported('--stored', 'hall'))

    def test_wrong_inputs(self):
        self.save(*VIEW)
        self.assertIn("'hall'", self.refused('-p', 'p.strake', '--stored', 'deck', '-o', 'a.svg'))
        self.assertIn('--section', self.refused('-p', 'p.strake', '--stored', 'hall', '--section', 'z=1mm', '-o', 'a.svg'))
        self.assertIn('--visible-only', self.refused('-p', 'p.strake', '--stored', 'hall', '--visible-only', '-o', 'a.svg'))
        self.refused('m.obj', '--stored', 'hall', '-o', 'a.svg')
        self.refused('-p', 'p.strake', 'm.obj', '--stored', 'hall', '-o', 'a.svg')
        self.refused('-p', 'p.strake', '--save', 'a', '--stored', 'hall', '-o', 'a.svg')
        self.refused('-p', 'p.strake', '--full', '-o', 'a.svg')
        self.refused('-p', 'p.strake', '--stored', 'hall', '-o', 'p.strake')
        self.refused('-p', 'p.strake')
        with contextlib.closing(sqlite3.connect(self.folder / 'p.strake')) as other:
            for settings in ('nothing', '[]', '{"magic":"yes"}', '{"view":1}', '{"section":"z=1mm"}', '{"visible-only":"x"}'):
                other.execute('UPDATE view SET settings = ?', (settings,))
                other.commit()
                self.assertIn('save the view again', self.refused('-p', 'p.strake', '--stored', 'hall', '-o', 'a.svg', code=3))

    def test_a_drawing_is_written_again_without_its_model(self):
        for view in (('--view', 'iso'), ('--view', 'top', '--section', 'z=50mm', '--title', 'A-A'),
                     ('--eye', '-500,-900,700', '--target', '300,300,0')):
            for hidden in ('off', 'dashed', 'all'):
                self.fresh(*view, '--hidden', hidden)
                for neutral in ('f.json', 'f.view'):
                    self.text('draw', neutral, '--hidden', hidden, '-o', 'a.svg', '-o', 'a.json', '-o', 'a.view')
                    for name in ('json', 'svg', 'view'):
                        self.same(f'a.{name}', f'f.{name}')

    def test_a_drawing_is_put_on_another_sheet(self):
        self.fresh('--view', 'iso')
        self.text('draw', 'f.view', '--scale', '1:20', '--paper', 'A1', '--title', 'B', '-o', 'a.json', '-o', 'a.svg')
        self.text('draw', 'm.obj', *WAYS, '--view', 'iso', '--scale', '1:20', '--paper', 'A1', '--title', 'B',
                  '-o', 'b.json', '-o', 'b.svg')
        one, other = (json.loads((self.folder / name).read_text(encoding='utf-8')) for name in ('a.json', 'b.json'))
        self.assertEqual(one['sheet'], other['sheet'])
        self.assertEqual(one['hash'], other['hash'])
        for a, b in zip(one['pieces'], other['pieces'], strict=True):
            for end in ('a_paper_mm', 'b_paper_mm'):
                for x, y in zip(a[end], b[end], strict=True):
                    self.assertAlmostEqual(x, y, delta=.0015)

    def test_what_needs_the_model_is_refused(self):
        self.fresh('--view', 'iso')
        for option in (('--view', 'top'), ('--select', 'c1*'), ('--sag', '1mm'), ('--unit', 'm'), ('--visible-only',),
                       ('--solver', 'brute-force'), ('--strict',)):
            self.assertIn(option[0], self.refused('f.json', *option, '-o', 'a.svg'))
        self.refused('f.json', 'm.obj', '-o', 'a.svg')
        self.refused('f.json', '-o', 'f.json')
        self.assertIn('larger paper', self.refused('f.json', '--scale', '1:1', '--paper', 'A4', '-o', 'a.svg'))
        self.text('draw', 'm.obj', *WAYS, '--visible-only', '-o', 'v.json')
        self.assertIn('--hidden', self.refused('v.json', '--hidden', 'dashed', '-o', 'a.svg'))
        sound = (self.folder / 'f.json').read_text(encoding='utf-8')
        self.write('cut.json', sound[:len(sound) // 2])
        self.refused('cut.json', '-o', 'a.svg', code=3)
        self.write('wrong.json', sound.replace('"edge":1,', '"edge":90000,', 1))
        self.refused('wrong.json', '-o', 'a.svg', code=3)


if __name__ == '__main__':
    main()
