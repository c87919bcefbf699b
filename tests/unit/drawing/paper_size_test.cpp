// SPDX-License-Identifier: Apache-2.0
#include "drawing/layout/paper_size.hpp"

#include <gtest/gtest.h>

#include <string>
#include <string_view>
#include <utility>

namespace strake::drawing {
namespace {

TEST(Paper, SizesAsPeopleWriteThem) {
  const auto size = [](std::string_view text) {
    const auto paper = parse_paper(text);
    return paper ? std::pair(paper->width_mm, paper->height_mm) : std::pair(0.0, 0.0);
  };
  EXPECT_EQ(size("A4"), std::pair(297.0, 210.0));
  EXPECT_EQ(size(" A0 landscape "), std::pair(1189.0, 841.0));
  EXPECT_EQ(size("A3,portrait"), std::pair(297.0, 420.0));
  EXPECT_EQ(size("A3 portrait"), std::pair(297.0, 420.0));
  EXPECT_EQ(size("A3, portrait"), std::pair(297.0, 420.0));
  EXPECT_EQ(size("900x420"), std::pair(900.0, 420.0));
  EXPECT_EQ(size("900mm x 42cm"), std::pair(900.0, 420.0));
  // In whole micrometres, as everything on paper.
  EXPECT_EQ(size("12inx12in"), std::pair(304.8, 304.8));
  EXPECT_EQ(size("100.0005mm x 99.9996mm"), std::pair(100.0, 100.0));
  for (const char* wrong :
       {"", "A5", "a3", "A3,upright", "A3 portrait landscape", "900", "900x", "x420", "900x420x1",
        "50x420", "900x21m", "-900x420", "900degx420", "1,5mx420"}) {
    const auto paper = parse_paper(wrong);
    ASSERT_FALSE(paper) << wrong;
    EXPECT_EQ(paper.error().code, ErrorCode::usage);
    EXPECT_NE(paper.error().mend.find("900mmx420mm"), std::string::npos) << wrong;
  }
}

}  // namespace
}  // namespace strake::drawing
