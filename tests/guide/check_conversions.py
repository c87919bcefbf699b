#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""check_conversions.py CHAPTER FOLDER: the chapter on conversions says of its examples what is so.
Its table holds, for each NAME_before.cpp in the folder, a row
    | `NAME` | lines before | lines after | taken out | put in |
of code lines without blank ones and comments, compared as a diff does; and what it shows as code, all
that is indented by four, occurs in the folder's files line by line."""
import difflib
import re
import sys
from pathlib import Path


def code_lines(path):
    lines = (re.sub(r'\s*//.*', '', line) for line in path.read_text(encoding='utf-8').splitlines())
    return [line for line in lines if line.strip()]


def counts(before, after):
    changes = list(difflib.unified_diff(before, after, n=0, lineterm=''))[2:]
    return [len(before), len(after), sum(line.startswith('-') for line in changes),
            sum(line.startswith('+') for line in changes)]


def faults(chapter, folder):
    text = chapter.read_text(encoding='utf-8')
    stated = {name: [int(number) for number in numbers.split('|')]
            for name, numbers in re.findall(r'^\| `(\w+)` \|((?: *\d+ *\|){3} *\d+) *\|$', text, re.M)}
    names = sorted(path.name.removesuffix('_before.cpp') for path in folder.glob('*_before.cpp'))
    if not names:
        yield f'{folder}: no conversions'
    for name in names:
        counted = counts(*(code_lines(folder / f'{name}_{when}.cpp') for when in ('before', 'after')))
        if stated.get(name) != counted:
            yield f'{chapter}: {name}: says {stated.get(name)}, counted {counted}'
    for name in stated.keys() - set(names):
        yield f'{chapter}: {name}: there is no such conversion'
    sources = {line.strip() for path in folder.glob('*.?pp') for line in path.read_text(encoding='utf-8').splitlines()}
    for number, line in enumerate(text.splitlines(), 1):
        if line.startswith('    ') and line.strip() not in sources:
            yield f'{chapter}:{number}: stands in no file of {folder}: {line.strip()}'


def main():
    found = list(faults(Path(sys.argv[1]), Path(sys.argv[2])))
    if found:
        sys.exit('\n'.join(found))


if __name__ == '__main__':
    main()
