#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""bcf_test.py STRAKE: clashes as BCF for other programs, and what people decided there taken back into the project."""
import contextlib
import csv
import io
import json
import os
import random
import sqlite3
import struct
import time
import unittest
import xml.etree.ElementTree as ElementTree
import zipfile
from pathlib import Path

from bcf_file import Bcf, add_comment, approve, assign, rewrite
from bcf_project import BcfProject
from hostile_names_test import FILES, LONG, NAMES
from row_project import ROW, RowProject, cubes
from scenario import Scenario, gltf, main


class BcfOut(RowProject):
    def bcf(self, name='x.bcf'):
        return Bcf(self.folder / name, self.fail)

    def clash(self, *options, exit_code=0):
        return self.done('clash', 'row.obj', '--unit', 'mm', *options, exit_code=exit_code)

    def test_a_topic_for_each_clash(self):
        self.clash('-o', 'x.bcf', '--json')
        bcf = self.bcf()
        self.assertEqual((bcf.version, len(bcf.topics)), ('2.1', 3))
        topic = bcf.topics[0]
        self.assertRegex(topic['title'], r'^HIT, \d+\.\d mm deep: c0 / c1$')
        self.assertEqual((topic['status'], topic['type'], topic['priority'], topic['labels'], topic['files']),
                         ('New', 'Clash', 'High', ['HIT'], ['row.obj']))
        self.assertEqual((topic['created'], topic['author']), ('1970-01-01T00:00:00Z', 'strake'))
        self.assertIn('A: c0 (row.obj', topic['description'])
        view = topic['view']
        self.assertEqual(view['selection'], [('OBJ', 'c0'), ('OBJ', 'c1')])
        self.assertEqual(list(view['colors'].values()), [[('OBJ', 'c0')], [('OBJ', 'c1')]])
        self.assertEqual(view['size'], (800, 600))
        # Metres: the eye is within some metres of the row.
        self.assertLess(max(map(abs, view['eye'])), 5)
        ahead = sum(d * (c - e) for d, c, e in zip(view['direction'], (.09, .05, .05), view['eye']))
        self.assertGreater(ahead, 0)

    def test_both_versions_state_the_same(self):
        for version in ('2.1', '3.0'):
            self.clash('-o', f'{version}.bcf', '--bcf-version', version, '--clearance', '25mm')
        two, three = self.bcf('2.1.bcf'), self.bcf('3.0.bcf')
        for topic in [*two.topics, *three.topics]:
            topic.pop('view')
        self.assertEqual(three.version, '3.0')
        self.assertEqual(two.topics, three.topics)
        self.assertIn(b'<TopicStatus>Approved</TopicStatus>', three.bytes['extensions.xml'])

    def test_bytes_do_not_depend_on_threads_or_the_run(self):
        for number, threads in enumerate((1, 2, 3, 8, 1)):
            for version in ('2.1', '3.0'):
                self.clash('-o', f'{number}-{version}.bcf', '--bcf-version', version, '--threads', threads)
        for version in ('2.1', '3.0'):
            first = (self.folder / f'0-{version}.bcf').read_bytes()
            for number in range(1, 5):
                self.assertEqual((self.folder / f'{number}-{version}.bcf').read_bytes(), first)

    def test_guids_stay(self):
        self.clash('-o', 'before.bcf')
        self.write('row.obj', cubes([(1.5, 0, 0), *ROW[1:]]))
        self.clash('-o', 'after.bcf', '--bcf-date', '2026-01-31', '--bcf-author', 'Ann')
        before, after = self.bcf('before.bcf'), self.bcf('after.bcf')
        self.assertEqual(sorted(t['guid'] for t in before.topics), sorted(t['guid'] for t in after.topics))
        self.assertEqual({(t['created'], t['author']) for t in after.topics}, {('2026-01-31T00:00:00Z', 'Ann')})

    def test_groups(self):
        self.clash('--group-by', 'element', '-o', 'x.bcf')
        titles = [topic['title'] for topic in self.bcf().topics]
        self.assertRegex(titles[0], r'^2 clashes, worst HIT, \d+\.\d mm deep: ')
        self.assertEqual(len(titles), 2)
        view = self.bcf().topics[0]['view']
        self.assertEqual(sorted(map(len, view['colors'].values())), [1, 2])

    def test_what_is_left_out_is_reported(self):
        self.write('row.obj', cubes([*ROW, (340, 0, 0)]))
        reported = self.clash('-o', 'x.bcf', '--bcf-max-topics', 2).stderr
        self.assertIn('x.bcf: without 1 result beyond the first 2, and 1 contact', reported)
        self.assertEqual(len(self.bcf().topics), 2)
        reported = self.clash('-o', 'x.bcf', '--bcf-contacts').stderr
        self.assertNotIn('without', reported)
        self.assertEqual([t['priority'] for t in self.bcf().topics], ['High'] * 3 + ['Low'])

    def test_ifc_elements_have_their_guids(self):
        guids = ['0$WU4A9R19$vKWO$AdOnKA', '3Jl8HjJ1r9SBkP5tYw_VZm']
        self.write('m.gltf', gltf(('plant', {}, None, [(name, {'GlobalId': name}, .05 * i, []) for i, name in enumerate(guids)])))
        self.done('clash', 'm.gltf', '-o', 'x.bcf')
        self.assertEqual(sorted(self.bcf().topics[0]['view']['selection']), sorted(guids))

    def test_the_head_of_an_ifc_is_named(self):
        """As the importer of IFC has the groups at the top inherit it."""
        origin = {'ProjectId': '0$WU4A9R19$vKWO$AdOnKA', 'FileDate': '2026-01-30T10:00:00+02:00'}
        self.write('m.gltf', gltf(('site', origin, None, [(f'e{i}', {}, .05 * i, []) for i in range(2)])))
        reported = self.done('clash', 'm.gltf', '-o', 'x.bcf').stderr
        self.assertNotIn('dated', reported)
        topic, = self.bcf().topics
        self.assertEqual((topic['created'], topic['projects'], topic['file_dates']),
                         ('2026-01-30T08:00:00Z', ['0$WU4A9R19$vKWO$AdOnKA'], ['2026-01-30T08:00:00Z']))
        self.assertIn('its topics are dated 1970-01-01', self.clash('-o', 'x.bcf').stderr)
        self.assertNotIn('dated', self.clash('-o', 'x.bcf', '--bcf-date', '2026-01-31').stderr)

    def test_misuse(self):
        for options, reported in ((['--bcf-version', '2.1'], 'no .bcf is written'), (['--bcf-max-topics', '5'], 'no .bcf is written'),
                              (['-o', 'x.bcf', '--bcf-date', 'today'], 'is no date'),
                              (['-o', 'x.bcf', '--bcf-version', '2.0'], '2.1'),
                              (['-o', 'x.bcf', '--bcf-author', ' '], 'no name')):
            self.assertIn(reported, self.clash(*options, exit_code=2).stderr)


class BcfHostileNames(Scenario):
    def test_names_are_text(self):
        for number, file in enumerate(FILES[:3]):
            children = [(name, {}, .05 * (number + i), []) for i, name in enumerate([*NAMES, *LONG])]
            (self.folder / file).write_text(gltf((NAMES[number], {}, None, children)), encoding='utf-8')
        for version in ('2.1', '3.0'):
            done = self.run_strake('clash', *(f'./{file}' for file in FILES[:3]), '--quiet', '-o', 'x.bcfzip', '--bcf-max-topics', 60,
                                   '--bcf-version', version)
            self.assertEqual(done.returncode, 0, done.stderr)
            bcf = Bcf(self.folder / 'x.bcfzip', self.fail)
            self.assertEqual(len(bcf.topics), 60)
            for topic in bcf.topics:
                self.assertLess(len(topic['title']), 200)
                self.assertFalse(set('\u202e\u2066\x1b\x07') & set(topic['title'] + topic['description']))


class BcfBack(BcfProject):
    """What comes back into the project."""

    def edit(self, change, source='x.bcf', name='back.bcf'):
        """Has change(topic, markup) its way with each topic."""
        rewrite(self.folder / source, self.folder / name, lambda root: change(root.find('Topic'), root))

    def decide(self, topic, markup):
        """Approves c0/c1 with a reason, assigns c1/c2, says something of c2/c3."""
        title = topic.findtext('Title')
        if 'c0' in title:
            topic.set('TopicStatus', 'Approved')
            add_comment(markup, '11111111-1111-4111-8111-111111111111', '2026-02-03T12:00:00+02:00', 'Ann', 'as agreed\nby phone')
        elif 'c1' in title:
            assign(topic, 'Bob')
        else:
            add_comment(markup, '22222222-2222-4222-8222-222222222222', '2026-02-03T10:00:00.250Z', 'Ödön', '<b>move it</b>')
            add_comment(markup, '33333333-3333-4333-8333-333333333333', '2026-02-03T10:00:01', 'Ann', '<b>move it</b>')

    def test_statuses_assignees_and_comments_come_back(self):
        for version in ('2.1', '3.0'):
            with self.subTest(version):
                self.out('--bcf-version', version)
                self.edit(self.decide)
                reported = self.take().stderr
                rows = {row[0]: row[1:] for row in self.state()[0]}
                by_name = {tuple(row[:2]): rows[row[2]] for row in self.query('SELECT a_name, b_name, key FROM clash')}
                self.assertEqual(by_name['c0', 'c1'][:3], ('approved', 'as agreed\nby phone', None))
                self.assertIn(by_name['c1', 'c2'][0], ('new', 'active'))
                self.assertEqual(by_name['c1', 'c2'][1:3], (None, 'Bob'))
                self.assertEqual(by_name['c2', 'c3'][1:3], ('<b>move it</b>', None))
                stated = [event[1:] for event in self.state()[1] if event[5] and event[2] in ('Ann', 'Ödön')]
                self.assertEqual({(e[0], e[1], e[4]) for e in stated},
                                 {('2026-02-03T10:00:00Z', 'Ann', 'as agreed\nby phone'),
                                  ('2026-02-03T10:00:00Z', 'Ödön', '<b>move it</b>'),
                                  ('2026-02-03T10:00:01Z', 'Ann', '<b>move it</b>')})
                if version == '2.1':
                    self.assertIn('3 topics, 1 status and 1 assignee changed, 3 comments added, 0 comments were there', reported)

    def test_the_same_file_again_changes_nothing(self):
        self.edit(self.decide)
        self.take()
        before = self.state()
        reported = self.take().stderr
        self.assertIn('0 statuses and 0 assignees changed, 0 comments added, 3 comments were there', reported)
        self.assertEqual(self.state(), before)
        # Nor does a file that is written now and comes back untouched.
        for version in ('2.1', '3.0'):
            self.out('--bcf-version', version, name='now.bcf')
            before = self.state()
            self.assertIn('0 statuses and 0 assignees changed, 0 comments added', self.take(name='now.bcf').stderr)
            self.assertEqual(self.state(), before)
        topic = next(t for t in Bcf(self.folder / 'now.bcf', self.fail).topics if 'c0' in t['title'])
        self.assertEqual((topic['status'], topic['comments']),
                         ('Approved', [('2026-02-03T10:00:00Z', 'Ann', 'as agreed\nby phone')]))

    def comments(self, *options, name='now.bcf', of='c0'):
        """The comments of a topic in a file that is written now: GUID, date, author, text and who edited it."""
        self.out(*options, name=name)
        topics = Bcf(self.folder / name, self.fail).topics
        guids = [guid for topic in topics for guid in topic['comment_guids']]
        self.assertEqual(len(guids), len(set(guids)), 'no GUID stands for two comments')
        topic = next(t for t in topics if of in t['title'])
        return [(guid, *stated, *edited) for guid, stated, edited in zip(topic['comment_guids'], topic['comments'], topic['edited'])]

    def test_comments_of_others_keep_their_guids(self):
        ours = self.listed()[0]['key']
        self.set(ours, '--comment', 'ours', '--by', 'Eve')
        self.edit(self.decide)
        self.take()
        ann = ('11111111-1111-4111-8111-111111111111', '2026-02-03T10:00:00Z', 'Ann', 'as agreed\nby phone', None, None)
        for version in ('2.1', '3.0'):
            stated = self.comments('--bcf-version', version)
            self.assertIn(ann, stated)
            self.assertEqual([s[0] for s in self.comments('--bcf-version', version, of='c3')],
                             ['22222222-2222-4222-8222-222222222222', '33333333-3333-4333-8333-333333333333'])
        # In a group it is another comment, for the single clash has the GUID.
        grouped = self.comments('--group-by', 'test', name='g.bcf', of='clash')
        self.assertIn('Ödön', [s[2] for s in grouped])
        self.assertNotIn('22222222-2222-4222-8222-222222222222', [s[0] for s in grouped])

    def test_comments_that_were_edited_have_their_last_form(self):
        self.edit(self.decide)
        self.take()
        self.out()

        def change(topic, markup):
            for comment in markup.iter('Comment'):
                if comment.get('Guid') == '11111111-1111-4111-8111-111111111111':
                    comment.find('Comment').text = 'not agreed'
                    for name, value in (('ModifiedDate', '2026-02-04T10:00:00Z'), ('ModifiedAuthor', 'Bob')):
                        ElementTree.SubElement(comment, name).text = value
        self.edit(change, name='edited.bcf')
        self.assertIn('1 comment added, 2 comments were there', self.take(name='edited.bcf').stderr)
        self.assertIn('0 comments added', self.take(name='edited.bcf').stderr)
        self.assertEqual(self.comments(), [('11111111-1111-4111-8111-111111111111', '2026-02-03T10:00:00Z', 'Ann', 'not agreed',
                                            '2026-02-04T10:00:00Z', 'Bob')])
        self.assertIn('0 comments added', self.take(name='now.bcf').stderr)

    def test_who_sees_to_it_is_no_comment(self):
        key, = next(row for row in self.query("SELECT key FROM clash WHERE a_name = 'c0'"))
        self.set(key, '--assignee', 'Bob', '--by', 'Eve')
        self.set(key, '--assignee', 'Ann', '--comment', 'her deck', '--by', 'Eve')
        self.assertEqual([s[3] for s in self.comments()], ['her deck'])
        topic = next(t for t in Bcf(self.folder / 'now.bcf', self.fail).topics if 'c0' in t['title'])
        self.assertEqual(topic['assignee'], 'Ann')
        reported = [s[3] for s in self.comments('--bcf-history', name='told.bcf')]
        self.assertEqual(sorted(reported), ['assigned to Bob', 'her deck; assigned to Ann'])
        before = self.state()
        for name in ('now.bcf', 'told.bcf'):
            self.assertIn('0 comments added', self.take(name=name).stderr)
        self.assertEqual(self.state(), before)

    def test_one_word_for_each_status(self):
        """What was resolved and is found again is New everywhere."""
        for row in self.listed():
            self.set(row['key'], '--status', 'resolved')
        self.out('-o', 'x.xml', '-o', 'x.json', '-o', 'x.csv', name='again.bcf')
        self.assertEqual({t['status'] for t in Bcf(self.folder / 'again.bcf', self.fail).topics}, {'New'})
        xml = ElementTree.parse(self.folder / 'x.xml')
        self.assertEqual({e.get('status') for e in xml.iter('clashresult')}, {'new'})
        self.assertEqual({r['decision']['status'] for r in json.loads((self.folder / 'x.json').read_text())['results']}, {'new'})
        with open(self.folder / 'x.csv', encoding='utf-8', newline='') as lines:
            self.assertEqual({row['status'] for row in csv.DictReader(lines)}, {'new'})
        self.assertEqual({row['status'] for row in self.listed()}, {'new'})

    def test_an_untouched_file_does_not_take_decisions_back(self):
        key = self.listed()[0]['key']
        self.set(key, '--status', 'approved', '--assignee', 'Eve', '--by', 'Eve')
        before = self.state()
        reported = self.take(name='x.bcf').stderr
        self.assertNotIn('conflict', reported)
        self.assertEqual(self.state(), before)

    def test_conflicts_are_reported_and_go_by_the_rule(self):
        keys = {(a, b): key for a, b, key in self.query('SELECT a_name, b_name, key FROM clash')}
        self.edit(self.decide)
        self.set(keys['c0', 'c1'], '--status', 'reviewed', '--by', 'Eve')
        self.set(keys['c1', 'c2'], '--assignee', 'Eve')
        reported = self.take().stderr
        self.assertIn('2 conflicts', reported)
        self.assertIn('the status is another one in the project, too; that of the project stays', reported)
        rows = dict((row[0], row[1:]) for row in self.state()[0])
        self.assertEqual(rows[keys['c0', 'c1']][:2], ('reviewed', 'as agreed\nby phone'))
        self.assertEqual(rows[keys['c1', 'c2']][2], 'Eve')
        self.assertIn('that of the review holds now', self.take('--prefer', 'bcf').stderr)
        rows = dict((row[0], row[1:]) for row in self.state()[0])
        self.assertEqual(rows[keys['c0', 'c1']][0], 'approved')
        self.assertEqual(rows[keys['c1', 'c2']][2], 'Bob')

    def test_unknown_topics_and_words_are_named(self):
        def change(topic, _):
            title = topic.findtext('Title')
            if 'c0' in title:
                topic.set('Guid', '99999999-9999-4999-8999-999999999999')
                topic.set('TopicStatus', 'Approved')
            elif 'c1' in title:
                topic.set('TopicStatus', 'Whatever')
            else:
                topic.set('TopicStatus', 'closed')
        self.edit(change)
        reported = self.take().stderr
        self.assertRegex(reported, r"1 topic is about no clash of the project\n.*HIT, .*c0 / c1")
        self.assertIn("the status 'Whatever' of 1 topic means none of a clash: its own stays", reported)
        self.assertIn('1 status and', reported)
        self.assertEqual(sorted(row[1] for row in self.state()[0]), ['new', 'new', 'resolved'])

    def test_topics_without_their_description_are_known_by_their_guid(self):
        def change(topic, markup):
            topic.remove(topic.find('Description'))
            if 'c0' in topic.findtext('Title'):
                topic.set('TopicStatus', 'Approved')
        self.edit(change)
        self.assertIn('1 status and', self.take().stderr)
        self.assertEqual(sorted(row[1] for row in self.state()[0]), ['approved', 'new', 'new'])

    def test_groups_are_decided_at_once(self):
        self.out('--group-by', 'element', name='g.bcf')

        def change(topic, markup):
            if topic.findtext('Title').startswith('2 '):
                topic.set('TopicStatus', 'Reviewed')
                add_comment(markup, '11111111-1111-4111-8111-111111111111', '2026-02-03T12:00:00Z', 'Ann', 'both')
        self.edit(change, 'g.bcf')
        self.assertIn('2 statuses and 0 assignees changed, 2 comments added', self.take().stderr)
        self.assertEqual(sorted(row[1:3] for row in self.state()[0]),
                         [('active', None), ('reviewed', 'both'), ('reviewed', 'both')])
        self.out('--group-by', 'element', name='g.bcf')
        before = self.state()
        self.assertIn('0 comments added, 1 comment was there', self.take(name='g.bcf').stderr)
        self.assertEqual(self.state(), before)

    def test_topics_that_contradict_each_other_are_a_conflict(self):
        self.out('--group-by', 'element', name='g.bcf')
        rewrite(self.folder / 'x.bcf', self.folder / 'single.bcf', lambda root: root.find('Topic').set('TopicStatus', 'Approved'))
        rewrite(self.folder / 'g.bcf', self.folder / 'group.bcf', lambda root: root.find('Topic').set('TopicStatus', 'Reviewed'))
        with zipfile.ZipFile(self.folder / 'single.bcf', 'a') as both, zipfile.ZipFile(self.folder / 'group.bcf') as group:
            for name in group.namelist():
                if name.endswith('markup.bcf'):
                    both.writestr(name, group.read(name))
        reported = self.take(name='single.bcf').stderr
        self.assertIn('5 topics, 3 statuses', reported)
        self.assertIn('3 conflicts', reported)
        for clash, in self.query('SELECT id FROM clash'):
            self.assertEqual(len(self.query(f"SELECT id FROM event WHERE clash = {clash} AND after IN ('approved', 'reviewed')")), 1)

    def test_an_older_comment_is_not_that_of_the_clash(self):
        key = self.listed()[0]['key']
        self.set(key, '--comment', 'now', '--by', 'Eve')
        self.edit(lambda topic, markup: add_comment(markup, '1' * 8 + '-1111-4111-8111-111111111111', '2001-02-03T12:00:00Z',
                                                    'Ann', 'then'))
        self.assertIn('3 comments added', self.take().stderr)
        self.assertEqual(dict(self.query('SELECT key, comment FROM clashes'))[key], 'now')
        self.assertEqual([row[0] for row in self.query(f"SELECT event.comment FROM event JOIN clash ON clash.id = event.clash "
                                                       f"WHERE event.comment <> '' AND clash.key = '{key}' ORDER BY event.id")],
                         ['now', 'then'])

    def test_comments_without_a_date_are_known_again(self):
        self.edit(lambda topic, markup: add_comment(markup, '1' * 8 + '-1111-4111-8111-111111111111', 'yesterday', 'Ann', 'when?'))
        self.assertIn('3 comments added', self.take().stderr)
        time.sleep(1.1)  # the clock of the second take is another
        self.assertIn('0 comments added, 3 comments were there', self.take().stderr)

    def test_when_a_topic_was_changed_has_its_time(self):
        key = self.listed()[0]['key']
        self.set(key, '--status', 'approved', '--by', 'Eve')
        (at,), = self.query(f"SELECT decided_at FROM clash WHERE key = '{key}'")
        self.assertRegex(at, r'T\d\d:\d\d:\d\dZ$')
        for version in ('2.1', '3.0'):
            self.out('--bcf-version', version, name='now.bcf')
            topics = Bcf(self.folder / 'now.bcf', self.fail).topics
            self.assertEqual([t['modified'] for t in topics if t['status'] == 'Approved'], [(at, 'Eve')])
        # Of another zone it is the same moment.
        self.edit(lambda topic, markup: None if topic.get('TopicStatus') == 'Approved'
                  else approve(topic, '2026-02-03T01:30:00+02:00', 'Ann'), source='now.bcf')
        self.take()
        self.out(name='now.bcf')
        self.assertEqual(sorted(t['modified'] for t in Bcf(self.folder / 'now.bcf', self.fail).topics),
                         [('2026-02-02T23:30:00Z', 'Ann')] * 2 + [(at, 'Eve')])

    def test_a_date_that_is_none_is_reported_and_not_handed_on(self):
        def change(topic, markup):
            if 'c0' in topic.findtext('Title'):
                approve(topic, '2026-02-30T10:00:00Z', 'Ann')
            add_comment(markup, '1' * 8 + '-1111-4111-8111-111111111111', '2026-13-01T00:00:00', 'Ann', 'when?')
        self.edit(change)
        reported = self.take().stderr
        self.assertRegex(reported, "bcf-date-invalid, first of 4: .*the (Modified)?Date '2026-")
        with contextlib.closing(sqlite3.connect(self.folder / 'ship.strake')) as project, project:
            project.execute("UPDATE clash SET decided_at = '2026-02-30T10:00:00Z' WHERE decision = 'approved'")
            project.execute("UPDATE event SET at = 'then' WHERE comment = 'when?'")
        for version in ('2.1', '3.0'):
            reported = self.out('--bcf-version', version, name='now.bcf').stderr
            self.assertIn('4 dates of decisions and comments are none; others stand in their place', reported)
            topics = Bcf(self.folder / 'now.bcf', self.fail).topics
            self.assertEqual({t['modified'] for t in topics}, {(None, None)})
            self.assertEqual([len(t['comments']) for t in topics], [1, 1, 1])

    def test_comments_of_a_group_keep_their_guids_in_its_topic(self):
        """Each clash of the group has the comment in the project; in the topic it is one, under the GUID that it came with."""
        guid = '11111111-1111-4111-8111-111111111111'

        def change(topic, markup):
            if topic.findtext('Title').startswith('2 '):
                add_comment(markup, guid, '2026-02-03T12:00:00Z', 'Ann', 'both')

        def reword(topic, markup):
            for comment in markup.iter('Comment'):
                if comment.get('Guid') == guid:
                    comment.find('Comment').text = 'all'
                    ElementTree.SubElement(comment, 'ModifiedDate').text = '2026-02-04T10:00:00+01:00'
        stated = []
        for step, source in ((change, 'g.bcf'), (reword, 'g.bcf')):
            self.out('--group-by', 'element', name='g.bcf')
            self.edit(step, source)
            self.assertIn('2 comments added', self.take().stderr)
            self.out('--group-by', 'element', name='g.bcf')
            topics = Bcf(self.folder / 'g.bcf', self.fail).topics
            stated.append([(*c, *e) for t in topics for c, e in zip(zip(t['comment_guids'], t['comments']), t['edited'])])
        first = ('2026-02-03T12:00:00Z', 'Ann')
        self.assertEqual(stated, [[(guid, (*first, 'both'), None, None)],
                                [(guid, (*first, 'all'), '2026-02-04T09:00:00Z', 'Ann')]])
        # Alone each clash has it under another GUID, of which no two are the same, and it is known when it comes back.
        self.out(name='now.bcf')
        alone = [g for t in Bcf(self.folder / 'now.bcf', self.fail).topics for g in t['comment_guids']]
        self.assertEqual((len(alone), len(set(alone)), guid in alone), (2, 2, False))
        self.assertIn('0 comments added', self.take(name='now.bcf').stderr)

    def test_misuse(self):
        key = self.listed()[0]['key']
        for options in ([key], ['--status', 'approved'], ['--comment', 'x'], ['--group', '1'], ['--select', 'c0']):
            self.assertIn('a BCF file says', self.take(*options, name='x.bcf', exit_code=2).stderr)
        self.assertIn('no .bcf is read', self.set(key, '--prefer', 'bcf', exit_code=2).stderr)
        self.assertIn('cannot be opened', self.take(name='none.bcf', exit_code=3).stderr)

    # What comes back may be anything.

    def refused(self, content, reported):
        (self.folder / 'bad.bcf').write_bytes(content)
        before = self.state()
        self.assertRegex(self.take(name='bad.bcf', exit_code=3).stderr, reported)
        self.assertEqual(self.state(), before)

    @staticmethod
    def archive(files):
        memory = io.BytesIO()
        with zipfile.ZipFile(memory, 'w', zipfile.ZIP_DEFLATED) as archive:
            for name, content in files:
                archive.writestr(name, content)
        return memory.getvalue()

    def test_hostile_archives(self):
        version = ('bcf.version', '<Version VersionId="2.1"/>')
        self.refused(b'', 'no BCF file')
        self.refused(b'no zip at all' * 100, 'no BCF file')
        self.refused(self.archive([('a', 'b')]), r'no bcf\.version')
        self.refused(self.archive([('bcf.version', '<Version VersionId="1.0"/>')]), "version '1.0' is not read")
        self.refused(self.archive([('bcf.version', '<!DOCTYPE x [<!ENTITY e "2.1">]><Version VersionId="&e;"/>')]), 'is not read')
        bomb = self.archive([version, *((f'{i:08}-0000-4000-8000-000000000000/markup.bcf', b' ' * (17 << 20)) for i in range(3))])
        (self.folder / 'bomb.bcf').write_bytes(bomb)
        reported = self.take(name='bomb.bcf').stderr
        self.assertEqual(reported.count('unpacks to more than it may'), 3)
        many = self.archive([version, *((f'{i:08}-0000-4000-8000-000000000000/markup.bcf', b' ' * (15 << 20)) for i in range(40))])
        self.refused(many, '512 MiB')
        refused = self.archive([version, *((f'{i:08}-0000-4000-8000-000000000000/markup.bcf', b' ' * (17 << 20)) for i in range(40))])
        self.refused(refused, '512 MiB')
        names = self.archive([version, ('../../../tmp/strake-escape/markup.bcf', '<Markup/>'), ('/etc/markup.bcf', '<Markup/>'),
                              ('C:\\markup.bcf', '<Markup/>')])
        (self.folder / 'names.bcf').write_bytes(names)
        self.assertEqual(self.take(name='names.bcf').stderr.count('there is no topic with a GUID'), 3)
        markup = '<Markup><Topic Guid="{}" TopicStatus="Approved"><Title>x</Title></Topic></Markup>'
        guid = '00000000-0000-4000-8000-000000000000'
        self.refused(self.archive([version, ('a/markup.bcf', markup.format(guid)), ('b/markup.bcf', markup.format(guid.upper()))]),
                     'two topics have the GUID')
        twice = self.archive([version, ('a/markup.bcf', markup.format(guid)), ('b/markup.bcf', markup.format(guid))])
        self.refused(twice.replace(b'b/markup', b'a/markup'), 'two files of this name')
        deep = '<Markup>' + '<a>' * 200_000 + '</a>' * 200_000 + '</Markup>'
        (self.folder / 'deep.bcf').write_bytes(self.archive([version, ('a/markup.bcf', deep)]))
        self.assertIn('there is no topic with a GUID', self.take(name='deep.bcf').stderr)
        sealed = bytearray(self.archive([version, ('a/markup.bcf', markup.format(guid))]))
        for mark, flags in ((b'PK\x03\x04', 6), (b'PK\x01\x02', 8)):
            at = sealed.rfind(mark)
            sealed[at + flags] |= 1
        (self.folder / 'sealed.bcf').write_bytes(bytes(sealed))
        self.assertIn('encrypted', self.take(name='sealed.bcf').stderr)

    @unittest.skipUnless('STRAKE_DATA' in os.environ, 'no real files')
    def test_files_of_others_are_read(self):
        """Those of buildingSMART and of others: what is of another version is refused, and nothing changes."""
        before, read = self.state(), 0
        for path in sorted(Path(os.environ['STRAKE_DATA'], 'bcf').rglob('*.bcf*')):
            done = self.run_strake('clash', 'set', '-p', 'ship.strake', '--bcf', path)
            if done.returncode == 3:
                self.assertRegex(done.stderr, r"is not read|no bcf\.version|no BCF file", path)
            else:
                self.assertEqual(done.returncode, 0, done.stderr)
                self.assertNotIn('damaged', done.stderr)
                read += 1
        self.assertGreater(read, 20)
        self.assertEqual(self.state(), before)

    def test_damaged_files_end_well(self):
        self.edit(self.decide)
        whole = (self.folder / 'back.bcf').read_bytes()
        draw = random.Random(4)
        damaged = [whole[:draw.randrange(len(whole))] for _ in range(15)]
        for _ in range(45):
            content = bytearray(whole)
            for _ in range(draw.choice((1, 3, 30))):
                content[draw.randrange(len(content))] ^= 1 << draw.randrange(8)
            damaged.append(bytes(content))
        at = whole.rfind(b'PK\x01\x02')
        for size in (0, 1, 2**31, 2**32 - 1):
            for place in (20, 24, 42):
                damaged.append(whole[:at + place] + struct.pack('<I', size) + whole[at + place + 4:])
        keys = {row[0] for row in self.state()[0]}
        for number, content in enumerate(damaged):
            (self.folder / 'bad.bcf').write_bytes(content)
            done = self.run_strake('clash', 'set', '-p', 'ship.strake', '--bcf', 'bad.bcf', '--prefer', 'bcf')
            self.assertIn(done.returncode, (0, 3), (number, done.stderr))
        self.assertEqual({row[0] for row in self.state()[0]}, keys)
        self.done('project', 'check', 'ship.strake')


if __name__ == '__main__':
    main()
