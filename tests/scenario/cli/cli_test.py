#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Runs the program as a user does: exit codes, what goes where, what is left behind."""
import csv
import io
import json
import os
import pty
import select
import signal
import subprocess
import sys
import tempfile
import time
import unittest
from pathlib import Path

STRAKE = None  # the program, first argument of this script

CUBE_FACES = [(1, 4, 3, 2), (5, 6, 7, 8), (1, 2, 6, 5), (2, 3, 7, 6), (3, 4, 8, 7), (4, 1, 5, 8)]


def cube(name, number, at, size):
    """An OBJ object: a cube with its lower corner at `at`."""
    x, y, z = at
    lines = [f'o {name}']
    lines += [f'v {x + dx * size} {y + dy * size} {z + dz * size}'
              for dz in (0, 1) for dx, dy in ((0, 0), (1, 0), (1, 1), (0, 1))]
    lines += ['f ' + ' '.join(str(corner + 8 * number) for corner in face) for face in CUBE_FACES]
    return '\n'.join(lines) + '\n'


class Scenario(unittest.TestCase):
    def setUp(self):
        self.keep = tempfile.TemporaryDirectory(prefix='strake-cli-')
        self.folder = Path(self.keep.name)

    def tearDown(self):
        self.keep.cleanup()

    def run_strake(self, *arguments, **more):
        return subprocess.run([STRAKE, *map(str, arguments)], capture_output=True, text=True, timeout=100,
                              cwd=self.folder, check=False, **more)

    def files(self):
        return sorted(path.name for path in self.folder.iterdir())

    def write(self, name, text):
        (self.folder / name).write_text(text, encoding='utf-8')
        return name

    def two_files(self):
        """a.obj: cubes at 0 and 50 (millimetres, side 100: they clash); b.obj: one 10 from the first."""
        self.write('a.obj', cube('a0', 0, (0, 0, 0), 100) + cube('a1', 1, (50, 50, 50), 100))
        self.write('b.obj', cube('b0', 0, (-110, 0, 0), 100))


class Usage(Scenario):
    def test_version_and_help_go_to_stdout(self):
        version = self.run_strake('--version')
        self.assertEqual(version.returncode, 0)
        self.assertRegex(version.stdout, r'^strake \d+\.\d+\.\d+\n$')
        for arguments in (['--help'], ['info', '--help'], ['clash', '--help'], ['draw', '--help'],
                          ['generate', '--help'], ['generate', 'ship', '--help']):
            with self.subTest(arguments):
                done = self.run_strake(*arguments)
                self.assertEqual(done.returncode, 0)
                self.assertIn('Usage: strake', done.stdout)
                self.assertEqual(done.stderr, '')

    def test_wrong_command_lines_are_usage_errors_that_say_what(self):
        self.two_files()
        for arguments, said in (
                ([], 'no verb is given'),
                (['frobnicate'], 'frobnicate'),
                (['info'], 'no model file'),
                (['generate'], 'no verb is given'),
                (['generate', 'ship', '--frob'], 'generate ship --help'),
                (['clash', 'a.obj', '--clearance'], '--clearance wants a value'),
                (['clash', 'a.obj', '--clearance', '1mm', '--clearance', '2mm'], 'more than once'),
                (['info', 'a.obj', '--colour'], '--colour'),
                (['clash', 'a.obj', '--clearence', '25mm'], '--clearence'),
                (['info', 'a.obj', '--threads', '0'], '1 to'),
                (['info', 'a.obj', '--threads', 'many'], 'many'),
                (['info', 'a.obj', '--unit', 'cubit'], 'um, mm'),
                (['info', 'a.obj', '--up-axis', 'q'], 'x|y|z'),
                (['info', 'a.obj', '--sag', '0'], 'positive'),
                (['clash', 'a.obj', '--clearance', '25'], '25mm'),
                (['clash', 'a.obj', '--clearance', '-1mm'], 'negative'),
                (['clash', 'a.obj', '--touch-gap', 'nan'], 'nan'),
                (['clash', 'a.obj', '--clearance', ''], '--clearance: the value is empty'),
                (['info', 'a.obj', '--threads', ''], '--threads: the value is empty'),
                (['info', ''], 'FILE: the value is empty'),
                (['draw', 'a.obj', '-o', 'a.svg', '--limits', ''], '--limits: the value is empty'),
                (['info', 'a.obj', '--sag', '1e-30mm'], '1um or more'),
                (['clash', 'a.obj', '--fail-on', 'sometimes'], 'hit|contact'),
                (['clash', 'a.obj', '-o', 'report.doc'], '.json or .csv'),
                (['clash', 'a.obj', '--a', 'name ='], '--a, selection, column 7'),
                (['clash', 'a.obj', '--b', 'x', '--self'], '--b excludes --self'),
                (['clash', 'a.obj', '--most-pairs', 'all'], '--most-pairs'),
                (['draw', 'a.obj'], '-o FILE.svg'),
                (['draw', 'a.obj', '-o', 'a.dwg'], '.svg or .json'),
                (['draw', 'a.obj', '-o', 'a.svg', '--view', 'askew'], 'top|bottom'),
                (['draw', 'a.obj', '-o', 'a.svg', '--view', 'top', '--direction', '1,1,1'], 'exclude'),
                (['draw', 'a.obj', '-o', 'a.svg', '--direction', '0,0,0'], '--direction'),
                (['draw', 'a.obj', '-o', 'a.svg', '--direction', '1,1'], '--direction'),
                (['draw', 'a.obj', '-o', 'a.svg', '--limits', '1,2,3'], '--limits'),
                (['draw', 'a.obj', '-o', 'a.svg', '--limits', '1,1,1,0,0,0'], 'empty'),
                (['draw', 'a.obj', '-o', 'a.svg', '--scale', '50'], '1:50'),
                (['draw', 'a.obj', '-o', 'a.svg', '--scale', '1:5e-324'], '1:50'),
                (['draw', 'a.obj', '-o', 'a.svg', '--select', 'nobody*'], 'nobody*'),
                (['draw', 'a.obj', '-o', 'a.svg', '--select', 'type = '], '--select, selection, column 8'),
                (['draw', 'a.obj', '-o', 'a.svg', '--sharp-angle', '20mm'], '20deg'),
                (['generate', 'ship'], '--output'),
                (['generate', 'ship', '-o', 'x.glb', '--objects', '3'], 'objects'),
                (['generate', 'ship', '-o', 'x.glb', '--objects', '1e3'], 'digits'),
                (['generate', 'ship', '-o', 'x.step'], '.glb or .obj')):
            with self.subTest(arguments):
                done = self.run_strake(*arguments)
                self.assertEqual(done.returncode, 2, done.stderr)
                self.assertIn(said, done.stderr)
                self.assertIn('strake: error: ', done.stderr)
                self.assertEqual(done.stdout, '')
        self.assertEqual(self.files(), ['a.obj', 'b.obj'])


    def test_what_makes_no_sense_is_said_before_a_model_is_read(self):
        for arguments, said in (
                (['clash', 'missing.obj', '--clearance', '1e300mm'], '--clearance: '),
                (['clash', 'missing.obj', '--contact-distance', '2km'], '--contact-distance: '),
                (['draw', 'missing.obj', '-o', 'a.svg', '--direction', '1,1,1', '--up', '2,2,2'], '--up: '),
                (['draw', 'missing.obj', '-o', 'a.svg', '--view', 'top', '--up', '0,0,-5'], 'parallel')):
            with self.subTest(arguments):
                done = self.run_strake(*arguments)
                self.assertEqual(done.returncode, 2, done.stderr)
                self.assertIn(said, done.stderr)
                self.assertNotIn('missing.obj', done.stderr)

    def test_an_option_takes_one_value_and_leaves_the_next_word_alone(self):
        self.two_files()
        done = self.run_strake('clash', '-o', 'x.json', 'a.obj', 'b.obj')
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual([f['label'] for f in json.loads((self.folder / 'x.json').read_text())['files']],
                         ['a.obj', 'b.obj'])
        done = self.run_strake('draw', '--select', 'a0', 'a.obj', '-o', 'x.svg')
        self.assertEqual(done.returncode, 0, done.stderr)


class Files(Scenario):
    def test_input_that_cannot_be_read_names_the_file(self):
        self.write('empty.obj', '')
        self.write('noise.xyz', 'neither fish nor fowl\n')
        for verb in (['info'], ['clash', '-o', 'x.json'], ['draw', '-o', 'x.svg']):
            for name in ('missing.rvm', 'empty.obj', 'noise.xyz'):
                with self.subTest(verb=verb, name=name):
                    done = self.run_strake(*verb, name)
                    self.assertEqual(done.returncode, 3, done.stderr)
                    self.assertIn(name, done.stderr)
        self.assertEqual(self.files(), ['empty.obj', 'noise.xyz'])

    def test_output_that_cannot_be_written_leaves_nothing(self):
        self.two_files()
        done = self.run_strake('clash', 'a.obj', '-o', 'no/such/folder/x.json')
        self.assertEqual(done.returncode, 3)
        self.assertIn('no/such/folder', done.stderr)
        done = self.run_strake('info', 'a.obj', stdin=None)
        self.assertEqual(done.returncode, 0)
        with open('/dev/full', 'w', encoding='utf-8') as full:
            done = subprocess.run([STRAKE, 'info', 'a.obj'], stdout=full, stderr=subprocess.PIPE,
                                  text=True, cwd=self.folder, timeout=100, check=False)
        self.assertEqual(done.returncode, 3)
        self.assertIn('standard output', done.stderr)
        self.assertEqual(self.files(), ['a.obj', 'b.obj'])

    def test_an_old_result_survives_a_failed_run(self):
        self.write('x.json', 'old')
        self.assertEqual(self.run_strake('clash', 'missing.obj', '-o', 'x.json').returncode, 3)
        self.assertEqual((self.folder / 'x.json').read_text(), 'old')


    def test_a_model_is_never_overwritten(self):
        self.two_files()
        model = (self.folder / 'a.obj').read_text()
        self.write('model.json', model)
        os.symlink('model.json', self.folder / 'link.json')
        os.mkdir(self.folder / 'sub')
        for arguments in (['clash', 'model.json', '-o', 'model.json'], ['clash', 'model.json', '-o', 'link.json'],
                          ['draw', 'link.json', '-o', 'x.svg', '-o', './sub/../model.json']):
            with self.subTest(arguments):
                done = self.run_strake(*arguments)
                self.assertEqual(done.returncode, 2, done.stderr)
                self.assertIn('overwritten', done.stderr)
                self.assertEqual((self.folder / 'model.json').read_text(), model)

    def test_outputs_that_cannot_be_are_said_at_once(self):
        self.two_files()
        done = self.run_strake('draw', 'missing.obj', '-o', 'x.svg', '-o', './x.svg')
        self.assertEqual(done.returncode, 2)
        self.assertIn('twice', done.stderr)
        os.mkdir(self.folder / 'dir.svg')
        done = self.run_strake('draw', 'missing.obj', '-o', 'dir.svg')
        self.assertEqual(done.returncode, 3)
        self.assertIn('it is a folder', done.stderr)

    def test_a_pipe_that_nobody_writes_to_is_refused_at_once(self):
        os.mkfifo(self.folder / 'pipe')
        done = self.run_strake('info', 'pipe')
        self.assertEqual(done.returncode, 3)
        self.assertIn('not a regular file', done.stderr)

    def test_closed_standard_streams_do_not_end_in_a_result(self):
        self.two_files()
        done = subprocess.run(['/bin/sh', '-c', '"$0" clash a.obj -o x.json >&- 2>&- <&-', STRAKE],
                              cwd=self.folder, timeout=100, check=False)
        self.assertEqual(done.returncode, 3)
        json.loads((self.folder / 'x.json').read_text())

    def test_names_cannot_command_the_terminal(self):
        self.write('evil.obj', cube('\x1b[2J\u202egpj', 0, (0, 0, 0), 1).replace('f 4 1 5 8\n', ''))
        for arguments in (['info', 'evil.obj'], ['clash', 'evil.obj'], ['info', 'a\x1b[2J.obj']):
            done = self.run_strake(*arguments)
            for text in (done.stdout, done.stderr):
                self.assertNotIn('\x1b', text)
                self.assertNotIn('\u202e', text)


class Generate(Scenario):
    def test_json_is_the_truth(self):
        done = self.run_strake('generate', 'ship', '--objects', 100, '-o', 'x.glb', '--truth', 'x.json', '--json')
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(done.stdout, (self.folder / 'x.json').read_text())
        self.assertIn('pairs', json.loads(done.stdout))


class Info(Scenario):
    def test_data_on_stdout_narration_on_stderr(self):
        self.two_files()
        done = self.run_strake('info', 'a.obj', 'b.obj', '--unit', 'mm', '--up-axis', 'z', '--json')
        self.assertEqual(done.returncode, 0, done.stderr)
        told = json.loads(done.stdout)
        self.assertEqual([file['objects'] for file in told['files']], [2, 1])
        self.assertEqual(told['total']['objects'], 3)
        self.assertEqual(told['total']['triangles'], 36)
        self.assertEqual(told['total']['solids'], 3)
        self.assertEqual(told['total']['extents_mm'], {'lo': [-110, 0, 0], 'hi': [150, 150, 150]})
        self.assertEqual(told['skipped'], 0)
        self.assertIn('a.obj: OBJ', done.stderr)
        quiet = self.run_strake('info', 'a.obj', '--quiet')
        self.assertEqual((quiet.returncode, quiet.stderr), (0, ''))
        self.assertIn('objects', quiet.stdout)

    def test_the_unit_and_the_axis_are_obeyed(self):
        self.two_files()
        done = self.run_strake('info', 'b.obj', '--unit', 'm', '--up-axis', 'z', '--json')
        self.assertEqual(json.loads(done.stdout)['total']['extents_mm'],
                         {'lo': [-110000, 0, 0], 'hi': [-10000, 100000, 100000]})
        done = self.run_strake('info', 'b.obj', '--unit', 'mm', '--up-axis', 'y', '--json')
        self.assertEqual(json.loads(done.stdout)['total']['extents_mm'],
                         {'lo': [-110, -100, 0], 'hi': [-10, 0, 100]})

    def test_stats_say_where_the_time_went(self):
        self.two_files()
        done = self.run_strake('info', 'a.obj', '--stats', '--quiet', '--json')
        self.assertEqual(done.returncode, 0)
        stats = json.loads(done.stderr)
        self.assertEqual(stats['phases'][0]['name'], 'load')
        self.assertGreater(stats['peak_memory_bytes'], 1 << 20)
        plain = self.run_strake('info', 'a.obj', '--stats')
        self.assertIn('peak memory', plain.stderr)

    def test_strict_tells_a_partial_result_by_its_exit_code(self):
        self.write('bad.obj', cube('good', 0, (0, 0, 0), 1) + 'o bad\nv nan 0 0\nf 9 9 9\n')
        self.assertEqual(self.run_strake('info', 'bad.obj').returncode, 0)
        strict = self.run_strake('info', 'bad.obj', '--strict', '--json')
        self.assertEqual(strict.returncode, 4, strict.stderr)
        self.assertGreater(json.loads(strict.stdout)['skipped'], 0)


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
        for more in (['--threads', 1], ['--threads', 3], ['--threads', 64], ['--broad-phase', 'all-pairs']):
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

    def test_lines_are_judged_where_asked_for(self):
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
        done = self.run_strake('clash', 'a.obj', '--most-pairs', 0)
        self.assertEqual(done.returncode, 3, done.stderr)
        self.assertIn('more than 0 pairs', done.stderr)
        self.assertIn('--most-pairs', done.stderr)
        self.assertEqual(self.run_strake('clash', 'a.obj', '--most-pairs', 1).returncode, 0)

    def test_fail_on_is_an_exit_code(self):
        self.two_files()
        self.assertEqual(self.run_strake('clash', 'a.obj', *self.SETTINGS).returncode, 0)
        self.assertEqual(self.run_strake('clash', 'a.obj', *self.SETTINGS, '--fail-on', 'hit').returncode, 1)
        far = ['clash', 'a.obj', 'b.obj', *self.SETTINGS, '--clearance', '25mm', '--fail-on']
        self.assertEqual(self.run_strake(*far, 'hit').returncode, 0)
        self.assertEqual(self.run_strake(*far, 'contact').returncode, 0)
        self.assertEqual(self.run_strake(*far, 'clearance_violation').returncode, 1)


    def test_groups_say_which_options_belong_together(self):
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
        self.assertIn('costly pair', self.run_strake('clash', 'a.obj', '--stats').stderr)

    def generate(self, name, *more):
        done = self.run_strake('generate', 'ship', '--objects', 300, '--seed', 7, '-o', name, *more)
        self.assertEqual(done.returncode, 0, done.stderr)

    def diff(self, *arguments, exit_code=0):
        done = self.run_strake('clash', 'diff', 'old.json', 'new.json', '--json', *arguments)
        self.assertEqual(done.returncode, exit_code, done.stderr)
        return json.loads(done.stdout)

    def test_a_run_is_compared_with_an_older_one(self):
        """A ship, and the same with one object removed, one moved away and one renamed."""
        self.generate('ship.obj')
        run = ['clash', 'ship.obj', '-o']
        self.assertEqual(self.run_strake(*run, 'old.json').returncode, 0)
        self.assertEqual(self.run_strake(*run, 'new.json').returncode, 0)
        same = self.diff('--fail-on', 'worse')
        results = json.loads((self.folder / 'old.json').read_text())['results']
        self.assertEqual(same['counts'], {'new': 0, 'changed': 0, 'same': len(results), 'gone': 0, 'cannot_tell': 0})
        hits = [r for r in results if r['class'] == 'HIT']
        removed, moved = hits[0]['a']['id'], hits[-1]['b']['id']
        touched = {id for r in results for id in (r['a']['id'], r['b']['id'])}
        renamed = next(id for id in sorted(touched, reverse=True)
                       if not any({id, other} <= {r['a']['id'], r['b']['id']} for r in results
                                  for other in (removed, moved)))
        self.rewrite_obj('ship.obj', removed, moved, renamed)
        self.assertEqual(self.run_strake(*run, 'new.json').returncode, 0)
        told = self.diff('-o', 'changes.json', '--fail-on', 'cannot-tell', exit_code=1)
        self.assertEqual(told, json.loads((self.folder / 'changes.json').read_text()))
        self.assertEqual(told['counts']['changed'], 0)

        def of(entries):
            return {frozenset((e['a']['id'], e['b']['id'])) for e in entries}

        def having(id):
            return {frozenset((r['a']['id'], r['b']['id'])) for r in results if id in (r['a']['id'], r['b']['id'])}
        missing = having(removed) | having(renamed)
        self.assertEqual(of(told['cannot_tell']), missing)
        self.assertEqual(of(told['gone']), having(moved) - missing)
        self.assertTrue(all('is not in the model' in e['why'] for e in told['cannot_tell']))
        self.assertEqual(of(told['added']),
                         {frozenset(i.replace(renamed, 'renamed') for i in pair)
                          for pair in having(renamed) - having(removed) - having(moved)})
        self.assertTrue(all("'renamed' of ship.obj is not in the model" == e['why'] for e in told['added']))
        done = self.run_strake('clash', 'diff', 'old.json', 'new.json')
        self.assertIn(f"{len(told['gone'])} gone, {len(missing)} cannot tell", done.stdout)

    def rewrite_obj(self, name, removed, moved, renamed):
        """Vertices are numbered through the file, so a removed object keeps them."""
        lines, keep, far = [], True, False
        for line in (self.folder / name).read_text().splitlines():
            word, _, rest = line.partition(' ')
            if word in ('o', 'g'):
                keep, far = rest != removed, rest == moved
                if rest == renamed:
                    line = f'{word} renamed'
            elif word == 'v' and far:
                x, y, z = rest.split()[:3]
                line = f'v {float(x) + 1e4} {y} {z}'
            if keep or word == 'v':
                lines.append(line)
        self.write(name, '\n'.join(lines) + '\n')

    def test_what_cannot_be_compared_is_named(self):
        self.two_files()
        self.run_strake('clash', 'a.obj', '-o', 'good.json')
        good = (self.folder / 'good.json').read_text()
        self.write('cut.json', good[:-40])
        self.write('first.json', good.replace('"schema_version": 2', '"schema_version": 1'))
        for file, word in (('cut.json', 'ends too soon'), ('first.json', 'version 1'), ('a.obj', 'no JSON'),
                           ('nowhere.json', 'cannot be opened'), ('.', 'folder')):
            with self.subTest(file):
                done = self.run_strake('clash', 'diff', 'good.json', file)
                self.assertEqual(done.returncode, 3, done.stderr)
                self.assertIn(word, done.stderr)
                self.assertIn(file, done.stderr)
        self.assertEqual(self.run_strake('clash', 'diff', 'good.json').returncode, 2)
        self.assertEqual(self.run_strake('clash', 'diff', 'good.json', 'good.json', '-o', 'good.json').returncode, 2)
        self.assertEqual((self.folder / 'good.json').read_text(), good)


class Draw(Scenario):
    def test_svg_and_json_are_the_same_for_any_number_of_threads(self):
        self.two_files()
        expected = None
        for threads in (1, 2, 3, 8, 64):
            done = self.run_strake('draw', 'a.obj', 'b.obj', '--view', 'iso', '--hidden', 'dashed', '--threads',
                                   threads, '-o', 'x.svg', '-o', 'x.json')
            self.assertEqual(done.returncode, 0, done.stderr)
            got = [(self.folder / name).read_bytes() for name in ('x.svg', 'x.json')]
            expected = expected or got
            self.assertEqual(got, expected, threads)
        self.assertIn(b'<svg', expected[0])
        self.assertEqual(set(piece['object'] for piece in json.loads(expected[1])['pieces']).__len__(), 3)

    def test_order_of_files_and_of_objects_changes_nothing(self):
        self.write('b.obj', cube('b', 0, (10, 20, 90), 40))
        got = []
        for order in ([0, 1, 2, 3, 4, 5, 6], [6, 5, 4, 3, 2, 1, 0], [3, 0, 6, 2, 5, 1, 4]):
            # Two of them coincide, so that which line is the duplicate must not depend on the order.
            self.write('all.obj', ''.join(cube(f'a{i}', at, (i % 6 * 50, i % 6 * 30, i % 6 * 20), 100)
                                          for at, i in enumerate(order)))
            for files in (('all.obj', 'b.obj'), ('b.obj', 'all.obj')):
                done = self.run_strake('draw', *files, '--unit', 'mm', '--up-axis', 'z', '--hidden', 'dashed', '-o',
                                       'x.svg', '-o', 'x.json')
                self.assertEqual(done.returncode, 0, done.stderr)
                got.append([(self.folder / name).read_bytes() for name in ('x.svg', 'x.json')])
        for other in got[1:]:
            self.assertEqual(other, got[0])

    def test_selection_limits_and_solver(self):
        self.two_files()

        def pieces(*more):
            done = self.run_strake('draw', 'a.obj', '--unit', 'mm', '--up-axis', 'z', *more, '--json')
            self.assertEqual(done.returncode, 0, done.stderr)
            return json.loads(done.stdout)['pieces']

        whole = pieces()
        self.assertEqual(whole, pieces('--solver', 'brute-force'))
        self.assertEqual(pieces('--view', 'front'), pieces('--direction', '0,-7,0'))
        one = pieces('--select', 'a0')
        self.assertLess(len(one), len(whole))
        self.assertEqual(one, pieces('--select', 'type = mesh and not name ~ "a[1-9]"'))
        self.assertEqual(whole, pieces('--select', 'a0', '--select', 'not a0'))
        wire = pieces('--stage', 'none')
        self.assertEqual({piece['state'] for piece in wire} - {'visible', 'projecting', 'duplicate'}, set())
        cut = pieces('--limits', '0,0,0,40,40,40')
        self.assertTrue(any(piece['state'] == 'clipped' for piece in cut))

    def test_an_empty_sheet_is_not_silent(self):
        self.two_files()
        done = self.run_strake('draw', 'a.obj', '-o', 'x.svg', '--limits', '1e6,1e6,1e6,2e6,2e6,2e6')
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn('nothing lies within the limits', done.stderr)


class Interrupt(Scenario):
    """Ctrl-C: exit code 130, soon, and nothing left behind."""

    ARGUMENTS = ['generate', 'ship', '--objects', '3000000', '-o', 'big.glb', '--truth', 'big.json']

    def start(self, **more):
        return subprocess.Popen([STRAKE, *self.ARGUMENTS], cwd=self.folder, text=True, **more)

    def test_ctrl_c_ends_at_once_and_leaves_nothing(self):
        for name in ('SIGINT', 'SIGTERM'):
            for delay in (0.2, 1.0):
                with self.subTest(signal=name, delay=delay):
                    process = self.start(stdout=subprocess.DEVNULL, stderr=subprocess.PIPE)
                    time.sleep(delay)
                    self.assertIsNone(process.poll(), 'the run is too short to be interrupted')
                    before = time.monotonic()
                    process.send_signal(getattr(signal, name))
                    _, told = process.communicate(timeout=60)
                    took = time.monotonic() - before
                    self.assertEqual(process.returncode, 130, told)
                    self.assertIn('cancelled', told)
                    self.assertEqual(self.files(), [])
                    # The promise is 100 ms; a machine with other work on it gets some grace.
                    self.assertLess(took, 2.0)
                    print(f'{name} after {delay} s: ended in {1000 * took:.0f} ms', file=sys.stderr)

    def test_progress_is_drawn_on_a_terminal_only(self):
        try:
            master, slave = pty.openpty()
        except OSError as error:
            self.skipTest(f'no terminal to be had here: {error}')
        process = self.start(stdout=subprocess.DEVNULL, stderr=slave)
        os.close(slave)
        shown, until = b'', time.monotonic() + 30
        while time.monotonic() < until and b' s' not in shown:
            if select.select([master], [], [], 0.2)[0]:
                try:
                    shown += os.read(master, 4096)
                except OSError:
                    break
        process.send_signal(signal.SIGINT)
        while process.poll() is None:
            if select.select([master], [], [], 0.05)[0]:
                try:
                    os.read(master, 4096)
                except OSError:
                    break
        self.assertEqual(process.wait(60), 130)
        os.close(master)
        self.assertIn(b'\r', shown)
        self.assertRegex(shown.decode(), r'\d+ s')

        process = self.start(stdout=subprocess.PIPE, stderr=subprocess.PIPE)
        time.sleep(1.6)
        process.send_signal(signal.SIGINT)
        out, told = process.communicate(timeout=60)
        self.assertEqual(out, '')
        self.assertNotIn('\r', told)


if __name__ == '__main__':
    STRAKE = str(Path(sys.argv.pop(1)).resolve())
    unittest.main(verbosity=1)
