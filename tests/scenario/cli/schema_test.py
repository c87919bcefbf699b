#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""schema_test.py STRAKE SCHEMAS: everything that the program writes as JSON follows its schema."""
import json
import os
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

import jsonschema
from scenario import bar_between_walls, cube, rvm

STRAKE = SCHEMAS = None

# One sound tetrahedron, one open triangle, one inside out, a line, and an object that is nowhere.
ODD_OBJ = '''o sound
v 0 0 0
v 100 0 0
v 0 100 0
v 0 0 100
f 1 3 2
f 1 2 4
f 2 3 4
f 1 4 3
o open
f 1 2 4
o inside-out
v 20 20 20
v 120 20 20
v 20 120 20
v 20 20 120
f 5 6 7
f 5 8 6
f 6 8 7
f 5 7 8
o wire
l 1 2 3
o nowhere
v nan 0 0
f 9 1 2
'''


class Schemas(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.keep = tempfile.TemporaryDirectory(prefix='strake-schemas-')
        cls.folder = Path(cls.keep.name)
        (cls.folder / 'odd.obj').write_text(ODD_OBJ, encoding='utf-8')
        cls.run_strake('generate', 'ship', '--objects', 300, '--seed', 7, '-o', 'ship.glb', '--truth',
                       'truth.json')

    @classmethod
    def tearDownClass(cls):
        cls.keep.cleanup()

    @classmethod
    def run_strake(cls, *arguments, **more):
        done = subprocess.run([STRAKE, *map(str, arguments), '--quiet'], capture_output=True, text=True,
                              timeout=200, cwd=cls.folder, check=False, **more)
        if done.returncode != 0:
            raise AssertionError(f'{arguments}: exit {done.returncode}: {done.stderr}')
        return done.stdout

    def follows(self, text, name):
        """The document, which follows a schema that would refuse it with a key added or one left out."""
        schema = json.loads((SCHEMAS / f'{name}.schema.json').read_text(encoding='utf-8'))
        jsonschema.Draft202012Validator.check_schema(schema)
        validator = jsonschema.Draft202012Validator(schema)
        document = json.loads(text)
        for error in validator.iter_errors(document):
            self.fail(f'{name}: {"/".join(map(str, error.absolute_path))}: {error.message}')
        short = {k: v[:3] if isinstance(v, list) else v for k, v in document.items()}
        self.assertTrue(validator.is_valid(short))
        self.assertFalse(validator.is_valid({**short, 'no such key': 1}))
        for key in schema['required']:
            self.assertFalse(validator.is_valid({k: v for k, v in short.items() if k != key}), key)
        return document

    def test_info(self):
        ship = self.follows(self.run_strake('info', 'ship.glb', '--json'), 'info')
        self.assertGreaterEqual(ship['total']['objects'], 300)
        listed = self.follows(self.run_strake('info', 'ship.glb', '--objects', 3, '--json'), 'info')
        self.assertEqual(len(listed['objects']), 3)
        stating = self.follows(self.run_strake('info', 'odd.obj', 'ship.glb', '--attributes', '--json'), 'info')
        self.assertEqual([len(f['attributes']) > 1 for f in stating['files']], [False, True])
        odd = self.follows(self.run_strake('info', 'odd.obj', 'ship.glb', '--json'), 'info')
        self.assertEqual(len(odd['files']), 2)
        self.assertGreater(odd['skipped'], 0)
        self.assertEqual(odd['files'][0]['inverted'], 1)

    def test_convert(self):
        reported = self.follows(self.run_strake('convert', 'odd.obj', 'ship.glb', 'whole.glb', '--json'), 'convert')
        self.assertEqual([reported['output'], reported['bytes']], ['whole.glb', (self.folder / 'whole.glb').stat().st_size])
        self.assertEqual([one['file'] for one in reported['files']], ['odd.obj', 'ship.glb'])
        info = json.loads(self.run_strake('info', 'odd.obj', 'ship.glb', '--json'))
        for word in ('objects', 'bodies', 'shapes'):
            self.assertEqual(reported[word], info['total'][word], word)
        self.assertGreater(reported['skipped'], 0)

    def test_kept_scenes(self):
        (self.folder / 'cache' / 'scenes').mkdir(parents=True)
        (self.folder / 'cache' / 'scenes' / 'x.scene').write_text('damaged')
        cache = {**os.environ, 'STRAKE_CACHE': str(self.folder / 'cache')}
        listed = self.follows(self.run_strake('cache', 'list', '--json', env=cache), 'cache-list')
        self.assertEqual([scene['scene'] for scene in listed['scenes']], ['x.scene'])
        cleared = self.follows(self.run_strake('cache', 'clear', '--json', env=cache), 'cache-clear')
        self.assertEqual(cleared['removed'], 1)

    def test_a_file_that_ends_early(self):
        (self.folder / 'cut.rvm').write_bytes(rvm([('/A', (0, 0, 0))], whole=False))
        reported = self.follows(self.run_strake('info', 'cut.rvm', '--json'), 'info')
        self.assertIs(reported['files'][0]['ends_early'], True)
        self.follows(self.run_strake('clash', 'cut.rvm', '--json'), 'clash')
        drawn = self.follows(self.run_strake('draw', 'cut.rvm', '--json'), 'view')
        self.assertEqual(drawn['files_ending_early'], ['cut.rvm'])

    def test_view_diff(self):
        for name, at in (('old', 0), ('new', 30)):
            (self.folder / 'pair.obj').write_text(cube('a', 0, (0, 0, 0), 100) + cube('b', 1, (50, 50, 50 + at), 100),
                                                  encoding='utf-8')
            self.run_strake('draw', 'pair.obj', '-o', f'{name}.json')
        diff = self.follows(self.run_strake('draw', 'diff', 'old.json', 'new.json', '--json'), 'view-diff')
        self.assertGreater(diff['counts']['new']['lines'], 0)
        self.assertTrue(any('other' in line for line in diff['lines']))
        self.assertTrue(any('was' in line for line in diff['lines']))
        self.follows(self.run_strake('draw', 'diff', 'old.json', 'old.json', '--json'), 'view-diff')
        (self.folder / 'far.obj').write_text(''.join(cube(f'c{n}', n, (150 * n, 10**6 * (n == 5), 0), 100) for n in range(6)),
                                             encoding='utf-8')
        for name, limits in (('whole', []), ('auto', ['--limits', 'auto'])):
            self.run_strake('draw', 'far.obj', '--view', 'top', *limits, '-o', f'{name}.json')
        self.assertGreater(self.follows(self.run_strake('draw', 'diff', 'whole.json', 'auto.json', '--json'),
                                        'view-diff')['left_out']['gone']['lines'], 0)

    def test_truth(self):
        truth = self.follows((self.folder / 'truth.json').read_text(encoding='utf-8'), 'truth')
        self.assertEqual(truth['generator']['seed'], 7)
        classes = [pair['class'] for pair in truth['pairs']]
        for name, count in truth['counts'].items():
            self.assertEqual(classes.count(name), count)
            self.assertGreater(count, 0)

    def test_clashes_of_a_project(self):
        self.run_strake('project', 'new', 'ship.strake', 'ship.glb')
        of_project = ['-p', 'ship.strake', '--json']
        self.follows(self.run_strake('clash', *of_project), 'clash')
        clashes = self.follows(self.run_strake('clash', 'list', *of_project), 'clash-list')['clashes']
        self.assertGreater(len(clashes), 10)
        key = clashes[0]['key']
        self.run_strake('clash', 'set', '-p', 'ship.strake', key, '--status', 'approved', '--comment', 'meant')
        self.assertEqual(self.follows(self.run_strake('clash', *of_project), 'clash')['decisions']['counts']['approved'], 1)
        runs = self.follows(self.run_strake('clash', 'history', *of_project), 'clash-list')['runs']
        self.assertEqual([run['how'] for run in runs], ['full', 'nothing'])
        events = self.follows(self.run_strake('clash', 'history', key, *of_project), 'clash-list')['events']
        self.assertEqual([event['after'] for event in events], ['approved'])

    def test_clash(self):
        report = self.follows(self.run_strake('clash', 'odd.obj', '--json'), 'clash')
        self.assertEqual({flag for result in report['results'] for flag in result['flags']},
                         {'OPEN', 'INVERTED'})
        report = self.follows(self.run_strake('clash', 'ship.glb', '--clearance', '25mm', '--contacts', 'count',
                                             '--json'), 'clash')
        test = report['tests'][0]
        self.assertEqual(test['unlisted']['CONTACT'], test['counts']['CONTACT'])
        self.assertEqual(sum(test['counts'].values()) - test['counts']['CONTACT'], len(report['results']))
        self.follows(self.run_strake('clash', 'ship.glb', '--a', 'PIP*', '--b', 'nobody', '--json'), 'clash')
        welded = self.follows(self.run_strake('clash', 'ship.glb', '--weld', '0.01mm', '--json'), 'clash')
        self.assertEqual(welded['tests'][0]['settings']['weld_mm'], .01)
        drawn = self.follows(self.run_strake('draw', 'odd.obj', '--weld', '0', '--json'), 'view')
        self.assertEqual(drawn['settings']['weld_mm'], 0)
        empty = self.follows(self.run_strake('clash', 'odd.obj', 'ship.glb', '--json'), 'clash')
        some = self.follows(self.run_strake('clash', 'ship.glb', '--class', 'hit', '--columns', '@discipline,@nothing',
                                           '--json'), 'clash')
        self.assertEqual(some['classes'], ['HIT'])
        self.assertIn('discipline', some['results'][0]['a']['attributes'])
        volumes = self.follows(self.run_strake('clash', 'ship.glb', '--volumes', '--json'), 'clash')
        self.assertTrue(all('volume_mm3' in r for r in volumes['results'] if r['class'] == 'HIT'))
        for by in 'element', 'proximity', 'test', 'files', 'assembly':
            grouped = self.follows(self.run_strake('clash', 'ship.glb', '--group-by', by, '--json'), 'clash')
            self.assertEqual([r['class'] == 'CONTACT' for r in grouped['results']],
                             ['group' not in r for r in grouped['results']])
            grouped = self.follows(self.run_strake('clash', 'ship.glb', '--group-by', by, '--group-contacts',
                                                   '--json'), 'clash')
            sizes = [group['results'] for group in grouped['groups']['list']]
            self.assertEqual(sum(sizes), len(grouped['results']))
            for number, size in enumerate(sizes):
                self.assertEqual(sum(r['group'] == number for r in grouped['results']), size)
        split = self.follows(self.run_strake('clash', 'ship.glb', '--group-by', 'element', '--group-distance', '2m', '--json'),
                             'clash')
        self.assertEqual(split['groups']['distance_mm'], 2000)
        self.assertEqual([file['label'] for file in empty['files']], ['odd.obj', 'ship.glb'])

    def test_clash_with_depths_that_a_work_limit_ended(self):
        self.run_strake('clash', 'ship.glb', '-o', 'exact.json')
        self.run_strake('clash', 'ship.glb', '--narrow-phase', 'sphere-subdivision', '--max-spheres', 50,
                        '-o', 'rough.json')
        rough = self.follows((self.folder / 'rough.json').read_text(encoding='utf-8'), 'clash')
        self.assertIn(False, [result.get('depth_complete') for result in rough['results']])
        diff = self.follows(self.run_strake('clash', 'diff', 'exact.json', 'rough.json', '--json'), 'clash-diff')
        self.assertIn(False, [result.get('depth_complete') for result in diff['changed']])

    def test_clash_by_rules(self):
        (self.folder / 'r.toml').write_text(
            '[[discipline]]\nname = "pipes"\nselect = "PIP*"\n[[discipline]]\nname = "rest"\nselect = "*"\n'
            '[matrix.cells.rest]\nrest = "not checked"\n[obstruction]\n[insulation]\n'
            '[[allowed]]\nname = "seats"\na = "PIP*"\nb = "SUP*"\n[[test]]\nname = "all"\n', encoding='utf-8')
        report = self.follows(self.run_strake('clash', 'ship.glb', '--rules', 'r.toml', '--list-exempted',
                                              '--json'), 'clash')
        self.assertGreater(len(report['exempted']), 0)
        self.assertGreater(sum('allowed' in result for result in report['results']), 0)

    def test_clash_with_clearances_that_objects_add_to(self):
        (self.folder / 'r.toml').write_text(
            '[[discipline]]\nname = "pipes"\nselect = "PIP*"\n[[discipline]]\nname = "rest"\nselect = "*"\n[matrix]\n'
            '[matrix.cells.pipes]\nrest = { clearance = "@weight_kg + 1mm" }\n', encoding='utf-8')
        report = self.follows(self.run_strake('clash', 'ship.glb', '--rules', 'r.toml', '--json'), 'clash')
        self.assertEqual([cell['settings'].get('clearance_attribute') for cell in report['tests'][0]['matrix']['cells']],
                         [None, 'weight_kg', None])
        self.assertEqual({'clearance_mm' in result for result in report['results']}, {True, False})
        self.run_strake('clash', 'ship.glb', '--clearance', '@weight_kg', '-o', 'added.json')
        self.run_strake('clash', 'ship.glb', '-o', 'plain.json')
        self.follows((self.folder / 'added.json').read_text(encoding='utf-8'), 'clash')
        diff = self.follows(self.run_strake('clash', 'diff', 'added.json', 'plain.json', '--json'), 'clash-diff')
        self.assertEqual([(s['setting'], s['old'], s['new']) for s in diff['settings_changed']],
                         [('clearance_attribute', 'weight_kg', None)])

    def test_clash_with_decisions(self):
        run = ['clash', 'ship.glb', '--decisions', 'decided.csv', '--json']
        first = self.follows(self.run_strake(*run, '--write-decisions'), 'clash')
        text = (self.folder / 'decided.csv').read_text(encoding='utf-8')
        for key, status in zip([result['key'] for result in first['results']], ('approved', 'resolved')):
            text = text.replace(f'{key},new,,,,', f'{key},{status},Ann,2026-01-31,as built,')
        text += '0' * 26 + ',active,Bob,,,\r\n'
        (self.folder / 'decided.csv').write_text(text, encoding='utf-8', newline='')
        (self.folder / 'ship_revB.glb').write_bytes((self.folder / 'ship.glb').read_bytes())
        reported = self.follows(self.run_strake('clash', 'ship_revB.glb', *run[2:]), 'clash')
        self.assertEqual([reported['decisions'][key] for key in ('file', 'not_found')],
                         ['decided.csv', [{'key': '0' * 26, 'status': 'active', 'by': 'Bob'}]])
        self.assertEqual(reported['decisions']['reopened'], {'severer': 0, 'deeper': 0, 'more_places': 0, 'found_again': 1})
        self.assertEqual([m['new'] for m in reported['decisions']['files_matched']], ['ship_revB.glb'])
        decided = [result['decision'] for result in reported['results'] if result['decision']['status'] != 'new']
        self.assertEqual({d['status'] for d in decided}, {'approved', 'resolved'})

    def test_clash_by_a_profile(self):
        report = self.follows(self.run_strake('clash', 'ship.glb', '--profile', 'ship', '--json'), 'clash')
        self.assertEqual(report['rules']['profile'], 'ship')

    def test_clash_with_a_place_that_a_rule_allows(self):
        (self.folder / 'bar.obj').write_text(bar_between_walls(), encoding='utf-8')
        ruled = ['clash', 'bar.obj', '--unit', 'mm', '--rules']
        for name, depth in (('none.toml', '1mm'), ('one.toml', '1m')):
            (self.folder / name).write_text(
                f'[[allowed]]\nname = "sleeve"\na = "bar"\nb = "walls"\nmax_depth = "{depth}"\n'
                'region = { min = ["50mm", "-1m", "-1m"], max = ["1m", "1m", "1m"] }\n', encoding='utf-8')
            self.run_strake(*ruled, name, '-o', f'{name}.json')
        report = self.follows((self.folder / 'one.toml.json').read_text(encoding='utf-8'), 'clash')
        self.assertEqual([place['allowed'] for place in report['results'][0]['allowed_regions']], ['sleeve'])
        diff = self.follows(self.run_strake('clash', 'diff', 'none.toml.json', 'one.toml.json', '--json'),
                            'clash-diff')
        self.assertEqual(diff['changed'][0]['allowed_region_count'], 1)

    def test_clash_that_reports_some_relations(self):
        for key in ('relations = ["abut", "duplicate"]', 'min_volume = "1m3"'):
            (self.folder / 'some.toml').write_text(f'[[test]]\nname = "t"\n{key}\n', encoding='utf-8')
            report = self.follows(self.run_strake('clash', 'ship.glb', '--rules', 'some.toml', '--json'), 'clash')
            self.assertEqual([reason['by'] for reason in report['tests'][0]['not_reported']], ['relation', 'volume'])
            self.assertGreater(sum(reason['counts']['HIT'] for reason in report['tests'][0]['not_reported']), 0)

    def test_positional_ids(self):
        for name, cubes in (('old', (('dup', 0), ('dup', 50), ('c', 140))), ('new', (('dup', 0), ('dup', 50), ('c', 145)))):
            (self.folder / 'm.obj').write_text(
                ''.join(cube(id, n, (x, 0, 0), 100) for n, (id, x) in enumerate(cubes)), encoding='utf-8')
            self.run_strake('clash', 'm.obj', '--unit', 'mm', '-o', f'{name}.json')
            report = self.follows((self.folder / f'{name}.json').read_text(encoding='utf-8'), 'clash')
            self.assertIn('positional_ids', report)
        diff = self.follows(self.run_strake('clash', 'diff', 'old.json', 'new.json', '--json'), 'clash-diff')
        self.assertEqual((diff['counts']['same'], diff['counts']['cannot_tell']), (1, 2))

    def test_clash_diff(self):
        for name, clearance in (('tight.json', '0'), ('wide.json', '25mm')):
            self.run_strake('clash', 'ship.glb', '--clearance', clearance, '-o', name)
        wider = self.follows(self.run_strake('clash', 'diff', 'tight.json', 'wide.json', '--json'), 'clash-diff')
        tighter = self.follows(self.run_strake('clash', 'diff', 'wide.json', 'tight.json', '--json'), 'clash-diff')
        self.assertGreater(wider['counts']['new'], 0)
        self.assertEqual(wider['counts']['new'], tighter['counts']['cannot_tell'])
        self.assertEqual([(s['setting'], s['old'], s['new']) for s in wider['settings_changed']],
                         [('clearance_mm', 0, 25)])
        (self.folder / 'd.toml').write_text('[defaults]\nclearance = "25mm"\n', encoding='utf-8')
        self.run_strake('clash', 'ship.glb', '--rules', 'd.toml', '-o', 'ruled.json')
        ruled = self.follows(self.run_strake('clash', 'diff', 'wide.json', 'ruled.json', '--json'), 'clash-diff')
        self.assertEqual(ruled['new']['rules']['file'], 'd.toml')

    def test_comparisons_of_renamed_files(self):
        for name, y in (('port', 0), ('starboard', 5000), ('new', 2500)):
            (self.folder / f'{name}.obj').write_text(
                ''.join(cube(f'c{n}', n, (90 * n, y, 0), 100) for n in range(24)), encoding='utf-8')
        for run, schema in ((['clash', '--self'], 'clash-diff'), (['draw'], 'view-diff')):
            for name, files in (('old', ('port.obj', 'starboard.obj')), ('new', ('new.obj',))):
                self.run_strake(*run, *files, '--unit', 'mm', '-o', f'{name}.json')
            diff = [run[0], 'diff', 'old.json', 'new.json', '--json']
            reported = self.follows(self.run_strake(*diff), schema)
            self.assertEqual(reported['files_ambiguous'],
                             [{'run': 'new', 'file': 'new.obj', 'may_be': ['port.obj', 'starboard.obj']}])
            reported = self.follows(self.run_strake(*diff, '--match-files', 'port.obj=new.obj'), schema)
            self.assertEqual([match['relation'] for match in reported['files_matched']], ['asked'])

    def test_view(self):
        self.run_strake('draw', 'ship.glb', '--view', 'iso', '--hidden', 'dashed', '-o', 'view.json', '-o', 'rows.view')
        self.follows((self.folder / 'view.json').read_text(encoding='utf-8'), 'view')
        rows = (self.folder / 'rows.view').read_bytes()
        self.follows(rows[16:16 + int.from_bytes(rows[8:16], 'little')], 'view')
        self.run_strake('draw', 'ship.glb', '--view', 'top', '--section', 'z=4500mm', '--section', '1,2,0>9m',
                        '--own-polylines', 'hidden', '-o', 'cut.json')
        cut = self.follows((self.folder / 'cut.json').read_text(encoding='utf-8'), 'view')
        self.assertEqual([s['normal'] for s in cut['view']['sections']], [[0, 0, 1], [1, 2, 0]])
        self.assertLessEqual({'section', 'hatch'}, {p['kind'] for p in cut['pieces']})
        chosen = self.follows(self.run_strake('draw', 'ship.glb', '--view', 'top', '--section', 'z=4500mm', '--uncut',
                                              '*', '--flush-seams', 'off', '--json'), 'view')
        self.assertGreater(chosen['counts']['objects_uncut'], 0)
        self.assertEqual(chosen['settings']['uncut'], ['*'])
        self.assertEqual(chosen['settings']['flush_seams'], 'off')


if __name__ == '__main__':
    STRAKE = Path(sys.argv.pop(1)).resolve()
    SCHEMAS = Path(sys.argv.pop(1)).resolve()
    unittest.main(verbosity=2)
