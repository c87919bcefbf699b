#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""check_map.py PROJECT: every path that ARCHITECTURE.md, HACKING.md and the index of decisions name is there; what the
tables of these pages say to look for in a file is declared in it, and the product uses it; the rooms of each module are
all there are; every decision is in the index, once, and is named in the code that the index says it explains."""
import re
import sys
from pathlib import Path

PAGES = ['ARCHITECTURE.md', 'HACKING.md', 'docs/decisions/README.md']
# Where a path that is not one from the root begins: as an #include has it, or as a room of the module.
ROOTS = ['', 'src', 'include/strake', 'tests']
# What a name stands for that the reader is to choose, and what a build makes.
MADE_UP = re.compile(r'\b[A-Z]{4,}\b(?!\.)|^build/|^\$|^-')
A_PATH = re.compile(r'[\w.-]+(/[\w.-]+)+/?|[\w-]+\.(md|json|py|hpp|cpp|toml|cmake|sh|txt)')
# What stands before the name of a function that is declared.
A_RETURN_TYPE = r'(?:\b(?!(?:return|else|throw|case|new|co_return)\b)\w+|(?<=\S)>)[&*]*\s+'


def in_quotes(text):
    return re.findall(r'`([^`\n]+)`', text)


def tables(text):
    """The rows of the tables of a page: their cells, under the names of the columns."""
    columns, rows = None, []
    for line in text.split('\n'):
        cells = [cell.strip() for cell in line.strip('|').split('|')] if line.startswith('|') else None
        if cells is None:
            columns = None
        elif columns is None:
            columns = cells
        elif len(cells) == len(columns) and not set(line) <= set('|-'):
            rows.append(dict(zip(columns, cells)))
    return rows


def exists(project, path):
    return any((project / root / path).exists() for root in ROOTS)


def path_faults(project, page, text):
    for name in in_quotes(text):
        if A_PATH.fullmatch(name) and not MADE_UP.search(name) and not exists(project, name):
            yield f'{page}: there is no {name}'
    here = (project / page).parent
    for target in re.findall(r'\]\(([^)#:]+)[^):]*\)', text):
        if not (here / target).exists():
            yield f'{page}: a link leads to {target}, which is not there'


def without_comments(text):
    return re.sub(r'//[^\n]*|^#include[^\n]*', '', text, flags=re.MULTILINE)


def declaration_of(name):
    """What declares or defines a type or a function of this name. A function stands behind the type that it returns, where
    a call stands behind a sign, or a word that is no type."""
    a_type = rf'\b(?:class|struct|union|using|concept)\s+{name}\b(?!\s*;)'
    return rf'{a_type}|{A_RETURN_TYPE}(?:\w+::)*{name}(?=\s*\()'


def symbol_faults(project, page, text):
    """What a table says to look for, or to break on, is declared or defined in the files beside it."""
    for row in tables(text):
        names = in_quotes(row.get('look for') or row.get('break on') or '')
        files = [project / name for name in in_quotes(row.get('file', '')) if (project / name).is_file()]
        code = '\n'.join(without_comments(file.read_text(encoding='utf-8')) for file in files)
        for name in names:
            *scopes, last = name.split('::')
            scoped = all(re.search(rf'{declaration_of(scope)}|\b{scope}::', code) for scope in scopes)
            if not (scoped and re.search(declaration_of(last), code)):
                yield f'{page}: {name} is not declared in {row["file"]}'


def name_faults(project, page, text):
    """A name of the code that the page gives in quotes stands somewhere in it."""
    code = '\n'.join(path.read_text(encoding='utf-8')
                     for folder in ('src', 'include', 'cli', 'tests', 'cmake', 'scripts', 'bench', 'python')
                     for path in sorted((project / folder).rglob('*')) if path.suffix in ('.hpp', '.cpp', '.cmake', '.py', '.txt'))
    words = set(re.findall(r'\w+', code))
    for name in in_quotes(text):
        if re.fullmatch(r'[A-Za-z]\w*(::\w+)*', name) and re.search(r'[a-z][A-Z]|_', name):
            if not set(name.split('::')) <= words:
                yield f'{page}: nothing is called {name}'


def is_used(name, code):
    """Whether code without comments has a name other than to declare it, or to define what belongs to it."""
    no_use = '|'.join([declaration_of(name), rf'\b(?:class|struct) {name};', rf'\busing [\w:]*::{name};',
                       rf'^{name}::~?{name}\(', rf'{A_RETURN_TYPE}{name}::'])
    return re.search(rf'\b{name}\b', re.sub(no_use, '', code, flags=re.MULTILINE))


def unused_faults(project, page, text):
    """A function or type that the map says to look for is one that the product uses. A type is used in another file than
    the named one and its source, or the source itself makes an object of it."""
    code = {path: without_comments(path.read_text(encoding='utf-8'))
            for folder in ('src', 'cli') for path in sorted((project / folder).rglob('*.?pp'))}

    def place(path):
        """The module of a file and its name: the same for a header and its source."""
        parts = path.parts
        return parts[2 if parts[0] == 'include' else 1], path.stem

    for row in tables(text):
        if 'library only' in row.get('what', ''):
            continue
        own = {place(Path(file)) for file in in_quotes(row.get('file', ''))}
        for name in in_quotes(row.get('look for', '')):
            made = re.compile(rf'\b{name} \w+[({{;]|(?:\breturn|=) {name}[({{]')
            if not any(made.search(body) if name[0].isupper() and place(path.relative_to(project)) in own
                       else is_used(name, body) for path, body in code.items() if name in body):
                yield f'{page}: the product does not use {name} of {row["file"]}'


def included_rooms(folder, module):
    """By room of a module: the other rooms of it whose headers its files include, each with one such file."""
    used = {}
    for path in sorted(folder.rglob('*.?pp')):
        room = path.relative_to(folder).parts[0]
        for header in re.findall(r'^#include "([\w./]+)"', path.read_text(encoding='utf-8'), re.MULTILINE):
            parts = header.split('/')
            if parts[0] == module and len(parts) > 2 and parts[1] != room:
                used.setdefault(room, {})[parts[1]] = path
    return used


def room_faults(project, page, text):
    """A room is a folder of a module; the map has a row for each, with the rooms that it uses, and which come later."""
    sections = re.split(r'\n\*\*(\w+)\*\*', text.split('### Rooms')[1].split('\n## ')[0])
    for module, section in zip(sections[1::2], sections[2::2]):
        folder = project / ('cli' if module == 'cli' else f'src/{module}')
        there = {path.name for path in folder.iterdir() if path.is_dir()}
        reported = {name: row['uses'] for row in tables(section) for name in in_quotes(row['room'])}
        yield from (f'{page}: {module} has no room {name}' for name in sorted(reported.keys() - there))
        yield from (f'{page}: the room {name} of {module} is not told of' for name in sorted(there - reported.keys()))
        used, above = included_rooms(folder, module), []
        for room, cell in reported.items():
            uses = re.findall(r'(\w+)(?: \((below)\))?', cell)
            for name, below in uses:
                if (name in above) == bool(below) or name not in reported:
                    yield f'{page}: {module}/{name} is not {"below" if below else "above"} {room}'
            for name, path in used.get(room, {}).items():
                if name not in {use for use, _ in uses}:
                    yield f'{path.relative_to(project)}: includes {module}/{name}, which {page} does not say of {room}'
            above.append(room)


def decision_faults(project):
    index = (project / 'docs/decisions/README.md').read_text(encoding='utf-8')
    indexed = re.findall(r'^\| \[(\d{4})\]\(([\w-]+\.md)\) \|.*\| ([^|]*) \|$', index, re.MULTILINE)
    code = {path: path.read_text(encoding='utf-8') for folder in ('src', 'include', 'cli', 'cmake', 'scripts', 'python')
            for path in sorted((project / folder).rglob('*')) if path.suffix in ('.hpp', '.cpp', '.cmake', '.py', '.sh')}
    records = {path.name for path in (project / 'docs/decisions').glob('*.md')} - {'README.md'}
    names = [name for _, name, _ in indexed]
    yield from (f'docs/decisions/README.md: has no {name}' for name in sorted(records - set(names)))
    yield from (f'docs/decisions/README.md: has {name} twice' for name in sorted(set(names)) if names.count(name) > 1)
    for number, name, cell in indexed:
        if not name.startswith(number):
            yield f'docs/decisions/README.md: {number} is not the number of {name}'
        naming = re.compile(rf'\b[Dd]ecision {number}\b')
        if not any(naming.search(text) for text in code.values()):
            yield f'docs/decisions/{name}: no code names decision {number}'
        elif not any(naming.search(code.get(project / file, '')) for file in in_quotes(cell)):
            yield f'docs/decisions/README.md: none of the files beside {number} names it'
    numbers = {name[:4] for name in records}
    for path, text in code.items():
        for number in re.findall(r'\b[Dd]ecision (\d{4})\b', text):
            if number not in numbers:
                yield f'{path.relative_to(project)}: there is no decision {number}'


def faults(project):
    for page in PAGES:
        text = (project / page).read_text(encoding='utf-8')
        yield from path_faults(project, page, text)
        yield from symbol_faults(project, page, text)
        yield from name_faults(project, page, text)
    page = 'ARCHITECTURE.md'
    text = (project / page).read_text(encoding='utf-8')
    yield from unused_faults(project, page, text)
    yield from room_faults(project, page, text)
    concepts = [row for row in tables(text) if 'look for' in row]
    if len(concepts) < 60:
        yield f'{page}: finds only {len(concepts)} concepts'
    yield from decision_faults(project)


def main():
    found = list(faults(Path(sys.argv[1])))
    if found:
        sys.exit('\n'.join(found))


if __name__ == '__main__':
    main()
