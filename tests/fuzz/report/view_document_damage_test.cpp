// SPDX-License-Identifier: Apache-2.0
// Drawings of earlier runs cut off, changed and spliced: an error that names the file, or a
// document that compares.
#include <gtest/gtest.h>

#include <cstddef>
#include <cstdlib>
#include <string>

#include "feed_view_document.hpp"
#include "fuzz/damage.hpp"
#include "support/rounds.hpp"

namespace strake::report {
namespace {

TEST(ViewDocumentDamage, SeedsAreSound) {
  for (const test::Seed& seed : test::view_document_seeds())
    EXPECT_FALSE(test::view_document(seed.bytes).pieces.empty());
}

TEST(ViewDocumentDamage, NoBytesDoHarm) {
  const char* const splices = std::getenv("STRAKE_SPLICES");
  const auto seeds = test::view_document_seeds();
  const auto feed = [](const std::string& bytes) { test::feed_view_document(bytes); };
  for (const std::size_t s : {0U, 2U}) {
    test::truncate_everywhere(seeds[s], feed);
    test::flip_everywhere(seeds[s], feed);
    test::replace_numbers(seeds[s], feed);
  }
  test::splice(seeds, splices != nullptr ? std::atoi(splices) : test::rounds(2000), feed);
}

}  // namespace
}  // namespace strake::report
