#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""rules_test.py STRAKE EXAMPLES: rules files on whole models, against what plain runs and the files say."""
import csv
import io
import json
import os
import re
import struct
import sys
import unittest
from pathlib import Path

from scenario import Scenario, bar_between_walls, cube, main

EXAMPLES = None


def cubes(*places):
    """An OBJ file: cubes of side 100 at places along x, named c0, c1 ..."""
    return ''.join(cube(f'c{number}', number, (at, 0, 0), 100) for number, at in enumerate(places))


class Rules(Scenario):
    def report(self, *arguments):
        done = self.run_strake('clash', *arguments, '--json')
        self.assertEqual(done.returncode, 0, done.stderr)
        return json.loads(done.stdout)


class Small(Rules):
    SETTINGS = ['--unit', 'mm', '--up-axis', 'z']

    def test_what_is_allowed_fails_nothing_and_keeps_its_class(self):
        self.write('m.obj', cubes(0, 90))
        self.write('r.toml', '[[allowed]]\nname = "glued"\na = "c0"\nb = "c1"\nmax_depth = "11mm"\n')
        run = ['clash', 'm.obj', *self.SETTINGS, '--fail-on', 'contact']
        self.assertEqual(self.run_strake(*run).returncode, 1)
        done = self.run_strake(*run, '--rules', 'r.toml', '--stats')
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn('0 hits, 0 contacts, 0 clearance violations, 1 allowed', done.stdout)
        self.assertRegex(done.stderr, r'pairs that may be allowed\s+1\n')
        result, = self.report('m.obj', *self.SETTINGS, '--rules', 'r.toml')['results']
        self.assertEqual((result['class'], result['allowed'], result['d_mm']), ('HIT', 'glued', -10))

    def test_a_place_that_a_rule_allows_of_a_pair_that_it_does_not_is_reported(self):
        # A bar between two walls of one object, in both of them; the one has a sleeve.
        self.write('m.obj', bar_between_walls())
        self.write('r.toml', '[[allowed]]\nname = "sleeve"\na = "bar"\nb = "walls"\nmax_depth = "any"\n'
                             'region = { min = ["50mm", "-1m", "-1m"], max = ["1m", "1m", "1m"] }\n')
        run = ['m.obj', *self.SETTINGS]
        plain = self.report(*run)['results'][0]
        self.assertEqual((plain['region_count'], 'allowed_region_count' in plain), (2, False))
        document = self.report(*run, '--rules', 'r.toml', '-o', 'new.json', '-o', 'x.csv')
        result, = document['results']
        self.assertEqual((result['class'], result['region_count'], result['allowed_region_count']), ('HIT', 1, 1))
        self.assertNotIn('regions', result)
        place, = result['allowed_regions']
        self.assertEqual((place['allowed'], place['class'], place['d_mm']), ('sleeve', 'HIT', -10))
        self.assertEqual(document['tests'][0]['allowed'],
                         [{'rule': 'sleeve', 'candidates': 1, 'pairs': 0, 'places': 1}])
        done = self.run_strake('clash', *run, '--rules', 'r.toml', '--stats')
        self.assertIn('1 hit, 0 contacts, 0 clearance violations, 1 place of others allowed\n', done.stdout)
        self.assertRegex(done.stderr, r'allowed places of others\s+1\n')
        row, = csv.DictReader(io.StringIO((self.folder / 'x.csv').read_text(encoding='utf-8')))
        self.assertEqual((row['regions'], row['allowed_regions']), ('1', '1'))
        # Against a run under a rule that allows nothing of it, which has a test of the same name.
        self.write('r.toml', '[[allowed]]\nname = "sleeve"\na = "bar"\nb = "walls"\nmax_depth = "1mm"\n')
        self.report(*run, '--rules', 'r.toml', '-o', 'old.json')
        diff = self.run_strake('clash', 'diff', 'old.json', 'new.json', '-o', 'diff.json')
        self.assertIn('HIT -10.000 at 1 place, 1 more allowed (was HIT -10.000 at 2 places)', diff.stdout)
        entry, = json.loads((self.folder / 'diff.json').read_text(encoding='utf-8'))['changed']
        self.assertEqual((entry['region_count'], entry['allowed_region_count'], entry['was']['region_count']),
                         (1, 1, 2))
        # A result from which the count was cut contradicts itself.
        text = (self.folder / 'new.json').read_text(encoding='utf-8')
        self.write('cut.json', text.replace('"allowed_region_count": 1', '"allowed_region_count": 2'))
        done = self.run_strake('clash', 'diff', 'old.json', 'cut.json')
        self.assertEqual(done.returncode, 3)
        self.assertIn('counts 1 places that rules allow, but "results" has 2', done.stderr)

    def test_what_a_test_does_not_report_is_counted_and_is_not_gone(self):
        # c0 and c1 have a tenth of a litre in common; c2 and c3 are one cube of a litre twice.
        self.write('m.obj', cubes(0, 90, 500, 500))
        run = ['m.obj', *self.SETTINGS, '--rules', 'r.toml']
        self.write('r.toml', '[[test]]\nname = "t"\n')
        self.assertNotIn('not_reported', self.report(*run, '-o', 'all.json')['tests'][0])
        self.write('r.toml', '[[test]]\nname = "t"\nrelations = ["duplicate", "through"]\nmin_volume = "0.5l"\n')
        document = self.report(*run, '-o', 'some.json')
        test, = document['tests']
        self.assertEqual([(r['a']['name'], r['b']['name']) for r in document['results']], [('c2', 'c3')])
        self.assertEqual(test['settings']['relations'], ['INTERFERE', 'DUPLICATE', 'CROSS'])
        self.assertEqual(test['settings']['min_volume_mm3'], 500000)
        none = {'HIT': 0, 'CONTACT': 0, 'CLEARANCE_VIOLATION': 0, 'ALLOWED': 0}
        self.assertEqual(test['not_reported'], [{'by': 'relation', 'counts': none},
                                                {'by': 'volume', 'counts': {**none, 'HIT': 1}}])
        self.assertEqual(test['counts'], {**none, 'HIT': 1})
        done = self.run_strake('clash', *run, '--fail-on', 'hit')
        self.assertEqual(done.returncode, 1)
        self.assertIn('1 hit, 0 contacts, 0 clearance violations, 1 result not reported by volume\n', done.stdout)
        reported = json.loads(self.run_strake('clash', 'diff', 'all.json', 'some.json', '--json').stdout)
        self.assertEqual(reported['counts'], {'new': 0, 'changed': 0, 'same': 1, 'gone': 0, 'cannot_tell': 1})
        self.assertIn('may be among the 1 results that the test does not report', reported['cannot_tell'][0]['why'])
        self.assertEqual([(s['setting'], s['old']) for s in reported['settings_changed']],
                         [('min_volume_mm3', None), ('relations', None)])
        self.write('r.toml', '[[test]]\nname = "t"\nrelations = "inside"\n')
        done = self.run_strake('clash', *run, '--fail-on', 'hit')
        self.assertEqual(done.returncode, 0, 'what is not reported fails nothing')
        self.assertIn('0 hits, 0 contacts, 0 clearance violations, 2 results not reported by relation\n', done.stdout)

    def test_rules_by_relation_and_volume_need_the_exact_narrow_phase(self):
        self.write('m.obj', cubes(0, 90))
        for table in ('[[test]]\nname = "t"\nrelations = "through"\n',
                      '[[allowed]]\nname = "x"\na = "*"\nb = "*"\nmax_volume = "1l"\n'):
            self.write('r.toml', table)
            done = self.run_strake('clash', 'm.obj', *self.SETTINGS, '--rules', 'r.toml', '--narrow-phase',
                                   'sphere-subdivision')
            self.assertEqual(done.returncode, 2, done.stderr)
            self.assertIn('leave out --narrow-phase, or these rules', done.stderr)

    def test_exempted_pairs_are_listed_where_requested(self):
        self.write('m.obj', cubes(0, 90, 180))
        self.write('r.toml', '[[exempt]]\nname = "a pair"\na = "c0"\nb = "c1"\n')
        run = ['m.obj', *self.SETTINGS, '--rules', 'r.toml']
        plain = self.report(*run)
        self.assertNotIn('exempted', plain)
        self.assertEqual(plain['tests'][0]['exempted'], [{'rule': 'a pair', 'pairs': 1}])
        listed = self.report(*run, '--list-exempted')
        pair, = listed['exempted']
        self.assertEqual((pair['rule'], pair['a']['name'], pair['b']['name']), ('a pair', 'c0', 'c1'))
        self.assertEqual(listed['results'], plain['results'])
        self.assertEqual(self.run_strake('clash', *run, '--list-exempted', '-o', 'x.csv').returncode, 0)
        rows = list(csv.DictReader(io.StringIO((self.folder / 'x.csv').read_text(encoding='utf-8'))))
        self.assertEqual([(row['a_name'], row['b_name'], row['class'], row['exempted_by']) for row in rows],
                         [('c1', 'c2', 'HIT', ''), ('c0', 'c1', 'EXEMPTED', 'a pair')])

    def test_faults_of_a_rules_file_are_reported_before_a_model_is_read(self):
        self.write('r.toml', '[defaults]\nclearance = 25\n')
        done = self.run_strake('clash', 'missing.obj', '--rules', 'r.toml')
        self.assertEqual(done.returncode, 3)
        self.assertIn("r.toml, line 2, column 13: 'clearance' of [defaults]", done.stderr)
        self.assertNotIn('missing.obj', done.stderr)
        done = self.run_strake('clash', 'missing.obj', '--rules', 'none.toml')
        self.assertEqual(done.returncode, 3)
        self.assertIn('none.toml', done.stderr)

    def test_the_command_line_leaves_to_the_file_what_the_file_states(self):
        self.write('r.toml', '')
        for option in (['--clearance', '1mm'], ['--touch-gap', '1mm'], ['--touch-overlap', '1mm'],
                       ['--thickness-cap', 'off'], ['--contact-distance', '1mm'], ['--a', 'x'], ['--b', 'x'],
                       ['--self']):
            done = self.run_strake('clash', 'missing.obj', '--rules', 'r.toml', *option)
            self.assertEqual(done.returncode, 2, option)
            self.assertIn('excludes', done.stderr)
        done = self.run_strake('clash', 'missing.obj', '--list-exempted')
        self.assertEqual(done.returncode, 2)
        self.assertIn('--rules', done.stderr)
        self.write('rules.json', '')
        self.write('m.obj', cubes(0))
        done = self.run_strake('clash', 'm.obj', '--rules', 'rules.json', '-o', 'rules.json')
        self.assertEqual(done.returncode, 2)
        self.assertIn('overwritten', done.stderr)

    def test_the_order_of_objects_and_files_changes_nothing(self):
        self.write('r.toml', """
[defaults]
clearance = "25mm"
[[discipline]]
name = "low"
select = "name ~ 'c[0-2]'"
[[discipline]]
name = "high"
select = "*"
[matrix.cells.low]
high = { clearance = "5mm" }
[[exempt]]
name = "neighbours"
a = "c0"
b = "c1"
[[allowed]]
name = "meant"
a = "c1"
b = "c2"
max_depth = "any"
""")
        places = [0, 90, 180, 283, 390, 390]
        blocks = [block for block in re.split(r'(?m)^(?=o )', cubes(*places)) if block]
        expected = None
        for order in ([0, 1, 2, 3, 4, 5], [5, 3, 1, 4, 2, 0], [2, 4, 0, 5, 1, 3]):
            text = ''
            for at, number in enumerate(order):
                shift = 8 * (at - number)
                text += re.sub(r'(?m)^f .*$', lambda line, by=shift: 'f ' + ' '.join(
                    str(int(corner) + by) for corner in line[0].split()[1:]), blocks[number])
            self.write('a.obj', text)
            self.write('b.obj', cubes(700, 790))
            for files in (['a.obj', 'b.obj'], ['b.obj', 'a.obj']):
                done = self.run_strake('clash', *files, *self.SETTINGS, '--rules', 'r.toml', '--list-exempted',
                                       '--json')
                self.assertEqual(done.returncode, 0, done.stderr)
                expected = expected or done.stdout
                self.assertEqual(done.stdout, expected, (order, files))
        report = json.loads(expected)
        self.assertEqual([(r['a']['name'], r['b']['name'], r['class'], r.get('allowed')) for r in report['results']],
                         [('c1', 'c2', 'HIT', 'meant'), ('c2', 'c3', 'CLEARANCE_VIOLATION', None),
                          ('c3', 'c4', 'CLEARANCE_VIOLATION', None), ('c3', 'c5', 'CLEARANCE_VIOLATION', None),
                          ('c4', 'c5', 'HIT', None)])
        self.assertEqual(report['tests'][0]['exempted'],
                         [{'rule': 'matrix', 'pairs': 0}, {'rule': 'neighbours', 'pairs': 2}])

    def test_the_snippets_of_the_documentation_are_one_file_that_runs(self):
        text = (EXAMPLES.parent / 'docs' / 'rules.md').read_text(encoding='utf-8')
        snippets = re.findall(r'(?s)```toml\n(.*?)```', text)
        self.assertEqual(len(snippets), 8)
        self.write('r.toml', ''.join(snippets))
        self.write('m.obj', cubes(0, 90))
        report = self.report('m.obj', *self.SETTINGS, '--rules', 'r.toml')
        self.assertEqual([test['name'] for test in report['tests']],
                         ['disciplines', 'hvac against steel', 'things twice', 'what is worth a meeting',
                          'insulated pipes'])
        self.assertEqual(report['tests'][1]['settings']['clearance_mm'], 50)
        self.assertEqual(report['tests'][2]['settings']['relations'], ['DUPLICATE'])
        self.assertEqual(report['tests'][4]['settings']['clearance_attribute'], 'INSU')

    def test_each_example_of_the_documentation_runs_by_itself(self):
        text = (EXAMPLES.parent / 'docs' / 'rules.md').read_text(encoding='utf-8')
        examples = re.findall(r'(?m)((?:^    .*\n)+)', text)
        tables = [re.sub('(?m)^    ', '', example) for example in examples if example.lstrip().startswith('[[')]
        self.assertGreaterEqual(len(tables), 5)
        self.write('m.obj', cubes(0, 90))
        for table in tables:
            with self.subTest(table=table):
                self.write('r.toml', table)
                self.report('m.obj', *self.SETTINGS, '--rules', 'r.toml')

    def test_a_result_names_its_rules_file(self):
        self.write('m.obj', cubes(0, 90))
        plain = self.report('m.obj', *self.SETTINGS)
        self.assertNotIn('rules', plain)
        self.write('r.toml', '[[test]]\nname = "t"\n')
        first = self.report('m.obj', *self.SETTINGS, '--rules', 'r.toml')
        self.assertEqual(first['rules']['file'], 'r.toml')
        self.write('r.toml', '# nothing more\n[[test]]\nname = "t"\n')
        second = self.report('m.obj', *self.SETTINGS, '--rules', str(self.folder / 'r.toml'))
        self.assertEqual(second['rules']['file'], 'r.toml', 'without folders')
        self.assertNotEqual(first['rules']['hash'], second['rules']['hash'])
        self.assertEqual(first['hash'], second['hash'], 'the hash is that of the results')

    def test_a_rule_that_matches_nothing_is_named_in_both_places(self):
        self.write('m.obj', cubes(0))
        self.write('r.toml', '[[exempt]]\nname = "old"\na = "new*"\nb = "ghost*"\n[[test]]\nname = "t"\na = "x"\n')
        done = self.run_strake('clash', 'm.obj', '--rules', 'r.toml', '--json')
        messages = [f"{m['code']}: {m['where']}: {m['message']}" for m in json.loads(done.stdout)['messages']]
        for stated in ("rule-matches-nothing: r.toml, line 3: [[exempt]] 'old', a: 'new*' picks no object",
                     "rule-matches-nothing: r.toml, line 4: [[exempt]] 'old', b: 'ghost*' picks no object",
                     "rule-matches-nothing: r.toml, line 7: [[test]] 't', a: 'x' picks no object",
                     "empty-set: test 't', set A, x: a set without objects clashes with nothing"):
            self.assertIn(stated, done.stderr)
            self.assertIn(stated, messages)

    def test_a_test_that_compares_nothing_is_no_success(self):
        self.write('m.obj', cubes(0, 500))
        self.write('r.toml', '[[test]]\nname = "t"\na = "c0"\nb = "c1"\n[[test]]\nname = "u"\na = "x"\n')
        stated = "nothing was compared: set A of test 'u' is empty (x)\n"
        for extra, code in (['--fail-on', 'hit'], 1), (['--strict'], 4), ([], 0):
            with self.subTest(extra=extra):
                done = self.run_strake('clash', 'm.obj', '--rules', 'r.toml', '--quiet', *extra)
                self.assertEqual(done.returncode, code, done.stderr)
                self.assertEqual(done.stderr.endswith(stated), code != 0, done.stderr)

    def test_a_discipline_without_objects_stops_strict_where_it_is_checked(self):
        self.write('m.obj', cubes(0, 500))
        disciplines = ''.join(f'[[discipline]]\nname = "{name}"\nselect = "{select}"\n'
                              for name, select in (('one', 'c*'), ('two', 'x')))
        for missing, code in ('checked', 4), ('not checked', 0):
            self.write('r.toml', f'{disciplines}[matrix]\nmissing = "{missing}"\n[matrix.cells.one]\none = {{}}\n')
            run = ['clash', 'm.obj', '--rules', 'r.toml', '--quiet']
            done = self.run_strake(*run, '--strict')
            self.assertEqual(done.returncode, code, done.stderr)
            self.assertEqual("discipline 'two' of the matrix is empty" in done.stderr, code == 4, done.stderr)
            self.assertEqual(self.run_strake(*run, '--fail-on', 'hit').returncode, 0)

    def test_a_rule_without_a_use_is_named_in_both_places(self):
        self.write('m.obj', cubes(0, 90, 500))
        self.write('r.toml', ''.join(f'[[exempt]]\nname = "{name}"\na = "c0"\nb = "{b}"\n'
                                     for name, b in (('near', 'c1'), ('again', 'c1'), ('far', 'c2'))))
        done = self.run_strake('clash', 'm.obj', *self.SETTINGS, '--rules', 'r.toml', '--json')
        messages = [f"{m['code']}: {m['where']}: {m['message']}" for m in json.loads(done.stdout)['messages']]
        for stated in ("rule-shadowed: r.toml, line 5: [[exempt]] 'again': it does nothing: what it concerns is "
                     "exempted by earlier rules, as 'near'",
                     "rule-matches-nothing: r.toml, line 9: [[exempt]] 'far': it concerns no two objects that are "
                     "within reach of each other"):
            self.assertIn(stated, done.stderr)
            self.assertIn(stated, messages)
        self.assertEqual(done.stderr.count('warning rule-'), 2, done.stderr)


def paths_of_glb(file):
    """Path of each node with a mesh, by its name, from the file itself."""
    data = file.read_bytes()
    document = json.loads(data[20:20 + struct.unpack('<I', data[12:16])[0]])
    paths = {}

    def walk(node, above):
        here = document['nodes'][node]
        if 'mesh' in here:
            paths[here['name']] = above
        for child in here.get('children', []):
            walk(child, above + (here['name'],))

    for root in document['scenes'][0]['nodes']:
        walk(root, ())
    return paths


class Ship(Rules):
    """The example file on a generated ship, against a plain run and a second reading of the rules."""

    SUPPORTS, SEATS = re.compile('SUP-|HGR-'), re.compile('FND-|BED-')
    ENGINE = re.compile('(ENG|CYL|MAN|MPT|MNT|BED)-')
    CLEARANCE = {('piping', 'steel'): 10, ('others', 'steel'): 0}

    def setUp(self):
        super().setUp()
        done = self.run_strake('generate', 'ship', '--objects', 1200, '--seed', 7, '-o', 'ship.glb')
        self.assertEqual(done.returncode, 0, done.stderr)
        self.paths = paths_of_glb(self.folder / 'ship.glb')
        self.rules = EXAMPLES / 'ship_rules.toml'

    def discipline(self, name):
        groups = self.paths[name]
        if 'STRUCTURE' in groups or 'HULL' in groups:
            return 'steel'
        return 'piping' if 'PIPING' in groups else 'machinery' if 'MACHINERY' in groups else 'others'

    def exemption(self, a, b):
        disciplines = sorted((self.discipline(a), self.discipline(b)))
        if disciplines == ['steel', 'steel']:
            return 'matrix'
        both = [self.paths[name] for name in (a, b) if self.ENGINE.match(name) and 'MACHINERY' in self.paths[name]]
        if len(both) == 2 and both[0] == both[1]:
            return 'one engine'
        return 'flanges of one joint' if a.startswith('FLG-') and b.startswith('FLG-') else None

    def allowance(self, a, b, result):
        def between(test_a, test_b):
            return test_a(a) and test_b(b) or test_a(b) and test_b(a)

        def piping(name):
            return self.discipline(name) == 'piping'

        if between(piping, lambda n: piping(n) and self.SUPPORTS.match(n)) and result['d_range_mm'][0] >= -0.5005:
            return 'pipes on their supports'
        x, y, z = result['point_mm']
        inside = -1000 <= x <= 500000 and -50000 <= y <= 50000 and 0 <= z <= 6000
        if inside and result['class'] != 'HIT' and between(lambda n: n.startswith('MNT-'), self.SEATS.match):
            return 'seats of engines'
        return None

    def expected(self):
        results, exempted = {}, {}
        for r in self.report('ship.glb', '--clearance', '25mm')['results']:
            a, b = r['a']['name'], r['b']['name']
            rule = self.exemption(a, b)
            disciplines = tuple(sorted((self.discipline(a), self.discipline(b))))
            if rule:
                exempted[a, b] = rule
            elif r['class'] != 'CLEARANCE_VIOLATION' or r['d_mm'] < self.CLEARANCE.get(disciplines, 25):
                results[a, b] = (r['class'], r['d_mm'], self.allowance(a, b, r))
        return results, exempted

    def test_the_example_states_what_a_second_reading_states(self):
        report = self.report('ship.glb', '--rules', self.rules, '--list-exempted')
        self.assertEqual([test['name'] for test in report['tests']], ['disciplines', 'pipes among themselves'])
        results, exempted = self.expected()
        got = {(r['a']['name'], r['b']['name']): (r['class'], r['d_mm'], r.get('allowed'))
               for r in report['results'] if r['test'] == 0}
        self.assertEqual(got, results)
        listed = {(p['a']['name'], p['b']['name']): p['rule'] for p in report['exempted'] if p['test'] == 0}
        # Pairs within reach that clash nowhere are exempted as well.
        self.assertEqual({pair: listed.get(pair) for pair in exempted}, exempted)
        self.assertEqual({pair: self.exemption(*pair) for pair in listed}, listed)
        test = report['tests'][0]
        for rule in test['exempted']:
            self.assertEqual(rule['pairs'], list(listed.values()).count(rule['rule']))
            self.assertGreater(rule['pairs'], 0)
        allowed = [label for _, _, label in results.values()]
        for rule in test['allowed']:
            self.assertEqual(rule['pairs'], allowed.count(rule['rule']))
            self.assertGreater(rule['pairs'], 0)
        self.assertEqual(sum(test['counts'].values()), len(results))
        for cell in test['matrix']['cells']:
            inside = [r for pair, r in results.items()
                      if sorted(map(self.discipline, pair)) == sorted((cell['a'], cell['b']))]
            if cell['checked']:
                self.assertEqual(sum(cell['counts'].values()), len(inside), cell)
            else:
                self.assertEqual(inside, [])
        for r in report['results']:
            if r['test'] == 0:
                self.assertEqual(r['a']['discipline'], self.discipline(r['a']['name']))

    def test_same_bytes_for_any_team_and_broad_phase(self):
        expected = None
        for more in ([], ['--threads', 1], ['--threads', 3], ['--threads', 64], ['--broad-phase', 'all-pairs']):
            done = self.run_strake('clash', 'ship.glb', '--rules', self.rules, '--list-exempted', *more, '-o',
                                   'x.json', '-o', 'x.csv')
            self.assertEqual(done.returncode, 0, done.stderr)
            got = [(self.folder / name).read_bytes() for name in ('x.json', 'x.csv')]
            expected = expected or got
            self.assertEqual(got, expected, more)


@unittest.skipUnless('STRAKE_DATA' in os.environ, 'STRAKE_DATA names no folder of real models')
class RealModels(Rules):
    def setUp(self):
        super().setUp()
        self.data = Path(os.environ['STRAKE_DATA']) / 'rvm'

    def test_a_matrix_of_files_is_what_each_pair_of_files_gives(self):
        names = ['ARCH', 'HVAC', 'MECH', 'SAFE']
        files = {name: self.data / 'vegarringdal_rvm2glb' / f'HA-{name}.RVM' for name in names}
        clearance = {('ARCH', 'HVAC'): '50mm', ('MECH', 'SAFE'): '3mm'}
        rules = '[defaults]\nclearance = "10mm"\n'
        for name in names:
            rules += f'[[discipline]]\nname = "{name}"\nselect = "file = HA-{name}.RVM"\n'
        rules += '[matrix]\n'
        for name in names:
            rules += f'[matrix.cells.{name}]\n{name} = "not checked"\n'
            for (a, b), value in clearance.items():
                rules += f'{b} = {{ clearance = "{value}" }}\n' if a == name else ''
        self.write('ha.toml', rules)
        report = self.report(*files.values(), '--rules', 'ha.toml')
        shown = ('class', 'relation', 'd_mm', 'd_range_mm', 'point_mm', 'flags')
        found = 0
        for i, a in enumerate(names):
            for b in names[i + 1:]:
                plain = self.report(files[a], files[b], '--clearance', clearance.get((a, b), '10mm'))
                expected = [[r['a']['id'], r['b']['id'], *(r[key] for key in shown)] for r in plain['results']]
                got = [[r['a']['id'], r['b']['id'], *(r[key] for key in shown)] for r in report['results']
                       if (r['a']['discipline'], r['b']['discipline']) == (a, b)]
                self.assertEqual(got, expected, (a, b))
                found += len(got)
        self.assertEqual(found, len(report['results']))
        self.assertGreater(found, 300)

    def test_components_at_the_ends_of_real_branches_are_connected(self):
        model = self.data / 'benvautrin_pmuc' / 'plm-sample_11072013.rvm'

        def exempted(inherited):
            self.write('r.toml', '[[connected]]\nname = "joints"\nattributes = ["Href", "Tref"]\n'
                       f'inherited = "{inherited}"\n')
            report = self.report(model, '--rules', 'r.toml', '--list-exempted')
            return {frozenset((pair['a']['name'], pair['b']['name'])) for pair in report['exempted']}

        own, ends = exempted('none'), exempted('ends')
        self.assertEqual(len(own), 7, 'branches that have tubes are objects with references of their own')
        self.assertEqual(ends - own, {frozenset(pair) for pair in (
            ('/-ART1010TYB0001', '/-ART1106RT-'),
            ('/-ART1010TYB0002', 'WELD 2 of BRANCH /-ART1010TYB0001'),
            ('/DVX1201GLB0001T001', 'GASKET 1 of BRANCH /DVX1201GLB0002'),
            ('TEE 1 of BRANCH /-ART1010TYB0002', 'WELD 1 of BRANCH /-ARTXXXTYB0001'),
            ('FLANGE 1 of BRANCH /-ART1010TYB0002', 'NOZZLE 2 of SUBEQUIPMENT 3 of EQUIPMENT /-ART1101PO-'),
            ('FLANGE 1 of BRANCH /-ARTXXXTYB0001', 'NOZZLE 1 of SUBEQUIPMENT 3 of EQUIPMENT /-ART1111PO-'),
            ('TEE 1 of BRANCH /-HZ-0501CAA1A--', 'REDUCER 1 of BRANCH /-HZ-0501CAA2A--'))})
        self.assertLessEqual(own, ends)

    def test_obstruction_levels_of_a_real_attribute_file(self):
        model = self.data / 'equinor_rvmsharp' / 'WD1-PSUP.RVM'
        levels, name = {}, None
        for line in (model.with_suffix('.txt')).read_text(encoding='utf-8-sig', errors='replace').splitlines():
            if line.strip().startswith('NEW '):
                name = line.strip()[4:]
            elif line.strip().startswith('OBST:='):
                levels[name] = line.split(':=')[1].strip()
        self.assertEqual(set(levels.values()), {'0', '1', '2'})
        self.write('r.toml', '[obstruction]\nsoft_against_soft = false\n')
        plain = self.report(model)['results']
        ruled = self.report(model, '--rules', 'r.toml', '--list-exempted')
        word = {'0': 'none', '1': 'soft'}

        def level(side):
            return word.get(levels.get(side['name'], '2'), 'hard')

        def pair(r):
            return r['a']['id'], r['b']['id']

        kept = {pair(r) for r in plain if 'none' not in (level(r['a']), level(r['b'])) and
                (level(r['a']), level(r['b'])) != ('soft', 'soft')}
        self.assertEqual({pair(r) for r in ruled['results']}, kept)
        self.assertLess(len(kept), len(plain))
        self.assertEqual({pair(r) for r in plain} - kept, {pair(r) for r in plain} & {pair(r) for r in ruled['exempted']})
        for r in ruled['results']:
            self.assertEqual((r['a']['level'], r['b']['level']), (level(r['a']), level(r['b'])))


if __name__ == '__main__':
    EXAMPLES = Path(sys.argv.pop(2)).resolve()
    main()
