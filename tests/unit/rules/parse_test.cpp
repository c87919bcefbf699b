// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "strake/rules/rules.hpp"

namespace strake::rules {
namespace {

std::string fault_of(std::string_view text) {
  const auto rules = Rules::parse(text, "r.toml");
  if (rules) return "";
  EXPECT_EQ(rules.error().code, ErrorCode::input);
  return rules.error().text();
}

TEST(RulesFile, AnEmptyFileIsOneTestOfEverything) { EXPECT_EQ(fault_of(""), ""); }

TEST(RulesFile, EverythingThatThereIsCanBeWritten) {
  EXPECT_EQ(fault_of(R"toml(
[defaults]
clearance = "10mm"
touch_gap = "1mm"
touch_overlap = 0
thickness_cap = false
contact_distance = "5um"
within_file = false
[sets]
both = "set(one) or set('an other')"
one = "type = box"
"an other" = "type = mesh"
[[discipline]]
name = "hull"
select = "set(both)"
[[discipline]]
name = "pipes"
select = "PIPE*"
[matrix]
name = "by discipline"
enabled = true
missing = "not checked"
clearance = "2cm"
without = ["units"]
[matrix.cells.hull]
hull = "checked"
pipes = { clearance = "1in", thickness_cap = true }
[[test]]
name = "all"
[[test]]
name = "later"
enabled = false
a = "set(one)"
b = "*"
clearance = "@'Insulation thickness' + 25mm"
touch_gap = "2mm"
contact_distance = 0
without = ["sleeves", "soft against soft"]
[unit_groups]
name = "units"
attribute = "UNIT"
[[unit_groups.group]]
number = -1
select = "a*"
[[same_assembly]]
name = "equipment"
level = 3
across_files = true
among = "b*"
[[same_assembly]]
name = "owner"
level = "parent"
[[same_assembly]]
name = "item"
level = "assembly"
[[same_assembly]]
name = "skid"
group = "SKID*"
[[connected]]
name = "joints"
attributes = ["HREF", "TREF"]
by = "partner"
groups = true
separator = ","
[[connected]]
name = "nodes"
attributes = "NODE"
by = "node"
[[same_attribute]]
name = "system"
attribute = "SYSTEM"
[[exempt]]
name = "not ours"
a = "file = x.rvm"
b = "file = y.rvm"
[obstruction]
attribute = [":OBST", "Obstruction"]
volumes = "hard"
soft_against_soft = false
soft = "ACCESS*"
none = "NOTE*"
hard = "ACCESS-DOOR*"
[insulation]
select = "LAGGING*"
against_insulation = false
against_soft = false
[[allowed]]
name = "sleeves"
a = "PIPE*"
b = "SLEEVE*"
max_depth = "5mm"
region = { min = ["0m", 0, "-1m"], max = ["9m", "9000", 9e3] }
cavity = [ { point = ["0m", "0m", "3m"], normal = [0, 0.5, -1] } ]
[[allowed]]
name = "embedded"
a = "ANCHOR*"
b = "WALL*"
max_depth = "any"
)toml"),
            "");
}

TEST(RulesFile, FaultsNamePlaceAndMend) {
  const std::vector<std::pair<std::string, std::string>> faults{
      {"a = = 1", "r.toml, line 1, column 5: "},
      {"x = 1", "r.toml, line 1, column 1: the file has no key 'x' (its keys are sets, defaults"},
      {"[defaults]\nclearence = \"1mm\"",
       "r.toml, line 2, column 1: [defaults] has no key 'clearence' (its keys are clearance,"},
      {"[defaults]\nclearance = 25",
       "line 2, column 13: 'clearance' of [defaults] is a whole number, not a length with its "
       "unit"},
      {"[defaults]\nclearance = \"25\"",
       "line 2, column 13: 'clearance' of [defaults]: the length '25' has no unit (write 25mm or"},
      {"[defaults]\nclearance = \"-1mm\"",
       "'clearance' of [defaults]: '-1mm' is negative (write a length from 0 to 1km)"},
      {"[defaults]\nclearance = \"2km\"", "is longer than a kilometre"},
      {"[defaults]\nclearance = \"nanmm\"", "'clearance' of [defaults]"},
      {"[defaults]\nclearance = \"@INSU + 25\"",
       "r.toml, line 2, column 13: 'clearance' of [defaults]: the length '25' has no unit"},
      {"[[test]]\nname = \"t\"\nclearance = \"@INSU + @LAG\"",
       "r.toml, line 3, column 13: 'clearance' of [[test]] 't': '@INSU + @LAG' has two attributes "
       "(write a length, an attribute or one of each"},
      {"[defaults]\ntouch_gap = \"@INSU\"", "'touch_gap' of [defaults]: '@INSU' is not a length"},
      {"[defaults]\nthickness_cap = \"yes\"",
       "'thickness_cap' of [defaults] is a text, not true or false"},
      {"defaults = 3", "'defaults' is a whole number, not a table (write [defaults] with single"},
      {"[unit_groups]\ngroup = 3",
       "'group' is not a list of tables (write [[unit_groups.group]] with double brackets"},
      {"[test]\nname = \"x\"",
       "'test' is not a list of tables (write [[test]] with double brackets"},
      {"test = [1]", "'test' is not a list of tables"},
      {"[sets]\na = 3", "line 2, column 5: [sets] 'a' is no selection"},
      {"[sets]\na = \"type =\"", "r.toml, line 2, column 5, [sets] 'a', selection, column 7"},
      {"[sets]\na = \"set(b)\"\nb = \"not set(a)\"", "line 2, column 1: the set 'a' needs itself"},
      {"[sets]\na = \"set(c)\"", "no set is called 'c' (the sets are a)"},
      {"[sets]\na = \"set(b)\"\nb = \"(\"", "r.toml, line 3, column 5, [sets] 'b', selection"},
      {"[[test]]\na = \"set(x)\"\nname = \"t\"",
       "line 2, column 5, [[test]] 't', a, selection, column 5: no set is called 'x' (write one"},
      {"[[test]]\na = \"x\"", "line 1, column 1: [[test]] has no 'name'"},
      {"[[test]]\nname = \"\"", "[[test]] has an empty 'name'"},
      {"[[test]]\nname = \"t\"\n[[test]]\nname = \"t\"",
       "line 3, column 1: the name 't' is given twice"},
      {"[[test]]\nname = \"t\"\nenabled = false", "every test is disabled"},
      {"[[test]]\nname = \"t\"\nwithout = [\"x\"]",
       "'without' names a rule 'x' that is not there (there are no rules)"},
      {"[[test]]\nname = \"t\"\nwithout = [1]",
       "'without' of [[test]] 't' is a whole number, not a list of texts"},
      {"[[discipline]]\nname = \"h\"\nselect = \"*\"", "disciplines without a matrix do nothing"},
      {"[[discipline]]\nname = \"h\"\n[matrix]", "[[discipline]] 'h' has no 'select'"},
      {"[matrix]", "a matrix without disciplines"},
      {"[[discipline]]\nname = \"h\"\nselect = \"*\"\n[matrix]\nmissing = \"no\"",
       "'missing' of [matrix] is 'no' (write one of \"checked\", \"not checked\")"},
      {"[[discipline]]\nname = \"h\"\nselect = \"*\"\n[matrix.cells.x]\nh = \"checked\"",
       "no discipline is called 'x' (the disciplines are h)"},
      {"[[discipline]]\nname = \"h\"\nselect = \"*\"\n[matrix.cells.h]\nx = \"checked\"",
       "line 5, column 1: no discipline is called 'x'"},
      {"[[discipline]]\nname = \"h\"\nselect = \"*\"\n[matrix.cells.h]\nh = \"1mm\"",
       "the cell 'h' is no rule for a pair of disciplines"},
      {"[[discipline]]\nname = \"h\"\nselect = \"*\"\n[matrix.cells.h]\nh = { clear = 1 }",
       "the cell 'h' has no key 'clear'"},
      {"[[discipline]]\nname = \"h\"\nselect = \"*\"\n[[discipline]]\nname = \"p\"\nselect = "
       "\"*\"\n"
       "[matrix.cells.h]\np = \"checked\"\n[matrix.cells.p]\nh = \"checked\"",
       "line 10, column 1: the cell of 'p' and 'h' is given twice"},
      {"[unit_groups]", "[unit_groups] says no unit of anything"},
      {"[unit_groups]\n[[unit_groups.group]]\nselect = \"*\"", "has no 'number'"},
      {"[unit_groups]\n[[unit_groups.group]]\nnumber = 1.5\nselect = \"*\"", "not a whole number"},
      {"[[same_assembly]]\nname = \"s\"", "takes either 'level' or 'group'"},
      {"[[same_assembly]]\nname = \"s\"\nlevel = 1\ngroup = \"x\"",
       "takes either 'level' or 'group'"},
      {"[[same_assembly]]\nname = \"s\"\nlevel = 0", "'level' of [[same_assembly]] is no level"},
      {"[[same_assembly]]\nname = \"s\"\nlevel = \"top\"", "is no level of the hierarchy"},
      {"[[connected]]\nname = \"c\"", "[[connected]] names no attributes"},
      {"[[connected]]\nname = \"c\"\nhead = \"HREF\"\ninherited = \"all\"",
       "'head' and 'tail' of [[connected]] are about the ends of a branch"},
      {"[[connected]]\nname = \"c\"\nattributes = [\"A\"]\nby = \"luck\"",
       "write one of \"partner\", \"node\""},
      {"[[same_attribute]]\nname = \"c\"", "[[same_attribute]] 'c' has no 'attribute'"},
      {"[[exempt]]\nname = \"c\"\na = \"x\"", "[[exempt]] 'c' has no 'b'"},
      {"[obstruction]\nvolumes = \"hart\"", "write one of \"soft\", \"hard\", \"none\""},
      {"[insulation]\nagainst_soft = 1", "not true or false"},
      {"[insulation]\nselect = \"type =\"", "r.toml, line 2, column 10, [insulation], select"},
      {"[[exempt]]\nname = \"soft against soft\"\na = \"x\"\nb = \"y\"\n[obstruction]",
       "the name 'soft against soft' is given twice"},
      {"[[allowed]]\nname = \"c\"\nb = \"x\"", "[[allowed]] 'c' has no 'a'"},
      {"[[allowed]]\nname = \"c\"\na = \"x\"\nb = \"x\"\nmax_depth = \"deep\"",
       "'max_depth' of [[allowed]]"},
      {"[[allowed]]\nname = \"c\"\na = \"x\"\nb = \"x\"\nregion = { min = [0, 0, 0] }",
       "'region' wants both corners"},
      {"[[allowed]]\nname = \"c\"\na = \"x\"\nb = \"x\"\nregion = { min = [\"1m\", 0, 0], max = "
       "[0, 0, 0] }",
       "'region' ends before it begins"},
      {"[[allowed]]\nname = \"c\"\na = \"x\"\nb = \"x\"\nregion = { min = [0, 0], max = [0, 0, 0] "
       "}",
       "is no list of three"},
      {"[[allowed]]\nname = \"c\"\na = \"x\"\nb = \"x\"\ncavity = [ { point = [0, 0, 0], normal = "
       "[0, 0, 0] } ]",
       "has no direction"},
      {"[[allowed]]\nname = \"c\"\na = \"x\"\nb = \"x\"\ncavity = [ { point = [0, 0, 0], normal = "
       "[1e-320, 0, 0] } ]",
       "has no direction"},
      {"[[allowed]]\nname = \"c\"\na = \"x\"\nb = \"x\"\ncavity = [ { point = [0, 0, 0], normal = "
       "[inf, 0, 0] } ]",
       "'normal' of 'cavity' of [[allowed]] has a number that is not finite"},
      {"[[allowed]]\nname = \"c\"\na = \"x\"\nb = \"x\"\ncavity = [ { point = [0, 0, 0], normal = "
       "[\"x\", 0, 0] } ]",
       "not a list of three numbers"},
      {"[[allowed]]\nname = \"c\"\na = \"x\"\nb = \"x\"\ncavity = [ { point = [0, 0, 0] } ]",
       "a plane of a cavity wants a point and a normal"},
      {"[defaults]\nclearance = 2020-01-01", "is a date or time, not a length"},
  };
  for (const auto& [text, fault] : faults)
    EXPECT_NE(fault_of(text).find(fault), std::string::npos) << text << "\n" << fault_of(text);
}

TEST(RulesFile, HostileTextsEndInAnError) {
  std::string nested = "[sets]\n";
  for (int i = 0; i < 200; ++i)
    nested += "s" + std::to_string(i) + " = \"set(s" + std::to_string(i + 1) + ")\"\n";
  EXPECT_NE(fault_of(nested + "s200 = \"*\""), "");
  EXPECT_NE(fault_of(std::string(100000, '[')), "");
  EXPECT_NE(fault_of("a = " + std::string(100000, '[')), "");
  EXPECT_NE(fault_of(std::string("a = \"\0\"", 7)), "");
  EXPECT_NE(fault_of("a = \"\xFF\xFE\""), "");
  EXPECT_NE(fault_of("b\u00FCro = 1"), "");
  EXPECT_EQ(fault_of("# B\u00FCro\n[sets]\n\"B\u00FCro\" = \"name = '\u00C5*'\""), "");
}

// Each part of a key is a table within a table.
TEST(RulesFile, KeysOfVeryManyPartsAreRefused) {
  std::string deep, most;
  for (int i = 0; i < 100000; ++i) deep += i % 2 == 0 ? "a." : "'b c' . ";
  for (int i = 0; i < 15; ++i) most += "a.";
  const std::string fault = ": a key of more than 16 parts";
  const std::vector<std::pair<std::string, std::string>> places{
      {"x = 1\n" + deep + "y = 1", "line 2, column 1"},
      {"[" + deep + "y]", "line 1, column 2"},
      {"[[ " + deep + "y]]", "line 1, column 4"},
      {"x = [ 1.5, { " + deep + " y = 1 } ]", "line 1, column 14"},
      {"x = [\"\"\"a\"\"\"\", { " + deep + " y = 1 } ]", "line 1, column 18"},
      {"x = ['it', { " + deep + " y = 1 } ]", "line 1, column 14"},
      {"x = \"\\\" # \" # '\n " + deep + "y = 1", "line 2, column 2"},
      {most + "y.z = 1", "line 1, column 1"}};
  for (const auto& [text, place] : places)
    EXPECT_NE(fault_of(text).find("r.toml, " + place + fault), std::string::npos)
        << text.substr(0, 40) << "\n"
        << fault_of(text);
  EXPECT_NE(fault_of(most + "y = 1").find("the file has no key 'a'"), std::string::npos);
  EXPECT_EQ(fault_of("# " + deep + "\n[sets]\nx = \"name ~ '" + std::string(1000, '.') + "'\""),
            "");
  // As deep as values and keys may be together.
  std::string inner = "1";
  for (int i = 0; i < 250; ++i) inner = "{ " + most + "y = " + inner + " }";
  EXPECT_NE(fault_of("x = " + inner), "");
}

TEST(RulesFile, DamageEndsInAnErrorWithAPlaceOrInRules) {
  std::ifstream stream(STRAKE_EXAMPLE_RULES, std::ios::binary);
  const std::string whole{std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
  ASSERT_GT(whole.size(), 1000U);
  std::mt19937 random(11);
  int refused = 0;
  for (int i = 0; i < 2000; ++i) {
    std::string text = whole;
    for (std::size_t cut = random() % 3 + 1; cut > 0; --cut) {
      const std::size_t at = random() % text.size();
      if (random() % 2 == 0)
        text[at] = static_cast<char>(random() % 256);
      else
        text.erase(at, random() % 30);
    }
    const auto rules = Rules::parse(text, "r.toml");
    if (rules) continue;
    ++refused;
    EXPECT_TRUE(rules.error().where.starts_with("r.toml, line ")) << rules.error().text();
    EXPECT_FALSE(rules.error().message.empty());
    EXPECT_FALSE(rules.error().mend.empty()) << rules.error().text();
  }
  EXPECT_GT(refused, 500);
}

TEST(RulesFile, IsReadFromAFile) {
  namespace fs = std::filesystem;
  const auto rules = Rules::read(STRAKE_EXAMPLE_RULES);
  ASSERT_TRUE(rules) << rules.error().text();
  const auto missing = Rules::read("no such rules.toml");
  ASSERT_FALSE(missing);
  EXPECT_EQ(missing.error().code, ErrorCode::input);
  EXPECT_NE(missing.error().text().find("no such rules.toml"), std::string::npos);
  EXPECT_FALSE(Rules::read(fs::temp_directory_path()));
}

TEST(RulesFile, TheSceneIsAsFineAsTheFinestTest) {
  EXPECT_EQ(Rules::parse("", "r").value().scene_options().sag_mm, 0.25);
  const auto fine = Rules::parse(
      "[[discipline]]\nname = \"h\"\nselect = \"*\"\n[matrix.cells.h]\nh = { touch_gap = \"0.4mm\" "
      "}\n"
      "[[test]]\nname = \"off\"\nenabled = false\ntouch_gap = 0\n[insulation]",
      "r");
  ASSERT_TRUE(fine) << fine.error().text();
  EXPECT_EQ(fine.value().scene_options().sag_mm, 0.1);
  EXPECT_TRUE(fine.value().scene_options().insulation);
  EXPECT_FALSE(fine.value().scene_options().obstruction);
  EXPECT_TRUE(Rules::parse("[obstruction]", "r").value().scene_options().obstruction);
}

/// A small file must not request a large result: a cell for each two disciplines, and the name of a
/// rule with every pair.
TEST(RulesFile, WhatWouldFillTheDiskIsRefused) {
  const auto disciplines = [](int count) {
    std::string text;
    for (int i = 0; i < count; ++i)
      text += "[[discipline]]\nname = 'd" + std::to_string(i) + "'\nselect = '*'\n";
    return text + "[matrix]\n";
  };
  EXPECT_EQ(fault_of(disciplines(300)), "");
  for (const int count : {301, 3000}) {
    const std::string reported = fault_of(disciplines(count));
    EXPECT_NE(reported.find("line 901"), std::string::npos) << reported;
    EXPECT_NE(reported.find("more than 300 disciplines"), std::string::npos) << reported;
    EXPECT_NE(reported.find("join some"), std::string::npos) << reported;
  }
  for (const std::string table : {"[[test]]", "[[exempt]]\na = '*'\nb = '*'",
                                  "[[allowed]]\na = '*'\nb = '*'\nmax_depth = '1mm'"}) {
    const auto named = [&](std::size_t length) {
      return fault_of("\n" + table + "\nname = '" + std::string(length, 'n') + "'\n");
    };
    EXPECT_EQ(named(200), "") << table;
    EXPECT_NE(named(201).find("line 2"), std::string::npos) << named(201);
    EXPECT_NE(named(100'000).find("has 100000 bytes, more than 200"), std::string::npos);
    EXPECT_LT(named(100'000).size(), 500U);
  }
}

}  // namespace
}  // namespace strake::rules
