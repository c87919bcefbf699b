// SPDX-License-Identifier: Apache-2.0
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { styleRules } from '../../src/drawings/drawing_styles.ts';

test('pens and colours of a drawing are taken within its scope', () => {
  const svg = '<svg><style>\n.strake .visible.sharp path, .strake .edge { stroke: #c00000; stroke-width: 0.35; stroke-dasharray: 3 1; }\n.strake text.h2_5 { font-size: 3.5px; }\n</style></svg>';
  assert.equal(styleRules(svg, '.paper .d'), '.paper .d .strake .visible.sharp path, .paper .d .strake .edge { stroke: #c00000; stroke-width: 0.35; stroke-dasharray: 3 1 }\n.paper .d .strake text.h2_5 { font-size: 3.5px }');
});

test('what is more than pens and colours is left out', () => {
  for (const text of ['@import "http://x/y.css";', 'path { fill: url(http://x/y) }', 'path { background: red; position: fixed }', '.a:hover path { stroke: red }',
    'path { stroke-width: calc(1px) }', '* { stroke: red }', 'path[d] { stroke: red }', '.a > path { stroke: red }', 'path { stroke: red } } body { fill: #000', 'path { fill: expression(1) }']) {
    const rules = styleRules(`<svg><style>${text}</style></svg>`, '.paper .d');
    assert.doesNotMatch(rules, /url|import|background|position|hover|calc|expression|\*|\[|>/);
    for (const line of rules.split('\n').filter(Boolean)) assert.match(line, /^\.paper \.d [\w .-]+ \{ [^{}]+ \}$/);
  }
});
