// SPDX-License-Identifier: Apache-2.0
#pragma once

// Decision 0023 says why faces at the ends of a slab come before trees.

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include "geometry/bvh/pair_local_part.hpp"
#include "strake/geometry/part_pair.hpp"

// Heights over a slab between two parts, the triangles at its ends, and proximity across it.

namespace strake::geometry {

/// Grid units: far above the rounding of a height, far below any length that matters.
inline constexpr double kHeightMargin = 1.0 / 16;

/// The heights of a small part's vertices along a direction.
class Heights {
 public:
  Heights(const PairLocalPart& view, const Vec3d& up) : part_(view.part()) {
    all_.reserve(part_.vertices.size());
    for (std::uint32_t v = 0; v < part_.vertices.size(); ++v) {
      all_.push_back(dot(up, view.vertex(v).as<double>()));
      least_ = std::min(least_, all_.back());
    }
  }

  [[nodiscard]] double least() const { return least_; }
  [[nodiscard]] double at(std::uint32_t vertex) const { return all_[vertex]; }

  /// Returns the triangles with a corner no higher than a level, ascending.
  [[nodiscard]] std::vector<std::uint32_t> below(double level) const {
    std::vector<std::uint32_t> low;
    for (std::uint32_t t = 0; t < part_.triangles.size(); ++t)
      if (lowest(t) <= level) low.push_back(t);
    return low;
  }

  [[nodiscard]] double lowest(std::uint32_t triangle) const {
    const Triangle& t = part_.triangles[triangle];
    return std::min({all_[t[0]], all_[t[1]], all_[t[2]]});
  }
  [[nodiscard]] double highest(std::uint32_t triangle) const {
    const Triangle& t = part_.triangles[triangle];
    return std::max({all_[t[0]], all_[t[1]], all_[t[2]]});
  }

 private:
  const Part& part_;
  std::vector<double> all_;  ///< by vertex
  double least_ = std::numeric_limits<double>::infinity();
};

/// The heights of two parts over the slab between them: up to which level a triangle may be near
/// the other part.
struct SlabHeights {
  Heights a, b;
  double level_a = 0, level_b = 0;

  /// `normal`: unit, from b to a. Two points within `reach` grid units of each other are no
  /// farther apart across the slab.
  SlabHeights(const PairLocalPart& of_a, const PairLocalPart& of_b, const Vec3d& normal,
              double reach)
      : a(of_a, normal), b(of_b, -normal) {
    const double margin = reach * (1 + 1e-12) + kHeightMargin;
    level_a = margin - b.least();
    level_b = margin - a.least();
  }
};

/// The triangles of two parts at either end of a slab between them.
struct SlabFaces {
  std::vector<std::uint32_t> a, b;
  double beyond = 0;  ///< grid units: a pair with a triangle not listed is farther apart, certainly
};

/// Returns the triangles at the ends of a slab; nothing where one of the parts has more than
/// `limit` of them. `normal`: unit, from b to a. The cost is that of the triangles found in the
/// trees.
[[nodiscard]] std::optional<SlabFaces> slab_faces(const PairLocalPart& a, const PairLocalPart& b,
                                                  const Vec3d& normal, std::size_t limit);

/// The proximity of two parts across a slab.
struct SlabProximity {
  std::optional<ClosestPair> near;  ///< as find_pair_within() gives it
  bool decided = false;             ///< false: too many triangles, and nothing is known
};

/// find_pair_within() of small parts that lie face to face, without trees. `normal`, a unit vector
/// from b to a, is across the widest slab between them (oriented_box.hpp), whose width may be
/// slightly negative: only triangles that come within `distance` grid units of its other end are
/// tested, those at its ends first.
[[nodiscard]] SlabProximity slab_proximity(const PlacedPart& a, const PlacedPart& b,
                                           const Vec3d& normal, double distance,
                                           QueryContext& work);

}  // namespace strake::geometry
