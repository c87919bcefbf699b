#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""decisions_test.py STRAKE: decisions about clashes, in a file that one edits and gives to the next run."""
import csv
import io
import json
import os
import re
import subprocess

from scenario import Scenario, cube, main

ROW = [(0, 0, 0), (80, 0, 0), (160, 0, 0), (240, 0, 0)]


def cubes(places):
    """An OBJ file of cubes c0, c1 and so on, 100 mm wide; in a row each is 20 mm in the next."""
    return ''.join(cube(f'c{n}', n, at, 100) for n, at in enumerate(places))


class Decisions(Scenario):
    def setUp(self):
        super().setUp()
        self.write('row.obj', cubes(ROW))

    def clash(self, *arguments, model='row.obj', exit_code=0):
        done = self.run_strake('clash', model, '--unit', 'mm', *arguments)
        self.assertEqual(done.returncode, exit_code, done.stderr)
        return done

    def decide(self, *statuses, name='decided.csv'):
        """Writes the file of a run, with these statuses for its rows in their order."""
        self.clash('--decisions', name, '--write-decisions')
        path = self.folder / name
        lines = path.read_bytes().decode().split('\r\n')
        for number, status in enumerate(statuses, 1):
            lines[number] = lines[number].replace(',new,,,', f',{status},Ann,2026-01-31,as agreed', 1)
        path.write_bytes('\r\n'.join(lines).encode())
        return self.rows(name)

    def rows(self, name='decided.csv'):
        return list(csv.DictReader(io.StringIO((self.folder / name).read_bytes().decode('utf-8-sig'))))

    def reported(self, *arguments, model='row.obj'):
        return json.loads(self.clash('--decisions', 'decided.csv', '--json', *arguments, model=model).stdout)

    def test_from_the_first_run_to_the_next(self):
        rows = self.decide('approved', 'reviewed')
        self.assertEqual([row['status'] for row in rows], ['approved', 'reviewed', 'new'])
        self.assertEqual([(row['a_name'], row['b_name'], float(row['d_mm'])) for row in rows],
                         [('c0', 'c1', -20), ('c1', 'c2', -20), ('c2', 'c3', -20)])
        table = self.clash('--decisions', 'decided.csv').stdout
        self.assertIn('2 hits, 0 contacts, 0 clearance violations, 1 approved\n'
                      'decisions of decided.csv: 1 new, 0 active, 1 reviewed, 1 approved, 0 resolved\n', table)
        self.assertRegex(table, r'(?m)^HIT +reviewed +-20[.]000 .* c1 +c2$')
        self.assertNotRegex(table, r'(?m)^HIT .* c0 +c1$')
        reported = self.reported()
        self.assertEqual([r['decision'] for r in reported['results']],
                         [{'status': 'approved', 'by': 'Ann', 'date': '2026-01-31', 'comment': 'as agreed'},
                          {'status': 'reviewed', 'by': 'Ann', 'date': '2026-01-31', 'comment': 'as agreed'},
                          {'status': 'new'}])
        plain = json.loads(self.clash('--json').stdout)
        self.assertEqual(reported['hash'], plain['hash'], 'decisions change no result')
        self.assertEqual(reported['tests'], plain['tests'])
        before = (self.folder / 'decided.csv').read_bytes()
        self.clash('--decisions', 'decided.csv', '--write-decisions')
        self.assertEqual((self.folder / 'decided.csv').read_bytes(), before)

    def test_approved_ones_stop_nothing_and_are_in_no_group(self):
        self.decide('approved', 'approved', 'approved')
        self.clash('--fail-on', 'hit', exit_code=1)
        self.clash('--fail-on', 'hit', '--decisions', 'decided.csv')
        text = self.clash('--decisions', 'decided.csv', '--group-by', 'element').stdout
        self.assertTrue(text.startswith('0 hits, '), text)
        self.decide('approved', 'approved', 'active', name='other.csv')
        self.clash('--fail-on', 'hit', '--decisions', 'other.csv', exit_code=1)

    def test_what_came_back_is_reported(self):
        self.decide('approved', 'resolved', 'approved')
        self.write('row.obj', cubes([(1.5, 0, 0), *ROW[1:]]))
        done = self.clash('--decisions', 'decided.csv', '--fail-on', 'hit', exit_code=1)
        self.assertRegex(done.stdout, r'(?m)^HIT +deeper +-21[.]500 .* c0 +c1$')
        self.assertRegex(done.stdout, r'(?m)^HIT +found again +-20[.]000 .* c1 +c2$')
        self.assertIn('; approved, but deeper or nearer than they were: 1; resolved, but found again: 1\n', done.stdout)
        self.assertIn('2 hits, ', done.stdout)
        reported = self.reported('--deeper', '2mm')
        self.assertEqual(reported['decisions']['reopened'], {'severer': 0, 'deeper': 0, 'more_places': 0, 'found_again': 1})
        self.assertEqual(reported['decisions']['deeper_mm'], 2)

    def test_what_is_mended_is_listed_and_keeps_its_row(self):
        rows = self.decide('resolved', 'approved')
        self.write('row.obj', cubes([(-50, 0, 0), *ROW[1:3], (245, 0, 0)]))
        reported = self.reported()
        self.assertEqual(reported['decisions']['not_found'],
                         [{'key': rows[0]['key'], 'status': 'resolved', 'by': 'Ann', 'date': '2026-01-31',
                           'comment': 'as agreed'}])
        self.assertIn('; no longer found: 1\n', self.clash('--decisions', 'decided.csv', '--write-decisions').stdout)
        after = self.rows()
        self.assertEqual(after[:2], rows[:2])
        self.assertEqual(float(after[2]['d_mm']), -15, 'nobody had decided about it')

    def test_a_class_limits_what_is_added_and_not_what_is_found(self):
        self.clash('--class', 'contact', '--decisions', 'none.csv', '--write-decisions')
        self.assertEqual(self.rows('none.csv'), [])
        self.decide('approved')
        text = self.clash('--class', 'contact', '--decisions', 'decided.csv').stdout
        self.assertIn('2 hits (2 left out by class), 0 contacts, 0 clearance violations, 1 approved\n', text)
        self.assertNotIn('no longer found', text)

    def test_a_file_that_was_renamed(self):
        rows = self.decide('approved', 'approved')
        (self.folder / 'row.obj').rename(self.folder / 'row_revB.obj')
        done = self.clash('--decisions', 'decided.csv', '--write-decisions', model='row_revB.obj')
        self.assertIn('files are taken as renamed: row.obj -> row_revB.obj (4 of 4 ids in common)\n', done.stderr)
        self.assertIn('1 hit, 0 contacts, 0 clearance violations, 2 approved\n', done.stdout)
        after = self.rows()
        self.assertEqual([row['status'] for row in after], [row['status'] for row in rows])
        self.assertEqual({row[f'{side}_file'] for row in after for side in 'ab'}, {'row_revB.obj'})
        done = self.clash('--decisions', 'decided.csv', model='row_revB.obj')
        self.assertNotIn('renamed', done.stderr)
        self.assertIn(', 2 approved\n', done.stdout)

    def test_a_file_that_somebody_states_was_renamed(self):
        rows = self.decide('approved')
        self.write('own.csv', 'key;status\n' + rows[0]['key'] + ';Approved\n')
        (self.folder / 'row.obj').rename(self.folder / 'n.obj')
        run = ['--decisions', 'own.csv']
        self.assertIn('no longer found: 1', self.clash(*run, model='n.obj').stdout)
        self.assertIn(', 1 approved\n', self.clash(*run, '--match-files', 'row.obj=n.obj', model='n.obj').stdout)
        done = self.clash(*run, '--match-files', 'row.obj=x.obj', model='n.obj', exit_code=2)
        self.assertIn("--match-files: the ", done.stderr)

    def test_the_command_that_reported_a_new_name_goes_on_the_next_night(self):
        self.decide('approved')
        self.write('n.obj', cubes([*ROW, (320, 0, 0)]))
        run = ['--decisions', 'decided.csv', '--match-files', 'row.obj=n.obj', '--write-decisions']
        for again in False, True:
            done = self.clash(*run, model='n.obj')
            self.assertIn(', 1 approved\n', done.stdout)
            self.assertNotIn('no longer found', done.stdout)
            self.assertEqual('--match-files row.obj=n.obj: decided.csv has the new name already' in done.stderr, again)
        self.assertEqual(len(self.rows()), 4)

    def test_a_file_without_files_and_the_night_before_anybody_knew(self):
        rows = self.decide('approved')
        self.write('own.csv', f'key,status\n{rows[0]["key"]},approved\n')
        (self.folder / 'row.obj').rename(self.folder / 'n.obj')
        run = ['--decisions', 'own.csv', '--write-decisions']
        self.assertIn('no longer found: 1', self.clash(*run, model='n.obj').stdout)
        done = self.clash(*run, '--match-files', 'row.obj=n.obj', model='n.obj')
        self.assertIn('files are taken as renamed: row.obj -> n.obj\n', done.stderr, 'there is nothing to compare')
        self.assertIn('1 row without a decision replaced', done.stderr)
        done = self.clash(*run, model='n.obj')
        self.assertIn(', 1 approved\n', done.stdout)
        self.assertNotIn('no longer found', done.stdout)

    def pipes(self, *places):
        """Cubes of one name, so that their ids are positions in the file, in the face of a large one."""
        self.write('pipes.obj', cube('beam', 0, (0, 0, 0), 5000) +
                   ''.join(cube('pipe', n, (x, 4980, 2000), 100) for n, x in enumerate(places, 1)))

    def test_objects_that_come_and_go_where_ids_are_positions(self):
        run = ['--decisions', 'pipes.csv', '--write-decisions']
        self.pipes(200, 500, 800)
        self.clash(*run, model='pipes.obj')
        path = self.folder / 'pipes.csv'
        path.write_bytes(path.read_bytes().replace(b',new,', b',approved,'))
        for places, approved, rows in (((3000, 200, 500, 800), 3, 4), ((3000, 200, 800), 2, 4),
                                       ((200, 500, 800), 3, 3)):
            with self.subTest(places):
                self.pipes(*places)
                for _ in range(2):
                    done = self.clash(*run, model='pipes.obj')
                    self.assertIn(f', {approved} approved\n', done.stdout)
                    self.assertNotIn('have no row', done.stderr)
                self.assertEqual(len(self.rows('pipes.csv')), rows)
        self.pipes(1100, 1400)
        self.assertIn('pipes.csv: 2 results have no row: their keys stand there for another place\n',
                      self.clash(*run, model='pipes.obj').stderr)

    def test_a_contact_that_becomes_a_hit(self):
        self.write('row.obj', cubes([(0, 0, 0), (100, 0, 0)]))
        self.clash('--decisions', 'decided.csv', '--write-decisions')
        path = self.folder / 'decided.csv'
        path.write_bytes(path.read_bytes().replace(b',new,', b',approved,'))
        run = ['--decisions', 'decided.csv', '--fail-on', 'hit', '--deeper', '5mm']
        self.write('row.obj', cubes([(0, 0, 0), (98, 0, 0)]))
        done = self.clash(*run, exit_code=1)
        self.assertRegex(done.stdout, r'(?m)^HIT +severer +-2[.]000 ')
        self.assertIn('; approved, but of a severer class than they were: 1\n', done.stdout)
        path.write_bytes(re.sub(rb',CONTACT,[^,]*,', b',CONTACT,,', path.read_bytes()))
        self.clash(*run, '--write-decisions')
        self.assertEqual(self.rows()[0]['class'], 'HIT', 'it is approved as it is now')
        self.clash(*run)

    def test_contacts_that_are_counted_and_have_a_row(self):
        self.write('row.obj', cubes([(0, 0, 0), (100, 0, 0), (200, 0, 0), (300, 0, 0)]))
        self.decide('approved', 'resolved')
        path = self.folder / 'decided.csv'
        path.write_bytes(b''.join(path.read_bytes().splitlines(keepends=True)[:3]))
        run = ['--decisions', 'decided.csv', '--contacts', 'count']
        done = self.clash(*run)
        self.assertIn('; resolved, but found again: 1\n', done.stdout)
        self.assertIn('(1 not listed)', done.stdout)
        self.assertIn(', 1 approved\n', done.stdout)
        self.assertEqual(len(self.reported('--contacts', 'count')['results']), 2)
        self.write('row.obj', cubes([(0, 0, 0), (100, 0, 0)]))
        self.clash(*run, '--fail-on', 'contact')

    def test_what_a_run_does_not_look_for_is_reported(self):
        self.decide('approved')
        reported = 'decided.csv: 1 clash is approved at places that this run does not count: '
        self.assertNotIn(reported, self.clash('--decisions', 'decided.csv').stderr)
        for option in ('--regions', '0'), ('--narrow-phase', 'sphere-subdivision'):
            self.assertIn(reported, self.clash('--decisions', 'decided.csv', *option).stderr)

    def test_the_hint_counts_what_is_not_approved(self):
        files = []
        for name, y in (('a', 0), ('b', 5000), ('c', 10000), ('d', 15000), ('e', 20000)):
            files.append(self.write(f'{name}.obj', ''.join(cube(f'{name}{n}', n, (60 * n, y, 0), 100) for n in range(6))))
        run = [*files, '--self', '--unit', 'mm', '--up-axis', 'z', '--decisions', 'all.csv', '--write-decisions']
        self.assertIn('25 of 25 hits lie between parts of one assembly: ', self.run_strake('clash', *run).stderr)
        path = self.folder / 'all.csv'
        for approved, hint in ((1, '24 of 24 hits lie '), (5, '20 of 20 hits lie '), (6, None)):
            path.write_bytes(path.read_bytes().replace(b',approved,', b',new,').replace(b',new,', b',approved,', approved))
            done = self.run_strake('clash', *run)
            self.assertIn(f', {approved} approved\n', done.stdout)
            if hint:
                self.assertIn(hint, done.stderr)
            else:
                self.assertNotIn('hits lie ', done.stderr)

    def test_the_forms_of_spreadsheets(self):
        for form, separator in (('standard', ','), ('excel', ','), ('excel-comma', ';')):
            with self.subTest(form):
                run = ['--decisions', f'{form}.csv', '--write-decisions']
                self.clash(*run, '--csv', form)
                data = (self.folder / f'{form}.csv').read_bytes()
                self.assertEqual(data.startswith(b'\xef\xbb\xbf'), form != 'standard')
                self.assertIn(separator.join(('key', 'status', 'by', 'date')).encode(), data)
                self.clash(*run)
                self.assertEqual((self.folder / f'{form}.csv').read_bytes(), data)

    def test_columns_of_others_stay(self):
        rows = self.decide()
        self.write('own.csv', f'Owner,key,status,note\n"A, B",{rows[0]["key"]},active,"say ""no"""\n\n')
        self.clash('--decisions', 'own.csv', '--write-decisions')
        text = (self.folder / 'own.csv').read_text()
        self.assertTrue(text.startswith('Owner,key,status,note,by,date,comment,class,d_mm,'), text)
        self.assertIn(f'\n"A, B",{rows[0]["key"]},active,"say ""no""",', text)
        self.assertEqual([row['status'] for row in self.rows('own.csv') if row['key']], ['active', 'new', 'new'])

    def test_a_link_and_a_mode_stay(self):
        self.decide()
        (self.folder / 'decided.csv').chmod(0o600)
        (self.folder / 'link.csv').symlink_to('decided.csv')
        self.write('row.obj', cubes([*ROW, (320, 0, 0)]))
        self.assertIn('link.csv: 1 row added', self.clash('--decisions', 'link.csv', '--write-decisions').stderr)
        self.assertTrue((self.folder / 'link.csv').is_symlink())
        self.assertEqual(os.stat(self.folder / 'decided.csv').st_mode & 0o777, 0o600)
        self.assertEqual(len(self.rows()), 4)

    def test_a_file_that_somebody_saved_meanwhile_is_left_alone(self):
        """The run has read the file when it opens its first output, a pipe, and waits at its second one until it is another."""
        self.decide()
        self.write('row.obj', cubes([*ROW, (320, 0, 0)]))
        pipes = [self.folder / name for name in ('results.csv', 'pairs.csv')]
        for pipe in pipes:
            os.mkfifo(pipe)
        path = self.folder / 'decided.csv'
        saved = path.read_bytes().replace(b',new,', b',active,', 1)
        before = self.files()
        words = ['clash', 'row.obj', '--unit', 'mm', '--decisions', 'decided.csv', '--write-decisions',
                 '-o', 'results.csv', '--log-pairs', 'pairs.csv']
        with subprocess.Popen([self.STRAKE, *words], cwd=self.folder, stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                              text=True) as run:
            pipes[0].read_bytes()
            path.write_bytes(saved)
            pipes[1].read_bytes()
            _, reported = run.communicate(timeout=100)
        self.assertEqual(run.returncode, 3, reported)
        self.assertIn('decided.csv: was changed while the run went on, and is left as it is (run the test again)', reported)
        self.assertEqual(path.read_bytes(), saved)
        self.assertEqual(self.files(), before)

    def test_what_is_wrong_is_reported_with_its_line(self):
        key = '0' * 26
        for text, reported in ((f'key,status\n{key},done\n', "bad.csv, line 2: 'done' is no status"),
                           (f'key,status,date\n{key},new,30.2.2026\n', "bad.csv, line 2: '30.2.2026' is no date"),
                           (f'key,status\n{key},new\n{key},new\n', 'bad.csv, line 3: the key stands in line 2 already'),
                           ('key,state\n', "bad.csv, line 1: has no column 'status'"), ('', 'bad.csv, line 1: is empty'),
                           ('key,status\nabc,new\n', "bad.csv, line 2: 'abc' is no key")):
            with self.subTest(reported):
                self.write('bad.csv', text)
                done = self.clash('--decisions', 'bad.csv', '--write-decisions', exit_code=3)
                self.assertIn(reported, done.stderr)
                self.assertEqual(done.stdout, '')
                self.assertEqual((self.folder / 'bad.csv').read_text(), text)
        done = self.clash('--decisions', 'missing.csv', exit_code=3)
        self.assertIn('add --write-decisions, which makes it', done.stderr)

    def test_what_does_not_go_together(self):
        self.write('d.csv', 'key,status\n')
        for arguments, reported in ((['--write-decisions'], '--decisions'), (['--deeper', '1mm'], '--decisions'),
                                (['--match-files', 'a=b'], '--decisions'),
                                (['--decisions', 'd.csv', '-o', 'd.csv'], 'would be overwritten'),
                                (['--decisions', 'd.csv', '--deeper', '-1mm'], '--deeper'),
                                (['--decisions', 'd.txt', '--write-decisions'], '--decisions')):
            with self.subTest(arguments=arguments):
                self.assertIn(reported, self.clash(*arguments, exit_code=2).stderr)
        self.assertEqual((self.folder / 'd.csv').read_text(), 'key,status\n')
        self.assertNotIn('d.txt', self.files())


if __name__ == '__main__':
    main()
