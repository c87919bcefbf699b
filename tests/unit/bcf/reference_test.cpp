// SPDX-License-Identifier: Apache-2.0
#include "bcf/topics/reference.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

namespace strake::bcf {
namespace {

using report::DecisionStatus;

const std::string kKeyOne = "0c8x2kq9w3e4r5t6y7v8b9n0mz", kKeyTwo = "1c8x2kq9w3e4r5t6y7v8b9n0mz";

ClashReference group_of_two() {
  return {"9f3c",
          assignee_digest("Ann"),
          {{kKeyOne, DecisionStatus::reviewed}, {kKeyTwo, DecisionStatus::active}}};
}

TEST(ClashReference, ComesBackHoweverItIsLaidOut) {
  const ClashReference reference = group_of_two();
  const std::string text = "HIT\nA: x\n\n" + reference_line(reference);
  std::string laid_out = text;
  std::ranges::replace(laid_out, '\n', ' ');
  std::string broken = text;
  std::ranges::replace(broken, ' ', '\n');
  for (const std::string& some : {text, laid_out, broken, text + "  \r\n"}) {
    const std::optional<ClashReference> found = find_reference(some);
    ASSERT_TRUE(found) << some;
    EXPECT_EQ(found->group, "9f3c");
    EXPECT_EQ(found->assignee_mark, assignee_digest("Ann"));
    ASSERT_EQ(found->clashes.size(), 2U);
    EXPECT_EQ(found->clashes[0].key, kKeyOne);
    EXPECT_EQ(found->clashes[0].status, DecisionStatus::reviewed);
    EXPECT_EQ(guid_of(*found), group_guid("9f3c"));
    EXPECT_EQ(found->status(), DecisionStatus::active);
  }
}

TEST(ClashReference, IsTheLastOne) {
  const ClashReference mine{{}, assignee_digest({}), {{kKeyTwo, DecisionStatus::undecided}}};
  const ClashReference named{{}, assignee_digest("Eve"), {{kKeyOne, DecisionStatus::approved}}};
  const auto found = find_reference("A: " + reference_line(named) + "\n" + reference_line(mine));
  ASSERT_TRUE(found);
  EXPECT_EQ(guid_of(*found), clash_guid(kKeyTwo));
}

TEST(ClashReference, IsNoneWhereItIsDamaged) {
  for (const std::string& text :
       {std::string(), std::string("Strake-reference:"), std::string("Strake-reference: x"),
        std::string("Strake-reference: assignee=none"),
        "Strake-reference: assignee=none " + kKeyOne + "=settled",
        "Strake-reference: assignee=none " + kKeyOne.substr(1) + "=new",
        "Strake-reference: assignee=none " + kKeyOne + "=new " + kKeyTwo + "=new"})
    EXPECT_FALSE(find_reference(text)) << text;
}

TEST(ClashReference, AClashNamedTwiceIsThereOnce) {
  const auto found = find_reference(reference_line(group_of_two()) + " " + kKeyOne + "=approved");
  ASSERT_TRUE(found);
  ASSERT_EQ(found->clashes.size(), 2U);
  EXPECT_EQ(found->clashes[0].status, DecisionStatus::reviewed);
}

TEST(ClashReference, GuidsDistinguishClashesGroupsAndParts) {
  EXPECT_EQ(clash_guid(kKeyOne), clash_guid(kKeyOne));
  EXPECT_NE(clash_guid(kKeyOne), clash_guid(kKeyTwo));
  EXPECT_NE(clash_guid(kKeyOne), group_guid(kKeyOne));
  EXPECT_NE(part_guid(clash_guid(kKeyOne), "a"), part_guid(clash_guid(kKeyTwo), "a"));
  EXPECT_EQ(assignee_digest({}), "none");
  EXPECT_NE(assignee_digest("Ann"), assignee_digest("Bob"));
}

}  // namespace
}  // namespace strake::bcf
