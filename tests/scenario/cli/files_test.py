#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""files_test.py STRAKE: what cannot be read or written, and what is left behind."""
import json
import os
import resource
import subprocess

from scenario import Scenario, cube, main


class Files(Scenario):
    def test_input_that_cannot_be_read_names_the_file(self):
        self.write('empty.obj', '')
        self.write('noise.xyz', 'neither fish nor fowl\n')
        for verb in (['info'], ['clash', '-o', 'x.json'], ['draw', '-o', 'x.svg']):
            for name in ('missing.rvm', 'empty.obj', 'noise.xyz'):
                with self.subTest(verb=verb, name=name):
                    done = self.run_strake(*verb, name)
                    self.assertEqual(done.returncode, 3, done.stderr)
                    self.assertIn(name, done.stderr)
        self.assertEqual(self.files(), ['empty.obj', 'noise.xyz'])

    def test_output_that_cannot_be_written_leaves_nothing(self):
        self.two_files()
        done = self.run_strake('clash', 'a.obj', '-o', 'no/such/folder/x.json')
        self.assertEqual(done.returncode, 3)
        self.assertIn('no/such/folder', done.stderr)
        done = self.run_strake('info', 'a.obj', stdin=None)
        self.assertEqual(done.returncode, 0)
        with open('/dev/full', 'w', encoding='utf-8') as full:
            done = subprocess.run([self.STRAKE, 'info', 'a.obj'], stdout=full, stderr=subprocess.PIPE,
                                  text=True, cwd=self.folder, timeout=100, check=False)
        self.assertEqual(done.returncode, 3)
        self.assertIn('standard output', done.stderr)
        self.assertEqual(self.files(), ['a.obj', 'b.obj'])

    # Every kind of file that the program writes: the command line up to its name, and its ending.
    OUTPUTS = [*((['clash', 'a.obj', '-o'], ending)
                 for ending in ('.json', '.csv', '.xlsx', '.xml', '.ifcclash.json', '.joints.csv', '.svg', '.glb', '.bcf')),
               (['clash', 'a.obj', '--log-pairs'], '.csv'), (['clash', 'diff', 'old.json', 'old.json', '-o'], '.json'),
               (['draw', 'a.obj', '-o'], '.svg'), (['draw', 'a.obj', '-o'], '.pdf'),
               (['draw', 'a.obj', '-o'], '.dxf'), (['draw', 'a.obj', '-o'], '.json'), (['draw', 'a.obj', '-o'], '.view'),
               (['clash', 'a.obj', '-o'], '.html'), (['draw', 'a.obj', '-o'], '.html'),
               (['draw', 'a.obj', '--sheet', 'sheet.toml', '-o'], '.svg'),
               (['draw', 'a.obj', '--sheet', 'sheet.toml', '-o'], '.pdf'),
               (['draw', 'a.obj', '--sheet', 'sheet.toml', '-o'], '.dxf'),
               (['draw', 'diff', 'old.view', 'old.view', '-o'], '.json'),
               (['draw', 'diff', 'old.view', 'old.view', '-o'], '.svg'),
               (['generate', 'ship', '--objects', '100', '-o'], '.glb'),
               (['generate', 'ship', '--objects', '100', '-o'], '.obj'),
               (['generate', 'ship', '--objects', '100', '-o', 'null.glb', '--truth'], '.json')]

    def test_a_failed_write_is_reported_and_leaves_nothing(self):
        """A file larger than the limit on files, and a full disk."""
        self.two_files()
        os.symlink('/dev/null', self.folder / 'null.glb')
        self.write('sheet.toml', 'arrangement = "first-angle"\n')
        self.assertEqual(self.run_strake('clash', 'a.obj', '-o', 'old.json').returncode, 0)
        self.assertEqual(self.run_strake('draw', 'a.obj', '-o', 'old.view').returncode, 0)
        before = self.files()

        def small_files_only():
            resource.setrlimit(resource.RLIMIT_FSIZE, (16, 16))

        for arguments, ending in self.OUTPUTS:
            with self.subTest(arguments=arguments, ending=ending):
                done = self.run_strake(*arguments, 'x' + ending, preexec_fn=small_files_only)
                self.assertEqual(done.returncode, 3, done.stderr)
                self.assertIn(f'x{ending}: cannot be written: File too large', done.stderr)
                self.assertIn('ulimit -f', done.stderr)
                self.assertEqual(self.files(), before)
                os.symlink('/dev/full', self.folder / ('x' + ending))
                done = self.run_strake(*arguments, 'x' + ending)
                self.assertEqual(done.returncode, 3, done.stderr)
                self.assertIn('No space left on device', done.stderr)
                os.unlink(self.folder / ('x' + ending))
                self.assertEqual(self.files(), before)

    def test_standard_output_that_is_full_is_reported(self):
        self.two_files()
        self.assertEqual(self.run_strake('clash', 'a.obj', '-o', 'old.json').returncode, 0)
        for arguments in (['clash', 'a.obj'], ['clash', 'a.obj', '--json'], ['info', 'a.obj'],
                          ['clash', 'diff', 'old.json', 'old.json'], ['draw', 'a.obj', '--json'], ['--help'],
                          ['clash', '--help'], ['--version']):
            with self.subTest(arguments), open('/dev/full', 'w', encoding='utf-8') as full:
                done = subprocess.run([self.STRAKE, *arguments], stdout=full, stderr=subprocess.PIPE, text=True,
                                      cwd=self.folder, timeout=100, check=False)
                self.assertEqual(done.returncode, 3, done.stderr)
                self.assertIn('standard output: cannot be written: No space left on device', done.stderr)

    def test_an_old_result_survives_a_failed_run(self):
        self.write('x.json', 'old')
        self.assertEqual(self.run_strake('clash', 'missing.obj', '-o', 'x.json').returncode, 3)
        self.assertEqual((self.folder / 'x.json').read_text(), 'old')

    def test_a_model_is_never_overwritten(self):
        self.two_files()
        model = (self.folder / 'a.obj').read_text()
        self.write('model.json', model)
        os.symlink('model.json', self.folder / 'link.json')
        os.mkdir(self.folder / 'sub')
        for arguments in (['clash', 'model.json', '-o', 'model.json'], ['clash', 'model.json', '-o', 'link.json'],
                          ['draw', 'link.json', '-o', 'x.svg', '-o', './sub/../model.json']):
            with self.subTest(arguments):
                done = self.run_strake(*arguments)
                self.assertEqual(done.returncode, 2, done.stderr)
                self.assertIn('overwritten', done.stderr)
                self.assertEqual((self.folder / 'model.json').read_text(), model)

    def test_two_outputs_that_are_one_file_are_stated_at_once(self):
        os.mkdir(self.folder / 'sub')
        os.symlink('sub', self.folder / 'way')
        os.symlink('y.json', self.folder / 'link.csv')
        os.symlink('sub/../link.csv', self.folder / 'chain.csv')
        os.symlink(self.folder / 'way' / 'z.json', self.folder / 'far.csv')
        self.write('old.json', 'old')
        os.link(self.folder / 'old.json', self.folder / 'hard.csv')
        for first, second in (('y.json', 'link.csv'), ('link.csv', 'y.json'), ('./sub/../y.json', 'chain.csv'),
                              ('sub/z.json', 'far.csv'), ('way/z.json', 'sub/z.json'), ('old.json', 'hard.csv'),
                              ('link.csv', 'chain.csv')):
            with self.subTest(first=first, second=second):
                done = self.run_strake('clash', 'missing.obj', '-o', first, '-o', second)
                self.assertEqual(done.returncode, 2, done.stderr)
                self.assertIn('twice', done.stderr)
                done = self.run_strake('clash', 'missing.obj', '-o', first, '--log-pairs', second)
                self.assertEqual(done.returncode, 2, done.stderr)
        self.assertEqual((self.folder / 'old.json').read_text(), 'old')

    def test_an_output_behind_a_link_is_written_through_it(self):
        self.two_files()
        self.write('there.json', 'old')
        os.chmod(self.folder / 'there.json', 0o666)
        os.symlink('there.json', self.folder / 'link.json')
        os.symlink('new.csv', self.folder / 'link.csv')
        done = self.run_strake('clash', 'a.obj', 'b.obj', '-o', 'link.json', '-o', 'link.csv')
        self.assertEqual(done.returncode, 0, done.stderr)
        for link, file in (('link.json', 'there.json'), ('link.csv', 'new.csv')):
            self.assertTrue((self.folder / link).is_symlink())
            self.assertGreater((self.folder / file).stat().st_size, 100)
        self.assertEqual((self.folder / 'there.json').stat().st_mode & 0o777, 0o666)

    def test_outputs_have_names_of_any_legal_length(self):
        self.two_files()
        for length in (230, 245, 255):
            name = 'n' * (length - 5) + '.json'
            done = self.run_strake('clash', 'a.obj', 'b.obj', '-o', name)
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertTrue((self.folder / name).exists())
            name = 'n' * (length - 4) + '.glb'
            done = self.run_strake('generate', 'ship', '--objects', 100, '-o', name)
            self.assertEqual(done.returncode, 0, done.stderr)

    def test_outputs_that_cannot_be_are_refused_at_once(self):
        self.two_files()
        done = self.run_strake('draw', 'missing.obj', '-o', 'x.svg', '-o', './x.svg')
        self.assertEqual(done.returncode, 2)
        self.assertIn('twice', done.stderr)
        os.mkdir(self.folder / 'dir.svg')
        done = self.run_strake('draw', 'missing.obj', '-o', 'dir.svg')
        self.assertEqual(done.returncode, 3)
        self.assertIn('it is a folder', done.stderr)

    def test_a_pipe_that_nobody_writes_to_is_refused_at_once(self):
        os.mkfifo(self.folder / 'pipe')
        done = self.run_strake('info', 'pipe')
        self.assertEqual(done.returncode, 3)
        self.assertIn('not a regular file', done.stderr)

    def test_closed_standard_streams_do_not_end_in_a_result(self):
        self.two_files()
        done = subprocess.run(['/bin/sh', '-c', '"$0" clash a.obj -o x.json >&- 2>&- <&-', self.STRAKE],
                              cwd=self.folder, timeout=100, check=False)
        self.assertEqual(done.returncode, 3)
        json.loads((self.folder / 'x.json').read_text())

    def test_names_cannot_command_the_terminal(self):
        self.write('evil.obj', cube('\x1b[2J\u202egpj', 0, (0, 0, 0), 1).replace('f 4 1 5 8\n', ''))
        for arguments in (['info', 'evil.obj'], ['clash', 'evil.obj'], ['info', 'a\x1b[2J.obj']):
            done = self.run_strake(*arguments)
            for text in (done.stdout, done.stderr):
                self.assertNotIn('\x1b', text)
                self.assertNotIn('\u202e', text)


if __name__ == '__main__':
    main()
