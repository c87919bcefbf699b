// SPDX-License-Identifier: Apache-2.0
// BCF files and topics cut off, changed and spliced: an error that names the file, or topics of
// which all is as it is promised.
#include <gtest/gtest.h>

#include <cstdlib>
#include <random>
#include <string>
#include <utility>

#include "feed_bcf.hpp"
#include "fuzz/damage.hpp"
#include "support/rounds.hpp"

namespace strake::bcf {
namespace {

class BcfDamage : public ::testing::Test {
 protected:
  void feed(const std::string& bytes) const { test::feed_bcf(bytes, folder_); }
  [[nodiscard]] Result<ReadFile> read(const std::string& bytes) const {
    return read_bcf(folder_.write("x.bcf", bytes));
  }

  test::TemporaryFolder folder_;
  std::vector<test::Seed> seeds_ = test::bcf_seeds();
};

TEST_F(BcfDamage, SeedsAreSound) {
  for (const test::Seed& seed : seeds_) {
    const auto file = read(seed.bytes.starts_with('<') ? test::bcf_of(seed.bytes) : seed.bytes);
    ASSERT_TRUE(file) << seed.name << ": " << file.error().text();
    EXPECT_TRUE(file->diagnostics.counts().empty()) << seed.name;
    EXPECT_EQ(file->topics.size(), seed.bytes.starts_with('<') ? 1U : 2U) << seed.name;
  }
}

TEST_F(BcfDamage, NoTopicDoesHarm) {
  const auto fed = [this](const std::string& bytes) { feed(bytes); };
  const test::Seed& topic = seeds_.back();
  test::truncate_everywhere(topic, fed);
  test::replace_numbers(topic, fed);
  std::mt19937 random(11);
  for (int i = 0; i < test::rounds(1000); ++i) {
    std::string bytes = topic.bytes;
    for (unsigned k = 0; k < 1 + random() % 4; ++k)
      bytes[random() % bytes.size()] = static_cast<char>(random() % 256);
    feed(bytes);
  }
}

TEST_F(BcfDamage, NoArchiveDoesHarm) {
  std::mt19937 random(12);
  const char* const splices = std::getenv("STRAKE_SPLICES");
  const int tries = splices != nullptr ? std::atoi(splices) / 10 : test::rounds(1000);
  for (int i = 0; i < tries; ++i) {
    std::string bytes = seeds_[random() % 2].bytes;
    for (unsigned k = 0; k < 1 + random() % 8; ++k)
      bytes[random() % bytes.size()] ^= static_cast<char>(1U << random() % 8);
    feed(bytes);
    feed(bytes.substr(0, random() % bytes.size()));
  }
  test::splice(seeds_, tries, [this](const std::string& bytes) { feed(bytes); });
}

TEST_F(BcfDamage, DepthAndEntitiesDoNoHarm) {
  constexpr std::size_t kDeep = 300'000;
  std::string deep = "<Markup>";
  for (std::size_t i = 0; i < kDeep; ++i) deep += "<a>";
  feed(deep);
  for (std::size_t i = 0; i < kDeep; ++i) deep += "</a>";
  feed(deep + "</Markup>");
  std::string laughs = "<!DOCTYPE m [<!ENTITY a0 \"ha\">";
  for (int i = 1; i < 30; ++i) {
    const std::string before = "&a" + std::to_string(i - 1) + ";";
    laughs += "<!ENTITY a" + std::to_string(i) + " \"" + before + before + before + "\">";
  }
  laughs += "<!ENTITY file SYSTEM \"/etc/hostname\">]>";
  const auto file = read(test::bcf_of(
      laughs + R"(<Markup><Topic Guid="x"><Title>&a29;</Title><AssignedTo>&file;</AssignedTo>)"
               "</Topic></Markup>"));
  ASSERT_TRUE(file);
  ASSERT_EQ(file->topics.size(), 1U);
  EXPECT_EQ(file->topics[0].title, "&a29;") << "nothing is expanded";
  EXPECT_EQ(file->topics[0].assignee, "&file;") << "nothing is opened";
}

}  // namespace
}  // namespace strake::bcf
