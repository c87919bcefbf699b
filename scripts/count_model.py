#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Counts objects and triangles of OBJ, STL, PLY and glTF files, for comparison with the readers.

A second opinion: it shares no code with the product, reads whole files with the plainest means,
and takes its rules from the formats' specifications. Prints one JSON object per file: objects,
triangles, segments of polylines, and "refused" with a reason where nothing can be read.
"""
import base64
import json
import math
import struct
import sys
from pathlib import Path
from urllib.parse import unquote


class Refused(Exception):
    pass


# ---------------------------------------------------------------- OBJ
def obj_lines(data):
    text = data.decode('utf-8', 'replace').replace('\r\n', '\n').replace('\\\n', ' ')
    for line in text.split('\n'):
        words = line.split()
        if words:
            yield words[0], words[1:], line


def count_obj(path):
    vertices = [0]
    o, g, number = None, None, 0
    found = {}
    for word, rest, line in obj_lines(path.read_bytes()):
        if word == 'v':
            vertices.append(tuple(float(x) for x in rest[:3]))
        elif word == 'o':
            o, g, number = ' '.join(rest), None, number + 1
        elif word == 'g':
            g = ' '.join(rest)
        elif word in ('f', 'l'):
            corners = [int(w.split('/')[0]) for w in rest]
            corners = [c if c > 0 else len(vertices) + c for c in corners]
            if len(corners) < (3 if word == 'f' else 2):
                continue
            found.setdefault((number, g), []).append((word, corners))
    good = [[(word, corners) for word, corners in rows if all(
        0 < c < len(vertices) and all(map(math.isfinite, vertices[c])) for c in corners)]
            for rows in found.values()]
    rows = [row for rows in good for row in rows]
    if not rows:
        raise Refused('no usable object')
    return (sum(map(bool, good)), sum(len(c) - 2 for word, c in rows if word == 'f'),
            sum(len(c) - 1 for word, c in rows if word == 'l'))


# ---------------------------------------------------------------- STL
def count_stl(path):
    data = path.read_bytes()
    if len(data) >= 84:
        n = struct.unpack_from('<I', data, 80)[0]
        if len(data) == 84 + 50 * n:
            good = sum(all(map(math.isfinite, struct.unpack_from('<9f', data, 96 + 50 * k))) for k in range(n))
            if good == 0:
                raise Refused('no facets')
            return 1, good, 0
    words = data.decode('latin-1').lower().split('\n')
    objects = triangles = here = 0
    for line in words + ['endsolid']:
        word = line.split()[:1]
        if word == ['endfacet']:
            here += 1
        if word in (['endsolid'], ['solid']):
            objects += here > 0
            triangles += here
            here = 0
    if not triangles:
        raise Refused('no facets')
    return objects, triangles, 0


# ---------------------------------------------------------------- PLY
PLY_TYPES = {'char': 'b', 'int8': 'b', 'uchar': 'B', 'uint8': 'B', 'short': 'h', 'int16': 'h', 'ushort': 'H',
             'uint16': 'H', 'int': 'i', 'int32': 'i', 'uint': 'I', 'uint32': 'I', 'float': 'f', 'float32': 'f',
             'double': 'd', 'float64': 'd'}


def count_ply(path):
    head, _, body = path.read_bytes().replace(b'\r\n', b'\n').partition(b'end_header\n')
    lines = [line.split() for line in head.decode('latin-1').split('\n')]
    form = next(words[1] for words in lines if words[:1] == ['format'])
    numbers, at = iter(body.split()) if form == 'ascii' else None, 0

    def number(code):
        nonlocal at
        if numbers is not None:
            return float(next(numbers))
        value, = struct.unpack_from(('<' if 'little' in form else '>') + code, body, at)
        at += struct.calcsize(code)
        return value

    triangles = segments = 0
    for i, words in enumerate(lines):
        if words[:1] != ['element']:
            continue
        properties = []
        for words_below in lines[i + 1:]:
            if words_below[:1] == ['element']:
                break
            if words_below[:1] == ['property']:
                properties.append(words_below[1:])
        for _ in range(int(words[2])):
            for name in properties:
                if name[0] == 'list':
                    count = int(number(PLY_TYPES[name[1]]))
                    for _ in range(count):
                        number(PLY_TYPES[name[2]])
                    if name[3].startswith('vertex_ind'):
                        triangles += count - 2
                else:
                    number(PLY_TYPES[name[0]])
            segments += words[1] == 'edge'
    return 1, triangles, segments


# ---------------------------------------------------------------- glTF
FORMATS = {5120: 'b', 5121: 'B', 5122: 'h', 5123: 'H', 5125: 'I', 5126: 'f'}
WIDTHS = {'SCALAR': 1, 'VEC2': 2, 'VEC3': 3, 'VEC4': 4}
UNREAD = {'KHR_draco_mesh_compression'}


class Gltf:
    def __init__(self, path):
        data = path.read_bytes()
        self.binary = None
        if data[:4] == b'glTF':
            size = struct.unpack_from('<I', data, 12)[0]
            self.json = json.loads(data[20:20 + size])
            if len(data) > 20 + size:
                self.binary = data[28 + size:]
        else:
            self.json = json.loads(data)
        self.path = path

    def buffer(self, i):
        uri = self.json['buffers'][i].get('uri')
        if uri is None:
            return self.binary
        if uri.startswith('data:'):
            return base64.b64decode(uri.split(',', 1)[1])
        return (self.path.parent / unquote(uri)).read_bytes()

    def read(self, i):
        a = self.json['accessors'][i]
        width, code = WIDTHS[a['type']], FORMATS[a['componentType']]
        size = struct.calcsize(code) * width
        if 'bufferView' not in a:
            values = [(0,) * width] * a['count']
        else:
            view = self.json['bufferViews'][a['bufferView']]
            data, stride = self.buffer(view['buffer']), view.get('byteStride', size)
            start = view.get('byteOffset', 0) + a.get('byteOffset', 0)
            values = [struct.unpack_from('<%d%s' % (width, code), data, start + stride * k)
                      for k in range(a['count'])]
        if 'sparse' in a:
            raise NotImplementedError('sparse')
        return values

    def packed(self, i):
        view = self.json['accessors'][i].get('bufferView')
        return view is not None and 'EXT_meshopt_compression' in self.json['bufferViews'][view].get('extensions', {})

    def primitive(self, p):
        """Triangles and segments without those that use a vertex that is not there or nowhere."""
        mode = p.get('mode', 4)
        if mode == 0:
            return 0, 0
        if self.packed(p['attributes']['POSITION']):  # it says how many there are, and all are taken for good
            good = [True] * self.json['accessors'][p.get('indices', p['attributes']['POSITION'])]['count']
        else:
            points = self.read(p['attributes']['POSITION'])
            indices = [i[0] for i in self.read(p['indices'])] if 'indices' in p else range(len(points))
            good = [i < len(points) and all(map(math.isfinite, points[i])) for i in indices]
        n = len(good)
        size = 2 if mode < 4 else 3
        elements = {1: range(0, n - 1, 2), 2: range(n), 3: range(n - 1), 4: range(0, n - 2, 3),
                    5: range(n - 2), 6: range(1, n - 1)}[mode]
        if mode == 6:
            kept = sum(good[0] and good[i] and good[i + 1] for i in elements)
        else:
            kept = sum(all(good[(i + k) % n] for k in range(size)) for i in elements)
        return (kept, 0) if size == 3 else (0, kept)

    def mesh(self, i):
        total = [0, 0]
        for p in self.json['meshes'][i]['primitives']:
            one = self.primitive(p)
            total = [total[0] + one[0], total[1] + one[1]]
        return total if any(total) else None

    def roots(self):
        nodes, scenes = self.json.get('nodes', []), self.json.get('scenes', [])
        if scenes:
            return scenes[self.json.get('scene', 0)].get('nodes', [])
        children = {c for n in nodes for c in n.get('children', [])}
        return [i for i in range(len(nodes)) if i not in children]

    def count(self):
        unread = UNREAD & set(self.json.get('extensionsRequired', []))
        if unread:
            raise Refused('requires ' + ', '.join(sorted(unread)))
        objects = triangles = segments = 0
        known, open_nodes = {}, list(self.roots())
        while open_nodes:
            node = self.json['nodes'][open_nodes.pop()]
            open_nodes += node.get('children', [])
            if 'mesh' not in node:
                continue
            if node['mesh'] not in known:
                known[node['mesh']] = self.mesh(node['mesh'])
            if known[node['mesh']] is not None:
                objects += 1
                triangles += known[node['mesh']][0]
                segments += known[node['mesh']][1]
        if not objects:
            raise Refused('no usable object')
        return objects, triangles, segments


COUNTERS = {'.obj': count_obj, '.stl': count_stl, '.ply': count_ply, '.glb': lambda p: Gltf(p).count(),
            '.gltf': lambda p: Gltf(p).count()}


def main():
    for name in sys.argv[1:]:
        path = Path(name)
        try:
            objects, triangles, segments = COUNTERS[path.suffix.lower()](path)
            result = {'objects': objects, 'triangles': triangles, 'segments': segments}
        except Refused as reason:
            result = {'refused': str(reason)}
        print(json.dumps({'file': name, **result}))


if __name__ == '__main__':
    main()
