// SPDX-License-Identifier: Apache-2.0
#include "strake/core/hash.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <set>
#include <span>
#include <string>
#include <string_view>

#include "core/checksum.hpp"
#include "core/seeded_hash.hpp"

namespace strake {
namespace {

Hash128 of(std::string_view text) { return hash_bytes(std::as_bytes(std::span(text))); }

TEST(Hash, is_the_published_one) {
  // XXH3 128 bits, seed 0, from the reference program (xxhsum -H2).
  EXPECT_EQ(of("").text(), "99aa06d3014798d86001c324468d497f");
  EXPECT_EQ(of("a").text(), "a96faf705af16834e6c632b61e964e1f");
}

TEST(Hash, of_a_sequence_stays_the_same_for_ever) {
  Hasher hasher;
  hasher.add(std::uint64_t{1}).add(-2.5).add("name").add(std::int32_t{-7});
  // Spelled out: words little-endian, the string behind its length.
  using namespace std::string_view_literals;
  EXPECT_EQ(hasher.value(), of("\1\0\0\0\0\0\0\0"
                               "\0\0\0\0\0\0\x04\xc0"
                               "\4\0\0\0\0\0\0\0"
                               "name"
                               "\xf9\xff\xff\xff\xff\xff\xff\xff"sv));
  EXPECT_EQ(hasher.value().text(), "e6534c508abfc33be30b9c91a29613dd");
}

TEST(Hash, distinguishes_sequences) {
  std::set<std::string> found;
  const auto insert = [&](Hasher& hasher) { return found.insert(hasher.value().text()).second; };
  Hasher empty, ab_c, a_bc, number, text, order;
  EXPECT_TRUE(insert(empty));
  EXPECT_TRUE(insert(ab_c.add("ab").add("c")));
  EXPECT_TRUE(insert(a_bc.add("a").add("bc")));
  EXPECT_TRUE(insert(number.add(1.0).add(2.0)));
  EXPECT_TRUE(insert(order.add(2.0).add(1.0)));
  EXPECT_TRUE(insert(text.add("")));
}

TEST(Hash, knows_one_zero_and_one_nan) {
  Hasher plus, minus, nan, other_nan;
  EXPECT_EQ(plus.add(0.0).value(), minus.add(-0.0).value());
  EXPECT_EQ(nan.add(std::nan("")).value(), other_nan.add(-std::nan("1")).value());
}

TEST(Hash, does_not_depend_on_how_bytes_arrive) {
  std::string text;
  for (int i = 0; i < 5000; ++i) text += static_cast<char>(i * 37 % 251);
  Hasher whole, again;
  whole.add(text);
  again.add(std::as_bytes(std::span(text)));
  EXPECT_EQ(whole.value(), again.value());
}

TEST(Hash, of_a_sequence_does_not_depend_on_how_long_it_is) {
  // Short sequences are hashed at once, longer ones piece by piece: there is no seam between them.
  for (std::uint64_t words = 120; words < 140; ++words) {
    Hasher hasher;
    std::string spelled;
    for (std::uint64_t word = 0; word < words; ++word) {
      hasher.add(word);
      spelled += static_cast<char>(word);
      spelled.append(7, '\0');
      EXPECT_EQ(hasher.value(), of(spelled)) << words << ' ' << word;
    }
  }
}

TEST(Hash, text_has_leading_zeros) {
  EXPECT_EQ((Hash128{0, 0xabc}).text(), "00000000000000000000000000000abc");
}

TEST(Checksum, is_that_of_all_bytes_however_they_come) {
  std::string bytes;
  for (int i = 0; i < 5000; ++i) bytes += static_cast<char>(i * 31 % 251);
  const Hash128 whole = hash_bytes(std::as_bytes(std::span(bytes)));
  for (const std::size_t piece : {1U, 7U, 1024U, 5000U}) {
    Checksum checksum;
    for (std::size_t at = 0; at < bytes.size(); at += piece)
      checksum.add(std::string_view(bytes).substr(at, piece));
    EXPECT_EQ(checksum.value(), whole) << piece;
  }
  EXPECT_EQ(Checksum().value(), hash_bytes({}));
}

TEST(SeededHash, is_another_in_each_table_and_the_same_in_one) {
  const SeededHash one, two;
  int equal = 0;
  for (int i = 0; i < 100; ++i) {
    const std::string text = std::to_string(i);
    EXPECT_EQ(one(text), one(text));
    equal += one(text) % 1024 == two(text) % 1024 ? 1 : 0;
  }
  EXPECT_LT(equal, 20) << "keys that meet in one table do not in another";
}

}  // namespace
}  // namespace strake
