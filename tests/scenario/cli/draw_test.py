#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""draw_test.py STRAKE: drawings do not depend on order or threads; selections and limits."""
import json
import re
import struct

from scenario import Scenario, cube, main, prism


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
        self.assertEqual(whole, pieces('--culling', 'off'))
        for bucketing in ('auto', 'off', '1', '16', '4096'):
            self.assertEqual(whole, pieces('--bucketing', bucketing))
        for wrong in ('0', '4097', '-1', 'on', '3.5'):
            done = self.run_strake('draw', 'a.obj', '--bucketing=' + wrong, '-o', 'x.svg')
            self.assertEqual(done.returncode, 2, wrong)
            self.assertIn('--bucketing', done.stderr)
        for threads in (1, 3):
            self.assertEqual(whole, pieces('--global', 'push', '--threads', threads))
        for distribution in ('planned', 'in-order', 'equal-ranges'):
            for threads in (1, 3, 7):
                self.assertEqual(whole, pieces('--distribution', distribution, '--threads', threads))
        self.assertEqual(pieces('--view', 'front'), pieces('--direction', '0,-7,0'))
        one = pieces('--select', 'a0')
        self.assertLess(len(one), len(whole))
        self.assertEqual(one, pieces('--select', 'type = mesh and not name ~ "a[1-9]"'))
        self.assertEqual(whole, pieces('--select', 'a0', '--select', 'not a0'))
        wire = pieces('--stage', 'none')
        self.assertEqual({piece['state'] for piece in wire} - {'visible', 'projecting', 'duplicate'}, set())
        cut = pieces('--limits', '0,0,0,40,40,40')
        self.assertTrue(any(piece['state'] == 'clipped' for piece in cut))

    def test_polylines_are_hidden_by_their_own_faces_if_requested(self):
        # Of one object: a line inside the cube, and one on its upper face.
        lines = 'v 20 40 50\nv 80 40 50\nv 20 40 100\nv 80 40 100\nl 9 10\nl 11 12\n'
        self.write('pipe.obj', cube('pipe', 0, (0, 0, 0), 100) + lines)

        def drawn(*more):
            done = self.run_strake('draw', 'pipe.obj', '--unit', 'mm', '--up-axis', 'z', *more, '--json')
            self.assertEqual(done.returncode, 0, done.stderr)
            drawing = json.loads(done.stdout)
            states = {piece['a_mm'][2]: piece['state'] for piece in drawing['pieces'] if piece['kind'] == 'polyline'}
            return drawing, states

        plain, states = drawn()
        self.assertEqual(states, {50: 'visible', 100: 'visible'})
        self.assertEqual(drawn('--own-polylines', 'visible')[0], plain)
        self.assertNotIn('own_polylines', plain['settings'])
        for more in ((), ('--stage', 'local'), ('--global', 'push'), ('--solver', 'brute-force'), ('--bucketing', 'off')):
            drawing, states = drawn('--own-polylines', 'hidden', *more)
            self.assertEqual(states, {50: 'hidden_by_self', 100: 'visible'}, more)
            self.assertEqual(drawing['settings']['own_polylines'], 'hidden')
        self.assertEqual(drawn('--own-polylines', 'hidden', '--stage', 'none')[1], {50: 'visible', 100: 'visible'})
        done = self.run_strake('draw', 'pipe.obj', '--own-polylines', 'seen', '-o', 'x.svg')
        self.assertEqual(done.returncode, 2, done.stderr)

    def test_clipped_edges_that_are_not_listed_are_counted(self):
        self.write('m.obj', cube('in', 0, (0, 0, 0), 100) + cube('out', 1, (900, 0, 0), 100) + cube('half', 2, (200, 0, 0), 100))
        view = ('m.obj', '--view', 'iso', '--limits', '-50,-50,-50,250,150,150')
        self.text('draw', *view, '-o', 'all.json', '-o', 'all.svg')
        all_lines = json.loads((self.folder / 'all.json').read_text())
        self.assertNotIn('clipped_left_out', all_lines['counts'])
        for name in ('v.json', 'v.view'):
            self.text('draw', *view, '--visible-only', '-o', name, '-o', 'v.svg')
            # A document that lists fewer lines is read again, drawn to the same bytes, and equals the one with all of them.
            self.text('draw', name, '-o', 'again.svg')
            self.assertEqual((self.folder / 'again.svg').read_bytes(), (self.folder / 'v.svg').read_bytes())
            self.assertEqual(self.run_strake('draw', 'diff', 'all.json', name).returncode, 0)
            self.text('draw', name, '-o', 'again.json')
            counts = json.loads((self.folder / 'again.json').read_text())['counts']
            self.assertGreaterEqual(counts['clipped_left_out'], 12)
            self.assertEqual(counts['clipped'] + counts['clipped_left_out'], all_lines['counts']['clipped'])
            self.assertEqual(counts['visible'], all_lines['counts']['visible'])
            self.assertEqual(counts['objects_clipped'], 1)
        # Edges that are clipped in part are listed.
        self.assertGreater(counts['clipped'], 0)

    def test_visible_only_leaves_out_the_rest_and_nothing_else(self):
        self.two_files()
        found = []
        for more in ((), ('--visible-only',), ('--visible-only', '--culling', 'off', '--threads', 3)):
            done = self.run_strake('draw', 'a.obj', 'b.obj', '-o', 'x.svg', '-o', 'x.json', *more)
            self.assertEqual(done.returncode, 0, done.stderr)
            drawing = json.loads((self.folder / 'x.json').read_text())
            ink = (self.folder / 'x.svg').read_text().split('</metadata>')[1]
            visible = [[piece[key] for key in ('object', 'edge', 'kind', 'a_mm', 'b_mm', 'a_paper_mm')]
                       for piece in drawing['pieces'] if piece['state'] == 'visible']
            fates = {key: n for key, n in drawing['counts'].items() if key.startswith('objects')}
            found.append((visible, fates, ink))
            hidden = drawing['counts']['hidden_by_self'] + drawing['counts']['hidden_by_other']
            self.assertEqual(hidden > 0, not more)
            self.assertEqual(drawing['counts']['edges_left_out'] > 0, bool(more))
        self.assertEqual(found[0], found[1])
        self.assertEqual(found[0], found[2])
        # What no output shows is not computed, and the lines that are shown are the same.
        for more, kept in (((), False), (('--hidden', 'dashed'), True), (('-o', 'x.view'), True), (('--json',), True)):
            done = self.run_strake('draw', 'a.obj', 'b.obj', '-o', 'x.svg', *more)
            self.assertEqual(done.returncode, 0, done.stderr)
            metadata, ink = (self.folder / 'x.svg').read_text().split('</metadata>')
            counts = re.search('hidden-by-self="([0-9]+)" hidden-by-other="([0-9]+)"', metadata)
            self.assertEqual(counts.groups() != ('0', '0'), kept)
            if '--hidden' not in more:
                self.assertEqual(ink, found[0][2])
        done = self.run_strake('draw', 'a.obj', '--visible-only', '--hidden', 'dashed', '-o', 'y.svg')
        self.assertEqual(done.returncode, 2, done.stderr)
        self.assertIn('--visible-only', done.stderr)

    def test_binary_rows_state_what_json_states(self):
        self.two_files()
        expected = None
        for threads in (1, 3, 8):
            done = self.run_strake('draw', 'a.obj', 'b.obj', '-o', 'x.json', '-o', 'x.view', '--threads', threads)
            self.assertEqual(done.returncode, 0, done.stderr)
            content = (self.folder / 'x.view').read_bytes()
            expected = expected or content
            self.assertEqual(content, expected)
        text = json.loads((self.folder / 'x.json').read_text(encoding='utf-8'))
        # As docs/drawing.md says, and nothing more.
        magic, size = struct.unpack_from('<8sQ', content)
        self.assertEqual(magic, b'STRKVIEW')
        head = json.loads(content[16:16 + size])
        rows = head.pop('rows')
        letters = {'uint8': 'B', 'uint32': 'I', 'int32': 'i', 'int64': 'q'}
        pieces = []
        end = 16 + size + head['counts']['pieces'] * rows['bytes']
        self.assertEqual((rows['checksum'], len(content)), ('XXH3-128', end + 16))
        for at in range(16 + size, end, rows['bytes']):
            row = {field['name']: struct.unpack_from(f"<{field['count']}{letters[field['type']]}", content,
                                                     at + field['offset']) for field in rows['fields']}
            piece = {'object': head['objects'][row['object_index'][0]]['id'], 'object_index': row['object_index'][0],
                     'edge': row['edge'][0], 'kind': rows['kinds'][row['kind'][0]],
                     'state': rows['states'][row['state'][0]]}
            if piece['kind'] == 'intersection':
                piece['other_index'] = row['other_index'][0]
            if row['curve_index'][0] != 2**32 - 1:
                piece['curve_index'] = row['curve_index'][0]
            for name in ('a', 'b'):
                piece[f'{name}_mm'] = [(um + origin) / 1000 for um, origin in zip(row[f'{name}_um'], rows['origin_um'])]
                piece[f'{name}_paper_mm'] = [um / 1000 for um in row[f'{name}_paper_um']]
            pieces.append(piece)
        self.assertGreater(len(pieces), 20)
        self.assertEqual(pieces, text.pop('pieces'))
        self.assertEqual(head, text)
        done = self.run_strake('draw', 'diff', 'x.json', 'x.view', '--fail-on', 'any')
        self.assertEqual(done.returncode, 0, done.stderr + done.stdout)
        (self.folder / 'y.view').write_bytes(content[:-1])
        done = self.run_strake('draw', 'diff', 'x.json', 'y.view')
        self.assertEqual(done.returncode, 3, done.stderr)
        self.assertRegex(done.stderr, r'y\.view: .*ends in the checksum')
        (self.folder / 'y.view').write_bytes(content[:-17])
        done = self.run_strake('draw', 'diff', 'x.json', 'y.view')
        self.assertRegex(done.stderr, r'y\.view: .*ends in row')

    def test_what_is_clipped_far_out_is_within_what_files_can_state(self):
        self.write('one.obj', cube('a', 0, (0, 0, 0), 300) + cube('b', 1, (50, 50, 50), 300))
        for target, scale, code in (('1000000,0,0', '100:1', 0), ('100000000,0,0', '1:1', 0),
                                    ('1000000,0,0', '1000000:1', 2)):
            done = self.run_strake('draw', 'one.obj', '--unit', 'mm', '--up-axis', 'z', '--eye', '60,60,60', '--target',
                                   target, '--near', '0.001mm', '--scale', scale, '-o', 'p.view', '-o', 'p.json')
            self.assertEqual(done.returncode, code, (target, scale, done.stderr))
            if code == 0:
                done = self.run_strake('draw', 'diff', 'p.view', 'p.json', '--fail-on', 'any')
                self.assertEqual(done.returncode, 0, (target, scale, done.stderr))
            else:
                self.assertIn('--scale', done.stderr)

    def test_names_that_are_no_utf8_stay_apart(self):
        square = 'v 0 {0} 0\nv 1 {0} 0\nv 0 {0} 1\nf -3 -2 -1\n'
        text = 'o VENTIL-\xc4\n' + square.format(0) + 'o VENTIL-\xd6\n' + square.format(9)
        (self.folder / 'lat.obj').write_bytes(text.encode('latin-1'))
        done = self.run_strake('draw', 'lat.obj', '--unit', 'mm', '--up-axis', 'z', '-o', 'l.json', '-o', 'l.view')
        self.assertEqual(done.returncode, 0, done.stderr)
        drawing = json.loads((self.folder / 'l.json').read_text(encoding='utf-8'))
        self.assertEqual([o['name'] for o in drawing['objects']], ['VENTIL-\u00c4', 'VENTIL-\u00d6'])
        self.assertEqual(self.run_strake('draw', 'diff', 'l.json', 'l.view', '--fail-on', 'any').returncode, 0)

    def test_a_wire_seen_end_on_is_no_more_clipped_than_the_rest(self):
        self.write('w.obj', 'o wire\nv 10 10 0\nv 10 10 100\nl 1 2\n'
                   'o plate\nv 50 50 0\nv 90 50 0\nv 50 90 0\nf 3 4 5\n')
        for more in (('--limits', '-10,-10,-10,1000,1000,50'), ('--section', 'z=50mm'), ()):
            done = self.run_strake('draw', 'w.obj', '--unit', 'mm', '--up-axis', 'z', '--view', 'top', '-o', 'w.json',
                                   *more)
            self.assertEqual(done.returncode, 0, done.stderr)
            drawing = json.loads((self.folder / 'w.json').read_text(encoding='utf-8'))
            self.assertEqual([(d['name'], d['why']) for d in drawing['defects']], [('wire', ['only-points'])], more)

    def test_perspective(self):
        self.write('a.obj', cube('a', 0, (0, 0, 0), 1000))
        where = ('draw', 'a.obj', '--unit', 'mm', '--up-axis', 'z')

        def view(*more):
            done = self.run_strake(*where, *more, '--json')
            self.assertEqual(done.returncode, 0, done.stderr)
            return json.loads(done.stdout)

        # Square to a face: its sides are true in the plane of the target, shorter by half twice as far away.
        drawn_view = view('--eye', '500,-1000,500', '--target', '500,0,500', '--scale', '1:10')
        self.assertEqual(drawn_view['view']['projection'], 'perspective')
        self.assertEqual(drawn_view['view']['perspective']['eye_mm'], [500, -1000, 500])
        lengths = {'visible': set(), 'hidden_by_self': set()}
        for piece in drawn_view['pieces']:
            (ax, ay), (bx, by) = piece['a_paper_mm'], piece['b_paper_mm']
            if piece['a_mm'][1] == piece['b_mm'][1]:
                lengths[piece['state']].add(round(abs(ax - bx) + abs(ay - by), 3))
        self.assertEqual(lengths, {'visible': {100.0}, 'hidden_by_self': {50.0}})

        # The scale holds in the plane of the target, and nothing says otherwise.
        done = self.run_strake(*where, '--eye', '500,-1000,500', '--target', '500,0,500', '--scale', '1:10', '-o', 'x.svg')
        self.assertIn('lines at 1:10 in the plane of the target on 420 x 297 mm', done.stderr)
        self.assertIn('<title>perspective</title>', (self.folder / 'x.svg').read_text(encoding='utf-8'))

        # An oblique one, by both solvers, with and without culling.
        oblique = ('--eye', '-700.5,-1300,1900', '--target', '500,400,300', '--field-of-view', '70deg')
        whole = view(*oblique)
        self.assertEqual(whole, view(*oblique, '--solver', 'brute-force'))
        self.assertEqual(whole, view(*oblique, '--culling', 'off'))
        narrow = view(*oblique[:4], '--field-of-view', '10deg')
        self.assertTrue(any(piece['state'] == 'clipped' for piece in narrow['pieces']))

        for bad in (('--eye', '1,2,3'), ('--target', '1,2,3'), ('--eye', '1,2,3', '--target', '1,2,3'),
                    ('--eye', '1,2,nan', '--target', '1,2,3'), ('--eye', '1,2,3', '--target', '1,2,4'),
                    (*oblique, '--near', '1e9mm'), (*oblique[:4], '--field-of-view', '170deg'),
                    (*oblique, '--view', 'top'), ('--eye', '1e30,2,3', '--target', '1,2,3')):
            done = self.run_strake(*where, *bad, '-o', 'x.svg')
            self.assertEqual(done.returncode, 2, (bad, done.stderr))
        done = self.run_strake(*where, '--eye', '500,500,500', '--target', '500,900,500', '-o', 'x.svg')
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn('eye-in-solid', done.stderr)
        done = self.run_strake(*where, '--eye', '500,-500,500', '--target', '500,-900,500', '-o', 'x.svg')
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn('empty-sheet', done.stderr)

    def test_flush_seams_of_one_colour_are_left_out_if_requested(self):
        self.write('a.obj', cube('a', 0, (0, 0, 0), 100) + cube('b', 1, (100, 0, 0), 100)
                   + cube('c', 2, (200, 0, 0), 80))

        def drawn(*options):
            done = self.run_strake('draw', 'a.obj', *options, '--json')
            self.assertEqual(done.returncode, 0, done.stderr)
            drawing = json.loads(done.stdout)
            length = {100: 0, 200: 0}
            for piece in drawing['pieces']:
                (x, *a), (other, *b) = piece['a_mm'], piece['b_mm']
                if x == other and x in length:
                    length[x] += sum(abs(p - q) for p, q in zip(a, b))
            return drawing, length, done.stderr

        plain, length, _ = drawn()
        self.assertEqual(length, {100: 800, 200: 400 + 320})
        self.assertEqual(drawn('--flush-seams', 'on')[0], plain)
        self.assertNotIn('flush_seams', plain['settings'])
        self.assertNotIn('edges_with_seams', plain['counts'])
        for more in ((), ('--threads', 3), ('--solver', 'brute-force'), ('--global', 'push')):
            drawing, length, stated = drawn('--flush-seams', 'off', *more)
            # Of the smaller cube the bottom and the front are flush; what the larger one has beyond it stays.
            self.assertEqual(length, {100: 0, 200: 2 * 20 + 200 + 2 * 80}, more)
            self.assertEqual(drawing['settings']['flush_seams'], 'off')
            self.assertEqual(drawing['counts']['edges_with_seams'], 8 + 4)
            self.assertIn('flush seams of 12 edges are left out', stated)
            self.assertEqual(drawing['counts']['objects_drawn'], plain['counts']['objects_drawn'])
        # Another colour is another material.
        materials = 'newmtl red\nKd 1 0 0\nnewmtl blue\nKd 0 0 1\n'
        self.write('m.mtl', materials)
        self.write('a.obj', 'mtllib m.mtl\nusemtl red\n' + cube('a', 0, (0, 0, 0), 100)
                   + cube('b', 1, (100, 0, 0), 100).replace('f ', 'usemtl blue\nf ', 1))
        self.assertEqual(drawn('--flush-seams', 'off')[1][100], 800)

    def test_no_object_vanishes_silently(self):
        self.write('odd.obj', cube('good', 0, (0, 0, 0), 100) + cube('behind', 1, (20, 20, -500), 50)
                   + 'o wire\nv 10 10 200\nv 10 10 300\nl 17 18\no nowhere\nv nan 0 0\nf 19 1 2\n'
                   + 'o speck\nv 500 0 0\nv 500.0001 0 0\nv 500 0.0001 0\nf 20 21 22\n')
        done = self.run_strake('draw', 'odd.obj', '--unit', 'mm', '--up-axis', 'z', '--view', 'top', '--stats', '-o',
                               'x.json')
        self.assertEqual(done.returncode, 0, done.stderr)
        drawing = json.loads((self.folder / 'x.json').read_text(encoding='utf-8'))
        counts = drawing['counts']
        fates = ('drawn', 'coincident', 'hidden', 'clipped', 'degenerate', 'failed', 'left_out')
        self.assertEqual(sum(counts[f'objects_{fate}'] for fate in fates), counts['objects'])
        self.assertEqual([counts[f'objects_{fate}'] for fate in fates], [1, 0, 1, 0, 2, 1, 0])
        self.assertEqual({d['name']: (d['fate'], d['why']) for d in drawing['defects']},
                         {'wire': ('degenerate', ['only-points']), 'speck': ('degenerate', ['shape-vanished']),
                          'nowhere': ('failed', ['object-skipped'])})
        self.assertIn('5 objects: 1 drawn, 1 hidden, 2 degenerate, 1 failed\n', done.stderr)
        for name in ('speck', 'nowhere'):
            self.assertRegex(done.stderr, f'warning object-.*: odd.obj: {name}: ', name)
        self.assertNotIn('odd.obj: wire: ', done.stderr)  # seen end-on: nothing is wrong with it
        self.assertRegex(done.stderr, r'objects hidden +1\n')

    def test_the_account_reports_a_file_that_ends_early(self):
        rest = 'the rest of cut.rvm, which ends early'
        self.write_rvm('cut.rvm', [('/A', (0, 0, 0)), ('/B', (500, 0, 0))], whole=False)
        done = self.run_strake('draw', 'cut.rvm', '-o', 'x.json')
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn(f'2 objects: 2 drawn; not drawn: {rest}\n', done.stderr)
        cut = json.loads((self.folder / 'x.json').read_text(encoding='utf-8'))
        self.assertEqual(cut['files_ending_early'], ['cut.rvm'])
        quiet = self.run_strake('draw', 'cut.rvm', '--quiet', '-o', 'x.svg')
        self.assertEqual((quiet.returncode, quiet.stderr), (0, f'strake: nothing is known of {rest}\n'))
        self.assertEqual(self.run_strake('draw', 'cut.rvm', '--strict', '-o', 'x.svg').returncode, 4)
        # Whole again it is the same drawing, and both can be compared.
        self.write_rvm('cut.rvm', [('/A', (0, 0, 0)), ('/B', (500, 0, 0))])
        done = self.run_strake('draw', 'cut.rvm', '-o', 'y.json', '-o', 'y.view')
        self.assertNotIn('ends early', done.stderr)
        whole = json.loads((self.folder / 'y.json').read_text(encoding='utf-8'))
        self.assertNotIn('files_ending_early', whole)
        self.assertEqual(whole['hash'], cut['hash'])
        same = self.run_strake('draw', 'diff', 'x.json', 'y.view', '--fail-on', 'any')
        self.assertEqual(same.returncode, 0, same.stderr)

    def test_the_brute_force_states_what_it_costs(self):
        self.write('a.obj', cube('a', 0, (0, 0, 0), 100))
        run = ['draw', 'a.obj', '--solver', 'brute-force', '-o', 'x.svg']
        done = self.run_strake(*run, '--threads', 1)
        self.assertEqual(done.returncode, 0, done.stderr)
        reported = 'brute-force: 12 edges and 12 triangles, 144 tests: less than a second with 1 worker'
        self.assertIn(reported, done.stderr)
        self.assertLess(done.stderr.index(reported), done.stderr.index('visible of'))
        self.assertNotIn('brute-force', self.run_strake(*run[:2], *run[4:]).stderr)
        self.assertEqual(self.run_strake(*run, '--quiet').stderr, '')

    def test_coordinates_are_millimetres_or_have_units(self):
        self.write('a.obj', cube('a', 0, (0, 0, 0), 100))
        def drawn(*options):
            done = self.run_strake('draw', 'a.obj', *options, '-o', 'x.json')
            self.assertEqual(done.returncode, 0, done.stderr)
            return json.loads((self.folder / 'x.json').read_text(encoding='utf-8'))['pieces']
        for plain, units in ((['--limits', '-10,-10,-10,1000,1000,50'], ['--limits', '-1cm,-10mm,-10,1m,1m,0.05m']),
                             (['--section', 'z=50'], ['--section', 'z=5cm']),
                             (['--eye', '500,-1000,500', '--target', '0,0,0'], ['--eye', '0.5m,-1m,500', '--target', '0mm,0,0'])):
            self.assertEqual(drawn(*plain), drawn(*units), units)

    def test_the_outline_of_a_part_is_of_one_weight(self):
        # A pin on a box: its sides are contours, its rims sharp edges, the box has sharp edges only.
        self.write('m.obj', cube('box', 0, (0, 0, 0), 1000) + prism('pin', 8, 24, (500, 500), 200, 1000, 1600))
        done = self.run_strake('draw', 'm.obj', '--unit', 'mm', '--up-axis', 'z', '--hidden', 'dashed', '-o', 'x.svg')
        self.assertEqual(done.returncode, 0, done.stderr)
        text = (self.folder / 'x.svg').read_text(encoding='utf-8')
        widths = {selector.strip(): float(width) for rule, width in re.findall(r'^(.*) \{ stroke-width: ([\d.]+)', text, re.M)
                  for selector in rule.split(',')}
        layers = re.findall(r'class="((?:visible|hidden) \w+)"', text)
        self.assertTrue({'visible contour', 'visible sharp', 'hidden sharp'} <= set(layers), layers)
        drawn_view = {widths['.' + layer.replace(' ', '.') + ' path'] for layer in layers if layer.startswith('visible')}
        self.assertEqual(drawn_view, {0.5})
        self.assertEqual(widths['.hidden path'], 0.25)

    def test_hidden_lines_are_dashed_to_fit_and_may_be_two_layers(self):
        # From above: the box hides its own lower rim but for where that lies under the upper one, and all of the block.
        self.write('m.obj', cube('box', 0, (0, 0, 0), 1000) + prism('pin', 8, 24, (500, 500), 200, -800, -200)
                   + prism('cone', 56, 24, (500, 500), 120, -100, -50))
        run = ['draw', 'm.obj', '--unit', 'mm', '--up-axis', 'z', '--view', 'top', '--hidden', 'all', '-o', 'x.svg']
        self.assertEqual(self.run_strake(*run).returncode, 0)
        one = (self.folder / 'x.svg').read_text(encoding='utf-8')
        self.assertNotIn('-by-other"', one.replace('hidden-by-other="', ''))
        dashes = [[float(length) for length in found.split()]
                  for found in re.findall(r'style="stroke-dasharray:([\d. ]+)"', one)]
        self.assertTrue(dashes)
        for ink, gap in dashes:
            self.assertAlmostEqual(ink / gap, 4, delta=0.02)
        expected = None
        for threads in (1, 2, 8):
            done = self.run_strake(*run, '--hidden-layers', 'two', '--threads', threads)
            self.assertEqual(done.returncode, 0, done.stderr)
            two = (self.folder / 'x.svg').read_text(encoding='utf-8')
            expected = expected or two
            self.assertEqual(two, expected)
        self.assertIn('id="hidden-sharp-by-other" class="by-other"', two)
        self.assertIn('id="hidden-sharp" class="hidden sharp"', two)
        self.assertEqual(self.run_strake(*run, '--hidden-layers', 'three').returncode, 2)

    def test_centre_lines_are_of_exact_primitives(self):
        self.write('m.obj', prism('pin', 0, 48, (0, 0), 200, 0, 600))
        run = ['draw', 'm.obj', '--unit', 'mm', '--up-axis', 'z', '--view', 'top']
        done = self.run_strake(*run, '--centre-lines', 'on', '-o', 'x.svg', '-o', 'x.json')
        self.assertEqual(done.returncode, 0, done.stderr)
        # A mesh has no axis, however round it looks.
        self.assertNotIn('centre-lines', (self.folder / 'x.svg').read_text(encoding='utf-8'))
        for wrong in ('yes', '0mm', '7'):
            done = self.run_strake(*run, '--centre-lines', wrong, '-o', 'y.svg')
            self.assertEqual(done.returncode, 2, done.stderr)
            self.assertIn('--centre-lines', done.stderr)
        done = self.run_strake('draw', 'x.json', '--centre-lines', 'on', '-o', 'y.svg')
        self.assertEqual(done.returncode, 2, done.stderr)
        self.assertIn('--centre-lines', done.stderr)

    def test_an_empty_sheet_is_not_silent(self):
        self.two_files()
        done = self.run_strake('draw', 'a.obj', '-o', 'x.svg', '--limits', '1e6,1e6,1e6,2e6,2e6,2e6')
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn('nothing is left to draw inside the limits', done.stderr)

    def test_one_far_object_is_reported_and_left_out_on_request(self):
        self.write('far.obj', ''.join(cube(f'a{i}', i, (150 * i, 0, 0), 100) for i in range(5))
                   + cube('lost', 5, (0, 100000, 0), 100))

        def drawn(*more):
            done = self.run_strake('draw', 'far.obj', '--unit', 'mm', '--up-axis', 'z', '--view', 'top', *more, '-o', 'x.json',
                                   '-o', 'x.svg')
            self.assertEqual(done.returncode, 0, done.stderr)
            return done.stderr, json.loads((self.folder / 'x.json').read_text(encoding='utf-8'))

        reported, drawing = drawn()
        self.assertIn("warning far-object: 'lost' (far.obj) lies 99.9 m from the rest: the view is about 1:500 on 420 x 297 mm "
                      "for it, without it 1:2 on 420 x 297 mm (--limits auto leaves it out)", reported)
        self.assertEqual((drawing['sheet']['scale_text'], drawing['counts']['objects']), ('1:500', 6))
        self.assertNotIn('far_objects', drawing)
        (self.folder / 'x.json').rename(self.folder / 'whole.json')
        reported, drawing = drawn('--limits', 'auto')
        self.assertIn("note far-object-left-out: 'lost' (far.obj) lies 99.9 m from the rest and is left out", reported)
        self.assertNotIn('warning', reported)
        self.assertEqual((drawing['sheet']['scale_text'], drawing['counts']['objects']), ('1:2', 5))
        self.assertEqual([(far['name'], far['file']) for far in drawing['far_objects']], [('lost', 'far.obj')])
        self.assertRegex((self.folder / 'x.svg').read_text(encoding='utf-8'), '<far-object id="[^"]*" name="lost" file="far.obj"/>')
        done = self.run_strake('draw', 'diff', 'whole.json', 'x.json', '--fail-on', 'visible')
        self.assertEqual(done.returncode, 1, done.stderr)
        self.assertTrue(done.stdout.startswith('far_objects: was 0, is 1 (lost)\n'), done.stdout)
        diff = json.loads(self.run_strake('draw', 'diff', 'x.json', 'whole.json', '--json').stdout)
        self.assertEqual(diff['settings'][0], {'setting': 'far_objects', 'before': '1 (lost)', 'after': '0'})
        self.assertGreater(diff['left_out']['new']['lines'], 0)
        self.assertEqual(diff['left_out'], {'new': diff['counts']['new'], 'gone': {'lines': 0, 'length_mm': 0}})
        self.assertEqual((diff['counts']['gone']['lines'], diff['counts']['changed']['lines']), (0, 0))
        self.assertNotIn('far-object', drawn('--limits', '-1,-1,-1,800,200,200')[0])
        self.assertNotIn('far-object', drawn('--select', 'not lost', '--limits', 'auto')[0])

    def test_the_paper_that_is_requested(self):
        self.write('bar.obj', cube('bar', 0, (0, 0, 0), 800))
        where = ('draw', 'bar.obj', '--unit', 'mm', '--up-axis', 'z', '--view', 'top')

        def sheet(*more):
            done = self.run_strake(*where, *more, '--json')
            self.assertEqual(done.returncode, 0, done.stderr)
            paper = json.loads(done.stdout)['sheet']
            return paper['width_mm'], paper['height_mm'], paper['scale_text']

        self.assertEqual(sheet(), (420, 297, '1:5'))
        self.assertEqual(sheet('--paper', 'A3'), sheet())
        self.assertEqual(sheet('--paper', 'A4'), (297, 210, '1:5'))
        self.assertEqual(sheet('--paper', 'A1'), (841, 594, '1:2'))
        self.assertEqual(sheet('--paper', 'A0,portrait'), (841, 1189, '1:1'))
        self.assertEqual(sheet('--paper', '1mx840mm', '--scale', '1:1'), (1000, 840, '1:1'))
        done = self.run_strake(*where, '--paper', 'A1', '--scale', '1:1', '-o', 'x.svg')
        self.assertEqual(done.returncode, 2, done.stderr)
        self.assertIn('--paper: at 1:1 the view is 800 x 800 mm, and of the paper of 841 x 594 mm 821 x 566 mm are for it', done.stderr)
        self.assertIn('no larger scale than 1:2', done.stderr)
        self.assertFalse((self.folder / 'x.svg').exists())
        for wrong, words in (('A7', "no paper is called 'A7'"), ('A3,up', "'up' of 'A3,up'"), ('9x9', 'not between 100mm and 20m')):
            done = self.run_strake(*where, '--paper', wrong, '-o', 'x.svg')
            self.assertEqual(done.returncode, 2, wrong)
            self.assertIn(words, done.stderr)


if __name__ == '__main__':
    main()
