#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""rules_of_attributes_test.py STRAKE: clearances from attributes, levels by selection and settings of files, on
scenes of cubes where the answer is known."""
import csv
import io
import json

from scenario import Scenario, cube, gltf, main

# Cubes of 100 mm, 40 mm apart: a pipe with 30 mm of insulation, a beam, a pipe with 25 mm, its twin without.
RACK = ('RACK', {}, None, [
    ('pipe', {'INSU': '30', 'Area': 7}, 0, []), ('beam', {'Area': 7}, .14, []),
    ('LINE-2', {'INSU': '25 mm'}, None, [('elbow', {}, .28, [])]), ('twin', {'INSU': 'none'}, .42, [])])
# Cubes of 100 mm, 10 mm in each other.
PILE = ('PILE', {}, None, [('pipe', {}, 0, []), ('lagging 1', {}, .09, []), ('lagging 2', {}, .18, []),
                           ('access', {}, .27, []), ('note', {}, .36, []), ('beam', {}, .45, [])])


def names(result):
    """The names of both sides, whichever is a."""
    return '-'.join(sorted(result[side]['name'] for side in 'ab'))


class Ruled(Scenario):
    def report(self, *arguments):
        done = self.run_strake('clash', *arguments, '--json')
        self.assertEqual(done.returncode, 0, done.stderr)
        self.reported = done.stderr
        return json.loads(done.stdout)

    def pairs(self, *arguments):
        return {names(r) for r in self.report(*arguments)['results']}


class Clearance(Ruled):
    def setUp(self):
        super().setUp()
        self.write('rack.gltf', gltf(RACK))

    def test_what_both_objects_of_a_pair_state_is_added(self):
        all_three = {'beam-pipe', 'beam-elbow', 'elbow-twin'}
        for clearance, found in (('@INSU', set()), ('@INSU + 12mm', {'beam-pipe'}), ('45mm', all_three),
                                 ('@INSU + 16mm', all_three)):
            with self.subTest(clearance=clearance):
                self.assertEqual(self.pairs('rack.gltf', '--clearance', clearance), found)
                self.write('r.toml', f'[defaults]\nclearance = "{clearance}"\n')
                self.assertEqual(self.pairs('rack.gltf', '--rules', 'r.toml'), found)

    def test_each_result_states_what_it_lacks(self):
        report = self.report('rack.gltf', '--clearance', '@INSU + 16mm', '-o', 'x.csv', '--columns', '@INSU')
        self.assertEqual({names(r): (r['clearance_mm'], round(r['d_mm'], 3)) for r in report['results']},
                         {'beam-pipe': (46, 40), 'beam-elbow': (41, 40), 'elbow-twin': (41, 40)})
        settings = report['tests'][0]['settings']
        self.assertEqual((settings['clearance_mm'], settings['clearance_attribute']), (16, 'INSU'))
        rows = list(csv.DictReader(io.StringIO((self.folder / 'x.csv').read_text(encoding='utf-8'))))
        self.assertEqual(len(rows), 3)
        self.assertNotIn('clearance_attribute', self.report('rack.gltf', '--clearance', '16mm')['tests'][0]['settings'])

    def test_results_are_those_of_the_constant_clearance(self):
        added = self.report('rack.gltf', '--clearance', '@INSU + 16mm', '--a', 'pipe', '--b', 'beam')
        constant = self.report('rack.gltf', '--clearance', '46mm', '--a', 'pipe', '--b', 'beam')
        self.assertEqual(added['hash'], constant['hash'])
        self.assertEqual([{k: v for k, v in r.items() if k != 'clearance_mm'} for r in added['results']],
                         constant['results'])

    def test_what_has_no_length_is_reported_in_one_line(self):
        self.write('odd.gltf', gltf(('ODD', {'INSU': 'as of spec 7'}, None, [('a', {}, 0, []), ('b', {}, .14, []),
                                                                           ('c', {'INSU': '50'}, .28, [])])))
        self.assertEqual(self.pairs('odd.gltf', '--clearance', '@INSU'), {'b-c'})
        lines = [line for line in self.reported.splitlines() if 'clearance-not-a-length' in line]
        self.assertEqual(len(lines), 1, self.reported)
        self.assertIn("the attribute 'INSU' of 2 objects is no length from 0 to 1km and adds nothing to the clearance: "
                      "'as of spec 7' (2)", lines[0])
        self.report('odd.gltf', '--clearance', '@LAGGING')
        self.assertIn("--clearance: no object has the attribute 'LAGGING'", self.reported)

    def test_strict_stops_where_a_clearance_lacks_a_length(self):
        self.write('odd.gltf', gltf(('ODD', {}, None, [('a', {'INSU': '50,0'}, 0, []), ('b', {'INSU': '50'}, .14, [])])))
        self.write('r.toml', '[[test]]\nname = "t"\nclearance = "@INSUL"\n')
        why = 'not every clearance is as large as it was asked for: '
        for arguments, stated in (['--clearance', '@INSU'], "the attribute 'INSU' of 1 object is no length"), \
                (['--clearance', '@INSUL'], "no object has the attribute 'INSUL'"), \
                (['--rules', 'r.toml'], "no object has the attribute 'INSUL'"):
            with self.subTest(arguments=arguments):
                done = self.run_strake('clash', 'odd.gltf', *arguments, '--quiet', '--strict')
                self.assertEqual(done.returncode, 4, done.stderr)
                self.assertIn(f'--strict: {why}{stated}', done.stderr)
                self.assertEqual(self.run_strake('clash', 'odd.gltf', *arguments).returncode, 0)
        self.assertEqual(self.run_strake('clash', 'rack.gltf', '--clearance', '@INSU', '--strict').returncode, 0)

    def test_what_makes_no_sense_is_refused(self):
        for clearance, why in (('@', 'names no attribute'), ('@A + @B', 'two attributes'), ('@INSU + 5', 'no unit'),
                               ('5mm + @INSU + 5mm', 'two lengths')):
            done = self.run_strake('clash', 'missing.gltf', '--clearance', clearance)
            self.assertEqual(done.returncode, 2, done.stderr)
            self.assertIn('--clearance', done.stderr)
            self.assertIn(why, done.stderr)


class Levels(Ruled):
    def test_insulation_and_obstruction_by_selection(self):
        self.write('pile.gltf', gltf(PILE))
        self.write('r.toml', """
[obstruction]
soft = "access"
none = "note"
[insulation]
select = "lagging*"
against_insulation = false
""")
        report = self.report('pile.gltf', '--rules', 'r.toml')
        self.assertEqual({frozenset(((r['a']['name'], r['a']['level']), (r['b']['name'], r['b']['level'])))
                          for r in report['results']},
                         {frozenset((('pipe', 'hard'), ('lagging 1', 'insulation'))),
                          frozenset((('lagging 2', 'insulation'), ('access', 'soft')))})
        self.assertEqual(report['tests'][0]['exempted'],
                         [{'rule': 'no obstruction', 'pairs': 2}, {'rule': 'insulation against insulation', 'pairs': 1}])
        self.assertNotIn('rule-', self.reported)

    def test_a_selection_works_in_files_that_have_no_attributes(self):
        self.write('m.obj', ''.join(cube(name, n, (90 * n, 0, 0), 100) for n, name in enumerate(('pipe', 'INSU-1', 'DOOR'))))
        self.write('r.toml', "[obstruction]\nsoft = '*'\nhard = 'DOOR'\n[insulation]\nselect = 'INSU*'\nagainst_soft = false\n")
        report = self.report('m.obj', '--unit', 'mm', '--rules', 'r.toml')
        self.assertEqual([{r[side]['name']: r[side]['level'] for side in 'ab'} for r in report['results']],
                         [{'INSU-1': 'insulation', 'DOOR': 'hard'}])


class Files(Ruled):
    def setUp(self):
        super().setUp()
        self.write('mm.obj', cube('a', 0, (0, 0, 0), 100))
        self.write('m.obj', cube('b', 0, (.05, .05, .05), .1))

    def units(self, *arguments):
        return {f['label']: f['unit'] for f in self.report(*arguments)['files']}

    def test_a_unit_for_each_file(self):
        self.write('r.toml', '[[file]]\nname = "m.obj"\nunit = "m"\n')
        run = ['mm.obj', 'm.obj', '--rules', 'r.toml']
        self.assertEqual(self.units(*run), {'mm.obj': 'mm (assumed)', 'm.obj': 'm (given)'})
        self.assertNotIn('unit-doubtful', self.reported)
        result, = self.report(*run)['results']
        self.assertEqual((result['class'], result['d_mm']), ('HIT', -50))
        plain = self.report('mm.obj', 'm.obj', '--unit', 'm.obj=m')
        self.assertEqual(plain['results'], self.report(*run)['results'])

    def test_the_command_line_goes_before_the_rules(self):
        self.write('r.toml', '[[file]]\nname = "*.obj"\nunit = "m"\nup_axis = "y"\n')
        run = ['mm.obj', 'm.obj', '--rules', 'r.toml']
        self.assertEqual(self.units(*run, '--unit', 'mm.obj=mm'), {'mm.obj': 'mm (given)', 'm.obj': 'm (given)'})
        self.assertEqual(self.units(*run, '--unit', 'in'), {'mm.obj': 'in (given)', 'm.obj': 'in (given)'})
        done = self.run_strake('clash', *run, '--up-axis', 'mm.obj=z')
        self.assertIn('mm.obj: OBJ, 1 objects, unit m (given), z up', done.stderr)
        self.assertIn('m.obj: OBJ, 1 objects, unit m (given), y up', done.stderr)
        self.assertNotIn('rule-', done.stderr)

    def test_the_first_table_counts_and_idle_ones_are_named(self):
        self.write('r.toml', '[[file]]\nname = "m.obj"\nunit = "m"\n[[file]]\nname = "*.obj"\nunit = "mm"\n'
                             '[[file]]\nname = "mm*"\nunit = "in"\n[[file]]\nname = "*.stl"\nunit = "in"\n')
        report = self.report('mm.obj', 'm.obj', '--rules', 'r.toml')
        self.assertEqual({f['label']: f['unit'] for f in report['files']}, {'mm.obj': 'mm (given)', 'm.obj': 'm (given)'})
        reported = [f"{m['code']}: {m['where']}: {m['message']}" for m in report['messages'] if m['code'].startswith('rule-')]
        self.assertEqual(reported, [
            "rule-shadowed: r.toml, line 7: [[file]] 'mm*': earlier [[file]] tables say as much of every file that it is about",
            "rule-matches-nothing: r.toml, line 10: [[file]] '*.stl': no file of the run has such a name"])
        for line in reported:
            self.assertIn(line, self.reported)

    def test_folders_distinguish_files(self):
        for folder in ('hull', 'pipes'):
            (self.folder / folder).mkdir()
            self.write(f'{folder}/x.obj', cube(folder, 0, (0, 0, 0), 1))
        self.write('r.toml', '[[file]]\nname = "hull/*"\nunit = "m"\n')
        self.assertEqual(self.units('hull/x.obj', 'pipes/x.obj', '--rules', 'r.toml'),
                         {'hull/x.obj': 'm (given)', 'pipes/x.obj': 'mm (assumed)'})

    def test_a_unit_is_doubted_whatever_the_formats(self):
        """A part in metres beside the same in millimetres."""
        self.write('m.stl', """solid x
facet normal 0 0 0
outer loop
vertex 0 0 0
vertex .1 .1 0
vertex 0 .1 .1
endloop
endfacet
endsolid x
""")
        self.write_rvm('box.rvm', [('/B', (50, 50, 50))])
        in_mm = json.loads(gltf(('x', {}, None, [('big', {}, 0, [])])))
        self.write('m.gltf', json.dumps(in_mm))
        in_mm['nodes'][1]['scale'] = [1000, 1000, 1000]  # as programs write that forget that glTF is in metres
        self.write('mm.gltf', json.dumps(in_mm))
        self.report('box.rvm', 'm.stl')
        self.assertIn('unit-doubtful: box.rvm: is about 1000 times as large as m.stl', self.reported)
        self.assertIn("--unit 'm.stl=m'", self.reported)
        self.report('m.gltf', 'm.stl')
        self.assertIn("--unit 'm.stl=m'", self.reported)
        self.report('m.gltf', 'box.rvm')
        self.assertNotIn('unit-doubtful', self.reported)
        self.report('mm.gltf', 'box.rvm')
        self.assertIn("unit-doubtful: mm.gltf: is about 1000 times as large as box.rvm", self.reported)
        self.assertIn("--unit 'mm.gltf=mm'", self.reported)
        self.report('mm.gltf', 'box.rvm', '--unit', 'mm.gltf=mm')
        self.assertNotIn('unit-doubtful', self.reported)


if __name__ == '__main__':
    main()
