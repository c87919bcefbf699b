# SPDX-License-Identifier: Apache-2.0
"""Tells what the calling thread of a program does while no team works: between its regions.

    python3 scripts/time_alone.py build/release/bin/strake clash ship.glb --json

Samples of the calling thread (Linux, `perf`) whose stack has no region of a team in it, by the function
that they are in and by the functions of Strake that called it. It wants a build with symbols; frame
pointers are not needed. Whatever the program prints is dropped.
"""
import argparse
import collections
import os
import re
import subprocess
import sys
import tempfile

# A thread that has the team's attention, or waits for its workers.
IN_REGION = ('Team::call_all', 'HostExecutor::call_all')
FRAME = re.compile(r'^\s+[0-9a-f]+ (.*)$')


def short_name(symbol):
    """A function's name without parameters, template arguments and what every name begins with."""
    symbol = re.sub(r'\+0x[0-9a-f]+$', '', symbol.rsplit(' (', 1)[0]).replace('(anonymous namespace)::', '')
    symbol = re.sub(r'\[clone [^]]*\]', '', symbol)
    short, depth = '', 0
    for sign in symbol.replace('operator<', 'operator_less').replace('operator()', 'call'):
        depth -= sign in '>)'
        short += sign if depth == 0 and sign not in '>)' else ''
        depth += sign in '<('
    return short.replace('strake::', '').strip(' <(')


def stacks(lines):
    """Yields the stacks of a profile, the innermost function first."""
    stack = []
    for line in lines:
        frame = FRAME.match(line)
        if frame:
            stack.append(frame.group(1))
        elif stack:
            yield stack
            stack = []
    if stack:
        yield stack


def profile(command, rate, stack_bytes):
    """Runs a command and yields the stacks of its first thread."""
    with tempfile.TemporaryDirectory() as folder:
        data = os.path.join(folder, 'perf.data')
        record = ['perf', 'record', '-q', '-i', '-e', 'cpu-clock', '-F', str(rate), '--call-graph',
                  f'dwarf,{stack_bytes}', '-o', data, '--', *command]
        subprocess.run(record, stdout=subprocess.DEVNULL, check=False)
        script = ['perf', 'script', '-i', data, '--no-inline', '-F', 'ip,sym']
        with subprocess.Popen(script, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True) as run:
            yield from stacks(run.stdout)


def print_table(title, counts, ms, min_ms):
    print(f'\n{title}')
    for name, count in counts.most_common():
        if count * ms < min_ms:
            break
        print(f'{count * ms:9.1f} ms  {name}')


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument('--rate', type=int, default=2000, help='samples a second')
    parser.add_argument('--stack', type=int, default=32768, help='bytes of the stack that a sample keeps')
    parser.add_argument('--depth', type=int, default=3, help='functions of Strake that are told')
    parser.add_argument('--least', type=float, default=1, help='milliseconds that a line takes at least')
    parser.add_argument('command', nargs=argparse.REMAINDER)
    given = parser.parse_args()
    if not given.command:
        parser.error('name a program to run')
    everything = alone = 0
    innermost, callers, phases = (collections.Counter() for _ in range(3))
    for stack in profile(given.command, given.rate, given.stack):
        everything += 1
        if any(name in frame for frame in stack for name in IN_REGION):
            continue
        alone += 1
        ours = [short_name(frame) for frame in stack if 'strake::' in frame]
        innermost[short_name(stack[0])] += 1
        callers[' < '.join(ours[:given.depth]) or short_name(stack[-1])] += 1
        # Behind main(), run() and the verb.
        phases[' > '.join(ours[::-1][:given.depth + 3])] += 1
    if everything == 0:
        sys.exit('no samples: is perf allowed here?')
    ms = 1000 / given.rate
    print(f'the calling thread: {everything * ms:.0f} ms, of these {alone * ms:.0f} ms alone')
    print_table('by the innermost function', innermost, ms, given.least)
    print_table('by the innermost functions of Strake', callers, ms, given.least)
    print_table('by the outermost functions of Strake', phases, ms, given.least)


if __name__ == '__main__':
    main()
