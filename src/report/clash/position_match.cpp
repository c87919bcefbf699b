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
#include "strake/core/hash.hpp"

namespace strake::report {
namespace {

constexpr std::size_t kCoordinates = 4;

/// A result as the other run may know it.
struct PositionedResult {
  Hash128 kind;  ///< the hash of what must be equal
  std::array<double, kCoordinates> at{};
  const DocumentResult* result = nullptr;
  bool is_after = false;
};

Hash128 kind_of(const PositionalResults& results, const DocumentResult& r) {
  const ClashDocument& run = results.run();
  const auto side = [&](std::uint32_t object) {
    const DocumentObject& o = run.objects[object];
    const bool positional = results.has(object);
    return std::tuple(positional, results.file_of(o),
                      positional ? without_numbers(o.name) : std::string(o.id));
  };
  // Numbers in ids decide which of the two comes first.
  std::array sides{side(r.a), side(r.b)};
  std::ranges::sort(sides);
  Hasher hasher;
  hasher.add(std::string_view(run.tests[r.test].name)).add(static_cast<std::uint32_t>(r.cls));
  for (const auto& [positional, file, text] : sides)
    hasher.add(std::uint32_t{positional}).add(std::string_view(file)).add(std::string_view(text));
  return hasher.value();
}

void place(const PositionalResults& results, bool is_after, std::vector<PositionedResult>& all) {
  for (const DocumentResult& r : results.run().results)
    if (results.has(r))
      all.push_back(
          {kind_of(results, r), {r.point_mm.x, r.point_mm.y, r.point_mm.z, r.d_mm}, &r, is_after});
}

using Cluster = std::span<PositionedResult>;

/// Sorts a cluster, and cuts it between neighbours that are apart(one, next).
template <class Before, class Apart>
void cut(Cluster all, Before&& before, Apart&& apart, std::vector<Cluster>& clusters) {
  std::ranges::sort(all, before);
  for (std::size_t first = 0, end = 0; first < all.size(); first = end) {
    for (end = first + 1; end < all.size() && !apart(all[end - 1], all[end]);) ++end;
    clusters.push_back(all.subspan(first, end - first));
  }
}

/// Returns clusters of results that are alike, with a gap in some coordinate between any two
/// clusters.
std::vector<Cluster> clusters_of(Cluster all) {
  std::vector<Cluster> clusters;
  cut(
      all, [](const PositionedResult& x, const PositionedResult& y) { return x.kind < y.kind; },
      [](const PositionedResult& x, const PositionedResult& y) { return x.kind != y.kind; },
      clusters);
  // What a cut along one coordinate separates may leave gaps along those before it.
  constexpr std::size_t kRounds = 2;
  for (std::size_t k = 0; k < kRounds * kCoordinates; ++k) {
    const auto at = [k](const PositionedResult& p) { return p.at[k % kCoordinates]; };
    std::vector<Cluster> finer;
    finer.reserve(clusters.size());
    for (const Cluster cluster : clusters)
      cut(
          cluster,
          [&](const PositionedResult& x, const PositionedResult& y) { return at(x) < at(y); },
          [&](const PositionedResult& x, const PositionedResult& y) {
            return at(y) - at(x) > kSameMm;
          },
          finer);
    clusters = std::move(finer);
  }
  return clusters;
}

/// Whether it makes no difference which result of one run is paired with which of the other: all
/// are at one place, and those of a run differ in nothing that a comparison considers.
bool interchangeable(const Cluster cluster) {
  for (std::size_t k = 0; k < kCoordinates; ++k) {
    const auto [least, most] =
        std::ranges::minmax(cluster, {}, [k](const PositionedResult& p) { return p.at[k]; });
    if (most.at[k] - least.at[k] > kSameMm) return false;
  }
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
                                     const FileMap& files, Run side)
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
  for (const Cluster cluster : clusters_of(all)) {
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
