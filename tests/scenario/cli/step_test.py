#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""step_test.py STRAKE MAKE_STEP_FILES: STEP and IGES files through their importer, which lies beside the program."""
import json
import os
import random
import re
import subprocess
import sys
from pathlib import Path

from scenario import Scenario, main

MUTATIONS = int(os.environ.get('STRAKE_STEP_MUTATIONS', '30'))


def mutated(chance, data):
    """The bytes of a file with a few faults: bytes, lines, numbers, references, an end that comes too soon."""
    data = bytearray(data)
    kind = chance.randrange(5)
    if kind == 0:
        for _ in range(chance.randint(1, 8)):
            data[chance.randrange(len(data))] = chance.randrange(256)
    elif kind == 1:
        lines = bytes(data).split(b'\n')
        first = chance.randrange(len(lines))
        del lines[first:first + chance.randint(1, 3)]
        data = b'\n'.join(lines)
    elif kind == 2:
        numbers = list(re.finditer(rb'(?<![#\w])\d+\.\d*(E[+-]?\d+)?', data))
        for at in sorted(chance.sample(numbers, min(3, len(numbers))), key=lambda found: -found.start()):
            data[at.start():at.end()] = chance.choice([b'1.E300', b'-1.E30', b'0.', b'1.E-300', b'1.E9'])
    elif kind == 3:
        references = list(re.finditer(rb'#\d+', data))
        if references:
            one, other = chance.choice(references), chance.choice(references)
            data[one.start():one.end()] = bytes(data[other.start():other.end()])
    else:
        data = data[:chance.randrange(len(data))] + b'\nENDSEC;\nEND-ISO-10303-21;\n'
    return bytes(data)


class Step(Scenario):
    MAKE = ''

    def setUp(self):
        super().setUp()
        subprocess.run([self.MAKE, str(self.folder)], check=True, capture_output=True, timeout=100)
        self.importer = str(Path(self.STRAKE).parent / 'strake-import-step')
        self.environment = {**os.environ, 'STRAKE_CACHE': 'off'}

    def run_strake(self, *arguments, **more):
        return super().run_strake(*arguments, env={**self.environment, **more.pop('env', {})}, **more)

    def import_file(self, file, *options):
        """Runs the importer; returns how it ended, its report and the bytes of its scene."""
        report, scene = self.folder / 'report.jsonl', self.folder / 'scene.glb'
        scene.unlink(missing_ok=True)
        done = subprocess.run([self.importer, '--input', str(self.folder / file), '--output', str(scene), '--report',
                               str(report), *map(str, options)], capture_output=True, timeout=300, check=False)
        lines = [json.loads(line) for line in report.read_text(encoding='utf-8').splitlines()]
        return done, lines, scene.read_bytes() if scene.exists() else b''

    def test_files_are_read_and_clash(self):
        done = self.run_strake('clash', 'rig.step', 'solid.igs', '--json')
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn('rig.step: STEP AP214, 11 objects, unit mm (stated), z up', done.stderr)
        self.assertIn('solid.igs: IGES, 1 objects, unit mm (stated), z up', done.stderr)
        pairs = {(row['a']['id'], row['b']['id']): row['class'] for row in json.loads(done.stdout)['results']}
        self.assertIn('HIT', pairs.values())
        codes = {one['code'] for one in json.loads(done.stdout)['diagnostics']}
        self.assertNotIn('unknown-sag', codes)
        done = self.run_strake('draw', 'rig.step', '--select', '@Instance = left and @Assembly = first', '--view', 'top', '-o',
                               'left.svg')
        self.assertIn('1 objects: 1 drawn', done.stderr)
        self.assertIn('  id        Rig/first/left\n', self.text('info', 'rig.step', '--objects', 20))
        self.assertIn('.step', self.text('info', '--formats'))
        self.text('draw', 'curved.step', '--view', 'top', '-o', 'curved.svg')
        self.assertIn('<path', (self.folder / 'curved.svg').read_text(encoding='utf-8'))

    def test_solids_are_closed(self):
        reported = self.text('info', 'curved.step')
        self.assertIn('6 solids, 0 sheets, 0 wires; 0 inside out', reported)
        self.assertIn('1 sheets', self.text('info', 'open.step'))
        self.assertIn('2 solids, 0 sheets', self.text('info', 'faces.igs'))

    def test_bytes_are_the_same_for_any_number_of_threads(self):
        for file in ('rig.step', 'curved.step', 'faces.igs'):
            scenes = {self.import_file(file, '--threads', threads)[2] for threads in (1, 2, 4, 1)}
            self.assertEqual(len(scenes), 1, file)
            self.assertTrue(scenes.pop().startswith(b'glTF'))

    def test_nothing_is_printed(self):
        for file in ('rig.step', 'faces.igs', 'open.step'):
            done, lines, _ = self.import_file(file)
            self.assertEqual((done.returncode, done.stdout), (0, b''), done.stderr)
            self.assertEqual(lines[-1]['made_by'].split()[:2], ['Open', 'CASCADE'])
        self.write('bad.step', 'ISO-10303-21;\nHEADER;\nENDSEC;\nDATA;\n#1=A(;\nENDSEC;\nEND-ISO-10303-21;\n')
        done, lines, _ = self.import_file('bad.step')
        self.assertEqual((done.returncode, done.stdout), (1, b''))
        self.assertEqual(lines[-1]['error'], "the file is damaged: line 5: a '(' of this statement is not closed")

    def test_triangles_are_as_fine_as_is_requested(self):
        def triangles(**environment):
            return int(re.search(r'triangles +(\d+)', self.text('info', 'curved.step', env=environment))[1])
        usual = triangles()
        self.assertGreater(triangles(STRAKE_IMPORT_SAG='0.01mm'), 2 * usual)
        self.assertLess(triangles(STRAKE_IMPORT_SAG='2mm'), usual)
        done = self.run_strake('info', 'curved.step', env={'STRAKE_IMPORT_SAG': '1'})
        self.assertEqual((done.returncode, 'STRAKE_IMPORT_SAG' in done.stderr), (2, True))

    def text(self, *arguments, **more):
        done = self.run_strake(*arguments, **more)
        self.assertEqual(done.returncode, 0, done.stderr)
        return done.stdout

    def test_a_file_in_part_states_what_it_lacks(self):
        text = (self.folder / 'rig.step').read_text(encoding='utf-8')
        whole = text.replace('\r', '')
        gone = re.search(r"\n#\d+ = ADVANCED_FACE[^;]*;", whole)
        (self.folder / 'rig.step').write_text(whole.replace(gone[0], '', 1), encoding='utf-8')
        done = self.run_strake('info', 'rig.step', '--strict')
        self.assertEqual(done.returncode, 4, done.stderr)
        self.assertIn('step-missing-entity', done.stderr)
        (self.folder / 'rig.step').write_text(text[:len(text) // 2], encoding='utf-8')
        self.assertIn('rig.step: the file ends too soon', self.run_strake('info', 'rig.step').stderr)

    def test_without_the_importer_it_is_stated_how_to_get_it(self):
        alone = self.folder / 'alone'
        alone.mkdir()
        (alone / 'strake').write_bytes(Path(self.STRAKE).read_bytes())
        (alone / 'strake').chmod(0o755)
        done = subprocess.run([alone / 'strake', 'clash', 'rig.step', 'faces.igs'], cwd=self.folder, text=True, timeout=100,
                              capture_output=True, check=False, env={**self.environment, 'PATH': '/nowhere'})
        self.assertEqual(done.returncode, 3)
        self.assertIn('rig.step: STEP and IGES files are read by the importer strake-import-step', done.stderr)
        self.assertEqual(len(done.stderr.splitlines()), 1)

    def test_damaged_files_are_read_or_refused(self):
        names = ('rig.step', 'curved.step', 'two_solids.step', 'faces.igs', 'solid.igs')
        whole = {name: (self.folder / name).read_bytes() for name in names}
        ends = {}
        for seed in range(MUTATIONS):
            chance = random.Random(seed)
            name = chance.choice(names)
            (self.folder / name).write_bytes(mutated(chance, whole[name]))
            done = self.run_strake('info', name, env={'STRAKE_IMPORT_LIMIT': '20'})
            self.assertIn(done.returncode, (0, 3), (seed, done.stderr))
            if done.returncode == 3:
                self.assertRegex(done.stderr, rf'{name}: .+\(.+\)', seed)
            ends[done.returncode] = ends.get(done.returncode, 0) + 1
        self.assertEqual(set(ends), {0, 3}, ends)


if __name__ == '__main__':
    Step.MAKE = sys.argv.pop(2)
    main()
