# SPDX-License-Identifier: Apache-2.0
"""What the scenarios of the program share: a folder of their own, the program, small models."""
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

CUBE_FACES = [(1, 4, 3, 2), (5, 6, 7, 8), (1, 2, 6, 5), (2, 3, 7, 6), (3, 4, 8, 7), (4, 1, 5, 8)]


def cube(name, number, at, size):
    """An OBJ object: a cube with its lower corner at `at`."""
    x, y, z = at
    lines = [f'o {name}']
    lines += [f'v {x + dx * size} {y + dy * size} {z + dz * size}'
              for dz in (0, 1) for dx, dy in ((0, 0), (1, 0), (1, 1), (0, 1))]
    lines += ['f ' + ' '.join(str(corner + 8 * number) for corner in face) for face in CUBE_FACES]
    return '\n'.join(lines) + '\n'


def bar_between_walls():
    """An OBJ file: a cube of side 100 at 0, 10 into each of two others before and behind it, which are one object."""
    return (cube('bar', 0, (0, 0, 0), 100) + cube('walls', 1, (90, 0, 0), 100)
            + cube('', 2, (-90, 0, 0), 100).split('\n', 1)[1])


class Scenario(unittest.TestCase):
    """Runs in a new folder; main() sets the program."""

    STRAKE = None

    def setUp(self):
        self.keep = tempfile.TemporaryDirectory(prefix='strake-cli-')
        self.folder = Path(self.keep.name)

    def tearDown(self):
        self.keep.cleanup()

    def run_strake(self, *arguments, **more):
        return subprocess.run([self.STRAKE, *map(str, arguments)], capture_output=True, text=True, timeout=200,
                              cwd=self.folder, check=False, **more)

    def files(self):
        return sorted(path.name for path in self.folder.iterdir())

    def write(self, name, text):
        (self.folder / name).write_text(text, encoding='utf-8')
        return name

    def two_files(self):
        """a.obj: cubes at 0 and 50 (millimetres, side 100: they clash); b.obj: one 10 from the first."""
        self.write('a.obj', cube('a0', 0, (0, 0, 0), 100) + cube('a1', 1, (50, 50, 50), 100))
        self.write('b.obj', cube('b0', 0, (-110, 0, 0), 100))


def main():
    """Runs the tests of the script that was started; its first argument is the program."""
    Scenario.STRAKE = str(Path(sys.argv.pop(1)).resolve())
    unittest.main(verbosity=1)
