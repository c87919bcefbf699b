// SPDX-License-Identifier: Apache-2.0
// What attributes say to rules, and what says that there is no value: also within a list.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "model/attributes.hpp"
#include "support/rules_models.hpp"

namespace strake::rules {
namespace {

using test::Counts;
using test::exempted;
using test::ResultLines;
using test::Row;
using test::warned;

std::vector<std::string> listed(const std::string& value, const std::string& separator = ",") {
  const model::Attributes attributes{{"X", value}};
  const auto views = model::listed_values_of(attributes, "X", separator);
  return {views.begin(), views.end()};
}

using Texts = std::vector<std::string>;

TEST(RulesValues, PiecesOfAListAreValuesOfTheirOwn) {
  EXPECT_EQ(listed("N1,N2"), (Texts{"N1", "N2"}));
  EXPECT_EQ(listed(" N1 ,\t'N2' , \"N3\""), (Texts{"N1", "N2", "N3"}));
  EXPECT_EQ(listed("unset,N1,Nulref,=0/0,NONE,, ,'unset',\"\",' '"), Texts{"N1"});
  EXPECT_EQ(listed("unset"), Texts{});
  EXPECT_EQ(listed(","), Texts{});
  EXPECT_EQ(listed(""), Texts{});
  EXPECT_EQ(listed("a  b ", " "), (Texts{"a", "b"}));
  EXPECT_EQ(listed("a, b", ""), Texts{"a, b"});
  EXPECT_EQ(listed("a--b--unset", "--"), (Texts{"a", "b"}));
}

TEST(RulesValues, QuotesRoundAPieceOrTheWholeList) {
  EXPECT_EQ(listed("'N1,N2'"), (Texts{"N1", "N2"}));
  EXPECT_EQ(listed("'\"R\",P'"), (Texts{"R", "P"}));
  EXPECT_EQ(listed("\"R\",\"P\""), (Texts{"R", "P"}));
  EXPECT_EQ(listed("'R','P'"), (Texts{"R", "P"}));
  EXPECT_EQ(listed("'a,b',c"), (Texts{"a,b", "c"})) << "a separator within quotes parts nothing";
  EXPECT_EQ(listed("'R,P"), (Texts{"'R", "P"})) << "a quote that nothing closes is of the name";
  EXPECT_EQ(listed("6\",4\""), (Texts{"6\"", "4\""})) << "inches";
  EXPECT_EQ(listed("'"), Texts{"'"});
  EXPECT_EQ(listed("a'b'c", "'"), (Texts{"a", "b", "c"}));
  EXPECT_EQ(listed("\"'unset'\""), Texts{});
}

/// A missed clash otherwise: two that are joined to nothing are joined to each other.
TEST(RulesValues, WhatStatesThatThereIsNoneConnectsNothing) {
  const std::string rule =
      "[[connected]]\nname = \"joints\"\nattributes = [\"NODES\"]\nseparator = \",\"\n";
  for (const std::string none : {"unset", " Unset", "Nulref", "none", "=0/0", "", " ", "'unset'"}) {
    SCOPED_TRACE(none);
    const std::string name = none.empty() ? "c" : none;
    const Row row = Row()
                        .cube("a", {{"NODES", "n1," + none}})
                        .cube("b", {{"NODES", none + ",n3"}})
                        .cube(name, {{"NODES", none + "," + none}});
    EXPECT_EQ(row.hits(rule + "by = \"node\""), (ResultLines{"a-b HIT", "b-" + name + " HIT"}));
    EXPECT_EQ(row.hits(rule), (ResultLines{"a-b HIT", "b-" + name + " HIT"}));
  }
  const Row row = Row().cube("P", {}).cube("a", {{"NODES", "\"R\",P"}}).cube("R", {});
  EXPECT_EQ(exempted(row.run(rule).reports[0]), (Counts{{"joints", 2}}));
}

TEST(RulesValues, WhatStatesThatThereIsNoneIsNoUnitSystemOrLevel) {
  for (const std::string none : {"unset", "Nulref", "=0/0", "", " '' ", "\"unset\""}) {
    SCOPED_TRACE(none);
    const Row row = Row().cube("a", {{"X", none}}).cube("b", {{"X", none}}).cube("c", {{"X", "1"}});
    const ResultLines both{"a-b HIT", "b-c HIT"};
    EXPECT_EQ(row.hits("[[same_attribute]]\nname = \"s\"\nattribute = \"X\""), both);
    auto outcome = row.run("[unit_groups]\nattribute = \"X\"");
    EXPECT_EQ(outcome.reported[0], both);
    EXPECT_EQ(warned(outcome.diagnostics, "unit-not-a-number"), "");
    outcome = row.run("[obstruction]\nattribute = \"X\"");
    EXPECT_EQ(outcome.reported[0], both);
    EXPECT_EQ(outcome.reports[0].pairs[0].level_a, clash::Level::hard);
    EXPECT_EQ(outcome.reports[0].pairs[1].level_b, clash::Level::soft);
    EXPECT_EQ(warned(outcome.diagnostics, "obstruction-not-known"), "");
  }
}

/// Groups without a name in several files are not one assembly.
TEST(RulesValues, AGroupWithoutANameIsNotTheSameAsAnother) {
  const std::string rule =
      "[[same_assembly]]\nname = \"one\"\nlevel = \"parent\"\nacross_files = true\n";
  Row row;
  const auto one = row.group("site"), two = row.group("site");
  row.cube("a", {}, row.group("", one), 0).cube("b", {}, row.group("", two), 1);
  EXPECT_EQ(row.hits(rule), (ResultLines{"a-b HIT"}));
  Row same;
  const auto nameless = same.group("");
  same.cube("a", {}, nameless).cube("b", {}, nameless);
  EXPECT_EQ(same.hits(rule), ResultLines{}) << "the one group";
}

}  // namespace
}  // namespace strake::rules
