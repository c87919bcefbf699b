#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""usage_test.py STRAKE: what it says of itself, and of command lines that make no sense."""
import json

from scenario import VERBS, Scenario, main


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

    def test_the_verb_help_prints_what_help_prints(self):
        for verb in VERBS:
            with self.subTest(verb=verb):
                done = self.run_strake('help', *verb)
                self.assertEqual((done.returncode, done.stderr), (0, ''))
                self.assertEqual(done.stdout, self.text(*verb, '--help'))

    def test_what_is_misspelt_is_guessed(self):
        for arguments, stated in (
                (['clahs'], "there is no verb 'clahs' (did you mean 'clash'?)"),
                (['frobnicate'], "there is no verb 'frobnicate' (the verbs are clash, draw, info"),
                (['help', 'drwa'], "there is no verb 'drwa' (did you mean 'draw'?)"),
                (['help', 'clash', 'dif'], "'strake clash' has no verb 'dif' (did you mean 'diff'?)"),
                (['man', 'inof'], "there is no verb 'inof' (did you mean 'info'?)"),
                (['generate', 'shp'], "'strake generate' has no verb 'shp' (did you mean 'ship'?)"),
                (['info', 'help', 'me', '--thread', '2'], "there is no option '--thread' (did you mean '--threads'?"),
                (['clash', 'a.obj', '--clearence=2mm'], "there is no option '--clearence' (did you mean '--clearance'?"),
                (['--threads', '2'], "no verb is given before '--threads'"),
                (['clash', 'diff', 'a', 'b', 'c'], "'c' is one word too many")):
            with self.subTest(arguments):
                done = self.run_strake(*arguments)
                self.assertEqual((done.returncode, done.stdout), (2, ''))
                self.assertIn(stated, done.stderr)

    def test_wrong_command_lines_are_usage_errors_that_state_what(self):
        self.two_files()
        for arguments, stated in (
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
                (['info', 'a.obj', '--sag', '0'], '1um or more'),
                (['clash', 'a.obj', '--clearance', '25'], '25mm'),
                (['clash', 'a.obj', '--clearance', '-1mm'], 'negative'),
                (['clash', 'a.obj', '--touch-gap', 'nan'], 'nan'),
                (['clash', 'a.obj', '--clearance', ''], '--clearance: the value is empty'),
                (['info', 'a.obj', '--threads', ''], '--threads: the value is empty'),
                (['info', ''], 'FILE: the value is empty'),
                (['draw', 'a.obj', '-o', 'a.svg', '--limits', ''], '--limits: the value is empty'),
                (['info', 'a.obj', '--sag', '1e-30mm'], '1um or more'),
                (['clash', 'a.obj', '--fail-on', 'sometimes'], 'hit|contact'),
                (['clash', 'a.obj', '--distribution', 'fair'], 'planned|in-order|equal-ranges'),
                (['info', 'a.obj', '--distribution', 'planned'], '--distribution'),
                (['clash', 'a.obj', '-o', 'report.doc'], '.json or .csv or '),
                (['clash', 'a.obj', '--a', 'name ='], '--a, selection, column 7'),
                (['clash', 'a.obj', '--b', 'x', '--self'], '--b excludes --self'),
                (['clash', 'a.obj', '--max-pairs', 'all'], '--max-pairs'),
                (['draw', 'a.obj'], '-o FILE.svg'),
                (['draw', 'a.obj', '-o', 'a.dwg'], '.svg or .pdf or .dxf or .json'),
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
                self.assertIn(stated, done.stderr)
                self.assertIn('strake: error: ', done.stderr)
                self.assertEqual(done.stdout, '')
        self.assertEqual(self.files(), ['a.obj', 'b.obj'])

    def test_former_names_of_options_work_and_are_not_shown(self):
        self.two_files()
        shown = self.run_strake('clash', '--help').stdout + self.run_strake('completion', 'bash').stdout
        for former, name in (('--most-pairs', '--max-pairs'), ('--most-spheres', '--max-spheres'), ('--bcf-most', '--bcf-max-topics')):
            with self.subTest(former):
                self.assertEqual(self.run_strake('clash', 'a.obj', '-o', 'x.bcf', former, '1').returncode, 0)
                self.assertIn(name, self.run_strake('clash', 'a.obj', '-o', 'x.bcf', former, 'all').stderr)
                self.assertIn(name, shown)
                self.assertNotIn(former, shown)

    def test_what_makes_no_sense_is_stated_before_a_model_is_read(self):
        for arguments, stated in (
                (['clash', 'missing.obj', '--clearance', '1e300mm'], '--clearance: '),
                (['clash', 'missing.obj', '--contact-distance', '2km'], '--contact-distance: '),
                (['draw', 'missing.obj', '-o', 'a.svg', '--direction', '1,1,1', '--up', '2,2,2'], '--up: '),
                (['draw', 'missing.obj', '-o', 'a.svg', '--view', 'top', '--up', '0,0,-5'], 'parallel')):
            with self.subTest(arguments):
                done = self.run_strake(*arguments)
                self.assertEqual(done.returncode, 2, done.stderr)
                self.assertIn(stated, done.stderr)
                self.assertNotIn('missing.obj', done.stderr)

    def test_an_option_takes_one_value_and_leaves_the_next_word_alone(self):
        self.two_files()
        done = self.run_strake('clash', '-o', 'x.json', 'a.obj', 'b.obj')
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual([f['label'] for f in json.loads((self.folder / 'x.json').read_text())['files']],
                         ['a.obj', 'b.obj'])
        done = self.run_strake('draw', '--select', 'a0', 'a.obj', '-o', 'x.svg')
        self.assertEqual(done.returncode, 0, done.stderr)


if __name__ == '__main__':
    main()
