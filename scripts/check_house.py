#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""House rules that no compiler checks: layers and rooms, licence lines, file sizes, a library that never prints,
threads, locks and hidden state in the patterns alone, nothing that standard libraries do in different ways, no scratch files
in the root."""
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
    'project': ['core', 'parallel', 'geometry', 'model', 'io', 'clash', 'settings', 'rules', 'hlr', 'drawing', 'report'],
    'tiles': ['core', 'parallel', 'geometry', 'model', 'io', 'clash', 'settings', 'rules', 'hlr', 'project'],
    'generate': ['core', 'parallel', 'geometry', 'model', 'clash'],
    'workbook': ['core', 'parallel', 'geometry', 'model', 'clash', 'drawing', 'report'],
    'pictures': ['core', 'parallel', 'geometry', 'model', 'io', 'clash', 'hlr', 'drawing', 'report'],
    'bcf': ['core', 'parallel', 'geometry', 'model', 'clash', 'hlr', 'drawing', 'report', 'pictures'],
    'page': ['core', 'parallel', 'geometry', 'model', 'clash', 'hlr', 'drawing', 'sheets', 'report'],
    'serve': ['core', 'parallel', 'geometry', 'model', 'io', 'clash', 'settings', 'rules', 'hlr', 'drawing', 'report', 'project'],
    'publish': ['core', 'parallel', 'geometry', 'model', 'io', 'clash', 'hlr', 'drawing', 'sheets', 'report', 'workbook',
                'pictures', 'bcf', 'page'],
}
# A room is a folder of a module, for one stage of an algorithm (decision 0060).
MAX_IN_ROOM = 22
LINES = {'.hpp': 300, '.cpp': 600}
IN_ROOT = {'.clang-format', '.clang-tidy', '.gitattributes', '.gitignore', 'ARCHITECTURE.md', 'CHANGELOG.md', 'CMakeLists.txt',
           'CMakePresets.json', 'CONTRIBUTING.md', 'HACKING.md', 'LICENSE', 'NOTICE', 'README.md', 'SECURITY.md',
           'packages.txt', 'pyproject.toml', 'run'}
SOURCES = ('src', 'include', 'cli')
CODE = {'.hpp', '.cpp', '.inc'}
NEEDS_SPDX = {'.cpp', '.hpp', '.py', '.sh', '.cmake'}
IMPURE = re.compile(r'\bstd::(cout|cerr|abort|exit|getenv)\b|(?<![\w:.])(printf|puts|abort|exit|getenv)\s*\('
                    r'|\bthread_local\b|\bfmt::print\b')


def words(text):
    """A pattern that matches one of the words, each a pattern itself."""
    return f'({"|".join(text.split())})'


# Threads, locks and atomics, of the language, the library, the compilers and the system. An alias of std would hide
# names from this list, which knows words and no C++.
OF_STD = words(r"""j?thread this_thread async (shared_)?future promise packaged_task execution (\w+_)?mutex atomic\w*
    memory_order\w* condition_variable\w* once_flag call_once lock lock_guard \w+_lock latch barrier
    \w+_semaphore stop_callback experimental o?syncstream syncbuf system signal""")
HEADERS = words(r"""c?threads?(\.h)? (shared_)?future execution (shared_)?mutex (c?std)?atomic(\.h)? condition_variable latch
    barrier semaphore(\.h)? syncstream experimental/ parallel/ oneapi/ tbb/ pthread\.h omp\.h sched\.h linux/futex\.h
    sys/(syscall|futex|eventfd|wait)\.h boost/ absl/ folly/ c?signal(\.h)? spawn\.h""")
CALLS = 'syscall v?fork clone3 posix_spawnp? popen flock sigaction call_once atomic_[a-z_]+'
CONCURRENT = re.compile(rf'\bstd\s*::\s*({OF_STD}\b|__\w)'
                        r'|\busing\s+namespace\s+(::\s*)?std\b|\bnamespace\s+\w+\s*=\s*(::\s*)?std\b(?!\s*::)'
                        rf'|\b{words("tbb oneapi __gnu_parallel __gnu_cxx boost absl folly")}\s*::'
                        rf'|\b{words("pthread omp thrd mtx cnd tss sem __gthread __atomic __c11_atomic __sync")}_\w+'
                        rf'|\b{words("asm __asm __asm__ volatile __volatile__ _Atomic thread_local __thread _Thread_local")}\b'
                        rf'|(?<![\w.>]){words(CALLS)}\s*\(|#\s*pragma\s+omp\b|\b_Pragma\s*\('
                        rf'|\b{words("_mm_pause __builtin_ia32_pause")}\s*\(|#\s*{words("include_next import")}\b'
                        rf'|#\s*include\s*[<"]({HEADERS}|(?<=<)(bits|ext)/)')
# What reads the environment, and why.
READS_ENVIRONMENT = {'src/io/importer/environment.cpp': 'where importers and their scenes are, unless a caller says so itself'}
# How the patterns do it, and whose threads they run on: affairs of them and of who starts a program.
INSIDES = re.compile(r'\bparallel\s*::\s*detail\b|\bteam(_|\s*\(\s*\))?\s*\)?\s*(->|\.)\s*(run|size)\b'
                     r'|\b(Team|Executor|HostExecutor|RegionRun)\b'
                     r'|\bnamespace\s+\w+\s*=[\w:\s]*\bparallel\b|\bnamespace\s+([\w:\s]*::\s*)?parallel\b'
                     r'|#\s*include\s*[<"]([\w./]*/)?parallel/(team|executor|host_executor|quota|backends/\w+)\.hpp')
# State that calls share unseen: a static that is no constant of the compiler's, which besides hides a lock if it is a
# function's, and a member that changes in a const object. A static function has a parenthesis after its name, and
# returns no const value; a lambda that is mutable has a brace or an arrow behind the word.
IN_ANGLES = r'<(?:[^<>;={]|<(?:[^<>;={]|<[^<>;={]*>)*>)*>'
HIDDEN = re.compile(r'(?<!constexpr )\bstatic\s+(?!(inline\s+)?(constexpr|constinit\s+const)\b)(?![^;{]*\boperator\b)'
                    rf'((?:{IN_ANGLES}|[^();={{<])*[;={{]|(inline\s+)?const\s(?:{IN_ANGLES}|[\w:\s])*\s\w+\s*\()'
                    r'|\bstatic\s+(alignas|__attribute__|decltype)\b|\bstatic\s+[\w:<>]+\s+\w+\s*\(\s*[\d"\']'
                    r'|\bconstinit\b(?!\s+(static\s+)?const\b)|\bconst_cast\s*<[^;]*>\s*\(\s*\*?\s*this\s*\)'
                    r'|\bmutable\b(?!\s*(\{|->|noexcept\b))')
# What each standard library, or each run, does in its own way: the order of what an algorithm leaves in no order, the numbers
# of a distribution, hashes (decision 0123). Strake's own are in core.
UNFIXED = re.compile(r'\bstd\s*::\s*(ranges\s*::\s*)?(nth_element|partition|shuffle|sample)\s*\('
                     r'|\bstd\s*::\s*(\w+_distribution|default_random_engine|random_device|hash)\b')
# Where they are, and why no result has them.
FIXES = {
    'src/core/parting.hpp': 'callers sort what it leaves in no order, or do not look at it',
    'src/core/seeded_hash.cpp': 'seeds of tables in which keys are only looked up',
}
# Names of headers and numbers are kept; a comment, a text and a character become nothing, but for the ends of lines.
TOKENS = re.compile(r'(?P<kept>#\s*include\s*(<[^>\n]*>|"[^"\n]*")|\b\d[\w.\']*)'
                    r'|R"(?P<end>[^()\\\s]*)\((?s:.*?)\)(?P=end)"|"(\\(?s:.)|[^"\\\n])*"|\'(\\.|[^\'\\\n])+\''
                    r'|//[^\n]*|/\*(?s:.*?)\*/')
# What has threads, locks, atomics or signals of its own, though it is not of the patterns, and why.
OWN_CONCURRENCY = {
    'cli/evaluate/time_limit.cpp': 'a run that may take too long is stopped from outside',
    'cli/evaluate/time_limit.hpp': 'a run that may take too long is stopped from outside',
    'cli/output/console.cpp': 'lines of several threads on one terminal, one of them the progress of a run',
    'cli/output/console.hpp': 'lines of several threads on one terminal, one of them the progress of a run',
        'cli/run/interrupts.cpp': 'waits for signals',
    'cli/run/interrupts.hpp': 'waits for signals',
    'cli/program.cpp': 'a file beyond the limit is an error of writing, no signal',
    'cli/run/session.cpp': 'the step that the progress line names',
    'cli/run/session.hpp': 'the step that the progress line names',
    'src/serve/http/wake.cpp': 'a stop request ends the wait for clients',
    'src/io/importer/child_process.cpp': 'starts another program and waits for its end',
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


def room_of(path):
    """The module and the folder in it, for what is not public."""
    parts = path.parts[1:] if path.parts[0] == 'src' else path.parts
    return (parts[0], parts[1] if len(parts) > 2 else '')


def room_faults(sources):
    """Rooms of a module that include each other, and rooms that hold too much; sources: path and text of each."""
    includes, held = {}, {}
    for path, text in sources:
        if path.parts[0] not in ('src', 'cli') or path.suffix not in CODE or len(path.parts) < 2:
            continue
        held[path.parent] = held.get(path.parent, 0) + 1
        module, room = room_of(path)
        for line in re.findall(r'^\s*#include\s+"([\w./]+)"', text, re.MULTILINE):
            target = Path(line).parts
            if target[0] == module and len(target) > 1:
                other = target[1] if len(target) > 2 else ''
                if other != room:
                    includes.setdefault((module, room, other), path)
    for (module, room, other), path in sorted(includes.items()):
        if room < other and (module, other, room) in includes:
            yield f'{path}: includes {module}/{other}, of which {includes[module, other, room]} includes {module}/{room}'
    for folder, count in sorted(held.items()):
        if count > MAX_IN_ROOM:
            yield f'{folder}: {count} files; {MAX_IN_ROOM} are the limit for one stage of an algorithm'


def code_of(text):
    """The text without comments and what stands in quotes, but for names of headers; as many lines."""
    return TOKENS.sub(lambda match: match['kept'] or '\n' * match[0].count('\n') or ' ', text)


def lines_with(pattern, code):
    """The numbers of the lines that a match begins on."""
    return sorted({code.count('\n', 0, match.start()) + 1 for match in pattern.finditer(code)})


def concurrency_faults(path, code):
    """Threads, locks, atomics and hidden state outside the patterns; an exception that is none any more."""
    if path.parts[0] not in SOURCES or module_of(path) == 'parallel':
        return
    found = lines_with(CONCURRENT, code)
    if path.as_posix() not in OWN_CONCURRENCY:
        for number in found:
            yield number, 'threads, locks and atomics belong to strake::parallel: take one of its patterns'
    elif not found:
        yield 1, 'has no threads, locks, atomics or signals: no exception in check_house.py'
    for number in lines_with(HIDDEN, code):
        yield number, 'state that calls share unseen: static constexpr, a constant of the namespace, or a parameter'
    # The header of all is for programs, as cli is one.
    if path.parts[0] != 'cli' and path.as_posix() != 'include/strake/strake.hpp':
        for number in lines_with(INSIDES, code):
            yield number, 'an engine takes a Context and the patterns: the team and their insides are not its affair'


def has_rules(path):
    return path.suffix in NEEDS_SPDX or path.name == 'CMakeLists.txt' or path.parts[0] in SOURCES


def faults_of(path, text):
    lines = text.splitlines()
    head = '\n'.join(lines[:3])
    if (path.suffix in NEEDS_SPDX or path.name == 'CMakeLists.txt') and 'SPDX-License-Identifier' not in head:
        yield 1, 'no SPDX-License-Identifier in the first lines'
    limit = LINES.get(path.suffix)
    if limit and len(lines) > limit:
        yield len(lines), f'{len(lines)} lines; {limit} is the limit for one job'
    if path.suffix not in CODE:
        if path.parts[0] in SOURCES and path.name != 'CMakeLists.txt':
            yield 1, 'sources are .hpp and .cpp, lists .inc: the house rules know no other names'
        return
    code = code_of(text)
    yield from concurrency_faults(path, code)
    if path.parts[0] in SOURCES and path.as_posix() not in FIXES:
        for number in lines_with(UNFIXED, code):
            yield number, 'each standard library has another result: part_at, part_by or nth_value of core/parting.hpp'
    module = module_of(path)
    if module is None:
        return
    for number, line in enumerate(lines, 1):
        include = re.match(r'\s*#include\s+"(?:strake/)?([a-z]+)/', line)
        if include and include[1] in MAY_USE and include[1] != module and include[1] not in MAY_USE[module]:
            yield number, f'layer {module} must not include {include[1]}'
    for number in lines_with(IMPURE, code) if path.as_posix() not in READS_ENVIRONMENT else ():
        yield number, 'the library never prints, exits, reads the environment or hides state per thread'


def main():
    faults = [f'{name}: an exception in check_house.py for a file that is not there'
              for name in OWN_CONCURRENCY if not Path(name).exists()]
    sources = []
    for path in tracked():
        if len(path.parts) == 1 and path.is_file() and path.name not in IN_ROOT:
            faults.append(f'{path}: no file that belongs in the root (a scratch file?)')
        if path.is_file() and has_rules(path):
            text = path.read_text(encoding='utf-8', errors='replace')
            faults += [f'{path}:{n}: {what}' for n, what in faults_of(path, text)]
            sources.append((path, text))
    faults += room_faults(sources)
    if faults:
        sys.exit('\n'.join(faults))


if __name__ == '__main__':
    main()
