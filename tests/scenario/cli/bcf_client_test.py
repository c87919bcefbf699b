#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""bcf_client_test.py STRAKE: clashes written as BCF, read, decided about and written again by bcf-client, and taken in: every
status, assignee and comment arrives, and nothing else changes. Ends with 77 where bcf-client is not installed, or where the
Python that BCF_PYTHON names does not have it."""
import json
import os
import random
import subprocess
import sys
import uuid

from bcf_project import BcfProject
from row_project import cubes
from scenario import main

# What runs with bcf-client: it reads decisions, applies them, and prints all that it read.
SCRIPT = r'''
import json, sys, uuid
from bcf.bcfxml import load
source, target, decisions = sys.argv[1:]
decisions = json.loads(decisions)
read = {}
with load(source) as file:
    three = 'v3' in type(file).__module__
    if three:
        from bcf.v3.model import Comment, TopicComments
    else:
        from bcf.v2.model import Comment
    from xsdata.models.datatype import XmlDateTime
    for guid, handler in file.topics.items():
        topic = handler.topic
        views = handler.viewpoints
        read[guid] = {'title': topic.title, 'status': topic.topic_status, 'views': len(views),
                      'pictures': [len(view.snapshot or b'') for view in views.values()],
                      'components': [len(view.visualization_info.components.selection.component) for view in views.values()]}
        decided = decisions.get(guid, {})
        topic.topic_status = decided.get('status', topic.topic_status)
        topic.assigned_to = decided.get('assignee', topic.assigned_to)
        said = [Comment(date=XmlDateTime.from_string(date), author=author, comment=text, guid=str(uuid.uuid4()))
                for date, author, text in decided.get('comments', [])]
        if three and said:
            topic.comments = TopicComments(comment=[*(topic.comments.comment if topic.comments else []), *said])
        elif said:
            handler.comments = [*handler.comments, *said]
    file.save(target)
print(json.dumps(read))
'''
PYTHON = os.environ.get('BCF_PYTHON', sys.executable)
STATUSES = ('Active', 'Reviewed', 'Approved', 'Resolved')


class BcfClient(BcfProject):
    def setUp(self):
        super().setUp()
        self.write('row.obj', cubes([(80 * i, 80 * j, 0) for i in range(7) for j in range(5)]))
        self.done('project', 'update', 'ship.strake')

    def by_client(self, source, target, decisions):
        done = subprocess.run([PYTHON, '-c', SCRIPT, source, target, json.dumps(decisions)], cwd=self.folder,
                              capture_output=True, text=True, check=False)
        self.assertEqual(done.returncode, 0, done.stderr)
        return json.loads(done.stdout)

    def test_every_decision_arrives_and_nothing_else_changes(self):
        for number, version in enumerate(('2.1', '3.0')):
            with self.subTest(version):
                self.out('--bcf-version', version, '--bcf-max-topics', 500)
                guids = self.by_client('x.bcf', 'same.bcf', {})
                self.assertGreater(len(guids), 50)
                for read in guids.values():
                    self.assertEqual((read['views'], read['components']), (1, [2]))
                    self.assertGreater(read['pictures'][0], 1000)
                before = self.state()
                self.assertIn('0 statuses and 0 assignees changed, 0 comments added', self.take(name='same.bcf').stderr)
                self.assertEqual(self.state(), before)
                draw = random.Random(7 + number)
                decisions = {}
                for guid in sorted(guids):
                    decided = decisions[guid] = {}
                    if draw.random() < .5:
                        decided['status'] = draw.choice(STATUSES)
                    if draw.random() < .5:
                        decided['assignee'] = draw.choice(('Ann', 'Bob <bob@example.com>', 'Ödön', '工藤'))
                    decided['comments'] = [(f'202{number}-01-0{n + 1}T10:00:00Z', draw.choice(('Ann', 'Bob')),
                                            draw.choice(('move it', 'a <b> & "c"', 'first line\nsecond line')))
                                           for n in range(draw.randrange(3))]
                self.by_client('x.bcf', 'back.bcf', decisions)
                self.take('--prefer', 'bcf')
                self.check(before, self.state(), decisions)

    def check(self, before, after, decisions):
        """Compares the project with what it was and what was decided."""
        reported = self.keys_by_guid()
        old = {row[0]: row for row in before[0]}
        events = after[1][len(before[1]):]
        self.assertEqual(after[1][:len(before[1])], before[1])
        stated = {key: [] for key in reported}
        ids = dict(self.query('SELECT id, key FROM clash'))
        for clash, at, who, _, _, comment in events:
            if comment and not comment.startswith('assigned to '):
                stated[ids[clash]].append((at, who, ' '.join(comment.split())))
        for key, status, comment, assignee, _ in after[0]:
            decided = decisions.get(reported[key], {})
            wanted = decided.get('status', '').lower() or old[key][1]
            self.assertEqual(status, wanted, key)
            self.assertEqual(assignee, decided.get('assignee', old[key][3]))
            comments = [(at, who, ' '.join(text.split())) for at, who, text in decided.get('comments', [])]
            self.assertEqual(stated[key], comments)
            last = comments[-1][2] if comments else old[key][2]
            self.assertEqual(' '.join(comment.split()) if comment else comment, ' '.join(last.split()) if last else last)

    def keys_by_guid(self):
        """The GUID of the topic of each clash, by the standard library."""
        return {row[0]: str(uuid.uuid5(uuid.uuid5(uuid.NAMESPACE_URL, 'urn:strake:clash'), row[0]))
                for row in self.query('SELECT key FROM clash')}


if __name__ == '__main__':
    if subprocess.run([PYTHON, '-c', 'import bcf.bcfxml'], capture_output=True, check=False).returncode != 0:
        print(f'bcf-client is not installed for {PYTHON}')
        sys.exit(77)
    main()
