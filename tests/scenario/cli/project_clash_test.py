#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""A week of clash tests over a project: what is found, decided, mended and found again."""
import contextlib
import csv
import io
import json
import re
import signal
import sqlite3
import subprocess

from row_project import ROW, RowProject, cubes
from scenario import cube, main


class ProjectClash(RowProject):
    def clash(self, *arguments, exit_code=0):
        return self.done('clash', '-p', 'ship.strake', *arguments, exit_code=exit_code)

    def change(self, places, name='row.obj'):
        self.write(name, cubes(places))
        self.done('project', 'update', 'ship.strake')

    def statuses(self):
        return [clash['status'] for clash in self.listed()]

    def test_a_week(self):
        # Monday: everything is new.
        monday = self.clash('--fail-on', 'hit', exit_code=1)
        self.assertIn('all of 4 objects tested', monday.stderr)
        self.assertEqual(self.statuses(), ['new'] * 3)
        keys = [clash['key'] for clash in self.listed()]
        # Tuesday: nothing changed.
        tuesday = self.clash()
        self.assertIn('nothing changed, 3 results kept', tuesday.stderr)
        self.assertEqual(self.statuses(), ['active'] * 3)
        self.set(keys[0], keys[1], '--status', 'approved', '--comment', 'as agreed', '--by', 'Ann')
        self.set(keys[2], '--assignee', 'Bob')
        self.assertEqual(self.statuses(), ['approved', 'approved', 'active'])
        self.assertIn('1 hit, 0 contacts, 0 clearance violations, 2 approved', self.clash().stdout)
        # Wednesday: one got deeper, and comes back.
        self.change([(1.5, 0, 0), *ROW[1:]])
        wednesday = self.clash('--verify')
        self.assertRegex(wednesday.stderr, r'1 of 4 objects changed, \d+ pairs? tested again, 2 results kept')
        self.assertIn('the same as by a full test', wednesday.stderr)
        self.assertRegex(wednesday.stdout, r'(?m)^HIT +deeper +-21[.]500 .* c0 +c1$')
        self.assertEqual(self.statuses(), ['active', 'approved', 'active'])
        events = json.loads(self.done('clash', 'history', '-p', 'ship.strake', keys[0], '--json').stdout)['events']
        self.assertEqual([(e['who'], e['before'], e['after']) for e in events],
                         [('Ann', 'active', 'approved'), ('strake', 'approved', 'active')])
        # Thursday: one is mended, and an element is missing.
        self.change([(1.5, 0, 0), (80, 500, 0), ROW[2]])
        self.clash('--verify')
        clashes = self.listed()
        self.assertEqual([clash['status'] for clash in clashes], ['resolved', 'resolved', 'active'])
        self.assertIn('is not in the model', clashes[2]['cannot_tell'])
        # Friday: all is as on Monday.
        self.change(ROW)
        self.clash('--verify')
        self.assertEqual(self.statuses(), ['new', 'new', 'active'])
        self.assertEqual([clash['key'] for clash in self.listed()], keys)
        runs = json.loads(self.done('clash', 'history', '-p', 'ship.strake', '--json').stdout)['runs']
        self.assertEqual([run['how'] for run in runs], ['full', 'nothing', 'nothing', 'changes', 'changes', 'changes'])
        self.assertEqual([run['appeared'] for run in runs], [3, 0, 0, 0, 0, 2])
        self.assertEqual([run['gone'] for run in runs], [0, 0, 0, 0, 2, 0])
        self.assertEqual([run['hit'] for run in runs], [3, 3, 3, 3, 0, 3])

    def test_the_result_is_that_of_the_files(self):
        reported = json.loads(self.clash('--json').stdout)
        self.change([(1.5, 0, 0), *ROW[1:]])
        reported = json.loads(self.clash('--json').stdout)
        plain = json.loads(self.done('clash', 'row.obj', '--unit', 'mm', '--json').stdout)
        self.assertEqual(reported['hash'], plain['hash'])
        for result in reported['results']:
            result.pop('decision', None)
        self.assertEqual(reported['results'], plain['results'])
        self.assertEqual(reported['tests'], plain['tests'])

    def test_changes_are_followed_where_no_regions_are_requested(self):
        self.clash('--regions', '0')
        self.change([(-500, 0, 0), *ROW[1:]])
        self.assertIn('the same as by a full test', self.clash('--regions', '0', '--verify').stderr)

    def test_decisions_stop_no_fail_on_and_hold_for_a_renamed_file(self):
        self.clash()
        self.set('--select', '*', '--status', 'approved')
        self.clash('--fail-on', 'hit')
        (self.folder / 'row.obj').rename(self.folder / 'row_revB.obj')
        self.done('project', 'update', 'ship.strake', 'row_revB.obj', '--match-files', 'row.obj=row_revB.obj')
        self.clash('--fail-on', 'hit', '--verify')
        self.assertEqual({(c['status'], c['a_file']) for c in self.listed()}, {('approved', 'row_revB.obj')})

    def test_a_file_gets_the_label_of_one_that_is_no_more(self):
        self.write('early.obj', cube('a0', 0, (-80, 0, 0), 100))
        self.done('project', 'add', 'ship.strake', 'early.obj', '--unit', 'mm')
        self.clash('--self')
        self.done('project', 'remove', 'ship.strake', 'early.obj')
        self.write('early.obj', cubes(ROW) + cube('a0', len(ROW), (-80, 0, 0), 100))
        self.done('project', 'update', 'ship.strake', 'early.obj', '--match-files', 'row.obj=early.obj')
        self.clash('--self', '--verify')
        reported = json.loads(self.clash('--self', '--json').stdout)
        plain = json.loads(self.done('clash', 'early.obj', '--self', '--unit', 'mm', '--json').stdout)
        self.assertEqual(reported['hash'], plain['hash'])

    def test_a_group_is_decided_about_at_once(self):
        self.clash('--group-by', 'element')
        self.set('--group', '1', '--status', 'reviewed')
        self.assertEqual(sorted(self.statuses()).count('reviewed'), 2, 'two clashes share an element')
        self.assertIn('there is no group', self.set('--group', '9', '--status', 'reviewed', exit_code=2).stderr)

    def test_a_number_of_a_group_is_that_of_the_last_run_and_of_its_options(self):
        # Another test of an earlier run has groups too, which no number means.
        self.write('r.toml', '[[test]]\nname = "before"\n')
        self.clash('--rules', 'r.toml')
        self.change([*ROW, (0, 1000, 0), (100, 1000, 0), (0, 2000, 0), (110, 2000, 0)])
        options = ['--group-by', 'files', '--group-contacts', '--class', 'contact']
        self.clash('--clearance', '25mm', *options)
        self.set('--group', '1', *options, '--status', 'reviewed')
        reviewed = [clash for clash in self.listed() if clash['status'] == 'reviewed']
        self.assertEqual({(clash['test'], clash['class']) for clash in reviewed}, {('', 'CONTACT')})
        self.set('--group', '2', *options, '--status', 'reviewed', exit_code=2)
        self.set(reviewed[0]['key'], '--class', 'hit', '--status', 'active', exit_code=2)

    def test_what_was_stated_is_taken_back(self):
        self.clash()
        key = self.listed()[0]['key']
        self.set(key, '--comment', 'soon', '--assignee', 'Bob')
        self.set(key, '--comment', '', '--assignee', '')
        clash = self.listed()[0]
        self.assertEqual((clash['comment'], clash['assignee']), (None, None))

    def test_the_table_shows_tests_and_what_cannot_be_decided(self):
        self.clash()
        table = self.done('clash', 'list', '-p', 'ship.strake').stdout
        self.assertNotRegex(table.splitlines()[0], 'test|cannot_tell')
        self.write('r.toml', '[[test]]\nname = "all"\n')
        self.change(ROW[:3])
        self.clash()
        self.clash('--rules', 'r.toml')
        table = self.done('clash', 'list', '-p', 'ship.strake').stdout
        self.assertRegex(table.splitlines()[0], 'test.*cannot_tell')
        self.assertIn('is not in the model', table)
        done = self.done('clash', 'list', '-p', 'ship.strake', '--test', 'nope', exit_code=2)
        self.assertIn("there are '', 'all'", done.stderr)
        self.assertEqual({clash['test'] for clash in self.listed('--test', '')}, {''})

    def test_what_cannot_be_decided_stays_so(self):
        self.change([(0, 0, 0), (120, 0, 0)])
        self.clash('--clearance', '25mm')
        for _ in range(3):
            self.clash()
            clash, = self.listed()
            self.assertEqual((clash['status'], clash['cannot_tell']),
                             ('active', 'the test does not reach as far as it did'))

    def test_the_list_is_a_file_of_decisions(self):
        self.clash()
        key = self.listed()[0]['key']
        self.set(key, '--status', 'approved', '--by', 'Ann', '--comment', '=1+1')
        self.done('clash', 'list', '-p', 'ship.strake', '-o', 'decided.csv')
        rows = list(csv.DictReader(io.StringIO((self.folder / 'decided.csv').read_text(encoding='utf-8'))))
        self.assertEqual(rows[0]['status'], 'approved')
        done = self.done('clash', 'row.obj', '--unit', 'mm', '--decisions', 'decided.csv')
        self.assertIn('2 hits, 0 contacts, 0 clearance violations, 1 approved', done.stdout)

    def test_a_run_that_cannot_be_decided_is_not_remembered(self):
        (self.folder / 'full').mkdir()
        self.done('clash', '-p', 'ship.strake', '-o', 'full', exit_code=2)
        self.assertEqual(self.listed(), [])
        self.clash()
        before = self.statuses()
        self.set('0' * 26, '--status', 'approved', exit_code=2)
        self.assertEqual(self.statuses(), before)

    def other_writer(self):
        return contextlib.closing(sqlite3.connect(self.folder / 'ship.strake', isolation_level=None))

    def changed_meanwhile(self, other, seal):
        """Runs a test, during which the model gets this seal if the run can be stopped in time: its exit code and messages."""
        with subprocess.Popen([self.STRAKE, 'clash', '-p', 'ship.strake'], cwd=self.folder,
                              stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True) as run:
            run.stderr.readline()  # what was read is told as soon as it is
            run.send_signal(signal.SIGSTOP)
            try:
                other.execute('UPDATE model_seal SET files = ?', (seal,))
            except sqlite3.OperationalError:
                pass  # it writes already
            run.send_signal(signal.SIGCONT)
            reported = run.stderr.read()
        return run.returncode, reported

    def test_a_model_that_changed_meanwhile_is_not_remembered(self):
        self.change([(n % 100 * 200, n // 100 * 200, 0) for n in range(5000)])
        with self.other_writer() as other:
            seal, = other.execute('SELECT files FROM model_seal').fetchone()
            for runs in range(20):
                exit_code, reported = self.changed_meanwhile(other, bytes(16))
                if exit_code != 0:
                    break
                other.execute('UPDATE model_seal SET files = ?', (seal,))
            self.assertEqual(exit_code, 3, reported)
            self.assertIn('changed meanwhile', reported)
            self.assertEqual(other.execute('SELECT count(*) FROM run').fetchone(), (runs,))

    def test_who_pages_through_the_result_keeps_nobody_from_writing(self):
        # Far more than a pipe holds: the run writes until somebody reads on.
        self.change([(n * 80, 0, 0) for n in range(400)])
        with subprocess.Popen([self.STRAKE, 'clash', '-p', 'ship.strake', '--json'], cwd=self.folder,
                              stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True) as run:
            self.assertEqual(run.stdout.read(1), '{')
            self.set('--select', 'c0', '--status', 'approved')
            self.assertIsNone(run.poll(), 'it waits for its reader')
            run.stdout.read()
        self.assertEqual(run.returncode, 0)
        self.assertEqual(self.statuses().count('approved'), 1)

    def test_rules_that_change_test_everything_and_tests_have_names(self):
        self.write('r.toml', '[[test]]\nname = "all"\n')
        self.assertIn("test 'all': all of 4 objects tested", self.clash('--rules', 'r.toml').stderr)
        self.assertIn("test 'all': nothing changed", self.clash('--rules', 'r.toml').stderr)
        self.write('r.toml', '[[test]]\nname = "all"\nclearance = "25mm"\n')
        self.assertIn("test 'all': all of 4 objects tested", self.clash('--rules', 'r.toml').stderr)
        self.assertEqual({clash['test'] for clash in self.listed()}, {'all'})
        self.assertEqual(len(self.listed('--test', 'all', '--status', 'active')), 3)
        self.assertIn('all of 4 objects', self.clash('--rules', 'r.toml', '--full').stderr)

    def test_what_makes_no_sense(self):
        for wrong in (['-p', 'ship.strake', 'row.obj'], ['row.obj', '--full'], ['row.obj', '--verify'],
                      ['-p', 'ship.strake', '--decisions', 'x.csv'], ['row.obj', '--deeper', '2mm']):
            self.done('clash', *wrong, exit_code=2)
        for wrong in ([], ['--status', 'approved'], ['--select', '*'], ['a', '--select', '*', '--status', 'new']):
            self.set(*wrong, exit_code=2)

    def test_help_names_the_keys_as_results_do(self):
        key = re.search(r'"key": "([^"]+)"', self.clash('--json').stdout)
        self.assertEqual(key.group(1), self.listed()[0]['key'])


if __name__ == '__main__':
    main()
