#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""check_pages.py PROJECT: each page of docs/patterns tells all that the guide promises of a page, names an
example that is compiled and whose output is compared, and stands in the guide's table with headers that
there are; every header of the patterns that a user includes stands there; and the first program that the guide
shows is one that is compiled."""
import re
import sys
from pathlib import Path

SECTIONS = ['Problem', 'Before', 'After', 'Example', 'Measured', 'Pitfalls', 'When not']
# Chapters, not patterns.
CHAPTERS = {'README.md', 'convert.md'}


def faults(project):
    guide = project / 'docs/patterns'
    contents = (guide / 'README.md').read_text(encoding='utf-8')
    compiled = (project / 'examples/CMakeLists.txt').read_text(encoding='utf-8')
    pages = [page for page in sorted(guide.glob('*.md')) if page.name not in CHAPTERS]
    if len(pages) < 10:
        yield f'{guide}: only {len(pages)} pages'
    for page in pages:
        text = page.read_text(encoding='utf-8')
        found = [text.find(f'\n**{section}') for section in SECTIONS]
        yield from (f'{page}: no section "{section}"' for section, at in zip(SECTIONS, found) if at < 0)
        if found != sorted(found):
            yield f'{page}: its sections are not in the order {", ".join(SECTIONS)}'
        if f']({page.name}) |' not in contents:
            yield f'{page}: not in the table of README.md'
        paragraph = text[found[SECTIONS.index('Example')]:].strip().split('\n\n')[0]
        examples = re.findall(r'`examples/([\w/]+?)(?:\.cpp|/)`', paragraph)
        if not examples:
            yield f'{page}: names no example'
        for example in examples:
            source = project / 'examples' / f'{example}.cpp'
            if not source.exists() and not (project / 'examples' / example).is_dir():
                yield f'{page}: there is no examples/{example}'
            elif source.exists() and '/' not in example and not (
                    re.search(rf'\b{example}\b', compiled) and (project / f'examples/expected/{example}.txt').exists()):
                yield f'{page}: examples/{example}.cpp is not compiled, or its output is not compared'
    program = contents.split('## A first program')[1].split('\n## ')[0].split('\n\nWhat is in braces')[0]
    compiled_lines = {line.strip() for line in (project / 'examples/first_program.cpp').read_text(encoding='utf-8').split('\n')}
    shown = [line.strip() for line in program.split('\n') if line.startswith('    ')]
    yield from (f'README.md: not in examples/first_program.cpp: {line}' for line in shown if line not in compiled_lines)
    if len(shown) < 15:
        yield 'README.md: shows no first program'
    named = set(re.findall(r'`(\w+\.hpp)`', contents))
    headers = {path.name for path in (project / 'include/strake/parallel').glob('*.hpp')}
    yield from (f'README.md: there is no header {name}' for name in sorted(named - headers))
    yield from (f'README.md: does not name {name}' for name in sorted(headers - named))


def main():
    found = list(faults(Path(sys.argv[1])))
    if found:
        sys.exit('\n'.join(found))


if __name__ == '__main__':
    main()
