#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""clash_pictures_test.py STRAKE: pictures of clashes in a folder, all clashes on a drawing, markers in a model."""
import html.parser
import json
import struct
import xml.etree.ElementTree as ET
import zlib

from scenario import Scenario, cube, main

SVG = '{http://www.w3.org/2000/svg}'
OF_A, OF_B = (0xd5, 0x5e, 0x00), (0x00, 0x72, 0xb2)


def png_points(data):
    """Width, height and the points of a PNG of 8-bit RGB whose rows are filtered by Up."""
    assert data[:8] == b'\x89PNG\r\n\x1a\n', data[:8]
    at, chunks = 8, {}
    while at < len(data):
        length, = struct.unpack('>I', data[at:at + 4])
        kind, body = data[at + 4:at + 8], data[at + 8:at + 8 + length]
        assert zlib.crc32(kind + body) == struct.unpack('>I', data[at + 8 + length:at + 12 + length])[0], kind
        chunks[kind] = body
        at += 12 + length
    width, height, depth, colour = struct.unpack('>IIBB', chunks[b'IHDR'][:10])
    assert (depth, colour) == (8, 2), (depth, colour)
    rows, step = zlib.decompress(chunks[b'IDAT']), 3 * width + 1
    assert len(rows) == step * height
    above, points = bytes(3 * width), []
    for y in range(height):
        assert rows[y * step] == 2
        above = bytes((x + a) & 255 for x, a in zip(rows[y * step + 1:(y + 1) * step], above, strict=True))
        points += zip(above[::3], above[1::3], above[2::3], strict=True)
    return width, height, points


class Images(html.parser.HTMLParser):
    def __init__(self):
        super().__init__()
        self.files = []

    def handle_starttag(self, tag, attrs):
        assert tag != 'script'
        if tag == 'img':
            self.files.append(dict(attrs)['src'])


class ClashPictures(Scenario):
    def ship(self):
        self.text('generate', 'ship', '--objects', 300, '-o', 'ship.glb')
        return ['clash', 'ship.glb', '--class', 'hit,clearance', '--clearance', '25mm']

    def pictures(self, folder):
        index = Images()
        index.feed((self.folder / folder / 'index.html').read_text(encoding='utf-8'))
        self.assertEqual(sorted([*index.files, 'index.html']), sorted(f.name for f in (self.folder / folder).iterdir()))
        return index.files

    def test_a_picture_of_each_clash_the_worst_first(self):
        done = self.run_strake(*self.ship(), '--pictures', 'p', '--top-pictures', 3, '-o', 'x.json')
        self.assertEqual(done.returncode, 0, done.stderr)
        results = [r for r in json.loads((self.folder / 'x.json').read_text())['results'] if r['class'] != 'CONTACT']
        self.assertGreater(len(results), 3)
        self.assertIn(f'wrote p: 3 pictures, {len(results) - 3} more left out (--top-pictures)', done.stderr)
        order = sorted(results, key=lambda r: (r['class'] != 'HIT', r['d_mm'], r['key']))
        self.assertEqual(self.pictures('p'), [r['key'] + '.svg' for r in order[:3]])
        for name in self.pictures('p'):
            root = ET.parse(self.folder / 'p' / name).getroot()
            self.assertEqual(root.tag, SVG + 'svg')
            self.assertTrue({'#d55e00', '#0072b2'} <= {path.get('stroke') for path in root.iter(SVG + 'path')})
            words = ' '.join(text.text for text in root.iter(SVG + 'text'))
            result, = [r for r in results if name.startswith(r['key'])]
            self.assertIn(result['a']['name'], words)
            self.assertIn(result['b']['name'], words)

    def test_png_has_both_colours(self):
        self.write('two.obj', cube('a', 0, (0, 0, 0), 100) + cube('b', 1, (60, 30, 40), 100))
        self.text('clash', 'two.obj', '--pictures', 'p', '--picture-format', 'png')
        name, = self.pictures('p')
        width, height, points = png_points((self.folder / 'p' / name).read_bytes())
        self.assertEqual((width, height), (1280, 960))
        for colour in OF_A, OF_B, (0x11, 0x11, 0x11), (255, 255, 255):
            self.assertGreater(points.count(colour), 300, colour)

    def test_groups_have_one_picture_each(self):
        run = [*self.ship(), '--group-by', 'element']
        self.text(*run, '--pictures', 'p', '-o', 'x.json')
        groups = json.loads((self.folder / 'x.json').read_text())['groups']['list']
        self.assertEqual(sorted(self.pictures('p')), sorted(g['id'] + '.svg' for g in groups))

    def test_bytes_do_not_depend_on_threads(self):
        run, outputs = self.ship(), ('.svg', '.glb')
        for threads in 1, 2, 3, 8:
            self.text(*run, '--threads', threads, '--pictures', f'p{threads}', '--top-pictures', 4,
                      *[x for o in outputs for x in ('-o', f'x{threads}{o}')])
            for name in self.pictures('p1'):
                self.assertEqual((self.folder / f'p{threads}' / name).read_bytes(),
                                 (self.folder / 'p1' / name).read_bytes())
            for ending in outputs:
                self.assertEqual((self.folder / f'x{threads}{ending}').read_bytes(),
                                 (self.folder / f'x1{ending}').read_bytes())

    def test_only_pictures_are_replaced(self):
        self.write('two.obj', cube('a', 0, (0, 0, 0), 100) + cube('b', 1, (60, 30, 40), 100))
        run = ['clash', 'two.obj', '--pictures', 'p']
        self.text(*run)
        before = {f.name: f.read_bytes() for f in (self.folder / 'p').iterdir()}
        self.text(*run)
        self.assertEqual({f.name: f.read_bytes() for f in (self.folder / 'p').iterdir()}, before)
        self.write('p/notes.txt', 'mine')
        done = self.run_strake(*run)
        self.assertEqual(done.returncode, 3, done.stderr)
        self.assertIn('p: holds something else than pictures of clashes', done.stderr)
        self.assertEqual((self.folder / 'p' / 'notes.txt').read_text(), 'mine')
        (self.folder / 'p' / 'notes.txt').unlink()
        self.write('p/index.html', 'my own page')
        self.assertEqual(self.run_strake(*run).returncode, 3)
        self.assertEqual(sorted(f.name for f in self.folder.iterdir()), ['p', 'two.obj'], 'nothing is left beside')

    def test_the_drawing_of_all_counts_what_the_result_counts(self):
        self.text(*self.ship(), '-o', 'x.svg', '-o', 'x.json')
        result = json.loads((self.folder / 'x.json').read_text())
        root = ET.parse(self.folder / 'x.svg').getroot()
        words = [text.text for text in root.iter(SVG + 'text')]
        counts = result['tests'][0]['counts'] if 'counts' in result['tests'][0] else result['counts']
        self.assertIn(f'{counts["HIT"]} hits', words)
        self.assertIn(f'{counts["CLEARANCE_VIOLATION"]} clearance violations', words)
        marked = [r for r in result['results'] if r['class'] != 'CONTACT']
        self.assertEqual(len([w for w in words if w.isdigit()]), min(200, len(marked)))

    def test_markers_read_back_are_the_results(self):
        self.text(*self.ship(), '-o', 'm.glb', '-o', 'x.json')
        results = json.loads((self.folder / 'x.json').read_text())['results']
        info = json.loads(self.text('info', 'm.glb', '--json'))
        objects = {r[side]['id'] for r in results for side in 'ab'}
        self.assertEqual(info['files'][0]['objects'], len(results) + len(objects))
        data = (self.folder / 'm.glb').read_bytes()
        length, = struct.unpack('<I', data[12:16])
        nodes = json.loads(data[20:20 + length])['nodes']
        markers = {n['name']: n['extras']['attributes'] for n in nodes if 'key' in n.get('extras', {}).get('attributes', {})}
        self.assertEqual({key: (m['class'], float(m['d_mm'])) for key, m in markers.items()},
                         {r['key']: (r['class'], round(r['d_mm'], 3)) for r in results})

    def test_wrong_options_are_reported_before_the_run(self):
        self.write('two.obj', cube('a', 0, (0, 0, 0), 100) + cube('b', 1, (60, 30, 40), 100))
        for arguments, words in ((['--top-pictures', '3'], '--pictures'),
                                 (['--pictures', 'p', '--top-pictures', '-1'], '--top-pictures'),
                                 (['--pictures', 'p', '--picture-format', 'gif'], 'svg'),
                                 (['--pictures', 'two.obj'], 'two.obj')):
            done = self.run_strake('clash', 'two.obj', *arguments)
            self.assertIn(done.returncode, (2, 3), done.stderr)
            self.assertIn(words, done.stderr)
        self.assertEqual([f.name for f in self.folder.iterdir()], ['two.obj'])


if __name__ == '__main__':
    main()
