#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""completion_test.py STRAKE: what bash, zsh and fish offer for command lines, asked of these shells."""
import os
import pty
import re
import select
import shutil
import subprocess
import tempfile
import time
from pathlib import Path

from scenario import VERBS, Scenario, main

PROGRAM_VERBS = {'clash', 'draw', 'info', 'project', 'rules', 'cache', 'report', 'view', 'convert', 'evaluate', 'generate', 'help', 'man', 'completion'}


class Completion:
    """What every shell must offer; `offers` asks one of them about a command line up to the cursor."""

    def setUp(self):
        super().setUp()
        if not shutil.which(self.SHELL):
            self.skipTest(f'no {self.SHELL}')
        for name in ('ship.glb', 'hull plan.glb', 'diff', 'hit'):
            (self.folder / name).write_bytes(b'')

    def test_verbs_and_no_files_where_only_a_verb_can_stand(self):
        self.assertEqual(self.offers('strake '), PROGRAM_VERBS)
        self.assertEqual(self.offers('strake generate '), {'ship'})
        self.assertEqual(self.offers('strake completion '), {'bash', 'zsh', 'fish'})
        self.assertEqual(self.offers('strake rules '), {'list', 'show'})
        self.assertEqual(self.offers('strake rules show '), {'plant', 'ship', 'building'})
        self.assertEqual(self.offers('strake cl'), {'clash'})

    def test_files_where_files_can_stand(self):
        self.assertLessEqual({'ship.glb', 'diff'}, self.offers('strake clash '))
        self.assertEqual(self.offers('strake clash s'), {'ship.glb', 'set'})
        self.assertEqual(self.offers('strake clash diff s'), {'ship.glb'})
        self.assertEqual(self.offers('strake info h'), {'hull plan.glb', 'hit'})
        self.assertEqual(self.offers('strake clash ship.glb --output s'), {'ship.glb'})
        self.assertEqual(self.offers('strake generate ship '), set())

    def test_verbs_of_the_manual(self):
        self.assertEqual(self.offers('strake man '), PROGRAM_VERBS)
        self.assertEqual(self.offers('strake man clash '), {'diff', 'set', 'list', 'history'})
        self.assertEqual(self.offers('strake man clash diff '), set())
        self.assertEqual(self.offers('strake help '), PROGRAM_VERBS)
        self.assertEqual(self.offers('strake help clash '), {'diff', 'set', 'list', 'history'})

    def test_values_of_options(self):
        words = self.words_of('clash', '--fail-on')
        self.assertEqual(self.offers('strake clash --fail-on '), words)
        self.assertEqual(self.offers('strake clash --fail-on h'), {'hit'})
        self.assertEqual(self.values_behind_equals('strake clash --fail-on='), words)
        self.assertEqual(self.values_behind_equals('strake clash --fail-on=h'), {'hit'})
        self.assertEqual(self.values_behind_equals('strake clash --output=s'), {'ship.glb'})
        self.assertEqual(self.offers('strake clash diff --fail-on '), self.words_of('clash diff', '--fail-on'))

    def test_values_that_are_no_files(self):
        self.assertEqual(self.offers('strake info --unit '), set())
        self.assertEqual(self.offers('strake info --threads '), set())
        self.assertEqual(self.offers('strake info --up-axis '), {'x', 'y', 'z'})

    def test_a_value_with_the_name_of_a_verb_leads_nowhere(self):
        self.assertIn('--clearance', self.offers('strake clash -o diff --clear'))
        self.assertIn('--clearance', self.offers('strake clash --output diff --clear'))
        self.assertIn('--clearance', self.offers('strake clash --output=diff --clear'))
        self.assertEqual(self.offers('strake draw diff --clear'), set())

    def test_every_option_of_every_verb(self):
        for verb in VERBS:
            with self.subTest(verb=verb):
                self.assertEqual(self.offers(' '.join(['strake', *verb, '--'])), self.options(verb))

    def words_of(self, verb, option):
        """What --help says that the value may be."""
        found = re.search(rf'^ *{option} ([a-z_|-]+)(?: |$)', self.text(*verb.split(), '--help'), re.MULTILINE)
        return set(found[1].split('|'))

    def values_behind_equals(self, line):
        """Some shells offer the value, others the option with it."""
        return {offered.split('=', 1)[-1] for offered in self.offers(line)}


class Bash(Completion, Scenario):
    SHELL = 'bash'
    # Readline's words: = is one.
    BREAKS = r'=|(?:\\.|[^\s=])+|(?<= )$'

    def completions(self, *words, before=''):
        script = before + self.text('completion', 'bash') + \
            'COMP_WORDS=("$@"); COMP_CWORD=$(($# - 1)); _strake; ((${#COMPREPLY[@]} == 0)) || printf "%s\\n" "${COMPREPLY[@]}"'
        done = subprocess.run(['bash', '-c', script, 'bash', *words], cwd=self.folder,
                              capture_output=True, text=True, timeout=60, check=False)
        self.assertEqual((done.returncode, done.stderr), (0, ''))
        return set(done.stdout.splitlines())

    def offers(self, line):
        return self.completions(*re.findall(self.BREAKS, line))

    def test_old_bash(self):
        """What bash 3 of macOS lacks is not called."""
        self.assertNotRegex(self.text('completion', 'bash'), r'\bmapfile\b|\breadarray\b|\bdeclare -A\b|\blocal -n\b')
        self.assertEqual(self.completions('strake', 'clash', 's', before='enable -n compopt mapfile\n'), {'set', 'ship.glb'})

    def test_equals_within_a_word(self):
        """As with COMP_WORDBREAKS that lacks it."""
        self.assertEqual(self.completions('strake', 'clash', '--fail-on=h'), {'--fail-on=hit'})
        self.assertEqual(self.completions('strake', 'clash', '--output=s'), {'--output=ship.glb'})


class Fish(Completion, Scenario):
    SHELL = 'fish'

    def offers(self, line):
        script = self.text('completion', 'fish') + f'complete -C "{line}"\n'
        with tempfile.TemporaryDirectory() as home:
            done = subprocess.run(['fish', '--no-config', '-c', script], cwd=self.folder, capture_output=True, text=True,
                                  timeout=60, check=False, env=os.environ | {'HOME': home})
        self.assertEqual((done.returncode, done.stderr), (0, ''))
        return {offered.split('\t')[0] for offered in done.stdout.splitlines()}


class Zsh(Completion, Scenario):
    """Types into an interactive shell that notes what it completes with, and when it is done."""
    SHELL = 'zsh'
    SETUP = r"""
PS1= PROMPT= RPROMPT=
unsetopt zle_bracketed_paste beep prompt_sp
fpath=($notes $fpath)
autoload -U compinit
compinit -u -D
compadd() {
  local -a offered
  if [[ " ${(j: :)@[1,(i)(-|--)]} " != *' -'[OAD]' '* ]]; then
    builtin compadd -A offered "$@"
    (( $#offered )) && print -rl -- $offered >> $notes/offered
  fi
  builtin compadd "$@"
}
ask() { zle complete-word; zle kill-whole-line; : > $notes/done; }
zle -N ask
bindkey '^T' ask
: > $notes/done
"""

    def setUp(self):
        super().setUp()
        keep = tempfile.TemporaryDirectory(prefix='strake-zsh-')
        self.addCleanup(keep.cleanup)
        self.notes = Path(keep.name)
        (self.notes / '_strake').write_text(self.text('completion', 'zsh'))
        (self.notes / 'setup').write_text(f'notes={self.notes}\n' + self.SETUP)
        pid, self.terminal = pty.fork()
        if pid == 0:
            os.chdir(self.folder)
            os.execvpe('zsh', ['zsh', '-f', '-i'], os.environ | {'TERM': 'dumb'})
        self.addCleanup(os.waitpid, pid, 0)
        self.addCleanup(os.close, self.terminal)
        self.type(f'source {self.notes}/setup\n')

    def type(self, keys):
        """Returns when the shell has answered; reads what it writes meanwhile, or it would stop."""
        os.write(self.terminal, keys.encode())
        output = b''
        end = time.monotonic() + 60
        while not (self.notes / 'done').exists():
            self.assertLess(time.monotonic(), end, output.decode(errors='replace'))
            if select.select([self.terminal], [], [], .02)[0]:
                output += os.read(self.terminal, 65536)
        (self.notes / 'done').unlink()

    def offers(self, line):
        offered = self.notes / 'offered'
        offered.unlink(missing_ok=True)
        self.type(line + '\x14')
        return set(offered.read_text().replace('\\ ', ' ').splitlines()) if offered.exists() else set()

    def test_first_tab(self):
        """The file is loaded by the first TAB, which offers something already."""
        self.assertEqual(self.offers('strake cl'), {'clash'})


if __name__ == '__main__':
    main()
