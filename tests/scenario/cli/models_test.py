#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""models_test.py STRAKE: models that it makes, and what it says that models hold."""
import json

from scenario import Scenario, cube, main


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
        reported = json.loads(done.stdout)
        self.assertEqual([file['objects'] for file in reported['files']], [2, 1])
        self.assertEqual(reported['total']['objects'], 3)
        self.assertEqual(reported['total']['triangles'], 36)
        self.assertEqual(reported['total']['solids'], 3)
        self.assertEqual(reported['total']['extents_mm'], {'lo': [-110, 0, 0], 'hi': [150, 150, 150]})
        self.assertEqual(reported['skipped'], 0)
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

    def test_objects_are_listed_with_what_selections_go_by(self):
        self.write('a.obj', cube('a0', 0, (0, 0, 0), 100) + cube('a1', 1, (50, 50, 50), 100))
        listed = json.loads(self.run_strake('info', 'a.obj', '--objects', 1, '--json').stdout)['objects']
        self.assertEqual([(o['name'], o['id'], o['file'], o['types'], o['categories'], o['attributes'])
                          for o in listed], [('a0', 'a0', 'a.obj', ['mesh'], ['physical'], [])])
        plain = self.run_strake('info', 'a.obj', '--objects', 1).stdout
        self.assertIn("name = 'a0'\n  id        a0\n  path      ", plain)
        self.assertTrue(plain.endswith('… and 1 objects more (--objects)\n'), plain)
        self.assertEqual(self.run_strake('clash', 'a.obj', '--a', f"color = '{listed[0]['colors'][0]}'",
                                         '--strict').returncode, 0)

    def test_attributes_are_listed_with_counts_and_values(self):
        self.text('generate', 'ship', '--objects', 300, '-o', 'ship.glb')
        self.write('a.obj', cube('a0', 0, (0, 0, 0), 100))
        document = json.loads(self.text('info', 'a.obj', 'ship.glb', '--attributes', '--objects', 300, '--json'))
        none, listed = (f['attributes'] for f in document['files'])
        self.assertEqual(none, [])
        self.assertEqual([a['name'] for a in listed], sorted(a['name'] for a in listed))
        stated = {}  # by the list of objects: 'info --objects' works it out by another way
        for o in json.loads(self.text('info', 'ship.glb', '--objects', 1000, '--json'))['objects']:
            for name in {name for name, _ in o['attributes']}:
                stated.setdefault(name, []).append({value for of, value in o['attributes'] if of == name})
        self.assertEqual({a['name']: (a['objects'], a['values']) for a in listed},
                         {name: (len(sets), len(set.union(*sets))) for name, sets in stated.items()})
        for a in listed:
            self.assertEqual(len(a['first_values']), min(3, a['values']))
            self.assertLessEqual(set(a['first_values']), set.union(*stated[a['name']]))
        plain = self.text('info', 'a.obj', 'ship.glb', '--attributes')
        self.assertIn('  attributes  none\n', plain)
        self.assertRegex(plain, r"\n  @discipline +300 +\d+  '[A-Z-]+', '[A-Z-]+', '[A-Z-]+', …\n")
        self.assertNotIn('attributes', self.text('info', 'ship.glb', '--json'))

    def test_stats_state_where_the_time_went(self):
        self.two_files()
        done = self.run_strake('info', 'a.obj', '--stats', '--quiet', '--json')
        self.assertEqual(done.returncode, 0)
        stats = json.loads(done.stderr)
        self.assertEqual(stats['phases'][0]['name'], 'load')
        self.assertGreater(stats['peak_memory_bytes'], 1 << 20)
        plain = self.run_strake('info', 'a.obj', '--stats')
        self.assertIn('peak memory', plain.stderr)

    def test_strict_reports_a_partial_result_by_its_exit_code(self):
        self.write('bad.obj', cube('good', 0, (0, 0, 0), 1) + 'o bad\nv nan 0 0\nf 9 9 9\n')
        self.assertEqual(self.run_strake('info', 'bad.obj').returncode, 0)
        strict = self.run_strake('info', 'bad.obj', '--strict', '--json')
        self.assertEqual(strict.returncode, 4, strict.stderr)
        self.assertGreater(json.loads(strict.stdout)['skipped'], 0)


if __name__ == '__main__':
    main()
