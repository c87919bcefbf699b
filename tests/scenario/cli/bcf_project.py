# SPDX-License-Identifier: Apache-2.0
"""A project whose clashes go out as BCF and come back."""
import contextlib
import sqlite3

from row_project import RowProject


class BcfProject(RowProject):
    """The project ship.strake, whose clashes lie in x.bcf."""

    def setUp(self):
        super().setUp()
        self.out()

    def out(self, *options, name='x.bcf'):
        return self.done('clash', '-p', 'ship.strake', '-o', name, *options)

    def take(self, *options, name='back.bcf', exit_code=0):
        return self.set('--bcf', name, *options, exit_code=exit_code)

    def query(self, sql):
        with contextlib.closing(sqlite3.connect(f'file:{self.folder}/ship.strake?mode=ro', uri=True)) as other:
            return other.execute(sql).fetchall()

    def state(self):
        """All that the project remembers of its clashes."""
        return (self.query('SELECT key, status, comment, assignee, decided_by FROM clashes ORDER BY key'),
                self.query('SELECT clash, at, who, before, after, comment FROM event ORDER BY id'))
