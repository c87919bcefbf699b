// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "strake/core/result.hpp"

/// What the header of a PLY file says of the bytes behind it.
namespace strake::io::ply {

enum class Encoding : std::uint8_t { text, little_endian, big_endian };
enum class NumberType : std::uint8_t { i8, u8, i16, u16, i32, u32, f32, f64 };

/// Returns how many bytes a number of this type has in a binary file.
[[nodiscard]] constexpr std::size_t bytes_of(NumberType type) {
  constexpr std::size_t kBytes[] = {1, 1, 2, 2, 4, 4, 4, 8};
  return kBytes[static_cast<std::size_t>(type)];
}

struct PropertyHead {
  std::string name;
  NumberType type = NumberType::f32;
  std::optional<NumberType> count_type;  ///< of a list
};

struct ElementHead {
  std::string name;
  std::uint64_t count = 0;
  std::vector<PropertyHead> properties;

  /// Returns the fewest bytes of one: lists may be empty; in text a number takes a digit and what
  /// separates it from the next.
  [[nodiscard]] std::uint64_t min_bytes(Encoding encoding) const;
};

struct Header {
  Encoding encoding = Encoding::text;
  std::vector<ElementHead> elements;
  std::size_t size = 0;     ///< bytes of the header
  std::uint64_t lines = 0;  ///< lines of it
};

[[nodiscard]] bool is_ply(std::string_view text);

/// Errors: input, whose `where` is the line alone ("7").
[[nodiscard]] Result<Header> parse_header(std::string_view text);

}  // namespace strake::io::ply
