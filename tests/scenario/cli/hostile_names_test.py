#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""hostile_names_test.py STRAKE: names of objects and files that command terminals, break lines, turn writing round or are a
megabyte long: what is told stays lines of text, and files stay valid."""
import csv
import io
import json
import os
import unicodedata
import xml.etree.ElementTree as ElementTree

from scenario import Scenario, gltf, main
from xlsx_file import Workbook

csv.field_size_limit(10_000_000)
PLANTED = 'PLANTED LINE'
NAMES = [f'line\n{PLANTED}', f'return\r{PLANTED}', f'separators\u2028{PLANTED}\u2029{PLANTED}\x85{PLANTED}', '\x1b[2J\x1b]0;title\x07',
         'csi\x9b2J', 'nul\x00byte', 'bell\x07\x08\x0b\x0c', '\u202egpj.exe\u202c', '\u2066isolated\u2069', '\u200f\u061c',
         '</script><script>alert(1)</script>', '<!-- ]]> &lt; & " \' -->', '"quoted",\'=cmd|\' /C calc\'!A0', '=1+1', '-n', '{}%s$(x)`x`',
         '\ufeffmark', '\ufffe\uffff', '', ' ', '\t', '../../etc/passwd', 'C:\\con', '\U0001f6a2']
LONG = ['ä' * 30_000, 'long ' * 200_000]
FILES = [f'line\n{PLANTED}.gltf', 'esc\x1b[2J.gltf', '\u202eftlg.gltf', '<script>.gltf', '-o.gltf', 'tab\t.gltf', "it's, \"so\".gltf"]
# Nothing that is told is longer: a megabyte of a name tells nobody more than its beginning.
LONGEST_LINE = 4000


def may_be_shown(character):
    return character == '\n' or unicodedata.category(character) not in ('Cc', 'Cs', 'Zl', 'Zp') and \
        character not in '\u202a\u202b\u202c\u202d\u202e\u2066\u2067\u2068\u2069\u200e\u200f\u061c'


class HostileNames(Scenario):
    def setUp(self):
        super().setUp()
        for number, file in enumerate(FILES):
            children = [(name, {name: name, 'TYPE': name}, .05 * (number + i), []) for i, name in enumerate(self.names(file))]
            (self.folder / file).write_text(gltf((NAMES[number], {}, None, children)), encoding='utf-8')
        self.models = ['./' + file for file in FILES]

    @staticmethod
    def names(file):
        return NAMES + LONG if file == FILES[0] else NAMES

    def reported(self, *command, code=(0,)):
        done = self.run_strake(*command, encoding='utf-8', errors='surrogateescape')
        self.assertIn(done.returncode, code, (command, done.stderr[-2000:]))
        for stream in (done.stdout, done.stderr):
            bad = {character for character in stream if not may_be_shown(character)}
            self.assertFalse(bad, command)
            for line in stream.split('\n'):
                self.assertFalse(line.startswith(PLANTED), command)
                self.assertLess(len(line), LONGEST_LINE, (command, line[:200]))
        return done.stdout

    def check_file(self, name):
        content = (self.folder / name).read_bytes()
        if name.endswith('.json'):
            json.loads(content.decode())
        elif name.endswith('.csv'):
            rows = list(csv.reader(io.StringIO(content.decode(), newline=''), strict=True))
            self.assertEqual({len(row) for row in rows}, {len(rows[0])}, name)
        elif name.endswith('.svg') or name.endswith('.xml'):
            ElementTree.fromstring(content)
        elif name.endswith('.xlsx'):
            # That there is no formula the reader asserts; a name is what it is, but for what XML cannot have.
            names = {row['a_name'] for row in Workbook(self.folder / name).table('Clashes')}
            self.assertLessEqual({'=1+1', '-n', '{}%s$(x)`x`', '<!-- ]]> &lt; & " \' -->'}, names)
            self.assertEqual(max(len(name or '') for name in names), 32_767)
        elif name.endswith('.dxf'):
            lines = content.decode().split('\n')
            self.assertEqual([line for line in lines[:-1:2] if not line.isdecimal()], [], name)

    def check_json(self, *command):
        done = self.run_strake(*command, '--json', encoding='utf-8')
        self.assertEqual(done.returncode, 0, done.stderr[-2000:])
        json.loads(done.stdout)

    def test_models(self):
        self.reported('info', *self.models)
        self.reported('info', *self.models, '--objects', 200, '--attributes')
        self.check_json('info', *self.models, '--objects', 200, '--attributes')
        for more in ([], ['--group-by', 'element'], ['--group-by', 'assembly'], ['--group-by', 'files'], ['--self']):
            self.reported('clash', *self.models, '--stats', *more, '-o', 'c.json', '-o', 'c.csv', '--log-pairs', 'log.csv')
            for name in ('c.json', 'c.csv', 'log.csv'):
                self.check_file(name)
        exchanged = ('c.xlsx', 'c.xml', 'c.ifcclash.json', 'c.joints.csv')
        self.reported('clash', *self.models, '--group-by', 'files', '--columns', '@TYPE', *(w for n in exchanged for w in ('-o', n)))
        for name in exchanged:
            self.check_file(name)
        self.reported('clash', *self.models[:3], '--decisions', 'd.csv', '--write-decisions', '-o', 'old.json')
        self.reported('clash', *self.models[:3], '--decisions', 'd.csv', '--write-decisions')
        self.check_file('d.csv')
        self.reported('clash', 'diff', 'old.json', 'c.json', '-o', 'diff.json')
        self.check_file('diff.json')
        self.reported('clash', *self.models, '--a', f'name = "{PLANTED}*"', code=(0, 2))

    def test_drawings(self):
        self.reported('draw', *self.models, '--title', 'plain', '-o', 'd.svg', '-o', 'd.dxf', '-o', 'd.json', '-o', 'd.view',
                  '--stats')
        self.reported('draw', *self.models[:2], '-o', 'e.view')
        self.reported('draw', 'diff', 'd.view', 'e.view', '-o', 'diff.svg', '-o', 'diff.json')
        self.write('s.toml', '[[view]]\ndirection = "top"\n[[tag]]\nselect = "name = \'*\'"\ntext = "{name}"\n')
        self.reported('draw', *self.models[:2], '--sheet', 's.toml', '-o', 's.svg', code=(0, 3))
        for name in ('d.svg', 'd.dxf', 'd.json', 'diff.svg', 'diff.json'):
            self.check_file(name)

    def test_projects(self):
        self.reported('project', 'new', 'p.strake', *self.models[:-1])
        self.reported('project', 'add', 'p.strake', self.models[-1])
        self.reported('project', 'info', 'p.strake')
        self.reported('clash', '-p', 'p.strake', '--self', '-o', 'c.json')
        self.reported('draw', '-p', 'p.strake', '--save', 'top', '--view', 'top', '-o', 'v.svg')
        self.reported('clash', 'set', '-p', 'p.strake', '--select', "name = '*'", '--status', 'reviewed', '--comment', NAMES[0],
                  '--assignee', NAMES[3], '--by', NAMES[7])
        for what in ('files', 'shapes', 'revisions', 'tests', 'runs', 'clashes', 'views'):
            self.reported('project', 'list', 'p.strake', what, '--rows', 0)
            self.check_json('project', 'list', 'p.strake', what)
        for verb in (['clash', 'list'], ['clash', 'history']):
            self.reported(*verb, '-p', 'p.strake')
            self.reported(*verb, '-p', 'p.strake', '-o', 'l.csv', '-o', 'l.json')
            self.check_file('l.csv')
            self.check_file('l.json')
        key = json.loads((self.folder / 'l.json').read_text()) and next(
            row['key'] for row in json.loads(self.run_strake('clash', 'list', '-p', 'p.strake', '--json').stdout)['clashes'])
        self.reported('clash', 'history', '-p', 'p.strake', key)
        (self.folder / FILES[0]).write_text(gltf(('other', {}, None, [(name + '2', {}, .1, []) for name in NAMES])),
                                            encoding='utf-8')
        self.reported('project', 'update', 'p.strake', '-o', 'u.json', '-o', 'u.csv')
        self.check_file('u.json')
        self.check_file('u.csv')
        self.reported('clash', '-p', 'p.strake', '--self')
        self.reported('project', 'check', 'p.strake')
        self.reported('project', 'export', 'p.strake', '-o', 'x.glb', '-o', 'x.obj', '-o', 'x.csv')
        self.check_file('x.csv')
        count = len(NAMES) * len(FILES)
        for name in ('x.glb', 'x.obj'):
            self.assertIn(f'  objects     {count}\n', self.reported('info', name), name)
        for file in FILES:
            self.reported('project', 'remove', 'p.strake', '--', file)

    def test_names_of_outputs(self):
        for name in (*FILES, b'no\xffutf-8'):
            out = os.fsdecode(name).removesuffix('.gltf') + '.svg'
            self.reported('draw', self.models[3], '--stats', '-o', './' + out)
            done = self.run_strake('draw', self.models[3], '--stats', '--json', '-o', './' + out)
            self.assertEqual(done.returncode, 0, done.stderr)
            json.loads(done.stderr.split('\n')[-2])

    def test_errors_quote_what_can_be_shown(self):
        for name in NAMES:
            if '\x00' in name:
                continue  # no argument can be such a text
            for command in (['info', './' + name], ['clash', './' + name], ['draw', self.models[0], '-o', name],
                            ['clash', self.models[0], '--a', name], ['project', 'list', './' + name],
                            ['clash', self.models[0], '--clearance', name], ['draw', self.models[0], '--view', name], [name],
                            ['clash', 'set', '-p', 'p.strake', name], ['rules', 'show', name], ['help', name]):
                self.reported(*command, code=(0, 2, 3))


if __name__ == '__main__':
    main()
