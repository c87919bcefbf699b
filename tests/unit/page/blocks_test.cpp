// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>
#include <zlib.h>

#include <array>
#include <cstdint>
#include <cstring>
#include <nlohmann/json.hpp>
#include <stop_token>
#include <string>
#include <string_view>
#include <vector>

#include "core/text_encoding.hpp"
#include "page/blocks/block_writer.hpp"
#include "page/blocks/columns.hpp"
#include "strake/parallel/team.hpp"

namespace strake::page {
namespace {

constexpr std::string_view kBegin = "<script type=\"application/octet-stream+gzip\" id=\"x\">";
constexpr std::string_view kEnd = "</script>\n";

std::string written(const Block& block, const parallel::Context& context = {}) {
  std::string text;
  const Status status = write_block(block, [&](std::string_view piece) { text += piece; }, context);
  EXPECT_TRUE(status) << status.error().text();
  return text;
}

/// Returns the bytes of a block by zlib's own reading of gzip files, which checks their sum.
std::string unpacked(std::string_view text, std::uint64_t size) {
  EXPECT_TRUE(text.starts_with(kBegin) && text.ends_with(kEnd));
  text.remove_prefix(kBegin.size());
  text.remove_suffix(kEnd.size());
  auto packed = parse_base64(text);
  EXPECT_TRUE(packed);
  std::string bytes(size + 1, '\0');
  z_stream stream{};
  EXPECT_EQ(inflateInit2(&stream, 15 + 16), Z_OK);
  stream.next_in = packed->data();
  stream.avail_in = static_cast<uInt>(packed->size());
  stream.next_out = reinterpret_cast<Bytef*>(bytes.data());
  stream.avail_out = static_cast<uInt>(bytes.size());
  EXPECT_EQ(inflate(&stream, Z_FINISH), Z_STREAM_END);
  EXPECT_EQ(stream.avail_in, 0U) << "one member, and nothing behind it";
  bytes.resize(stream.total_out);
  EXPECT_EQ(inflateEnd(&stream), Z_OK);
  return bytes;
}

std::uint32_t number_at(std::string_view bytes, std::size_t at) {
  std::uint32_t value = 0;
  std::memcpy(&value, bytes.data() + at, sizeof value);
  return value;
}

/// A block of all kinds of columns, longer than what is compressed at once.
Block many_rows(std::size_t rows) {
  Columns columns("x");
  columns.numbers<std::uint32_t>(
      "u", rows, [](std::size_t i) { return static_cast<std::uint32_t>(i * 2654435761U); });
  columns.millionths("m", rows, [](std::size_t i) {
    return (i % 2 == 0 ? -1 : 1) * static_cast<std::int64_t>(i) * 1'000'003;
  });
  columns.texts("t", rows, [](std::size_t i, std::string& room) -> std::string_view {
    room = "object " + std::to_string(i);
    return room;
  });
  return std::move(columns).finish();
}

TEST(Blocks, ColumnsAreWhatTheirDirectoryStates) {
  constexpr std::size_t kRows = 100'000;
  const Block block = many_rows(kRows);
  const std::string bytes = unpacked(written(block), block.bytes());
  ASSERT_EQ(bytes.size(), block.bytes());
  ASSERT_EQ(bytes.substr(0, 4), "SCOL");
  const std::uint32_t length = number_at(bytes, 4);
  const auto directory = nlohmann::json::parse(bytes.substr(8, length));
  ASSERT_EQ(directory["columns"].size(), 3U);
  EXPECT_EQ(directory["columns"][1]["type"], "nm");
  const std::size_t numbers = 8 + length;
  for (std::size_t i = 0; i < kRows; i += 997)
    EXPECT_EQ(number_at(bytes, numbers + 4 * i), static_cast<std::uint32_t>(i * 2654435761U));
  const std::size_t planes = numbers + 4 * kRows;
  for (std::size_t i = 0; i < kRows; i += 997) {
    std::uint64_t value = 0;
    for (std::size_t p = 0; p < 8; ++p)
      value |= std::uint64_t{static_cast<std::uint8_t>(bytes[planes + p * kRows + i])} << (8 * p);
    EXPECT_EQ(static_cast<std::int64_t>(value),
              (i % 2 == 0 ? -1 : 1) * static_cast<std::int64_t>(i) * 1'000'003);
  }
  const std::size_t lengths = planes + 8 * kRows;
  EXPECT_EQ(number_at(bytes, lengths + 4 * 99'999), 12U);
  EXPECT_TRUE(bytes.ends_with("object 99998object 99999"));
  EXPECT_EQ(directory["columns"][2]["bytes"], bytes.size() - lengths - 4 * kRows);
}

TEST(Blocks, AreTheSameForAnyTeam) {
  const Block block = many_rows(60'000);
  const std::string alone = written(block);
  for (const unsigned workers : {1U, 2U, 3U, 8U}) {
    parallel::Team team(workers);
    EXPECT_EQ(written(block, {.team = &team}), alone) << workers;
  }
}

TEST(Blocks, OfNothingAndOfLittle) {
  for (const std::string& text : {std::string(), std::string("a"), std::string("</script>")}) {
    const std::string page = written(text_block("x", text));
    EXPECT_EQ(unpacked(page, text.size()), text);
    EXPECT_EQ(page.find("</script>"), page.size() - kEnd.size());
  }
}

TEST(Blocks, BytesThatAreNoTextAreMended) {
  Columns columns("x");
  const std::array<std::string, 2> names{"l\xff", "\xe2\x80\xae"};
  columns.texts("t", 2, [&](std::size_t i, std::string&) -> std::string_view { return names[i]; });
  const Block block = std::move(columns).finish();
  EXPECT_TRUE(unpacked(written(block), block.bytes()).ends_with("l\xef\xbf\xbd\xe2\x80\xae"));
}

TEST(Blocks, StopOnRequest) {
  std::stop_source source;
  source.request_stop();
  const Status status =
      write_block(many_rows(1000), [](std::string_view) {}, {.stop = source.get_token()});
  ASSERT_FALSE(status);
  EXPECT_EQ(status.error().code, ErrorCode::cancelled);
}

}  // namespace
}  // namespace strake::page
