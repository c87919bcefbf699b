# SPDX-License-Identifier: Apache-2.0
"""What the scenarios of the program share: a folder of their own, the program, small models."""
import base64
import json
import math
import re
import signal
import struct
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

VERBS = [[], ['clash'], ['clash', 'diff'], ['clash', 'set'], ['clash', 'list'], ['clash', 'history'],
         ['draw'], ['draw', 'diff'], ['info'],
         *[['project', *verb] for verb in ([], ['new'], ['add'], ['update'], ['remove'], ['list'], ['info'], ['check'],
                                           ['export'])],
         ['rules'], ['rules', 'list'], ['rules', 'show'],
         ['cache'], ['cache', 'list'], ['cache', 'clear'], ['report'], ['view'], ['convert'], ['evaluate'], ['generate'],
         ['generate', 'ship'], ['help'], ['man'], ['completion']]
CUBE_FACES = [(1, 4, 3, 2), (5, 6, 7, 8), (1, 2, 6, 5), (2, 3, 7, 6), (3, 4, 8, 7), (4, 1, 5, 8)]


def cube(name, number, at, size):
    """An OBJ object: a cube with its lower corner at `at`."""
    x, y, z = at
    lines = [f'o {name}']
    lines += [f'v {x + dx * size} {y + dy * size} {z + dz * size}'
              for dz in (0, 1) for dx, dy in ((0, 0), (1, 0), (1, 1), (0, 1))]
    lines += ['f ' + ' '.join(str(corner + 8 * number) for corner in face) for face in CUBE_FACES]
    return '\n'.join(lines) + '\n'


def prism(name, first, sides, at, radius, bottom, top):
    """An OBJ object: an upright prism of so many sides, for a pin; `first` counts the corners of the file before it."""
    corners = [(at[0] + radius * math.cos(2 * math.pi * i / sides), at[1] + radius * math.sin(2 * math.pi * i / sides))
               for i in range(sides)]
    lines = [f'o {name}'] + [f'v {x:.6f} {y:.6f} {z}' for z in (bottom, top) for x, y in corners]
    below = [first + 1 + i for i in range(sides)]
    above = [corner + sides for corner in below]
    faces = [below[::-1], above] + [[below[i - 1], below[i], above[i], above[i - 1]] for i in range(sides)]
    lines += ['f ' + ' '.join(map(str, face)) for face in faces]
    return '\n'.join(lines) + '\n'


def bar_between_walls():
    """An OBJ file: a cube of side 100 at 0, 10 into each of two others before and behind it, which are one object."""
    return (cube('bar', 0, (0, 0, 0), 100) + cube('walls', 1, (90, 0, 0), 100)
            + cube('', 2, (-90, 0, 0), 100).split('\n', 1)[1])


def rvm(boxes, whole=True):
    """The bytes of an RVM file: for each (name, place in mm) a group with a cube of 100 mm, for (name, place, 'OBST') one
    that is an obstruction volume or, with 'INSU', insulation, for (name, place, (8, radius, height)) the primitive of that
    number with these measures; without an END, not whole."""
    content = b''

    def words(*numbers):
        return struct.pack(f'>{len(numbers)}I', *numbers)

    def floats(*numbers):
        return struct.pack(f'>{len(numbers)}f', *numbers)

    def text(value):
        data = value.encode()
        data += bytes(-len(data) % 4)
        return words(len(data) // 4) + data

    def chunk(name, body):
        nonlocal content
        content += words(*name.encode(), len(content) + 24 + len(body), 1) + body

    chunk('HEAD', words(2) + b''.join(map(text, ('test', '', '', '', 'Unicode UTF-8'))))
    chunk('MODL', words(1) + text('P') + text('/M'))
    for name, place, *kind in boxes:
        number, *measures = kind.pop() if kind and isinstance(kind[0], tuple) else (2, 100, 100, 100)
        chunk('CNTB', words(2) + text(name) + floats(0, 0, 0) + words(1))
        chunk(*(kind or ['PRIM']), words(1, number)
              + floats(.001, 0, 0, 0, .001, 0, 0, 0, .001, *(x / 1000 for x in place))
              + floats(-50, -50, -50, 50, 50, 50) + (bytes([50, 0, 0, 0]) if kind else b'') + floats(*measures))
        chunk('CNTE', words(2))
    if whole:
        chunk('END:', words(1))
    return content


def rvm_of_round_things():
    """What rvm() takes: upright cylinders, a ball, a quarter of a torus, a dish, and a box among them."""
    return [('/TANK', (0, 0, 0), (8, 250, 600)), ('/PIPE', (400, 50, 0), (8, 50.5, 800)),
            ('/PIN', (400, 50, 500), (8, 5, 300)), ('/BALL', (800, 0, 100), (9, 240)),
            ('/BEND', (0, 500, 0), (4, 300, 100, 1.5707964)), ('/CAP', (0, 0, 300), (5, 500, 90)),
            ('/BOX', (300, -200, 0))]


def sheet_with_all_notes():
    """A sheet of rvm_of_round_things() with every note that there is, centre lines, and hidden lines in two layers."""
    return '''[sheet]
size = "A2"
hidden_layers = "two"
scale = "1:10"
[fields]
title = "ALL NOTES"
[arrangement]
projection = "first-angle"
views = ["front", "top", "left"]
hidden = "all"
centre_lines = "on"
[arrangement.left]
sections = "x=100mm"
section_mark = "A"
[[view]]
name = "key"
direction = "top"
scale = "1:50"
position = ["530mm", "250mm"]
extents_of = ["front", "left"]
[levels]
z = ["0m", ["ROOF", "0.6m"]]
[[dimension]]
view = "front"
from = ["-0.5m", "0m", "0m"]
to = ["0.25m", "0m", "0.3m"]
[[dimension]]
view = "top"
from = ["0m", "0m", "0m"]
to = ["0.4m", "0.5m", "0m"]
along = "aligned"
[scale_bar]
[north]
[[parts_list]]
title = "PARTS"
select = "name = '*'"
columns = [["NAME", "{{name}}"]]
[[revision]]
revision = "B"
date = "2026-02-11"
text = "Nozzle moved"
by = "NN"
[[tag]]
views = ["top"]
select = "name = '*P*'"
text = "{{name}}"
[grid]
x = [["1", "0m"], ["2", "0.4m"]]
z = [["BL", "0m"]]
[styles]
hidden_self = { dash = ["1.5mm", "0.75mm"], color = "#00a000" }
hidden_other = { width = "0.18mm", dash = ["3mm", "1mm"], color = "#a00000" }
centre = { color = "#0000c0" }
dimension = { width = "0.25mm" }
'''


def gltf(tree):
    """A glTF file of cubes of 100 mm: a tree is (name, extras, place in m along x or None, children)."""
    corners = b''.join(struct.pack('<3f', *(x / 10 for x in (i & 1, i >> 1 & 1, i >> 2 & 1))) for i in range(8))
    faces = struct.pack('<36H', *(c for a, b, d, e in ((0, 2, 3, 1), (4, 5, 7, 6), (0, 1, 5, 4), (2, 6, 7, 3),
                                                       (0, 4, 6, 2), (1, 3, 7, 5)) for c in (a, b, d, a, d, e)))
    nodes = []

    def add(name, extras, at, children):
        node = {'name': name, 'extras': extras}
        number = len(nodes)
        nodes.append(node)
        if at is not None:
            node.update(mesh=0, translation=[at, 0, 0])
        if children:
            node['children'] = [add(*child) for child in children]
        return number

    root = add(*tree)
    return json.dumps({
        'asset': {'version': '2.0'}, 'scene': 0, 'scenes': [{'nodes': [root]}], 'nodes': nodes,
        'meshes': [{'primitives': [{'attributes': {'POSITION': 0}, 'indices': 1}]}],
        'accessors': [{'bufferView': 0, 'componentType': 5126, 'count': 8, 'type': 'VEC3',
                       'min': [0, 0, 0], 'max': [.1, .1, .1]},
                      {'bufferView': 1, 'componentType': 5123, 'count': 36, 'type': 'SCALAR'}],
        'bufferViews': [{'buffer': 0, 'byteOffset': 0, 'byteLength': 96},
                        {'buffer': 0, 'byteOffset': 96, 'byteLength': 72}],
        'buffers': [{'byteLength': 168, 'uri': 'data:application/octet-stream;base64,'
                     + base64.b64encode(corners + faces).decode()}]})


def without_decisions(text):
    """The JSON of a clash run as it is where nobody remembers what was decided."""
    text = re.sub(r'"decisions": \{.*?"not_found": \[.*?\]\},\n(?="results")', '', text, flags=re.DOTALL)
    return re.sub(r', "decision": \{[^{}]*\}', '', text)


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

    def text(self, *arguments):
        """What the program prints when it ends well."""
        done = self.run_strake(*arguments)
        self.assertEqual(done.returncode, 0, done.stderr)
        return done.stdout

    def options(self, verb):
        """The long options that --help of a verb names."""
        return set(re.findall(r'^  (?:-\w,)?(--[a-z-]+)', self.text(*verb, '--help'), re.MULTILINE))

    def files(self):
        return sorted(path.name for path in self.folder.iterdir())

    def write(self, name, text):
        (self.folder / name).write_text(text, encoding='utf-8')
        return name

    def write_rvm(self, name, boxes, whole=True):
        (self.folder / name).write_bytes(rvm(boxes, whole))

    def two_files(self):
        """a.obj: cubes at 0 and 50 (millimetres, side 100: they clash); b.obj: one 10 from the first."""
        self.write('a.obj', cube('a0', 0, (0, 0, 0), 100) + cube('a1', 1, (50, 50, 50), 100))
        self.write('b.obj', cube('b0', 0, (-110, 0, 0), 100))


def main():
    """Runs the tests of the script that was started; its first argument is the program."""
    # A shell has what runs in its background ignore Ctrl-C, and programs that are started from here would inherit it.
    signal.signal(signal.SIGINT, signal.default_int_handler)
    Scenario.STRAKE = str(Path(sys.argv.pop(1)).resolve())
    unittest.main(verbosity=1)
