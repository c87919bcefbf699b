#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""convert_test.py STRAKE: what becomes of a model that is converted. Clashes, drawings and lists of a converted model
are those of the model, byte for byte where both files have one name. With STRAKE_DATA of real models, too."""
import json
import os
import shutil
import unittest
from pathlib import Path

from scenario import Scenario, cube, gltf, main, rvm

# What says of a file what it is, and not what is in it.
OF_FILES = ('format', 'unit', 'up_axis', 'bytes')
# Noticed of whatever is read; of ids that the converted file no longer has twice, of more objects.
NOTICED = ('object-id-positional', 'object-id-repeated')
SUFFIXES = ('.rvm', '.glb', '.gltf', '.obj', '.stl', '.ply')


def real_models():
    """Files of real models that are small enough for a test."""
    folder = os.environ.get('STRAKE_DATA', '')
    if not folder:
        return []
    most = int(os.environ.get('STRAKE_CONVERT_BYTES', '400000'))
    return sorted(p for p in Path(folder).rglob('*')
                  if p.is_file() and p.suffix.lower() in SUFFIXES and p.stat().st_size < most)


class Convert(Scenario):
    def results(self, file, name):
        """All that is said of a model."""
        self.run_strake('clash', file, '--clearance', '20mm', '--quiet', '-o', f'{name}.json')
        self.run_strake('draw', file, '--view', 'iso', '--hidden', 'dashed', '--quiet', '-o', f'{name}.svg',
                        '-o', f'{name}.view.json')
        reported = json.loads(self.text('info', file, '--attributes', '--objects', 10**9, '--json', '--quiet'))
        clash = (self.folder / f'{name}.json').read_text()
        document = json.loads(clash)
        for one in (reported, document):
            one.pop('messages', None)
            one['diagnostics'] = [d for d in one.get('diagnostics', []) if d['code'] not in NOTICED]
            for of_file in one['files']:
                for word in OF_FILES:
                    of_file.pop(word, None)
        return {'clash': document, 'svg': (self.folder / f'{name}.svg').read_text(),
                'view': (self.folder / f'{name}.view.json').read_text(), 'info': reported}

    def assert_round_trip(self, file):
        file = Path(file)
        before = self.results(file, 'before')
        self.text('convert', file, 'out.glb', '--quiet')
        (self.folder / 'again').mkdir(exist_ok=True)
        again = self.folder / 'again' / file.name
        shutil.move(self.folder / 'out.glb', again)
        after = self.results(again, 'after')
        for what, result in before.items():
            self.assertEqual(result, after[what], f'{what} of {file}')

    def test_generated_ships(self):
        for seed, more in ((1, []), (2, ['--turned']), (3, ['--kind', 'dense'])):
            self.text('generate', 'ship', '--objects', 250, '--seed', seed, *more, '-o', 'ship.glb', '--quiet')
            self.assert_round_trip(self.folder / 'ship.glb')

    def test_primitives_categories_and_precision_of_rvm(self):
        (self.folder / 'a.rvm').write_bytes(rvm([('one', (0, 0, 0)), ('two', (50, 0.3, 0)), ('two', (0, 130, 0)),
                                                 ('space', (10, 10, 10), 'OBST'), ('wool', (400, 0, 0), 'INSU')]))
        self.assert_round_trip(self.folder / 'a.rvm')
        self.text('convert', 'a.rvm', 'a.glb')
        self.assertIn('box', self.text('info', 'a.glb'))
        self.assertIn('left out 2 bodies', self.run_strake('info', 'a.glb').stderr)

    def test_decimals_and_polygons_of_obj(self):
        self.write('a.obj', cube('a', 0, (0.1, 0.2, 1234567.8), 100.01) + cube('b', 1, (100.11, 0, 1234567.8), 0.7))
        self.assert_round_trip(self.folder / 'a.obj')

    def test_attributes_and_groups_of_gltf(self):
        self.write('a.gltf', gltf(('site', {'Site': 'S'}, None, [
            ('wall', {'id': 'w', 'Pset_WallCommon': {'FireRating': 'F60'}, 'n': 12.5}, 0, []),
            ('level', {'Storey': 'Level 1'}, None, [('pipe', {'id': 'p'}, .05, [])])])))
        self.assert_round_trip(self.folder / 'a.gltf')
        self.text('convert', 'a.gltf', 'a.glb')
        listed = json.loads(self.text('info', 'a.glb', '--objects', 9, '--json'))['objects']
        self.assertIn(['Pset_WallCommon.FireRating', 'F60'], sum((o['attributes'] for o in listed), []))
        self.assertEqual(self.run_strake('draw', 'a.glb', '--select', '@"Pset_WallCommon.FireRating" = F60', '-o',
                                         'x.svg').returncode, 0)

    def test_a_project_and_several_files_become_one(self):
        self.two_files()
        self.text('convert', 'a.obj', 'b.obj', 'all.glb')
        listed = json.loads(self.text('info', 'all.glb', '--objects', 9, '--json'))['objects']
        self.assertEqual([(o['id'], o['path']) for o in listed], [('a0', 'a.obj/a0'), ('a1', 'a.obj/a1'), ('b0', 'b.obj/b0')])
        self.text('project', 'new', 'p.strake', 'a.obj', 'b.obj')
        self.text('convert', 'p.strake', 'project.glb')
        self.assertEqual((self.folder / 'project.glb').read_bytes(), (self.folder / 'all.glb').read_bytes())

    def test_from_the_second_time_on_bytes_are_the_same(self):
        self.text('generate', 'ship', '--objects', 200, '-o', 'ship.glb')
        (self.folder / 'a.rvm').write_bytes(rvm([('one', (0, 0, 0)), ('two', (50, 0.3, 0)), ('two', (0, 130, 0))]))
        self.write('b.obj', cube('a', 0, (0.1, 0.2, 0.3), 100.01))
        for files in (['ship.glb'], ['ship.glb', 'a.rvm', 'b.obj']):
            self.text('convert', *files, '1.glb')
            for n in (1, 2):
                shutil.copy(self.folder / f'{n}.glb', self.folder / 'x.glb')
                self.text('convert', 'x.glb', f'{n + 1}.glb')
            self.assertEqual((self.folder / '2.glb').read_bytes(), (self.folder / '3.glb').read_bytes(), files)

    def test_obj_is_written_by_its_suffix(self):
        self.text('generate', 'ship', '--objects', 100, '-o', 'ship.glb')
        self.text('convert', 'ship.glb', 'ship.obj')
        count = [json.loads(self.text('info', f, '--unit', 'mm', '--json', *axis))['total']['objects']
                 for f, axis in (('ship.obj', ['--up-axis', 'z']), ('ship.glb', []))]
        self.assertEqual(count[0], count[1])

    def test_what_is_wrong_is_stated(self):
        self.two_files()
        for arguments, code, words in (
                (['a.obj'], 2, 'one file is given'),
                (['a.obj', 'b.obj'], 2, 'is one of the inputs'),
                (['a.obj', 'x.step'], 2, '.glb'),
                (['a.obj', 'no/x.glb'], 3, 'no such folder'),
                (['none.obj', 'x.glb'], 3, 'none.obj'),
                (['a.obj', 'x.glb', '--sag', '0'], 2, '--sag')):
            done = self.run_strake('convert', *arguments) if arguments[-1] != 'b.obj' else self.run_strake(
                'convert', 'a.obj', 'b.obj', './b.obj')
            self.assertEqual(done.returncode, code, done.stderr)
            self.assertIn(words, done.stderr)
        self.assertEqual(self.files(), ['a.obj', 'b.obj'])

    def test_equal_bytes_for_any_number_of_threads(self):
        self.text('generate', 'ship', '--objects', 400, '-o', 'ship.glb')
        for threads in (1, 3):
            self.text('convert', 'ship.glb', f'{threads}.glb', '--threads', threads)
        self.assertEqual((self.folder / '1.glb').read_bytes(), (self.folder / '3.glb').read_bytes())

    @unittest.skipUnless(real_models(), 'STRAKE_DATA is not set')
    def test_real_models(self):
        for file in real_models():
            with self.subTest(file.name):
                if self.run_strake('info', file, '--quiet').returncode == 0:
                    self.assert_round_trip(file)


if __name__ == '__main__':
    main()
