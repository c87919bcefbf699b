#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""importers_test.py STRAKE PAGE: files that importers read, with the example of the page as one of them."""
import json
import os
import re
import signal
import subprocess
import sys
import time
from pathlib import Path

from scenario import Scenario, main

BOXES = 'a 0 0 0 100 100 100\nb 50 50 50 100 100 100\n'


class Importers(Scenario):
    PAGE = ''

    def setUp(self):
        super().setUp()
        (self.folder / 'bin').mkdir()
        example = re.search(r'```python\n(.*?)```', Path(self.PAGE).read_text(encoding='utf-8'), re.DOTALL)[1]
        self.script('strake-import-boxes', example.replace('\nreport =', f'\nopen({str(self.folder / "calls")!r}, "a").write("x")\nreport ='))
        self.environment = {**os.environ, 'PATH': f'{self.folder}/bin:{os.environ["PATH"]}',
                            'STRAKE_CACHE': str(self.folder / 'cache')}
        self.write('model.boxes', BOXES)

    def script(self, name, text):
        path = self.folder / 'bin' / name
        path.write_text(text, encoding='utf-8')
        path.chmod(0o755)

    def run_strake(self, *arguments, **more):
        return super().run_strake(*arguments, env={**self.environment, **more.pop('env', {})}, **more)

    def calls(self):
        path = self.folder / 'calls'
        return len(path.read_text()) if path.exists() else 0

    def clashes(self, *files, **more):
        done = self.run_strake('clash', *files, '--json', **more)
        self.assertEqual(done.returncode, 0, done.stderr)
        return done

    def test_the_example_of_the_page_is_read_and_its_scene_is_kept(self):
        first = self.clashes('model.boxes')
        self.assertIn('model.boxes: BOXES, 2 objects, unit mm (stated), z up', first.stderr)
        reported = json.loads(first.stdout)
        self.assertEqual([row['class'] for row in reported['results']], ['HIT'])
        self.assertEqual(self.clashes('model.boxes').stdout, first.stdout)
        self.assertEqual(self.calls(), 1, 'the scene is found')
        off = self.clashes('model.boxes', env={'STRAKE_CACHE': 'off'})
        self.assertEqual(off.stdout, first.stdout)
        self.assertEqual(self.calls(), 2)
        with open(self.folder / 'bin' / 'strake-import-boxes', 'a', encoding='utf-8') as program:
            program.write('# a newer version\n')
        self.assertEqual(self.clashes('model.boxes').stdout, first.stdout)
        self.assertEqual(self.calls(), 3, 'a changed importer makes it anew')
        listed = self.text('info', 'model.boxes', '--objects', 2)
        self.assertIn('100 x 100 x 100', listed)
        self.assertIn('strake-import-boxes', self.text('info', '--formats'))

    def test_importers_are_looked_for_in_folders_of_path_and_never_in_the_current_one(self):
        abused = self.folder / 'abused'
        (self.folder / 'sub').mkdir()
        for name in ('strake-import-odd', 'strake-import', 'sub/strake-import-odd', 'strake-import-boxes'):
            self.write(name, f'#!/bin/sh\ntouch {abused}\n')
            (self.folder / name).chmod(0o755)
        self.write('model.odd', 'x')
        for path in (':', '.:', 'sub:', './sub:', '../' + self.folder.name + ':'):
            done = self.run_strake('info', 'model.odd', env={'PATH': path + self.environment['PATH']})
            self.assertEqual(done.returncode, 3, path)
            self.assertIn('model.odd: unsupported format (Strake reads RVM', done.stderr)
            self.assertIn('a program strake-import-odd in PATH would be taken, too', done.stderr)
        self.clashes('model.boxes')
        self.assertFalse(abused.exists())
        # What does not end in letters and digits names no program.
        for name in ('model.odd~', 'model.a-b', 'model.', 'model', 'model.averylongsuffix'):
            self.write(name, 'x')
            self.assertIn('unsupported format', self.run_strake('info', name).stderr)

    def test_what_is_left_out_and_why_nothing_came_of_it(self):
        self.write('half.boxes', BOXES + 'no box\n')
        done = self.run_strake('info', 'half.boxes', '--strict')
        self.assertEqual(done.returncode, 4)
        self.assertIn('boxes-line: half.boxes, line 3: is no box', done.stderr)
        self.write('empty.boxes', 'nothing\n')
        done = self.run_strake('info', 'empty.boxes')
        self.assertEqual(done.returncode, 3)
        self.assertIn('empty.boxes: holds no box (write a name', done.stderr)

    def test_results_are_the_same_for_any_number_of_threads(self):
        names = []
        for i in range(4):
            names.append(f'm{i}.boxes')
            self.write(names[-1], ''.join(f'b{i}-{k} {k * 90 + i * 30} {i * 20} 0 100 100 100\n' for k in range(20)))
        outputs = {self.clashes(*names, '--threads', threads, env={'STRAKE_CACHE': cache}).stdout
                   for threads in (1, 4) for cache in ('off', str(self.folder / 'cache'))}
        self.assertEqual(len(outputs), 1)

    def test_two_processes_at_once(self):
        runs = [subprocess.Popen([self.STRAKE, 'clash', 'model.boxes', '--json', '--quiet'], cwd=self.folder,
                                 env=self.environment, stdout=subprocess.PIPE) for _ in range(4)]
        outputs = {run.communicate(timeout=100)[0] for run in runs}
        self.assertEqual([run.returncode for run in runs], [0] * 4)
        self.assertEqual(len(outputs), 1)
        self.assertEqual(len(list((self.folder / 'cache' / 'scenes').iterdir())), 1)

    @staticmethod
    def is_alive(process):
        """Whether it still runs; who waits for it may not have taken notice of its end."""
        try:
            return Path(f'/proc/{process}/stat').read_text(encoding='ascii').rsplit(')', 1)[1].split()[0] != 'Z'
        except OSError:
            return False

    def test_ctrl_c_ends_the_importer(self):
        self.script('strake-import-slow', f'#!/bin/sh\ncd {self.folder}; echo $$ > pid.part; mv pid.part pid; sleep 300\n')
        self.write('model.slow', 'x')
        run = subprocess.Popen([self.STRAKE, 'clash', 'model.slow'], cwd=self.folder, env=self.environment,
                               stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
        until = time.monotonic() + 60
        while not (self.folder / 'pid').exists() and time.monotonic() < until:
            time.sleep(0.01)
        importer = int((self.folder / 'pid').read_text())
        run.send_signal(signal.SIGINT)
        _, reported = run.communicate(timeout=60)
        self.assertEqual(run.returncode, 130, reported)
        until = time.monotonic() + 30
        while self.is_alive(importer) and time.monotonic() < until:
            time.sleep(0.01)
        self.assertFalse(self.is_alive(importer))

    def test_a_silent_importer_and_one_that_crashes(self):
        self.script('strake-import-slow', '#!/bin/sh\necho hm; sleep 300\n')
        self.write('model.slow', 'x')
        done = self.run_strake('info', 'model.slow', env={'STRAKE_IMPORT_LIMIT': '0.3'})
        self.assertEqual(done.returncode, 3)
        self.assertIn('model.slow: strake-import-slow was ended after 0.3 s without progress', done.stderr)
        self.script('strake-import-slow', '#!/bin/sh\nkill -ABRT $$\n')
        self.assertIn('signal 6 (abort)', self.run_strake('info', 'model.slow').stderr)
        done = self.run_strake('info', 'model.slow', env={'STRAKE_IMPORT_LIMIT': 'soon'})
        self.assertEqual((done.returncode, 'STRAKE_IMPORT_LIMIT' in done.stderr), (2, True))

    def test_files_lie_on_a_map_where_that_is_requested(self):
        importer = self.folder / 'bin' / 'strake-import-boxes'
        place = '{"crs": "EPSG:25832", "matrix": [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, %s, 5428000250, 110000, 1]}'
        importer.write_text(importer.read_text(encoding='utf-8').replace(
            'depends_on=[]', f"depends_on=[], map=json.loads({place!r} % (463000500 + 1000 * ('far' in options.input)))"))
        self.write('far.boxes', 'c 50 50 50 100 100 100\n')
        local = self.clashes('model.boxes', 'far.boxes')
        self.assertEqual(len(json.loads(local.stdout)['results']), 2)
        self.assertIn('map-place-differs', local.stderr)
        placed = self.clashes('model.boxes', 'far.boxes', '--georeference')
        self.assertEqual(json.loads(placed.stdout)['results'], [])
        self.assertNotIn('map-', placed.stderr)
        points = [json.loads(self.clashes('model.boxes', *words).stdout)['results'][0]['point_mm']
                  for words in ([], ['--georeference'])]
        self.assertEqual([round(y - x, 3) for x, y in zip(*points)], [463000500, 5428000250, 110000])
        self.assertEqual(self.calls(), 2, 'one scene of each file serves both')
        self.text('project', 'new', 'x.strake', 'model.boxes')
        for words in (('x.strake',), ('-p', 'x.strake')):
            done = self.run_strake('clash', *words, '--georeference')
            self.assertEqual(done.returncode, 2, done.stderr)
            self.assertIn('--georeference', done.stderr)

        self.text('project', 'new', 'two.strake', 'model.boxes', 'far.boxes')
        for words in (('two.strake',), ('-p', 'two.strake')):
            done = self.clashes(*words)
            self.assertEqual([row['key'] for row in json.loads(done.stdout)['results']],
                             [row['key'] for row in json.loads(local.stdout)['results']])
            self.assertEqual([line for line in done.stderr.splitlines() if 'map-place-differs' in line],
                             [line for line in local.stderr.splitlines() if 'map-place-differs' in line])
        self.text('project', 'remove', 'two.strake', 'far.boxes')
        self.assertNotIn('map-place-differs', self.clashes('two.strake').stderr)

    def test_a_project_takes_such_files(self):
        self.text('project', 'new', 'x.strake', 'model.boxes')
        self.write('more.boxes', 'c 400 0 0 50 50 50\n')
        self.text('project', 'add', 'x.strake', 'more.boxes')
        self.assertEqual(self.calls(), 2)
        self.text('project', 'update', 'x.strake')
        self.assertEqual(self.calls(), 2, 'nothing changed')
        self.write('more.boxes', 'c 50 0 0 50 50 50\n')
        self.text('project', 'update', 'x.strake')
        self.assertEqual(self.calls(), 3)
        of_project = json.loads(self.text('clash', 'x.strake', '--json'))['results']
        self.assertEqual(of_project, json.loads(self.text('clash', 'model.boxes', 'more.boxes', '--json'))['results'])

    def test_the_cache_is_listed_and_cleared(self):
        self.assertIn('0 scenes in', self.text('cache', 'list'))
        self.clashes('model.boxes')
        listed = json.loads(self.text('cache', 'list', '--json'))
        self.assertEqual([(s['file'], s['format'], s['made_by']) for s in listed['scenes']],
                         [('model.boxes', 'BOXES', 'boxes 1.0')])
        self.assertIn('model.boxes  BOXES made by boxes 1.0', self.text('cache', 'list'))
        scene = self.folder / 'cache' / 'scenes' / listed['scenes'][0]['scene']
        self.assertEqual(self.text('cache', 'clear', '--older-than', '30d'), 'removed 0 scenes, 0.0 MB\n')
        os.utime(scene, (time.time() - 40 * 86400,) * 2)
        self.assertEqual(json.loads(self.text('cache', 'clear', '--older-than', '30d', '--json'))['removed'], 1)
        self.assertFalse(scene.exists())
        for wrong in ('30', 'soon', '-1d'):
            self.assertEqual(self.run_strake('cache', 'clear', f'--older-than={wrong}').returncode, 2)

    def test_what_to_install(self):
        (self.folder / 'plan.ifc').write_bytes(b'ISO-10303-21;\n')
        done = self.run_strake('clash', 'plan.ifc', 'model.boxes', env={'PATH': '/nowhere'})
        self.assertEqual(done.returncode, 3)
        self.assertEqual(done.stderr.count('\n'), 1)
        self.assertIn("IFC files are read by an importer: pip install 'strake[ifc]'", done.stderr)


if __name__ == '__main__':
    Importers.PAGE = sys.argv.pop(2)
    main()
