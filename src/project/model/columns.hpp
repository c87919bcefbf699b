// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "project/codec/blob.hpp"
#include "strake/model/model.hpp"

/// Columns of a block that compress better than values as they are.
namespace strake::project {

/// Objects, bodies … of a block. Blocks are unpacked by different workers, and what repeats is
/// found within a block.
inline constexpr std::size_t kBlock = 32'768;

/// Longer texts are stored as often as they occur, so that few bytes cannot become a great many.
inline constexpr std::size_t kLongestShared = 255;

/// Numbers that mostly follow each other, or are mostly the same.
void write_steps(BlobWriter& out, std::span<const std::uint32_t> values);
[[nodiscard]] std::vector<std::uint32_t> read_steps(BlobReader& in);

/// Reads a column that must have so many values; the reader refuses another number.
[[nodiscard]] std::vector<std::uint32_t> read_steps(BlobReader& in, std::size_t count);
[[nodiscard]] std::vector<std::uint32_t> read_planes(BlobReader& in, std::size_t count);

/// Texts behind each other.
class TextColumn {
 public:
  void add(std::string_view text);
  void write(BlobWriter& out) const;
  [[nodiscard]] std::size_t size() const { return lengths_.size(); }

 private:
  std::vector<std::uint32_t> lengths_;
  std::string all_;
};

/// Such a column, of which texts are taken in order.
class TextSource {
 public:
  explicit TextSource(BlobReader& in);
  [[nodiscard]] std::size_t size() const { return lengths_.size(); }
  /// Returns the next text, which lasts as long as the column; empty behind the last one.
  [[nodiscard]] std::string_view next();

 private:
  std::vector<std::uint32_t> lengths_;
  std::string all_;
  std::size_t at_ = 0, begin_ = 0;
};

/// Appends attributes of many owners, each text once.
void write_attributes(BlobWriter& out, std::span<const model::Attributes* const> owners);
/// Takes attributes that write_attributes() appended, for so many owners.
void read_attributes(BlobReader& in, std::span<model::Attributes* const> owners);

}  // namespace strake::project
