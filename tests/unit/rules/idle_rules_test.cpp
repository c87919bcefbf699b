// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "support/rules_models.hpp"

namespace strake::rules {
namespace {

using test::expect_lines;
using test::ResultLines;
using test::Row;
using test::warned;

// Rules that match objects, but are of no use for any pair of them.
TEST(IdleRules, WhatConcernsNoPairIsNamed) {
  const Row row = Row()
                      .cube("a", {{"SYS", "1"}, {"HREF", "c"}})
                      .cube("b", {{"SYS", "2"}})
                      .cube("c", {{"SYS", "1"}})
                      .cube("d");
  const auto outcome = row.run(R"toml(
[insulation]
[[same_attribute]]
name = "system"
attribute = "SYS"
[[connected]]
name = "joints"
attributes = "HREF"
[[exempt]]
name = "far"
a = "a"
b = "d"
[[exempt]]
name = "near"
a = "a"
b = "b"
[[allowed]]
name = "never asked"
a = "a"
b = "d"
[[allowed]]
name = "exempted"
a = "a"
b = "b"
[[allowed]]
name = "asked in vain"
a = "b"
b = "c"
)toml");
  expect_lines(
      warned(outcome.diagnostics, "rule-matches-nothing"),
      {"r.toml: [insulation]: no object has insulation\n",
       "r.toml, line 3: [[same_attribute]] 'system': it concerns no two objects that are within "
       "reach of each other\n",
       "r.toml, line 6: [[connected]] 'joints': it concerns no two objects that are within reach "
       "of each other\n",
       "r.toml, line 9: [[exempt]] 'far': it concerns no two objects that are within reach of "
       "each other\n",
       "r.toml, line 17: [[allowed]] 'never asked': it concerns no two objects that are within "
       "reach of each other and not exempted\n",
       "r.toml, line 21: [[allowed]] 'exempted': it concerns no two objects that are within reach "
       "of each other and not exempted\n"});
}

// One test that has a use for a rule is enough.
TEST(IdleRules, WhatSomeTestHasAUseForIsNotNamed) {
  const Row row = Row().cube("a").cube("b").cube("c");
  const auto outcome = row.run(R"toml(
[[exempt]]
name = "ab"
a = "a"
b = "b"
[[test]]
name = "one"
a = "c"
[[test]]
name = "two"
[[test]]
name = "three"
without = ["ab"]
)toml");
  EXPECT_EQ(outcome.diagnostics.counts().size(), 0U);
}

TEST(IdleRules, WhatEarlierRulesLeaveNothingToIsNamed) {
  const Row row = Row().cube("a").cube("b").cube("c").cube("d");
  const auto outcome = row.run(R"toml(
[[discipline]]
name = "first"
select = "a or b"
[[discipline]]
name = "second"
select = "b"
[[discipline]]
name = "rest"
select = "*"
[matrix]
[matrix.cells.rest]
rest = "not checked"
[unit_groups]
[[unit_groups.group]]
number = 1
select = "a or b"
[[unit_groups.group]]
number = 2
select = "a"
[obstruction]
soft = "d"
none = "*"
[[exempt]]
name = "again"
a = "a"
b = "*"
[[exempt]]
name = "not checked anyway"
a = "d"
b = "c"
)toml");
  expect_lines(
      warned(outcome.diagnostics, "rule-shadowed"),
      {"[[discipline]] 'second', select: every object that it picks counts for an earlier "
       "discipline\n",
       "every object that it picks is in an earlier group\n",
       "every object that it picks is one of 'none'\n",
       "[[exempt]] 'again': it does nothing: what it concerns is exempted by earlier rules, as "
       "'unit groups'\n",
       "[[exempt]] 'not checked anyway': it does nothing: what it concerns is exempted by earlier "
       "rules, as 'matrix'\n"});
}

TEST(IdleRules, AllowancesThatEarlierOnesLeaveNothingToAreNamed) {
  const Row row = Row().cube("a").cube("b").cube("c");
  const auto outcome = row.run(R"toml(
[[allowed]]
name = "shallow"
a = "*"
b = "*"
[[allowed]]
name = "all"
a = "*"
b = "*"
max_depth = "any"
[[allowed]]
name = "some"
a = "a"
b = "b"
max_depth = "20mm"
[[allowed]]
name = "too little"
a = "b"
b = "c"
max_depth = "5mm"
)toml");
  EXPECT_EQ(outcome.reported[0], (ResultLines{"a-b HIT by all", "b-c HIT by all"}));
  EXPECT_EQ(warned(outcome.diagnostics, "rule-shadowed"),
            "r.toml, line 11: [[allowed]] 'some': it does nothing: what it concerns is allowed by "
            "earlier rules, as 'all'\n");
  EXPECT_EQ(outcome.diagnostics.count("rule-matches-nothing"), 0U);
}

}  // namespace
}  // namespace strake::rules
