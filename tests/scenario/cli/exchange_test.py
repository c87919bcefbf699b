#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""exchange_test.py STRAKE: clash results for spreadsheets and programs of others: workbooks, XML, ifcclash, joints of pipes."""
import csv
import io
import json
import struct
import uuid
import xml.etree.ElementTree as ElementTree

from scenario import main
from row_project import RowProject
from xlsx_file import Workbook

FORMATS = ('x.xlsx', 'x.xml', 'x.ifcclash.json', 'x.joints.csv')
NAMESPACE = uuid.uuid5(uuid.NAMESPACE_URL, 'urn:strake:clash')


def ifcclash_key(a, b):
    return '-'.join(one.replace('%', '%25').replace('-', '%2D') for one in (a, b))


class Exchange(RowProject):
    def ship(self, *more, files=FORMATS):
        """Writes results of a ship; returns the document of the same run."""
        if 'ship.glb' not in self.files():
            self.text('generate', 'ship', '--objects', 300, '-o', 'ship.glb')
        outputs = [word for name in files for word in ('-o', name)]
        return json.loads(self.text('clash', 'ship.glb', '--clearance', '25mm', *more, *outputs, '--json'))

    def read(self, name):
        return (self.folder / name).read_bytes()

    def bytes_of(self, *more):
        self.ship(*more)
        return {name: self.read(name) for name in FORMATS}

    def rows(self, name):
        return list(csv.DictReader(io.StringIO(self.read(name).decode('utf-8'), newline='')))

    def test_a_workbook_has_the_numbers_of_the_document(self):
        document = self.ship('--group-by', 'element', '--columns', '@discipline', files=('x.xlsx', 'x.csv'))
        book = Workbook(self.folder / 'x.xlsx')
        self.assertEqual(list(book.sheets)[:2], ['Summary', 'Clashes'])
        self.assertEqual(book.dates, {(1980, 1, 1, 0, 0, 0)})
        rows, results = book.table('Clashes'), document['results']
        self.assertGreater(len(results), 100)
        self.assertIn('CLEARANCE_VIOLATION', {row['class'] for row in rows})
        for row, result in zip(rows, results, strict=True):
            self.assertEqual((row['key'], row['class'], row['d_mm'], row['a_id'], row['b_name'], row['relation']),
                             (result['key'], result['class'], result['d_mm'], result['a']['id'], result['b']['name'],
                              result['relation']))
            self.assertEqual([row['d_lower_mm'], row['d_upper_mm']], result['d_range_mm'])
            self.assertEqual([row[f'{axis}_mm'] for axis in 'xyz'], result['point_mm'])
            self.assertEqual(row['a_@discipline'], result['a']['attributes'].get('discipline'))
            self.assertEqual(row['status'], 'new')
        # The columns are those of CSV, with room for a decision behind them.
        heads = list(rows[0])
        plain = list(self.rows('x.csv')[0])
        self.assertEqual([head for head in heads if head not in ('status', 'by', 'date', 'comment', 'reopened')], plain)
        for row, group in zip(book.table('Groups'), document['groups']['list'], strict=True):
            self.assertEqual((row['group'], row['results'], row['class'], row['d_mm'], row['HIT']),
                             (group['id'], group['results'], group['class'], group['d_mm'], group['counts']['HIT']))
        summary = [row for row in book.sheets['Summary'] if row]
        test, counts = document['tests'][0], next(row for row in summary if row[0] == '(the only one)')
        self.assertEqual(counts[3:9], [test['objects']['a'], test['objects']['b'], test['counts']['HIT'],
                                       test['counts']['CONTACT'], test['counts']['CLEARANCE_VIOLATION'],
                                       test['counts']['ALLOWED']])
        self.assertIn(['clearance_mm', 25.0], [list(pair) for pair in zip(
            next(row for row in summary if row[0] == 'Settings of'),
            [row for row in summary if row[0] == '(the only one)'][1])])
        self.assertIn(['Clashes', float(len(results))], summary)
        self.assertIn(['Hash of the results', document['hash']], summary)

    def test_the_worst_have_pictures(self):
        document = self.ship(files=('x.xlsx',))
        worst = sorted((result for result in document['results'] if result['class'] != 'CONTACT'),
                       key=lambda result: (result['class'] != 'HIT', result['d_mm']))[:10]
        book = Workbook(self.folder / 'x.xlsx')
        rows = book.table('Pictures')
        self.assertGreater(len(rows), 2)
        self.assertEqual([(row['class'], row['d_mm']) for row in rows],
                         [(result['class'], result['d_mm']) for result in worst])
        images = [content for name, content in book.parts.items() if name.startswith('xl/media/')]
        self.assertEqual(len(images), len(rows))
        self.assertEqual(len(set(images)), len(rows))
        for image in images:
            self.assertTrue(image.startswith(b'\x89PNG\r\n'))
            self.assertEqual(struct.unpack('>II', image[16:24]), (640, 480))

    def test_xml_has_the_results_with_guids_of_their_keys(self):
        document = self.ship('--group-by', 'element', files=('x.xml',))
        test = ElementTree.fromstring(self.read('x.xml')).find('batchtest/clashtests/clashtest')
        self.assertEqual((test.get('test_type'), test.get('tolerance')), ('clearance', '25'))
        found = {}
        for result in test.iter('clashresult'):
            point = result.find('clashpoint/pos3f')
            ids = [value.text for value in result.iterfind('clashobjects/clashobject/objectattribute/value')]
            found[result.get('guid')] = (float(result.get('distance')), [float(point.get(axis)) for axis in 'xyz'], ids)
        expected = {str(uuid.uuid5(NAMESPACE, result['key'])):
                    (result['d_mm'], result['point_mm'], [result['a']['id'], result['b']['id']])
                    for result in document['results']}
        self.assertEqual(found, expected)
        self.assertEqual(test.find('summary').get('new'), str(len(expected)))
        groups = test.findall('clashresults/clashgroup')
        self.assertEqual([(group.get('name'), len(group.findall('clashresults/clashresult'))) for group in groups],
                         [(group['name'], group['results']) for group in document['groups']['list']])

    def test_ifcclash_reads_sets_of_clashes(self):
        document = self.ship(files=('x.ifcclash.json',))
        sets = json.loads(self.read('x.ifcclash.json'))
        self.assertEqual([one['mode'] for one in sets], ['intersection', 'collision', 'clearance'])
        needed = {'intersection': {'tolerance', 'check_all'}, 'collision': {'allow_touching'},
                  'clearance': {'clearance', 'check_all'}}
        found = {}
        for one in sets:
            self.assertLessEqual({'name', 'a', 'clashes'} | needed[one['mode']], one.keys())
            self.assertEqual([source['file'] for source in one['a']], ['ship.glb'])
            for key, clash in one['clashes'].items():
                self.assertEqual(set(clash), {'a_global_id', 'b_global_id', 'a_ifc_class', 'b_ifc_class', 'a_name', 'b_name',
                                              'type', 'p1', 'p2', 'distance'})
                self.assertEqual(key, ifcclash_key(clash['a_global_id'], clash['b_global_id']))
                self.assertEqual((len(clash['p1']), len(clash['p2'])), (3, 3))
                found[key] = (clash['type'], round(clash['distance'], 9))
        types = {'HIT': 'protrusion', 'CONTACT': 'collision', 'CLEARANCE_VIOLATION': 'clearance'}
        self.assertEqual(found, {ifcclash_key(result['a']['id'], result['b']['id']):
                                 (types[result['class']], round(abs(result['d_mm']) / 1000, 9))
                                 for result in document['results']})

    def test_statuses_come_from_a_file_and_from_a_project(self):
        self.done('clash', 'row.obj', '--unit', 'mm', '--decisions', 'd.csv', '--write-decisions')
        text = self.read('d.csv').decode()
        comment = 'as agreed,\n=1+1'
        decided = text.replace('new,,,', f'approved,N. N.,2026-01-09,"{comment}"', 1)
        self.assertNotEqual(text, decided)
        self.write('d.csv', decided)
        key = next(row['key'] for row in self.rows('d.csv') if row['status'] == 'approved')
        self.done('clash', '-p', 'ship.strake', '--self')
        self.set(key, '--status', 'approved', '--by', 'N. N.', '--comment', comment)
        for name, source in (('f', ['row.obj', '--unit', 'mm', '--decisions', 'd.csv']), ('p', ['-p', 'ship.strake', '--self'])):
            done = self.done('clash', *source, '-o', f'{name}.xlsx', '-o', f'{name}.xml', '--json')
            results = json.loads(done.stdout)['results']
            rows = Workbook(self.folder / f'{name}.xlsx').table('Clashes')
            self.assertEqual([(row['key'], row['status']) for row in rows],
                             [(result['key'], result['decision']['status']) for result in results])
            self.assertEqual([(row['status'], row['by'], row['comment']) for row in rows if row['key'] == key],
                             [('approved', 'N. N.', comment)])
            report = ElementTree.fromstring(self.read(f'{name}.xml'))
            self.assertEqual([body.text for body in report.iter('body')], [comment])
            summary = report.find('.//summary')
            statuses = [row['status'] for row in rows]
            for status in ('new', 'active', 'reviewed', 'approved', 'resolved'):
                self.assertEqual(summary.get(status), str(statuses.count(status)))

    def test_the_sheet_saved_as_csv_is_a_file_of_decisions(self):
        self.done('clash', 'row.obj', '--unit', 'mm', '-o', 'x.xlsx')
        heads, *rows = Workbook(self.folder / 'x.xlsx').sheets['Clashes']
        rows = [row + [None] * (len(heads) - len(row)) for row in rows]
        rows[0][heads.index('status')] = 'reviewed'
        with open(self.folder / 'd.csv', 'w', encoding='utf-8', newline='') as file:
            csv.writer(file).writerows([heads, *rows])
        done = json.loads(self.done('clash', 'row.obj', '--unit', 'mm', '--decisions', 'd.csv', '--json').stdout)
        self.assertEqual([result['decision']['status'] for result in done['results']],
                         ['reviewed'] + ['new'] * (len(rows) - 1))

    def test_joints_are_contacts_of_pipes(self):
        document = self.ship('--columns', '@system', files=('x.joints.csv', 'x.xlsx'))
        rows = self.rows('x.joints.csv')
        contacts = {result['key']: result for result in document['results'] if result['class'] == 'CONTACT'}
        self.assertGreater(len(rows), 10)
        self.assertLess(len(rows), len(contacts))
        self.assertIn('end_to_end', {row['kind'] for row in rows})
        for row in rows:
            self.assertEqual((row['a_id'], row['b_id']), tuple(contacts[row['key']][side]['id'] for side in 'ab'))
        sheet = Workbook(self.folder / 'x.xlsx').table('Joints')
        self.assertEqual([(row['key'], row['kind'], row['x_mm']) for row in sheet],
                         [(row['key'], row['kind'], float(row['x_mm'])) for row in rows])

    def test_bytes_are_the_same_for_any_number_of_threads(self):
        one = self.bytes_of('--threads', 1)
        for threads in 2, 3, 8:
            self.assertEqual(self.bytes_of('--threads', threads), one)


if __name__ == '__main__':
    main()
