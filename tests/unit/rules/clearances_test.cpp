// SPDX-License-Identifier: Apache-2.0
#include "rules/clearances.hpp"

#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

#include "strake/rules/rules.hpp"
#include "support/clash_model.hpp"
#include "support/rules_models.hpp"

namespace strake::rules {
namespace {

using test::expect_lines;
using test::warned;

TEST(Clearances, ALengthAnAttributeOrBothInEitherOrder) {
  struct Case {
    std::string text, attribute;
    double mm;
  };
  for (const Case& c :
       std::vector<Case>{{"25mm", "", 25},
                         {"0", "", 0},
                         {"@INSU", "INSU", 0},
                         {" @INSU+25mm ", "INSU", 25},
                         {"1in + @:INSU", ":INSU", 25.4},
                         {"@'Insulation + lagging' + 5 mm", "Insulation + lagging", 5},
                         {"@\"Insulation \"\"I\"\"\"", "Insulation \"I\"", 0},
                         {"1e+1mm + @A1e", "A1e", 10},
                         {"@A1e+5mm", "A1e", 5}}) {
    const auto written = parse_clearance(c.text);
    ASSERT_TRUE(written) << c.text << ": " << written.error().text();
    EXPECT_EQ(written->attribute, c.attribute) << c.text;
    EXPECT_DOUBLE_EQ(written->mm, c.mm) << c.text;
  }
}

TEST(Clearances, FaultsStateWhatToWrite) {
  for (const auto& [text, fault] : std::vector<std::pair<std::string, std::string>>{
           {"@", "'@' names no attribute"},
           {"@A B", "'@A B' names no attribute"},
           {"@'A", "names no attribute"},
           {"@'A'B'", "names no attribute"},
           {"@'' + 1mm", "names no attribute"},
           {"@A + @B", "'@A + @B' has two attributes"},
           {"1mm + @A + 2mm", "has two lengths"},
           {"@A + 25", "the length '25' has no unit"},
           {"@A + -5mm", "'-5mm' is negative"},
           {"@A + 2km", "is longer than a kilometre"},
           {"@A +", "''"},
           {"@A - 5mm", "'@A - 5mm' names no attribute"},
           {"2 * @A", "'2 * @A'"}}) {
    const auto written = parse_clearance(text);
    ASSERT_FALSE(written) << text;
    EXPECT_NE(written.error().text().find(fault), std::string::npos) << written.error().text();
    EXPECT_FALSE(written.error().mend.empty()) << text;
  }
}

/// Two pipes and a beam in a row, 60 apart; what the pipes state, and what a group above the last.
class Racks {
 public:
  Racks(const std::string& first, const std::string& second, const std::string& of_group) {
    add("a", {{"INSU", first}});
    add("b", {{"INSU", second}});
    add("beam", {});
    m_.model.groups.push_back({"/B1", model::GroupId::none});
    m_.model.set_attributes(model::GroupId{0}, {{"INSU", of_group}});
    add("c", {});
    m_.model.objects.back().parent = model::GroupId{0};
  }

  struct Outcome {
    std::vector<std::string> near;  ///< "a-b" for each clearance violation
    Diagnostics diagnostics;
  };
  [[nodiscard]] Outcome run(const std::string& text) const {
    const auto rules = Rules::parse(text, "r.toml").value();
    const auto scene = make_scene(m_.model, rules.scene_options(), {}).value();
    const Plan plan = rules.plan(scene, {}).value();
    Outcome outcome{{}, plan.diagnostics};
    for (const PlannedTest& test : plan.tests) {
      const auto report = clash::detect(scene, test.sets, test.options, test.policy, {}).value();
      for (const clash::Pair& p : report.pairs)
        outcome.near.push_back(m_.model.object(p.a).id + "-" + m_.model.object(p.b).id);
    }
    return outcome;
  }

 private:
  void add(const std::string& id, model::Attributes attributes) {
    const double x = 160.0 * static_cast<double>(m_.model.objects.size());
    m_.box(id, {x, 0, 0}, {x + 100, 100, 100});
    m_.model.objects.back().attributes = std::move(attributes);
  }
  test::ClashModel m_;
};

using Near = std::vector<std::string>;

TEST(Clearances, WhatBothObjectsStateIsAdded) {
  const Racks racks("40", "0.03 m", "2in");  // 40, 30, none, 50.8
  const auto near = [&](const std::string& clearance) {
    return racks.run("[defaults]\nclearance = " + clearance).near;
  };
  EXPECT_EQ(near("'59.9mm'"), Near{});
  EXPECT_EQ(near("'@INSU'"), (Near{"a-b"})) << "70 of both; no other pair is nearer than 50.8";
  EXPECT_EQ(near("'@INSU + 9.3mm'"), (Near{"a-b", "beam-c"})) << "50.8 and 9.3 are 60.1";
  EXPECT_EQ(near("'@INSU + 9.1mm'"), (Near{"a-b"}));
  EXPECT_EQ(near("'31mm + @INSU'"), (Near{"a-b", "b-beam", "beam-c"}));
  EXPECT_EQ(near("'@Other + 31mm'"), Near{});
}

TEST(Clearances, ATestOrACellGivesAnotherInPlaceOfTheWholeOfIt) {
  const Racks racks("40", "30", "50");
  const std::string all = "[defaults]\nclearance = '@INSU'\n[[test]]\nname = 't'\n";
  EXPECT_EQ(racks.run(all).near, (Near{"a-b"}));
  EXPECT_EQ(racks.run(all + "touch_gap = '2mm'\n").near, (Near{"a-b"}));
  EXPECT_EQ(racks.run(all + "clearance = '59mm'\n").near, Near{});
  EXPECT_EQ(racks.run(all + "clearance = 0\n").near, Near{});
  const std::string matrix =
      "[[discipline]]\nname = 'pipes'\nselect = \"name ~ '^.$'\"\n"
      "[[discipline]]\nname = 'steel'\nselect = 'beam'\n[matrix]\n[matrix.cells.pipes]\n";
  EXPECT_EQ(racks.run(matrix + "steel = { clearance = '@INSU + 15mm' }").near, (Near{"beam-c"}));
  EXPECT_EQ(racks.run(matrix + "pipes = { clearance = '@INSU' }").near, (Near{"a-b"}));
}

TEST(Clearances, WhatIsNoLengthIsCountedAndNamedAndAddsNothing) {
  const Racks racks("70mm", "thick", "'Nulref'");
  auto outcome = racks.run(
      "[[test]]\nname = 't'\nclearance = '@INSU'\n[[test]]\nname = 'u'\n"
      "clearance = '@INSU + 1mm'");
  EXPECT_EQ(outcome.near, (Near{"a-b", "a-b"}));
  EXPECT_EQ(warned(outcome.diagnostics, "clearance-not-a-length"),
            "b: the attribute 'INSU' of 1 object is no length from 0 to 1km and adds nothing to "
            "the clearance: 'thick' (1)\n")
      << "once, though two tests ask for it";
  for (const char* const odd : {"-5mm", "70bar", "2km", "1,5mm"})
    EXPECT_EQ(warned(Racks(odd, odd, odd).run("[defaults]\nclearance = '@INSU'").diagnostics,
                     "clearance-not-a-length"),
              "a: the attribute 'INSU' of 3 objects is no length from 0 to 1km and adds nothing to "
              "the clearance: '" +
                  std::string(odd) + "' (3)\n");
  outcome = racks.run(
      "[defaults]\nclearance = '@LAGGING'\n[[test]]\nname = 't'\n[[test]]\n"
      "name = 'u'\nclearance = '25mm'");
  expect_lines(
      warned(outcome.diagnostics, "clearance-attribute-missing"),
      {"r.toml, line 2: 'clearance' of [defaults]: no object has the attribute 'LAGGING'"});
}

TEST(Clearances, OfManyValuesThatAreNoLengthTheMostUsedAreNamed) {
  model::Model model;
  for (const char* const value : {"A", "B", "C", "D", "E", "F", "G", "G", "5"}) {
    model::Object& object = model.objects.emplace_back();
    object.id = std::string("of ") + value;
    object.attributes = {{"INSU", value}};
  }
  Diagnostics diagnostics;
  static_cast<void>(object_clearances(model, "INSU", "here", diagnostics));
  EXPECT_EQ(
      warned(diagnostics, "clearance-not-a-length"),
      "of A: the attribute 'INSU' of 8 objects is no length from 0 to 1km and adds nothing to "
      "the clearance: 'G' (2), 'A' (1), 'B' (1), 'C' (1), 'D' (1) and 2 more\n");
}

}  // namespace
}  // namespace strake::rules
