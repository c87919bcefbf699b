#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""same_bytes.py STRAKE OTHER [MODEL...]: whether two builds of the program write the same bytes, file by file: of generated
ships of all kinds, and of the models that are named (decision 0123). Exit code 1 where they do not."""
import hashlib
import subprocess
import sys
import tempfile
from pathlib import Path

KINDS = ('usual', 'slender', 'dense', 'repeated', 'unlike')
OBJECTS = 1500
# A project file has times in it: what the program says of it is compared.
CLASH = ('clash', '{model}', '--clearance', '20mm', '--volumes', '--group-by', 'proximity', '--log-pairs', 'pairs.csv',
         '--bcf-date', '2026-01-31')
RESULTS = ('clashes.json', 'clashes.csv', 'clashes.xml', 'clashes.ifcclash.json', 'clashes.xlsx', 'clashes.bcf', 'clashes.svg',
           'clashes.glb', 'clashes.html')
DRAWN = ('view.json', 'view.view', 'view.svg', 'view.pdf', 'view.dxf', 'view.html')


def with_outputs(command, names):
    return (*command, *(word for name in names for word in ('-o', name)))


def commands_of(model):
    """The command lines for a model, each with what it writes in a folder of its own."""
    iso = ('draw', model, '--view', 'iso', '--hidden', 'dashed', '--centre-lines', 'on', '--smooth', 'tangent')
    yield with_outputs(tuple(word.format(model=model) for word in CLASH), RESULTS)
    yield ('clash', model, '--contacts', 'count', '--narrow-phase', 'exact', '--profile', 'ship', '--list-exempted', '-o', 'counted.json')
    yield with_outputs(iso, DRAWN)
    yield with_outputs(('draw', model, '--direction', '1,-2,1', '--hidden', 'all', '--thin', 'on', '--flush-seams', 'off',
                        '--intersections', 'parts', '--single-line', 'DN50'), DRAWN)
    yield with_outputs(('draw', model, '--view', 'front', '--section', 'y=0mm', '--hidden', 'dashed'), DRAWN)
    yield ('convert', model, 'converted.glb')
    yield ('info', model, '--json')
    yield ('project', 'new', 'model.strake', model)
    yield ('clash', '-p', 'model.strake', '--clearance', '10mm', '--by', 'nobody', '--json')


def run(program, command, folder):
    ended = subprocess.run([program, *command, '--quiet'], cwd=folder, capture_output=True, check=False)
    if ended.returncode != 0:
        sys.exit(f'{program} {" ".join(command)}: exit code {ended.returncode}\n{ended.stderr.decode(errors="replace")}')
    return hashlib.sha256(ended.stdout + b'|' + ended.stderr).hexdigest()


def contents(folder):
    return {path.relative_to(folder).as_posix(): path.read_bytes() for path in sorted(folder.rglob('*'))
            if path.is_file() and path.suffix != '.strake'}


def differences(programs, model, folder):
    """What the two programs say of a model in different ways."""
    folders = [folder / side for side in ('one', 'other')]
    for side in folders:
        side.mkdir(parents=True)
    for command in commands_of(model):
        said = [run(program, command, side) for program, side in zip(programs, folders)]
        if said[0] != said[1]:
            yield f'{" ".join(command)}: what it says'
    one, other = (contents(side) for side in folders)
    for name in sorted(one.keys() | other.keys()):
        if one.get(name) != other.get(name):
            yield f'{model}: {name}'


def ships(programs, folder):
    """The ships that the first program makes; the other one is to make the same."""
    for kind in KINDS:
        for turned in (False, True):
            name = f'{kind}{"-turned" if turned else ""}.glb'
            command = ('generate', 'ship', '--objects', str(OBJECTS), '--seed', '5', '--kind', kind, *(['--turned'] if turned else []))
            made = []
            for number, program in enumerate(programs):
                made.append(folder / f'{number}-{name}')
                run(program, (*command, '-o', str(made[-1])), folder)
            if made[0].read_bytes() != made[1].read_bytes():
                print(f'{name}: generated in different ways')
            yield str(made[0])


def main(one, other, *models):
    programs = [str(Path(program).resolve()) for program in (one, other)]
    count = 0
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        for model in models or ships(programs, folder):
            for what in differences(programs, str(Path(model).resolve()), folder / f'{count}-{Path(model).stem}'):
                count += 1
                print(what, flush=True)
            print(f'compared: {Path(model).name}', file=sys.stderr, flush=True)
    if count:
        sys.exit(f'{count} differences')


if __name__ == '__main__':
    main(*sys.argv[1:])
