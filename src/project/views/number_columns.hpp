// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "project/codec/blob.hpp"

/// Columns of whole numbers that are near to their neighbours, in few bytes and fast to read.
namespace strake::project {

/// Appends numbers as differences from one to the next, the lowest bytes of all first, then the
/// next higher ones as far as any is not zero: compression finds little to do in the high bytes.
void write_numbers(BlobWriter& out, std::span<const std::int64_t> values);

/// A column as it was read, whose numbers are yet to be made of its bytes: columns are read one
/// after another, and worked out at the same time.
class NumberColumn {
 public:
  /// Takes a column that must have `size` numbers. The caller knows that size from a column of
  /// bytes, so that a hostile blob cannot claim memory.
  [[nodiscard]] static NumberColumn read(BlobReader& in, std::size_t size);

  [[nodiscard]] std::size_t size() const { return size_; }
  /// Works the numbers out; any bytes give some.
  [[nodiscard]] std::vector<std::int64_t> values() const;

 private:
  std::size_t size_ = 0;
  std::vector<std::vector<std::uint8_t>> planes_;
};

}  // namespace strake::project
