#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""check_commands.py STRAKE PROJECT: the commands of README.md and of docs/*.md can be typed as they stand, page by page
from the first to the last, on models that the page makes itself. Commands on the real models that pages tell of are run
where STRAKE_DATA names a folder that holds those."""
import os
import re
import shutil
import signal
import subprocess
import sys
import tempfile
from pathlib import Path

COMMAND = re.compile(r'^ {4}(strake (?:[^\n]*\\\n)*[^\n]*)$', re.MULTILINE)
REAL_MODEL = re.compile(r'\S+\.RVM\b')


def commands_of(text):
    """Each command of a page in one line, without the remark behind it."""
    for command in COMMAND.findall(text):
        yield re.sub(r'\s{2,}#.*', '', re.sub(r'\\\n\s*', ' ', command))


def bring(pattern, folder, data):
    """Links the real models that a pattern names into the folder; whether there are any."""
    found = sorted(Path(data).rglob(pattern)) if data else []
    for path in found:
        link = folder / path.name
        if not link.exists():
            link.symlink_to(path)
    return bool(found)


def run(command, folder, strake):
    """The exit code of a command, and what it told. One that serves is ended as by Ctrl-C once it has told where."""
    serves = command.startswith('strake view ')
    process = subprocess.Popen('exec ' * serves + command, shell=True, cwd=folder, text=True, stdout=subprocess.PIPE,
                               stderr=subprocess.PIPE, env={**os.environ, 'PATH': f'{strake.parent}:{os.environ["PATH"]}'})
    if serves and process.stdout.readline():
        process.send_signal(signal.SIGINT)
    reported = process.communicate(timeout=600)[1]
    return process.returncode, reported


def faults_of(page, strake, project, data):
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        (folder / 'examples').symlink_to(project / 'examples')
        for command in commands_of(page.read_text(encoding='utf-8')):
            # The Python package of several machines has tests of its own.
            if '--scheduler' in command:
                continue
            if not all([bring(pattern, folder, data) for pattern in REAL_MODEL.findall(command)]):
                continue
            code, reported = run(command, folder, strake)
            # What --fail-on stops at is an answer, too.
            if code not in ((0, 1) if '--fail-on' in command else (0,)):
                yield f'{page.name}: {command}: exit code {code}\n{reported}'


def main():
    # A shell has what runs in its background ignore Ctrl-C, and what is started from here would inherit it.
    signal.signal(signal.SIGINT, signal.default_int_handler)
    strake, project = Path(sys.argv[1]).resolve(), Path(sys.argv[2]).resolve()
    if strake.name != 'strake' or shutil.which(str(strake)) is None:
        sys.exit(f'{strake} is no program strake')
    data = os.environ.get('STRAKE_DATA')
    pages = [project / 'README.md', *sorted((project / 'docs').glob('*.md'))]
    count = sum(len(list(commands_of(page.read_text(encoding='utf-8')))) for page in pages)
    found = [fault for page in pages for fault in faults_of(page, strake, project, data)]
    if count < 20:
        found.append(f'only {count} commands found')
    if found:
        sys.exit('\n'.join(found))
    print(f'{count} commands')


if __name__ == '__main__':
    main()
