#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""project_read_only_test.py STRAKE: a project that may be read and not written is read, and left as it was."""
import contextlib
import os
import sqlite3

from scenario import main
from ship_project import CLASH, VIEW, ProjectScenario

NOBODY = 65534


class ReadOnly(ProjectScenario):
    """A folder and a file that the user may not write in; root may, so that root becomes another one."""

    def setUp(self):
        super().setUp()
        self.as_user = {}
        if os.geteuid() == 0:
            self.as_user = {'user': NOBODY, 'group': NOBODY, 'extra_groups': []}
            try:
                self.run_strake('--version', **self.as_user)
            except PermissionError:
                self.skipTest('the program lies where others may not read')
        os.chmod(self.folder / 'p.strake', 0o444)
        os.chmod(self.folder, 0o555)

    def tearDown(self):
        os.chmod(self.folder, 0o755)
        super().tearDown()

    def test_reading_needs_no_writing(self):
        for command in (['project', 'list', 'p.strake'], ['project', 'check', 'p.strake'], ['info', 'p.strake'],
                        ['clash', 'p.strake', '--clearance', '25mm'], ['clash', 'list', '-p', 'p.strake']):
            with self.subTest(command):
                done = self.run_strake(*command, **self.as_user)
                self.assertEqual(done.returncode, 0, done.stderr)

    def test_writing_is_refused_and_changes_nothing(self):
        content = (self.folder / 'p.strake').read_bytes()
        for command in (['project', 'add', 'p.strake', 'more.glb'], CLASH, [*VIEW, '--json']):
            with self.subTest(command):
                done = self.run_strake(*command, **self.as_user)
                self.assertEqual(done.returncode, 3, done.stderr)
                self.assertIn('p.strake', done.stderr)
        self.assertEqual((self.folder / 'p.strake').read_bytes(), content)
        self.assertEqual(self.files(), ['more.glb', 'p.strake', 'ship.glb', 'x.svg'])


class ReadOnlyFile(ProjectScenario):
    """A project that the user may not write to, in a folder where others may make files: nothing is left beside it."""

    def setUp(self):
        super().setUp()
        if os.geteuid() != 0:
            self.skipTest('only root becomes another user')
        self.as_user = {'user': NOBODY, 'group': NOBODY, 'extra_groups': []}
        try:
            self.run_strake('--version', **self.as_user)
        except PermissionError:
            self.skipTest('the program lies where others may not read')
        (self.folder / 'x.svg').unlink()
        os.chmod(self.folder / 'p.strake', 0o444)
        os.chmod(self.folder, 0o777)
        self.left = self.files()

    @contextlib.contextmanager
    def log_kept(self):
        """A comment of everything stands in the write log only, as while its writer is at work."""
        with contextlib.closing(sqlite3.connect(self.folder / 'p.strake')) as other:
            other.execute('BEGIN')
            other.execute('SELECT count(*) FROM file').fetchall()
            self.text('clash', 'set', '-p', 'p.strake', '--select', "name = '*'", '--comment', 'in the log')
            yield

    def test_nothing_is_left_by_readers_nor_by_refused_writers(self):
        for code, command in ((0, ['project', 'list', 'p.strake']), (0, ['project', 'check', 'p.strake']),
                              (0, ['project', 'info', 'p.strake']), (0, ['info', 'p.strake']),
                              (0, ['clash', 'p.strake', '--clearance', '25mm']), (0, ['clash', 'list', '-p', 'p.strake']),
                              (0, ['draw', '-p', 'p.strake', '--json']), (3, ['project', 'add', 'p.strake', 'more.glb']),
                              (3, CLASH), (3, [*VIEW, '--json']), (3, ['clash', 'set', '-p', 'p.strake', '--select', "name = '*'",
                                                                       '--status', 'reviewed'])):
            with self.subTest(command):
                done = self.run_strake(*command, **self.as_user)
                self.assertEqual(done.returncode, code, done.stderr)
                self.assertEqual(self.files(), self.left)

    def test_what_a_killed_writer_left_is_not_passed_over(self):
        """Rows that are only in the write log: a reader who cannot put them into the file reads them where they are, by the
        index that lies there, or says that it cannot."""
        with self.log_kept():
            copies = {name: (self.folder / name).read_bytes() for name in ('p.strake', 'p.strake-wal')}
        for index in (None, b''):
            for path in self.folder.glob('p.strake*'):
                path.unlink()
            for name, content in copies.items():
                (self.folder / name).write_bytes(content)
                os.chmod(self.folder / name, 0o444)
            if index is not None:
                (self.folder / 'p.strake-shm').write_bytes(index)
                os.chmod(self.folder / 'p.strake-shm', 0o444)
            before = {path.name: path.read_bytes() for path in self.folder.iterdir()}
            for command in (['clash', 'list', '-p', 'p.strake'], ['clash', 'p.strake'], ['project', 'check', 'p.strake']):
                with self.subTest(index=index, command=command):
                    done = self.run_strake(*command, **self.as_user)
                    if index is None:
                        self.assertEqual(done.returncode, 3, done.stdout)
                        self.assertIn('p.strake: was not closed', done.stderr)
                        self.assertIn('-wal', done.stderr)
                    elif 'list' in command:
                        self.assertIn('in the log', done.stdout)
                    self.assertEqual({path.name: path.read_bytes() for path in self.folder.iterdir()}, before)
        # Whoever may write puts the log into the file.
        self.assertIn('in the log', self.text('clash', 'list', '-p', 'p.strake'))
        self.assertEqual(self.files(), self.left)

    def test_a_reader_sees_what_a_writer_at_work_has_stored(self):
        with self.log_kept():
            before = self.files()
            done = self.run_strake('clash', 'list', '-p', 'p.strake', **self.as_user)
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertIn('in the log', done.stdout)
            self.assertEqual(self.files(), before)
        self.assertEqual(self.files(), self.left)


if __name__ == '__main__':
    main()
