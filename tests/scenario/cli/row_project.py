# SPDX-License-Identifier: Apache-2.0
"""A project of a row of cubes, which tests of clash runs change from night to night."""
import json

from scenario import Scenario, cube

ROW = [(0, 0, 0), (80, 0, 0), (160, 0, 0), (240, 0, 0)]


def cubes(places):
    """An OBJ file of cubes c0, c1 and so on, 100 mm wide, but for those whose place is None; in a row each is 20 mm in the next."""
    there = [(name, at) for name, at in enumerate(places) if at is not None]
    return ''.join(cube(f'c{name}', n, at, 100) for n, (name, at) in enumerate(there))


class RowProject(Scenario):
    def setUp(self):
        super().setUp()
        self.write('row.obj', cubes(ROW))
        self.done('project', 'new', 'ship.strake', 'row.obj', '--unit', 'mm')

    def done(self, *arguments, exit_code=0):
        done = self.run_strake(*arguments)
        self.assertEqual(done.returncode, exit_code, done.stderr)
        return done

    def listed(self, *options):
        return json.loads(self.done('clash', 'list', '-p', 'ship.strake', '--json', *options).stdout)['clashes']

    def set(self, *options, exit_code=0):
        return self.done('clash', 'set', '-p', 'ship.strake', *options, exit_code=exit_code)
