#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""profile_test.py STRAKE RULES: what profiles leave out of models of which is known what clashes in them."""
import json
import sys
from pathlib import Path

from scenario import Scenario, gltf, main

RULES = None
PROFILES = ['plant', 'ship', 'building']


# An elbow that ends in a pump of two boxes, which hits a beam.
PUMP = ('/SITE', {}, None, [('/ZONE', {}, None, [
    ('/100-B-1', {}, None, [('/100-B-1/B1', {'Href': '/P-101'}, None, [
        ('ELBOW 1 of BRANCH /100-B-1/B1', {}, 0, [])])]),
    ('/P-101', {}, None, [('BOX 1 of EQUIPMENT /P-101', {}, .09, []), ('BOX 2 of EQUIPMENT /P-101', {}, .18, [])]),
    ('/S-1', {}, None, [('SCTN 1 of STRUCTURE /S-1', {}, .27, [])])])])
LEFT_OUT = ('left out by profile plant: 1 pair (parts of one equipment, structure or branch), '
            '1 pair (joints of branches)\n')


class Profiles(Scenario):
    def report(self, *arguments):
        done = self.run_strake('clash', *arguments, '--json')
        self.assertEqual(done.returncode, 0, done.stderr)
        if '--rules' not in arguments:
            self.assertNotIn('rule-matches-nothing', done.stderr + done.stdout)
        return json.loads(done.stdout)

    def test_what_is_shown_is_the_file(self):
        for profile in PROFILES:
            self.assertEqual(self.text('rules', 'show', profile),
                             (RULES / f'{profile}.toml').read_text(encoding='utf-8'))
        self.assertEqual([line.split()[0] for line in self.text('rules', 'list').splitlines()], PROFILES)

    def test_a_pump_with_its_pipe_and_a_beam(self):
        self.write('pump.gltf', gltf(PUMP))
        self.assertEqual(self.report('pump.gltf')['tests'][0]['counts']['HIT'], 3)
        done = self.run_strake('clash', 'pump.gltf', '--profile', 'plant')
        self.assertIn('1 hit, 0 contacts, 0 clearance violations\n' + LEFT_OUT, done.stdout)
        report = self.report('pump.gltf', '--profile', 'plant', '--list-exempted')
        result, = report['results']
        self.assertEqual({result[side]['name'] for side in 'ab'},
                         {'BOX 2 of EQUIPMENT /P-101', 'SCTN 1 of STRUCTURE /S-1'})
        self.assertEqual({pair['rule'] for pair in report['exempted']},
                         {'joints of branches', 'parts of one equipment, structure or branch'})
        self.assertEqual((report['rules']['file'], report['rules']['profile']), ('plant.toml', 'plant'))

    def test_the_rules_as_a_file_state_the_same(self):
        self.write('pump.gltf', gltf(PUMP))
        self.write('own.toml', self.text('rules', 'show', 'plant'))
        own, profile = (self.report('pump.gltf', *rules) for rules in (['--rules', 'own.toml'], ['--profile', 'plant']))
        self.assertEqual(own['results'], profile['results'])
        self.assertEqual(own['tests'][0]['exempted'], profile['tests'][0]['exempted'])
        self.assertNotIn('profile', own['rules'])

    def test_sets_and_tolerances_stay_those_of_the_command_line(self):
        self.write('pump.gltf', gltf(PUMP))
        run = ['pump.gltf', '--profile', 'plant', '--a', 'SCTN*', '--clearance', '90mm']
        # The beam is 80 mm from the pump's other box.
        self.assertEqual([result['class'] for result in self.report(*run)['results']], ['CLEARANCE_VIOLATION', 'HIT'])
        self.assertEqual(self.report(*run, '--b', "name = 'BOX 1*'")['tests'][0]['counts']['HIT'], 0)

    def test_space_kept_free_and_insulation(self):
        self.write_rvm('m.rvm', [('/A', (0, 0, 0)), ('/B', (90, 0, 0), 'OBST'), ('/C', (180, 0, 0), 'OBST'),
                                 ('/D', (0, 90, 0), 'INSU')])
        self.assertEqual(self.report('m.rvm')['results'], [])
        report = self.report('m.rvm', '--profile', 'plant')
        reported = {(r['a']['name'], r['b']['name']): (r['class'], r['a']['level'], r['b']['level'])
                for r in report['results']}
        self.assertEqual(reported[('/A', '/B')], ('HIT', 'hard', 'soft'))
        self.assertEqual(reported[('/A', '/D')], ('HIT', 'hard', 'insulation'))
        self.assertNotIn(('/B', '/C'), reported)
        line = self.text('clash', 'm.rvm', '--profile', 'plant').splitlines()[-1]
        self.assertIn('1 pair (soft against soft)', line)
        self.assertIn('; with space kept free: ', line)
        self.assertIn('; with insulation: ', line)

    def test_without_a_profile_nothing_changes(self):
        self.write('pump.gltf', gltf(PUMP))
        for output in ([], ['--json']):
            self.assertEqual(self.text('clash', 'pump.gltf', *output),
                             self.text('clash', 'pump.gltf', '--profile', 'none', *output))
        self.assertIn('left out by profile building: nothing\n',
                      self.text('clash', 'pump.gltf', '--profile', 'building'))

    def test_a_hint_where_most_hits_are_of_one_kind(self):
        tank = [(f'BOX {i} of EQUIPMENT /T-1', {}, i * .09, []) for i in range(25)]
        pump = [(f'BOX {i} of EQUIPMENT /P-1', {}, i * .09, []) for i in range(25)]
        within = 'lie between parts of one assembly: --group-by assembly has a line for each; --profile plant or'

        def site(*equipment):
            return gltf(('/SITE', {}, None, [('/ZONE', {}, None, [(name, {}, None, boxes) for name, boxes in equipment])]))

        self.write('tank.gltf', site(('/T-1', tank)))
        self.assertIn(f'24 of 24 hits {within}', self.run_strake('clash', 'tank.gltf').stderr)
        for more in (['--quiet'], ['--profile', 'plant'], ['--profile', 'none']):
            self.assertNotIn('of 24 hits', self.run_strake('clash', 'tank.gltf', *more).stderr)
        # Each box in its like, and in the neighbours of that: two files of one thing.
        self.write('pump.gltf', site(('/P-1', pump)))
        done = self.run_strake('clash', 'tank.gltf', 'pump.gltf')
        self.assertIn('73 of 73 hits lie between /T-1 and /P-1: --group-by assembly makes them one line\n',
                      done.stderr.replace('/P-1 and /T-1', '/T-1 and /P-1'))
        table = self.text('clash', 'tank.gltf', 'pump.gltf', '--group-by', 'assembly')
        self.assertRegex(table, r'HIT +-\d+[.]\d+ +73 +[0-9.]+ +-?\d+ +-?\d+ +-?\d+ +/(P-1 and /T-1|T-1 and /P-1)\n')

    def test_what_does_not_go_together(self):
        self.write('r.toml', '')
        for arguments, stated in ((['--profile', 'plant', '--rules', 'r.toml'], 'excludes'),
                                (['--profile', 'plnat'], 'plant'), (['--list-exempted'], '--profile'),
                                (['--profile', 'none', '--list-exempted'], '--profile')):
            done = self.run_strake('clash', 'missing.rvm', *arguments)
            self.assertEqual(done.returncode, 2, arguments)
            self.assertIn(stated, done.stderr)
        for arguments in (['rules'], ['rules', 'show'], ['rules', 'show', 'plnat']):
            self.assertEqual(self.run_strake(*arguments).returncode, 2, arguments)

    def test_no_planted_clash_of_a_ship_is_lost(self):
        for kind in ('usual', 'slender', 'dense', 'repeated', 'unlike'):
            for turned in ([], ['--turned']):
                with self.subTest(kind=kind, turned=turned):
                    done = self.run_strake('generate', 'ship', '--objects', 1200, '--seed', 7, '--kind', kind, *turned,
                                           '-o', 'ship.glb', '--truth', 'truth.json')
                    self.assertEqual(done.returncode, 0, done.stderr)
                    self.compare_with_truth()

    def compare_with_truth(self):
        truth = json.loads((self.folder / 'truth.json').read_text(encoding='utf-8'))
        planted = {(p['a'], p['b']): p['class'] for p in truth['pairs'] if p['class'] != 'CONTACT'}
        self.assertIn('HIT', planted.values())
        for profile in PROFILES:
            report = self.report('ship.glb', '--profile', profile, '--clearance', '25mm')
            reported = {(r['a']['name'], r['b']['name']): r['class'] for r in report['results'] if 'allowed' not in r}
            lost = {pair: cls for pair, cls in planted.items() if reported.get(pair) != cls}
            self.assertEqual(lost, {}, profile)
            test, = report['tests']
            self.assertEqual(sum(rule['pairs'] for rule in test['exempted']), 0, profile)
            # Half of the contacts are welds, and none of them a clash.
            contacts = truth['counts']['CONTACT'] - test['counts']['CONTACT']
            self.assertGreater(contacts, 900 if profile == 'ship' else -1, profile)


if __name__ == '__main__':
    RULES = Path(sys.argv.pop(2)).resolve()
    main()
