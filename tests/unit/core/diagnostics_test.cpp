// SPDX-License-Identifier: Apache-2.0
#include "strake/core/diagnostics.hpp"

#include <gtest/gtest.h>

#include <string>

#include "strake/core/result.hpp"
#include "strake/core/version.hpp"

namespace strake {
namespace {

TEST(Diagnostics, counts_all_and_keeps_the_first) {
  Diagnostics all;
  for (int i = 0; i < 250; ++i) all.add(Severity::skipped, "bad", std::to_string(i), "here");
  all.add(Severity::note, "odd", "once", "there");
  EXPECT_EQ(all.count("bad"), 250U);
  EXPECT_EQ(all.count("odd"), 1U);
  EXPECT_EQ(all.count("none"), 0U);
  EXPECT_EQ(all.skipped(), 250U);
  ASSERT_EQ(all.kept().size(), Diagnostics::kMaxPerCode + 1);
  EXPECT_EQ(all.kept()[99].message, "99");
}

TEST(Diagnostics, more_are_counted_where_all_that_may_be_are_kept) {
  Diagnostics all;
  for (std::size_t i = 0; i < Diagnostics::kMaxPerCode; ++i)
    all.add(Severity::skipped, "many", "", "");
  all.add(Severity::note, "few", "", "");
  all.count_more("many", 900);
  all.count_more("few", 900);
  all.count_more("none", 900);
  EXPECT_EQ(all.count("many"), Diagnostics::kMaxPerCode + 900);
  EXPECT_EQ(all.count("few"), 1U);
  EXPECT_EQ(all.counts().size(), 2U);
  EXPECT_EQ(all.kept().size(), Diagnostics::kMaxPerCode + 1);
}

TEST(Diagnostics, append_is_adding_one_by_one) {
  for (const int first : {0, 60, 100, 150})
    for (const int second : {0, 60, 100, 150}) {
      Diagnostics whole, left, right;
      for (int i = 0; i < first + second; ++i) {
        const std::string message = std::to_string(i);
        whole.add(Severity::skipped, "bad", message, "");
        (i < first ? left : right).add(Severity::skipped, "bad", message, "");
      }
      left.append(right);
      EXPECT_EQ(left.count("bad"), whole.count("bad"));
      ASSERT_EQ(left.kept().size(), whole.kept().size()) << first << " + " << second;
      for (std::size_t i = 0; i < whole.kept().size(); ++i)
        EXPECT_EQ(left.kept()[i].message, whole.kept()[i].message);
    }
}

TEST(Error, names_place_fault_and_mend) {
  const Error whole{ErrorCode::input, "is empty", "ship.glb", "export it again"};
  EXPECT_EQ(whole.text(), "ship.glb: is empty (export it again)");
  EXPECT_EQ((Error{ErrorCode::input, "is empty", "", ""}).text(), "is empty");
}

TEST(Result, holds_a_value_or_an_error) {
  const Result<int> good = 7;
  ASSERT_TRUE(good);
  EXPECT_EQ(*good, 7);
  const Result<int> bad = Error{ErrorCode::usage, "no", "", ""};
  ASSERT_FALSE(bad);
  EXPECT_EQ(bad.error().message, "no");
  EXPECT_THROW((void)bad.value(), std::bad_variant_access);
  EXPECT_TRUE(Status());
  EXPECT_FALSE(Status(Error{}));
}

TEST(Version, has_three_numbers) {
  EXPECT_EQ(std::count(version().begin(), version().end(), '.'), 2);
}

}  // namespace
}  // namespace strake
