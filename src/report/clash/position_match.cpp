// SPDX-License-Identifier: Apache-2.0
#include "report/clash/position_match.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <tuple>
#include <utility>

#include "clash/results/clash_key.hpp"
#include "report/clash/clash_files.hpp"
#include "report/clash/place_clusters.hpp"
#include "strake/core/hash.hpp"

namespace strake::report {
namespace {

/// A result as the other run may know it.
struct PositionedResult : PlacedResult {
  const DocumentResult* result = nullptr;
};

Hash128 kind_of(const PositionalResults& results, const DocumentResult& r) {
  const ClashDocument& run = results.run();
  const auto side = [&](std::uint32_t object) {
    const DocumentObject& o = run.objects[object];
    const bool positional = results.has(object);
    return PlacedObject{positional, results.file_of(o),
                        positional ? without_numbers(o.name) : std::string(o.id)};
  };
  return kind_hash(run.tests[r.test].name, static_cast<std::uint32_t>(r.cls),
                   {side(r.a), side(r.b)});
}

void place(const PositionalResults& results, bool is_after, std::vector<PositionedResult>& all) {
  for (const DocumentResult& r : results.run().results)
    if (results.has(r))
      all.push_back(
          {{kind_of(results, r), {r.point_mm.x, r.point_mm.y, r.point_mm.z, r.d_mm}, is_after},
           &r});
}

using Cluster = std::span<PositionedResult>;

/// Whether it makes no difference which result of one run is paired with which of the other: all
/// are at one place, and those of a run differ in nothing that a comparison considers.
bool interchangeable(const Cluster cluster) {
  if (!is_one_place(cluster, kSameMm)) return false;
  const auto compared_values = [](const PositionedResult& p) {
    return std::tuple(p.result->regions, p.result->allowed_regions, p.result->rule);
  };
  std::array<const PositionedResult*, 2> first{};
  for (const PositionedResult& p : cluster) {
    const PositionedResult*& one = first[p.is_after ? 1 : 0];
    if (one == nullptr) one = &p;
    if (compared_values(p) != compared_values(*one)) return false;
  }
  return true;
}

std::string why(const PositionalResults& results, const DocumentResult& r, bool several) {
  const DocumentObject& o = results.run().objects[results.has(r.a) ? r.a : r.b];
  return "the id '" + std::string(o.id) + "' is only a position in " + std::string(o.file) +
         (several ? ", and several results are at that place"
                  : ", and no such result is at that place in the other run");
}

}  // namespace

PositionalResults::PositionalResults(const ClashDocument& run, const ClashDocument& other,
                                     const FileMap& files, RunSide side)
    : run_(run), files_(files), side_(side) {
  if (run.positional_ids.empty() && other.positional_ids.empty()) return;
  positional_.reserve(run.objects.size());
  for (const DocumentObject& o : run.objects) {
    const std::string there = files.label_in_other(side, o.file, o.id);
    positional_.push_back(is_positional(run, clash::element_hash(o.file, o.id)) ||
                          is_positional(other, clash::element_hash(there, o.id)));
  }
}

std::vector<DiffEntry> match_by_position(const PositionalResults& before,
                                         const PositionalResults& after) {
  std::vector<PositionedResult> all;
  place(before, false, all);
  place(after, true, all);
  std::vector<DiffEntry> entries;
  for (const Cluster cluster : clusters_of(Cluster(all), kSameMm)) {
    // They are sorted by key, so that the same two are paired whatever the order of the documents.
    std::ranges::sort(cluster, {}, [](const PositionedResult& p) {
      return std::pair(p.is_after, p.result->key);
    });
    const auto second = std::ranges::find(cluster, true, &PositionedResult::is_after);
    const Cluster was(cluster.begin(), second), is(second, cluster.end());
    const bool several = !was.empty() && !is.empty();
    if (several && was.size() == is.size() && interchangeable(cluster)) {
      for (std::size_t i = 0; i < was.size(); ++i)
        entries.push_back({was[i].result, is[i].result, {}});
      continue;
    }
    for (const PositionedResult& p : was)
      entries.push_back({p.result, nullptr, why(before, *p.result, several)});
    for (const PositionedResult& p : is)
      entries.push_back({nullptr, p.result, why(after, *p.result, several)});
  }
  return entries;
}

}  // namespace strake::report
