# SPDX-License-Identifier: Apache-2.0
"""A GLB file of `strake generate` that scenarios change as designers and exporters do."""
import json
import struct


class Glb:
    """A GLB file as another program would write it again: geometry and ids are kept, unless a test changes them."""

    def __init__(self, path):
        content = path.read_bytes()
        size, = struct.unpack_from('<I', content, 12)
        self.json = json.loads(content[20:20 + size])
        self.rest = content[20 + size:]

    def objects(self):
        """The nodes that have geometry, by id."""
        return {node['extras']['id']: node for node in self.json['nodes'] if 'mesh' in node}

    def shown(self):
        """The ids of the nodes that have geometry and are in the scene; keep() leaves the others where they are."""
        children = {child for node in self.json['nodes'] for child in node.get('children', ())}
        return {node['extras']['id'] for number, node in enumerate(self.json['nodes']) if 'mesh' in node and number in children}

    def reverse(self):
        """Puts nodes and children into the opposite order."""
        last = len(self.json['nodes']) - 1
        self.json['nodes'].reverse()
        for holder, key in [(scene, 'nodes') for scene in self.json['scenes']] + \
                [(node, 'children') for node in self.json['nodes'] if 'children' in node]:
            holder[key] = [last - child for child in reversed(holder[key])]
        return self

    def move(self, ids, metres):
        for id in ids:
            self.objects()[id]['matrix'][12] += metres
        return self

    def keep(self, ids):
        """Leaves all other objects out."""
        nodes = self.json['nodes']
        for node in nodes:
            if 'children' in node:
                node['children'] = [child for child in node['children']
                                    if 'mesh' not in nodes[child] or nodes[child]['extras']['id'] in ids]
        return self

    def rename(self, ids):
        for id in ids:
            node = self.objects()[id]
            node['name'] = node['extras']['id'] = id + '-R'
        return self

    def double(self, ids, metres):
        """Adds a double of each, with an id of its own, so far along x."""
        nodes = self.json['nodes']
        for id in ids:
            number = next(n for n, node in enumerate(nodes) if 'mesh' in node and node['extras']['id'] == id)
            node = json.loads(json.dumps(nodes[number]))
            node['name'] = node['extras']['id'] = id + '-2'
            node['matrix'][12] += metres
            nodes.append(node)
            next(n for n in nodes if number in n.get('children', ()))['children'].append(len(nodes) - 1)
        return self

    def write(self, path):
        text = json.dumps(self.json).encode()
        text += b' ' * (-len(text) % 4)
        path.parent.mkdir(exist_ok=True)
        path.write_bytes(struct.pack('<4sIII4s', b'glTF', 2, 20 + len(text) + len(self.rest), len(text), b'JSON')
                         + text + self.rest)
