// SPDX-License-Identifier: Apache-2.0
// Sheet files and templates cut off at every byte, changed and spliced: an error that names the
// file, or a sheet.
#include <gtest/gtest.h>

#include <cstdlib>
#include <string>

#include "feed_sheet.hpp"
#include "fuzz/damage.hpp"
#include "support/rounds.hpp"

namespace strake::sheets {
namespace {

TEST(SheetsDamage, SeedsAreSound) {
  for (const test::Seed& seed : test::sheet_seeds()) {
    if (seed.bytes.starts_with('<')) continue;
    const auto sheet = test::drawn(seed.bytes, {{"f.svg", test::kSheetTemplate}});
    EXPECT_TRUE(sheet) << (sheet ? "" : sheet.error().text());
  }
}

TEST(SheetsDamage, NoBytesDoHarm) {
  const char* const splices = std::getenv("STRAKE_SPLICES");
  const auto feed = [](const std::string& bytes) { test::feed_sheet(bytes); };
  for (const test::Seed& seed : test::sheet_seeds()) {
    test::truncate_everywhere(seed, feed);
    test::flip_everywhere(seed, feed);
    test::replace_numbers(seed, feed);
  }
  test::splice(test::sheet_seeds(), splices != nullptr ? std::atoi(splices) : test::rounds(2000),
               feed);
}

}  // namespace
}  // namespace strake::sheets
