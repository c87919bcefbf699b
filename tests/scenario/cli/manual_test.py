#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""manual_test.py STRAKE: manual pages and completions say what --help says."""
import re
import shutil
import subprocess

from scenario import Scenario, main

VERBS = [[], ['clash'], ['clash', 'diff'], ['draw'], ['draw', 'diff'], ['info'], ['generate'],
         ['generate', 'ship'], ['man'], ['completion']]


class Manual(Scenario):
    def text(self, *arguments):
        done = self.run_strake(*arguments)
        self.assertEqual(done.returncode, 0, done.stderr)
        return done.stdout

    def options(self, verb):
        return set(re.findall(r'^  (?:-\w,)?(--[a-z-]+)', self.text(*verb, '--help'), re.MULTILINE))

    def complete(self, *words):
        """What bash offers for the last of some words."""
        script = self.text('completion', 'bash') + \
            'COMP_WORDS=("$@"); COMP_CWORD=$(($# - 1)); _strake; printf "%s\\n" "${COMPREPLY[@]}"'
        done = subprocess.run(['bash', '-c', script, 'bash', 'strake', *words], cwd=self.folder,
                              capture_output=True, text=True, timeout=60)
        self.assertEqual((done.returncode, done.stderr), (0, ''))
        return set(done.stdout.split())

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
        """The list above, which the build installs, too, is that of the program."""
        def verbs(path):
            page = self.text('man', *path)
            below = re.findall(r'^\\fBstrake([a-z\\-]*)\\fR\(1\)$', page, re.MULTILINE)
            found = [path]
            for name in below:
                words = name.replace('\\-', ' ').split()
                found += verbs(words)
            return found
        self.assertEqual(sorted(verbs([])), sorted(VERBS))

    def test_bash_completes(self):
        (self.folder / 'ship.glb').write_bytes(b'')
        self.assertLessEqual({'clash', 'draw', 'info', 'generate', 'man', 'completion'}, self.complete(''))
        self.assertIn('diff', self.complete('clash', ''))
        self.assertIn('ship.glb', self.complete('clash', 's'))
        self.assertEqual(self.complete('clash', 'ship.glb', '--fail-on', 'h'), {'hit'})
        self.assertEqual(self.complete('clash', '--clear'), {'--clearance'})
        self.assertNotIn('--clearance', self.complete('draw', '--'))
        self.assertIn('--tolerance', self.complete('draw', 'diff', '--tol'))
        self.assertLessEqual({'bash', 'zsh', 'fish'}, self.complete('completion', ''))
        for verb in VERBS:
            with self.subTest(verb=verb):
                self.assertLessEqual(self.options(verb), self.complete(*verb, '--'))

    def test_other_shells_know_every_option(self):
        self.assertTrue(self.text('completion', 'zsh').startswith('#compdef strake\n'))
        fish = self.text('completion', 'fish')
        for verb in VERBS:
            for option in self.options(verb):
                self.assertIn(f' -l {option[2:]} ', fish)

    def test_what_there_is_not(self):
        done = self.run_strake('man', 'clash', 'dance')
        self.assertEqual(done.returncode, 2)
        self.assertIn("'strake clash' has no verb 'dance'", done.stderr)
        self.assertEqual(self.run_strake('completion', 'tcsh').returncode, 2)


if __name__ == '__main__':
    main()
