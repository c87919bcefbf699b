// SPDX-License-Identifier: Apache-2.0
#include "rules/profiles.hpp"

#include <gtest/gtest.h>

#include <string>

#include "strake/clash/options.hpp"
#include "strake/rules/rules.hpp"
#include "support/rules_models.hpp"

namespace strake::rules {
namespace {

using test::ResultLines;
using test::Row;

/// Cubes of a row overlap by 10 mm; allowing that much makes contacts of them.
const std::string kContacts = "[defaults]\ntouch_overlap = \"11mm\"\nthickness_cap = false\n";

std::string text_of(std::string_view profile) {
  const Profile* const found = find_profile(profile);
  if (found != nullptr) return std::string(found->text);
  ADD_FAILURE() << profile;
  return {};
}

TEST(Profiles, AreRulesWithoutTestsAndTolerances) {
  ASSERT_EQ(profiles().size(), 3U);
  for (const Profile& profile : profiles()) {
    const auto rules = Rules::parse(profile.text, profile.file());
    ASSERT_TRUE(rules) << rules.error().text();
    EXPECT_EQ(rules->file(), std::string(profile.name) + ".toml");
    EXPECT_EQ(rules->scene_options().sag_mm, clash::scene_options({}).sag_mm);
    const auto outcome = Row().cube("a").cube("b").run(profile.text);
    ASSERT_EQ(outcome.reports.size(), 1U);
    EXPECT_EQ(outcome.reports[0].name, "");
    EXPECT_EQ(outcome.reported[0], (ResultLines{"a-b HIT"})) << "nothing tells what these are";
  }
  EXPECT_EQ(find_profile("none"), nullptr);
}

TEST(Profiles, APlantHasSpaceKeptFreeAndABuildingHasNone) {
  EXPECT_TRUE(Rules::parse(text_of("plant"), "p")->scene_options().obstruction);
  EXPECT_TRUE(Rules::parse(text_of("plant"), "p")->scene_options().insulation);
  EXPECT_FALSE(Rules::parse(text_of("building"), "b")->scene_options().obstruction);
}

TEST(Profiles, ANozzleMeetsItsBranch) {
  Row row;
  const auto zone = row.group("/ZONE", row.group("/SITE"));
  const auto branch = row.group("/B1", row.group("/100-B-1", zone)), pump = row.group("/P-1", zone);
  row.cube("ELBOW 1 of BRANCH /B1", {}, branch)
      .cube("/P-1/N1", {{"Cref", "/B1"}}, pump)
      .cube("BOX 1 of EQUIPMENT /P-1", {}, pump)
      .cube("TUBE 1 of BRANCH /B1", {}, branch);
  EXPECT_EQ(row.hits(text_of("plant")),
            (ResultLines{"BOX 1 of EQUIPMENT /P-1-TUBE 1 of BRANCH /B1 HIT"}));
}

TEST(Profiles, WeldsOfAShipAreAllowedWhileTheyAreNoHit) {
  Row row;
  const auto zone = row.group("ZONE-01");
  const auto hull = row.group("HULL", zone), steel = row.group("STRUCTURE", zone);
  const auto pipes = row.group("PIPING", zone), cabins = row.group("ACCOMMODATION", zone);
  const auto cabin = row.group("CABIN 101", cabins), other = row.group("CABIN 102", cabins);
  row.cube("deck", {}, hull)
      .cube("beam", {}, steel)
      .cube("steel pipe", {}, pipes)
      .cube("wall", {}, cabin)
      .cube("bed", {}, cabin)
      .cube("wall 2", {}, other);
  EXPECT_EQ(row.hits(text_of("ship")), (ResultLines{"deck-beam HIT", "beam-steel pipe HIT",
                                                    "steel pipe-wall HIT", "bed-wall 2 HIT"}));
  EXPECT_EQ(row.hits(kContacts + text_of("ship")),
            (ResultLines{"deck-beam CONTACT by welds of steel", "beam-steel pipe CONTACT",
                         "steel pipe-wall CONTACT",
                         "bed-wall 2 CONTACT by fitted parts of the accommodation"}));
}

TEST(Profiles, RoomsOfABuildingAreNotBuilt) {
  const std::string text = text_of("building");
  const Row row = Row()
                      .cube("room", {{"type", "IfcSpace"}})
                      .cube("wall", {{"type", "IfcWallStandardCase"}})
                      .cube("IfcSlab/1")
                      .cube("duct", {{"ifcType", "IfcDuctSegment"}})
                      .cube("IfcOpeningElement/7");
  EXPECT_EQ(row.hits(text), (ResultLines{"wall-IfcSlab/1 HIT", "IfcSlab/1-duct HIT"}));
  EXPECT_EQ(
      row.hits(kContacts + text),
      (ResultLines{"wall-IfcSlab/1 CONTACT by joints of the fabric", "IfcSlab/1-duct CONTACT"}));
}

}  // namespace
}  // namespace strake::rules
