// SPDX-License-Identifier: Apache-2.0
#include "hlr/edges/slivers.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <span>
#include <utility>

#include "geometry/predicates/exact_normal.hpp"
#include "strake/geometry/part.hpp"

namespace strake::hlr {
namespace {

using geometry::Part;
using geometry::PartEdge;
using geometry::Vec3d;
using geometry::Vec3l;

/// Half the diagonal of a grid cell: the farthest that the snap moves a corner, grid units.
constexpr double kSnapMove = 0.8660254037844386;
constexpr double kMaxTurn = 0.0044;  // a quarter of a degree

std::array<double, 3> squared_sides(const Part& part, std::uint32_t t) {
  std::array<double, 3> sides{};
  const geometry::Triangle& corners = part.triangles[t];
  for (std::size_t k = 0; k < 3; ++k) {
    const Vec3l way = part.vertices[corners[(k + 1) % 3]].as<std::int64_t>() -
                      part.vertices[corners[k]].as<std::int64_t>();
    const Vec3d d = way.as<double>();
    sides[k] = dot(d, d);
  }
  return sides;
}

Vec3d rounded_normal(const Part& part, std::uint32_t t) {
  const geometry::ExactNormal n = triangle_normal(part, t);
  return {static_cast<double>(n[0]), static_cast<double>(n[1]), static_cast<double>(n[2])};
}

/// Returns the distance of a point from the plane of a triangle, grid units.
double off_plane(const Part& part, std::uint32_t triangle, std::uint32_t vertex) {
  const Vec3l to = part.vertices[vertex].as<std::int64_t>() -
                   part.vertices[part.triangles[triangle][0]].as<std::int64_t>();
  const Vec3d size = rounded_normal(part, triangle);
  return std::fabs(static_cast<double>(along(triangle_normal(part, triangle), to))) /
         std::sqrt(dot(size, size));
}

/// Propagates planes to slivers, from triangles that have their own, step by step.
class Owners {
 public:
  explicit Owners(const Part& part) : part_(part), within_(2 + part.weld) {
    for (std::uint32_t t = 0; t < part.triangles.size(); ++t) {
      const bool alone = part.faces.empty() || part.faces[t] == geometry::kNoIndex;
      if (alone && turn_by_rounding(part, t) >= kMaxTurn) slivers_.push_back(t);
    }
  }

  [[nodiscard]] PlaneOwners take() && {
    if (slivers_.empty()) return {};
    owners_.of.resize(part_.triangles.size());
    std::iota(owners_.of.begin(), owners_.of.end(), 0U);
    owners_.turned.assign(owners_.of.size(), 0);
    known_.assign(owners_.of.size(), 1);
    for (const std::uint32_t t : slivers_) known_[t] = 0;
    bool found = false;
    for (std::vector<std::uint32_t> left = slivers_; !left.empty();) {
      const std::vector<Owned> next = owned(left);
      if (next.empty()) break;
      found = true;
      for (const Owned& o : next) {
        owners_.of[o.sliver] = o.owner;
        owners_.turned[o.sliver] = o.turned ? 1 : 0;
        known_[o.sliver] = 1;
      }
      left = beside(next);
    }
    if (!found) owners_ = {};
    return std::move(owners_);
  }

 private:
  struct Owned {
    std::uint32_t sliver = 0, owner = 0;
    bool turned = false;
  };

  /// Calls take() with each triangle beyond a long side of this one, and whether the two are wound
  /// differently.
  template <class Take>
  void each_beside(std::uint32_t t, const Take& take) const {
    constexpr double kLong = 0.25;  // half of the longest, squared
    const std::array<double, 3> sides = squared_sides(part_, t);
    const double longest = *std::max_element(sides.begin(), sides.end());
    const geometry::Triangle& corners = part_.triangles[t];
    for (std::size_t k = 0; k < 3; ++k) {
      if (sides[k] < kLong * longest) continue;
      const std::uint32_t e = geometry::edge_between(part_, corners[k], corners[(k + 1) % 3]);
      if (e == geometry::kNoIndex) continue;
      const std::span<const std::uint32_t> round = geometry::incident_triangles(part_, e);
      if (round.size() != 2) continue;
      const std::uint32_t other = round[0] == t ? round[1] : round[0];
      take(other,
           geometry::has_directed_edge(part_.triangles[other], corners[k], corners[(k + 1) % 3]));
    }
  }

  /// Returns the slivers that lie in the plane of a triangle beside them that has an owner, with
  /// that owner. Of two planes, as where a corner of a flat face was rounded beyond its rim, it is
  /// the one to which the sliver turns less.
  [[nodiscard]] std::vector<Owned> owned(const std::vector<std::uint32_t>& slivers) const {
    std::vector<Owned> found;
    for (const std::uint32_t t : slivers) {
      Owned best{t, t, false};
      double largest = 0;
      each_beside(t, [&](std::uint32_t other, bool wound_differently) {
        const std::uint32_t owner = owners_.of[other];
        if (known_[other] == 0 || !is_near_plane(t, owner)) return;
        const bool turned = wound_differently != (owners_.turned[other] != 0);
        const double along = turned ? -cosine(t, owner) : cosine(t, owner);
        if (best.owner != t && !(along > largest)) return;
        best = {t, owner, turned};
        largest = along;
      });
      if (best.owner != t) found.push_back(best);
    }
    return found;
  }

  [[nodiscard]] bool is_near_plane(std::uint32_t t, std::uint32_t owner) const {
    return std::ranges::all_of(
        part_.triangles[t], [&](std::uint32_t v) { return off_plane(part_, owner, v) <= within_; });
  }
  [[nodiscard]] double cosine(std::uint32_t s, std::uint32_t t) const {
    const Vec3d m = rounded_normal(part_, s), n = rounded_normal(part_, t);
    return dot(m, n) / std::sqrt(dot(m, m) * dot(n, n));
  }

  /// Returns the slivers without a plane beside these, each once, ascending.
  [[nodiscard]] std::vector<std::uint32_t> beside(const std::vector<Owned>& some) const {
    std::vector<std::uint32_t> found;
    for (const Owned& o : some)
      each_beside(o.sliver, [&](std::uint32_t other, bool) {
        if (known_[other] == 0) found.push_back(other);
      });
    std::sort(found.begin(), found.end());
    found.erase(std::unique(found.begin(), found.end()), found.end());
    return found;
  }

  const Part& part_;
  double within_;
  std::vector<std::uint32_t> slivers_;
  PlaneOwners owners_;
  std::vector<std::uint8_t> known_;
};

}  // namespace

double turn_by_rounding(const Part& part, std::uint32_t triangle) {
  const std::array<double, 3> sides = squared_sides(part, triangle);
  const geometry::Triangle& t = part.triangles[triangle];
  const Vec3l p = part.vertices[t[0]].as<std::int64_t>();
  const Vec3d area = cross((part.vertices[t[1]].as<std::int64_t>() - p).as<double>(),
                           (part.vertices[t[2]].as<std::int64_t>() - p).as<double>());
  // Height = twice the area by the longest side.
  const double longest = *std::max_element(sides.begin(), sides.end());
  const double moved = 2 * (kSnapMove + part.weld);
  const double squared = moved * moved * longest, size = dot(area, area);
  if (!(squared < kMaxTurn * kMaxTurn * size)) return kMaxTurn;
  return std::sqrt(squared / size);
}

PlaneOwners plane_owners(const Part& part) {
  if (part.primitive) return {};
  return Owners(part).take();
}

// Each corner is off by half a unit along each axis, so the third corner of `other` is off the
// plane of `one` by no more than two units, unless that is a sliver.
bool bends(const Part& part, const PlaneOwners& owners, const PartEdge& edge, std::uint32_t one,
           std::uint32_t other) {
  const std::uint32_t owner = owners.owner(one);
  if (owner == owners.owner(other)) return false;
  const geometry::ExactNormal n = triangle_normal(part, owner);
  const Vec3l from = part.vertices[part.triangles[owner][0]].as<std::int64_t>();
  for (const std::uint32_t v : part.triangles[other]) {
    if (v == edge.v0 || v == edge.v1) continue;
    geometry::Int128 off = along(n, part.vertices[v].as<std::int64_t>() - from), size = 0;
    for (const geometry::Int128 component : n) size += component < 0 ? -component : component;
    if (off < 0) off = -off;
    if (off > 2 * size) return true;
  }
  return false;
}

}  // namespace strake::hlr
