// SPDX-License-Identifier: Apache-2.0
#include "pictures/output/png.hpp"

#include <zlib.h>

#include <algorithm>
#include <cstddef>
#include <string_view>
#include <vector>

namespace strake::pictures {
namespace {

void append_number(std::string& out, std::uint32_t number) {
  for (const unsigned shift : {24U, 16U, 8U, 0U})
    out += static_cast<char>((number >> shift) & 0xffU);
}

void append_chunk(std::string& out, std::string_view type, std::string_view data) {
  append_number(out, static_cast<std::uint32_t>(data.size()));
  const std::size_t begin = out.size();
  out += type;
  out += data;
  const uLong sum = crc32(0, reinterpret_cast<const Bytef*>(out.data() + begin),
                          static_cast<uInt>(out.size() - begin));
  append_number(out, static_cast<std::uint32_t>(sum));
}

/// Returns the rows as PNG filters them: each byte less that of the row above, which makes what is
/// of one colour nothing.
std::vector<std::uint8_t> filtered(std::size_t row_bytes, std::span<const std::uint8_t> rgb) {
  constexpr std::uint8_t kUp = 2;
  const std::size_t rows = rgb.size() / row_bytes;
  const std::vector<std::uint8_t> nothing(row_bytes);
  std::vector<std::uint8_t> out((row_bytes + 1) * rows);
  for (std::size_t row = 0; row < rows; ++row) {
    std::uint8_t* const to = out.data() + row * (row_bytes + 1);
    const std::uint8_t* const from = rgb.data() + row * row_bytes;
    const std::uint8_t* const above = row == 0 ? nothing.data() : from - row_bytes;
    to[0] = kUp;
    for (std::size_t i = 0; i < row_bytes; ++i)
      to[i + 1] = static_cast<std::uint8_t>(from[i] - above[i]);
  }
  return out;
}

}  // namespace

Result<std::string> encode_png(std::uint32_t width, std::uint32_t height,
                               std::span<const std::uint8_t> rgb) {
  const std::vector<std::uint8_t> rows = filtered(std::size_t{width} * 3, rgb);
  uLongf size = compressBound(static_cast<uLong>(rows.size()));
  std::string packed(size, '\0');
  constexpr int kLevel = 6;
  if (compress2(reinterpret_cast<Bytef*>(packed.data()), &size, rows.data(),
                static_cast<uLong>(rows.size()), kLevel) != Z_OK)
    return out_of_memory();
  packed.resize(size);
  constexpr std::string_view kSignature = "\x89PNG\r\n\x1a\n";
  constexpr std::string_view kTrueColour{"\x08\x02\x00\x00\x00", 5};  // 8 bits, RGB, not interlaced
  std::string header, out{kSignature};
  append_number(header, width);
  append_number(header, height);
  header += kTrueColour;
  append_chunk(out, "IHDR", header);
  append_chunk(out, "IDAT", packed);
  append_chunk(out, "IEND", {});
  return out;
}

}  // namespace strake::pictures
