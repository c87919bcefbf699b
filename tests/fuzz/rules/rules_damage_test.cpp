// SPDX-License-Identifier: Apache-2.0
// Rules files cut off at every byte, changed and spliced: an error that names the file, or tests
// that run.
#include <gtest/gtest.h>

#include <cstdlib>
#include <string>

#include "feed_rules.hpp"
#include "fuzz/damage.hpp"
#include "support/rounds.hpp"
#include "support/rules_seeds.hpp"

namespace strake::rules {
namespace {

TEST(RulesDamage, SeedsAreSound) {
  for (const test::Seed& seed : test::rules_seeds()) {
    const auto rules = Rules::parse(seed.bytes, seed.name);
    EXPECT_TRUE(rules) << (rules ? "" : rules.error().text());
  }
}

TEST(RulesDamage, NoBytesDoHarm) {
  const char* const splices = std::getenv("STRAKE_SPLICES");
  const auto feed = [](const std::string& bytes) { test::feed_rules(bytes); };
  for (const test::Seed& seed : test::rules_seeds()) {
    test::truncate_everywhere(seed, feed);
    test::flip_everywhere(seed, feed);
    test::replace_numbers(seed, feed);
  }
  test::splice(test::rules_seeds(), splices != nullptr ? std::atoi(splices) : test::rounds(2000),
               feed);
}

}  // namespace
}  // namespace strake::rules
