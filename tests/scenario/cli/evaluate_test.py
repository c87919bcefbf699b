#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""evaluate_test.py STRAKE SCHEMAS: an evaluation of two cases, as a user runs, resumes and compares it."""
import csv
import json
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

import jsonschema

STRAKE = SCHEMAS = None


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

    def worker_charts(self, study, count):
        self.assertEqual(len(study['charts']), count)
        for chart in study['charts']:
            self.assertEqual(len(chart['names']), 7)
            self.assertEqual([len(series['values']) for series in chart['series']], [7, 7])


if __name__ == '__main__':
    STRAKE = Path(sys.argv.pop(1)).resolve()
    SCHEMAS = Path(sys.argv.pop(1)).resolve()
    unittest.main(verbosity=2)
