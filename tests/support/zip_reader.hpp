// SPDX-License-Identifier: Apache-2.0
// Reads archives with zlib alone, by their directory.
#pragma once

#include <gtest/gtest.h>
#include <zlib.h>

#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <string_view>

namespace strake::test {

inline std::uint64_t little(std::string_view bytes, std::size_t at, std::size_t size) {
  std::uint64_t number = 0;
  for (std::size_t i = size; i > 0; --i)
    number = (number << 8U) | static_cast<unsigned char>(bytes.at(at + i - 1));
  return number;
}

/// Returns what raw deflated bytes unpack to; checks that they are all used and none is missing.
inline std::string inflated(std::string_view bytes, std::size_t size) {
  std::string text(size, '\0');
  z_stream stream{};
  EXPECT_EQ(inflateInit2(&stream, -15), Z_OK);
  std::string copy(bytes);
  stream.next_in = reinterpret_cast<Bytef*>(copy.data());
  stream.avail_in = static_cast<uInt>(copy.size());
  // One byte more shows that the stream ends where its size says.
  text.push_back('\0');
  stream.next_out = reinterpret_cast<Bytef*>(text.data());
  stream.avail_out = static_cast<uInt>(text.size());
  EXPECT_EQ(inflate(&stream, Z_FINISH), Z_STREAM_END);
  EXPECT_EQ(stream.total_out, size);
  EXPECT_EQ(stream.avail_in, 0U);
  inflateEnd(&stream);
  text.pop_back();
  return text;
}

/// Returns the files of an archive by name; checks sizes and checksums.
inline std::map<std::string, std::string> files_of_zip(const std::string& zip) {
  std::map<std::string, std::string> files;
  constexpr std::size_t kEnd = 22, kEntry = 46, kHead = 30;
  EXPECT_EQ(zip.substr(zip.size() - kEnd, 4), "PK\x05\x06");
  const std::uint64_t count = little(zip, zip.size() - kEnd + 10, 2);
  std::size_t at = little(zip, zip.size() - kEnd + 16, 4);
  EXPECT_EQ(at + little(zip, zip.size() - kEnd + 12, 4), zip.size() - kEnd);
  for (std::uint64_t i = 0; i < count; ++i) {
    EXPECT_EQ(zip.substr(at, 4), "PK\x01\x02");
    const std::size_t packed = little(zip, at + 20, 4), size = little(zip, at + 24, 4);
    const std::size_t name = little(zip, at + 28, 2), head = little(zip, at + 42, 4);
    EXPECT_EQ(zip.substr(head, 4), "PK\x03\x04");
    EXPECT_EQ(zip.substr(head + kHead, name), zip.substr(at + kEntry, name));
    const std::string_view bytes = std::string_view(zip).substr(head + kHead + name, packed);
    const bool stored = little(zip, at + 10, 2) == 0;
    const std::string text = stored ? std::string(bytes) : inflated(bytes, size);
    EXPECT_EQ(text.size(), size);
    EXPECT_EQ(crc32(0, reinterpret_cast<const Bytef*>(text.data()), static_cast<uInt>(text.size())),
              little(zip, at + 16, 4));
    EXPECT_TRUE(files.emplace(zip.substr(at + kEntry, name), text).second);
    at += kEntry + name;
  }
  return files;
}

}  // namespace strake::test
