#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""project_safety_test.py STRAKE: a project survives kills, full disks, other processes and damage.
STRAKE_KILLS says how many kills and how many damaged files there are (default 30)."""
import contextlib
import ctypes
import os
import random
import resource
import shutil
import signal
import sqlite3
import subprocess
import threading
import time

from scenario import Scenario, cube, main
from ship_project import CLASH, DRAW, VIEW, ProjectScenario

KILLS = int(os.environ.get('STRAKE_KILLS', 30))


class Killed(ProjectScenario):
    """A command that is killed at some moment."""

    def kill(self, command, moment, took):
        """Starts the command and kills it: at any time, or soon after it began to write."""
        def size():
            try:
                return (self.folder / 'p.strake-wal').stat().st_size
            except FileNotFoundError:
                return 0

        before = size()
        with subprocess.Popen([self.STRAKE, *command], cwd=self.folder, stdout=subprocess.DEVNULL,
                              stderr=subprocess.DEVNULL) as process:
            if moment % 2:
                while size() == before and process.poll() is None:
                    pass
                time.sleep(self.random.random() * .1 * took)
            else:
                time.sleep(self.random.random() * 1.1 * took)
            process.send_signal(signal.SIGKILL)
            return process.wait(60)


class Jobs(Killed):
    """Every command that writes: what is before, the command, and what is after it."""

    def setUp(self):
        super().setUp()
        key = self.query("SELECT key FROM clashes WHERE class = 'HIT' ORDER BY key")[0][0]
        self.jobs = {}
        self.add_job('add', ['project', 'add', 'p.strake', 'more.glb'])
        self.add_job('set', ['clash', 'set', '-p', 'p.strake', key, '--status', 'approved', '--comment', 'as agreed',
                             '--by', 'Ann'])
        self.add_job('remove', ['project', 'remove', 'p.strake', 'more.glb'], ['project', 'add', 'p.strake', 'more.glb'])
        self.move_some()
        self.add_job('update', ['project', 'update', 'p.strake'])
        self.add_job('clash', CLASH, ['project', 'update', 'p.strake'])
        self.add_job('draw', VIEW, ['project', 'update', 'p.strake'])

    def add_job(self, name, command, *prepare):
        self.save('begin')
        for line in prepare:
            self.text(*line)
        before = self.state()
        self.save(name)
        started = time.monotonic()
        self.text(*command)
        took = time.monotonic() - started
        after = self.state()
        self.assertNotEqual(before, after, name)
        self.jobs[name] = (command, before, after, took)
        self.restore('begin')


class Kills(Jobs):
    def test_a_kill_at_any_moment_leaves_the_project_as_before_or_as_after(self):
        self.random = random.Random(8)
        found = {'before': 0, 'after': 0, 'killed': 0}
        for moment in range(KILLS):
            name = list(self.jobs)[moment // 2 % len(self.jobs)]
            command, before, after, took = self.jobs[name]
            self.restore(name)
            found['killed'] += self.kill(command, moment, took) == -signal.SIGKILL
            state = self.state()
            self.assertIn(state, (before, after), (name, moment))
            found['before' if state == before else 'after'] += 1
            if state == before:
                self.text(*command)
                self.assertEqual(self.state(), after, (name, moment))
        self.assertGreater(found['killed'], KILLS // 3)
        self.assertGreater(found['before'], KILLS // 6)


class KillsOfNew(Killed):
    def test_a_kill_while_a_project_is_made(self):
        self.random = random.Random(9)
        new = ['project', 'new', 'p.strake', 'ship.glb', 'more.glb']

        def without_project():
            for path in self.folder.glob('p.strake*'):
                path.unlink()

        without_project()
        started = time.monotonic()
        self.text(*new)
        took = time.monotonic() - started
        after = self.state()
        for moment in range(KILLS // 3):
            without_project()
            self.kill(new, moment, took)
            done = self.run_strake(*new)
            if done.returncode:
                # It was there already: whole, or without files.
                self.text('project', 'check', 'p.strake')
                if not self.query('SELECT 1 FROM file'):
                    self.text('project', 'add', 'p.strake', 'ship.glb', 'more.glb')
            self.assertEqual(self.state(), after, moment)


class FullDisk(Jobs):
    def expect(self, command, before, after, **more):
        """The command does all or nothing, and what is told says why."""
        done = self.run_strake(*command, **more)
        self.assertIn(done.returncode, (0, 3), done.stderr)
        if done.returncode:
            self.assertIn('p.strake', done.stderr)
            self.assertNotIn('the disk reports an error', done.stderr)
        return done.returncode == 0

    def test_a_file_that_may_not_grow(self):
        for name, (command, before, after, _) in self.jobs.items():
            with self.subTest(name):
                done, sizes = [], [2 ** power * 1024 for power in range(0, 15, 2)]
                for most in sizes:
                    self.restore(name)
                    done.append(self.expect(command, before, after, preexec_fn=lambda most=most: resource.setrlimit(
                        resource.RLIMIT_FSIZE, (most, most))))
                    self.assertEqual(self.state(), after if done[-1] else before, (name, most))
                    if not done[-1]:
                        self.text(*command)
                        self.assertEqual(self.state(), after, (name, most))
                self.assertFalse(done[0])
                self.assertTrue(done[-1])

    @contextlib.contextmanager
    def small_disk(self, kibibytes):
        """The folder on a disk of so many KiB of its own."""
        libc = ctypes.CDLL(None, use_errno=True)
        place = self.folder / 'disk'
        place.mkdir()
        if os.geteuid() or libc.mount(b'tmpfs', bytes(place), b'tmpfs', 0, f'size={kibibytes}k'.encode()):
            place.rmdir()
            self.skipTest('no small disk to be had here')
        outside, self.folder = self.folder, place
        try:
            yield outside
        finally:
            self.folder = outside
            libc.umount2(bytes(place), 2)
            place.rmdir()

    def test_a_disk_that_is_full(self):
        for name in ('add', 'clash'):
            command, before, after, _ = self.jobs[name]
            self.restore(name)
            with self.small_disk(65536) as outside:
                for path in outside.iterdir():
                    if path.is_file():
                        shutil.copy(path, self.folder)
                free = shutil.disk_usage(self.folder).free
                failed = 0
                for left in (0, 8192, 65536, 262144):
                    (self.folder / 'filler').write_bytes(bytes(max(0, free - left)))
                    done = self.expect(command, before, after)
                    (self.folder / 'filler').unlink()
                    self.assertEqual(self.state(), after if done else before, (name, left))
                    failed += not done
                    if done:
                        break
                self.assertGreater(failed, 0)
                if not done:
                    self.text(*command)
                    self.assertEqual(self.state(), after)


class TwoProcesses(ProjectScenario):
    """Another process is one that has begun to write: Python's own connection, which ends when the test says so."""

    READERS = [['project', 'list', 'p.strake'], ['project', 'info', 'p.strake'], ['project', 'check', 'p.strake'],
               ['info', 'p.strake'], ['clash', 'p.strake'], ['clash', 'list', '-p', 'p.strake'],
               ['clash', 'history', '-p', 'p.strake'], ['draw', 'p.strake', '-o', 'x.svg']]

    def writers(self):
        key = self.query('SELECT key FROM clashes')[0][0]
        return [['project', 'add', 'p.strake', 'more.glb'], ['project', 'remove', 'p.strake', 'ship.glb'],
                ['clash', 'set', '-p', 'p.strake', key, '--status', 'reviewed'], CLASH, DRAW]

    @contextlib.contextmanager
    def writing(self):
        with contextlib.closing(sqlite3.connect(self.folder / 'p.strake', isolation_level=None,
                                                check_same_thread=False)) as other:
            other.execute('BEGIN IMMEDIATE')
            other.execute("UPDATE clash SET comment = 'not yet'")
            yield other

    def test_readers_never_wait_and_see_what_was_before(self):
        for command in self.READERS:
            with self.subTest(command), self.writing():
                self.assertNotIn('not yet', self.text(*command))

    def test_a_second_writer_is_reported(self):
        self.move_some()
        self.text('project', 'update', 'p.strake')
        for command in self.writers():
            for wait in ([], ['--wait', '0.2']):
                with self.subTest(command=command, wait=wait), self.writing():
                    done = self.run_strake(*command, *wait)
                    self.assertEqual(done.returncode, 3, done.stderr)
                    self.assertIn('p.strake', done.stderr)
                    self.assertIn('--wait', done.stderr)

    def test_a_second_writer_waits_where_it_is_requested_to(self):
        for command in (self.writers()[2], CLASH, DRAW, self.writers()[0]):
            with self.subTest(command), self.writing() as other:
                ending = threading.Timer(.5, lambda: other.execute('ROLLBACK'))
                ending.start()
                self.text(*command, '--wait', '60')
                ending.join()
        self.assertEqual(self.query("SELECT count(*) FROM clash WHERE comment = 'not yet'"), [(0,)])

    def test_many_at_once_lose_nothing(self):
        keys = [key for key, in self.query('SELECT key FROM clashes ORDER BY key')][:12]
        running = [subprocess.Popen([self.STRAKE, 'clash', 'set', '-p', 'p.strake', key, '--status', 'approved', '--by', 'Ann',
                                     '--wait', '120'], cwd=self.folder, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE)
                   for key in keys]
        for _ in range(4):
            self.text('clash', 'list', '-p', 'p.strake')
        for process in running:
            _, reported = process.communicate(timeout=200)
            self.assertEqual(process.returncode, 0, reported)
        self.assertEqual({key for key, in self.query("SELECT key FROM clashes WHERE status = 'approved'")}, set(keys))
        self.text('project', 'check', 'p.strake')


class Neighbours(ProjectScenario):
    def test_a_command_leaves_one_file(self):
        """What was written is in the project, not in a journal beside it: who copies one file copies all of it."""
        before = sorted({*self.files()} - {'p.strake-wal', 'p.strake-shm'})
        for command in (['project', 'list', 'p.strake'], ['clash', 'p.strake'], ['clash', 'list', '-p', 'p.strake'], CLASH, DRAW,
                        ['draw', '-p', 'p.strake', '--stored', 'top', '-o', 'x.svg'],
                        ['project', 'add', 'p.strake', 'more.glb'], CLASH, DRAW, ['project', 'check', 'p.strake']):
            self.text(*command)
            self.assertEqual(self.files(), before, command)


class Copies(ProjectScenario):
    def test_a_copy_that_sqlite_made_is_a_project(self):
        before = self.state()
        for first in (['project', 'check', 'p.strake'], CLASH, DRAW):
            with self.subTest(first):
                with contextlib.closing(sqlite3.connect(self.folder / 'p.strake')) as other:
                    other.execute(f"VACUUM INTO '{self.folder}/copy.strake'")
                for path in self.folder.glob('p.strake*'):
                    path.unlink()
                (self.folder / 'copy.strake').rename(self.folder / 'p.strake')
                self.text(*first)
                self.assertEqual(self.state()[0], before[0])


class LeftBehind(Scenario):
    def test_a_new_project_does_not_take_in_the_log_of_an_old_one(self):
        self.write('a.obj', cube('a', 0, (0, 0, 0), 100))
        for ending in ('-wal', '-shm', '-journal'):
            with self.subTest(ending):
                self.write('p.strake' + ending, 'left')
                done = self.run_strake('project', 'new', 'p.strake', 'a.obj')
                self.assertEqual(done.returncode, 3, done.stderr)
                self.assertIn('p.strake' + ending, done.stderr)
                self.assertEqual(self.files(), ['a.obj', 'p.strake' + ending])
                (self.folder / ('p.strake' + ending)).unlink()
        self.text('project', 'new', 'p.strake', 'a.obj')


class Damage(ProjectScenario):
    """What no project is, or no whole one, is an error of input that names it; nothing false is told."""

    READERS = [['info', 'p.strake'], ['clash', 'p.strake', '--clearance', '25mm', '-o', 'x.json'],
               ['project', 'list', 'p.strake'], ['clash', 'list', '-p', 'p.strake'], CLASH,
               ['draw', '-p', 'p.strake', '--stored', 'top', '-o', 'x.svg']]

    def setUp(self):
        super().setUp()
        self.text('clash', 'p.strake', '--clearance', '25mm', '-o', 'true.json')
        self.true = (self.folder / 'true.json').read_bytes()
        self.content = (self.folder / 'p.strake').read_bytes()

    def put(self, content):
        for path in self.folder.glob('p.strake*'):
            path.unlink()
        (self.folder / 'p.strake').write_bytes(content)

    def outcome(self, command):
        done = self.run_strake(*command)
        self.assertIn(done.returncode, (0, 3), (command, done.stderr))
        if done.returncode == 3:
            self.assertIn('p.strake', done.stderr)
        return done.returncode

    def is_whole(self):
        """What the check says: a list of faults, or that it is no project."""
        done = self.run_strake('project', 'check', 'p.strake')
        self.assertIn(done.returncode, (0, 1, 3), done.stderr)
        self.assertEqual(done.returncode == 0, 'no faults' in done.stdout)
        return done.returncode == 0

    def test_truncated_files(self):
        size = len(self.content)
        for left in (0, 1, 15, 16, 99, 100, 511, 4095, 4096, 4097, size // 3, size // 2, size - 4096, size - 1):
            with self.subTest(left):
                self.put(self.content[:left])
                self.assertFalse(self.is_whole())
                for command in self.READERS:
                    self.outcome(command)

    def test_flipped_bits(self):
        chance = random.Random(10)
        refused = 0
        for _ in range(KILLS):
            content = bytearray(self.content)
            for _ in range(chance.choice((1, 1, 8))):
                content[chance.randrange(len(content))] ^= 1 << chance.randrange(8)
            self.put(content)
            whole = self.is_whole()
            refused += not whole
            if self.outcome(self.READERS[1]) == 0 and whole:
                self.assertEqual((self.folder / 'x.json').read_bytes(), self.true)
            self.outcome(CLASH)
        self.assertGreater(refused, KILLS // 6)

    def test_other_versions_and_other_databases(self):
        for pragma, reported in (('user_version = 999', 'newer'), ('user_version = 0', ''), ('application_id = 7', '')):
            with self.subTest(pragma):
                self.put(self.content)
                with contextlib.closing(sqlite3.connect(self.folder / 'p.strake')) as other:
                    other.execute(f'PRAGMA {pragma}')
                for command in (*self.READERS, ['project', 'check', 'p.strake']):
                    done = self.run_strake(*command)
                    self.assertEqual(done.returncode, 3, (command, done.stderr))
                    self.assertIn('p.strake', done.stderr)
                    self.assertIn(reported, done.stderr)

    def test_what_other_programs_put_in(self):
        for sql in ('CREATE TRIGGER t AFTER INSERT ON run BEGIN DELETE FROM clash; END',
                    'DROP TABLE clash', 'DROP VIEW clashes', 'DELETE FROM shape_pack', 'UPDATE file SET objects = 7',
                    "UPDATE shape_pack SET data = zeroblob(1000)", 'UPDATE report SET snapshot = head',
                    'DELETE FROM report_part', "UPDATE report SET seal = x''"):
            with self.subTest(sql):
                self.put(self.content)
                with contextlib.closing(sqlite3.connect(self.folder / 'p.strake')) as other:
                    other.execute('PRAGMA foreign_keys = OFF')
                    other.execute(sql)
                    other.commit()
                self.assertFalse(self.is_whole())
                for command in self.READERS:
                    self.outcome(command)

    def test_words_that_are_none(self):
        """What no reader of the model or of a test would find, and `clash list` or `draw --stored` would not take."""
        for sql, reported in (("UPDATE clash SET relation = 'SOMEHOW'", 'no class or relation'),
                          ("UPDATE clash SET class = 'MISS'", 'no class or relation'),
                          ("UPDATE clash SET decision = 'later'", 'a status that is none'),
                          ("INSERT INTO event (clash, at, who, before, after, comment) "
                           "SELECT id, '', '', 'new', 'gone', '' FROM clash", 'CHECK constraint'),
                          ("UPDATE view SET settings = '{'", 'no JSON object'),
                          ("UPDATE view SET settings = '[]'", 'no JSON object'),
                          ("UPDATE view SET settings = ''", 'no JSON object')):
            with self.subTest(sql):
                self.put(self.content)
                with contextlib.closing(sqlite3.connect(self.folder / 'p.strake')) as other:
                    other.execute('PRAGMA ignore_check_constraints = ON')
                    other.execute(sql)
                    other.commit()
                done = self.run_strake('project', 'check', 'p.strake')
                self.assertEqual(done.returncode, 1, done.stderr)
                self.assertIn(reported, done.stdout)

    def test_every_damaged_view_is_reported(self):
        for name in ('deck', 'hull', 'pumps'):
            self.text('draw', '-p', 'p.strake', '--save', name, '--view', 'top', '-o', 'x.svg')
        with contextlib.closing(sqlite3.connect(self.folder / 'p.strake')) as other:
            other.execute("UPDATE drawing SET lines = x'00' WHERE view IN (SELECT id FROM view WHERE name IN ('deck', 'pumps'))")
            other.commit()
        done = self.run_strake('project', 'check', 'p.strake')
        self.assertEqual(done.returncode, 1, done.stderr)
        for name, is_damaged in (('deck', True), ('hull', False), ('pumps', True)):
            self.assertEqual(f'view {name}' in done.stdout, is_damaged, done.stdout)

    def test_no_projects(self):
        self.write('text.strake', 'SQLite format 4\n')
        os.mkfifo(self.folder / 'pipe.strake')
        os.mkdir(self.folder / 'folder.strake')
        for name in ('text.strake', 'pipe.strake', 'folder.strake', 'missing.strake', 'ship.glb'):
            for command in (['project', 'list', name], ['clash', '-p', name], ['project', 'add', name, 'more.glb']):
                with self.subTest(command):
                    done = self.run_strake(*command)
                    self.assertEqual(done.returncode, 3, done.stderr)
                    self.assertIn(name, done.stderr)


class HostileNames(Scenario):
    UNSEEN = ['\u202egpj', 'tab\tand\x1b[2J']  # no names of views
    NAMES = ["it's", '"quoted"', "'); DROP TABLE clash; --", '100%s', 'semi;colon', '-p', *UNSEEN, 'n' * 200, 'ä ö', '[x]*?']

    def test_names_are_text_and_nothing_else(self):
        files = []
        for number, name in enumerate(self.NAMES):
            (self.folder / f'{name}.obj').write_text(
                cube(name.replace('\n', ''), 0, (80 * number, 0, 0), 100), encoding='utf-8')
            files.append(f'./{name}.obj')
        self.text('project', 'new', 'p.strake', *files)
        self.text('clash', *files, '-o', 'true.json')
        self.text('clash', '-p', 'p.strake')
        self.text('clash', 'p.strake', '-o', 'p.json')
        self.assertEqual((self.folder / 'p.json').read_bytes(), (self.folder / 'true.json').read_bytes())
        for name in self.NAMES:
            with self.subTest(name):
                view = 'view' if name in self.UNSEEN else name
                reported = self.text('draw', '-p', 'p.strake', f'--save={view}', '--view', 'top', '-o', 'x.svg')
                reported += self.text('draw', '-p', 'p.strake', f'--stored={view}', '-o', 'x.svg')
                reported += self.text('clash', 'set', '-p', 'p.strake', '--select', "name = '*'", '--status', 'reviewed',
                                  f'--comment={name}', f'--assignee={name}', f'--by={name}')
                for command in (['clash', 'list', '-p', 'p.strake'], ['project', 'list', 'p.strake'],
                                ['project', 'list', 'p.strake', 'views'], ['project', 'info', 'p.strake']):
                    reported += self.text(*command)
                self.assertNotIn('\x1b', reported)
                self.assertNotIn('\u202e', reported)
        with contextlib.closing(sqlite3.connect(self.folder / 'p.strake')) as other:
            self.assertEqual({name for name, in other.execute('SELECT name FROM view')},
                             {'view', *self.NAMES} - {*self.UNSEEN})
            self.assertEqual({name for name, in other.execute('SELECT DISTINCT comment FROM clashes')}, {self.NAMES[-1]})
        self.text('project', 'check', 'p.strake')
        for name in self.NAMES:
            self.text('project', 'remove', 'p.strake', '--', f'{name}.obj')

    def test_views_have_names_that_can_be_read(self):
        self.write('a.obj', cube('a', 0, (0, 0, 0), 100))
        self.text('project', 'new', 'p.strake', 'a.obj')
        for name in (*self.UNSEEN, 'line\nbreak', b'\xff', 'n' * 201, 'ä' * 101):
            option = '--save=' + (os.fsdecode(name) if isinstance(name, bytes) else name)
            done = self.run_strake('draw', '-p', 'p.strake', option)
            self.assertEqual(done.returncode, 2, (name, done.stderr))
            self.assertIn('--save: ', done.stderr)


if __name__ == '__main__':
    main()
