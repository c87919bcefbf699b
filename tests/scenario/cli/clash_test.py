#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""clash_test.py STRAKE: sets, options, exit codes and outputs of a clash run."""
import csv
import io
import json
import math

from scenario import CUBE_FACES, Scenario, cube, main


def box_with_lid_off(gap):
    """An OBJ object: a cube of side 100 whose lid stands `gap` above it, on corners of its own."""
    head = cube('box', 0, (0, 0, 0), 100).split('f ')[0]
    faces = [face for face in CUBE_FACES if face != (5, 6, 7, 8)]
    lines = [f'v {x} {y} {100 + gap}' for x, y in ((0, 0), (100, 0), (100, 100), (0, 100))]
    lines += ['f ' + ' '.join(map(str, face)) for face in [*faces, (9, 10, 11, 12)]]
    return head + '\n'.join(lines) + '\n'


class Clash(Scenario):
    SETTINGS = ['--unit', 'mm', '--up-axis', 'z']

    def pairs(self, *arguments):
        done = self.run_strake('clash', *arguments, *self.SETTINGS, '--json')
        self.assertEqual(done.returncode, 0, done.stderr)
        return [(r['a']['name'], r['b']['name'], r['class']) for r in json.loads(done.stdout)['results']]

    def test_one_file_against_itself_several_against_each_other(self):
        self.two_files()
        self.write('c.obj', cube('c0', 0, (140, 140, 140), 100))
        self.assertEqual(self.pairs('a.obj'), [('a0', 'a1', 'HIT')])
        self.assertEqual(self.pairs('a.obj', 'b.obj'), [])
        near = ('a0', 'b0', 'CLEARANCE_VIOLATION')
        self.assertEqual(self.pairs('a.obj', 'b.obj', '--clearance', '0.99cm'), [])
        self.assertEqual(self.pairs('a.obj', 'b.obj', '--clearance', '10.1mm'), [near])
        self.assertEqual(self.pairs('a.obj', 'b.obj', 'c.obj', '--clearance', '10.1mm'),
                         [near, ('a1', 'c0', 'HIT')])
        self.assertEqual(self.pairs('a.obj', 'b.obj', 'c.obj', '--clearance', '10.1mm', '--self'),
                         [('a0', 'a1', 'HIT'), near, ('a1', 'c0', 'HIT')])

    def test_files_and_twins_give_the_same_bytes(self):
        self.two_files()
        arguments = ['clash', 'a.obj', 'b.obj', '--self', '--clearance', '25mm', *self.SETTINGS]
        self.assertEqual(self.run_strake(*arguments, '-o', 'x.json', '-o', 'x.csv').returncode, 0)
        expected = (self.folder / 'x.json').read_bytes()
        for more in (['--threads', 1], ['--threads', 3], ['--threads', 64], ['--broad-phase', 'all-pairs'],
                     ['--threads', 3, '--distribution', 'equal-ranges'], ['--threads', 3, '--distribution', 'in-order'],
                     ['--threads', 7, '--broad-phase', 'all-pairs', '--distribution', 'equal-ranges']):
            with self.subTest(more):
                self.assertEqual(self.run_strake(*arguments, *more, '-o', 'y.json').returncode, 0)
                self.assertEqual((self.folder / 'y.json').read_bytes(), expected)
        self.assertEqual(self.run_strake('clash', 'b.obj', 'a.obj', *arguments[3:], '-o', 'y.json').returncode, 0)
        self.assertEqual((self.folder / 'y.json').read_bytes(), expected, 'the order of files shows')
        self.assertEqual(len((self.folder / 'x.csv').read_text().splitlines()), 3)

    def test_sets_by_selection(self):
        self.two_files()
        both = ['a.obj', 'b.obj', '--clearance', '25mm']
        hit, near = ('a0', 'a1', 'HIT'), ('a0', 'b0', 'CLEARANCE_VIOLATION')
        self.assertEqual(self.pairs(*both), [near])
        self.assertEqual(self.pairs(*both, '--a', 'a0'), [hit, near], 'one set alone is against everything')
        self.assertEqual(self.pairs(*both, '--b', 'a1'), [hit])
        self.assertEqual(self.pairs(*both, '--a', 'a1', '--b', 'a0', '--b', 'b0'), [hit])
        self.assertEqual(self.pairs(*both, '--a', 'a0', '--a', 'a1', '--b', 'name ~ "^a"'), [hit])
        self.assertEqual(self.pairs(*both, '--a', "file = 'b.obj'"), [near])
        done = self.run_strake('clash', *both, *self.SETTINGS, '--a', 'a0', '--a', 'a9', '--b', 'b?', '--json')
        test, = json.loads(done.stdout)['tests']
        self.assertEqual(test['sets'], {'a': '(a0) or (a9)', 'b': 'b?'})
        self.assertEqual(test['objects'], {'a': 1, 'b': 1})
        self.assertIn("selection-picks-nothing: --a: 'a9' picks no object", done.stderr)
        self.assertEqual([m['where'] for m in json.loads(done.stdout)['messages']
                          if m['code'] == 'selection-picks-nothing'], ['--a'])

    def test_sets_by_file_are_named_as_selections(self):
        self.two_files()
        done = self.run_strake('clash', 'a.obj', 'b.obj', *self.SETTINGS, '--clearance', '25mm', '--json')
        by_file = json.loads(done.stdout)
        sets = by_file['tests'][0]['sets']
        self.assertEqual(sets, {'a': "file = 'a.obj'", 'b': "file = 'b.obj'"})
        done = self.run_strake('clash', 'a.obj', 'b.obj', *self.SETTINGS, '--clearance', '25mm', '--json',
                               '--a', sets['a'], '--b', sets['b'])
        self.assertEqual(json.loads(done.stdout), by_file)

    def test_an_empty_set_is_a_warning_in_both_places(self):
        self.two_files()
        done = self.run_strake('clash', 'a.obj', '--a', 'nobody', '--json')
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn('empty-set: set A, nobody', done.stderr)
        report = json.loads(done.stdout)
        self.assertEqual(report['results'], [])
        self.assertIn(('empty-set', 'set A, nobody'), [(m['code'], m['where']) for m in report['messages']])

    def test_an_empty_set_is_reported_as_draw_reports_it(self):
        self.two_files()
        for selection, mend in (('nobody', 'a bare pattern is compared with names'),
                                ('@Tag = 7', "'strake info --attributes' lists the attributes"),
                                ('type = sphere', "'strake info --objects 20' lists what")):
            clash = self.run_strake('clash', 'a.obj', '--a', selection)
            draw = self.run_strake('draw', 'a.obj', '--select', selection, '-o', 'x.svg')
            self.assertEqual((clash.returncode, draw.returncode), (0, 2))
            stated = draw.stderr.splitlines()[-1].split('--select: ')[1]
            self.assertIn(f"'{selection}' picks no object", stated)
            self.assertIn(mend, stated)
            self.assertIn(f'warning selection-picks-nothing: --a: {stated}\n', clash.stderr)

    def test_a_file_given_twice_is_reported(self):
        self.two_files()
        (self.folder / 'link.obj').symlink_to('a.obj')
        for verb in (['clash', '--json'], ['draw', '--json'], ['info', '--json']):
            for second, stated in (('a.obj', 'is given more than once: '), ('./a.obj', "is the file 'a.obj' as well: "),
                                 ('link.obj', "is the file 'a.obj' as well: ")):
                done = self.run_strake(*verb, 'a.obj', 'b.obj', second)
                self.assertEqual(done.returncode, 0, done.stderr)
                self.assertIn(f'warning file-given-twice: {second}: {stated}', done.stderr)
            self.assertNotIn('file-given-twice', self.run_strake(*verb, 'a.obj', 'b.obj').stderr)
        messages = json.loads(self.run_strake('clash', 'a.obj', 'a.obj', '--json').stdout)['messages']
        self.assertIn('file-given-twice', [m['code'] for m in messages])

    def test_an_empty_set_is_no_success(self):
        self.two_files()
        for sets, stated in ((['--a', 'nobody*'], 'set A is empty (nobody*)'),
                           (['--a', 'a0', '--b', 'b0'], 'set B is empty (b0)')):
            run = ['clash', 'a.obj', *sets, '--quiet']
            for extra, code, option in ((['--fail-on', 'hit'], 1, '--fail-on hit'),
                                        (['--fail-on', 'clearance_violation', '--json'], 1,
                                         '--fail-on clearance_violation'),
                                        (['--fail-on', 'hit', '--strict'], 1, '--fail-on hit'),
                                        (['--strict'], 4, '--strict')):
                with self.subTest(sets=sets, extra=extra):
                    done = self.run_strake(*run, *extra)
                    self.assertEqual(done.returncode, code, done.stderr)
                    self.assertEqual(done.stderr, f'strake: {option}: nothing was compared: {stated}\n')
            done = self.run_strake(*run)
            self.assertEqual((done.returncode, done.stderr), (0, ''))
            self.assertIn(f'violations; nothing was compared: {stated.split(" (")[0]}\n', done.stdout)

    def test_lines_are_classified_where_requested(self):
        self.write('a.obj', cube('a0', 0, (0, 0, 0), 100) + 'o wire\nv -50 50 40\nv 150 50 40\nl 9 10\n')
        plain = json.loads(self.run_strake('clash', 'a.obj', '--json').stdout)
        self.assertEqual((plain['results'], plain['tests'][0]['settings']['curves']), ([], False))
        run = self.run_strake('clash', 'a.obj', '--curves', '--json', '--fail-on', 'hit')
        self.assertEqual(run.returncode, 1, run.stderr)
        document = json.loads(run.stdout)
        self.assertEqual(document['tests'][0]['settings']['curves'], True)
        (result,) = document['results']
        self.assertEqual((result['class'], result['relation']), ('HIT', 'CROSS'))
        self.assertAlmostEqual(result['d_mm'], -40, places=2)
        run = self.run_strake('clash', 'a.obj', '--curves', '--narrow-phase', 'sphere-subdivision')
        self.assertEqual(run.returncode, 2)
        self.assertIn('--curves', run.stderr)
        # Against a run without lines nothing can be said of theirs.
        self.run_strake('clash', 'a.obj', '--curves', '-o', 'with.json')
        self.run_strake('clash', 'a.obj', '-o', 'without.json')
        diff = self.run_strake('clash', 'diff', 'with.json', 'without.json')
        self.assertIn('settings differ: curves', diff.stdout)

    def test_the_limit_of_pairs_can_be_set(self):
        self.two_files()
        done = self.run_strake('clash', 'a.obj', '--max-pairs', 0)
        self.assertEqual(done.returncode, 3, done.stderr)
        self.assertIn('more than 0 pairs', done.stderr)
        self.assertIn('--max-pairs', done.stderr)
        self.assertEqual(self.run_strake('clash', 'a.obj', '--max-pairs', 1).returncode, 0)

    def test_contacts_are_counted_or_listed(self):
        """Three cubes in a row that touch, and one that runs into the last."""
        self.write('row.obj', ''.join(cube(f'c{n}', n, (x, 0, 0), 100) for n, x in enumerate((0, 100, 200, 290))))
        touching, hit = [('c0', 'c1', 'CONTACT'), ('c1', 'c2', 'CONTACT')], ('c2', 'c3', 'HIT')
        self.assertEqual(self.pairs('row.obj'), [*touching, hit])
        self.assertEqual(self.pairs('row.obj', '--contacts', 'count'), [hit])
        documents = {}
        for contacts in 'count', 'list':
            file = f'{contacts}.json'
            done = self.run_strake('clash', 'row.obj', *self.SETTINGS, '--contacts', contacts, '-o', file)
            self.assertIn('1 hit, 2 contacts' + (' (2 not listed)' if contacts == 'count' else ','), done.stdout)
            documents[contacts] = json.loads((self.folder / file).read_text())
        counted, listed = (documents[name]['tests'][0] for name in ('count', 'list'))
        self.assertEqual(counted['unlisted'], {'CONTACT': 2, 'ALLOWED': 0})
        self.assertNotIn('unlisted', listed)
        self.assertEqual(counted['counts'], listed['counts'])
        self.assertEqual(counted['hash'], listed['hash'], 'what was found is the same')
        for arguments, code in ((('--fail-on', 'contact'), 1),
                                (('--group-by', 'element', '--group-contacts'), 2)):
            done = self.run_strake('clash', 'row.obj', *self.SETTINGS, *arguments, '--contacts', 'count')
            self.assertEqual(done.returncode, code, arguments)

    def test_a_sheet_that_is_there_twice_is_listed(self):
        plate = 'o {0}\nv 0 0 0\nv 100 0 0\nv 0 100 0\nf {1} {2} {3}\n'
        self.write('twice.obj', plate.format('p', 1, 2, 3) + plate.format('q', 4, 5, 6))
        self.assertEqual(self.pairs('twice.obj', '--contacts', 'count'), [('p', 'q', 'CONTACT')])

    def test_what_may_be_an_unlisted_contact_is_not_gone(self):
        """A pair that touches, and one that is near and touches in the second run."""
        def row(file, at, contacts):
            self.write('row.obj', ''.join(cube(f'c{n}', n, (x, 0, 0), 100) for n, x in enumerate((0, 100, at))))
            self.run_strake('clash', 'row.obj', *self.SETTINGS, '--clearance', '25mm', '--contacts', contacts,
                            '-o', file)
        row('near.json', 210, 'list')
        row('touching.json', 200, 'count')
        reported = json.loads(self.run_strake('clash', 'diff', 'near.json', 'touching.json', '--json').stdout)
        self.assertEqual(reported['counts'], {'new': 0, 'changed': 0, 'same': 0, 'gone': 0, 'cannot_tell': 2})
        for entry in reported['cannot_tell']:
            self.assertIn('2 contacts, which are not listed', entry['why'])
        reported = json.loads(self.run_strake('clash', 'diff', 'touching.json', 'near.json', '--json').stdout)
        self.assertEqual(reported['counts']['new'], 2)
        for entry in reported['added']:
            self.assertIn('2 contacts, which are not listed', entry['why'])

    def test_contacts_that_rules_allow_are_counted_as_such(self):
        self.write('row.obj', ''.join(cube(f'c{n}', n, (x, 0, 0), 100) for n, x in enumerate((0, 100, 200))))
        self.write('r.toml', '[[allowed]]\nname = "first"\na = "c0"\nb = "*"\n[[test]]\nname = "all"\n')
        done = self.run_strake('clash', 'row.obj', *self.SETTINGS, '--rules', 'r.toml', '--contacts', 'count', '--json')
        test = json.loads(done.stdout)['tests'][0]
        self.assertEqual(test['unlisted'], {'CONTACT': 1, 'ALLOWED': 1})
        self.assertEqual((test['counts']['CONTACT'], test['counts']['ALLOWED']), (1, 1))
        (self.folder / 'a.json').write_text(done.stdout)
        self.assertEqual(self.run_strake('clash', 'diff', 'a.json', 'a.json').returncode, 0)

    def test_fail_on_is_an_exit_code(self):
        self.two_files()
        self.assertEqual(self.run_strake('clash', 'a.obj', *self.SETTINGS).returncode, 0)
        self.assertEqual(self.run_strake('clash', 'a.obj', *self.SETTINGS, '--fail-on', 'hit').returncode, 1)
        far = ['clash', 'a.obj', 'b.obj', *self.SETTINGS, '--clearance', '25mm', '--fail-on']
        self.assertEqual(self.run_strake(*far, 'hit').returncode, 0)
        self.assertEqual(self.run_strake(*far, 'contact').returncode, 0)
        self.assertEqual(self.run_strake(*far, 'clearance_violation').returncode, 1)

    def test_fail_on_counts_what_may_be_as_bad(self):
        # 2 mm apart; with one sphere the baseline cannot tell how far, nor whether at all.
        self.write('a.obj', cube('a0', 0, (0, 0, 0), 100) + cube('a1', 1, (102, 0, 0), 100))
        run = ['clash', 'a.obj', *self.SETTINGS, '--clearance', '3mm', '--narrow-phase', 'sphere-subdivision',
               '--max-spheres', 1, '--json']
        done = self.run_strake(*run)
        (result,) = json.loads(done.stdout)['results']
        self.assertEqual((done.returncode, result['class'], result['may_be']), (0, 'CONTACT', 'HIT'))
        self.assertEqual(result['flags'], ['UNCERTAIN'])
        plain = self.run_strake(*run[:-1]).stdout
        self.assertTrue(plain.endswith('0 hits, 1 contact, 0 clearance violations; 1 result is uncertain '
                                       'and may be more severe\n'), plain)
        done = self.run_strake(*run, '--fail-on', 'hit')
        self.assertEqual(done.returncode, 1)
        self.assertIn('--fail-on hit: 1 that may be as bad', done.stderr)
        done = self.run_strake(*run, '--fail-on', 'contact')
        self.assertEqual((done.returncode, 'may be' in done.stderr), (1, False))
        # Where it is told exactly nothing is left to doubt.
        exactly = [*run[:6], '--clearance', '3mm', '--fail-on', 'contact']
        self.assertEqual(self.run_strake(*exactly).returncode, 0)

    def test_a_depth_that_a_work_limit_ended_is_reported_as_such(self):
        # Of cubes 10 mm deep in each other the baseline finds out no more than that they clash.
        self.write('a.obj', cube('a0', 0, (0, 0, 0), 100) + cube('a1', 1, (90, 0, 0), 100))
        exact = ['clash', 'a.obj', *self.SETTINGS]
        spheres = [*exact, '--narrow-phase', 'sphere-subdivision']
        reported = {}
        for name, run in (('exact', exact), ('spheres', spheres)):
            done = self.run_strake(*run, '-o', f'{name}.json', '-o', f'{name}.csv')
            (result,) = json.loads((self.folder / f'{name}.json').read_text(encoding='utf-8'))['results']
            (row,) = csv.DictReader(io.StringIO((self.folder / f'{name}.csv').read_text(encoding='utf-8')))
            self.assertEqual(result['class'], 'HIT')
            low, high = result['d_range_mm']
            bracket = f'[{math.floor(low * 1000) / 1000:.3f}, {math.ceil(high * 1000) / 1000:.3f}]'
            reported[name] = (result.get('depth_complete'), row['depth_complete'], bracket in done.stdout,
                          'd range mm' in done.stdout)
        self.assertEqual(reported, {'exact': (None, '', False, False), 'spheres': (False, 'false', True, True)})
        diff = self.run_strake('clash', 'diff', 'exact.json', 'spheres.json')
        self.assertIn(', depth incomplete (was HIT -10.000)', diff.stdout)

    def test_fail_on_counts_pairs_that_could_not_be_compared(self):
        # Together they measure more than 2.147 km: nothing is known of them, whatever they are.
        self.write('a.obj', cube('a0', 0, (-1.5e6, 0, 0), 1.5e6))
        self.write('b.obj', cube('b0', 0, (-1e3, 0, 0), 1.5e6))
        run = ['clash', 'a.obj', 'b.obj', *self.SETTINGS]
        done = self.run_strake(*run)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn('0 hits, 0 contacts, 0 clearance violations; not compared: 1 pair\n', done.stdout)
        for worst in 'hit', 'contact', 'clearance_violation':
            done = self.run_strake(*run, '--fail-on', worst)
            self.assertEqual(done.returncode, 1, done.stderr)
            self.assertIn(f'--fail-on {worst}: pairs that could not be compared and may be as bad: 1', done.stderr)
        self.assertRegex(self.run_strake(*run, '--stats').stderr, r'pairs not compared\s+1\n')

    def test_a_vertex_without_a_place_costs_its_faces_only(self):
        self.write('a.obj', cube('a0', 0, (0, 0, 0), 100)
                   + cube('a1', 1, (50, 50, 50), 100).replace('v 150 150 150', 'v 150 nan 150'))
        done = self.run_strake('clash', 'a.obj', *self.SETTINGS, '-o', 'a.json')
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("skipped mesh-face-left-out: a.obj:26: object 'a1' is kept without 3 faces: one uses vertex 15, "
                      'which has no readable place', done.stderr)
        self.assertIn('1 hit, 0 contacts, 0 clearance violations; not compared: all or part of 1 object\n', done.stdout)
        reported = json.loads((self.folder / 'a.json').read_text())
        self.assertEqual(reported['not_compared'], [{'test': 0, 'code': 'object-incomplete',
                                                 'a': {'id': 'a1', 'name': 'a1', 'file': 'a.obj'}}])
        self.assertIn({'code': 'mesh-face-left-out', 'severity': 'skipped', 'count': 1}, reported['diagnostics'])
        self.assertEqual(self.run_strake('clash', 'a.obj', *self.SETTINGS, '--strict').returncode, 4)
        drawn = self.run_strake('draw', 'a.obj', '--view', 'top', '-o', 'a.svg')
        self.assertIn('2 objects: 2 drawn; 1 without some of their geometry', drawn.stderr)

    def test_of_a_file_that_ends_early_the_rest_is_not_compared(self):
        self.write_rvm('cut.rvm', [('/A', (0, 0, 0)), ('/B', (500, 0, 0))], whole=False)
        run = ['clash', 'cut.rvm', '--quiet']
        rest = 'the rest of cut.rvm, which ends early'
        done = self.run_strake(*run, '-o', 'cut.json')
        self.assertEqual((done.returncode, done.stderr), (0, f'strake: nothing is known of {rest}\n'))
        self.assertEqual(done.stdout, f'0 hits, 0 contacts, 0 clearance violations; not compared: {rest}\n')
        reported = json.loads((self.folder / 'cut.json').read_text())
        self.assertEqual(reported['files'], [{'label': 'cut.rvm', 'format': 'RVM 2', 'unit': 'm (stated)',
                                          'ends_early': True}])
        for worst in 'hit', 'contact', 'clearance_violation':
            done = self.run_strake(*run, '--fail-on', worst)
            self.assertEqual(done.returncode, 1)
            self.assertIn(f'--fail-on {worst}: not everything was compared: {rest}\n', done.stderr)
        self.assertEqual(self.run_strake(*run, '--strict').returncode, 4)
        # What is missing is not mended, nor is it new when it comes back.
        self.write_rvm('cut.rvm', [('/A', (0, 0, 0)), ('/B', (500, 0, 0)), ('/C', (540, 0, 0))])
        done = self.run_strake(*run, '--fail-on', 'contact', '-o', 'whole.json')
        self.assertEqual((done.returncode, done.stderr), (1, ''))
        self.assertNotIn('ends_early', (self.folder / 'whole.json').read_text())
        lost = self.run_strake('clash', 'diff', 'whole.json', 'cut.json', '--json')
        self.assertEqual(lost.returncode, 0, lost.stderr)
        self.assertEqual(json.loads(lost.stdout)['counts']['cannot_tell'], 1)

    def test_objects_that_could_not_be_read_whole_are_reported_and_strict_counts_them(self):
        self.write('a.obj', cube('a0', 0, (0, 0, 0), 100) + cube('a1', 1, (50, 50, 50), 100).replace('150', 'nan'))
        run = ['clash', 'a.obj', *self.SETTINGS]
        done = self.run_strake(*run)
        self.assertIn('0 clearance violations; not compared: all or part of 1 object\n', done.stdout)
        # In most models something is: --fail-on would stop every night.
        done = self.run_strake(*run, '--fail-on', 'hit')
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn('--fail-on hit: 1 object could not be fully compared; --fail-on ignores it (add --strict to fail)', done.stderr)
        self.assertEqual(self.run_strake(*run, '--fail-on', 'hit', '--strict').returncode, 4)
        # What is in no set is nobody's concern.
        self.write('b.obj', cube('b0', 0, (50, 0, 0), 100))
        done = self.run_strake('clash', 'a.obj', 'b.obj', *self.SETTINGS, '--a', 'a0', '--b', 'b0')
        self.assertTrue(done.stdout.endswith('1 hit, 0 contacts, 0 clearance violations\n'), done.stdout)

    def test_groups_state_which_options_belong_together(self):
        self.two_files()
        done = self.run_strake('clash', 'a.obj', *self.SETTINGS, '--group-by', 'element')
        self.assertIn('element', done.stdout)
        self.assertIn('1 hit, 0 contacts', done.stdout)
        for wrong, word in ((['--sort', 'size'], '--group-by'), (['--group-contacts'], '--group-by'),
                            (['--group-distance', '2m'], 'proximity'),
                            (['--group-by', 'proximity', '--group-distance', '0.1mm'], 'distance'),
                            (['--group-by', 'colour'], 'colour')):
            with self.subTest(wrong):
                done = self.run_strake('clash', 'a.obj', *wrong)
                self.assertEqual(done.returncode, 2, done.stderr)
                self.assertIn(word, done.stderr)

    def test_the_log_of_pairs_is_the_same_for_any_number_of_threads(self):
        self.two_files()
        arguments = ['clash', 'a.obj', 'b.obj', '--self', '--clearance', '25mm', *self.SETTINGS, '--log-pairs']
        self.assertEqual(self.run_strake(*arguments, 'x.csv', '--threads', 1).returncode, 0)
        expected = (self.folder / 'x.csv').read_bytes()
        rows = list(csv.DictReader(io.StringIO(expected.decode())))
        self.assertEqual([(r['a_id'], r['b_id'], r['class']) for r in rows],
                         [('a0', 'a1', 'HIT'), ('a0', 'b0', 'CLEARANCE_VIOLATION')])
        self.assertTrue(all(int(r['cost']) > 0 for r in rows))
        for threads in 2, 64:
            self.assertEqual(self.run_strake(*arguments, 'y.csv', '--threads', threads).returncode, 0)
            self.assertEqual((self.folder / 'y.csv').read_bytes(), expected)
        done = self.run_strake(*arguments, 'a.obj')
        self.assertEqual(done.returncode, 2, 'a model is never overwritten')
        done = self.run_strake(*arguments, 'z.csv', '-o', 'z.csv')
        self.assertEqual(done.returncode, 2, 'two results in one file')
        self.assertIn("--log-pairs: 'z.csv' is the output of -o already", done.stderr)
        self.assertIn('costly pair', self.run_strake('clash', 'a.obj', '--stats').stderr)

    def test_seams_close_within_the_weld_distance(self):
        self.write('in.obj', cube('in', 0, (40, 40, 40), 20))
        for gap, weld, found in ((.002, [], True), (.002, ['--weld', '0'], False), (.021, [], False),
                                 (.021, ['--weld', '0.021mm'], True), (.021, ['--weld', '0.02mm'], False)):
            with self.subTest(gap=gap, weld=weld):
                self.write('box.obj', box_with_lid_off(gap))
                done = self.run_strake('clash', 'box.obj', 'in.obj', *self.SETTINGS, *weld, '--json',
                                       '--fail-on', 'hit')
                self.assertEqual(done.returncode, 1, 'neither a hit nor what may be one passes')
                report = json.loads(done.stdout)
                welded = [m for m in report['messages'] if m['code'] == 'mesh-welded']
                self.assertEqual([r['class'] for r in report['results']], ['HIT'] if found else [])
                self.assertEqual([n['code'] for n in report.get('not_compared', [])],
                                 [] if found else ['pair-in-open-surface'])
                self.assertEqual(len(welded), 1 if found else 0)
                settings = report['tests'][0]['settings']
                self.assertEqual('weld_mm' in settings, bool(weld))
                if found:
                    self.assertIn(f'{gap * 1000:g} um', welded[0]['message'])
                else:
                    strict = self.run_strake('clash', 'box.obj', 'in.obj', *self.SETTINGS, *weld, '--strict')
                    self.assertEqual(strict.returncode, 4)
                    self.assertIn('not compared: 1 pair', strict.stdout)
        for wrong in ('-1mm', '2m', 'wide'):
            done = self.run_strake('clash', 'box.obj', 'in.obj', *self.SETTINGS, '--weld', wrong)
            self.assertEqual(done.returncode, 2)
            self.assertIn('--weld', done.stderr)


if __name__ == '__main__':
    main()
