#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""keep_counters.py EVALUATION.json > VERSION.json: of an evaluation what does not depend on the machine, the counters of
the sequential runs, in the form that `strake evaluate --compare` reads. README.md beside it says how they are made."""
import json
import sys

record = json.load(open(sys.argv[1], encoding='utf-8'))
record['machine'].update(processor='', system='', program='', memory_bytes=0)
record['studies'] = record['peers'] = []
for case in record['cases']:
    for stage in case['stages']:
        stage['contenders'] = [c for c in stage['contenders'] if c['name'] == 'sequential']
        # No time is kept: without a reference none is compared.
        stage['reference_s'] = 0
        for contender in stage['contenders']:
            contender.update(seconds=[0], cpu_s=0, peak_bytes=0, regions=[], shared_wall_s=0)
            for name in ('alone_s', 'kernel_s', 'kernel_alone_s'):
                contender.pop(name, None)
print(json.dumps(record, indent=1))
