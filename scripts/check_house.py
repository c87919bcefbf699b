#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""House rules that no compiler checks: layers, licence lines, file sizes, a library that never prints,
no scratch files in the root."""
import re
import shutil
import subprocess
import sys
from pathlib import Path

MAY_USE = {
    'core': [],
    'parallel': ['core'],
    'geometry': ['core', 'parallel'],
    'model': ['core', 'parallel', 'geometry'],
    'io': ['core', 'parallel', 'geometry', 'model'],
    'clash': ['core', 'parallel', 'geometry', 'model'],
    'settings': ['core', 'parallel', 'geometry', 'model'],
    'rules': ['core', 'parallel', 'geometry', 'model', 'settings', 'clash'],
    'hlr': ['core', 'parallel', 'geometry', 'model'],
    'drawing': ['core', 'parallel', 'geometry', 'model', 'hlr'],
    'sheets': ['core', 'parallel', 'geometry', 'model', 'settings', 'hlr', 'drawing'],
    'report': ['core', 'parallel', 'geometry', 'model', 'clash', 'hlr', 'drawing'],
    'generate': ['core', 'parallel', 'geometry', 'model', 'clash'],
}
LINES = {'.hpp': 300, '.cpp': 600}
IN_ROOT = {'.clang-format', '.clang-tidy', '.gitattributes', '.gitignore', 'ARCHITECTURE.md', 'CHANGELOG.md', 'CMakeLists.txt',
           'CMakePresets.json', 'CONTRIBUTING.md', 'HACKING.md', 'LICENSE', 'NOTICE', 'README.md', 'SECURITY.md',
           'packages.txt', 'run'}
NEEDS_SPDX = {'.cpp', '.hpp', '.py', '.sh', '.cmake'}
IMPURE = re.compile(r'\bstd::(cout|cerr|abort|exit|getenv)\b|(?<![\w:.])(printf|puts|abort|exit|getenv)\s*\('
                    r'|\bthread_local\b|\bfmt::print\b')


def tracked():
    """The files of the project: git's, or in a release, which is no checkout, and without
    git, all outside build."""
    if not Path('.git').exists() or not shutil.which('git'):
        return sorted(path for path in Path('.').rglob('*') if path.is_file() and path.parts[0] not in ('build', '.git'))
    out = subprocess.run(['git', 'ls-files', '-z', '--cached', '--others', '--exclude-standard'],
                         check=True, capture_output=True, text=True).stdout
    return sorted(Path(name) for name in set(out.split('\0')) if name)


def module_of(path):
    parts = path.parts
    if parts[:2] == ('include', 'strake') and len(parts) > 3:
        return parts[2]
    if parts[0] == 'src' and len(parts) > 2:
        return parts[1]
    return None


def faults_of(path, text):
    lines = text.splitlines()
    head = '\n'.join(lines[:3])
    if (path.suffix in NEEDS_SPDX or path.name == 'CMakeLists.txt') and 'SPDX-License-Identifier' not in head:
        yield 1, 'no SPDX-License-Identifier in the first lines'
    limit = LINES.get(path.suffix)
    if limit and len(lines) > limit:
        yield len(lines), f'{len(lines)} lines; {limit} is the limit for one job'
    module = module_of(path)
    if module is None or path.suffix not in LINES:
        return
    for number, line in enumerate(lines, 1):
        include = re.match(r'\s*#include\s+"(?:strake/)?([a-z]+)/', line)
        if include and include[1] in MAY_USE and include[1] != module and include[1] not in MAY_USE[module]:
            yield number, f'layer {module} must not include {include[1]}'
        if IMPURE.search(re.sub(r'//.*|"(\\.|[^"\\])*"', '', line)):
            yield number, 'the library never prints, exits, reads the environment or hides state per thread'


def main():
    faults = []
    for path in tracked():
        if len(path.parts) == 1 and path.is_file() and path.name not in IN_ROOT:
            faults.append(f'{path}: no file that belongs in the root (a scratch file?)')
        if path.is_file() and (path.suffix in NEEDS_SPDX or path.name == 'CMakeLists.txt'):
            faults += [f'{path}:{n}: {what}' for n, what in faults_of(path, path.read_text(encoding='utf-8'))]
    if faults:
        sys.exit('\n'.join(faults))


if __name__ == '__main__':
    main()
