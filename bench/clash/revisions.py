#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""revisions.py STRAKE [FILE.rvm...]: how well runs over two revisions of a model are compared.

Each RVM is written anew under another name, with its groups in the opposite order, and with objects moved, removed, added,
renamed or renumbered, so that it is known which object of one file is which of the other. 'strake clash diff' is then
held against that. Prints a table in Markdown. Of the clashes that are in both runs: how many there are, how many are
matched with themselves (or with one of the same class, depth and
place, as copies have), and how many of all matches are right. Of the new ones: how many there are, how many are told as new, how
many are left open (cannot tell), and how many of those told as new are. Of the mended ones, between objects that both revisions have, the
same. Attribute files are left aside: ids are paths. Without files it takes all RVM files of the folder that STRAKE_DATA names, and ends with 77 where there
are none. It fails where a clash is told as new or mended that is not, but for renamed objects, which have another id.
"""
import argparse
import copy
import json
import os
import random
import re
import struct
import subprocess
import sys
import tempfile
from pathlib import Path

SHARE = .02  # of the objects, by each kind of change
COUNTED = re.compile(r'^(\S+) (\d+) of ')


class Group:
    """A group of an RVM: the body of its CNTB chunk but for its name, and its chunks and groups in order."""

    def __init__(self, body):
        words, = struct.unpack_from('>I', body, 4)
        self.version, self.rest = body[:4], body[8 + 4 * words:]
        self.name = body[8:8 + 4 * words].rstrip(b'\0').decode('utf-8', 'surrogateescape')
        self.items, self.tag = [], None

    def groups(self):
        return [item for item in self.items if isinstance(item, Group)]

    def has_geometry(self):
        return len(self.groups()) < len(self.items)

    def body(self):
        data = self.name.encode('utf-8', 'surrogateescape')
        data += bytes(-len(data) % 4)
        return self.version + struct.pack('>I', len(data) // 4) + data + self.rest

    def each(self):
        """This group and those below it, from the top down."""
        yield self
        for group in self.groups():
            yield from group.each()


class Model:
    """An RVM as a tree."""

    def __init__(self, path):
        data, at, stack, self.head = path.read_bytes(), 0, [], []
        self.roots, self.end = [], None
        while self.end is None:
            kind = data[at + 3:at + 16:4].decode('latin-1')
            after, = struct.unpack_from('>I', data, at + 16)
            body = data[at + 20:after or len(data)]  # with the word that says nothing of interest
            at = after
            if kind == 'CNTB':
                group = Group(body[4:])
                group.word = body[:4]
                (stack[-1].items if stack else self.roots).append(group)
                stack.append(group)
            elif kind == 'CNTE':
                stack.pop().close = body
            elif kind == 'END:':
                self.end = body
            elif stack:
                stack[-1].items.append((kind, body))
            else:
                self.head.append((kind, body))
        for tag, group in enumerate(self.objects()):
            group.tag = tag

    def groups(self):
        return [group for root in self.roots for group in root.each()]

    def objects(self):
        return [group for group in self.groups() if group.has_geometry()]

    def tags_by_path(self):
        """The tags of objects by the names from the top down to them, which no two share."""
        tags = {}

        def add(group, above):
            path = above + ('' if group.name.startswith('/') else '/') + group.name
            if group.has_geometry():
                tags[path] = group.tag
            for below in group.groups():
                add(below, path)

        for root in self.roots:
            add(root, '')
        return tags

    def write(self, path):
        out = bytearray()

        def chunk(kind, body):
            out.extend(struct.pack('>5I', *kind.encode('latin-1'), len(out) + 20 + len(body)) + body)

        def write(group):
            chunk('CNTB', group.word + group.body())
            for item in group.items:
                write(item) if isinstance(item, Group) else chunk(*item)
            chunk('CNTE', group.close)

        for item in self.head:
            chunk(*item)
        for root in self.roots:
            write(root)
        chunk('END:', self.end)
        path.write_bytes(out)

    def reverse(self):
        for group in self.groups():
            group.items = [i for i in group.items if not isinstance(i, Group)] + group.groups()[::-1]
        self.roots.reverse()

    def parents(self):
        return {id(child): group for group in self.groups() for child in group.groups()}

    def some(self, rng):
        """Some objects without groups below them, of groups that have several."""
        parents = self.parents()
        leaves = [g for g in self.objects() if not g.groups() and len(parents[id(g)].groups()) > 1]
        return rng.sample(leaves, max(1, min(len(leaves), round(SHARE * len(self.objects())))))

    def remove(self, groups):
        parents = self.parents()
        for group in groups:
            parents[id(group)].items.remove(group)


def move(group, metres):
    """Moves the geometry of a group: the last three of the twelve numbers of a matrix are its place."""
    place = 4 + 8 + 9 * 4  # behind the word, the version, the kind and the axes
    for number, item in enumerate(group.items):
        if not isinstance(item, Group):
            body = bytearray(item[1])
            x, = struct.unpack_from('>f', body, place)
            struct.pack_into('>f', body, place, x + metres)
            group.items[number] = (item[0], bytes(body))


# What one finds in the next revision. Each changes a model by a generator of random numbers.
def nothing(model, rng):
    pass


def moved(model, rng):
    for group in model.some(rng):
        move(group, 1)


def removed(model, rng):
    model.remove(model.some(rng))


def added(model, rng):
    parents = model.parents()
    for number, group in enumerate(model.some(rng)):
        double = copy.copy(group)
        double.items, double.name = list(group.items), f'/ADDED-{number}'
        double.tag = f'added {number}'
        move(double, .02)
        parents[id(group)].items.append(double)


def renamed(model, rng):
    for group in model.some(rng):
        group.name += '-R'


def renumbered(model, rng):
    """Removes some, and numbers what is left of their kind anew, as "BOX 2 of EQUIPMENT /P-1"."""
    parents = model.parents()
    counted = [g for g in model.some(rng) if COUNTED.match(g.name)]
    owners = {id(parents[id(g)]): parents[id(g)] for g in counted}.values()
    model.remove(counted)
    for owner in owners:
        numbers = {}
        for group in owner.groups():
            kind = COUNTED.match(group.name)
            if kind:
                numbers[kind[1]] = numbers.get(kind[1], 0) + 1
                group.name = f'{kind[1]} {numbers[kind[1]]}{group.name[kind.end(2):]}'


CHANGES = {'nothing': nothing, 'moved by 1 m': moved, 'removed': removed, 'added': added, 'renamed': renamed,
           'removed, and the others of their kind numbered anew': renumbered}


class Run:
    """A run over a model, with its clashes as pairs of tags."""

    def __init__(self, strake, path, model):
        listed = json.loads(strake('info', path, '--objects', 10 ** 7, '--json'))['objects']
        tags = model.tags_by_path()
        if sorted(o['path'] for o in listed) != sorted(tags):
            raise SystemExit(f'{path.name}: the objects of strake are others than those of this script')
        self.tags = {o['id']: tags[o['path']] for o in listed}
        self.result = path.with_suffix('.json')
        strake('clash', path, '-o', self.result)
        results = json.loads(self.result.read_text(encoding='utf-8'))['results']
        self.pair_of_key = {r['key']: self.pair(r) for r in results}
        self.pairs = set(self.pair_of_key.values())
        self.measures = {self.pair(r): (r['class'], *(round(mm, 3) for mm in (r['d_mm'], *r['point_mm']))) for r in results}

    def pair(self, entry):
        return frozenset(self.tags[entry[side]['id']] for side in 'ab')


def share(part, whole):
    return f'{100 * part / whole:.1f} %' if whole else '-'


def compared(strake, old, new):
    """The numbers of a row, from how a comparison is and how it should be."""
    diff = json.loads(strake('clash', 'diff', old.result, new.result, '--json'))
    both, is_new, is_gone = old.pairs & new.pairs, new.pairs - old.pairs, old.pairs - new.pairs
    matched = [(old.pair_of_key[(e.get('was') or {}).get('key', e['key'])], new.pair_of_key[e['key']])
               for e in diff['same'] + diff['changed']]
    # Copies that lie in each other have clashes between which nothing decides, and need not.
    right = sum(was == now or old.measures[was] == old.measures.get(now) for was, now in matched)
    # What an object that is gone was part of cannot be known: nobody looked at it again.
    there = set(new.tags.values())
    is_mended = {pair for pair in is_gone if pair <= there}
    reported = {'new': [new.pair(e) for e in diff['added']], 'gone': [old.pair(e) for e in diff['gone']]}
    open_in = {run: {of.pair(e) for e in diff['cannot_tell'] if e['run'] == name}
               for run, of, name in (('new', new, 'new'), ('gone', old, 'old'))}
    counts = [len(both), right, len(matched)]
    for run, truth in (('new', is_new), ('gone', is_mended)):
        found = truth & set(reported[run])
        counts += [len(truth), len(found), len(truth & open_in[run] - found), len(reported[run])]
    return [*counts, len(diff['cannot_tell'])]


def row(label, what, counts):
    both, right, matched, *rest = counts
    cells = [label, what, both, share(right, both), share(right, matched)]
    for truth, found, left, reported in (rest[:4], rest[4:8]):
        cells += [truth, share(found, truth), share(left, truth), share(found, reported)]
    return '| ' + ' | '.join(map(str, [*cells, rest[8]])) + ' |'


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument('strake', type=Path)
    parser.add_argument('files', nargs='*', type=Path)
    given = parser.parse_args()
    program = given.strake.resolve()
    data = os.environ.get('STRAKE_DATA')
    files = given.files or sorted(path for path in (Path(data).rglob('*') if data else ()) if path.suffix.lower() == '.rvm')
    if not files:
        print('skipped: give RVM files, or name a folder of them in STRAKE_DATA')
        return 77

    def strake(*words):
        done = subprocess.run([program, *map(str, words), '--quiet'], capture_output=True, text=True, check=False)
        if done.returncode != 0:
            raise SystemExit(f'{words}: {done.stderr}')
        return done.stdout

    print('| model | 2 % of the objects | in both | matched | right | new | told | open | right | mended | told | open | right '
          '| cannot tell |')
    print('|---|---|' + '---:|' * 12)
    sums = {}
    wrong = []
    for path in files:
        with tempfile.TemporaryDirectory() as folder:
            def run(model, label):
                file = Path(folder) / f'{label}{path.suffix}'
                model.write(file)
                return Run(strake, file, model)
            old = run(Model(path), path.stem)
            for what, change in CHANGES.items():
                model = Model(path)
                change(model, random.Random(7))
                model.reverse()
                counts = compared(strake, old, run(model, path.stem + '_revB'))
                print(row(path.name, what, counts), flush=True)
                if change is not renamed and (counts[4] < counts[6] or counts[8] < counts[10]):
                    wrong.append(f'{path.name}, {what}')
                sums[what] = [x + y for x, y in zip(sums[what], counts)] if what in sums else counts
    for what, counts in sums.items() if len(files) > 1 else ():
        print(row('all', what, counts))
    if wrong:
        print('told as new or mended and are not: ' + '; '.join(wrong), file=sys.stderr)
    return 1 if wrong else 0


if __name__ == '__main__':
    sys.exit(main())
