#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""check_refused.py COMPILER INCLUDE CASES.cpp: no case compiles, each says what stands after "refused:" in its
line, and what is left without any of them compiles."""
import re
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor


def main():
    compiler, include, source = sys.argv[1:4]
    with open(source, encoding='utf-8') as file:
        wanted = {int(number): words.strip()
                  for number, words in re.findall(r'^#(?:el)?if CASE == (\d+)\s+// refused: (.+)$', file.read(), re.M)}
    if len(wanted) < 10 or sorted(wanted) != list(range(1, len(wanted) + 1)):
        sys.exit(f'{source}: cases {sorted(wanted)}')

    def fault(case):
        done = subprocess.run([compiler, '-std=c++20', '-fsyntax-only', f'-DCASE={case}', '-I', include, source],
                              capture_output=True, text=True, check=False)
        if case == 0:
            return done.returncode and f'without any case: {done.stderr}'
        if done.returncode == 0:
            return f'case {case} compiles'
        return wanted[case] not in done.stderr and f'case {case} does not say "{wanted[case]}":\n{done.stderr[:2000]}'

    with ThreadPoolExecutor(2) as workers:
        faults = [text for text in workers.map(fault, [0, *wanted]) if text]
    if faults:
        sys.exit('\n'.join(faults))


if __name__ == '__main__':
    main()
