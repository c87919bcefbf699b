#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""project_versions_test.py STRAKE GOLDEN: projects that every version wrote are those that they were."""
import contextlib
import csv
import shutil
import sqlite3
import sys
from pathlib import Path

from scenario import Scenario, main

GOLDEN = None
TESTS = ['--clearance', '25mm', '--self']


class Versions(Scenario):
    def rows(self, path):
        with open(path, encoding='utf-8-sig', newline='') as lines:
            return {row['key']: row['status'] for row in csv.DictReader(lines)}

    def version(self, path):
        with contextlib.closing(sqlite3.connect(path)) as project:
            return project.execute('PRAGMA user_version').fetchone()[0]

    def test_each_version_opens_and_states_the_same(self):
        for stored in sorted(GOLDEN.glob('v*.strake')):
            with self.subTest(stored.name):
                shutil.copy(stored, self.folder / 'p.strake')
                self.text('project', 'check', 'p.strake')
                self.text('clash', 'p.strake', *TESTS, '-o', 'now.json')
                self.assertEqual((self.folder / 'now.json').read_bytes(), stored.with_suffix('.json').read_bytes())
                self.text('clash', 'list', '-p', 'p.strake', '-o', 'now.csv')
                self.assertEqual(self.rows(self.folder / 'now.csv'), self.rows(stored.with_suffix('.csv')))
                # A result that this version cannot use is found again, and decisions follow it.
                self.text('clash', '-p', 'p.strake', *TESTS, '--verify')
                self.text('draw', '-p', 'p.strake', '--stored', 'top', '--verify', '-o', 'top.svg')
                self.text('project', 'check', 'p.strake')

    def test_the_version_of_today_is_stored(self):
        """Before it is written by anybody: its first program makes the project that later ones have to open."""
        self.text('project', 'new', 'today.strake')
        self.assertTrue((GOLDEN / f'v{self.version(self.folder / "today.strake")}.strake').exists(),
                        'tests/golden/project/README.md says how it is made')


if __name__ == '__main__':
    GOLDEN = Path(sys.argv.pop(2)).resolve()
    main()
