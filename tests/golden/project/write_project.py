#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""write_project.py STRAKE: the stored project of the version of the tables that the program has, with something in every
table, and what the program says of it, beside this script."""
import contextlib
import os
import re
import shutil
import sqlite3
import subprocess
import sys
import tempfile
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent.parent / 'scenario/cli'))
from scenario import cube  # noqa: E402  pylint: disable=wrong-import-position,import-error

IMPORTERS = HERE.parent.parent.parent / 'docs/formats/importers.md'
TESTS = ['--clearance', '25mm', '--self']
PLACE = '{"crs": "EPSG:25832", "matrix": [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 463000500, 5428000250, 110000, 1]}'


def write_importer(folder):
    """The example of the page on importers, which says where its files lie on a map."""
    example = re.search(r'```python\n(.*?)```', IMPORTERS.read_text(encoding='utf-8'), re.DOTALL)[1]
    program = folder / 'strake-import-boxes'
    program.write_text(example.replace('depends_on=[]', f'depends_on=[], map=json.loads({PLACE!r})'), encoding='utf-8')
    program.chmod(0o755)


def write_models(folder, at):
    """Three files of cubes that clash, touch and nearly touch; one moves, and one is missing then."""
    (folder / 'hull.obj').write_text(''.join(cube(f'h{n}', n, (80 * n, 0, 0), 100) for n in range(5)))
    (folder / 'plates.boxes').write_text('plate 0 0 -30 400 100 10\n')
    (folder / 'pipes.obj').write_text(''.join(cube(f'p{n}', n, (90 * n, at if n == 2 else 100, 0), 90) for n in range(6 if at == 100 else 5)))


def main():
    strake = Path(sys.argv[1]).resolve()
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        write_importer(folder)
        environment = {**os.environ, 'PATH': f'{folder}:{os.environ["PATH"]}', 'STRAKE_CACHE': 'off'}

        def run(*arguments):
            done = subprocess.run([strake, *arguments], cwd=folder, check=True, capture_output=True, text=True, env=environment)
            return done.stdout

        write_models(folder, 100)
        run('project', 'new', 'p.strake', 'hull.obj', 'pipes.obj', 'plates.boxes')
        run('clash', '-p', 'p.strake', *TESTS, '--by', 'Ann')
        run('draw', '-p', 'p.strake', '--save', 'top', '--view', 'top', '-o', 'top.svg')
        with contextlib.closing(sqlite3.connect(folder / 'p.strake')) as project:
            keys = [key for key, in project.execute('SELECT key FROM clashes ORDER BY key LIMIT 4')]
        for key, status in zip(keys, ('approved', 'reviewed', 'active', 'resolved')):
            run('clash', 'set', '-p', 'p.strake', key, '--status', status, '--by', 'Ann', '--comment', 'as agreed',
                '--assignee', 'Bob')
        write_models(folder, 120)
        run('project', 'update', 'p.strake')
        run('clash', '-p', 'p.strake', *TESTS, '--by', 'Ann')
        with contextlib.closing(sqlite3.connect(folder / 'p.strake')) as project:
            version, = project.execute('PRAGMA user_version').fetchone()
            empty = [table for table, in project.execute(
                "SELECT name FROM sqlite_schema WHERE type = 'table' AND name NOT LIKE 'sqlite_%'")
                     if not project.execute(f'SELECT 1 FROM {table}').fetchone()]
            if empty:
                sys.exit(f'nothing is in {", ".join(empty)}')
        out = HERE / f'v{version}'
        if out.with_suffix('.strake').exists():
            sys.exit(f'{out}.strake is there already: it is the one that the first program of this version wrote')
        run('clash', 'p.strake', *TESTS, '-o', f'{out}.json')
        run('clash', 'list', '-p', 'p.strake', '-o', f'{out}.csv')
        shutil.copy(folder / 'p.strake', out.with_suffix('.strake'))


if __name__ == '__main__':
    main()
