#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""check_installed_pages.py PREFIX DOCUMENTS HEADERS: where the installed pages lead, there is something; what
the installed examples include of Strake or of their own is installed, too. The folders are those below the prefix."""
import re
import sys
from pathlib import Path

LINK = re.compile(r'\]\(([^()\s]+)(?: "[^"]*")?\)|\b(?:src|href)="([^"]+)"|^\[[^\]]+\]: *(\S+)', re.MULTILINE)
INCLUDE = re.compile(r'^#include (?:"([\w./]+)"|<(strake/[\w./]+)>)', re.MULTILINE)


def faults(prefix, documents, headers):
    pages = sorted((prefix / documents).rglob('*.md'))
    if not pages:
        yield f'{documents}: no pages'
    for page in pages:
        for groups in LINK.findall(page.read_text(encoding='utf-8')):
            target = next(filter(None, groups))
            if re.match(r'[a-z]+:|#', target):
                continue
            place = (page.parent / target.split('#')[0]).resolve()
            if not place.exists() or not place.is_relative_to(prefix / documents):
                yield f'{page.relative_to(prefix)}: {target} is not installed'
    for source in sorted((prefix / documents).rglob('*.?pp')):
        for groups in INCLUDE.findall(source.read_text(encoding='utf-8')):
            header = next(filter(None, groups))
            if not any((folder / header).exists() for folder in (prefix / headers, source.parent)):
                yield f'{source.relative_to(prefix)}: includes {header}, which is not installed'


def main():
    prefix, documents, headers = sys.argv[1:]
    found = list(faults(Path(prefix).resolve(), documents, headers))
    if found:
        sys.exit('\n'.join(found))


if __name__ == '__main__':
    main()
