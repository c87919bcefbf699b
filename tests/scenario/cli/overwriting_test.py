#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""overwriting_test.py STRAKE: no output takes the place of a file that the run, or a project, reads, by whatever name."""
import base64
import json
import os
import re

from scenario import Scenario, VERBS, cube, gltf, main, rvm

# Every option that names a file to write: the command line up to its value, the ending of the value, and the files that
# must be as they were.
READ = ['box.obj', 'box.mtl', 'pipe.rvm', 'pipe.att', 'far.gltf', 'far.bin']
MODELS = ['box.obj', 'pipe.rvm', 'far.gltf']
STORED = ['p.strake', 'p.strake-wal', 'p.strake-shm']
OUTPUTS = [
    (['clash', *MODELS, '-o'], '.json', READ),
    (['clash', *MODELS, '-o'], '.csv', READ),
    (['clash', *MODELS, '--log-pairs'], '.csv', READ),
    (['clash', *MODELS, '--rules', 'r.toml', '--log-pairs'], '.csv', [*READ, 'r.toml']),
    (['clash', *MODELS, '--decisions', 'd.csv', '-o'], '.csv', [*READ, 'd.csv']),
    (['clash', *MODELS, '--write-decisions', '--decisions'], '.csv', READ),
    (['clash', 'p.strake', '--log-pairs'], '.csv', [*STORED, *READ]),
    (['clash', '-p', 'p.strake', '-o'], '.json', [*STORED, *READ]),
    (['clash', '-p', 'p.strake', '--log-pairs'], '.csv', [*STORED, *READ]),
    (['clash', 'diff', 'old.json', 'new.json', '-o'], '.json', ['old.json', 'new.json']),
    (['clash', 'list', '-p', 'p.strake', '-o'], '.csv', [*STORED, *READ]),
    (['clash', 'history', '-p', 'p.strake', '-o'], '.json', [*STORED, *READ]),
    (['draw', *MODELS, '-o'], '.svg', READ),
    (['draw', *MODELS, '-o'], '.view', READ),
    (['draw', *MODELS, '--sheet', 's.toml', '-o'], '.svg', [*READ, 's.toml', 'frame.svg']),
    (['draw', 'old.view', '-o'], '.svg', ['old.view']),
    (['draw', 'p.strake', '-o'], '.svg', [*STORED, *READ]),
    (['draw', '-p', 'p.strake', '-o'], '.json', [*STORED, *READ]),
    (['draw', '-p', 'p.strake', '--save', 'top', '-o'], '.svg', [*STORED, *READ]),
    (['draw', 'diff', 'old.view', 'new.view', '-o'], '.svg', ['old.view', 'new.view']),
    (['report', '-p', 'p.strake', '-o'], '.html', [*STORED, *READ]),
    (['clash', *MODELS, '-o'], '.html', READ),
    (['project', 'update', 'p.strake', '-o'], '.json', [*STORED, *READ]),
    (['project', 'update', 'p.strake', *MODELS, '-o'], '.csv', [*STORED, *READ]),
    (['project', 'export', 'p.strake', '-o'], '.glb', [*STORED, *READ]),
    (['project', 'export', 'p.strake', '-o'], '.csv', [*STORED, *READ]),
]
# Two outputs of one run are two files.
PAIRS = [
    (['clash', *MODELS, '-o', '{}', '--log-pairs', '{}'], '.csv'),
    (['clash', *MODELS, '-o', '{}', '--write-decisions', '--decisions', '{}'], '.csv'),
    (['clash', *MODELS, '--write-decisions', '--decisions', '{}', '--log-pairs', '{}'], '.csv'),
    (['draw', *MODELS, '-o', '{}', '-o', '{}'], '.svg'),
    (['generate', 'ship', '--objects', '100', '-o', '{}', '--truth', '{}'], '.json'),
]


class Overwriting(Scenario):
    def setUp(self):
        super().setUp()
        self.write('box.obj', 'mtllib box.mtl\n' + cube('box', 0, (0, 0, 0), 100))
        self.write('box.mtl', 'newmtl red\nKd 1 0 0\n')
        self.write_rvm('pipe.rvm', [('pipe', (50, 0, 0))])
        self.write('pipe.att', 'CADC_Attributes_File v1.0 , start: NEW , end: END , name_end: := , sep: &end&\nNEW pipe\nEND\n')
        document = json.loads(gltf(('far', {}, .05, [])))
        (self.folder / 'far.bin').write_bytes(base64.b64decode(document['buffers'][0]['uri'].split(',')[1]))
        document['buffers'][0]['uri'] = 'far.bin'
        self.write('far.gltf', json.dumps(document))
        self.write('r.toml', '[[test]]\nname = "all"\n')
        self.write('s.toml', 'arrangement = "first-angle"\n[sheet]\ntemplate = "frame.svg"\n')
        self.write('frame.svg', '<svg xmlns="http://www.w3.org/2000/svg" width="420mm" height="297mm" '
                                'viewBox="0 0 420 297"></svg>')
        self.text('clash', *MODELS, '-o', 'old.json', '-o', 'new.json')
        self.write('d.csv', 'key,status,by,date,comment\n')
        self.text('draw', *MODELS, '-o', 'old.view', '-o', 'new.view')
        self.text('project', 'new', 'p.strake', *MODELS)
        os.mkdir(self.folder / 'sub')
        os.symlink('.', self.folder / 'way')

    def contents(self):
        return {path.name: path.read_bytes() for path in self.folder.iterdir() if path.is_file()}

    def refused(self, command, before, name):
        done = self.run_strake(*command)
        self.assertIn(name, done.stderr)
        # What decisions are added to is read first, and no model is a file of decisions.
        if '--write-decisions' in command:
            self.assertIn(done.returncode, (2, 3), (command, done.stderr))
        else:
            self.assertEqual(done.returncode, 2, (command, done.stderr))
            self.assertIn('would be overwritten', done.stderr)
        self.assertEqual({n: c for n, c in self.contents().items() if n in before}, before, command)
        self.assertFalse([n for n in self.files() if n.endswith('.part')])

    def test_no_output_is_a_file_that_is_read(self):
        for command, ending, kept in OUTPUTS:
            for name in kept:
                with self.subTest(command=command, name=name):
                    link = 'x' + ending
                    (self.folder / link).unlink(missing_ok=True)
                    if name in STORED[1:]:  # SQLite makes them as it goes, and takes them away
                        os.symlink(name, self.folder / link)
                        self.refused([*command, link], {}, link)
                        (self.folder / link).unlink()
                        continue
                    before = self.contents()
                    os.symlink(name, self.folder / link)
                    for way in (link, './' + link, f'sub/../{link}', f'way/{link}', str(self.folder / link)):
                        self.refused([*command, way], before, link)
                    (self.folder / link).unlink()
                    os.link(self.folder / name, self.folder / link)
                    self.refused([*command, link], before, link)
                    (self.folder / link).unlink()
                    if name.endswith(ending):
                        for way in ('./' + name, f'sub/../{name}', f'way/{name}', str(self.folder / name)):
                            self.refused([*command, way], before, name)

    def test_what_no_run_reads_may_be_written(self):
        """The same command lines with a file of no other use, which is there already."""
        for command, ending, _ in OUTPUTS:
            with self.subTest(command):
                self.write('x' + ending, 'key,status,by,date,comment\n')
                done = self.run_strake(*command, 'x' + ending)
                self.assertEqual(done.returncode, 0, (command, done.stderr))
                (self.folder / ('x' + ending)).unlink()

    def test_a_companion_that_an_output_is_named_after(self):
        """A model may call its materials what it wants."""
        self.write('box.csv', 'newmtl red\nKd 1 0 0\n')
        self.write('box.obj', 'mtllib box.csv\n' + cube('box', 0, (0, 0, 0), 100))
        self.text('project', 'new', 'q.strake', 'box.obj')
        before = self.contents()
        for command in (['clash', 'box.obj', '-o'], ['clash', 'q.strake', '--log-pairs'],
                        ['project', 'update', 'q.strake', '-o'], ['project', 'export', 'q.strake', '-o']):
            self.refused([*command, 'box.csv'], before, "'box.csv' is read with ")

    def test_no_two_outputs_are_one_file(self):
        for command, ending in PAIRS:
            for second in ('./x' + ending, 'sub/../x' + ending, 'way/x' + ending, 'link' + ending):
                with self.subTest(command=command, second=second):
                    names = iter(('x' + ending, second))
                    os.symlink('x' + ending, self.folder / ('link' + ending))
                    before = self.contents()
                    done = self.run_strake(*(next(names) if word == '{}' else word for word in command))
                    self.assertEqual(done.returncode, 2, done.stderr)
                    self.assertEqual(self.contents(), before)
                    (self.folder / ('link' + ending)).unlink()

    def test_an_evaluation_spares_what_it_is_compared_with(self):
        self.text('evaluate', '--scale', '0.001', '--only', 'detail', '--threads', '1', '--repeat', '1', '--limit', '0.1',
                  '-o', 'before')
        os.mkdir(self.folder / 'after')
        os.symlink('../before/evaluation.json', self.folder / 'after' / 'evaluation.csv')
        state = self.folder / 'before' / 'evaluation.json'
        before = state.read_bytes()
        done = self.run_strake('evaluate', '--scale', '0.001', '--only', 'detail', '--threads', '1', '--repeat', '1', '--limit',
                               '0.1', '-o', 'after', '--compare', 'before/evaluation.json')
        self.assertEqual(done.returncode, 2, done.stderr)
        self.assertEqual(state.read_bytes(), before)

    def test_a_folder_of_pictures_spares_what_is_read(self):
        os.mkdir(self.folder / 'drawn')
        self.write('drawn/box.obj', cube('box', 0, (0, 0, 0), 100))
        done = self.run_strake('clash', 'drawn/box.obj', '--pictures', 'drawn')
        self.assertEqual(done.returncode, 3, done.stderr)
        self.assertIn('drawn: holds something else than pictures', done.stderr)
        self.assertEqual([f.name for f in (self.folder / 'drawn').iterdir()], ['box.obj'])

    def test_every_option_that_names_an_output_is_tried(self):
        """An option whose help says that a file is written stands above."""
        tried = {(' '.join(word for word in command[:2] if word in ('clash', 'draw', 'diff', 'list', 'history', 'project', 'report',
                                                                    'update', 'export')), command[-1])
                 for command, _, _ in OUTPUTS} | {('generate ship', '-o'), ('generate ship', '--truth'), ('evaluate', '-o'),
                                          ('clash', '--pictures')}
        for verb in VERBS:
            text = self.text(*verb, '--help')
            for short, long in re.findall(r'^  (?:(-\w),)?(--[a-z-]+) F(?:ILE|OLDER)\b', text, re.MULTILINE):
                # --tile-folder takes files of names that no user has.
                if long in ('--project', '--rules', '--sheet', '--compare', '--peers', '--bcf', '--tile-folder'):
                    continue
                self.assertIn((' '.join(verb), short or long), tried)


if __name__ == '__main__':
    main()
