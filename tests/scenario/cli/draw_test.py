#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""draw_test.py STRAKE: drawings do not depend on order or threads; selections and limits."""
import json

from scenario import Scenario, cube, main


class Draw(Scenario):
    def test_svg_and_json_are_the_same_for_any_number_of_threads(self):
        self.two_files()
        expected = None
        for threads in (1, 2, 3, 8, 64):
            done = self.run_strake('draw', 'a.obj', 'b.obj', '--view', 'iso', '--hidden', 'dashed', '--threads',
                                   threads, '-o', 'x.svg', '-o', 'x.json')
            self.assertEqual(done.returncode, 0, done.stderr)
            got = [(self.folder / name).read_bytes() for name in ('x.svg', 'x.json')]
            expected = expected or got
            self.assertEqual(got, expected, threads)
        self.assertIn(b'<svg', expected[0])
        self.assertEqual(set(piece['object'] for piece in json.loads(expected[1])['pieces']).__len__(), 3)

    def test_order_of_files_and_of_objects_changes_nothing(self):
        self.write('b.obj', cube('b', 0, (10, 20, 90), 40))
        got = []
        for order in ([0, 1, 2, 3, 4, 5, 6], [6, 5, 4, 3, 2, 1, 0], [3, 0, 6, 2, 5, 1, 4]):
            # Two of them coincide, so that which line is the duplicate must not depend on the order.
            self.write('all.obj', ''.join(cube(f'a{i}', at, (i % 6 * 50, i % 6 * 30, i % 6 * 20), 100)
                                          for at, i in enumerate(order)))
            for files in (('all.obj', 'b.obj'), ('b.obj', 'all.obj')):
                done = self.run_strake('draw', *files, '--unit', 'mm', '--up-axis', 'z', '--hidden', 'dashed', '-o',
                                       'x.svg', '-o', 'x.json')
                self.assertEqual(done.returncode, 0, done.stderr)
                got.append([(self.folder / name).read_bytes() for name in ('x.svg', 'x.json')])
        for other in got[1:]:
            self.assertEqual(other, got[0])

    def test_selection_limits_and_solver(self):
        self.two_files()

        def pieces(*more):
            done = self.run_strake('draw', 'a.obj', '--unit', 'mm', '--up-axis', 'z', *more, '--json')
            self.assertEqual(done.returncode, 0, done.stderr)
            return json.loads(done.stdout)['pieces']

        whole = pieces()
        self.assertEqual(whole, pieces('--solver', 'brute-force'))
        self.assertEqual(pieces('--view', 'front'), pieces('--direction', '0,-7,0'))
        one = pieces('--select', 'a0')
        self.assertLess(len(one), len(whole))
        self.assertEqual(one, pieces('--select', 'type = mesh and not name ~ "a[1-9]"'))
        self.assertEqual(whole, pieces('--select', 'a0', '--select', 'not a0'))
        wire = pieces('--stage', 'none')
        self.assertEqual({piece['state'] for piece in wire} - {'visible', 'projecting', 'duplicate'}, set())
        cut = pieces('--limits', '0,0,0,40,40,40')
        self.assertTrue(any(piece['state'] == 'clipped' for piece in cut))

    def test_an_empty_sheet_is_not_silent(self):
        self.two_files()
        done = self.run_strake('draw', 'a.obj', '-o', 'x.svg', '--limits', '1e6,1e6,1e6,2e6,2e6,2e6')
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn('nothing lies within the limits', done.stderr)


if __name__ == '__main__':
    main()
