# SPDX-License-Identifier: Apache-2.0
"""validate_json.py SCHEMA FILE...: fails, naming the place, when a file does not follow the schema."""
import json
import sys

import jsonschema

with open(sys.argv[1], encoding='utf-8') as f:
    schema = json.load(f)
jsonschema.Draft202012Validator.check_schema(schema)
validator = jsonschema.Draft202012Validator(schema)
bad = 0
for name in sys.argv[2:]:
    with open(name, encoding='utf-8') as f:
        document = json.load(f)
    for error in sorted(validator.iter_errors(document), key=lambda e: list(e.absolute_path)):
        print('%s: %s: %s' % (name, '/'.join(map(str, error.absolute_path)), error.message))
        bad += 1
# A validator that accepts anything would accept this, too.
if not any(True for _ in validator.iter_errors({'schema_version': 'none'})):
    print('%s accepts nonsense' % sys.argv[1])
    bad += 1
sys.exit(1 if bad else 0)
