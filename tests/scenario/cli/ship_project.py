# SPDX-License-Identifier: Apache-2.0
"""What scenarios of the safety of projects begin with: a ship in a project, and the states that a project is in."""
import contextlib
import shutil
import sqlite3

from glb_file import Glb
from scenario import Scenario

CLASH = ['clash', '-p', 'p.strake', '--clearance', '25mm']
VIEW = ['draw', '-p', 'p.strake', '--save', 'top', '--view', 'top', '--hidden', 'dashed']
DRAW = [*VIEW, '-o', 'x.svg']


class ProjectScenario(Scenario):
    """A ship in a project, p.strake, with a night's clashes; other states are made of it."""

    def setUp(self):
        super().setUp()
        self.ship('ship.glb', 300)
        self.ship('more.glb', 120, '--seed', 3)
        self.text('project', 'new', 'p.strake', 'ship.glb')
        self.text(*CLASH)
        self.text(*DRAW)

    def ship(self, name, objects, *more):
        self.text('generate', 'ship', '--objects', objects, '--quiet', '-o', name, *more)

    def move_some(self):
        ids = sorted(Glb(self.folder / 'ship.glb').objects())[::40]
        Glb(self.folder / 'ship.glb').move(ids, .03).write(self.folder / 'ship.glb')

    def query(self, sql):
        """What another program reads in the project."""
        with contextlib.closing(sqlite3.connect(f'file:{self.folder}/p.strake?mode=ro', uri=True)) as other:
            return other.execute(sql).fetchall()

    def state(self):
        """All that a project remembers but times: what two projects that are equal agree in."""
        self.text('project', 'check', 'p.strake')
        self.text('clash', 'p.strake', '--clearance', '25mm', '--quiet', '-o', 'state.json')
        result = (self.folder / 'state.json').read_bytes()
        (self.folder / 'state.json').unlink()
        return (result, self.query('SELECT label, objects FROM file ORDER BY label'),
                self.query('SELECT key, class, d_mm, status, comment, assignee, decided_by FROM clashes ORDER BY key'),
                self.query('SELECT test, how, hit, contact, clearance_violation, new, active, reviewed, approved, resolved '
                           'FROM run_test ORDER BY run, test'),
                self.query('SELECT name, settings, lines FROM view LEFT JOIN drawing ON view = view.id ORDER BY name'))

    def save(self, name):
        """Keeps what there is; restore() brings it back."""
        shutil.rmtree(self.folder.parent / f'{self.folder.name}-{name}', ignore_errors=True)
        shutil.copytree(self.folder, self.folder.parent / f'{self.folder.name}-{name}')
        self.addCleanup(shutil.rmtree, self.folder.parent / f'{self.folder.name}-{name}', ignore_errors=True)

    def restore(self, name):
        for path in self.folder.iterdir():
            path.unlink()
        for path in (self.folder.parent / f'{self.folder.name}-{name}').iterdir():
            shutil.copy2(path, self.folder)
