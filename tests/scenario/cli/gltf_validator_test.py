#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""gltf_validator_test.py STRAKE: Khronos' validator finds nothing wrong with what is written as GLB.

It is the package gltf-validator of npm, in a folder that NODE_PATH names; scripts/npm.sh installs it in build/npm. Without it
the test fails. With STRAKE_DATA, real models are converted, too."""
import json
import os
import subprocess
from pathlib import Path

from scenario import Scenario, cube, main, rvm

# Groups without objects; doubles that only Strake reads.
IGNORED = ['NODE_EMPTY', 'UNUSED_OBJECT']
VALIDATE = """
const validator = require('gltf-validator'), fs = require('fs');
validator.validateBytes(new Uint8Array(fs.readFileSync(process.argv[1])), {ignoredIssues: %s, maxIssues: 20})
  .then(report => console.log(JSON.stringify(report.issues)));
""" % json.dumps(IGNORED)


class Validator(Scenario):
    def assert_valid(self, name):
        done = subprocess.run(['node', '-e', VALIDATE, str(self.folder / name)], capture_output=True, text=True,
                              timeout=200, check=False)
        self.assertEqual(done.returncode, 0, done.stderr)
        issues = json.loads(done.stdout)
        self.assertEqual((issues['numErrors'], issues['numWarnings']), (0, 0), json.dumps(issues['messages'], indent=1))

    def test_it_finds_what_is_wrong(self):
        self.text('generate', 'ship', '--objects', 100, '-o', 'ship.glb')
        data = (self.folder / 'ship.glb').read_bytes()
        (self.folder / 'bad.glb').write_bytes(data.replace(b'"type":"VEC3"', b'"type":"VEC2"'))
        with self.assertRaises(AssertionError):
            self.assert_valid('bad.glb')

    def test_generated_ships(self):
        self.text('generate', 'ship', '--objects', 400, '--turned', '-o', 'ship.glb')
        self.assert_valid('ship.glb')
        self.text('convert', 'ship.glb', 'whole.glb')
        self.assert_valid('whole.glb')

    def test_primitives_and_names(self):
        (self.folder / 'a.rvm').write_bytes(rvm([('one "Ä"', (0, 0, 0)), ('space', (10, 10, 10), 'OBST')]))
        self.write('b.obj', cube('b', 0, (0.1, 0.2, 1234567.8), 100.01))
        self.text('convert', 'a.rvm', 'b.obj', 'a.glb')
        self.assert_valid('a.glb')

    def test_real_models(self):
        folder = os.environ.get('STRAKE_DATA', '')
        for file in sorted(Path(folder).glob('rvm/*/*')) if folder else []:
            if file.suffix.lower() == '.rvm':
                with self.subTest(file.name):
                    self.text('convert', file, 'real.glb')
                    self.assert_valid('real.glb')


if __name__ == '__main__':
    main()
