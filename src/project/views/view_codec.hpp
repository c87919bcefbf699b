// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "project/codec/blob.hpp"
#include "strake/core/diagnostics.hpp"
#include "strake/geometry/vec.hpp"
#include "strake/hlr/hlr.hpp"

/// The small parts of a drawing in a row of the database: its view, options, counters, reports.
namespace strake::project {

void write(BlobWriter& out, const geometry::Vec3l& vector);
[[nodiscard]] geometry::Vec3l read_vector(BlobReader& in);

void write(BlobWriter& out, const hlr::View& view);
[[nodiscard]] hlr::View read_view(BlobReader& in);

void write(BlobWriter& out, std::span<const hlr::Hatch> hatches);
[[nodiscard]] std::vector<hlr::Hatch> read_hatches(BlobReader& in);

void write(BlobWriter& out, const hlr::Options& options);
[[nodiscard]] hlr::Options read_options(BlobReader& in);

void write(BlobWriter& out, const hlr::Counters& counters);
[[nodiscard]] hlr::Counters read_counters(BlobReader& in);

void write(BlobWriter& out, const hlr::Account& account);
[[nodiscard]] hlr::Account read_account(BlobReader& in);

void write(BlobWriter& out, const Diagnostics& diagnostics);
[[nodiscard]] Diagnostics read_diagnostics(BlobReader& in);

/// The bounds of what readers take for a coordinate: twice as far as anything can be placed.
inline constexpr std::int64_t kFarthestGrid = std::int64_t{1} << 51U;

[[nodiscard]] inline bool is_on_grid(std::int64_t coordinate) {
  return coordinate >= -kFarthestGrid && coordinate <= kFarthestGrid;
}

/// Whether a value is the number of one of so many things.
[[nodiscard]] inline bool is_number(std::int64_t value, std::uint64_t size) {
  return value >= 0 && static_cast<std::uint64_t>(value) < size;
}

}  // namespace strake::project
