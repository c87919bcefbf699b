// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <string>

#include "support/rules_models.hpp"

namespace strake::rules {
namespace {

using test::Counts;
using test::exempted;
using test::ResultLines;
using test::Row;
using test::warned;

constexpr const char* kRule = "[[same_assembly]]\nname = \"parts of one\"\nlevel = \"assembly\"\n";

TEST(Assemblies, NamesOfUnnamedElementsGiveTheLevel) {
  Row row;
  const auto zone = row.group("/ZONE", row.group("/SITE"));
  const auto pump = row.group("/P-101", zone), base = row.group("/P-101/BASE", pump);
  const auto tank = row.group("/T-101", zone);
  row.cube("BOX 1 of EQUIPMENT /P-101", {}, pump)
      .cube("CYLINDER 1 of SUBEQUIPMENT /P-101/BASE", {}, base)
      .cube("/P-101/N1", {}, base)  // a nozzle with a name, of the same pump
      .cube("BOX 1 of SUBEQUIPMENT 1 of EQUIPMENT /T-101", {},
            row.group("SUBEQUIPMENT 1 of EQUIPMENT /T-101", tank))
      .cube("BOX 2 of EQUIPMENT /T-101", {}, tank);
  const auto outcome = row.run(kRule);
  EXPECT_EQ(outcome.reported[0],
            (ResultLines{"/P-101/N1-BOX 1 of SUBEQUIPMENT 1 of EQUIPMENT /T-101 HIT"}));
  EXPECT_EQ(exempted(outcome.reports[0]), (Counts{{"parts of one", 3}}));
}

TEST(Assemblies, APipeIsOneAssemblyForEachBranch) {
  Row row;
  const auto pipe = row.group("/100-B-1", row.group("/ZONE", row.group("/SITE")));
  const auto one = row.group("/100-B-1/B1", pipe), two = row.group("/100-B-1/B2", pipe);
  row.cube("ELBOW 1 of BRANCH /100-B-1/B1", {}, one)
      .cube("a", {}, one)  // a valve with a name
      .cube("b", {}, two)  // nothing shows that this one is a branch, but its level
      .cube("c", {}, two);
  EXPECT_EQ(row.hits(kRule), (ResultLines{"a-b HIT"}));
}

TEST(Assemblies, WhatWasExportedFromBelowASite) {
  Row row;
  const auto pump = row.group("/P-101", row.group("/ZONE")), fan = row.group("/F-1");
  row.cube("BOX 1 of EQUIPMENT /P-101", {}, pump)
      .cube("BOX 2 of EQUIPMENT /P-101", {}, pump)
      .cube("BOX 1 of SUBEQUIPMENT 1 of EQUIPMENT /F-1", {},
            row.group("SUBEQUIPMENT 1 of EQUIPMENT /F-1", fan))
      .cube("a", {}, fan)
      .cube("b", {}, row.group("/F-1/B", row.group("/OTHER SITE")))
      .cube("c", {}, row.group("/F-1/C", row.group("/OTHER SITE")));
  EXPECT_EQ(row.hits(kRule),
            (ResultLines{"BOX 2 of EQUIPMENT /P-101-BOX 1 of SUBEQUIPMENT 1 of EQUIPMENT /F-1 HIT",
                         "a-b HIT", "b-c HIT"}));
}

TEST(Assemblies, TheAttributeTypeDecides) {
  Row row;
  const auto site = row.group("/SITE", model::Attributes{{"Type", "SITE"}});
  const auto deck = row.group("/DECK", site), rack = row.group("/RACK", site);
  EXPECT_EQ(row.cube("a", {}, deck).cube("b", {}, deck).cube("c", {}, rack).hits(kRule),
            (ResultLines{"a-b HIT", "b-c HIT"}))
      << "nothing is known below a site";
  Row typed;
  const auto skid = typed.group("/SKID", model::Attributes{{"Type", "'STRU'"}});
  EXPECT_EQ(
      typed.cube("a", {}, typed.group("1", skid)).cube("b", {}, typed.group("2", skid)).hits(kRule),
      ResultLines{});
}

TEST(Assemblies, AWordThatMeansADisciplineIsNoAssembly) {
  Row row;
  const auto hvac = row.group("HVAC", model::Attributes{{"Type", "HVAC"}});
  row.cube("a", {}, hvac).cube("b", {}, hvac).cube("c", {}, row.group("ducts", hvac));
  row.cube("BOX 1 of EQUIPMENT /P-1", {}, row.group("/P-2"));  // of another owner
  const auto outcome = row.run(kRule);
  EXPECT_EQ(outcome.reported[0].size(), 3U);
  EXPECT_NE(warned(outcome.diagnostics, "rule-matches-nothing").find("BOX 1 of EQUIPMENT"),
            std::string::npos);
}

TEST(Assemblies, AnEquipmentBelowItsLevelIsOneOfItsOwn) {
  Row row;
  const auto zone = row.group("/ZONE", row.group("/SITE"));
  const auto skid = row.group("/SKID", zone);
  const auto one = row.group("/P-1", skid), two = row.group("/P-2", skid);
  row.cube("BOX 1 of STRUCTURE /SKID", {}, skid)
      .cube("BOX 1 of EQUIPMENT /P-1", {}, one)
      .cube("BOX 2 of EQUIPMENT /P-1", {}, one)
      .cube("BOX 1 of EQUIPMENT /P-2", {}, two);
  EXPECT_EQ(row.hits(kRule), (ResultLines{"BOX 1 of STRUCTURE /SKID-BOX 1 of EQUIPMENT /P-1 HIT",
                                          "BOX 2 of EQUIPMENT /P-1-BOX 1 of EQUIPMENT /P-2 HIT"}));
}

}  // namespace
}  // namespace strake::rules
