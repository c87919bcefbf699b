// SPDX-License-Identifier: Apache-2.0
#include "model/attribute_uses.hpp"

#include <gtest/gtest.h>

#include <string_view>
#include <vector>

namespace strake::model {
namespace {

using Views = std::vector<std::string_view>;

/// Two groups, one in the other, and three objects in them; the last is of another file.
Model stating_model() {
  Model m;
  m.groups = {{"site", GroupId::none}, {"zone", GroupId{0}}};
  m.set_attributes(GroupId{0}, {{"Area", "A1"}, {"Tag", "site"}});
  m.set_attributes(GroupId{1}, {{"Tag", "zone"}, {"Tag", "also"}});
  m.files.resize(2);
  m.objects.resize(3);
  m.objects[0].parent = GroupId{1};
  m.objects[1].parent = GroupId{1};
  m.objects[1].attributes = {{"Tag", "own"}, {"Bore", "100"}};
  m.objects[2].parent = GroupId{0};
  m.objects[2].file = 1;
  return m;
}

TEST(AttributeUses, CountObjectsThatStateOrInherit) {
  const Model m = stating_model();
  const std::vector<AttributeUse> uses = attribute_uses(m, 0, 2);
  ASSERT_EQ(uses.size(), 3U);
  EXPECT_EQ(uses[0].name, "Area");
  EXPECT_EQ(uses[0].objects, 3U);
  EXPECT_EQ(uses[0].values, 1U);
  EXPECT_EQ(uses[1].name, "Bore");
  EXPECT_EQ(uses[1].objects, 1U);
  // What stands nearer hides what groups farther out say; a name may have several values.
  EXPECT_EQ(uses[2].name, "Tag");
  EXPECT_EQ(uses[2].objects, 3U);
  EXPECT_EQ(uses[2].values, 4U);
  EXPECT_EQ(uses[2].examples, (Views{"zone", "also", "own"}));
}

TEST(AttributeUses, OfAFileKnowTheOthersNot) {
  const Model m = stating_model();
  const std::vector<AttributeUse> first = attribute_uses(m, 0, 1), second = attribute_uses(m, 1, 2);
  ASSERT_EQ(first.size(), 3U);
  EXPECT_EQ(first[2].values, 3U) << "the value of the site is hidden from both objects";
  ASSERT_EQ(second.size(), 2U);
  EXPECT_EQ(second[1].examples, (Views{"site"}));
  EXPECT_TRUE(attribute_uses(m, 2, 2).empty());
}

TEST(AttributeUses, AgreeWithWhatAnObjectStates) {
  const Model m = stating_model();
  for (const AttributeUse& use : attribute_uses(m, 0, 2)) {
    std::uint64_t objects = 0;
    for (const Object& object : m.objects)
      objects += m.stated(object, use.name).attributes != nullptr ? 1U : 0U;
    EXPECT_EQ(use.objects, objects) << use.name;
  }
}

TEST(NoObjectStates, NamesWhatIsSpeltAlike) {
  const Model m = stating_model();
  const std::vector<AttributeUse> uses = attribute_uses(m, 0, 2);
  EXPECT_EQ(no_object_states("TAG", uses), "no object states @TAG; spelt alike: @Tag");
  EXPECT_EQ(no_object_states("Tga", uses), "no object states @Tga; spelt alike: @Tag");
  EXPECT_EQ(no_object_states("re", uses), "no object states @re; spelt alike: @Area, @Bore");
  EXPECT_EQ(no_object_states("Insulation", uses),
            "no object states @Insulation; there are @Area, @Tag, @Bore");
  EXPECT_EQ(no_object_states("Tag", {}), "no object states @Tag, nor any other attribute");
}

}  // namespace
}  // namespace strake::model
