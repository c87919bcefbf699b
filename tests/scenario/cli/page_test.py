# SPDX-License-Identifier: Apache-2.0
"""The report page: every number in it is that of the JSON of the same run; the model and the drawings that stand in it."""
import contextlib
import json
import math
import os
import re
import sqlite3
import sys
from pathlib import Path

from page_file import NONE, PageFile
from scenario import Scenario, cube, main

CLASSES = ['HIT', 'CONTACT', 'CLEARANCE_VIOLATION']
RELATIONS = ['SEPARATE', 'ABUT_OUTSIDE', 'ABUT_INSIDE', 'INTERFERE', 'A_IN_B', 'B_IN_A', 'DUPLICATE', 'CROSS']
FLAGS = ['BORDERLINE', 'UNCERTAIN', 'OPEN', 'INVERTED']
LEVELS = [None, 'hard', 'soft', 'insulation']
STATUSES = ['new', 'active', 'reviewed', 'approved', 'resolved']
REOPENED = [None, 'severer', 'deeper', 'more places', 'found again']
NO_NAME = 0xffff


def mm(millionths):
    return millionths / 10 ** 6


def without_none(members):
    return {name: value for name, value in members.items() if value is not None}


class Rebuilt:
    """The results of a page in the words of the JSON document."""

    def __init__(self, page):
        self.page, self.head = page, page.head
        self.objects = page.rows('strake-objects')
        self.attribute_texts = page.columns.get('strake-objects', {}).get('texts', [''])
        self.texts = page.columns.get('strake-results', {}).get('texts', [''])
        self.regions = {}
        for region in page.rows('strake-regions'):
            self.regions.setdefault(region['result'], []).append(region)

    def rule(self, number):
        return None if number == NO_NAME else self.head['rules'][number]

    def measured(self, row):
        return without_none({
            'class': CLASSES[row['class']], 'allowed': self.rule(row.get('allowed', NO_NAME)), 'd_mm': mm(row['d']),
            'd_range_mm': [mm(row['d_low']), mm(row['d_high'])], 'depth_complete': False if row['flags'] & 16 else None,
            'point_mm': [mm(row[axis]) for axis in 'xyz'], 'flags': [flag for bit, flag in enumerate(FLAGS) if row['flags'] >> bit & 1]})

    def side(self, row, side):
        its = self.objects[row[side]]
        attributes = {name: self.attribute_texts[its[f'attribute_{i}']] for i, name in enumerate(self.head['columns'])
                      if its[f'attribute_{i}']}
        discipline = row.get(f'discipline_{side}', NO_NAME)
        has_matrix = 'matrix' in self.head['clash']['tests'][row['test']]
        return without_none({
            'id': its['id'], 'name': its['id'] if its['flags'] & 2 else its['name'], 'file': self.head['files'][its['file']],
            'positional_id': True if its['flags'] & 1 else None, 'attributes': attributes if self.head['columns'] else None,
            'part': row[f'part_{side}'], 'level': LEVELS[row.get(f'level_{side}', 0)],
            'discipline': (self.head['disciplines'][discipline] if discipline != NO_NAME else '') if has_matrix else None})

    def witness(self, row):
        p, q = ([mm(row[f'{letter}_{axis}']) for axis in 'xyz'] for letter in 'pq')
        return [{'on_a_mm': p, 'on_b_mm': q}, {'surface_mm': p, 'push_out': q}, {'surface_mm': None, 'push_out': None}][row['witness']]

    def region_lists(self, number):
        lists = {}
        for region in self.regions.get(number, []):
            lists.setdefault('regions' if region['allowed'] == NO_NAME else 'allowed_regions', []).append(
                {**self.measured(region), 'part_a': region['part_a'], 'part_b': region['part_b']})
        return lists

    def decision(self, row):
        if row.get('status', 255) == 255:
            return {}
        stated = {name: self.texts[row[column]] or None
                for name, column in (('by', 'decided_by'), ('date', 'decided_on'), ('comment', 'comment'))}
        return {'decision': without_none({'status': STATUSES[row['status']], **stated, 'reopened': REOPENED[row['reopened']]})}

    def result(self, number, row):
        counted = row.get('region_count', 0)
        volume = row.get('volume', -2)
        return {**self.measured(row), **self.witness(row), **self.region_lists(number), **self.decision(row),
                'a': self.side(row, 'a'), 'b': self.side(row, 'b'), 'relation': RELATIONS[row['relation']],
                **({'region_count': None if counted == NONE else counted} if counted else {}),
                **({'volume_mm3': None if volume == -1 else mm(volume)} if volume != -2 else {}),
                **without_none({
                    'key': row['key'], 'test': row['test'], 'group': None if row.get('group', NONE) == NONE else row['group'],
                    'may_be': None if row.get('may_be', 255) == 255 else ['HIT', 'CONTACT', 'CLEARANCE_VIOLATION'][row['may_be']],
                    'clearance_mm': None if row.get('clearance', -1) < 0 else mm(row['clearance']),
                    'allowed_region_count': row.get('allowed_region_count') or None})}

    def results(self):
        return [self.result(number, row) for number, row in enumerate(self.page.rows('strake-results'))]

    def groups(self):
        return [{'id': g['id'], 'name': g['name'], 'results': g['results'], 'class': CLASSES[g['class']], 'd_mm': mm(g['d']),
                 'counts': {'HIT': g['hits'], 'CONTACT': g['contacts'], 'CLEARANCE_VIOLATION': g['clearance_violations']},
                 'box_mm': [[mm(g[f'{end}_{axis}']) for axis in 'xyz'] for end in ('min', 'max')],
                 **({'volume_mm3': mm(g['volume'])} if g.get('volume', -2) != -2 else {})}
                for g in self.page.rows('strake-groups')]


class PageScenario(Scenario):
    def ship(self, objects, *more):
        self.text('generate', 'ship', '--objects', objects, '--quiet', '-o', 'ship.glb', *more)

    def page(self, name='x.html'):
        return PageFile(self.folder / name)

    def pair(self, *arguments):
        """The page and the JSON of one run."""
        self.run_ok('clash', *arguments, '-o', 'x.html', '-o', 'x.json')
        return self.page(), json.loads((self.folder / 'x.json').read_text())

    def run_ok(self, *arguments):
        done = self.run_strake(*arguments)
        self.assertEqual(done.returncode, 0, done.stderr)
        return done

    def compare(self, page, document):
        """Holds everything that the page says of results to the document."""
        rebuilt = Rebuilt(page)
        for result in document['results']:  # boxes of places are not in the page
            for region in result.get('regions', []) + result.get('allowed_regions', []):
                del region['box_mm']
        found = rebuilt.results()
        self.assertEqual(len(found), len(document['results']))
        for mine, theirs in zip(found, document['results']):
            self.assertEqual(mine, theirs)
        head = page.head['clash']
        groups = document.get('groups')
        if groups:
            self.assertEqual(rebuilt.groups(), groups.pop('list'))
        for test in document['tests']:
            del test['tested']
        for member in ('results', 'elements', 'sheets', 'positional_ids'):
            document.pop(member, None)
        self.assertEqual(head, document)


class Numbers(PageScenario):
    def test_all_results_of_a_ship(self):
        self.ship(600)
        page, document = self.pair('ship.glb', '--clearance', '25mm', '--group-by', 'element', '--volumes', '--regions', '8')
        self.assertGreater(len(document['results']), 500)
        self.assertTrue(any('regions' in result for result in document['results']))
        self.assertTrue(any('volume_mm3' in result for result in document['results']))
        self.compare(page, document)

    def test_rules_disciplines_and_exemptions(self):
        self.ship(1200, '--seed', 7)
        page, document = self.pair('ship.glb', '--rules', Path(sys.argv[0]).resolve().parents[3] / 'examples' / 'ship_rules.toml',
                                   '--list-exempted')
        self.assertTrue(any('allowed' in result for result in document['results']))
        self.assertTrue(any(result['a'].get('discipline') == 'piping' for result in document['results']))
        self.assertIn('exempted', document)
        self.compare(page, document)

    def test_levels_columns_and_positions_for_ids(self):
        self.write_rvm('p.rvm', [('/A', (0, 0, 0)), ('/A', (80, 0, 0), 'OBST'), ('/B', (160, 0, 0), 'INSU')])
        self.write('p.att', 'NEW /A\n:Area := deck 1\nEND\n')
        self.write('a.obj', cube('a', 0, (60, 50, 50), 100))
        self.write('rules.toml', '''
            [defaults]
            clearance = "20mm"
            [obstruction]
            volumes = "soft"
            [insulation]
            against_insulation = true
            ''')
        page, document = self.pair('p.rvm', 'a.obj', '--rules', 'rules.toml', '--columns', '@Area,@Nothing')
        self.assertLessEqual({'hard', 'soft'}, {result[side]['level'] for result in document['results'] for side in 'ab'})
        self.assertTrue(any(result[side].get('positional_id') for result in document['results'] for side in 'ab'))
        self.compare(page, document)

    def test_decisions(self):
        self.ship(300)
        self.run_ok('clash', 'ship.glb', '--clearance', '25mm', '--decisions', 'd.csv', '--write-decisions')
        text = (self.folder / 'd.csv').read_text()
        statuses = iter(['approved', 'reviewed', 'active', 'resolved'] * 1000)
        text = re.sub(r',new,', lambda match: f',{next(statuses)},', text)
        (self.folder / 'd.csv').write_text(text)
        page, document = self.pair('ship.glb', '--clearance', '25mm', '--decisions', 'd.csv')
        self.assertEqual({result['decision']['status'] for result in document['results'] if 'decision' in result}
                         >= {'approved', 'reviewed', 'active', 'resolved'}, True)
        self.compare(page, document)

    def test_the_same_bytes_for_any_number_of_threads(self):
        self.ship(800)
        pages = []
        for threads in (1, 2, 3, 8):
            self.run_ok('clash', 'ship.glb', '--clearance', '25mm', '--threads', threads, '-o', 'x.html')
            pages.append((self.folder / 'x.html').read_bytes())
        self.assertEqual(len(set(pages)), 1)

    def test_names_that_would_be_markup(self):
        names = ['</script><script>alert(1)</script>', '<!--', '"&\'', '\u202eevil\u2066', 'x' * 10000, '=1+1', 'tab\tname']
        data = ''.join(cube(name, number, (90 * number, 0, 0), 100) for number, name in enumerate(names)).encode()
        (self.folder / 'a.obj').write_bytes(data + cube('last', len(names), (90 * len(names), 0, 0), 100).replace(
            'last', 'l\xff').encode('latin-1'))
        page, document = self.pair('a.obj')
        self.assertEqual(document['results'][0]['class'], 'HIT')
        self.compare(page, document)
        self.write('b.obj', cube('b', 0, (0, 0, 0), 100))
        self.run_ok('clash', 'b.obj', '-o', 'b.html')
        self.assertEqual(page.around, self.page('b.html').around)


class RealModels(PageScenario):
    def test_a_platform(self):
        """The files of a platform in the folder that STRAKE_DATA names."""
        files = sorted(Path(os.environ.get('STRAKE_DATA', '/nowhere')).glob('rvm/*/HA-*.RVM'))
        if not files:
            self.skipTest('STRAKE_DATA names no folder with the platform')
        page, document = self.pair(*files, '--clearance', '25mm', '--group-by', 'element')
        self.assertGreater(len(document['results']), 300)
        self.compare(page, document)
        self.assertLess((self.folder / 'x.html').stat().st_size, 3_000_000)


class ModelInPage(PageScenario):
    def boxes_of_instances(self, page):
        """The box of each object, by its instances, in millimetres of the model."""
        shapes, at, origin = [], 0, page.head['scene']['origin_mm']
        table = page.columns['strake-shapes']
        for i, count in enumerate(table['vertices']):
            low = (table['min_x'][i], table['min_y'][i], table['min_z'][i])
            numbers = table['position'][3 * at:3 * (at + count)]
            shapes.append([tuple(low[k] + table['step'][i] * numbers[3 * v + k] for k in range(3)) for v in range(count)])
            at += count
        boxes = {}
        instances = page.columns['strake-instances']
        for i, (shape, its) in enumerate(zip(instances['shape'], instances['object'])):
            m = instances['matrix'][12 * i:12 * i + 12]
            points = [[m[4 * r] * x + m[4 * r + 1] * y + m[4 * r + 2] * z + m[4 * r + 3] + origin[r] for r in range(3)]
                      for x, y, z in shapes[shape]]
            box = boxes.setdefault(its, [[math.inf] * 3, [-math.inf] * 3])
            for point in points:
                box[0] = list(map(min, box[0], point))
                box[1] = list(map(max, box[1], point))
        return boxes

    def boxes_of_boxes(self, page):
        scene = page.head['scene']
        low = [a + b for a, b in zip(scene['origin_mm'], scene['boxes']['min'])]
        table, step = page.columns['strake-boxes'], scene['boxes']['step']
        return {its: [[low[k] + step * table['box'][6 * i + 3 * end + k] for k in range(3)] for end in (0, 1)]
                for i, its in enumerate(table['object'])}

    def test_shapes_and_boxes_of_the_same_objects(self):
        self.ship(1200)
        self.run_ok('clash', 'ship.glb', '--page-geometry', 'all', '-o', 'x.html')
        self.run_ok('clash', 'ship.glb', '--page-geometry', 'boxes', '-o', 'boxes.html')
        page, boxes = self.page(), self.page('boxes.html')
        shapes, coarse = self.boxes_of_instances(page), self.boxes_of_boxes(boxes)
        self.assertEqual(page.head['scene']['objects_as_shapes'], len(shapes))
        self.assertEqual(boxes.head['scene']['objects_as_boxes'], len(coarse))
        self.assertEqual(sum(page.columns['strake-shapes']['triangles'][s] for s in page.columns['strake-instances']['shape']),
                         page.head['scene']['triangles'])
        self.assertEqual(len(shapes), 1200)
        self.assertEqual(page.head['scene']['objects_left_out'], 0)
        index = page.columns['strake-shapes']['index']
        self.assertTrue(any(q == r for q, r in zip(index[1::3], index[2::3])), 'a ship has lines without thickness')
        slack = boxes.head['scene']['boxes']['step'] + .5
        for its, box in shapes.items():
            for k in range(3):
                self.assertAlmostEqual(box[0][k], coarse[its][0][k], delta=slack)
                self.assertAlmostEqual(box[1][k], coarse[its][1][k], delta=slack)

    def test_a_single_object_far_off_makes_the_others_no_coarser(self):
        cubes = [(90 * i, 0, 0) for i in range(7)] + [(1e7, -1e7, 0)]
        self.write('a.obj', ''.join(cube(f'c{i}', i, at, 100) for i, at in enumerate(cubes)))
        self.run_ok('clash', 'a.obj', '-o', 'x.html')
        page = self.page()
        self.assertLess(max(map(abs, page.head['scene']['origin_mm'])), 1000)
        self.assertEqual(len(self.boxes_of_instances(page)), 8)

    def test_near_has_what_clashes_as_it_is(self):
        self.ship(3000)
        self.run_ok('clash', 'ship.glb', '--page-geometry', 'near', '--clearance', '5mm', '-o', 'x.html')
        page = self.page()
        scene = page.head['scene']
        self.assertGreater(scene['objects_as_shapes'], 0)
        self.assertEqual(scene['objects_as_shapes'] + scene['objects_as_boxes'] + scene['objects_left_out'], scene['objects'])
        self.assertIn('within 2 m', scene['note'])
        shown = set(page.columns['strake-instances']['object'])
        boxed = set(page.columns.get('strake-boxes', {}).get('object', []))
        self.assertFalse(shown & boxed)
        clashing = {row[side] for row in page.rows('strake-results') if row['class'] != 1 for side in 'ab'}
        self.assertTrue(clashing)
        self.assertLessEqual(clashing, shown)

    def test_no_model(self):
        self.ship(200)
        self.run_ok('clash', 'ship.glb', '--page-geometry', 'none', '-o', 'x.html')
        self.assertNotIn('scene', self.page().head)
        self.assertIn("without '--page-geometry none'", self.page().head['no_model']['remedy'])
        done = self.run_strake('clash', 'ship.glb', '--page-geometry', 'none')
        self.assertEqual(done.returncode, 2)
        self.assertIn('no page is written', done.stderr)

    def test_size_of_a_large_ship(self):
        """A page of 20,000 objects stays within what a mail takes."""
        self.ship(20000)
        self.run_ok('clash', 'ship.glb', '--clearance', '25mm', '--contacts', 'count', '-o', 'x.html')
        self.assertLess((self.folder / 'x.html').stat().st_size, 5_000_000)


class Drawings(PageScenario):
    def test_a_drawing_with_what_it_shows(self):
        self.ship(200)
        self.run_ok('draw', 'ship.glb', '--view', 'top', '--select', 'PIP*', '-o', 'x.html', '-o', 'x.svg')
        page = self.page()
        self.assertEqual(page.drawings, [(self.folder / 'x.svg').read_text()])
        self.assertNotIn('clash', page.head)
        ids = page.columns['strake-objects']['id']
        self.assertTrue(ids)
        self.assertTrue(all(name.startswith('PIP') for name in ids))
        drawn = set(re.findall(r'data-id="([^"]*)"', page.drawings[0]))
        self.assertTrue(drawn)
        self.assertLessEqual(drawn, set(ids))
        self.assertEqual(page.head['drawings'][0]['objects'], len(ids))
        self.run_ok('draw', 'ship.glb', '--view', 'top', '--select', 'PIP*', '-o', 'x.view')
        self.run_ok('draw', 'x.view', '-o', 'again.html')
        self.assertEqual(self.page('again.html').drawings, page.drawings)
        self.assertIn('from its lines alone', self.page('again.html').head['no_model']['why'])
        self.assertNotIn('no_model', page.head)


class ProjectPage(PageScenario):
    def setUp(self):
        super().setUp()
        self.ship(300)
        self.run_ok('project', 'new', 'p.strake', 'ship.glb')

    def test_results_decisions_runs_and_views(self):
        self.run_ok('clash', '-p', 'p.strake', '--clearance', '25mm', '--group-by', 'element')
        self.run_ok('draw', '-p', 'p.strake', '--save', 'from above', '--view', 'top', '-o', 'x.svg')
        page, document = self.pair('-p', 'p.strake', '--clearance', '25mm', '--group-by', 'element')
        hit = next(result for result in document['results'] if result['class'] == 'HIT')
        self.run_ok('clash', 'set', '-p', 'p.strake', hit['key'], '--status', 'reviewed', '--comment', 'seen <b>',
                    '--by', 'Ann', '--assignee', 'Bob')
        self.run_ok('report', '-p', 'p.strake', '-o', 'report.html')
        reported = self.page('report.html')
        rows = {row['key']: row for row in reported.rows('strake-results')}
        texts = reported.columns['strake-results']['texts']
        decided = rows[hit['key']]
        self.assertEqual((STATUSES[decided['status']], texts[decided['decided_by']], texts[decided['comment']],
                          texts[decided['assignee']]), ('reviewed', 'Ann', 'seen <b>', 'Bob'))
        statuses = {result['key']: result['decision']['status'] for result in document['results']}
        for key, row in rows.items():
            if key != hit['key']:
                self.assertEqual(STATUSES[row['status']], statuses[key])
        self.assertEqual([point['run'] for point in reported.head['trend']], [1, 2])
        self.assertEqual(reported.head['trend'][1]['hit'], document['tests'][0]['counts']['HIT'])
        self.assertEqual([drawing['title'] for drawing in reported.head['drawings']], ['from above'])
        self.assertEqual(reported.head['scene'], page.head['scene'])
        for members in (reported.head['clash'], page.head['clash']):
            del members['decisions']
        self.assertEqual(reported.head['clash'], page.head['clash'])
        before = reported.columns['strake-results'], page.columns['strake-results']
        for name in ('d', 'd_low', 'd_high', 'x', 'y', 'z', 'p_x', 'q_z', 'group', 'key'):
            self.assertEqual(before[0][name], before[1][name])

    def test_before_the_first_run(self):
        self.run_ok('report', '-p', 'p.strake', '-o', 'x.html')
        page = self.page()
        self.assertEqual(page.head['counts']['results'], 0)
        self.assertIn('scene', page.head)

    def test_a_model_that_changed_since(self):
        self.run_ok('clash', '-p', 'p.strake')
        self.ship(200)
        self.run_ok('project', 'update', 'p.strake')
        done = self.run_ok('report', '-p', 'p.strake', '-o', 'x.html')
        self.assertIn('the model changed since the last run', done.stderr)
        self.assertNotIn('scene', self.page().head)
        self.assertIn('The model changed', self.page().head['no_model']['why'])
        self.assertIn("'strake clash -p p.strake'", self.page().head['no_model']['remedy'])

    def test_a_model_that_cannot_be_read(self):
        self.run_ok('clash', '-p', 'p.strake', '--clearance', '25mm')
        self.run_ok('report', '-p', 'p.strake', '-o', 'whole.html')
        with contextlib.closing(sqlite3.connect(self.folder / 'p.strake')) as project:
            project.execute("UPDATE file_block SET data = x'0102'")
            project.commit()
        done = self.run_ok('report', '-p', 'p.strake', '-o', 'x.html')
        self.assertIn('the page has no model', done.stderr)
        page, whole = self.page(), self.page('whole.html')
        self.assertNotIn('scene', page.head)
        self.assertIn('cannot be read: p.strake is damaged', page.head['no_model']['why'])
        self.assertNotIn(str(self.folder), page.head['no_model']['why'])
        self.assertIn('make it anew', page.head['no_model']['remedy'])
        self.assertGreater(len(whole.rows('strake-results')), 10)
        self.assertEqual([(row['key'], row['d']) for row in page.rows('strake-results')],
                         [(row['key'], row['d']) for row in whole.rows('strake-results')])
        self.assertEqual(page.columns['strake-objects']['id'],
                         [whole.columns['strake-objects']['id'][o] for o in sorted({row[side] for row in whole.rows('strake-results') for side in 'ab'})])


if __name__ == '__main__':
    main()
