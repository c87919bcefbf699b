#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""draw_diff_test.py STRAKE: two drawings of a view compared."""
import json
import re
import xml.etree.ElementTree as ET

from scenario import Scenario, cube, main


class DrawDiff(Scenario):
    def draw(self, name, at, *more):
        self.write('m.obj', cube('still', 0, (0, 0, 0), 100) + cube('moves', 1, (at, 150, 0), 60))
        done = self.run_strake('draw', 'm.obj', '--unit', 'mm', '--up-axis', 'z', '--view', 'iso', '-o', name, *more)
        self.assertEqual(done.returncode, 0, done.stderr)

    def diff(self, *arguments, exit_code=0):
        done = self.run_strake('draw', 'diff', 'old.json', 'new.json', *arguments)
        self.assertEqual(done.returncode, exit_code, done.stderr)
        return done

    def test_what_moved_is_reported_and_drawn(self):
        self.draw('old.json', 0)
        self.draw('new.json', 25)
        done = self.diff('-o', 'd.json', '-o', 'd.svg', '--fail-on', 'visible', exit_code=1)
        reported = json.loads((self.folder / 'd.json').read_text(encoding='utf-8'))
        self.assertIn('moves', {o['id'] for o in reported['objects']})
        self.assertGreater(reported['counts']['new']['lines'], 8)
        self.assertGreater(reported['counts']['gone']['lines'], 8)
        for change in ('new', 'gone', 'changed'):
            self.assertEqual(sum(line['change'] == change for line in reported['lines']), reported['counts'][change]['lines'])
            self.assertRegex(done.stdout, rf"{reported['counts'][change]['lines']} {change} \(")
        svg = (self.folder / 'd.svg').read_text(encoding='utf-8')
        ET.fromstring(svg)
        for layer in ('same-visible', 'gone-visible', 'new-visible'):
            self.assertIn(f'id="{layer}"', svg)
        same = json.loads(self.diff('--json').stdout)
        self.assertEqual(same, reported)
        for threads in (1, 3, 8):
            self.diff('-o', 'e.svg', '--threads', threads)
            self.assertEqual((self.folder / 'e.svg').read_text(encoding='utf-8'), svg)

    def test_another_sheet_is_the_same_drawing(self):
        self.draw('old.json', 0)
        self.draw('new.json', 0, '--scale', '1:3')
        self.assertRegex(self.diff('--fail-on', 'any', '-o', 'd.svg').stdout, r'\n0 new .* 0 gone .* 0 changed ')
        done = self.run_strake('draw', 'diff', 'old.json', 'old.json', '--fail-on', 'any')
        self.assertEqual(done.returncode, 0)
        # What is gone lies where it would be at the newer scale: on its sheet.
        self.draw('new.json', 40, '--scale', '1:3')
        self.diff('-o', 'd.svg')
        svg = (self.folder / 'd.svg').read_text(encoding='utf-8')
        self.assertIn('viewBox="0.000 0.000 420.000 309.000"', svg)
        xs = [float(x) for x in re.findall(r'M(-?[\d.]+) ', svg.split('id="gone-visible"')[1].split('</g>')[0])]
        self.assertTrue(all(140 < x < 280 for x in xs), xs)

    def test_hidden_lines_and_settings(self):
        self.draw('old.json', 0)
        self.draw('new.json', 0, '--stage', 'none')
        reported = json.loads(self.diff('--json', '--fail-on', 'visible', exit_code=1).stdout)
        self.assertEqual(reported['settings'], [{'setting': 'settings.stage', 'before': '"global"', 'after': '"none"'}])
        self.assertGreater(reported['counts']['changed']['lines'], 0)
        self.assertEqual(reported['counts']['gone']['lines'] + reported['counts']['new']['lines'], 0)
        self.assertTrue(all(line['was']['state'].startswith('hidden') for line in reported['lines']))

    def test_what_is_no_drawing_is_refused(self):
        self.draw('old.json', 0)
        self.draw('side.json', 0)
        text = (self.folder / 'old.json').read_text(encoding='utf-8')
        self.write('cut.json', text[:len(text) // 2])
        self.write('huge.json', text.replace('"a_mm":[', '"a_mm":[1e300,', 1))
        self.write('nan.json', text.replace('"a_mm":[', '"a_mm":[NaN,', 1))
        self.write('short.json', text[:text.rindex(',\n{')] + ']}\n')
        self.write('clash.json', '{"schema_version": 2, "tests": []}')
        self.write('empty.json', '')
        done = self.run_strake('draw', 'm.obj', '--unit', 'mm', '--up-axis', 'z', '--view', 'top', '-o', 'top.json')
        self.assertEqual(done.returncode, 0, done.stderr)
        for name, words in (('cut.json', 'ends too soon'), ('huge.json', 'is no point'), ('nan.json', 'no JSON'),
                            ('short.json', 'counts'), ('clash.json', 'says version 2'), ('empty.json', 'ends too soon'),
                            ('m.obj', 'no JSON'), ('absent.json', 'there is no such file'), ('.', 'is a folder'),
                            ('top.json', 'view.direction')):
            done = self.run_strake('draw', 'diff', 'old.json', name)
            self.assertEqual(done.returncode, 3, (name, done.stderr))
            self.assertIn(words, done.stderr, name)
            self.assertIn(name, done.stderr, name)
            self.assertEqual(done.stdout, '')
        for wrong in (['old.json'], ['old.json', 'old.json', '-o', 'old.json'], ['old.json', 'old.json', '-o', 'x.png'],
                      ['old.json', 'old.json', '--tolerance', '-1mm'], ['old.json', 'old.json', '--tolerance', 'nan']):
            self.assertEqual(self.run_strake('draw', 'diff', *wrong).returncode, 2, wrong)


if __name__ == '__main__':
    main()
