// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace strake::page {

/// Bytes that are made when they are written, a row at a time: several workers request rows at
/// once.
struct RowSource {
  std::size_t rows = 0;
  std::uint64_t bytes = 0;  ///< of all rows
  /// Appends the bytes of rows [begin, end).
  std::function<void(std::size_t begin, std::size_t end, std::string& out)> append;
};

/// A block of the page: its sections one after another.
struct Block {
  std::string id;
  std::vector<RowSource> sections;

  [[nodiscard]] std::uint64_t bytes() const {
    std::uint64_t all = 0;
    for (const RowSource& section : sections) all += section.bytes;
    return all;
  }
};

/// Returns a block of a text that outlasts its writing.
[[nodiscard]] Block view_block(std::string id, std::string_view text);
/// Returns a block of a text, which it keeps.
[[nodiscard]] Block text_block(std::string id, std::string text);

}  // namespace strake::page
