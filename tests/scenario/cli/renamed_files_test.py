#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""renamed_files_test.py STRAKE: runs compared whose files have other names, are reordered, split or merged."""
import json
import re

from glb_file import Glb
from scenario import Scenario, cube, main


def counts(new=0, changed=0, same=0, gone=0, cannot_tell=0):
    return {'new': new, 'changed': changed, 'same': same, 'gone': gone, 'cannot_tell': cannot_tell}


def ids_of(entry):
    return {entry['a']['id'], entry['b']['id']}


class RenamedFiles(Scenario):
    def setUp(self):
        super().setUp()
        done = self.run_strake('generate', 'ship', '--objects', 300, '--seed', 7, '-o', 'ship.glb')
        self.assertEqual(done.returncode, 0, done.stderr)

    def glb(self):
        return Glb(self.folder / 'ship.glb')

    def clash(self, files, name, *more):
        done = self.run_strake('clash', *files, '--self', '-o', name, *more)
        self.assertEqual(done.returncode, 0, done.stderr)
        return json.loads((self.folder / name).read_text(encoding='utf-8'))['results']

    def draw(self, files, name):
        done = self.run_strake('draw', *files, '--view', 'iso', '-o', name)
        self.assertEqual(done.returncode, 0, done.stderr)

    def diff(self, verb, old='old.json', new='new.json', *more):
        done = self.run_strake(verb, 'diff', old, new, '--json', *more)
        self.assertEqual(done.returncode, 0, done.stderr)
        return json.loads(done.stdout)

    def reported(self, verb, old='old.json', new='new.json', *more):
        return self.text(verb, 'diff', old, new, *more)

    def test_a_run_and_its_repetition_under_another_name(self):
        old = self.clash(['ship.glb'], 'old.json')
        self.glb().reverse().write(self.folder / 'tues.glb')
        self.clash(['tues.glb'], 'new.json')
        diff = self.diff('clash', 'old.json', 'new.json', '--fail-on', 'cannot-tell')
        self.assertEqual(diff['counts'], counts(same=len(old)))
        named = {id for r in old for id in ids_of(r)}
        self.assertEqual(diff['files_matched'], [{'old': 'ship.glb', 'new': 'tues.glb', 'relation': 'renamed', 'by': 'ids',
                                                  'common': len(named), 'of': len(named)}])
        self.assertNotIn('files_ambiguous', diff)
        keys = {(e['was']['key'], frozenset(ids_of(e))) for e in diff['same']}
        self.assertEqual(keys, {(r['key'], frozenset(ids_of(r))) for r in old}, 'the old key is told')
        text = self.reported('clash')
        self.assertEqual(text.count('ship.glb'), 1, text)
        self.assertIn(f'files are taken as renamed: ship.glb -> tues.glb ({len(named)} of {len(named)} ids in common)\n',
                      text)
        same = self.diff('clash', 'old.json', 'old.json')
        self.assertFalse({'files_matched', 'files_ambiguous'} & set(same), 'nothing was renamed')

    def test_one_per_cent_changed(self):
        """The comparison is the one of files that kept their name, and tells what changed and nothing else."""
        old = self.clash(['ship.glb'], 'old.json')
        hits = [r for r in old if r['class'] == 'HIT']
        objects = sorted(self.glb().objects())
        changed = {hits[0]['a']['id'], *objects[::100]}
        self.assertLessEqual(len(changed), 4)
        self.glb().reverse().move(changed, 100).write(self.folder / 'ship_revB.glb')
        self.glb().reverse().move(changed, 100).write(self.folder / 'later' / 'ship.glb')
        self.clash(['ship_revB.glb'], 'new.json')
        self.clash(['later/ship.glb'], 'same_name.json')
        diff = self.diff('clash')
        expected = self.diff('clash', 'old.json', 'same_name.json')
        self.assertEqual(diff['counts'], expected['counts'])
        self.assertEqual({frozenset(ids_of(e)) for e in diff['gone']},
                         {frozenset(ids_of(r)) for r in old if ids_of(r) & changed})
        self.assertEqual(diff['counts'], counts(gone=len(diff['gone']), same=len(old) - len(diff['gone'])))
        self.assertEqual(len(diff['files_matched']), 1)

    def test_one_per_cent_removed_renamed_or_added(self):
        """Exactly their clashes are told, under another name of the file and in another order."""
        old = self.clash(['ship.glb'], 'old.json')
        some = set(sorted({id for r in old for id in ids_of(r)})[::100])
        theirs = [frozenset(ids_of(r)) for r in old if ids_of(r) & some]
        self.assertGreater(len(theirs), 0)
        rest = len(old) - len(theirs)
        self.glb().keep(set(self.glb().objects()) - some).reverse().write(self.folder / 'removed.glb')
        self.glb().rename(some).reverse().write(self.folder / 'renamed.glb')
        self.glb().double(some, .02).reverse().write(self.folder / 'added.glb')
        self.clash(['removed.glb'], 'removed.json')
        diff = self.diff('clash', 'old.json', 'removed.json')
        self.assertEqual(diff['counts'], counts(same=rest, cannot_tell=len(theirs)))
        self.assertCountEqual([frozenset(ids_of(e)) for e in diff['cannot_tell']], theirs)
        self.clash(['renamed.glb'], 'renamed.json')
        diff = self.diff('clash', 'old.json', 'renamed.json')
        self.assertEqual(diff['counts'], counts(new=len(theirs), same=rest, cannot_tell=len(theirs)))
        self.assertCountEqual([frozenset(id.removesuffix('-R') for id in ids_of(e)) for e in diff['added']], theirs)
        added = [frozenset(ids_of(r)) for r in self.clash(['added.glb'], 'added.json')
                 if any(id.endswith('-2') for id in ids_of(r))]
        self.assertGreater(len(added), 0)
        diff = self.diff('clash', 'old.json', 'added.json')
        self.assertEqual(diff['counts'], counts(new=len(added), same=len(old)))
        self.assertCountEqual([frozenset(ids_of(e)) for e in diff['added']], added)

    def test_another_format(self):
        """What was exported as GLB is exported as OBJ: ids and geometry stay, numbers are rounded otherwise."""
        for kind in ('usual', 'slender', 'dense', 'repeated', 'unlike'):
            with self.subTest(kind):
                for file in ('m.glb', 'm.obj'):
                    self.text('generate', 'ship', '--objects', 300, '--seed', 7, '--kind', kind, '-o', file)
                old = self.clash(['m.glb'], 'old.json')
                self.clash(['m.obj'], 'new.json')
                self.assertEqual(self.diff('clash')['counts'], counts(same=len(old)))

    def test_drawings_of_renamed_files(self):
        self.draw(['ship.glb'], 'old.json')
        objects = self.glb().objects()
        moved = sorted(objects)[::100]
        self.glb().reverse().write(self.folder / 'tues.glb')
        self.draw(['tues.glb'], 'new.json')
        diff = self.diff('draw', 'old.json', 'new.json', '--fail-on', 'any')
        self.assertEqual(diff['lines'], [])
        self.assertEqual([(m['old'], m['new'], m['relation']) for m in diff['files_matched']],
                         [('ship.glb', 'tues.glb', 'renamed')])
        self.assertIn('files are taken as renamed: ship.glb -> tues.glb (', self.reported('draw'))
        for path in ('wed.glb', 'later/ship.glb'):
            self.glb().reverse().move(moved, 1).write(self.folder / path)
        self.draw(['wed.glb'], 'new.json')
        self.draw(['later/ship.glb'], 'same_name.json')
        diff = self.diff('draw')
        expected = self.diff('draw', 'old.json', 'same_name.json')
        self.assertGreater(diff['counts']['new']['lines'], 0)
        self.assertEqual(diff['counts'], expected['counts'])
        lines = json.dumps(expected['lines']).replace('ship.glb', 'wed.glb')
        self.assertEqual(json.dumps(diff['lines']).replace('ship.glb', 'wed.glb'), lines)

    def parts(self, share=2):
        """The ids of the ship in so many parts."""
        ids = sorted(self.glb().objects())
        return [set(ids[i::share]) for i in range(share)]

    def test_several_files_at_once(self):
        for i, ids in enumerate(self.parts(3)):
            self.glb().keep(ids).write(self.folder / f'part{i}.glb')
            self.glb().keep(ids).reverse().write(self.folder / f'rev{2 - i}.glb')
        old = self.clash([f'part{i}.glb' for i in range(3)], 'old.json')
        self.clash([f'rev{i}.glb' for i in range(3)], 'new.json')
        diff = self.diff('clash')
        self.assertEqual(diff['counts'], counts(same=len(old)))
        self.assertEqual({(m['old'], m['new']) for m in diff['files_matched']},
                         {(f'part{i}.glb', f'rev{2 - i}.glb') for i in range(3)})
        self.assertEqual(self.reported('clash').count('files are taken as renamed'), 1)

    def test_split_and_merged(self):
        halves = self.parts()
        for name, ids in zip(('fore.glb', 'aft.glb'), halves):
            self.glb().keep(ids).write(self.folder / name)
        whole = self.clash(['ship.glb'], 'whole.json')
        self.clash(['fore.glb', 'aft.glb'], 'halves.json')
        for old, new, relation in (('whole.json', 'halves.json', 'split'), ('halves.json', 'whole.json', 'merged')):
            with self.subTest(relation):
                diff = self.diff('clash', old, new)
                self.assertEqual(diff['counts'], counts(same=len(whole)))
                relations = {m['relation'] for m in diff['files_matched']}
                self.assertIn(relation, relations)
                self.assertLessEqual(relations, {relation, 'renamed'})
                self.assertEqual(len(diff['files_matched']), 2)
        self.glb().keep(halves[0]).write(self.folder / 'later' / 'ship.glb')
        self.clash(['later/ship.glb', 'aft.glb'], 'kept_name.json')
        diff = self.diff('clash', 'whole.json', 'kept_name.json')
        self.assertEqual(diff['counts'], counts(same=len(whole)))
        self.assertEqual([(m['new'], m['relation']) for m in diff['files_matched']], [('aft.glb', 'split')])
        for name, files in (('whole.json', ['ship.glb']), ('halves.json', ['fore.glb', 'aft.glb'])):
            self.draw(files, name)
        # Of lines that coincide the first object's is drawn, and files order objects: owners change, no line comes or goes.
        for old, new in (('whole.json', 'halves.json'), ('halves.json', 'whole.json')):
            lines = self.diff('draw', old, new)['lines']
            self.assertEqual({line['change'] for line in lines} - {'changed'}, set())

    def test_only_the_folder_changed(self):
        """Files of one name have folders in their labels."""
        for ids, folders in zip(self.parts(), (('hull', 'h2'), ('outfit', 'o2'))):
            for folder in folders:
                self.glb().keep(ids).write(self.folder / folder / 'model.glb')
        old = self.clash(['hull/model.glb', 'outfit/model.glb'], 'old.json')
        self.clash(['o2/model.glb', 'h2/model.glb'], 'new.json')
        diff = self.diff('clash')
        self.assertEqual(diff['counts'], counts(same=len(old)))
        self.assertEqual([(m['old'], m['new']) for m in diff['files_matched']],
                         [('hull/model.glb', 'h2/model.glb'), ('outfit/model.glb', 'o2/model.glb')])

    def test_two_that_are_equally_like_are_not_guessed(self):
        """Two files of the same cubes at the same places, each of which clash, under two other names."""
        cubes = ''.join(cube(f'c{n}', n, (90 * n, 0, 0), 100) for n in range(5))
        for name in ('port.obj', 'starboard.obj', 'p2.obj', 's2.obj'):
            self.write(name, cubes)
        unit = ['--unit', 'mm']
        old = self.clash(['port.obj', 'starboard.obj'], 'old.json', *unit)
        self.clash(['p2.obj', 's2.obj'], 'new.json', *unit)
        diff = self.diff('clash')
        self.assertEqual(diff['counts'], counts(new=len(old), cannot_tell=len(old)))
        self.assertNotIn('files_matched', diff)
        self.assertIn({'run': 'new', 'file': 'p2.obj', 'may_be': ['port.obj', 'starboard.obj']}, diff['files_ambiguous'])
        self.assertIn('p2.obj of the new run is equally like port.obj and starboard.obj and is matched with none '
                      '(--match-files OLD=NEW says which it is)', self.reported('clash'))
        # One pair that is given decides the other.
        diff = self.diff('clash', 'old.json', 'new.json', '--match-files', 'port.obj=s2.obj')
        self.assertEqual(diff['counts'], counts(same=len(old)))
        self.assertEqual([(m['old'], m['new'], m['relation']) for m in diff['files_matched']],
                         [('starboard.obj', 'p2.obj', 'renamed'), ('port.obj', 's2.obj', 'asked')])
        self.assertIn('port.obj -> s2.obj (as asked for, 5 of 5 ids in common)',
                      self.reported('clash', 'old.json', 'new.json', '--match-files', 'port.obj=s2.obj'))

    def test_what_places_report(self):
        """A second pair of files has the same ids as the first one, 5 m away from it."""
        for name, at in (('port.obj', 0), ('starboard.obj', 5000)):
            cubes = ''.join(cube(f'c{n}', n, (90 * n, at, 0), 100) for n in range(5))
            for path in (name, 'new_' + name):
                self.write(path, cubes)
        unit = ['--unit', 'mm']
        old = self.clash(['port.obj', 'starboard.obj'], 'old.json', *unit)
        self.clash(['new_starboard.obj', 'new_port.obj'], 'new.json', *unit)
        diff = self.diff('clash')
        self.assertEqual(diff['counts'], counts(same=len(old)))
        self.assertEqual({(m['old'], m['new']) for m in diff['files_matched']},
                         {('port.obj', 'new_port.obj'), ('starboard.obj', 'new_starboard.obj')})

    def test_another_model_is_reported(self):
        self.clash(['ship.glb'], 'old.json')
        self.write('m.obj', ''.join(cube(f'c{n}', n, (90 * n, 0, 0), 100) for n in range(5)))
        self.clash(['m.obj'], 'new.json', '--unit', 'mm')
        self.assertIn('files without a counterpart: ship.glb in the old run, m.obj in the new one '
                      '(--match-files OLD=NEW matches them)\n', self.reported('clash'))
        diff = self.diff('clash')
        self.assertEqual((diff['counts']['gone'], diff['counts']['same']), (0, 0))
        requested = self.reported('clash', 'old.json', 'new.json', '--match-files', 'ship.glb=m.obj')
        self.assertRegex(requested, re.escape('ship.glb -> m.obj (as asked for, 0 of ') + r'\d+ ids in common\)')

    def test_pairs_that_make_no_sense_are_refused(self):
        self.write('m.obj', ''.join(cube(f'c{n}', n, (90 * n, 0, 0), 100) for n in range(5)))
        run = ['m.obj', '--unit', 'mm', '-o']
        for verb, result in (('clash', 'c.json'), ('draw', 'd.json')):
            self.assertEqual(self.run_strake(verb, *run, result).returncode, 0)
            for pairs, reported in ((['m.obj'], "'m.obj' names no two files (write OLD=NEW, as in ship.glb=ship_revB.glb)"),
                                (['=m.obj'], "'=m.obj' names no two files"),
                                (['x.obj=m.obj'], "the old run has no file 'x.obj' (it has m.obj)"),
                                (['m.obj=x.obj'], "the new run has no file 'x.obj' (it has m.obj)"),
                                (['m.obj=m.obj', 'm.obj=m.obj'], "the file 'm.obj' of the old run is given twice")):
                with self.subTest(verb + ' '.join(pairs)):
                    requested = [word for pair in pairs for word in ('--match-files', pair)]
                    done = self.run_strake(verb, 'diff', result, result, *requested)
                    self.assertEqual(done.returncode, 2, done.stdout)
                    self.assertIn('--match-files: ' + reported, done.stderr)
                    self.assertEqual(done.stdout, '')
            done = self.run_strake(verb, 'diff', result, result, '--match-files', 'm.obj=m.obj')
            self.assertEqual(done.returncode, 0, done.stderr)


if __name__ == '__main__':
    main()
