#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""evaluate_test.py STRAKE SCHEMAS: an evaluation of two cases, as a user runs, resumes and compares it, and of peers that
scripts play."""
import csv
import json
import signal
import subprocess
import sys
import tempfile
import time
import unittest
from pathlib import Path

import jsonschema

STRAKE = SCHEMAS = None
# Plays a program with peers: writes the rows that lie beside it, and ends with the status that does.
PLAYER = """#!/bin/sh
for word; do [ "$before" = --json ] && json=$word; before=$word; done
[ -e "$0.sleep" ] && sleep 60
cp "$0.rows" "$json"
exit "$(cat "$0.status")"
"""


def peer_row(**more):
    """What a peer says that agrees."""
    return {'scene': 'ship of 500 objects', 'objects': 500, 'triangles': 9000, 'threads': 1, 'who': 'Embree',
            'version': 'Embree 3', 'answers': 'pairs that overlap', 'cpu_s': 3.0, 'wall_s': 2.0, 'ours_cpu_s': 0.5,
            'ours_wall_s': 0.25, 'outcome': 'measured', 'result': 'all 4 crossing pairs found', **more}


class Evaluate(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.keep = tempfile.TemporaryDirectory(prefix='strake-evaluate-')
        cls.folder = Path(cls.keep.name)
        cls.first = cls.evaluate('-o', 'first', '--only', 'detail,repeated')

    @classmethod
    def tearDownClass(cls):
        cls.keep.cleanup()

    @classmethod
    def evaluate(cls, *arguments, expect=0):
        done = subprocess.run([STRAKE, 'evaluate', '--scale', '0.001', '--threads', '1,2,3', '--repeat', '1', '--limit',
                               '0.2', *map(str, arguments)], capture_output=True, text=True, cwd=cls.folder, timeout=300)
        assert done.returncode == expect, (done.returncode, done.stderr)
        return done

    def record(self, folder='first'):
        return json.loads((self.folder / folder / 'evaluation.json').read_text(encoding='utf-8'))

    def test_all_files_are_written_and_follow_their_forms(self):
        record = self.record()
        schema = json.loads((SCHEMAS / 'evaluation.schema.json').read_text(encoding='utf-8'))
        jsonschema.validate(record, schema)
        self.assertEqual([c['name'] for c in record['cases']], ['detail', 'repeated'])
        folder = self.folder / 'first'
        page = (folder / 'evaluation.html').read_text(encoding='utf-8')
        self.assertIn('byte by byte', page)
        self.assertNotIn('src=', page)
        charts = sorted(path.name for path in folder.glob('*.svg'))
        self.assertTrue(charts)
        text = (folder / 'evaluation.md').read_text(encoding='utf-8')
        for chart in charts:
            self.assertIn(f']({chart})', text)
        with (folder / 'evaluation.csv').open(encoding='utf-8', newline='') as file:
            rows = list(csv.DictReader(file))
        contenders = sum(len(s['contenders']) for c in record['cases'] for s in c['stages'])
        self.assertEqual(len(rows), contenders)

    def test_results_of_all_teams_are_equal(self):
        for case in self.record()['cases']:
            for stage in case['stages']:
                self.assertEqual(stage['differences'], [])
                exact = [c for c in stage['contenders'] if c['published_hash']]
                self.assertGreaterEqual(len(exact), 4)
                self.assertEqual(len({(c['hash'], c['published_hash']) for c in exact}), 1)

    def test_views_of_different_stages_differ(self):
        stages = self.record()['cases'][0]['stages']
        self.assertNotEqual(stages[0]['contenders'][0]['hash'], stages[1]['contenders'][0]['hash'])

    def test_what_is_there_is_not_measured_again(self):
        before = self.record()
        done = self.evaluate('-o', 'first', '--only', 'detail,repeated')
        self.assertIn('2 cases, which are not measured again', done.stderr)
        self.assertEqual(self.record(), before)

    def test_other_settings_want_another_folder(self):
        done = subprocess.run([STRAKE, 'evaluate', '--scale', '0.002', '-o', 'first', '--only', 'detail'],
                              capture_output=True, text=True, cwd=self.folder)
        self.assertEqual(done.returncode, 2)
        self.assertIn('--fresh', done.stderr)

    def test_work_that_grew_is_named(self):
        before = self.record()
        (self.folder / 'same.json').write_text(json.dumps(before), encoding='utf-8')
        same = self.evaluate('-o', 'first', '--only', 'detail,repeated', '--compare', 'same.json')
        self.assertIn('0 grew', same.stderr)
        itself = self.evaluate('-o', 'first', '--only', 'detail', '--compare', 'first/evaluation.json', expect=2)
        self.assertIn('gone on with', itself.stderr)
        before['cases'][1]['stages'][0]['contenders'][0]['hash'] = 'another'
        (self.folder / 'other.json').write_text(json.dumps(before), encoding='utf-8')
        other = self.evaluate('-o', 'first', '--only', 'detail,repeated', '--compare', 'other.json', expect=1)
        self.assertIn('another result than before: repeated, clash', other.stderr)
        before['cases'][0]['stages'][1]['contenders'][0]['counters']['face tests'] //= 2
        (self.folder / 'less.json').write_text(json.dumps(before), encoding='utf-8')
        more = self.evaluate('-o', 'first', '--only', 'detail,repeated', '--compare', 'less.json', expect=1)
        self.assertIn('more work: detail, global: face tests', more.stderr)

    def test_fresh_measures_again_what_is_named(self):
        self.evaluate('-o', 'third', '--only', 'detail,repeated')
        before = self.record('third')
        self.evaluate('-o', 'third', '--only', 'detail', '--fresh')
        after = self.record('third')
        self.assertEqual([c['name'] for c in after['cases']], ['detail', 'repeated'])
        self.assertEqual(after['cases'][1], before['cases'][1])
        self.assertNotEqual(after['cases'][0], before['cases'][0])

    def test_wrong_values_are_named(self):
        for arguments, word in ((('--only', 'nothing'), 'section-long'), (('--scale', '0'), '--scale'),
                                (('--scale', 'nan'), '--scale'), (('--threads', '1,x'), '--threads'),
                                (('--repeat', '0'), '--repeat'), (('--limit', '-1'), '--limit')):
            done = subprocess.run([STRAKE, 'evaluate', '-o', 'wrong', *arguments], capture_output=True, text=True,
                                  cwd=self.folder)
            self.assertEqual(done.returncode, 2, arguments)
            self.assertIn(word, done.stderr)
        for text in ('', '{', '[]', '{"schema_version": 1}'):
            (self.folder / 'bad.json').write_text(text, encoding='utf-8')
            done = subprocess.run([STRAKE, 'evaluate', '-o', 'wrong', '--only', 'detail', '--compare', 'bad.json'],
                                  capture_output=True, text=True, cwd=self.folder)
            self.assertEqual(done.returncode, 3, text)
        done = subprocess.run([STRAKE, 'evaluate', '-o', 'wrong', '--compare', '.'], capture_output=True, text=True,
                              cwd=self.folder)
        self.assertEqual(done.returncode, 3)
        self.assertFalse((self.folder / 'wrong').exists())

    def test_studies_answer_with_tables_of_equal_results(self):
        names = ['distribution', 'longest-first', 'granularity', 'memory', 'stage-one', 'octree']
        done = subprocess.run([STRAKE, 'evaluate', '--scale', '0.001', '--threads', '1', '--repeat', '1', '--limit', '60',
                               '--only', ','.join(names), '-o', 'studies'],
                              capture_output=True, text=True, cwd=self.folder, timeout=500)
        self.assertEqual(done.returncode, 0, done.stderr)
        record = self.record('studies')
        jsonschema.validate(record, json.loads((SCHEMAS / 'evaluation.schema.json').read_text(encoding='utf-8')))
        studies = {study['name']: study for study in record['studies']}
        self.assertEqual(sorted(studies), sorted(names))
        for name, study in studies.items():
            with self.subTest(name):
                self.assertEqual(study['differences'], [])
                self.assertGreater(len(study['rows']), 4)
                for row in study['rows']:
                    self.assertEqual(len(row), len(study['columns']), row)
                    self.assertIn(row[study['columns'].index('Equal')], ('yes', '-'), row)
        self.worker_charts(studies['distribution'], 4)
        self.worker_charts(studies['longest-first'], 3)
        pairs = studies['octree']['columns'].index('Pairs')
        found = [row[pairs] for row in studies['octree']['rows']]
        self.assertEqual(found[::2], found[1::2], 'either tree')
        self.assertEqual(len(found), 8)
        self.assertEqual([row[1] for row in studies['memory']['rows']], ['1', '2', '4', '8', '16'] * 3)
        page = (self.folder / 'studies' / 'evaluation.md').read_text(encoding='utf-8')
        self.assertIn('(chart-distribution-4.svg)', page)
        self.assertTrue((self.folder / 'studies' / 'chart-distribution-4.svg').is_file())

    def test_existing_views_cost_what_changed(self):
        done = subprocess.run([STRAKE, 'evaluate', '--scale', '0.001', '--threads', '1,2', '--repeat', '1', '--only',
                               'existing-view', '-o', 'views'],
                              capture_output=True, text=True, cwd=self.folder, timeout=500)
        self.assertEqual(done.returncode, 0, done.stderr)
        record = self.record('views')
        jsonschema.validate(record, json.loads((SCHEMAS / 'evaluation.schema.json').read_text(encoding='utf-8')))
        study, = record['studies']
        self.assertEqual(study['differences'], [])
        rows = [dict(zip(study['columns'], row, strict=True)) for row in study['rows']]
        states = ('new view', 'unchanged', 'one object moved', 'one in a thousand moved', '1 % added')
        self.assertEqual([row['State'] for row in rows], list(states) * 13)
        for row in rows:
            with self.subTest(row=row):
                self.assertEqual(row['Equal'], '-' if row['State'] == 'new view' else 'yes')
                self.assertGreater(float(row["Thesis's way s"]), 0)
                if row['State'] == 'new view':
                    everything = int(row['Edges solved'])
                    self.assertGreater(float(row['Local s']), 0)
                    self.assertGreater(float(row['Global s']), 0)
                    self.assertRegex(row['Note'], r'^[1-9]\d* instances share' if row['View'] != 'Whole ship, perspective'
                                     else r'^0 instances')
                elif row['State'] == 'unchanged':
                    self.assertEqual((row['Changed'], row['Solved'], row['Edges solved']), ('0', '0', '0'))
                elif row['State'] == 'one object moved':
                    self.assertEqual((row['Changed'], row['Note']), ('1', ''))
                    self.assertLess(5 * int(row['Edges solved']), everything)
        chart, = study['charts']
        self.assertEqual([len(series['values']) for series in chart['series']], [13] * 6)
        page = (self.folder / 'views' / 'evaluation.md').read_text(encoding='utf-8')
        self.assertIn('(chart-existing-view-1.svg)', page)
        self.assertIn('<svg', (self.folder / 'views' / 'evaluation.html').read_text(encoding='utf-8'))
        with (self.folder / 'views' / 'evaluation-studies.csv').open(encoding='utf-8', newline='') as file:
            cells = list(csv.DictReader(file))
        # A quote keeps spreadsheets from taking a dash for a formula.
        self.assertEqual([cell['value'].lstrip("'") for cell in cells], [cell for row in study['rows'] for cell in row])

    def worker_charts(self, study, count):
        self.assertEqual(len(study['charts']), count)
        for chart in study['charts']:
            self.assertEqual(len(chart['names']), 7)
            self.assertEqual([len(series['values']) for series in chart['series']], [7, 7])


class Peers(unittest.TestCase):
    def setUp(self):
        self.keep = tempfile.TemporaryDirectory(prefix='strake-peers-')
        self.folder = Path(self.keep.name)
        (self.folder / 'programs').mkdir()

    def tearDown(self):
        self.keep.cleanup()

    def play(self, rows, status=0, hangs=False, name='bench_clash_peers'):
        program = self.folder / 'programs' / name
        program.write_text(PLAYER, encoding='utf-8')
        program.chmod(0o755)
        text = json.dumps({'schema_version': 1, 'rows': rows}) if isinstance(rows, list) else rows
        Path(f'{program}.rows').write_text(text, encoding='utf-8')
        Path(f'{program}.status').write_text(str(status), encoding='utf-8')
        if hangs:
            Path(f'{program}.sleep').touch()

    def start(self, *arguments, only='pairs-embree'):
        return subprocess.Popen([STRAKE, 'evaluate', '--scale', '0.001', '--peers', 'programs', '--only', only, '-o', 'out',
                                 *arguments], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, cwd=self.folder)

    def evaluate(self, *arguments, expect=0, **more):
        process = self.start(*arguments, **more)
        _, errors = process.communicate(timeout=100)
        self.assertEqual(process.returncode, expect, errors)
        return errors

    def rows(self):
        record = json.loads((self.folder / 'out/evaluation.json').read_text(encoding='utf-8'))
        schema = json.loads((SCHEMAS / 'evaluation.schema.json').read_text(encoding='utf-8'))
        jsonschema.validate(record, schema)
        return {peer['name']: peer['rows'] for peer in record['peers']}

    def test_rows_stand_in_all_files(self):
        self.play([peer_row(), peer_row(scene='ship of 500 objects, turned')])
        self.evaluate()
        self.assertEqual(len(self.rows()['pairs-embree']), 2)
        self.assertIn('| ship of 500 objects, turned | 500 | 9000 | Embree |',
                      (self.folder / 'out/evaluation.md').read_text(encoding='utf-8'))
        self.assertIn('all 4 crossing pairs found', (self.folder / 'out/evaluation.html').read_text(encoding='utf-8'))
        with (self.folder / 'out/evaluation-peers.csv').open(encoding='utf-8', newline='') as file:
            self.assertEqual([row['cpu_s'] for row in csv.DictReader(file)], ['3', '3'])

    def test_what_was_measured_is_not_requested_again_and_what_was_not_there_is(self):
        self.play([peer_row()])
        self.evaluate(only='pairs-embree,drawing-occt')
        self.assertEqual(self.rows()['drawing-occt'][0]['outcome'], 'not there')
        self.play([peer_row(cpu_s=4.0)])
        self.play([peer_row(who='OCCT PolyAlgo')], name='bench_hidden_lines_peers')
        self.evaluate(only='pairs-embree,drawing-occt')
        self.assertEqual(self.rows()['pairs-embree'][0]['cpu_s'], 3.0)
        self.assertEqual(self.rows()['drawing-occt'][0]['outcome'], 'measured')

    def test_a_result_that_is_not_ours_is_exit_code_1(self):
        self.play([peer_row(outcome='disagrees', result='3 of 4 crossing pairs', cpu_s=0, wall_s=0)], status=1)
        self.assertIn('3 of 4 crossing pairs', self.evaluate(expect=1))
        self.assertIn('NO: 3 of 4', (self.folder / 'out/evaluation.md').read_text(encoding='utf-8'))

    def test_what_goes_wrong_is_a_row(self):
        for rows, status, outcome in (([], 0, 'failed'), ('{', 0, 'failed'), ([], 3, 'failed'),
                                      ([peer_row(outcome='no such')], 0, 'failed')):
            self.play(rows, status)
            self.evaluate('--fresh')
            self.assertEqual([row['outcome'] for row in self.rows()['pairs-embree']], [outcome], rows)
        self.play([peer_row()], hangs=True)
        self.evaluate('--fresh', '--peer-limit', '0.1')
        self.assertEqual(self.rows()['pairs-embree'][0]['outcome'], 'over limit')

    def test_ctrl_c_ends_the_peer(self):
        self.play([peer_row()], hangs=True)
        process = self.start()
        player = self.player_of(process)
        process.send_signal(signal.SIGINT)
        process.communicate(timeout=20)
        self.assertEqual(process.returncode, 130)
        self.assertTrue(self.wait_for(lambda: not self.runs(player)))

    @staticmethod
    def wait_for(condition):
        until = time.monotonic() + 20
        while time.monotonic() < until:
            value = condition()
            if value:
                return value
            time.sleep(0.01)
        return None

    def player_of(self, process):
        """The process of the peer program, once the script has begun to sleep."""
        def found():
            for path in Path('/proc').glob('[0-9]*/stat'):
                try:
                    fields = path.read_text().rsplit(')', 1)[1].split()
                    words = (path.parent / 'cmdline').read_bytes()
                except OSError:
                    continue
                if int(fields[1]) == process.pid and b'bench_clash_peers' in words:
                    return int(path.parent.name)
            return None
        player = self.wait_for(found)
        self.assertIsNotNone(player)
        return player

    @staticmethod
    def runs(pid):
        """Whether it runs; one that ended and that nobody has waited for does not."""
        try:
            return Path(f'/proc/{pid}/stat').read_text().rsplit(')', 1)[1].split()[0] != 'Z'
        except OSError:
            return False

    def test_peers_need_their_programs(self):
        for arguments, word in ((('--only', 'peers'), '--peers'), (('--only', 'pairs-fcl'), '--peers'),
                                (('--only', 'peers', '--peers', 'nowhere'), 'nowhere'),
                                (('--peers', 'programs', '--peer-limit', '0'), '--peer-limit')):
            done = subprocess.run([STRAKE, 'evaluate', '-o', 'wrong', *arguments], capture_output=True, text=True,
                                  cwd=self.folder)
            self.assertEqual(done.returncode, 2, arguments)
            self.assertIn(word, done.stderr)
        self.assertFalse((self.folder / 'wrong').exists())


if __name__ == '__main__':
    # A shell has what runs in its background ignore Ctrl-C, and programs that are started from here would inherit it.
    signal.signal(signal.SIGINT, signal.default_int_handler)
    STRAKE = Path(sys.argv.pop(1)).resolve()
    SCHEMAS = Path(sys.argv.pop(1)).resolve()
    unittest.main(verbosity=2)
