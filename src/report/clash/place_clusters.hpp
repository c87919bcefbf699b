// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <tuple>
#include <utility>
#include <vector>

#include "strake/core/hash.hpp"

/// Finds results of two runs that are alike and lie at one place, for results that keys do not
/// identify.
namespace strake::report {

/// The three of the point, and d.
inline constexpr std::size_t kPlaceCoordinates = 4;

/// What a result is placed by.
struct PlacedResult {
  Hash128 kind;  ///< the hash of what must be equal
  std::array<double, kPlaceCoordinates> at{};
  bool is_after = false;
};

/// An object of a result, as far as it is known in either run.
struct PlacedObject {
  bool positional = false;
  std::string file;
  std::string text;  ///< its id; of one whose id is only a position, its name without numbers

  friend auto operator<=>(const PlacedObject&, const PlacedObject&) = default;
};

/// Returns the hash of what must be equal. Numbers in ids decide which of the two objects comes
/// first, so that their order does not count.
[[nodiscard]] inline Hash128 kind_hash(std::string_view test, std::uint32_t cls,
                                       std::array<PlacedObject, 2> objects) {
  std::ranges::sort(objects);
  Hasher hasher;
  hasher.add(test).add(cls);
  for (const auto& [positional, file, text] : objects)
    hasher.add(std::uint32_t{positional}).add(std::string_view(file)).add(std::string_view(text));
  return hasher.value();
}

/// Sorts a cluster, and cuts it between neighbours that are apart(one, next).
template <class Placed, class Before, class Apart>
void cut_cluster(std::span<Placed> all, Before&& before, Apart&& apart,
                 std::vector<std::span<Placed>>& clusters) {
  std::ranges::sort(all, before);
  for (std::size_t first = 0, end = 0; first < all.size(); first = end) {
    for (end = first + 1; end < all.size() && !apart(all[end - 1], all[end]);) ++end;
    clusters.push_back(all.subspan(first, end - first));
  }
}

/// Returns clusters of results that are alike, with a gap of more than `same_mm` in some coordinate
/// between any two clusters. A Placed is a PlacedResult with more.
template <class Placed>
[[nodiscard]] std::vector<std::span<Placed>> clusters_of(std::span<Placed> all, double same_mm) {
  std::vector<std::span<Placed>> clusters;
  cut_cluster(
      all, [](const Placed& x, const Placed& y) { return x.kind < y.kind; },
      [](const Placed& x, const Placed& y) { return x.kind != y.kind; }, clusters);
  // What a cut along one coordinate separates may leave gaps along those before it.
  constexpr std::size_t kRounds = 2;
  for (std::size_t k = 0; k < kRounds * kPlaceCoordinates; ++k) {
    const auto at = [k](const Placed& p) { return p.at[k % kPlaceCoordinates]; };
    std::vector<std::span<Placed>> finer;
    finer.reserve(clusters.size());
    for (const std::span<Placed> cluster : clusters)
      cut_cluster(
          cluster, [&](const Placed& x, const Placed& y) { return at(x) < at(y); },
          [&](const Placed& x, const Placed& y) { return at(y) - at(x) > same_mm; }, finer);
    clusters = std::move(finer);
  }
  return clusters;
}

/// Whether no two results of a cluster are farther apart than `same_mm` along any coordinate.
template <class Placed>
[[nodiscard]] bool is_one_place(std::span<Placed> cluster, double same_mm) {
  for (std::size_t k = 0; k < kPlaceCoordinates; ++k) {
    const auto [least, largest] =
        std::ranges::minmax(cluster, {}, [k](const Placed& p) { return p.at[k]; });
    if (largest.at[k] - least.at[k] > same_mm) return false;
  }
  return true;
}

}  // namespace strake::report
