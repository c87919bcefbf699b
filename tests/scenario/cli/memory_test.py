#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""memory_test.py STRAKE: a run that needs more memory than there is says so, whatever it was doing."""
import resource

from scenario import Scenario, main

MIB = 1 << 20


class Memory(Scenario):
    REPORTED = 'strake: error: out of memory (use a machine with more memory, or a part of the model)\n'

    def run_within(self, size, *arguments):
        return self.run_strake(*arguments,
                               preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_AS, (size, size)))

    def least(self):
        """The address space that the program needs to start, and hardly more: a small run must not fit in too."""
        def starts(size):
            return self.run_within(size, '--version').returncode == 0

        for size in range(4 * MIB, 256 * MIB, MIB):
            if starts(size):
                return next(fine for fine in range(size - MIB, size + 1, MIB // 64) if starts(fine))
        self.skipTest('the program is built with a sanitizer, which takes all address space')

    def setUp(self):
        super().setUp()
        self.base = self.least()
        for arguments in (['generate', 'ship', '--objects', 300, '-o', 'ship.glb'],
                          ['clash', 'ship.glb', '--quiet', '-o', 'old.json']):
            self.assertEqual(self.run_strake(*arguments).returncode, 0)
        self.before = self.files()

    def outcomes(self, output, *arguments):
        """Exit codes within more and more memory, until there is enough of it."""
        codes = []
        for more in range(0, 400 * MIB, MIB):
            done = self.run_within(self.base + more, *arguments, '-o', output, '--threads', 2, '--quiet')
            codes.append(done.returncode)
            if done.returncode == 0:
                self.assertEqual(self.files(), sorted([*self.before, output]))
                (self.folder / output).unlink()
                if codes[-3:] == [0, 0, 0]:
                    break
                continue
            self.assertEqual((done.returncode, done.stderr), (6, self.REPORTED), (arguments, more))
            self.assertEqual(self.files(), self.before)
        return codes

    def test_it_is_reported_in_one_way_and_leaves_nothing(self):
        for output, arguments in (('x.json', ['clash', 'ship.glb']), ('x.csv', ['clash', 'ship.glb']),
                                  ('x.json', ['clash', 'diff', 'old.json', 'old.json']),
                                  ('x.svg', ['draw', 'ship.glb']),
                                  ('x.glb', ['generate', 'ship', '--objects', 300]),
                                  ('x.obj', ['generate', 'ship', '--objects', 300])):
            with self.subTest(arguments=arguments, output=output):
                codes = self.outcomes(output, *arguments)
                self.assertIn(6, codes)
                self.assertEqual(codes[-1], 0)

    def test_a_small_run_needs_little_data(self):
        size = 48 * MIB
        done = self.run_strake('info', 'ship.glb', '--threads', 1,
                               preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_DATA, (size, size)))
        self.assertEqual(done.returncode, 0, done.stderr)


if __name__ == '__main__':
    main()
