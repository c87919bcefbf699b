#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""manual_test.py STRAKE: manual pages say what --help says."""
import re
import shutil
import subprocess

from scenario import VERBS, Scenario, main


class Manual(Scenario):
    def test_a_page_has_every_option_of_its_verb(self):
        for verb in VERBS:
            with self.subTest(verb=verb):
                page = self.text('man', *verb)
                self.assertTrue(page.startswith('.TH STRAKE'))
                plain = page.replace('\\-', '-').replace('\\fB', '').replace('\\fR', '')
                for option in self.options(verb):
                    self.assertIn(option, plain)

    def test_pages_are_sound(self):
        if not shutil.which('groff'):
            self.skipTest('no groff')
        for verb in VERBS:
            with self.subTest(verb=verb):
                done = subprocess.run(['groff', '-man', '-Tascii', '-ww', '-z'], input=self.text('man', *verb),
                                      capture_output=True, text=True, timeout=60)
                self.assertEqual(done.stderr, '')

    def test_every_verb_has_a_page(self):
        """The list of them, which the build installs, too, is that of the program."""
        def verbs(path):
            page = self.text('man', *path)
            below = re.findall(r'^\\fBstrake([a-z\\-]*)\\fR\(1\)$', page, re.MULTILINE)
            found = [path]
            for name in below:
                words = name.replace('\\-', ' ').split()
                found += verbs(words)
            return found
        self.assertEqual(sorted(verbs([])), sorted(VERBS))

    def test_a_page_and_help_report_one_command_line(self):
        for verb in VERBS:
            with self.subTest(verb=verb):
                reported = re.search('^Usage: (.*)$', self.text(*verb, '--help'), re.MULTILINE)[1]
                page = self.text('man', *verb).split('.SH SYNOPSIS\n')[1].split('\n')[0]
                self.assertEqual(page.replace('\\fB', '').replace('\\fR', '').replace('\\-', '-'),
                                 reported.replace('SUBCOMMAND', 'VERB'))

    def test_characters_that_shells_know_stay_what_they_are(self):
        """troff makes typography of some, which cannot be pasted."""
        self.assertIn('\\(ti/.local', self.text('man', 'completion'))
        for verb in VERBS:
            with self.subTest(verb=verb):
                self.assertNotRegex(self.text('man', *verb), "[~^'`]")

    def test_an_empty_verb(self):
        self.assertIn('VERB: the value is empty', self.run_strake('man', '').stderr)
        self.assertIn('NEW: the value is empty', self.run_strake('clash', 'diff', 'a.json', '').stderr)

    def test_what_there_is_not(self):
        done = self.run_strake('man', 'clash', 'dance')
        self.assertEqual(done.returncode, 2)
        self.assertIn("'strake clash' has no verb 'dance'", done.stderr)
        self.assertEqual(self.run_strake('completion', 'tcsh').returncode, 2)


if __name__ == '__main__':
    main()
