// SPDX-License-Identifier: Apache-2.0
#include "model/object_assemblies.hpp"

#include <gtest/gtest.h>

namespace strake::model {
namespace {

TEST(CountedNames, AreThoseThatADatabaseMakesUp) {
  EXPECT_TRUE(is_counted_name("BOX 2 of EQUIPMENT /P-101"));
  EXPECT_TRUE(is_counted_name("SUBEQUIPMENT 12 of EQUIPMENT 3 of ZONE /Z"));
  for (const char* const name :
       {"", "/P-101", "BOX", "BOX 2", "BOX of EQUIPMENT", "2 of 3", "BOX 2of /P"})
    EXPECT_FALSE(is_counted_name(name)) << name;
}

TEST(ObjectAssemblies, AreTheNearestGroupsWithNamesOfTheirOwn) {
  Model m;
  m.groups = {{"/SITE", GroupId::none},
              {"/P", GroupId{0}},
              {"SUBEQUIPMENT 1 of EQUIPMENT /P", GroupId{1}},
              {"", GroupId{2}},
              {"BOX 1 of SITE /SITE", GroupId::none}};
  m.objects.resize(5);
  m.objects[0].parent = GroupId{3};  // below a group without a name and one that only counts
  m.objects[1].parent = GroupId{1};
  m.objects[1].name = "/P/N1";
  m.objects[2].parent = GroupId{0};  // an object with others below it
  m.objects[2].name = "/P";
  m.objects[3].parent = GroupId{4};  // nothing above it has a name
  const ObjectAssemblies assemblies(m);
  EXPECT_EQ(assemblies.of(ObjectId{0}), GroupId{1});
  EXPECT_EQ(assemblies.of(ObjectId{1}), GroupId{1});
  EXPECT_EQ(assemblies.of(ObjectId{2}), GroupId{1});
  EXPECT_EQ(assemblies.of(ObjectId{3}), GroupId::none);
  EXPECT_EQ(assemblies.of(ObjectId{4}), GroupId::none) << "it is in no group";
  EXPECT_EQ(assemblies.path(GroupId{1}), "/SITE/P");
  EXPECT_EQ(assemblies.path(GroupId::none), "");
}

}  // namespace
}  // namespace strake::model
