#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""project_diff_test.py STRAKE SCHEMAS: runs and drawings of projects compared, and groups that stay what they were."""
import contextlib
import json
import sqlite3
import sys
from pathlib import Path

import jsonschema

from row_project import ROW, RowProject, cubes
from scenario import cube, main

SCHEMAS = None


class Projects(RowProject):
    def refused(self, stated, *arguments):
        done = self.done(*arguments, exit_code=2)
        self.assertIn(stated, done.stderr)

    def night(self, places=None, *options):
        if places is not None:
            self.write('row.obj', cubes(places))
            self.done('project', 'update', 'ship.strake')
        return self.done('clash', '-p', 'ship.strake', *options)

    def keys(self):
        return [clash['key'] for clash in self.listed()]

    def diff(self, *arguments, verb='clash'):
        reported = json.loads(self.done(verb, 'diff', *arguments, '--json').stdout)
        schema = json.loads((SCHEMAS / f'{"clash" if verb == "clash" else "view"}-diff.schema.json').read_text())
        jsonschema.validate(reported, schema)
        return reported

    def pairs(self, reported, which):
        return {f'{entry["a"]["name"]} {entry["b"]["name"]}' for entry in reported[which]}


class Runs(Projects):
    def test_the_last_two_runs_are_compared_by_what_they_stated(self):
        self.night()
        # The first got deeper, the second parted, of the third an object is missing; two are new.
        self.night([(5, 0, 0), (80, 0, 0), (500, 0, 0), None, (0, 50, 0)])
        reported = self.diff('ship.strake')
        self.assertEqual(reported['counts'], {'new': 2, 'changed': 1, 'same': 0, 'gone': 1, 'cannot_tell': 1})
        self.assertEqual(self.pairs(reported, 'changed'), {'c0 c1'})
        self.assertEqual((reported['changed'][0]['d_mm'], reported['changed'][0]['was']['d_mm']), (-25, -20))
        self.assertEqual(self.pairs(reported, 'gone'), {'c1 c2'})
        self.assertEqual(self.pairs(reported, 'cannot_tell'), {'c2 c3'})
        self.assertEqual(reported['cannot_tell'][0]['why'], "'c3' is not in the model")
        self.assertEqual(self.pairs(reported, 'added'), {'c0 c4', 'c1 c4'})
        self.assertEqual((reported['old']['file'], reported['new']['file']), ('ship.strake, run 1', 'ship.strake, run 2'))
        # It tells what the run told.
        trend, = [run for run in json.loads(self.done('clash', 'history', '-p', 'ship.strake', '--json').stdout)['runs']
                  if run['run'] == 2]
        self.assertEqual((trend['appeared'], trend['gone'], trend['cannot_tell']), (2, 1, 1))
        self.assertEqual(self.diff('-p', 'ship.strake'), reported)
        self.done('clash', 'diff', 'ship.strake', '--fail-on', 'new-hit', exit_code=1)
        self.assertIn('2 new, 1 changed, 0 unchanged, 1 gone, 1 cannot tell', self.done('clash', 'diff', 'ship.strake').stdout)

    def test_any_two_runs_are_compared(self):
        self.night()
        self.night()
        self.night([(0, 0, 0), (80, 500, 0), *ROW[2:]])
        self.night(ROW)
        self.night([(2, 0, 0), *ROW[1:]])
        self.assertEqual(self.diff('ship.strake', '--runs', '1', '2')['counts']['same'], 3)
        self.assertEqual(self.diff('ship.strake', '--runs', '1', '3')['counts'],
                         {'new': 0, 'changed': 0, 'same': 1, 'gone': 2, 'cannot_tell': 0})
        self.assertEqual(self.diff('ship.strake', '--runs', '3', '4')['counts'],
                         {'new': 2, 'changed': 0, 'same': 1, 'gone': 0, 'cannot_tell': 0})
        self.assertEqual(self.diff('ship.strake', '--runs', '1', '4')['counts']['same'], 3)
        reported = self.diff('ship.strake', '--runs', '1', '5')
        self.assertEqual([(e['d_mm'], e['was']['d_mm']) for e in reported['changed']], [(-22, -20)])
        self.refused('there is no run 9', 'clash', 'diff', 'ship.strake', '--runs', '1', '9')
        self.refused('the earlier run comes first', 'clash', 'diff', 'ship.strake', '--runs', '4', '3')

    def test_it_is_what_the_files_of_the_runs_state(self):
        """Whatever happens: of the same two results the comparison of files tells the same, but for the words of reasons."""
        nights = [ROW, [(5, 0, 0), (80, 0, 0), (500, 0, 0), None, (0, 50, 0)], [*ROW[:3], (240, 5, 0), (100, 70, 0)],
                  [None, *ROW[1:]], ROW]
        for n, places in enumerate(nights):
            self.night(places, '--clearance', '25mm', '-o', f'{n + 1}.json')
        for older in range(1, len(nights)):
            for newer in range(older + 1, len(nights) + 1):
                with self.subTest((older, newer)):
                    runs = self.diff('ship.strake', '--runs', str(older), str(newer))
                    files = self.diff(f'{older}.json', f'{newer}.json')
                    for which in ('added', 'changed', 'same', 'gone', 'cannot_tell'):
                        self.assertEqual([(e['key'], e['class'], e['d_mm']) for e in runs[which]],
                                         [(e['key'], e['class'], e['d_mm']) for e in files[which]], which)
                    self.assertEqual(runs['old']['hash'], files['old']['hash'])
                    self.assertEqual(runs['new']['hash'], files['new']['hash'])

    def test_what_a_rule_came_to_allow_is_gone_and_reports_it(self):
        self.write('r.toml', '[[test]]\nname = "all"\n')
        self.night(None, '--rules', 'r.toml')
        self.write('r.toml', '[[test]]\nname = "all"\n[[allowed]]\nname = "first"\na = "c0"\nb = "c1"\nmax_depth = "30mm"\n')
        self.night(None, '--rules', 'r.toml')
        reported = self.diff('ship.strake')
        self.assertEqual([(e['a']['name'], e['why']) for e in reported['gone']], [('c0', "allowed by rule 'first'")])
        self.assertIn('rules file r.toml is not what it was', self.done('clash', 'diff', 'ship.strake').stdout)
        self.write('r.toml', '[[test]]\nname = "all"\nclearance = "25mm"\n')
        self.night(None, '--rules', 'r.toml')
        reported = self.diff('ship.strake')
        self.assertEqual([(e['a']['name'], e['why']) for e in reported['added']], [('c0', "allowed by rule 'first'")])
        self.assertEqual([change['test'] for change in reported['settings_changed']], ['all'])

    def test_what_has_no_rows_is_compared_by_its_number(self):
        """Contacts that are only counted, and results that a rule allows all along."""
        self.write('all.toml', '[[test]]\nname = "all"\n[[allowed]]\nname = "built"\na = "c0"\nb = "*"\nmax_depth = "30mm"\n')
        self.night(None, '--rules', 'all.toml', '--contacts', 'count')
        # The first comes away from the second; the third and the fourth now touch.
        self.night([(0, 500, 0), (80, 0, 0), (160, 0, 0), (260, 0, 0)], '--rules', 'all.toml', '--contacts', 'count')
        done = self.done('clash', 'diff', 'ship.strake')
        self.assertIn("test 'all': counted: 2 -> 1 hits, 0 -> 1 contacts, 0 -> 0 clearance violations, "
                      '1 -> 0 allowed by rules', done.stderr)
        self.assertNotIn('c0', done.stdout)

    def test_tests_have_runs_of_their_own(self):
        self.write('two.toml', '[[test]]\nname = "one"\n[[test]]\nname = "two"\na = "c0"\nb = "c1"\n')
        self.night(None, '--rules', 'two.toml')
        self.night([(5, 0, 0), *ROW[1:]], '--clearance', '5mm')
        self.refused('no two runs of the same test', 'clash', 'diff', 'ship.strake')
        self.night(None, '--rules', 'two.toml')
        reported = self.diff('ship.strake')
        self.assertEqual((reported['old']['file'], reported['new']['file']), ('ship.strake, run 1', 'ship.strake, run 3'))
        self.assertEqual({entry['test'] for entry in reported['changed']}, {'one', 'two'})
        reported = self.diff('ship.strake', '--test', 'two')
        self.assertEqual([entry['test'] for entry in reported['changed']], ['two'])
        self.refused("there are 'one', 'two', ''", 'clash', 'diff', 'ship.strake', '--test', 'three')
        self.refused("run 2 did not run test 'two'", 'clash', 'diff', 'ship.strake', '--test', 'two', '--runs', '2', '3')
        self.assertEqual(self.diff('ship.strake', '--runs', '1', '2')['tests_gone'], ['one', 'two'])

    def test_results_of_a_test_that_came_or_went_are_reported(self):
        for name, tests in (('one.toml', ['one']), ('two.toml', ['one', 'two'])):
            self.write(name, ''.join(f'[[test]]\nname = "{test}"\n' for test in tests))
        for rules in ('one.toml', 'two.toml', 'one.toml'):
            self.night(None, '--rules', rules)
        came = self.diff('ship.strake', '--runs', '1', '2')
        self.assertEqual((came['tests_added'], {(e['test'], e['why']) for e in came['added']}), (['two'], {('two', "there is no test 'two'")}))
        self.assertEqual(len(came['added']), 3)
        self.done('clash', 'diff', 'ship.strake', '--runs', '1', '2', '--fail-on', 'new', exit_code=1)
        went = self.diff('--runs', '2', '3', 'ship.strake')
        self.assertEqual((went['tests_gone'], went['gone'], len(went['cannot_tell'])), (['two'], [], 3))
        self.refused('two runs', 'clash', 'diff', 'ship.strake', '--runs', '1', '2', '--runs', '2', '3')

    def test_runs_of_an_earlier_version_are_refused(self):
        self.night()
        self.night()
        with contextlib.closing(sqlite3.connect(self.folder / 'ship.strake')) as project:
            project.executescript('DELETE FROM run_report WHERE run = 1; DELETE FROM run_result WHERE run = 1')
        self.refused('an earlier version', 'clash', 'diff', 'ship.strake', '--runs', '1', '2')
        self.refused('no two runs that can be compared', 'clash', 'diff', 'ship.strake')
        self.night()
        self.assertEqual(self.diff('ship.strake')['counts']['same'], 3)


class LastRuns(Projects):
    def test_a_project_stands_for_its_last_run(self):
        self.night(None, '-o', 'monday.json')
        self.night([(5, 0, 0), *ROW[1:]], '-o', 'tuesday.json')
        files = self.diff('monday.json', 'tuesday.json')
        for arguments in (['monday.json', 'ship.strake'], ['monday.json', '-p', 'ship.strake']):
            reported = self.diff(*arguments)
            self.assertEqual(reported['new'].pop('file'), 'ship.strake')
            self.assertEqual(reported, {**files, 'new': {k: v for k, v in files['new'].items() if k != 'file'}})
        # What became of the model since the run does not matter.
        self.write('row.obj', cubes([(700, 0, 0), None, (900, 0, 0)]))
        self.done('project', 'update', 'ship.strake')
        self.assertEqual(self.diff('monday.json', 'ship.strake')['counts'], files['counts'])
        # Two projects, of the same file and of one with another name.
        self.write('late.obj', cubes([(0, 0, 0), (80, 0, 0), None, (240, 0, 0)]))
        self.done('project', 'new', 'late.strake', 'late.obj', '--unit', 'mm')
        self.done('clash', '-p', 'late.strake')
        reported = self.diff('ship.strake', 'late.strake', '--match-files', 'row.obj=late.obj')
        self.assertEqual(reported['counts'], {'new': 0, 'changed': 1, 'same': 0, 'gone': 0, 'cannot_tell': 2})

    def test_a_file_that_was_renamed_is_called_as_today(self):
        self.night(None, '-o', 'monday.json')
        (self.folder / 'row.obj').rename(self.folder / 'row_revB.obj')
        self.done('project', 'update', 'ship.strake', 'row_revB.obj', '--match-files', 'row.obj=row_revB.obj')
        reported = self.diff('monday.json', 'ship.strake')
        self.assertEqual(reported['counts']['same'], 3)
        self.assertEqual({entry['a']['file'] for entry in reported['same']}, {'row_revB.obj'})

    def test_one_test_of_several(self):
        self.write('two.toml', '[[test]]\nname = "one"\n[[test]]\nname = "two"\na = "c0"\nb = "c1"\n')
        self.night(None, '--rules', 'two.toml', '-o', 'both.json')
        self.assertEqual(self.diff('both.json', 'ship.strake')['counts']['same'], 4)
        self.assertEqual(self.diff('both.json', 'ship.strake', '--test', 'two')['tests_gone'], ['one'])
        self.night()
        self.assertEqual(self.diff('both.json', 'ship.strake')['tests_added'], [''])
        self.assertEqual(self.diff('ship.strake', 'both.json', '--test', 'one')['counts']['same'], 3)

    def test_what_makes_no_sense(self):
        self.refused('has no result', 'clash', 'diff', 'ship.strake', 'ship.strake')
        self.refused('no two runs', 'clash', 'diff', 'ship.strake')
        self.night(None, '-o', 'monday.json')
        self.refused('NEW is not given', 'clash', 'diff', 'monday.json')
        self.refused('two files to compare already', 'clash', 'diff', 'monday.json', 'monday.json', '-p', 'ship.strake')
        self.refused('neither of the two is a project', 'clash', 'diff', 'monday.json', 'monday.json', '--test', '')
        self.refused('only runs of one project', 'clash', 'diff', 'monday.json', 'ship.strake', '--runs', '1', '2')
        self.refused('follows its files itself', 'clash', 'diff', 'ship.strake', '--match-files', 'a=b')
        self.refused("no test is called 'x'", 'clash', 'diff', 'monday.json', 'ship.strake', '--test', 'x')


class Drawings(Projects):
    def draw(self, *options, project='ship.strake'):
        return self.done('draw', '-p', project, *options, '-o', 'x.svg')

    def change(self, places):
        self.write('row.obj', cubes(places))
        self.done('project', 'update', 'ship.strake')

    def unnamed(self, reported):
        for run in ('before', 'after'):
            reported[run].pop('file', None)
        return reported

    def test_what_a_change_does_to_a_view(self):
        self.draw('--save', 'deck', '--view', 'top')
        before = (self.folder / 'ship.strake').read_bytes()
        self.diff('ship.strake', '--view', 'deck', verb='draw')
        self.done('draw', 'diff', 'ship.strake', '--view', 'deck', '--fail-on', 'any')
        self.done('draw', '-p', 'ship.strake', '--stored', 'deck', '-o', 'monday.json')
        # One moves, one comes and one goes: what is gone is reported by its name of then.
        self.change([(0, 0, 0), (80, 5, 0), (160, 0, 0), None, (400, 0, 0)])
        self.done('draw', 'diff', 'ship.strake', '--view', 'deck', '--fail-on', 'visible', '-o', 'changes.svg', exit_code=1)
        self.assertIn('<svg', (self.folder / 'changes.svg').read_text())
        reported = self.diff('-p', 'ship.strake', '--view', 'deck', verb='draw')
        self.assertIn('c3', json.dumps(reported))
        # It stores nothing: it says the same again, and the drawing of today is the one to come.
        self.assertEqual(self.diff('ship.strake', verb='draw'), reported)
        self.done('draw', 'row.obj', '--unit', 'mm', '--view', 'top', '-o', 'tuesday.json')
        files = self.diff('monday.json', 'tuesday.json', verb='draw')
        self.assertEqual(self.unnamed(reported), self.unnamed(files))
        self.draw('--stored', 'deck')
        reported = self.diff('monday.json', 'ship.strake', verb='draw')
        self.assertEqual(self.unnamed(reported), self.unnamed(files))
        self.assertNotEqual((self.folder / 'ship.strake').read_bytes(), before)

    def test_stored_views_of_two_projects(self):
        self.draw('--save', 'deck', '--view', 'top')
        self.write('row.obj', cubes([(0, 0, 0), (80, 5, 0), *ROW[2:]]))
        self.done('project', 'new', 'late.strake', 'row.obj', '--unit', 'mm')
        self.refused('has no view', 'draw', 'diff', 'ship.strake', 'late.strake')
        self.draw('--save', 'deck', '--view', 'top', project='late.strake')
        self.draw('--save', 'front', '--view', 'front', project='late.strake')
        self.refused("there are 'deck', 'front'", 'draw', 'diff', 'ship.strake', 'late.strake')
        self.done('draw', 'diff', 'ship.strake', 'late.strake', '--view', 'deck', '--fail-on', 'visible', exit_code=1)
        self.refused("has no view 'front'", 'draw', 'diff', 'ship.strake', 'late.strake', '--view', 'front')
        self.refused('NEW is not given', 'draw', 'diff', 'x.svg')
        self.refused('neither of the two is a project', 'draw', 'diff', 'x.svg', 'x.svg', '--view', 'deck')

    def test_a_drawing_of_an_earlier_version_is_refused_and_drawn_again(self):
        self.draw('--save', 'deck', '--view', 'top')
        with contextlib.closing(sqlite3.connect(self.folder / 'ship.strake')) as project:
            project.executescript('DELETE FROM drawing_objects')
        self.refused('with the names of its objects', 'draw', 'diff', 'ship.strake')
        self.draw('--stored', 'deck')
        self.done('draw', 'diff', 'ship.strake', '--fail-on', 'any')


class Groups(Projects):
    """Three groups by element: c1 with two clashes, c4 and c6 with one each."""
    PLACES = [*ROW[:3], (1000, 0, 0), (1085, 0, 0), (2000, 0, 0), (2090, 0, 0)]

    def group_keys(self, *options):
        keys = {}
        for clash in self.listed(*options):
            if clash['group'] is not None:
                keys.setdefault(clash['group'], set()).add(clash['group_key'])
        return {number: of_number.pop() for number, of_number in keys.items()}

    def status_of(self, name):
        return {clash['status'] for clash in self.listed() if name in (clash['a_name'], clash['b_name'])}

    def test_numbers_are_those_of_the_report_after_an_approval_too(self):
        self.night(self.PLACES, '--group-by', 'element')
        keys = self.group_keys('--groups')
        self.assertEqual(set(keys), {1, 2, 3})
        self.assertEqual(len(set(keys.values())), 3)
        self.set('--group', '1', '--status', 'approved')
        self.assertEqual(self.group_keys('--groups'), keys, 'what is approved since is in its group')
        reported = self.set('--group', '2', '--status', 'reviewed').stderr
        self.assertIn(f'key {keys[2]}', reported)
        self.assertEqual((self.status_of('c1'), self.status_of('c4'), self.status_of('c6')),
                         ({'approved'}, {'reviewed'}, {'new'}))
        # An approval that is taken back is one of a clash that the report had in its group.
        self.set('--group', '1', '--status', 'active')
        self.set('--group', '3', '--status', 'approved')
        self.assertEqual((self.status_of('c1'), self.status_of('c6')), ({'active'}, {'approved'}))

    def test_a_key_never_means_other_clashes(self):
        self.night(self.PLACES, '--group-by', 'element')
        keys = self.group_keys('--groups')
        self.set('--group', keys[1], '--status', 'approved')
        # In the next report the approved ones are in no group: numbers are others, keys are not.
        self.night(None, '--group-by', 'element')
        self.assertEqual(self.group_keys('--groups'), {1: keys[2], 2: keys[3]})
        self.set('--group', keys[1], '--status', 'active', exit_code=2)
        self.set('--group', keys[3], '--status', 'reviewed')
        self.assertEqual((self.status_of('c4'), self.status_of('c6')), ({'active'}, {'reviewed'}))
        # A group that has one clash more is another one.
        self.night([*self.PLACES, (1085, 90, 0)])
        self.refused(f"there is no group '{keys[2]}'", 'clash', 'set', '-p', 'ship.strake', '--group', keys[2], '--status', 'active')

    def test_groups_are_by_what_the_run_grouped_by(self):
        self.night(self.PLACES, '--group-by', 'proximity', '--group-distance', '10m')
        self.assertEqual(set(self.group_keys('--groups')), {1})
        self.assertEqual(set(self.group_keys('--group-by', 'element')), {1, 2, 3})
        self.set('--group', '1', '--status', 'reviewed')
        self.assertEqual({clash['status'] for clash in self.listed()}, {'reviewed'})
        self.night(self.PLACES)
        self.assertEqual(set(self.group_keys('--groups')), {1, 2, 3}, 'by element where the run did not group')

    def test_a_model_that_changed_has_no_groups(self):
        self.night(self.PLACES)
        self.write('row.obj', cubes([*self.PLACES[:-1], None, (2090, 0, 0)]))
        self.done('project', 'update', 'ship.strake')
        self.refused('the model changed', 'clash', 'list', '-p', 'ship.strake', '--groups')

    def test_lists_are_as_documented(self):
        self.night(self.PLACES)
        schema = json.loads((SCHEMAS / 'clash-list.schema.json').read_text())
        for options in ([], ['--groups']):
            jsonschema.validate(json.loads(self.done('clash', 'list', '-p', 'ship.strake', '--json', *options).stdout), schema)
        self.assertNotIn('group', self.listed()[0])
        self.assertIn('group_key', self.done('clash', 'list', '-p', 'ship.strake', '--groups').stdout.splitlines()[0])


class LifeCycle(Projects):
    def hull(self, there, is_open):
        """A cube of a metre, with or without its upper half of faces, and a small one within."""
        lines = cube('hull', 0, (0, 0, 0), 1000).splitlines()
        if is_open:
            lines = lines[:-4]
        inner = cube('inner', 1 if there else 0, (400, 400, 400), 100)
        self.write('row.obj', ('\n'.join(lines) + '\n' if there else '') + inner)
        self.done('project', 'update', 'ship.strake')
        self.night()
        return [(clash['status'], clash['cannot_tell']) for clash in self.listed() if 'hull' in (clash['a_name'], clash['b_name'])]

    def test_a_mesh_that_was_gone_and_comes_back_open_is_not_mended(self):
        self.assertEqual(self.hull(True, False), [('new', None)])
        self.assertEqual(self.hull(False, False), [('active', "'hull' is not in the model")])
        for _ in range(2):
            (status, why), = self.hull(True, True)
            self.assertEqual(status, 'active')
            self.assertIn("'hull' has surfaces that enclose nothing", why)
        self.assertEqual(self.hull(True, False), [('active', None)])

    def test_an_approved_violation_that_closes_to_a_counted_contact_comes_back(self):
        options = ['--clearance', '25mm', '--contacts', 'count']
        self.night([(0, 0, 0), (110, 0, 0)], *options)
        self.set(*self.keys(), '--status', 'approved')
        self.night([(0, 0, 0), (100, 0, 0)], *options)
        clash, = self.listed()
        self.assertEqual((clash['status'], clash['class'], clash['cannot_tell']), ('active', 'CONTACT', None))
        self.assertEqual([e['class'] for e in self.diff('ship.strake')['changed']], ['CONTACT'])
        self.night([(0, 0, 0), (300, 0, 0)], *options)
        self.assertEqual(self.listed()[0]['status'], 'resolved')


if __name__ == '__main__':
    SCHEMAS = Path(sys.argv.pop(2)).resolve()
    main()
