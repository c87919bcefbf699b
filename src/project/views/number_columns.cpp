// SPDX-License-Identifier: Apache-2.0
#include "project/views/number_columns.hpp"

#include <utility>

namespace strake::project {

namespace {

constexpr unsigned kMostPlanes = 8;

/// Small numbers of either sign become small ones without.
std::uint64_t folded(std::uint64_t difference) {
  return (difference << 1U) ^ (0 - (difference >> 63U));
}

std::uint64_t unfolded(std::uint64_t value) { return (value >> 1U) ^ (0 - (value & 1U)); }

std::uint64_t plane_count(std::uint64_t bits) {
  std::uint64_t planes = 0;
  for (; bits != 0; bits >>= 8U) ++planes;
  return planes;
}

}  // namespace

void write_numbers(BlobWriter& out, std::span<const std::int64_t> values) {
  std::vector<std::uint64_t> differences(values.size());
  std::uint64_t last = 0, bits = 0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    const auto value = static_cast<std::uint64_t>(values[i]);
    differences[i] = folded(value - last);
    bits |= differences[i];
    last = value;
  }
  const std::uint64_t planes = plane_count(bits);
  out.number(planes);
  std::vector<std::uint8_t> plane(values.size());
  for (unsigned p = 0; p < planes; ++p) {
    for (std::size_t i = 0; i < plane.size(); ++i)
      plane[i] = static_cast<std::uint8_t>(differences[i] >> (8 * p));
    out.column(std::span<const std::uint8_t>(plane));
  }
}

NumberColumn NumberColumn::read(BlobReader& in, std::size_t size) {
  NumberColumn column;
  const std::uint64_t planes = in.number();
  if (planes > kMostPlanes) in.refuse("a column of numbers has more than 8 bytes each");
  for (std::uint64_t p = 0; p < planes && !in.failed(); ++p) {
    column.planes_.push_back(in.column<std::uint8_t>());
    if (!in.failed() && column.planes_.back().size() != size)
      in.refuse("columns are not of one length");
  }
  if (in.failed())
    column.planes_.clear();
  else
    column.size_ = size;
  return column;
}

std::vector<std::int64_t> NumberColumn::values() const {
  std::vector<std::uint64_t> differences(size_);
  for (unsigned p = 0; p < planes_.size(); ++p) {
    const std::vector<std::uint8_t>& plane = planes_[p];
    for (std::size_t i = 0; i < size_; ++i)
      differences[i] |= static_cast<std::uint64_t>(plane[i]) << (8 * p);
  }
  std::vector<std::int64_t> values(size_);
  std::uint64_t last = 0;
  for (std::size_t i = 0; i < size_; ++i) {
    last += unfolded(differences[i]);
    values[i] = static_cast<std::int64_t>(last);
  }
  return values;
}

}  // namespace strake::project
