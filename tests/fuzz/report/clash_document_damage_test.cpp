// SPDX-License-Identifier: Apache-2.0
// Results of earlier runs cut off, changed and spliced: an error that names the file, or a
// document that compares.
#include <gtest/gtest.h>

#include <cstdlib>
#include <sstream>
#include <string>

#include "feed_clash_document.hpp"
#include "fuzz/damage.hpp"
#include "support/rounds.hpp"

namespace strake::report {
namespace {

TEST(ClashDocumentDamage, SeedsAreSound) {
  for (const test::Seed& seed : test::clash_document_seeds()) {
    std::istringstream in(seed.bytes);
    const auto document = parse_clash_document(in, seed.name);
    ASSERT_TRUE(document) << document.error().text();
    EXPECT_FALSE(document->results.empty());
  }
}

TEST(ClashDocumentDamage, AResultThatStandsThereTwiceIsNamed) {
  std::string bytes = test::clash_document_seeds()[0].bytes;
  const std::size_t from = bytes.find("{\"key\""), to = bytes.find('\n', from);
  const std::string result = bytes.substr(from, to - from);
  bytes.insert(from, result + '\n');
  std::istringstream in(bytes);
  const auto document = parse_clash_document(in, "twice.json");
  ASSERT_FALSE(document);
  EXPECT_NE(document.error().text().find("stands there twice"), std::string::npos)
      << document.error().text();
}

TEST(ClashDocumentDamage, NoBytesDoHarm) {
  const char* const splices = std::getenv("STRAKE_SPLICES");
  const auto seeds = test::clash_document_seeds();
  const auto feed = [](const std::string& bytes) { test::feed_clash_document(bytes); };
  test::truncate_everywhere(seeds[0], feed);
  test::flip_everywhere(seeds[0], feed);
  test::replace_numbers(seeds[0], feed);
  test::splice(seeds, splices != nullptr ? std::atoi(splices) : test::rounds(2000), feed);
}

}  // namespace
}  // namespace strake::report
