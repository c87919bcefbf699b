#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""project_edits_test.py STRAKE: a project after any sequence of edits gives, by what changed alone, the bytes that the
model files give in full. STRAKE_EDITS says how many sequences each number of threads gets (default 1)."""
import csv
import json
import os
import random
from pathlib import Path

from scenario import Scenario, main, without_decisions
from small_yard import Yard

SEQUENCES = int(os.environ.get('STRAKE_EDITS', 1))
STEPS = 14
RULES = """
[[test]]
name = "all {number}"
a = "name = '*'"
b = "name = '*'"
clearance = "{clearance}mm"

[[test]]
name = "pipes"
a = "@system = PIPING"
b = "not @system = PIPING"
clearance = "10mm"

[[allowed]]
name = "steel on steel"
a = "@system = STEEL"
b = "@system = STEEL"
max_depth = "{depth}mm"
"""
VIEWS = (('--view', 'top'), ('--view', 'iso', '--hidden', 'dashed'), ('--view', 'front', '--section', 'y=130mm'),
         ('--direction', '1,-2,1', '--limits', '0,0,0,200,200,200'), ('--view', 'iso', '--select', '@system = PIPING'),
         ('--eye', '900,-900,500', '--target', '120,120,100'), ('--view', 'left', '--stage', 'local'))


class Edits(Scenario):
    def run_ok(self, *arguments):
        done = self.run_strake(*arguments, '--quiet')
        self.assertEqual(done.returncode, 0, (self.log, arguments, done.stdout, done.stderr))

    def same_bytes(self, one, other):
        one, other = (self.folder / name for name in (one, other))
        if one.read_bytes() != other.read_bytes():
            kept = Path(os.environ.get('STRAKE_KEEP', self.folder))
            self.fail(f'{one.name} is not {other.name} after {self.log}; STRAKE_KEEP={kept}')

    def rows(self, name):
        with open(self.folder / name, encoding='utf-8-sig', newline='') as lines:
            return list(csv.DictReader(lines))

    def write_rules(self):
        self.write('rules.toml', RULES.format(number=self.random.choice('12'), clearance=self.random.choice((0, 5, 25)),
                                              depth=self.random.choice((1, 30))))

    def update(self, renamed):
        """Files under other names are given; others are looked at where they lie."""
        self.yard.write()
        files, requested = [], []
        for old, new in renamed:
            files.append(new)
            requested += ['--match-files', f'{old}={new}']
        self.run_ok('project', 'update', 'p.strake', *files, *requested)
        if files:
            self.run_ok('project', 'update', 'p.strake')

    def clash(self, threads):
        files = list(self.yard.files)
        for name, options in (('usual', ['--clearance', '5mm']), ('rules', ['--rules', 'rules.toml'])):
            self.run_ok('clash', *files, *options, '-o', f'{name}.json', '-o', f'{name}.csv')
            self.run_ok('clash', '-p', 'p.strake', *options, '--verify', '--threads', threads, '-o', f'{name}_p.json',
                        '-o', f'{name}_p.csv')
            self.run_ok('clash', 'p.strake', *options, '-o', f'{name}_q.json')
            self.same_bytes(f'{name}_q.json', f'{name}.json')
            remembered = self.folder / f'{name}_p.json'
            remembered.write_text(without_decisions(remembered.read_text(encoding='utf-8')), encoding='utf-8')
            self.same_bytes(remembered.name, f'{name}.json')
            plain, reported = (self.rows(f'{name}{end}.csv') for end in ('', '_p'))
            self.assertEqual([{column: now[column] for column in row} for row, now in zip(plain, reported)],
                             plain, self.log)
            self.assertEqual(len(plain), len(reported))

    def draw(self, threads):
        """The view is saved again where it is another one, and sometimes where it is not."""
        is_saved = self.view is not None and self.random.random() < .6
        if self.view is None or self.random.random() < .2:
            self.view, is_saved = self.random.choice(VIEWS), False
        self.run_ok('draw', *self.yard.files, *self.view, '-o', 'v.json', '-o', 'v.svg')
        first = ['--stored', 'hall', '--verify'] if is_saved else ['--save', 'hall', *self.view]
        for way in (first, ['--stored', 'hall', '--verify']):
            self.run_ok('draw', '-p', 'p.strake', *way, '--threads', threads, '-o', 'v_p.json', '-o', 'v_p.svg')
            self.same_bytes('v_p.json', 'v.json')
            self.same_bytes('v_p.svg', 'v.svg')

    def sequence(self, seed, threads):
        self.random, self.log = random.Random(seed), [f'seed {seed}, {threads} threads']
        for name in self.folder.iterdir():
            name.unlink()
        self.yard = Yard(self.folder, self.random, 9)
        self.view = None
        self.write_rules()
        self.run_ok('project', 'new', 'p.strake', *self.yard.files)
        for _ in range(STEPS):
            renamed = {}
            for _ in range(self.random.choice((0, 1, 1, 2, 4))):
                names = self.yard.edit()
                if names:
                    # What is renamed twice in a night has the project's name first.
                    first = next((old for old, new in renamed.items() if new == names[0]), names[0])
                    renamed[first] = names[1]
            if self.random.random() < .15:
                self.write_rules()
            self.update(renamed.items())
            self.log.append({name: {n: t.state() for n, t in things.items()} for name, things in self.yard.files.items()}
                            if 'STRAKE_KEEP' in os.environ else 'step')
            if self.random.random() < .8:
                self.clash(threads)
            if self.random.random() < .8:
                self.draw(threads)
        self.run_ok('project', 'check', 'p.strake')

    def test_what_changed_alone_gives_the_bytes_of_everything(self):
        for number in range(SEQUENCES):
            for threads in (1, 2, 3, 8):
                with self.subTest(number=number, threads=threads):
                    self.sequence(1000 * number + threads, threads)


class WhatIsReported(Scenario):
    """Of each kind of edit alone, update tells that kind and that object and nothing else."""

    KINDS = ('added', 'removed', 'moved', 'reshaped', 'reattributed', 'renamed')

    def changes(self):
        self.text('project', 'update', 'p.strake', '-o', 'changes.json')
        reported = json.loads((self.folder / 'changes.json').read_text(encoding='utf-8'))
        return {kind: count for kind, count in reported['counts'].items() if kind in self.KINDS and count}, reported

    def test_each_kind_alone(self):
        yard = Yard(self.folder, random.Random(5), 6)
        self.text('project', 'new', 'p.strake', *yard.files)
        self.assertEqual(self.changes()[0], {})
        things = yard.files['hull.gltf']
        name = sorted(things)[0]
        first = things[name]

        def gone():
            del things[name]

        def back():
            things[name] = first

        def elsewhere():
            things[name].place = tuple(x + 1000 for x in things[name].place)

        def larger():
            things[name].sides = (999, 40, 40)

        def other_system():
            things[name].system = 'FIRE'

        for edit, kind in ((gone, 'removed'), (back, 'added'), (elsewhere, 'moved'), (larger, 'reshaped'),
                           (other_system, 'reattributed')):
            with self.subTest(kind):
                edit()
                yard.write()
                counts, reported = self.changes()
                self.assertEqual(counts, {kind: 1})
                self.assertEqual([change['id'] for change in reported['changes']], [name])
                self.assertEqual(self.changes()[0], {}, 'told once')
        things['OTHER'] = things.pop(name)
        yard.write()
        self.assertEqual(self.changes()[0], {'renamed': 1})


if __name__ == '__main__':
    main()
