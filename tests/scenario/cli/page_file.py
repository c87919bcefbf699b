# SPDX-License-Identifier: Apache-2.0
"""A report page taken apart, by docs/formats/page.md alone."""
import base64
import gzip
import json
import re
import struct

NUMBERS = {'u8': 'B', 'u16': 'H', 'u32': 'I', 'f32': 'f', 'f64': 'd'}
ELEMENT = re.compile(r'<script type="application/octet-stream\+gzip" id="(strake-[a-z0-9-]+)">([A-Za-z0-9+/=]*)</script>\n')
NONE = 0xffffffff


def columns_of(block):
    """The columns of a block by name; numbers of type nm are whole millionths."""
    assert block[:4] == b'SCOL'
    at = 8 + struct.unpack_from('<I', block, 4)[0]
    columns = {}
    for column in json.loads(block[8:at])['columns']:
        count, kind = column['count'], column['type']
        if kind in NUMBERS:
            form = f'<{count}{NUMBERS[kind]}'
            values = list(struct.unpack_from(form, block, at))
            at += struct.calcsize(form)
        elif kind == 'nm':
            planes = [block[at + plane * count:at + (plane + 1) * count] for plane in range(8)]
            values = [int.from_bytes(row, 'little', signed=True) for row in zip(*planes)]
            at += 8 * count
        elif kind == 'key':
            values = [block[at + 26 * i:at + 26 * (i + 1)].decode('ascii') for i in range(count)]
            at += 26 * count
        else:
            lengths = struct.unpack_from(f'<{count}I', block, at)
            at += 4 * count
            assert sum(lengths) == column['bytes']
            values = []
            for length in lengths:
                values.append(block[at:at + length].decode())
                at += length
        assert len(values) == count
        columns[column['name']] = values
    assert at == len(block), 'nothing stands behind the last column'
    return columns


class PageFile:
    """The head, the columns and the drawings of a page."""

    def __init__(self, path):
        text = path.read_bytes().decode()
        self.around = ELEMENT.sub('', text)  # what stands round the payload
        self.blocks = {}
        for name, packed in ELEMENT.findall(text):
            assert name not in self.blocks
            file = base64.b64decode(packed, validate=True)
            assert file[:10] == b'\x1f\x8b\x08\0\0\0\0\0\0\xff', 'no time, no name'
            self.blocks[name] = gzip.decompress(file)
        self.head = json.loads(self.blocks['strake-head'])
        listed = {block['id']: block['bytes'] for block in self.head['blocks']}
        assert listed == {name: len(block) for name, block in self.blocks.items() if name != 'strake-head'}
        self.columns = {name: columns_of(block) for name, block in self.blocks.items()
                        if name != 'strake-head' and '-drawing-' not in name}
        self.drawings = [self.blocks[f'strake-drawing-{i}'].decode() for i in range(len(self.head['drawings']))]

    def rows(self, name):
        """The rows of a block as dicts, without the texts that columns count through."""
        columns = {key: values for key, values in self.columns.get(name, {}).items() if key != 'texts'}
        return [dict(zip(columns, row)) for row in zip(*columns.values())]
