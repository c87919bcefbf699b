# SPDX-License-Identifier: Apache-2.0
"""Small models that scenarios of the project file change: what designers do from one day to the next, drawn at random."""
import base64
import json
import struct

# How far objects lie apart and how long their sides are, mm: in so small a hall most of them have neighbours that they
# touch, pass through or nearly touch.
PLACES = range(0, 260, 20)
SIDES = (40, 60, 100, 140)
SYSTEMS = ('PIPING', 'HVAC', 'STEEL')
BOX = ((1, 4, 3, 2), (5, 6, 7, 8), (1, 2, 6, 5), (2, 3, 7, 6), (3, 4, 8, 7), (4, 1, 5, 8))
WEDGE = ((1, 3, 2), (4, 5, 6), (1, 2, 5, 4), (2, 3, 6, 5), (3, 1, 4, 6))


def corners_of(kind, sides):
    x, y, z = sides
    if kind == 'box':
        return [(a, b, c) for c in (0, z) for a, b in ((0, 0), (x, 0), (x, y), (0, y))]
    return [(a, b, c) for c in (0, z) for a, b in ((0, 0), (x, 0), (0, y))]


def faces_of(kind):
    return BOX if kind == 'box' else WEDGE


class Thing:
    """An object: a box or a wedge at a place, mm, with one attribute."""

    def __init__(self, kind, sides, place, system):
        self.kind, self.sides, self.place, self.system = kind, sides, place, system

    def state(self):
        return self.kind, self.sides, self.place, self.system


def write_obj(path, things):
    lines, first = [], 1
    for name, thing in things.items():
        corners = corners_of(thing.kind, thing.sides)
        lines.append(f'o {name}')
        lines += ['v ' + ' '.join(str(c + at) for c, at in zip(corner, thing.place)) for corner in corners]
        lines += ['f ' + ' '.join(str(first - 1 + corner) for corner in face) for face in faces_of(thing.kind)]
        first += len(corners)
    path.write_text('\n'.join(lines) + '\n', encoding='utf-8')


def write_gltf(path, things):
    """Things of one shape share a mesh, in millimetres with z up."""
    shapes = list(dict.fromkeys((thing.kind, thing.sides) for thing in things.values()))
    data, views, accessors, meshes = b'', [], [], []

    def add(content, component, count, kind, **more):
        nonlocal data
        views.append({'buffer': 0, 'byteOffset': len(data), 'byteLength': len(content)})
        accessors.append({'bufferView': len(views) - 1, 'componentType': component, 'count': count, 'type': kind, **more})
        data += content + bytes(-len(content) % 4)
        return len(accessors) - 1

    for kind, sides in shapes:
        corners = corners_of(kind, sides)
        triangles = [(face[0], face[i], face[i + 1]) for face in faces_of(kind) for i in range(1, len(face) - 1)]
        meshes.append({'primitives': [{
            'attributes': {'POSITION': add(b''.join(struct.pack('<3f', *corner) for corner in corners), 5126, len(corners),
                                           'VEC3', min=[0, 0, 0], max=list(sides))},
            'indices': add(b''.join(struct.pack('<3H', *(corner - 1 for corner in triangle)) for triangle in triangles),
                           5123, 3 * len(triangles), 'SCALAR')}]})
    nodes = [{'name': name, 'mesh': shapes.index((thing.kind, thing.sides)), 'translation': list(thing.place),
              'extras': {'id': name, 'system': thing.system}} for name, thing in things.items()]
    path.write_text(json.dumps({
        'asset': {'version': '2.0', 'extras': {'unit_mm': 1, 'up_axis': 'z'}}, 'scene': 0,
        'scenes': [{'nodes': list(range(len(nodes)))}], 'nodes': nodes, 'meshes': meshes, 'accessors': accessors,
        'bufferViews': views,
        'buffers': [{'byteLength': len(data), 'uri': 'data:application/octet-stream;base64,'
                     + base64.b64encode(data).decode()}]}), encoding='utf-8')


class Yard:
    """Model files of one folder. Of each edit it tells what a project should: the kind of change by name of the object."""

    def __init__(self, folder, random, objects):
        self.folder, self.random, self.made, self.revision = folder, random, 0, 0
        self.files = {'hull.gltf': {}, 'pipes.gltf': {}, 'steel.obj': {}}
        for things in self.files.values():
            for _ in range(objects):
                things.update([self.new_thing()])
        self.write()

    def write(self):
        for name, things in self.files.items():
            (write_obj if name.endswith('.obj') else write_gltf)(self.folder / name, things)

    def place(self):
        return tuple(self.random.choice(PLACES) for _ in range(3))

    def sides(self):
        return tuple(self.random.choice(SIDES) for _ in range(3))

    def new_thing(self):
        self.made += 1
        return f'T{self.made:03}', Thing(self.random.choice(('box', 'box', 'wedge')), self.sides(), self.place(),
                                         self.random.choice(SYSTEMS))

    def some(self):
        """A file, and the name of an object in it."""
        file = self.random.choice(sorted(self.files))
        return file, self.random.choice(sorted(self.files[file]))

    def add(self):
        things = self.files[self.some()[0]]
        things.update([self.new_thing()])

    def remove(self):
        file, name = self.some()
        if len(self.files[file]) > 4:
            del self.files[file][name]

    def move(self):
        file, name = self.some()
        self.files[file][name].place = self.place()

    def nudge(self):
        """By a length that no tolerance hides."""
        file, name = self.some()
        x, y, z = self.files[file][name].place
        self.files[file][name].place = (x + self.random.choice((-3, 3)), y, z)

    def reshape(self):
        file, name = self.some()
        self.files[file][name].sides = self.sides()

    def attribute(self):
        file, name = self.some()
        self.files[file][name].system = self.random.choice(SYSTEMS)

    def order(self):
        """Another order of objects, as exporters have it that keep none."""
        file = self.some()[0]
        things = list(self.files[file].items())
        self.random.shuffle(things)
        self.files[file] = dict(things)

    def rename(self):
        """A file under another name, which may come before or behind others; the old one is no more. Returns both names."""
        old = self.some()[0]
        self.revision += 1
        stem, ending = old.split('.')
        new = f'{self.random.choice("amz")}_{self.revision}_{stem.split("_")[-1]}.{ending}'
        self.files = {new if name == old else name: things for name, things in self.files.items()}
        (self.folder / old).unlink(missing_ok=True)
        return old, new

    def copy(self):
        """One object at the place and of the shape of another: two that are one as far as geometry goes."""
        file, name = self.some()
        other = self.files[self.some()[0]]
        made, thing = self.new_thing()
        thing.kind, thing.sides, thing.place, _ = self.files[file][name].state()
        other[made] = thing

    def edit(self):
        """Changes one thing or nothing, and returns what was renamed."""
        kind = self.random.choice((self.add, self.remove, self.move, self.move, self.nudge, self.reshape, self.attribute,
                                   self.order, self.copy, self.rename, lambda: None))
        return kind() if kind == self.rename else kind() and None
