#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""clash_output_test.py STRAKE: what of a clash result is written, and in what form."""
import csv
import io
import json

from scenario import Scenario, cube, main


class ClashOutput(Scenario):
    def ship(self):
        self.text('generate', 'ship', '--objects', 300, '-o', 'ship.glb')
        return ['clash', 'ship.glb', '--clearance', '25mm']

    def read(self, name):
        return (self.folder / name).read_bytes()

    def rows(self, name, **form):
        text = self.read(name).decode('utf-8-sig')
        return list(csv.DictReader(io.StringIO(text), **form))

    def test_columns_are_attributes_of_both(self):
        run = self.ship()
        self.text(*run, '-o', 'plain.csv', '-o', 'plain.json')
        self.text(*run, '--columns', '@system, @discipline', '-o', 'x.csv', '-o', 'x.json')
        header = self.read('x.csv').split(b'\r\n', 1)[0].decode().split(',')
        self.assertEqual(header[-4:], ['a_@system', 'b_@system', 'a_@discipline', 'b_@discipline'])
        rows, plain = self.rows('x.csv'), self.rows('plain.csv')
        self.assertEqual([{k: row[k] for k in plain[0]} for row in rows], plain)
        results = json.loads(self.read('x.json'))['results']
        self.assertGreater(len(results), 100)
        for row, result in zip(rows, results, strict=True):
            for side in 'a', 'b':
                of = result[side].pop('attributes')
                self.assertEqual(list(of), [name for name in ('system', 'discipline') if row[f'{side}_@{name}']])
                self.assertEqual([of.get(name, '') for name in ('system', 'discipline')],
                                 [row[f'{side}_@system'], row[f'{side}_@discipline']])
        self.assertEqual(results, json.loads(self.read('plain.json'))['results'])
        self.assertIn('PIPING', {row['a_@discipline'] for row in rows})
        counts = json.loads(self.text('clash', 'diff', 'plain.json', 'x.json', '--json'))['counts']
        self.assertEqual((counts['same'], sum(counts.values())), (len(rows), len(rows)))

    def test_a_column_that_nothing_states_is_reported_with_names_like_it(self):
        run = [*self.ship(), '--columns', '@sytem,@Insulation', '--json']
        done = self.run_strake(*run)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn('warning column-not-stated: --columns: no object states @sytem; spelt alike: @system\n',
                      done.stderr)
        self.assertIn('no object states @Insulation; there are @', done.stderr)
        messages = [m for m in json.loads(done.stdout)['messages'] if m['code'] == 'column-not-stated']
        self.assertEqual([m['where'] for m in messages], ['--columns'] * 2)

    def test_csv_opens_in_a_spreadsheet(self):
        run = [*self.ship(), '--class', 'hit']
        self.text(*run, '-o', 'standard.csv')
        self.text(*run, '--csv', 'standard', '-o', 'also.csv')
        self.text(*run, '--csv', 'excel', '-o', 'excel.csv', '--log-pairs', 'log.csv')
        self.text(*run, '--csv', 'excel-comma', '-o', 'comma.csv')
        self.assertEqual(self.read('also.csv'), self.read('standard.csv'))
        self.assertEqual(self.read('excel.csv'), b'\xef\xbb\xbf' + self.read('standard.csv'))
        self.assertTrue(self.read('log.csv').startswith(b'\xef\xbb\xbftest,'))
        self.assertTrue(self.read('comma.csv').startswith(b'\xef\xbb\xbfa_id;'))
        numbers = {name for name in self.rows('standard.csv')[0] if name.endswith('_mm') or name.startswith('away')}
        for row, standard in zip(self.rows('comma.csv', delimiter=';'), self.rows('standard.csv'), strict=True):
            self.assertEqual(row, {k: v.replace('.', ',') if k in numbers else v for k, v in standard.items()})
        self.assertTrue(any(',' in row[name] for name in numbers for row in self.rows('comma.csv', delimiter=';')))

    def test_classes_limit_what_is_written_and_not_what_is_counted(self):
        run = self.ship()
        self.text(*run, '-o', 'all.json')
        table = self.text(*run, '--class', 'hit, clearance', '-o', 'some.json', '-o', 'some.csv')
        whole, some = json.loads(self.read('all.json')), json.loads(self.read('some.json'))
        kept = [r for r in whole['results'] if r['class'] != 'CONTACT' or r.get('may_be') == 'HIT']
        self.assertEqual(some['results'], kept)
        self.assertEqual(some.pop('classes'), ['HIT', 'CLEARANCE_VIOLATION'])
        self.assertEqual({**some, 'results': 0}, {**whole, 'results': 0})
        self.assertEqual(len(self.rows('some.csv')), len(kept))
        self.assertNotIn('CONTACT', table)
        contacts = whole['tests'][0]['counts']['CONTACT']
        self.assertIn(f'{contacts} contacts ({contacts} left out by class)', table)
        done = self.run_strake('clash', 'diff', 'all.json', 'some.json')
        self.assertEqual(done.returncode, 3)
        self.assertIn('--class', done.stderr)

    def test_fail_on_goes_by_what_is_left_out_too(self):
        self.two_files()
        run = ['clash', 'a.obj', '--unit', 'mm', '--fail-on', 'hit']
        self.assertEqual(self.run_strake(*run).returncode, 1)
        self.assertEqual(self.run_strake(*run, '--class', 'contact').returncode, 1)

    def test_groups_are_of_the_classes_that_are_written(self):
        grouped = [*self.ship(), '--group-by', 'element', '--json', '--class']
        hits = json.loads(self.text(*grouped, 'hit'))
        self.assertGreater(len(hits['groups']['list']), 0)
        self.assertEqual({g['class'] for g in hits['groups']['list']}, {'HIT'})
        self.assertEqual(sum(g['results'] for g in hits['groups']['list']), len(hits['results']))

    def test_where_most_hits_lie_is_reported(self):
        for name, x in (('a', 0), ('b', 50)):
            self.write(f'{name}.obj', ''.join(cube(f'{name}{n}', n, (x, 0, 1000 * n), 100) for n in range(25)))
        self.write('c.obj', cube('c0', 0, (-50, 0, 0), 100))
        files = ['clash', 'a.obj', 'b.obj', 'c.obj', '--unit', 'mm', '--up-axis', 'z']
        hint = '25 of 26 hits lie between a.obj and b.obj: --group-by assembly makes them one line\n'
        done = self.run_strake(*files)
        self.assertTrue(done.stderr.endswith(hint), done.stderr)
        grouped = self.run_strake(*files, '--group-by', 'assembly')
        self.assertNotIn('makes them one line', grouped.stderr)
        self.assertRegex(grouped.stdout, r'\nHIT +-50\.000 +25 +24\.0 .* a\.obj and b\.obj\n')
        split = self.text(*files, '--group-by', 'assembly', '--group-distance', '500mm', '--class', 'hit')
        self.assertIn('… and 6 groups more\n', split)
        for quiet in (['--quiet'], ['--json'], ['--class', 'contact']):
            self.assertNotIn('makes them one line', self.run_strake(*files, *quiet).stderr)

    def test_hits_between_parts_of_one_assembly_are_reported(self):
        files = []
        for name, y in (('a', 0), ('b', 5000), ('c', 10000), ('d', 15000), ('e', 20000)):
            files.append(self.write(f'{name}.obj', ''.join(cube(f'{name}{n}', n, (50 * n, y, 0), 100) for n in range(6))))
        done = self.run_strake('clash', *files, '--self', '--unit', 'mm', '--up-axis', 'z')
        self.assertIn('25 of 25 hits lie between parts of one assembly: ', done.stderr)

    def test_top_is_the_number_of_rows(self):
        run = [*self.ship(), '--class', 'contact']
        for rows in 1, 7, 30:
            lines = self.text(*run, '--top', rows).split('\n')
            self.assertEqual(sum(line.startswith('CONTACT') for line in lines), rows)

    def test_what_is_wrong_with_the_options_is_stated(self):
        self.write('a.obj', cube('a', 0, (0, 0, 0), 100))
        for options, stated in ((['--columns', 'Tag', '-o', 'x.csv'], "--columns: 'Tag' is no column"),
                              (['--columns', '@Tag,', '-o', 'x.csv'], "--columns: '' is no column"),
                              (['--columns', '@A,@B,@A', '-o', 'x.csv'], "'@A' stands there twice"),
                              (['--columns', '@Tag'], 'files of results only'),
                              (['--columns', '@Tag', '--log-pairs', 'x.csv'], 'files of results only'),
                              (['--class', 'hits'], "'hits' is no class"),
                              (['--class', 'hit', '--group-by', 'element', '--group-contacts'], 'contact to --class'),
                              (['--csv', 'excel'], 'no .csv is written'),
                              (['--csv', 'xlsx', '-o', 'x.csv'], 'standard|excel|excel-comma'),
                              (['--top', '1.5'], "'1.5' is no whole number"),
                              (['--top', '5', '--json'], 'no table with --json')):
            with self.subTest(options):
                done = self.run_strake('clash', 'a.obj', *options)
                self.assertEqual((done.returncode, done.stdout), (2, ''))
                self.assertIn(stated, done.stderr)
        self.assertEqual(self.files(), ['a.obj'])


if __name__ == '__main__':
    main()
