// SPDX-License-Identifier: Apache-2.0
// Small files cut off at every byte, with every byte changed, and with numbers replaced by hostile
// ones: every answer must be a sound model or an error, under the sanitizers too.
#include <gtest/gtest.h>

#include <array>
#include <random>
#include <string>

#include "fuzz_reader.hpp"
#include "support/io_seeds.hpp"

namespace strake::io {
namespace {

void feed(const Reader& reader, const std::string& name, const std::string& bytes) {
  test::feed(reader, name.c_str(), reinterpret_cast<const std::uint8_t*>(bytes.data()),
             bytes.size());
}

void truncate_everywhere(const Reader& reader, const test::Seed& seed) {
  for (std::size_t length = 0; length <= seed.bytes.size(); ++length)
    feed(reader, seed.name, seed.bytes.substr(0, length));
}

void flip_everywhere(const Reader& reader, const test::Seed& seed) {
  constexpr std::array<unsigned char, 6> kMasks{0x01, 0x04, 0x10, 0x20, 0x80, 0xFF};
  for (std::size_t at = 0; at < seed.bytes.size(); ++at)
    for (const unsigned char mask : kMasks) {
      std::string bytes = seed.bytes;
      bytes[at] = static_cast<char>(static_cast<unsigned char>(bytes[at]) ^ mask);
      feed(reader, seed.name, bytes);
    }
}

/// Runs of digits become numbers that no reader should trust.
void replace_numbers(const Reader& reader, const test::Seed& seed) {
  const auto is_digit = [](char c) { return c >= '0' && c <= '9'; };
  for (std::size_t at = 0; at < seed.bytes.size(); ++at) {
    if (!is_digit(seed.bytes[at]) || (at > 0 && is_digit(seed.bytes[at - 1]))) continue;
    std::size_t end = at;
    while (end < seed.bytes.size() && is_digit(seed.bytes[end])) ++end;
    for (const char* number : {"-1", "0", "4294967295", "4294967296", "9007199254740992",
                               "18446744073709551616", "1e308", "1e999", "-0.5", "nan", ""}) {
      std::string bytes = seed.bytes;
      bytes.replace(at, end - at, number);
      feed(reader, seed.name, bytes);
    }
  }
}

void splice(const Reader& reader, const std::vector<test::Seed>& seeds) {
  const unsigned number = 99;
  SCOPED_TRACE(number);
  std::mt19937 random(number);
  for (int i = 0; i < 3000; ++i) {
    const std::string& a = seeds[random() % seeds.size()].bytes;
    const std::string& b = seeds[random() % seeds.size()].bytes;
    const std::size_t cut = random() % a.size(), from = random() % b.size();
    feed(reader, seeds.front().name, a.substr(0, cut) + b.substr(from));
  }
}

void damage(const Reader& reader, const std::vector<test::Seed>& seeds) {
  for (const test::Seed& seed : seeds) {
    truncate_everywhere(reader, seed);
    flip_everywhere(reader, seed);
    replace_numbers(reader, seed);
  }
  splice(reader, seeds);
}

TEST(Damage, ObjReaderSurvives) { damage(*make_obj_reader(), test::obj_seeds()); }
TEST(Damage, StlReaderSurvives) { damage(*make_stl_reader(), test::stl_seeds()); }
TEST(Damage, GltfReaderSurvives) { damage(*make_gltf_reader(), test::gltf_seeds()); }

TEST(Damage, ReadersSurviveEachOthersFiles) {
  for (const auto& reader : all_readers())
    for (const auto& seeds : {test::obj_seeds(), test::stl_seeds(), test::gltf_seeds()})
      for (const test::Seed& seed : seeds) feed(*reader, seed.name, seed.bytes);
}

TEST(Damage, SeedsAreSound) {
  const auto check = [](const Reader& reader, const std::vector<test::Seed>& seeds) {
    for (const test::Seed& seed : seeds) {
      const auto model = reader.read({seed.name, std::as_bytes(std::span(seed.bytes))}, {}, {});
      EXPECT_TRUE(model) << seed.name << ": " << (model ? "" : model.error().text());
      if (!model) continue;
      EXPECT_EQ(model->diagnostics.skipped(), 0U) << seed.name;
    }
  };
  check(*make_obj_reader(), test::obj_seeds());
  check(*make_stl_reader(), test::stl_seeds());
  check(*make_gltf_reader(), test::gltf_seeds());
}

}  // namespace
}  // namespace strake::io
