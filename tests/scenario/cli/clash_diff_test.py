#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""clash_diff_test.py STRAKE: two results of clash compared."""
import base64
import json
import struct

from scenario import Scenario, cube, main


class ClashDiff(Scenario):
    def generate(self, name, *more):
        done = self.run_strake('generate', 'ship', '--objects', 300, '--seed', 7, '-o', name, *more)
        self.assertEqual(done.returncode, 0, done.stderr)

    def diff(self, *arguments, exit_code=0):
        done = self.run_strake('clash', 'diff', 'old.json', 'new.json', '--json', *arguments)
        self.assertEqual(done.returncode, exit_code, done.stderr)
        return json.loads(done.stdout)

    def test_a_run_is_compared_with_an_older_one(self):
        """A ship, and the same with one object removed, one moved away and one renamed."""
        self.generate('ship.obj')
        run = ['clash', 'ship.obj', '-o']
        self.assertEqual(self.run_strake(*run, 'old.json').returncode, 0)
        self.assertEqual(self.run_strake(*run, 'new.json').returncode, 0)
        same = self.diff('--fail-on', 'worse')
        results = json.loads((self.folder / 'old.json').read_text())['results']
        self.assertEqual(same['counts'], {'new': 0, 'changed': 0, 'same': len(results), 'gone': 0, 'cannot_tell': 0})
        hits = [r for r in results if r['class'] == 'HIT']
        removed, moved = hits[0]['a']['id'], hits[-1]['b']['id']
        touched = {id for r in results for id in (r['a']['id'], r['b']['id'])}
        renamed = next(id for id in sorted(touched, reverse=True)
                       if not any({id, other} <= {r['a']['id'], r['b']['id']} for r in results
                                  for other in (removed, moved)))
        self.rewrite_obj('ship.obj', removed, moved, renamed)
        self.assertEqual(self.run_strake(*run, 'new.json').returncode, 0)
        reported = self.diff('-o', 'changes.json', '--fail-on', 'cannot-tell', exit_code=1)
        self.assertEqual(reported, json.loads((self.folder / 'changes.json').read_text()))
        self.assertEqual(reported['counts']['changed'], 0)

        def of(entries):
            return {frozenset((e['a']['id'], e['b']['id'])) for e in entries}

        def having(id):
            return {frozenset((r['a']['id'], r['b']['id'])) for r in results if id in (r['a']['id'], r['b']['id'])}
        missing = having(removed) | having(renamed)
        self.assertEqual(of(reported['cannot_tell']), missing)
        self.assertEqual(of(reported['gone']), having(moved) - missing)
        self.assertTrue(all('is not in the model' in e['why'] for e in reported['cannot_tell']))
        self.assertEqual(of(reported['added']),
                         {frozenset(i.replace(renamed, 'renamed') for i in pair)
                          for pair in having(renamed) - having(removed) - having(moved)})
        self.assertTrue(all("'renamed' of ship.obj is not in the model" == e['why'] for e in reported['added']))
        done = self.run_strake('clash', 'diff', 'old.json', 'new.json')
        self.assertIn(f"{len(reported['gone'])} gone, {len(missing)} cannot tell", done.stdout)

    def rewrite_obj(self, name, removed, moved, renamed):
        """Vertices are numbered through the file, so a removed object keeps them."""
        lines, keep, far = [], True, False
        for line in (self.folder / name).read_text().splitlines():
            word, _, rest = line.partition(' ')
            if word in ('o', 'g'):
                keep, far = rest != removed, rest == moved
                if rest == renamed:
                    line = f'{word} renamed'
            elif word == 'v' and far:
                x, y, z = rest.split()[:3]
                line = f'v {float(x) + 1e4} {y} {z}'
            if keep or word == 'v':
                lines.append(line)
        self.write(name, '\n'.join(lines) + '\n')

    def write_box(self, name, boxes):
        """OBJ boxes of (object, low corner, high corner)."""
        lines = []
        for n, (object, low, high) in enumerate(boxes):
            lines.append(f'o {object}')
            lines += [f'v {x} {y} {z}' for z in (low[2], high[2]) for y in (low[1], high[1]) for x in (low[0], high[0])]
            faces = ('1 3 4 2', '5 6 8 7', '1 2 6 5', '3 7 8 4', '1 5 7 3', '2 4 8 6')
            lines += ['f ' + ' '.join(str(int(v) + 8 * n) for v in face.split()) for face in faces]
        path = self.folder / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text('\n'.join(lines) + '\n')

    def test_files_of_one_name_are_distinguished_by_their_folders(self):
        """Neither the size of a file nor the order on the command line says which is which."""
        self.write_box('hull/model.obj', [('P', (0, 0, 0), (100, 100, 100))])
        self.write_box('outfit/model.obj', [('Q', (50, 0, 0), (150, 100, 100))])
        files = ['hull/model.obj', 'outfit/model.obj']
        self.assertEqual(self.run_strake('clash', *files, '-o', 'old.json').returncode, 0)
        old = json.loads((self.folder / 'old.json').read_text())
        self.assertEqual([f['label'] for f in old['files']], files)
        for longer in files:
            with open(self.folder / longer, 'a') as file:
                file.write('# ' + 'x' * 900 + '\n')
            for order in (files, files[::-1]):
                self.assertEqual(self.run_strake('clash', *order, '-o', 'new.json').returncode, 0)
                self.assertEqual(self.diff()['counts'],
                                 {'new': 0, 'changed': 0, 'same': 1, 'gone': 0, 'cannot_tell': 0})
                self.assertEqual(json.loads((self.folder / 'new.json').read_text())['hash'], old['hash'])

    def test_what_was_not_compared_is_listed_and_not_gone(self):
        """Objects too wide for the grid, pairs too far for one frame, and objects that cannot be read."""
        beam = ('B', (90, 20, 20), (200, 50, 50))
        self.write_box('m.obj', [('A', (0, 0, 0), (100, 100, 100)), beam])
        self.assertEqual(self.run_strake('clash', 'm.obj', '--unit', 'mm', '-o', 'old.json').returncode, 0)
        self.assertEqual(json.loads((self.folder / 'old.json').read_text())['not_compared'], [])
        named = {name: {'id': name, 'name': name, 'file': 'm.obj'} for name in 'AB'}
        wide = ('A', (-2.2e6, 0, 0), (100, 100, 100))
        long = ('A', (-1.5e6, 0, 0), (100, 100, 100)), ('B', (90, 20, 20), (1.5e6, 50, 50))
        for boxes, listed in (([wide, beam], {'test': 0, 'code': 'shape-unplaceable', 'a': named['A']}),
                              (long, {'test': 0, 'code': 'pair-too-large', 'a': named['A'], 'b': named['B']})):
            with self.subTest(listed['code']):
                self.write_box('m.obj', boxes)
                run = self.run_strake('clash', 'm.obj', '--unit', 'mm', '--quiet', '-o', 'new.json')
                self.assertEqual((run.returncode, run.stderr), (0, ''))
                new = json.loads((self.folder / 'new.json').read_text())
                self.assertEqual(new['not_compared'], [listed])
                self.assertIn({'code': listed['code'], 'severity': 'skipped', 'count': 1}, new['diagnostics'])
                reported = self.diff('--fail-on', 'cannot-tell', exit_code=1)
                self.assertEqual(reported['counts'], {'new': 0, 'changed': 0, 'same': 0, 'gone': 0, 'cannot_tell': 1})
                self.assertIn(listed['code'], reported['cannot_tell'][0]['why'])
        self.write_box('m.obj', [('A', (0, 0, 0), (100, 100, 100)), beam])
        with open(self.folder / 'm.obj', 'a') as file:
            file.write('o C\nf 1 2 999\n')
        self.assertEqual(self.run_strake('clash', 'm.obj', '--quiet', '-o', 'new.json').returncode, 0)
        new = json.loads((self.folder / 'new.json').read_text())
        self.assertIn(('obj-damaged-object', 'skipped'), [(m['code'], m['severity']) for m in new['messages']])
        self.assertEqual(new['not_compared'], [{'test': 0, 'code': 'object-skipped',
                                                'a': {'id': 'C', 'name': 'C', 'file': 'm.obj'}}])

    def test_what_lay_in_a_solid_that_has_come_open_is_not_gone(self):
        """A surface has no inside: that nothing is found within it says nothing."""
        self.write_box('m.obj', [('A', (0, 0, 0), (100, 100, 100)), ('B', (20, 20, 20), (80, 80, 80))])
        whole = (self.folder / 'm.obj').read_text()
        lacking = whole.replace('f 5 6 8 7\n', 'f 5 6 8\n', 1)
        self.assertNotEqual(whole, lacking)

        def run(text, name):
            self.write('m.obj', text)
            self.assertEqual(self.run_strake('clash', 'm.obj', '--unit', 'mm', '-o', name).returncode, 0)

        run(whole, 'old.json')
        run(lacking, 'new.json')
        reported = self.diff('--fail-on', 'cannot-tell', exit_code=1)
        self.assertEqual([e['why'] for e in reported['cannot_tell']],
                         ["'A' of m.obj has surfaces that enclose nothing beyond those of the other run"])
        self.assertEqual(reported['gone'], [])
        # The other way round it is new, but perhaps not by what was moved.
        run(lacking, 'old.json')
        run(whole, 'new.json')
        self.assertEqual([e['why'] for e in self.diff()['added']],
                         ["'A' of m.obj has surfaces that enclose nothing beyond those of the other run"])
        # As open as before, without a side: what is moved out of it is gone.
        lidless = whole.replace('f 5 6 8 7\n', '', 1)
        run(lidless.replace('v 20 ', 'v -10 '), 'old.json')
        self.assertEqual(len(json.loads((self.folder / 'old.json').read_text())['results']), 1)
        run(lidless, 'new.json')
        self.assertEqual(self.diff()['counts']['gone'], 1)

    def write_unnamed(self, places):
        """u.gltf: cubes of 100 mm with their lower corners at `places` (x in metres), which nobody named."""
        corners = b''.join(struct.pack('<3f', x, y, z) for z in (0, .1) for y in (0, .1) for x in (0, .1))
        faces = ((0, 2, 3, 1), (4, 5, 7, 6), (0, 1, 5, 4), (2, 6, 7, 3), (0, 4, 6, 2), (1, 3, 7, 5))
        indices = [i for a, b, c, d in faces for i in (a, b, c, a, c, d)]
        data = corners + struct.pack('<36H', *indices)
        uri = 'data:application/octet-stream;base64,' + base64.b64encode(data).decode()
        self.write('u.gltf', json.dumps({
            'asset': {'version': '2.0'}, 'scenes': [{'nodes': list(range(len(places)))}],
            'nodes': [{'mesh': 0, 'translation': [x, 0, 0]} for x in places],
            'meshes': [{'primitives': [{'attributes': {'POSITION': 0}, 'indices': 1}]}],
            'buffers': [{'byteLength': len(data), 'uri': uri}],
            'bufferViews': [{'buffer': 0, 'byteLength': 96}, {'buffer': 0, 'byteOffset': 96, 'byteLength': 72}],
            'accessors': [{'bufferView': 0, 'componentType': 5126, 'count': 8, 'type': 'VEC3'},
                          {'bufferView': 1, 'componentType': 5123, 'count': 36, 'type': 'SCALAR'}]}))

    def test_ids_that_are_positions_are_not_trusted(self):
        """Numbers of nodes that shift, and that a new clash takes over from a mended one."""
        def run(places, name):
            self.write_unnamed(places)
            done = self.run_strake('clash', 'u.gltf', '-o', name)
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertEqual(done.stderr.count('object-id-positional'), 1, done.stderr)
            self.assertIn(f'u.gltf: {len(places)} objects have no stable id', done.stderr)
            return json.loads((self.folder / name).read_text())

        old = run([0, .09], 'old.json')
        self.assertTrue(all(old['results'][0][side]['positional_id'] for side in 'ab'))
        same = {'new': 0, 'changed': 0, 'same': 1, 'gone': 0, 'cannot_tell': 0}
        for places in ([0, .09], [.09, 0], [-7, 0, .09], [.09, -7, -8, 0]):
            run(places, 'new.json')
            self.assertEqual(self.diff('--fail-on', 'cannot-tell')['counts'], same, places)
        new = run([-5, -4.91, 1, 1.2], 'new.json')
        self.assertEqual(new['results'][0]['key'], old['results'][0]['key'], 'two clashes of one key')
        reported = self.diff('--fail-on', 'cannot-tell', exit_code=1)
        self.assertEqual(reported['counts'], {'new': 0, 'changed': 0, 'same': 0, 'gone': 0, 'cannot_tell': 2})
        self.assertEqual([e['run'] for e in reported['cannot_tell']], ['old', 'new'])
        for level in ('new-hit', 'new', 'worse'):
            done = self.run_strake('clash', 'diff', 'old.json', 'new.json', '--fail-on', level)
            self.assertEqual(done.returncode, 1, level)
            self.assertIn("among 'cannot tell' that may be new, and count as such: 1\n", done.stderr)

    def test_repeated_names_are_not_trusted(self):
        def run(boxes, name):
            self.write_box('m.obj', boxes)
            done = self.run_strake('clash', 'm.obj', '--unit', 'mm', '-o', name)
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertEqual(('object-id-repeated' in done.stderr, 'object-id-positional' in done.stderr), (True, False))

        def at(x):
            return 'dup', (x, 0, 0), (x + 100, 100, 100)

        wall = 'wall', (90, 0, 0), (200, 100, 100)
        run([at(0), at(5000), wall], 'old.json')
        run([wall, at(5000), at(0)], 'new.json')
        self.assertEqual(self.diff()['counts'], {'new': 0, 'changed': 0, 'same': 1, 'gone': 0, 'cannot_tell': 0})
        run([at(150), at(5000), wall], 'new.json')
        self.assertEqual(self.diff()['counts'], {'new': 0, 'changed': 0, 'same': 0, 'gone': 0, 'cannot_tell': 2})

    def test_a_result_that_was_edited_is_refused(self):
        """Shortened lists with the counts kept, and whatever else no run writes: neither side may be it."""
        self.write('m.obj', ''.join(cube(f'c{n}', n, (90 * n, 0, 0), 100) for n in range(4)))
        self.write('r.toml', '[[exempt]]\nname = "x"\na = "c0"\nb = "c1"\n'
                   '[[allowed]]\nname = "y"\na = "c1"\nb = "c2"\nmax_depth = "any"\n')
        run = self.run_strake('clash', 'm.obj', '--unit', 'mm', '--rules', 'r.toml', '--list-exempted', '-o', 'good.json')
        self.assertEqual(run.returncode, 0, run.stderr)
        good = json.loads((self.folder / 'good.json').read_text())
        self.write('other.json', json.dumps(good, indent=3))
        self.assertEqual(self.run_strake('clash', 'diff', 'good.json', 'other.json').returncode, 0, 'other blanks')
        first, test = good['results'][0], good['tests'][0]
        for what, edit in (
                ('tests[0] counts 1 ALLOWED, but "results" has 0', {'results': good['results'][1:]}),
                ('tests[0] counts 1 HIT, but "results" has 0', {'results': good['results'][:-1]}),
                ('tests[0] counts 1 HIT, but "results" has 0', {'results': []}),
                ('tests[0] counts 1 exempted pairs, but "exempted" lists 0', {'exempted': []}),
                ('tests[0] counts 2 HIT, but "results" has 1', {'tests': [test | {'counts': test['counts'] | {'HIT': 2}}]}),
                ('tests[0] "HIT" is no count', {'tests': [test | {'counts': test['counts'] | {'HIT': -1}}]}),
                ('has not the "hash" of its tests', {'tests': [test | {'hash': '0' * 32}]}),
                ('has not the "hash" of its tests', {'hash': '0' * 32}),
                ('two tests of the name', {'tests': [test, test], 'exempted': good['exempted'] + [good['exempted'][0] | {'test': 1}]}),
                ('has not the key of its test', {'tests': [test | {'name': 'another'}]}),
                (f"result {first['key']} has not the key",
                 {'results': [first | {'a': good['results'][1]['b']}, *good['results'][1:]]}),
                (f"result {first['key']} is of 'c9', which is not among",
                 {'results': [first | {'a': first['a'] | {'id': 'c9'}}, *good['results'][1:]]}),
                ('stands there twice', {'results': [first, *good['results']]}),
                ('"within_files" is no truth', {'tests': [test | {'tested': test['tested'] | {'within_files': 'yes'}}]})):
            with self.subTest(what):
                self.write('edited.json', json.dumps(good | edit))
                for files in (['edited.json', 'good.json'], ['good.json', 'edited.json']):
                    done = self.run_strake('clash', 'diff', *files, '-o', 'changes.json')
                    self.assertEqual(done.returncode, 3, done.stdout)
                    self.assertIn('edited.json: ', done.stderr)
                    self.assertIn(what, done.stderr)
                    self.assertEqual(done.stdout, '')
        self.write('edited.json', (self.folder / 'good.json').read_text().rstrip()[:-1] + ', "results": []}')
        done = self.run_strake('clash', 'diff', 'good.json', 'edited.json')
        self.assertEqual(done.returncode, 3)
        self.assertIn('has "results" twice (it was cut short or edited: run the test again', done.stderr)
        self.assertNotIn('changes.json', self.files())

    def test_what_cannot_be_compared_is_named(self):
        self.two_files()
        self.run_strake('clash', 'a.obj', '-o', 'good.json')
        good = (self.folder / 'good.json').read_text()
        self.write('cut.json', good[:-40])
        self.write('first.json', good.replace('"schema_version": 2', '"schema_version": 1'))
        for file, word in (('cut.json', 'ends too soon'), ('first.json', 'version 1'), ('a.obj', 'no JSON'),
                           ('nowhere.json', 'there is no such file'), ('.', 'folder')):
            with self.subTest(file):
                done = self.run_strake('clash', 'diff', 'good.json', file)
                self.assertEqual(done.returncode, 3, done.stderr)
                self.assertIn(word, done.stderr)
                self.assertIn(file, done.stderr)
        self.assertEqual(self.run_strake('clash', 'diff', 'good.json').returncode, 2)
        done = self.run_strake('clash', 'diff', 'good.json', 'good.json', '-o', 'good.json')
        self.assertEqual(done.returncode, 2)
        self.assertIn("'good.json' is one of the inputs and would be overwritten", done.stderr)
        self.assertEqual((self.folder / 'good.json').read_text(), good)


if __name__ == '__main__':
    main()
