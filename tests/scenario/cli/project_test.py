#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""project_test.py STRAKE SCHEMAS: projects made, followed, listed, checked and exported; other verbs take them for files."""
import csv
import json
import sqlite3
import sys
from pathlib import Path

import jsonschema
from scenario import Scenario, cube, main, rvm


class Project(Scenario):
    SCHEMAS = None

    def made(self, *files):
        self.text('project', 'new', 'ship.strake', *files, '--quiet')
        return 'ship.strake'

    def as_json(self, *arguments, schema=None):
        value = json.loads(self.text(*arguments, '--json'))
        if schema:
            jsonschema.validate(value, json.loads((self.SCHEMAS / schema).read_text(encoding='utf-8')))
        return value

    def refused(self, code, *arguments):
        done = self.run_strake(*arguments)
        self.assertEqual(done.returncode, code, done.stderr)
        return done.stderr

    def info(self):
        return self.as_json('project', 'info', 'ship.strake', schema='project-info.schema.json')

    def listed(self, what):
        return self.as_json('project', 'list', 'ship.strake', what, schema='project-list.schema.json')['rows']

    def changes(self, *arguments):
        """The changes that an update tells, by id."""
        reported = self.as_json('project', 'update', 'ship.strake', *arguments, schema='project-changes.schema.json')
        return reported, {change['id']: change['kinds'] for change in reported['changes']}

    def test_a_project_is_made_and_found_sound(self):
        self.two_files()
        self.made('a.obj', 'b.obj')
        info = self.info()
        self.assertEqual([file['label'] for file in info['files']], ['a.obj', 'b.obj'])
        self.assertEqual((info['objects'], info['revisions'], info['tests']), (3, 1, 0))
        self.assertEqual(info['last_revision']['added'], 3)
        self.assertEqual(self.text('project', 'check', 'ship.strake'), 'no faults\n')
        self.assertIn('ship.strake', self.text('project', 'info', 'ship.strake'))
        self.assertNotIn('ship.strake-wal', self.files())

    def test_a_project_that_cannot_be_filled_is_not_left_behind(self):
        self.write('bad.obj', 'nothing\n')
        self.assertIn('bad.obj', self.refused(3, 'project', 'new', 'ship.strake', 'bad.obj'))
        self.assertEqual(self.files(), ['bad.obj'])

    def test_what_is_there_is_not_made_again(self):
        self.two_files()
        self.made('a.obj')
        before = (self.folder / 'ship.strake').read_bytes()
        self.assertIn('ship.strake', self.refused(3, 'project', 'new', 'ship.strake', 'b.obj'))
        self.assertEqual((self.folder / 'ship.strake').read_bytes(), before)
        self.assertIn('is in the project already', self.refused(2, 'project', 'add', 'ship.strake', 'a.obj'))

    def test_files_are_added_and_removed(self):
        self.two_files()
        self.made('a.obj')
        added = self.as_json('project', 'add', 'ship.strake', 'b.obj', schema='project-changes.schema.json')
        self.assertEqual((added['files_added'], added['counts']['added'], added['counts']['unchanged']), (['b.obj'], 1, 2))
        removed = self.as_json('project', 'remove', 'ship.strake', 'a.obj', schema='project-changes.schema.json')
        self.assertEqual((removed['files_removed'], removed['counts']['removed']), (['a.obj'], 2))
        self.assertEqual([row['label'] for row in self.listed('files')], ['b.obj'])
        self.assertEqual([row['what'] for row in self.listed('revisions')], ['remove', 'add', 'add'])
        message = self.refused(2, 'project', 'remove', 'ship.strake', 'c.obj')
        self.assertIn("no file 'c.obj'", message)
        self.assertIn('b.obj', message)

    def test_an_update_reports_what_became_of_objects(self):
        self.write('a.obj', ''.join(cube(f'o{i}', i, (300 * i, 0, 0), 100) for i in range(6)))
        self.made('a.obj')
        reported, kinds = self.changes()
        self.assertEqual((kinds, reported['counts']['unchanged']), ({}, 6))
        self.assertEqual(len(self.listed('revisions')), 1)  # nothing happened
        self.write('a.obj', cube('o0', 0, (0, 0, 0), 100) + cube('o1', 1, (310, 0, 0), 100)
                   + cube('o2', 2, (600, 0, 0), 120) + cube('was3', 3, (900, 0, 0), 100)
                   + cube('o4', 4, (1200, 0, 0), 100) + cube('o9', 5, (5000, 0, 0), 100))
        reported, kinds = self.changes('-o', 'changes.csv', '-o', 'changes.json')
        self.assertEqual(kinds, {'o1': ['moved'], 'o2': ['reshaped'], 'was3': ['renamed'], 'o5': ['removed'],
                                 'o9': ['added']})
        self.assertEqual(reported['counts']['unchanged'], 2)
        self.assertEqual(json.loads((self.folder / 'changes.json').read_text(encoding='utf-8')), reported)
        with open(self.folder / 'changes.csv', encoding='utf-8', newline='') as file:
            self.assertEqual({row['id']: row['change'] for row in csv.DictReader(file)},
                             {name: kind[0] for name, kind in kinds.items()})
        database = sqlite3.connect(f'file:{self.folder}/ship.strake?mode=ro', uri=True)
        self.assertEqual(database.execute('SELECT kind, object FROM changed_object ORDER BY object').fetchall(),
                         [('moved', 'o1'), ('reshaped', 'o2'), ('removed', 'o5'), ('added', 'o9'), ('renamed', 'was3')])
        database.close()
        self.assertEqual(self.text('project', 'check', 'ship.strake'), 'no faults\n')

    def test_what_is_noticed_names_files_as_they_were_given(self):
        def cubes(at):
            return 'mtllib none.mtl\n' + cube('one', 0, (0, 0, 0), 100) + cube('two', 1, (at, 0, 0), 100)

        ways = ('--unit', 'mm', '--up-axis', 'z')
        self.write('a.obj', cubes(90))
        self.made('a.obj', *ways)
        for update in ((), ('a.obj', '--unit', 'mm')):
            with self.subTest(update):
                self.write('a.obj', cubes(80 if update else 70))
                self.text('project', 'update', 'ship.strake', *update)
                self.text('clash', 'ship.strake', '-o', 'p.json')
                self.text('clash', 'a.obj', *ways, '-o', 'f.json')
                self.assertIn(b'obj-material-library-missing', (self.folder / 'f.json').read_bytes())
                self.assertEqual((self.folder / 'p.json').read_bytes(), (self.folder / 'f.json').read_bytes())

    def test_rules_that_state_otherwise_of_a_file_are_refused(self):
        self.two_files()
        self.made('a.obj', 'b.obj', '--unit', 'a.obj=m')
        runs = (('clash', '-p', 'ship.strake', '--rules', 'r.toml'), ('clash', 'ship.strake', '--rules', 'r.toml'))
        for line, read, option in (('unit = "mm"', 'unit m,', '--unit mm'), ('up_axis = "y"', 'z up', '--up-axis y')):
            self.write('r.toml', f'[[file]]\nname = "a.*"\n{line}\n[[test]]\nname = "all"\n')
            for run in runs:
                reported = self.refused(2, *run)
                self.assertIn("'a.obj'", reported)
                self.assertIn(read, reported)
                self.assertIn(f'strake project update ship.strake {self.folder / "a.obj"} {option}', reported)
        self.write('r.toml', '[[file]]\nname = "a.*"\nunit = "m"\nup_axis = "z"\n[[file]]\nname = "c.*"\nunit = "in"\n'
                             '[[test]]\nname = "all"\n')
        for run in runs:
            reported = self.run_strake(*run).stderr
            self.assertNotIn("[[file]] 'a.*'", reported)
            self.assertIn("[[file]] 'c.*': no file of the run has such a name", reported)

    def test_a_renamed_file_takes_the_place_of_what_it_was(self):
        boxes = [(f'/P{i}', (300 * i, 0, 0)) for i in range(8)]
        self.write_rvm('HA.RVM', boxes)
        self.write_rvm('HB.RVM', [(f'/Q{i}', (300 * i, 900, 0)) for i in range(8)])
        self.made('HA.RVM', 'HB.RVM')
        self.write_rvm('HA_revB.RVM', [*boxes[:7], ('/P7', (2105, 0, 0))])
        reported, kinds = self.changes('HA_revB.RVM')
        self.assertEqual(list(kinds.values()), [['moved']])
        self.assertEqual(reported['counts']['unchanged'], 15)
        self.assertEqual([(match['old'], match['new']) for match in reported['files_matched']], [('HA.RVM', 'HA_revB.RVM')])
        self.assertEqual([row['label'] for row in self.listed('files')], ['HA_revB.RVM', 'HB.RVM'])
        self.write_rvm('other.rvm', [(f'/Z{i}', (300 * i, 0, 5000)) for i in range(8)])
        message = self.refused(2, 'project', 'update', 'ship.strake', 'other.rvm')
        self.assertIn('is like no file of the project', message)
        reported, kinds = self.changes('other.rvm', '--match-files', 'HB.RVM=other.rvm')
        self.assertEqual((reported['counts']['added'], reported['counts']['removed']), (8, 8))

    def test_after_an_error_the_project_is_as_it_was(self):
        self.two_files()
        self.made('a.obj', 'b.obj')
        before = self.text('project', 'info', 'ship.strake', '--json')
        self.write('a.obj', cube('a0', 0, (7, 0, 0), 100))
        self.write('b.obj', 'nothing\n')
        self.refused(3, 'project', 'update', 'ship.strake')
        (self.folder / 'b.obj').unlink()
        self.assertIn('b.obj', self.refused(3, 'project', 'update', 'ship.strake'))
        self.assertEqual(json.loads(self.text('project', 'info', 'ship.strake', '--json')), json.loads(before))

    def test_options_of_a_file_are_remembered(self):
        self.write('a.obj', cube('a0', 0, (0, 0, 0), 1))
        self.made('a.obj', '--unit', 'm')
        self.write('a.obj', cube('a0', 0, (1, 0, 0), 1))
        reported, kinds = self.changes()
        self.assertEqual(kinds, {'a0': ['moved']})
        self.assertIn('unit m (given)', self.text('project', 'info', 'ship.strake'))
        self.assertEqual(reported['counts']['moved'], 1)

    def test_results_of_a_project_are_those_of_its_files(self):
        self.text('generate', 'ship', '--objects', 400, '-o', 'ship.glb', '--quiet')
        self.two_files()
        files = ['ship.glb', 'a.obj', 'b.obj']
        self.made(*files)
        for output, line in [('clashes.json', ['clash']), ('clashes.csv', ['clash', '--clearance', '25mm']),
                             ('plan.svg', ['draw', '--view', 'top']), ('view.json', ['draw'])]:
            verb, *options = line
            self.text(verb, *files, *options, '-o', 'files-' + output, '--quiet')
            self.text(verb, 'ship.strake', *options, '-o', 'project-' + output, '--quiet')
            self.assertEqual((self.folder / f'project-{output}').read_bytes(),
                             (self.folder / f'files-{output}').read_bytes(), output)
        self.assertEqual(self.text('info', 'ship.strake', '--json'), self.text('info', *files, '--json'))
        self.assertEqual(self.run_strake('info', 'ship.strake').stderr, self.run_strake('info', *files).stderr)

    def test_projects_and_files_are_one_model(self):
        self.two_files()
        self.made('a.obj')
        joined = self.as_json('clash', 'ship.strake', 'b.obj', '--clearance', '25mm')
        whole = self.as_json('clash', 'a.obj', 'b.obj', '--clearance', '25mm')
        self.assertEqual(joined['results'], whole['results'])
        self.assertTrue(whole['results'])

    def test_files_of_a_project_are_not_read_otherwise(self):
        self.two_files()
        self.made('a.obj')
        for option in (['--unit', 'm'], ['--unit', 'ship.strake=m'], ['--up-axis', 'y']):
            self.assertIn('is a project', self.refused(2, 'clash', 'ship.strake', 'b.obj', *option))
        self.text('clash', 'ship.strake', 'b.obj', '--unit', 'b.obj=m', '--quiet')
        self.assertIn('is a project, no model file', self.refused(2, 'project', 'add', 'ship.strake', 'ship.strake'))

    def test_the_most_used_shapes_come_first(self):
        self.text('generate', 'ship', '--objects', 300, '--kind', 'repeated', '-o', 'ship.glb', '--quiet')
        self.made('ship.glb')
        uses = [row['bodies'] for row in self.listed('shapes')]
        self.assertEqual(uses, sorted(uses, reverse=True))
        self.assertGreater(uses[0], 1)
        text = self.text('project', 'list', 'ship.strake', 'shapes', '--rows', 2)
        self.assertIn('(--rows)', text)
        for what in ('tests', 'runs', 'clashes', 'views'):
            self.assertEqual(self.listed(what), [])

    def test_the_model_is_exported(self):
        (self.folder / 'a.rvm').write_bytes(rvm([('/A', (0, 0, 0)), ('/B', (500, 0, 0))]))
        self.made('a.rvm')
        self.text('project', 'export', 'ship.strake', '-o', 'out.obj', '-o', 'out.glb', '--quiet')
        for name in ('out.obj', 'out.glb'):
            self.assertEqual(self.as_json('info', name)['total']['objects'], 2)
        self.assertIn('.obj', self.refused(2, 'project', 'export', 'ship.strake', '-o', 'out.step'))

    def test_the_decisions_are_exported(self):
        self.two_files()
        self.made('a.obj', 'b.obj')
        self.run_strake('clash', '-p', 'ship.strake', '--clearance', '25mm')
        row, *_ = self.listed('clashes')
        self.text('clash', 'set', row['key'], '-p', 'ship.strake', '--status', 'approved')
        self.text('project', 'export', 'ship.strake', '-o', 'decisions.csv', '-o', 'out.glb', '--quiet')
        self.text('clash', 'list', '-p', 'ship.strake', '-o', 'listed.csv')
        exported = (self.folder / 'decisions.csv').read_text(encoding='utf-8')
        self.assertEqual(exported, (self.folder / 'listed.csv').read_text(encoding='utf-8'))
        self.assertIn('approved', exported)
        self.assertTrue((self.folder / 'out.glb').exists())

    def test_model_files_of_the_project_are_not_written_over(self):
        self.two_files()
        self.made('a.obj')
        before = (self.folder / 'a.obj').read_bytes()
        (self.folder / 'link.obj').symlink_to('a.obj')
        for name in ('a.obj', str(self.folder / 'a.obj'), 'link.obj'):
            reported = self.refused(2, 'project', 'export', 'ship.strake', '-o', name)
            self.assertIn('would be overwritten', reported)
        # A model file is known by what it holds: its name may be that of a result.
        (self.folder / 'a.obj').rename(self.folder / 'a.json')
        self.text('project', 'new', 'other.strake', 'a.json', '--quiet')
        for verb in (['clash'], ['draw'], ['draw', '--save', 'top']):
            reported = self.refused(2, *verb, '-p', 'other.strake', '-o', 'a.json')
            self.assertIn('would be overwritten', reported)
        self.assertEqual((self.folder / 'a.json').read_bytes(), before)

    def test_damage_is_reported_with_its_place(self):
        self.two_files()
        self.made('a.obj', 'b.obj')
        database = sqlite3.connect(self.folder / 'ship.strake')
        database.execute("UPDATE file_block SET data = substr(data, 1, length(data) - 1) WHERE kind = 'objects'")
        database.commit()
        database.close()
        done = self.run_strake('project', 'check', 'ship.strake')
        self.assertEqual(done.returncode, 1, done.stderr)
        self.assertIn('model: ', done.stdout)
        faults = json.loads(self.run_strake('project', 'check', 'ship.strake', '--json').stdout)
        jsonschema.validate(faults, json.loads((self.SCHEMAS / 'project-check.schema.json').read_text(encoding='utf-8')))
        self.assertEqual(faults['faults'][0]['where'], 'model')
        self.refused(3, 'clash', 'ship.strake')

    def test_results_that_do_not_fit_their_rows_are_reported(self):
        self.write('a.obj', ''.join(cube(f'o{i}', i, (90 * i, 0, 0), 100) for i in range(4)))
        self.made('a.obj')
        self.run_strake('clash', '-p', 'ship.strake')
        self.text('draw', '-p', 'ship.strake', '--save', 'top', '--view', 'top', '-o', 'top.svg')
        self.assertEqual(self.text('project', 'check', 'ship.strake'), 'no faults\n')
        sound = (self.folder / 'ship.strake').read_bytes()
        for change, reported in (("UPDATE clash SET a_id = 'x' WHERE id = 1", 'has another key than its objects'),
                             ('DELETE FROM clash WHERE id = 2', 'clash 2 has a result, and is not there'),
                             ('UPDATE clash SET (a_file, a_id, b_file, b_id) = (SELECT a_file, a_id, b_file, b_id '
                              'FROM clash WHERE id = 2) WHERE id = 1', 'is of other objects than its result'),
                             ('UPDATE test SET objects = objects + 1', 'and its row says'),
                             ('UPDATE drawing SET pieces = pieces + 1', "the drawing of the view 'top' is of another size")):
            with self.subTest(change):
                (self.folder / 'ship.strake').write_bytes(sound)
                database = sqlite3.connect(self.folder / 'ship.strake')
                database.execute(change)
                database.commit()
                database.close()
                done = self.run_strake('project', 'check', 'ship.strake')
                self.assertEqual(done.returncode, 1, done.stderr)
                self.assertIn(reported, done.stdout)

    def test_a_second_writer_is_reported_or_waits(self):
        self.two_files()
        self.made('a.obj')
        database = sqlite3.connect(self.folder / 'ship.strake', isolation_level=None)
        database.execute('BEGIN IMMEDIATE')
        self.refused(3, 'project', 'add', 'ship.strake', 'b.obj')
        self.refused(3, 'project', 'add', 'ship.strake', 'b.obj', '--wait', '0.2')
        self.text('info', 'ship.strake', '--quiet')  # readers never wait
        database.execute('ROLLBACK')
        database.close()
        self.text('project', 'add', 'ship.strake', 'b.obj', '--wait', '5', '--quiet')

    def test_wrong_command_lines_are_reported(self):
        self.two_files()
        self.made('a.obj')
        for line, stated in [('project', 'no verb is given'), ('project renew', "has no verb 'renew'"),
                           ('project new', 'FILE is not given'), ('project add ship.strake', 'no model file is given'),
                           ('project list ship.strake things', "'things' is not one of"),
                           ('project list ship.strake files --rows many', 'whole number'),
                           ('project update ship.strake --wait long', 'no number of seconds'),
                           ('project update ship.strake --wait -1', 'no number of seconds'),
                           ('project update ship.strake -o a.txt', '.json'),
                           ('project update ship.strake -o a.txt.json --match-files x', 'OLD=NEW'),
                           ('project remove ship.strake', 'LABEL is not given'),
                           ('project export ship.strake', 'nowhere to export to')]:
            self.assertIn(stated, self.refused(2, *line.split()), line)
        for line in ('project info a.obj', 'project info nowhere.strake', 'project check a.obj'):
            self.assertIn(line.split()[-1], self.refused(3, *line.split()), line)


if __name__ == '__main__':
    Project.SCHEMAS = Path(sys.argv.pop(2)).resolve()
    main()
