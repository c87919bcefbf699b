#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""project_week_test.py STRAKE EXAMPLES: a week of a yard in one project, as docs/project.md tells it, with every number."""
import contextlib
import csv
import json
import os
import re
import shutil
import sqlite3
import subprocess
import sys
from pathlib import Path

from glb_file import Glb
from scenario import Scenario, main, without_decisions

EXAMPLES = None
NIGHT = ['--self', '--clearance', '25mm']
DEEPER_MM = 1
SEVERITY = {'CLEARANCE_VIOLATION': 0, 'CONTACT': 1, 'HIT': 2}


def pair_of(result):
    return frozenset((result['a']['id'], result['b']['id']))


class Truth:
    """What the status of each pair has to be, from the plain results of the nights alone: the life cycle of docs/project.md
    written down a second time."""

    def __init__(self):
        self.status, self.decided, self.gone = {}, {}, set()
        self.cannot_tell = set()

    def decide(self, pair, status, result):
        self.status[pair] = status
        self.decided[pair] = result

    def came_back(self, pair, result):
        """An approved one that is worse than what was approved."""
        if self.status[pair] != 'approved':
            return False
        was = self.decided[pair]
        return (SEVERITY[result['class']] > SEVERITY[was['class']] or result['d_mm'] < was['d_mm'] - DEEPER_MM
                or result['region_count'] > was['region_count'])

    def night(self, results, objects):
        """Takes a run over, and returns how many appeared and how many are gone."""
        found = {pair_of(result): result for result in results}
        appeared = gone = 0
        self.cannot_tell = set()
        for pair, result in found.items():
            if self.status.get(pair, 'resolved') == 'resolved':
                self.status[pair] = 'new'
                self.gone.discard(pair)
                appeared += 1
            elif self.status[pair] == 'new' or self.came_back(pair, result):
                self.status[pair] = 'active'
        for pair in self.status.keys() - found.keys() - self.gone:
            if pair <= objects:
                gone += self.status[pair] != 'resolved'
                self.status[pair] = 'resolved'
                self.gone.add(pair)
            else:
                self.cannot_tell.add(pair)
                self.status[pair] = self.status[pair].replace('new', 'active')
        return appeared, gone

    def counts(self):
        """Of each status: those that the last run found, and all that are resolved."""
        reported = [status for pair, status in self.status.items() if pair not in self.cannot_tell]
        return {status: reported.count(status) for status in ('new', 'active', 'reviewed', 'approved', 'resolved')}


class Week(Scenario):
    def setUp(self):
        super().setUp()
        self.text('generate', 'ship', '--objects', 600, '--seed', 1, '-o', 'ship.glb', '--truth', 'truth.json')
        ids = set(Glb(self.folder / 'ship.glb').objects())
        self.steel = {id for id in ids if re.match('BEA|BHD|DPL|FRM|LON|PIL|SHL|STF|WEB|BED|FND', id)}
        self.assertGreater(len(self.steel), 50)
        self.write_part(self.steel, 'steel.glb')
        self.write_part(ids - self.steel, 'outfit.glb')
        self.names = ['steel.glb', 'outfit.glb']
        self.truth = Truth()

    def write_part(self, ids, name):
        Glb(self.folder / 'ship.glb').keep(ids).write(self.folder / name)

    def load(self, name):
        return json.loads((self.folder / name).read_text(encoding='utf-8'))

    def query(self, sql):
        with contextlib.closing(sqlite3.connect(f'file:{self.folder}/ship.strake?mode=ro', uri=True)) as shell:
            return shell.execute(sql).fetchall()

    def objects(self):
        return {id for name in self.names for id in Glb(self.folder / name).shown()}

    def changes(self, *files):
        self.text('project', 'update', 'ship.strake', *files, '-o', 'changes.json')
        return self.load('changes.json')

    def night(self, name, how):
        """A night's run: its bytes are those of the files, and every status and number is the truth's."""
        reported = self.text('clash', '-p', 'ship.strake', *NIGHT, '--verify', '-o', f'{name}.json')
        self.text('clash', *self.names, *NIGHT, '-o', 'plain.json')
        self.assertEqual(without_decisions((self.folder / f'{name}.json').read_text(encoding='utf-8')),
                         (self.folder / 'plain.json').read_text(encoding='utf-8'))
        results = self.load(f'{name}.json')['results']
        appeared, gone = self.truth.night(results, self.objects())
        self.check_statuses()
        counts = self.truth.counts()
        row, = self.query('SELECT how, objects, hit, contact, clearance_violation, appeared, gone, new, active, reviewed, '
                          'approved, resolved, cannot_tell FROM run_test ORDER BY run DESC LIMIT 1')
        classes = [result['class'] for result in results]
        self.assertEqual(row, (how, len(self.objects()), classes.count('HIT'), classes.count('CONTACT'),
                               classes.count('CLEARANCE_VIOLATION'), appeared, gone, *counts.values(),
                               len(self.truth.cannot_tell)))
        return reported, results, appeared, gone

    def check_statuses(self):
        rows = self.query('SELECT a_id, b_id, status, unknown IS NOT NULL FROM clashes')
        self.assertEqual({frozenset(row[:2]): row[2] for row in rows}, self.truth.status)
        self.assertEqual({frozenset(row[:2]) for row in rows if row[3]}, self.truth.cannot_tell)
        self.text('clash', 'list', '-p', 'ship.strake', '-o', 'list.csv')
        with open(self.folder / 'list.csv', encoding='utf-8-sig', newline='') as lines:
            listed = {frozenset((row['a_id'], row['b_id'])): row['status'] for row in csv.DictReader(lines)}
        self.assertEqual(listed, self.truth.status)

    def decide(self, results, status, *arguments):
        self.text('clash', 'set', '-p', 'ship.strake', *arguments, '--status', status, '--by', 'Ann')
        for result in results:
            self.truth.decide(pair_of(result), status, result)

    def drawing(self, name, *options):
        self.text('draw', '-p', 'ship.strake', *options, '-o', f'{name}.json', '-o', f'{name}.svg')
        self.text('draw', *self.names, '--view', 'iso', '-o', 'plain.json', '-o', 'plain.svg')
        for ending in ('json', 'svg'):
            self.assertEqual((self.folder / f'{name}.{ending}').read_bytes(), (self.folder / f'plain.{ending}').read_bytes())

    def deepen(self, result):
        """The name of an object of the two, and how far along x it has to go so that they are deeper in each other."""
        for id in sorted(pair_of(result)):
            for metres in (-.005, .005):
                for name in self.names:
                    glb = Glb(self.folder / name)
                    glb.move({id} & glb.shown(), metres).write(self.folder / f'trial_{name}')
                self.text('clash', *[f'trial_{name}' for name in self.names], *NIGHT, '-o', 'trial.json')
                now = {pair_of(other): other for other in self.load('trial.json')['results']}
                if now[pair_of(result)]['d_mm'] < result['d_mm'] - DEEPER_MM:
                    return id, metres
        return self.fail('no way to deepen it along x')

    def test_a_week(self):
        # Monday: the files come in, the first night has everything new.
        self.text('project', 'new', 'ship.strake', *self.names)
        self.assertEqual(self.query('SELECT label FROM file ORDER BY label'), [('outfit.glb',), ('steel.glb',)])
        _, monday, appeared, gone = self.night('monday', 'full')
        self.assertEqual((appeared, gone), (len(monday), 0))
        # The ship's maker knows every pair that touches or clashes; the run has these and no others.
        self.assertEqual({pair_of(result) for result in monday},
                         {frozenset((pair['a'], pair['b'])) for pair in self.load('truth.json')['pairs']})
        self.drawing('monday_iso', '--save', 'iso', '--view', 'iso')

        # Tuesday: ten decisions, by key, by selection and by group.
        by_depth = sorted(monday, key=lambda result: (result['d_mm'], result['key']))
        hits, contacts = by_depth[:4], by_depth[-6:]
        self.decide(hits[:2], 'approved', *[result['key'] for result in hits[:2]], '--comment', 'drawn so')
        self.decide(hits[2:], 'reviewed', *[result['key'] for result in hits[2:]], '--assignee', 'Bob')
        self.decide(contacts[:3], 'approved', *[result['key'] for result in contacts[:3]])
        self.decide(contacts[3:5], 'resolved', *[result['key'] for result in contacts[3:5]])
        self.decide(contacts[5:], 'active', contacts[5]['key'])
        self.check_statuses()
        self.assertEqual(self.query("SELECT count(*) FROM clashes WHERE comment = 'drawn so' AND decided_by = 'Ann'"), [(2,)])
        self.assertEqual(self.query("SELECT count(*) FROM clashes WHERE assignee = 'Bob'"), [(2,)])

        # Tuesday night: no file changed. What was called resolved and is still there is new again.
        changes = self.changes()
        self.assertEqual(changes['changes'], [])
        _, _, appeared, gone = self.night('tuesday', 'nothing')
        self.assertEqual((appeared, gone), (2, 0))
        self.assertEqual(self.truth.counts()['new'], 2)

        # Wednesday: a delivery with other names and another order of the same objects.
        decisions = self.query('SELECT a_id, b_id, decision, decided_by, comment, assignee FROM clash '
                               'WHERE decision IS NOT NULL ORDER BY a_id, b_id')
        for name in self.names:
            Glb(self.folder / name).reverse().write(self.folder / name.replace('.glb', '_revB.glb'))
        self.names = [name.replace('.glb', '_revB.glb') for name in self.names]
        changes = self.changes(*self.names)
        self.assertEqual(changes['changes'], [])
        self.assertEqual({(match['old'], match['new']) for match in changes['files_matched']},
                         {('steel.glb', 'steel_revB.glb'), ('outfit.glb', 'outfit_revB.glb')})
        _, wednesday, appeared, gone = self.night('wednesday', 'changes')
        self.assertEqual((appeared, gone), (0, 0))
        self.assertEqual(self.query('SELECT changed_objects, tested_pairs FROM run_test ORDER BY run DESC LIMIT 1'), [(0, 0)],
                         'what has another name is not tested again')
        self.assertEqual({pair_of(result) for result in wednesday}, {pair_of(result) for result in monday})
        self.assertEqual(self.query('SELECT a_id, b_id, decision, decided_by, comment, assignee FROM clash '
                                    'WHERE decision IS NOT NULL ORDER BY a_id, b_id'), decisions)
        self.assertEqual({match['relation'] for match in json.loads(
            self.text('clash', 'diff', 'monday.json', 'wednesday.json', '--json'))['files_matched']}, {'renamed'})

        # Thursday: the ship changes. One object moves away, one goes deeper, one is taken out, one comes, one has another name
        # of its system, and each is of a clash that somebody decided about.
        moved = sorted(pair_of(hits[2]))[0]
        deeper, way = self.deepen(hits[0])
        removed = sorted(pair_of(contacts[0]))[0]
        added = sorted(pair_of(hits[3]))[0]
        for name in self.names:
            glb = Glb(self.folder / name)
            glb.move([id for id in (moved,) if id in glb.shown()], 30)
            glb.move([id for id in (deeper,) if id in glb.shown()], way)
            glb.double([id for id in (added,) if id in glb.shown()], .02)
            glb.keep(glb.shown() - {removed}).write(self.folder / name)
        changes = self.changes()
        self.assertEqual({(change['id'], *change['kinds']) for change in changes['changes']},
                         {(moved, 'moved'), (deeper, 'moved'), (removed, 'removed'), (added + '-2', 'added')})
        self.assertEqual({kind: count for kind, count in changes['counts'].items() if count and kind != 'unchanged'},
                         {'moved': 2, 'removed': 1, 'added': 1})
        _, _, appeared, gone = self.night('thursday', 'changes')
        self.assertEqual(self.truth.status[pair_of(hits[0])], 'active', 'it is approved no deeper than it was')
        self.assertGreater(appeared, 0)
        self.assertGreater(gone, 0)
        self.assertGreater(len(self.truth.cannot_tell), 0)

        # Friday: the drawing again, from what changed; then in another style, from nothing.
        self.drawing('friday_iso', '--stored', 'iso', '--verify')
        self.text('draw', '-p', 'ship.strake', '--stored', 'iso', '--hidden', 'dashed', '--scale', '1:200', '-o', 'dashed.svg')
        self.text('draw', *self.names, '--view', 'iso', '--hidden', 'dashed', '--scale', '1:200', '-o', 'plain.svg')
        self.assertEqual((self.folder / 'dashed.svg').read_bytes(), (self.folder / 'plain.svg').read_bytes())
        self.text('draw', 'friday_iso.json', '-o', 'again.svg')
        self.assertEqual((self.folder / 'again.svg').read_bytes(), (self.folder / 'friday_iso.svg').read_bytes())
        self.assertIn('new', self.text('draw', 'diff', 'monday_iso.json', 'friday_iso.json'))

        # The report of the week: the trend of four nights, and the decisions in a file.
        self.text('clash', 'history', '-p', 'ship.strake', '-o', 'history.csv')
        with open(self.folder / 'history.csv', encoding='utf-8-sig', newline='') as lines:
            history = list(csv.DictReader(lines))
        self.assertEqual([row['how'] for row in history], ['full', 'nothing', 'changes', 'changes'])
        self.assertEqual([int(row['hit']) for row in history],
                         [sum(result['class'] == 'HIT' for result in self.load(f'{day}.json')['results'])
                          for day in ('monday', 'tuesday', 'wednesday', 'thursday')])
        diff = json.loads(self.text('clash', 'diff', 'monday.json', 'thursday.json', '--json'))
        self.assertEqual(diff['counts']['gone'], gone)
        self.assertEqual(diff['counts']['cannot_tell'], len(self.truth.cannot_tell))
        self.text('project', 'export', 'ship.strake', '-o', 'ship_now.glb')
        self.text('clash', 'ship_now.glb', *NIGHT, '-o', 'exported.json')
        self.assertEqual(len(self.load('exported.json')['results']), len(self.load('thursday.json')['results']))
        self.text('clash', 'list', '-p', 'ship.strake', '-o', 'decisions.csv')
        with open(self.folder / 'decisions.csv', encoding='utf-8-sig', newline='') as lines:
            exported = {frozenset((row['a_id'], row['b_id'])): row['status'] for row in csv.DictReader(lines)}
        self.assertEqual(exported, self.truth.status)
        self.text('project', 'check', 'ship.strake')

    def test_a_missing_object_is_never_resolved(self):
        """Neither on the night after, nor by a full run, and it is decided about again when it is back."""
        self.text('project', 'new', 'ship.strake', *self.names)
        _, monday, _, _ = self.night('monday', 'full')
        result = next(result for result in monday if result['class'] == 'HIT')
        self.decide([result], 'approved', result['key'])
        outfit = (self.folder / 'outfit.glb').read_bytes()
        glb = Glb(self.folder / 'outfit.glb')
        glb.keep(glb.shown() - pair_of(result)).write(self.folder / 'outfit.glb')
        self.changes()
        self.night('tuesday', 'changes')
        self.assertIn(pair_of(result), self.truth.cannot_tell)
        self.assertEqual(self.truth.status[pair_of(result)], 'approved')
        self.night('wednesday', 'nothing')
        self.assertIn(pair_of(result), self.truth.cannot_tell)
        (self.folder / 'outfit.glb').write_bytes(outfit)
        self.changes()
        self.night('thursday', 'changes')
        self.assertEqual(self.truth.cannot_tell, set())


class Nightly(Scenario):
    """examples/nightly.sh, which cron runs."""

    def nightly(self, *arguments, **environment):
        return subprocess.run(['sh', EXAMPLES / 'nightly.sh', *arguments], cwd=self.folder, capture_output=True, text=True,
                              timeout=200, check=False,
                              env={**os.environ, 'PATH': f'{Path(self.STRAKE).parent}:{os.environ["PATH"]}', **environment})

    def setUp(self):
        super().setUp()
        self.text('generate', 'ship', '--objects', 300, '--seed', 7, '-o', 'ship.glb')
        self.text('project', 'new', 'ship.strake', 'ship.glb')
        self.text('draw', '-p', 'ship.strake', '--save', 'deck', '--view', 'top', '-o', 'deck.svg')

    def test_nights(self):
        """New hits make the exit code 1, a quiet night 0; everything lies in the folder of the report."""
        done = self.nightly('ship.strake', 'report', 'deck')
        self.assertEqual(done.returncode, 1, done.stderr)
        expected = ['changes.csv', 'clashes.json', 'deck.svg', 'history.csv', 'new.csv']
        self.assertEqual(sorted(path.name for path in (self.folder / 'report').iterdir()), expected)
        self.assertGreater(len((self.folder / 'report/new.csv').read_text().splitlines()), 1)
        self.text('clash', 'ship.glb', '--clearance', '25mm', '-o', 'plain.json')
        self.assertEqual(without_decisions((self.folder / 'report/clashes.json').read_text(encoding='utf-8')),
                         (self.folder / 'plain.json').read_text(encoding='utf-8'))
        done = self.nightly('ship.strake', 'report', 'deck')
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(len((self.folder / 'report/new.csv').read_text().splitlines()), 1)
        self.assertEqual(len((self.folder / 'report/history.csv').read_text().splitlines()), 3)

    def test_what_goes_wrong_is_reported_and_stops_it(self):
        shutil.move(self.folder / 'ship.glb', self.folder / 'away.glb')
        done = self.nightly('ship.strake', 'report', 'deck')
        self.assertEqual(done.returncode, 3, done.stderr)
        self.assertIn('ship.glb', done.stderr)
        self.assertEqual(self.nightly().returncode, 2)
        self.assertEqual(self.nightly('missing.strake', 'report').returncode, 3)
        with contextlib.closing(sqlite3.connect(self.folder / 'ship.strake', isolation_level=None)) as other:
            shutil.move(self.folder / 'away.glb', self.folder / 'ship.glb')
            Glb(self.folder / 'ship.glb').reverse().write(self.folder / 'ship.glb')
            other.execute('BEGIN IMMEDIATE')
            done = self.nightly('ship.strake', 'report', STRAKE_WAIT='0.2')
            self.assertEqual(done.returncode, 3, done.stderr)
        self.assertEqual(self.nightly('ship.strake', 'report', 'deck').returncode, 1)


if __name__ == '__main__':
    EXAMPLES = Path(sys.argv.pop(2)).resolve()
    main()
