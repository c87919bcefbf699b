#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""check_project_page.py STRAKE PROJECT: the page of the project file tells of every table, its queries can be asked of the
project that its commands make, and its picture is that of the tables."""
import contextlib
import os
import re
import sqlite3
import subprocess
import sys
import tempfile
from pathlib import Path

from check_commands import commands_of


def faults(strake, source, folder):
    page = (source / 'docs/project.md').read_text(encoding='utf-8')
    for command in commands_of(page):
        subprocess.run(command, shell=True, cwd=folder, stdout=subprocess.DEVNULL, timeout=600, check=True,
                       env={**os.environ, 'PATH': f'{strake.parent}:{os.environ["PATH"]}'})
    with contextlib.closing(sqlite3.connect(f'file:{folder}/ship.strake?mode=ro', uri=True)) as project:
        names = {name for name, in project.execute(
            "SELECT name FROM sqlite_schema WHERE type IN ('table', 'view') AND name NOT LIKE 'sqlite_%'")}
        reported = set(re.findall(r'`(\w+)`', page))
        yield from (f'does not tell of {name}' for name in sorted(names - reported))
        queries = re.sub(r'--[^\n]*', '', '\n'.join(re.findall(r'```sql\n(.*?)```', page, re.DOTALL))).split(';')
        answers = [project.execute(query).fetchall() for query in queries if query.strip()]
        if len(answers) < 5:
            yield f'only {len(answers)} queries'
        yield from (f'query {number} has no answer' for number, rows in enumerate(answers, 1) if not rows)
    subprocess.run([sys.executable, source / 'scripts/draw_schema.py', folder / 'ship.strake', folder / 'schema.svg'], check=True)
    if (folder / 'schema.svg').read_bytes() != (source / 'docs/pictures/project-schema.svg').read_bytes():
        yield 'its picture is of other tables: scripts/draw_schema.py PROJECT docs/pictures/project-schema.svg makes it'


def main():
    with tempfile.TemporaryDirectory() as folder:
        found = list(faults(Path(sys.argv[1]).resolve(), Path(sys.argv[2]).resolve(), Path(folder)))
    if found:
        sys.exit('\n'.join(f'docs/project.md: {fault}' for fault in found))


if __name__ == '__main__':
    main()
