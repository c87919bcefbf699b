// SPDX-License-Identifier: Apache-2.0
#include "project/codec/blob.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <random>
#include <span>
#include <string>
#include <vector>

namespace strake::project {
namespace {

using Bytes = std::vector<std::byte>;

Bytes finished(BlobWriter& writer) {
  auto bytes = writer.finish();
  EXPECT_TRUE(bytes);
  return bytes ? std::move(*bytes) : Bytes();
}

Bytes sample() {
  BlobWriter out;
  out.number(7);
  out.text("plate");
  out.column<std::uint32_t>(std::array<std::uint32_t, 3>{1, 2, 3});
  out.planes(std::array{0.5, -0.0});
  return finished(out);
}

TEST(Blob, ValuesComeBackToTheLastBit) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const std::vector<double> reals{0.0, -0.0, 1e308, nan, 25.4};
  const std::vector<bool> flags{true, false, true, true, false, false, false, true, true};
  const std::vector<std::string> texts{"", "a", std::string("b\0c", 3), "Überlauf"};
  BlobWriter out;
  out.number(std::numeric_limits<std::uint64_t>::max());
  out.integer(-5);
  out.real(nan);
  out.text("text");
  out.hash({1, 2});
  out.column<std::uint16_t>(std::array<std::uint16_t, 2>{3, 65535});
  out.reals(reals);
  out.planes(reals);
  out.planes(std::array<std::uint32_t, 3>{0, 1, 0xffffffffU});
  out.flags(flags);
  out.texts(texts);
  const Bytes bytes = finished(out);

  auto in = BlobReader::open(bytes, "sample");
  ASSERT_TRUE(in) << in.error().text();
  EXPECT_EQ(in->number(), std::numeric_limits<std::uint64_t>::max());
  EXPECT_EQ(in->integer(), -5);
  EXPECT_TRUE(std::isnan(in->real()));
  EXPECT_EQ(in->text(), "text");
  EXPECT_EQ(in->hash(), (Hash128{1, 2}));
  EXPECT_EQ(in->column<std::uint16_t>(), (std::vector<std::uint16_t>{3, 65535}));
  for (const std::vector<double>& back : {in->column<double>(), in->planes<double>()}) {
    ASSERT_EQ(back.size(), reals.size());
    EXPECT_TRUE(std::signbit(back[1]));
    EXPECT_TRUE(std::isnan(back[3]));
    EXPECT_EQ(back[4], 25.4);
  }
  EXPECT_EQ(in->planes<std::uint32_t>(), (std::vector<std::uint32_t>{0, 1, 0xffffffffU}));
  EXPECT_EQ(in->flags(), flags);
  EXPECT_EQ(in->texts(), texts);
  EXPECT_TRUE(in->finish());
}

TEST(Blob, EmptyColumnsAreColumns) {
  BlobWriter out;
  out.column<std::uint32_t>(std::span<const std::uint32_t>());
  out.planes(std::span<const double>());
  out.flags({});
  out.texts({});
  const Bytes bytes = finished(out);
  auto in = BlobReader::open(bytes, "empty");
  ASSERT_TRUE(in);
  EXPECT_TRUE(in->column<std::uint32_t>().empty());
  EXPECT_TRUE(in->planes<double>().empty());
  EXPECT_TRUE(in->flags().empty());
  EXPECT_TRUE(in->texts().empty());
  EXPECT_TRUE(in->finish());
}

TEST(Blob, AnyChangedByteIsSeen) {
  const Bytes bytes = sample();
  int unseen = 0;
  for (std::size_t at = 0; at < bytes.size(); ++at) {
    Bytes changed = bytes;
    changed[at] ^= std::byte{0x10};
    auto in = BlobReader::open(changed, "the objects of a.rvm");
    // A bit of zstd's own head has no meaning.
    if (in) {
      EXPECT_EQ(in->number(), 7U) << "byte " << at;
      EXPECT_EQ(in->text(), "plate") << "byte " << at;
      ++unseen;
      continue;
    }
    EXPECT_EQ(in.error().code, ErrorCode::input);
    EXPECT_EQ(in.error().where, "the objects of a.rvm");
  }
  EXPECT_LE(unseen, 1);
  for (std::size_t length = 0; length < bytes.size(); ++length)
    EXPECT_FALSE(BlobReader::open(std::span(bytes).first(length), "cut")) << length;
}

TEST(Blob, ReadingTooMuchOrTooLittleIsAnError) {
  const Bytes bytes = sample();
  auto little = BlobReader::open(bytes, "little");
  ASSERT_TRUE(little);
  EXPECT_EQ(little->number(), 7U);
  const Status rest = little->finish();
  ASSERT_FALSE(rest);
  EXPECT_NE(rest.error().message.find("more than it should"), std::string::npos);

  auto much = BlobReader::open(bytes, "much");
  ASSERT_TRUE(much);
  for (int i = 0; i < 100; ++i) static_cast<void>(much->real());
  EXPECT_TRUE(much->failed());
  EXPECT_EQ(much->number(), 0U);
  EXPECT_EQ(much->text(), "");
  EXPECT_TRUE(much->column<std::uint64_t>().empty());
  EXPECT_FALSE(much->finish());
}

TEST(Blob, CountsReserveNoMoreThanThereIs) {
  for (const std::uint64_t count :
       {std::uint64_t{2}, std::uint64_t{1} << 33U, std::uint64_t{1} << 61U,
        std::numeric_limits<std::uint64_t>::max()}) {
    BlobWriter out;
    out.number(count);
    const Bytes bytes = finished(out);
    const auto refuses = [&](auto read) {
      auto in = BlobReader::open(bytes, "hostile");
      ASSERT_TRUE(in);
      read(*in);
      EXPECT_TRUE(in->failed()) << count;
    };
    refuses([](BlobReader& in) { EXPECT_TRUE(in.column<std::uint64_t>().empty()); });
    refuses([](BlobReader& in) { EXPECT_TRUE(in.planes<double>().empty()); });
    refuses([](BlobReader& in) { EXPECT_TRUE(in.flags().empty()); });
    refuses([](BlobReader& in) { EXPECT_TRUE(in.texts().empty()); });
    refuses([](BlobReader& in) { EXPECT_TRUE(in.text().empty()); });
  }
}

TEST(Blob, FewBytesNeverBecomeAGreatMany) {
  BlobWriter out;
  const std::vector<std::uint64_t> zeros(std::size_t{4} << 20U, 0);
  out.column<std::uint64_t>(zeros);
  const Bytes bytes = finished(out);
  // They would compress to a thousandth; then they could not be told from an attack.
  EXPECT_GT(bytes.size() * 257 + 65'536, zeros.size() * 8);
  auto in = BlobReader::open(bytes, "zeros");
  ASSERT_TRUE(in);
  EXPECT_EQ(in->column<std::uint64_t>(), zeros);
  EXPECT_TRUE(in->finish());

  // The same promise from a head that lies.
  Bytes lies = sample();
  const std::uint64_t huge = std::uint64_t{1} << 40U;
  std::ranges::copy(std::as_bytes(std::span(&huge, 1)), lies.begin() + 8);
  EXPECT_FALSE(BlobReader::open(lies, "lies"));
  EXPECT_EQ(BlobReader::raw_size(lies), 0U);
}

TEST(Blob, RandomColumnsComeBack) {
  constexpr std::uint32_t kSeed = 4;
  std::mt19937 random(kSeed);
  for (int round = 0; round < 50; ++round) {
    std::vector<std::uint32_t> numbers(random() % 1000);
    std::vector<double> reals(random() % 1000);
    for (std::uint32_t& number : numbers)
      number = static_cast<std::uint32_t>(random()) >> random() % 32;
    for (double& real : reals) real = std::ldexp(static_cast<double>(random()), -20);
    BlobWriter out;
    out.planes(numbers);
    out.planes(reals);
    const Bytes bytes = finished(out);
    auto in = BlobReader::open(bytes, "random");
    ASSERT_TRUE(in);
    EXPECT_EQ(in->planes<std::uint32_t>(), numbers);
    EXPECT_EQ(in->planes<double>(), reals);
    EXPECT_TRUE(in->finish());
  }
}

}  // namespace
}  // namespace strake::project
