#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""House rules that no compiler checks: layers, licence lines, file sizes, a library that never prints,
threads and locks in the patterns alone, no scratch files in the root."""
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
CONCURRENT = re.compile(r'\bstd::(j?thread|this_thread|async|(shared_)?future|promise|packaged_task|execution|(\w+_)?mutex'
                        r'|atomic\w*|memory_order\w*|condition_variable\w*|once_flag|call_once|lock_guard|\w+_lock'
                        r'|latch|barrier|\w+_semaphore)\b|\b(tbb::|pthread_\w+|omp_\w+|__(atomic|sync)_\w+)|#\s*pragma\s+omp\b'
                        r'|#\s*include\s*[<"](thread|future|execution|(shared_)?mutex|(std)?atomic|condition_variable|latch'
                        r'|barrier|semaphore|pthread\.h|omp\.h|oneapi/|tbb/)')
# What has threads, locks or atomics of its own, though it is not of the patterns, and why.
OWN_CONCURRENCY = {
    'cli/console.cpp': 'lines of several threads on one terminal',
    'cli/console.hpp': 'lines of several threads on one terminal',
    'cli/interrupts.cpp': 'waits for signals',
    'cli/interrupts.hpp': 'waits for signals',
    'cli/progress_line.cpp': 'shows how far a run is while it runs',
    'cli/progress_line.hpp': 'shows how far a run is while it runs',
    'cli/session.cpp': 'the step that the progress line names',
    'cli/session.hpp': 'the step that the progress line names',
}


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


def code_of(line):
    """The line without its comment and what stands in quotes, but for names of headers."""
    return re.sub(r'//.*' if '#include' in line else r'//.*|"(\\.|[^"\\])*"', '', line)


def concurrency_faults(path, lines):
    """Threads, locks and atomics outside the patterns; an exception that is none any more."""
    if path.suffix not in LINES or path.parts[0] not in ('src', 'include', 'cli') or module_of(path) == 'parallel':
        return
    found = [number for number, line in enumerate(lines, 1) if CONCURRENT.search(code_of(line))]
    if path.as_posix() not in OWN_CONCURRENCY:
        for number in found:
            yield number, 'threads, locks and atomics belong to strake::parallel: take one of its patterns'
    elif not found:
        yield 1, 'has no threads, locks or atomics: no exception in check_house.py'


def faults_of(path, text):
    lines = text.splitlines()
    head = '\n'.join(lines[:3])
    if (path.suffix in NEEDS_SPDX or path.name == 'CMakeLists.txt') and 'SPDX-License-Identifier' not in head:
        yield 1, 'no SPDX-License-Identifier in the first lines'
    limit = LINES.get(path.suffix)
    if limit and len(lines) > limit:
        yield len(lines), f'{len(lines)} lines; {limit} is the limit for one job'
    yield from concurrency_faults(path, lines)
    module = module_of(path)
    if module is None or path.suffix not in LINES:
        return
    for number, line in enumerate(lines, 1):
        include = re.match(r'\s*#include\s+"(?:strake/)?([a-z]+)/', line)
        if include and include[1] in MAY_USE and include[1] != module and include[1] not in MAY_USE[module]:
            yield number, f'layer {module} must not include {include[1]}'
        if IMPURE.search(code_of(line)):
            yield number, 'the library never prints, exits, reads the environment or hides state per thread'


def main():
    faults = [f'{name}: an exception in check_house.py for a file that is not there'
              for name in OWN_CONCURRENCY if not Path(name).exists()]
    for path in tracked():
        if len(path.parts) == 1 and path.is_file() and path.name not in IN_ROOT:
            faults.append(f'{path}: no file that belongs in the root (a scratch file?)')
        if path.is_file() and (path.suffix in NEEDS_SPDX or path.name == 'CMakeLists.txt'):
            faults += [f'{path}:{n}: {what}' for n, what in faults_of(path, path.read_text(encoding='utf-8'))]
    if faults:
        sys.exit('\n'.join(faults))


if __name__ == '__main__':
    main()
