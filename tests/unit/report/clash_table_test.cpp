// SPDX-License-Identifier: Apache-2.0
// Tables of a terminal: places, files or disciplines, and names that are short and do not look
// alike.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "report/text/columns.hpp"
#include "report/text/formatting.hpp"
#include "report/text/table_names.hpp"
#include "strake/clash/group.hpp"
#include "strake/report/clash.hpp"
#include "support/clash_model.hpp"

namespace strake::report {
namespace {

using test::ClashModel;
using Views = std::vector<std::string_view>;
using Texts = std::vector<std::string>;

TEST(TableNames, FindTheGroupsThatAllPathsBeginWith) {
  EXPECT_EQ(common_lead(Views{"/PS/WD1/0010/M1", "BOX 1 of STRUCTURE /PS/WD1/0015"}), "/PS/WD1");
  EXPECT_EQ(common_lead(Views{"/PS/WD1/0010", "/PS/WD1/0011", "PIPE"}), "/PS/WD1");
  EXPECT_EQ(common_lead(Views{"hull/frames/F1", "hull/frames/F2"}), "hull/frames");
  // One of them is a group of the other: what is left of it must not be empty.
  EXPECT_EQ(common_lead(Views{"/PS/WD1/0010", "/PS/WD1"}), "");
  EXPECT_EQ(common_lead(Views{"/PLANT/WD1/A/0010", "/PLANT/WD1/A"}), "/PLANT/WD1");
}

TEST(TableNames, HaveNoLeadWhereItSavesNothingOrMisleads) {
  EXPECT_EQ(common_lead(Views{}), "");
  EXPECT_EQ(common_lead(Views{"a", "b"}), "");
  EXPECT_EQ(common_lead(Views{"/A/x", "/A/y"}), "") << "no longer than the mark";
  EXPECT_EQ(common_lead(Views{"/PLANT/WD1/x", "/PLANT/WD1/x"}), "")
      << "nothing would be left to tell";
  EXPECT_EQ(common_lead(Views{"/PLANT/WD1/x", "/PLANT/WD1/y", "~/z"}), "") << "the mark is a name";
}

TEST(TableNames, LeaveTheLeadOutWhereverThePathBegins) {
  EXPECT_EQ(without_lead("/PS/WD1/0010", "/PS/WD1"), "~/0010");
  EXPECT_EQ(without_lead("BOX 1 of STRU /PS/WD1/0010", "/PS/WD1"), "BOX 1 of STRU ~/0010");
  EXPECT_EQ(without_lead("PIPE\n", "/PS/WD1"), "PIPE?");
  EXPECT_EQ(without_lead("/PS/WD1/0010", ""), "/PS/WD1/0010");
}

TEST(TableNames, AreCutOnlySoThatTheyStayApart) {
  const std::string left = "BOX 1 of SUBSTRUCTURE 1 of EQUIPMENT",
                    right = "BOX 1 of SUBSTRUCTURE 2 of EQUIPMENT";
  EXPECT_EQ(shorten_distinctly({left, "short", right}, 12), (Texts{left, "short", right}));
  EXPECT_EQ(shorten_distinctly({left, "short", left}, 12),
            (Texts{"BOX 1…IPMENT", "short", "BOX 1…IPMENT"}));
  EXPECT_EQ(shorten_distinctly({"BOX 1…IPMENT", left}, 12), (Texts{"BOX 1…IPMENT", left}));
  EXPECT_EQ(shorten_distinctly({"Büro"}, 4), (Texts{"Büro"}));
}

ClashModel two_boxes(const std::string& a, const std::string& b) {
  ClashModel m;
  m.box(a, {1000, 2000, 3000}, {1100, 2100, 3100}).box(b, {1080, 2000, 3000}, {1200, 2100, 3100});
  return m;
}

std::string table_of(const ClashModel& m, const TableOptions& options = {}) {
  return clash_table({{{m.detect()}, {}}, m.model}, options);
}

TEST(ClashTable, HasThePlaceInMillimetres) {
  EXPECT_EQ(table_of(two_boxes("left", "right")),
            "class     d mm  relation   x mm y mm z mm  a     b\n"
            "HIT    -20.000  INTERFERE  1100 2050 3050  left  right\n"
            "\n"
            "1 hit, 0 contacts, 0 clearance violations\n");
}

TEST(ClashTable, ReportsTheCommonPathOnce) {
  const std::string text =
      table_of(two_boxes("BOX 1 of STRUCTURE /PLANT/WD1/0010", "/PLANT/WD1/0011"));
  EXPECT_TRUE(text.starts_with("~ stands for /PLANT/WD1\nclass ")) << text;
  EXPECT_NE(text.find("  BOX 1 of STRUCTURE ~/0010  ~/0011\n"), std::string::npos) << text;
  EXPECT_EQ(text.find("/PLANT/WD1", text.find("class")), std::string::npos) << text;
}

TEST(ClashTable, PutsLongNamesBelowEachOtherRatherThanCutThem) {
  const std::string a = "SUBEQUIPMENT 1 of EQUIPMENT /A", b = "SUBEQUIPMENT 2 of EQUIPMENT /A";
  const std::string numbers = "HIT    -20.000  INTERFERE  1100 2050 3050";
  const std::string stacked = table_of(two_boxes(a, b));
  EXPECT_NE(
      stacked.find(numbers + "  " + a + "\n" + std::string(numbers.size() + 2, ' ') + b + "\n"),
      std::string::npos)
      << stacked;
  EXPECT_NE(stacked.find("  a, and b below it\n"), std::string::npos) << stacked;
  const std::string below = table_of(two_boxes(a, b), {.width = 60});
  EXPECT_NE(below.find(numbers + "\n    " + a + "\n    " + b + "\n"), std::string::npos) << below;
}

TEST(ClashTable, CutsNamesWiderThanTheTerminalSoThatTheyStayApart) {
  const std::string long_name(100, 'x');
  const std::string unlike = table_of(two_boxes("a" + long_name, "b" + long_name), {.width = 60});
  EXPECT_EQ(unlike.find("a" + long_name), std::string::npos) << unlike;
  EXPECT_NE(unlike.find("…"), std::string::npos) << unlike;
  const std::string alike =
      table_of(two_boxes(long_name + "a" + long_name, long_name + "b" + long_name), {.width = 60});
  EXPECT_NE(alike.find("xax"), std::string::npos) << alike;
  EXPECT_NE(alike.find("xbx"), std::string::npos) << alike;
}

TEST(ClashTable, NamesTheFileWhereThereAreSeveral) {
  ClashModel m = two_boxes("left", "right");
  m.model.files.push_back({"hvac.rvm", "RVM 2", "mm", "z", 1, 0});
  m.model.objects[1].file = 1;
  const std::string text = table_of(m);
  EXPECT_NE(text.find("z mm  file      a     file      b\n"), std::string::npos) << text;
  EXPECT_NE(text.find("3050  t.obj     left  hvac.rvm  right\n"), std::string::npos) << text;
}

TEST(ClashTable, NamesTheDisciplineInsteadWhereThereAreSome) {
  const ClashModel m = two_boxes("left", "right");
  clash::Report report = m.detect();
  report.disciplines = {{"hull", 1}};
  report.discipline = {0, clash::kNoLabel};
  const std::string text = clash_table({{{report}, {}}, m.model}, {});
  EXPECT_NE(text.find("z mm  discipline  a     discipline  b\n"), std::string::npos) << text;
  EXPECT_NE(text.find("3050  hull        left  -           right\n"), std::string::npos) << text;
}

TEST(ClashTable, OfNoRowsHasNoHead) {
  EXPECT_EQ(table_of(two_boxes("left", "right"), {.rows = 0}),
            "… and 1 hit more\n\n1 hit, 0 contacts, 0 clearance violations\n");
}

TEST(ClashTable, GroupsHaveTheirPlaceToo) {
  const ClashModel m = two_boxes("/PLANT/WD1/left", "/PLANT/WD1/right");
  const clash::Findings findings{{m.detect()}, {}};
  const clash::Grouping by_element = clash::group_results(findings, m.model, {}).value();
  const std::string text = clash_table({findings, m.model, &by_element}, {});
  EXPECT_NE(
      text.find("class            d mm  results  size m  x mm  y mm  z mm  element\n"
                "HIT           -20.000        1     0.0  1100  2050  3050  /PLANT/WD1/left\n"),
      std::string::npos)
      << text;
}

/// The table of one group by element of a name, or by another grouping of its test.
std::string group_table_of(const std::string& name, std::size_t width,
                           const clash::GroupRules& rules = {}) {
  const ClashModel m = two_boxes(name, "other");
  const clash::Findings findings{{m.detect()}, {}};
  const clash::Grouping grouping = clash::group_results(findings, m.model, rules).value();
  return clash_table({findings, m.model, &grouping}, {.width = width});
}

/// The most columns of a line of the table of groups, which an empty line ends.
std::size_t columns_of_groups(const std::string& table) {
  std::size_t widest = 0;
  std::string_view rest = std::string_view(table).substr(0, table.find("\n\n"));
  while (!rest.empty()) {
    const std::size_t end = std::min(rest.find('\n'), rest.size());
    widest = std::max(widest, columns_in(rest.substr(0, end)));
    rest.remove_prefix(std::min(end + 1, rest.size()));
  }
  return widest;
}

TEST(ClashTable, GroupsFitTheTerminalWhateverTheirNamesAndHeading) {
  const std::string long_name = "BOX 1 of EQUIPMENT with a name";
  for (const clash::GroupBy by :
       {clash::GroupBy::element, clash::GroupBy::test, clash::GroupBy::files,
        clash::GroupBy::assembly, clash::GroupBy::proximity})
    for (const std::string& name : {std::string("a"), long_name})
      for (std::size_t width = 40; width <= 100; ++width) {
        const std::string table = group_table_of(name, width, {.by = by});
        EXPECT_LE(columns_of_groups(table), width) << table;
      }
}

TEST(ClashTable, OfATestWithoutANameIsNoEmptyLineBelow) {
  const std::string table = group_table_of("a", 60, {.by = clash::GroupBy::test});
  EXPECT_NE(table.find("z mm\n    test\nHIT "), std::string::npos) << table;
  EXPECT_NE(table.find("3050\n\n1 hit"), std::string::npos) << table;
}

TEST(ClashTable, GroupsOfANarrowTerminalHaveTheirNamesBelow) {
  const std::string name = "BOX 1 of EQUIPMENT with a name";
  const std::string numbers = "class            d mm  results  size m";
  EXPECT_NE(group_table_of(name, 100).find("3050  " + name + "\n"), std::string::npos);
  const std::string below = group_table_of(name, 70);
  EXPECT_NE(below.find(numbers + "  x mm  y mm  z mm\n    element\n"), std::string::npos) << below;
  EXPECT_NE(below.find("  1100  2050  3050\n    " + name + "\n"), std::string::npos) << below;
  const std::string narrow = group_table_of(name, 50);
  EXPECT_NE(narrow.find(numbers + "\n    x mm y mm z mm  element\n"), std::string::npos) << narrow;
  EXPECT_NE(narrow.find("    1100 2050 3050  BOX 1 of EQU"), std::string::npos) << narrow;
}

TEST(TableNames, OfEastAsianScriptsTakeTwoColumnsForACharacter) {
  EXPECT_EQ(columns_in("配管 A1"), 7U);
  EXPECT_EQ(columns_in("ﾊﾞﾙﾌﾞ"), 5U) << "half-width forms are narrow";
  EXPECT_EQ(columns_in("밸브"), 4U);
  EXPECT_EQ(columns_in("e\xCC\x81"), 1U) << "the mark stands over the letter";
  EXPECT_EQ(columns_in("Bäöß …"), 6U);
  EXPECT_EQ(left_aligned("配管", 6), "配管  ");
  EXPECT_EQ(fit_to_columns("配管系統図", 6), "配…図 ");
  EXPECT_EQ(fit_to_columns("配管系統図", 10), "配管系統図");
  EXPECT_EQ(fit_to_columns("abcdefghij", 6), "ab…hij");
  const std::string table = table_of(two_boxes("配管", "x"));
  EXPECT_NE(table.find("mm  a     b\n"), std::string::npos) << table;
}

}  // namespace
}  // namespace strake::report
