// SPDX-License-Identifier: Apache-2.0
// Damage done to small files, each of which `feed` must answer for: called with the bytes.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <random>
#include <span>
#include <string>
#include <vector>

#include "support/io_seeds.hpp"
#include "support/rounds.hpp"

namespace strake::test {

template <class Feed>
void truncate_everywhere(const Seed& seed, const Feed& feed) {
  for (std::size_t length = 0; length <= seed.bytes.size(); ++length)
    feed(seed.bytes.substr(0, length));
}

template <class Feed>
void flip_everywhere(const Seed& seed, const Feed& feed) {
  constexpr std::array<unsigned char, 6> kMasks{0x01, 0x80, 0xFF, 0x04, 0x10, 0x20};
  constexpr std::size_t kTried = kSanitized ? 3 : kMasks.size();
  for (std::size_t at = 0; at < seed.bytes.size(); ++at)
    for (const unsigned char mask : std::span(kMasks).first(kTried)) {
      std::string bytes = seed.bytes;
      bytes[at] = static_cast<char>(static_cast<unsigned char>(bytes[at]) ^ mask);
      feed(bytes);
    }
}

/// Runs of digits become numbers that no reader should trust.
template <class Feed>
void replace_numbers(const Seed& seed, const Feed& feed) {
  const auto is_digit = [](char c) { return c >= '0' && c <= '9'; };
  for (std::size_t at = 0; at < seed.bytes.size(); ++at) {
    if (!is_digit(seed.bytes[at]) || (at > 0 && is_digit(seed.bytes[at - 1]))) continue;
    std::size_t end = at;
    while (end < seed.bytes.size() && is_digit(seed.bytes[end])) ++end;
    for (const char* number : {"-1", "0", "4294967295", "4294967296", "9007199254740992",
                               "18446744073709551616", "1e308", "1e999", "-0.5", "nan", ""}) {
      std::string bytes = seed.bytes;
      bytes.replace(at, end - at, number);
      feed(bytes);
    }
  }
}

/// The beginning of one and the end of another, `count` times.
template <class Feed>
void splice(const std::vector<Seed>& seeds, int count, const Feed& feed) {
  constexpr std::uint32_t kSeed = 99;
  std::mt19937 random(kSeed);
  for (int i = 0; i < count; ++i) {
    const std::string& a = seeds[random() % seeds.size()].bytes;
    const std::string& b = seeds[random() % seeds.size()].bytes;
    const std::size_t cut = random() % a.size(), from = random() % b.size();
    feed(a.substr(0, cut) + b.substr(from));
  }
}

}  // namespace strake::test
