// SPDX-License-Identifier: Apache-2.0
#include "cli/verbs/draw/brute_force_cost.hpp"

#include <gtest/gtest.h>

namespace strake::cli {
namespace {

TEST(BruteForceCost, IsTheNumberOfTestsAndATimeWithoutFalseDigits) {
  const auto reported = [](std::uint64_t edges, std::uint64_t triangles, unsigned workers) {
    return brute_force_cost({edges, triangles, edges * triangles}, workers);
  };
  EXPECT_NE(reported(9710, 15456, 1)
                .find("9710 edges and 15456 triangles, 150 million tests: about 26 seconds with 1 "
                      "worker;"),
            std::string::npos);
  EXPECT_NE(reported(12, 12, 4).find("triangles, 144 tests"), std::string::npos);
  EXPECT_NE(reported(12, 12, 4).find("less than a second with 4 workers"), std::string::npos);
  EXPECT_NE(reported(67000, 131000, 1).find("about 24 minutes"), std::string::npos);
  EXPECT_NE(reported(67000, 131000, 2).find("about 12 minutes"), std::string::npos);
  EXPECT_NE(reported(600000, 1000000, 8).find("about 3 hours"), std::string::npos);
  EXPECT_NE(reported(6000000, 10000000, 8).find("about 14 days"), std::string::npos);
}

}  // namespace
}  // namespace strake::cli
