// SPDX-License-Identifier: Apache-2.0
// Projects cut off and changed: an error that names the file, or the model that was stored.
#include <gtest/gtest.h>

#include <cstddef>
#include <cstdlib>
#include <random>
#include <string>

#include "feed_project.hpp"
#include "support/rounds.hpp"

namespace strake::project {
namespace {

class ProjectDamage : public ::testing::Test {
 protected:
  test::Fed feed(const std::string& bytes) const {
    return test::feed_project(bytes, folder_.path(), &seed_);
  }
  /// How many damaged files a test tries.
  [[nodiscard]] static int tries(int few) {
    const char* const many = std::getenv("STRAKE_SPLICES");
    return many != nullptr ? std::atoi(many) / 10 : test::rounds(few);
  }

  test::ProjectSeed seed_ = test::project_seed();
  test::TemporaryFolder folder_;
  std::mt19937 random_{7};
};

TEST_F(ProjectDamage, TheSeedIsSound) { EXPECT_EQ(feed(seed_.file.bytes), test::Fed::read); }

TEST_F(ProjectDamage, WhatIsCutOffIsNoticed) {
  const std::string& whole = seed_.file.bytes;
  for (std::size_t length = 0; length < 200; ++length) feed(whole.substr(0, length));
  for (std::size_t length = 512; length < whole.size(); length += 512)
    EXPECT_EQ(feed(whole.substr(0, length)), test::Fed::refused) << length;
}

TEST_F(ProjectDamage, ChangedBytesAreNoticedOrDoNotMatter) {
  const std::string& whole = seed_.file.bytes;
  constexpr std::size_t kHead = 100;
  for (std::size_t at = 0; at < kHead; ++at)
    for (const unsigned mask : {0x01U, 0x80U, 0xFFU}) {
      std::string bytes = whole;
      bytes[at] = static_cast<char>(static_cast<unsigned char>(bytes[at]) ^ mask);
      feed(bytes);
    }
  int refused = 0;
  const int tried = tries(1500);
  for (int i = 0; i < tried; ++i) {
    std::string bytes = whole;
    const std::size_t at = random_() % bytes.size();
    bytes[at] = static_cast<char>(static_cast<unsigned char>(bytes[at]) ^ (1U << random_() % 8));
    if (feed(bytes) == test::Fed::refused) ++refused;
  }
  // A good part of the file is the blobs, of which every byte counts.
  EXPECT_GT(refused, tried / 20);
}

/// Heads of pages, where they say how many cells there are and where: a change there loses rows.
TEST_F(ProjectDamage, ChangedHeadsOfPagesAreNoticedOrDoNotMatter) {
  constexpr std::size_t kPage = 8192, kHead = 40;
  const std::string& whole = seed_.file.bytes;
  const int tried = tries(1500);
  for (int i = 0; i < tried; ++i) {
    std::string bytes = whole;
    const std::size_t page = random_() % (bytes.size() / kPage) * kPage;
    const std::size_t at = page + (page == 0 ? 100 : 0) + random_() % kHead;
    bytes[at] = static_cast<char>(random_() % 3 == 0 ? random_() % 256 : random_() % 3);
    feed(bytes);
  }
}

TEST_F(ProjectDamage, PagesOfOtherPlacesAreNoticedOrDoNotMatter) {
  constexpr std::size_t kPage = 8192;
  const std::string& whole = seed_.file.bytes;
  const int tried = tries(300);
  for (int i = 0; i < tried; ++i) {
    std::string bytes = whole;
    const std::size_t pages = bytes.size() / kPage;
    const std::size_t to = random_() % pages * kPage, from = random_() % pages * kPage;
    bytes.replace(to, kPage, whole, from, kPage);
    feed(bytes);
  }
}

}  // namespace
}  // namespace strake::project
