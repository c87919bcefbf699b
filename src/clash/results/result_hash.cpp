// SPDX-License-Identifier: Apache-2.0
#include "clash/results/result_hash.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "strake/core/hash.hpp"
#include "strake/parallel/transform.hpp"

namespace strake::clash {

namespace {

/// The number of pairs hashed as one piece; it is part of the definition of the hash.
constexpr std::size_t kPiece = 4096;

void add_region(Hasher& hasher, const Region& region) {
  hasher.add(std::uint32_t{static_cast<std::uint8_t>(region.cls)});
  hasher.add(region.d_mm);
  for (const geometry::Vec3d& p : {region.point_mm, region.box_mm.lo, region.box_mm.hi})
    for (int k = 0; k < 3; ++k) hasher.add(p[k]);
}

void add_allowed(Hasher& hasher, std::int32_t rule, const Report& report) {
  hasher.add(std::string_view(report.allowed[static_cast<std::size_t>(rule)].rule));
}

void add_pair(Hasher& hasher, const Pair& pair, const Report& report, const model::Model& model) {
  for (const model::ObjectId id : {pair.a, pair.b}) {
    const model::Object& object = model.object(id);
    hasher.add(std::string_view(model.files[object.file].label));
    hasher.add(std::string_view(object.id));
  }
  hasher.add(std::uint32_t{static_cast<std::uint8_t>(pair.cls)});
  hasher.add(std::uint32_t{static_cast<std::uint8_t>(pair.relation)});
  hasher.add(pair.d_mm);
  for (const geometry::Vec3d& p : {pair.point_mm, pair.on_a_mm, pair.on_b_mm, pair.away})
    for (int k = 0; k < 3; ++k) hasher.add(p[k]);
  if (report.options.engine.most_regions > 0) {
    hasher.add(pair.regions);
    const std::uint32_t listed = pair.regions_listed(report.options);
    for (std::uint32_t r = pair.first_region; r < pair.first_region + listed; ++r)
      add_region(hasher, report.regions[r]);
  }
  if (pair.allowed_regions > 0) {
    hasher.add(pair.allowed_regions);
    const std::uint32_t first = pair.first_region + pair.regions_listed(report.options);
    const std::uint32_t listed = pair.allowed_regions_listed(report.options);
    for (std::uint32_t r = first; r < first + listed; ++r) {
      add_region(hasher, report.regions[r]);
      add_allowed(hasher, report.regions[r].allowed, report);
    }
  }
  if (pair.allowed >= 0) add_allowed(hasher, pair.allowed, report);
}

}  // namespace

Result<std::string> hash_of(const Report& report, const model::Model& model,
                            const parallel::Context& context) {
  const std::vector<Pair>& pairs = report.pairs;
  const auto pieces = parallel::transform(
      context, {.name = "hash of results", .n = (pairs.size() + kPiece - 1) / kPiece},
      [&](std::size_t piece) {
        Hasher hasher;
        for (std::size_t i = piece * kPiece; i < std::min(pairs.size(), (piece + 1) * kPiece); ++i)
          add_pair(hasher, pairs[i], report, model);
        return hasher.value();
      });
  if (!pieces) return pieces.error();
  Hasher whole;
  for (const Hash128& piece : *pieces) whole.add(piece.high).add(piece.low);
  return whole.value().text();
}

}  // namespace strake::clash
