// SPDX-License-Identifier: Apache-2.0
#include "project/views/number_columns.hpp"

#include <array>

namespace strake::project {

namespace {

constexpr std::size_t kMaxPlanes = 8;

/// Small numbers of either sign become small ones without.
std::uint64_t folded(std::uint64_t difference) {
  return (difference << 1U) ^ (0 - (difference >> 63U));
}

std::uint64_t unfolded(std::uint64_t value) { return (value >> 1U) ^ (0 - (value & 1U)); }

std::size_t plane_count(std::uint64_t bits) {
  std::size_t planes = 0;
  for (; bits != 0; bits >>= 8U) ++planes;
  return planes;
}

/// Makes numbers of so many planes; how many is known when it is compiled, for speed.
template <std::size_t Planes>
void join_planes(const std::uint8_t* bytes, std::span<std::int64_t> values) {
  const std::size_t n = values.size();
  std::uint64_t last = 0;
  for (std::size_t i = 0; i < n; ++i) {
    std::uint64_t value = 0;
    for (std::size_t p = 0; p < Planes; ++p)
      value |= static_cast<std::uint64_t>(bytes[p * n + i]) << (8 * p);
    last += unfolded(value);
    values[i] = static_cast<std::int64_t>(last);
  }
}

constexpr std::array<void (*)(const std::uint8_t*, std::span<std::int64_t>), kMaxPlanes + 1>
    kJoinPlanes{join_planes<0>, join_planes<1>, join_planes<2>, join_planes<3>, join_planes<4>,
                join_planes<5>, join_planes<6>, join_planes<7>, join_planes<8>};

}  // namespace

void append_numbers(std::vector<std::uint8_t>& bytes, std::span<const std::int64_t> values) {
  std::uint64_t last = 0, bits = 0;
  for (const std::int64_t v : values) {
    const auto value = static_cast<std::uint64_t>(v);
    bits |= folded(value - last);
    last = value;
  }
  const std::size_t planes = plane_count(bits), n = values.size();
  bytes.push_back(static_cast<std::uint8_t>(planes));
  const std::size_t begin = bytes.size();
  bytes.resize(begin + planes * n);
  last = 0;
  for (std::size_t i = 0; i < n; ++i) {
    const auto value = static_cast<std::uint64_t>(values[i]);
    const std::uint64_t difference = folded(value - last);
    for (std::size_t p = 0; p < planes; ++p)
      bytes[begin + p * n + i] = static_cast<std::uint8_t>(difference >> (8 * p));
    last = value;
  }
}

bool take_numbers(std::span<const std::uint8_t>& bytes, std::span<std::int64_t> values) {
  if (bytes.empty() || bytes[0] > kMaxPlanes) return false;
  const std::size_t planes = bytes[0];
  bytes = bytes.subspan(1);
  if (planes > 0 && bytes.size() / planes < values.size()) return false;
  kJoinPlanes.at(planes)(bytes.data(), values);
  bytes = bytes.subspan(planes * values.size());
  return true;
}

void write_numbers(BlobWriter& out, std::span<const std::int64_t> values) {
  std::vector<std::uint8_t> bytes;
  append_numbers(bytes, values);
  out.column(std::span<const std::uint8_t>(bytes));
}

std::vector<std::int64_t> read_numbers(BlobReader& in, std::size_t size) {
  std::span<const std::uint8_t> rest = in.bytes();
  if (in.failed()) return {};
  std::vector<std::int64_t> values(size);
  if (take_numbers(rest, values) && rest.empty()) return values;
  in.refuse("columns are not of one length");
  return {};
}

}  // namespace strake::project
