// SPDX-License-Identifier: Apache-2.0
#include "cli/options/nearest_word.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace strake::cli {
namespace {

const std::vector<std::string> kVerbs{"clash", "draw", "info", "generate", "help"};

TEST(NearestWord, CountsLettersThatChangePlacesOnce) {
  EXPECT_EQ(nearest_word("clahs", kVerbs), "clash");
  EXPECT_EQ(nearest_word("drwa", kVerbs), "draw");
  EXPECT_EQ(nearest_word("clas", kVerbs), "clash");
  EXPECT_EQ(nearest_word("clashh", kVerbs), "clash");
  EXPECT_EQ(nearest_word("genarat", kVerbs), "generate");
}

TEST(NearestWord, NamesNoneThatIsNotNear) {
  for (const char* const word : {"", "x", "frobnicate", "hull", "drraww"})
    EXPECT_EQ(nearest_word(word, kVerbs), "") << word;
  EXPECT_EQ(nearest_word(std::string(1000, 'c'), kVerbs), "");
  EXPECT_EQ(nearest_word("clash", {}), "");
}

TEST(NearestWord, RequestsOrStatesTheOther) {
  EXPECT_EQ(did_you_mean("inf", kVerbs, "no"), "did you mean 'info'?");
  EXPECT_EQ(did_you_mean("hatch", kVerbs, "no"), "no");
}

}  // namespace
}  // namespace strake::cli
