// SPDX-License-Identifier: Apache-2.0
#include "clash/results/result_hash.hpp"

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "strake/core/hash.hpp"
#include "strake/parallel/reduce.hpp"

namespace strake::clash {
namespace {

// Only shares the work out: between 1024 and 16'384 no difference can be seen (decision 0073).
constexpr std::size_t kHashGrain = 4096;

void add_place(WordHash& hash, const geometry::Vec3d& p) { hash.add(p.x).add(p.y).add(p.z); }

void add_region(WordHash& hash, const Region& region) {
  hash.add(static_cast<std::uint8_t>(region.cls)).add(region.d_mm);
  for (const geometry::Vec3d& p : {region.point_mm, region.box_mm.lo, region.box_mm.hi})
    add_place(hash, p);
}

void add_allowed(WordHash& hash, std::int32_t rule, const Report& report) {
  hash.add(std::string_view(report.allowed[static_cast<std::size_t>(rule)].rule));
}

}  // namespace

ElementHashes::ElementHashes(const model::Model& model) : model_(model) {
  labels_.reserve(model.files.size());
  for (const model::SourceFile& file : model.files)
    labels_.push_back(WordHash().add(std::string_view(file.label)).value());
}

Hash128 ElementHashes::of(std::uint32_t object) const {
  const model::Object& o = model_.objects[object];
  return WordHash().add(labels_[o.file]).add(std::string_view(o.id)).value();
}

Hash128 hash_of(const Pair& pair, const Report& report, std::uint64_t a, std::uint64_t b) {
  WordHash hash;
  hash.add(a).add(b);
  hash.add(static_cast<std::uint8_t>(pair.cls)).add(static_cast<std::uint8_t>(pair.relation));
  hash.add(pair.d_mm);
  for (const geometry::Vec3d& p : {pair.point_mm, pair.on_a_mm, pair.on_b_mm, pair.away})
    add_place(hash, p);
  if (report.options.engine.max_regions > 0) {
    hash.add(pair.regions);
    const std::uint32_t listed = pair.regions_listed(report.options);
    for (std::uint32_t r = pair.first_region; r < pair.first_region + listed; ++r)
      add_region(hash, report.regions[r]);
  }
  if (pair.allowed_regions > 0) {
    hash.add(pair.allowed_regions);
    const std::uint32_t first = pair.first_region + pair.regions_listed(report.options);
    const std::uint32_t listed = pair.allowed_regions_listed(report.options);
    for (std::uint32_t r = first; r < first + listed; ++r) {
      add_region(hash, report.regions[r]);
      add_allowed(hash, report.regions[r].allowed, report);
    }
  }
  if (pair.allowed >= 0) add_allowed(hash, pair.allowed, report);
  return hash.value();
}

Hash128 sum(const Hash128& x, const Hash128& y) { return {x.high + y.high, x.low + y.low}; }

Hash128 difference(const Hash128& x, const Hash128& y) { return {x.high - y.high, x.low - y.low}; }

Result<Hash128> sum_of_hashes(const Report& report, std::span<const std::uint64_t> elements,
                              const parallel::Context& context) {
  return parallel::reduce(
      context, {.name = "hash of results", .n = report.pairs.size(), .grain = kHashGrain},
      Hash128{},
      [&](Hash128& partial, std::size_t i) {
        const Pair& pair = report.pairs[i];
        partial =
            sum(partial, hash_of(pair, report, elements[index(pair.a)], elements[index(pair.b)]));
      },
      [](Hash128& into, const Hash128& partial) { into = sum(into, partial); });
}

std::string result_hash(const Hash128& sum, std::uint64_t pairs) {
  return WordHash().add(sum).add(pairs).value().text();
}

}  // namespace strake::clash
