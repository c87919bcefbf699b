// SPDX-License-Identifier: Apache-2.0
#include "strake/geometry/near_across.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "geometry/closest_points.hpp"
#include "geometry/directions.hpp"
#include "geometry/heights.hpp"
#include "geometry/pair_view.hpp"
#include "geometry/triangle_distance.hpp"

namespace strake::geometry {
namespace {

/// Of larger ones a tree asks less than all.
constexpr std::size_t kMostTriangles = 1024;
/// Most pairs of triangles.
constexpr std::size_t kMostPairs = 4096;

/// A triangle at an end of the slab, with its extent in the plane of the slab.
struct EndTriangle {
  std::uint32_t id = 0;
  DoubleTriangle triangle;
  std::array<double, 2> lo{}, hi{};
};

using EndTriangles = std::vector<EndTriangle>;

/// Axes in the plane of the slab: boxes along the coordinate axes would overlap where faces askew
/// do not.
class Plane {
 public:
  explicit Plane(const Vec3d& normal) : axis_{square_to(normal)} {
    axis_[1] = cross(normal, axis_[0]);
  }

  [[nodiscard]] EndTriangles put(const PartView& view, std::span<const std::uint32_t> ids) const {
    EndTriangles ends;
    ends.reserve(ids.size());
    for (const std::uint32_t id : ids) ends.push_back(put(view, id));
    return ends;
  }

 private:
  [[nodiscard]] EndTriangle put(const PartView& view, std::uint32_t id) const {
    EndTriangle end{.id = id, .triangle = DoubleTriangle(view.corners(id))};
    for (std::size_t k = 0; k < 2; ++k) {
      const auto& c = end.triangle.corner;
      const double x = dot(axis_[k], c[0]), y = dot(axis_[k], c[1]), z = dot(axis_[k], c[2]);
      end.lo[k] = std::min({x, y, z});
      end.hi[k] = std::max({x, y, z});
    }
    return end;
  }

  std::array<Vec3d, 2> axis_;
};

bool overlap(const EndTriangle& a, const EndTriangle& b, double room) {
  return a.lo[0] <= b.hi[0] + room && b.lo[0] <= a.hi[0] + room && a.lo[1] <= b.hi[1] + room &&
         b.lo[1] <= a.hi[1] + room;
}

class Search {
 public:
  Search(const PartView& a, const PartView& b, double distance, PairWork& work)
      : a_(a), b_(b), distance_(distance), squared_(distance * distance), work_(work) {}

  /// The first two that are near; nothing where none are.
  [[nodiscard]] std::optional<Closest> first(const EndTriangles& a, const EndTriangles& b) {
    for (const EndTriangle& x : a)
      for (const EndTriangle& y : b) {
        if (!overlap(x, y, distance_ + kHeightMargin)) continue;
        ++work_.triangle_pairs;
        const DistanceBounds bounds = distance_bounds(x.triangle, y.triangle, squared_, squared_);
        if (!(bounds.upper <= squared_)) continue;
        ++work_.exact_fallbacks;
        const Closest near = as_closest(
            exact_distance(a_.corners(x.id), b_.corners(y.id), bounds.upper), {x.id, y.id});
        if (near.distance < distance_) return near;
      }
    return std::nullopt;
  }

 private:
  const PartView &a_, &b_;
  double distance_, squared_;
  PairWork& work_;
};

/// The triangles of a part that reach down to a level, those that lie below it as a whole apart.
struct Ends {
  std::vector<std::uint32_t> lying, others;

  Ends(const Heights& heights, double level) {
    for (const std::uint32_t t : heights.below(level))
      (heights.highest(t) <= level ? lying : others).push_back(t);
  }
};

}  // namespace

NearAcross near_across(const PlacedPart& a, const PlacedPart& b, const Vec3d& normal,
                       double distance, PairWork& work) {
  if (a.part->triangles.size() + b.part->triangles.size() > kMostTriangles) return {};
  const PartView x({a, nullptr}, {}), y({b, nullptr}, b.origin - a.origin);
  const SlabHeights heights(x, y, normal, distance);
  const Plane plane(normal);
  const Ends ends_x(heights.a, heights.level_a), ends_y(heights.b, heights.level_b);
  Search search(x, y, distance, work);
  if (ends_x.lying.size() * ends_y.lying.size() > kMostPairs) return {};
  const EndTriangles lying_x = plane.put(x, ends_x.lying), lying_y = plane.put(y, ends_y.lying);
  if (auto near = search.first(lying_x, lying_y)) return {std::move(near), true};
  const std::size_t all_x = ends_x.lying.size() + ends_x.others.size();
  const std::size_t all_y = ends_y.lying.size() + ends_y.others.size();
  if (all_x * all_y > kMostPairs) return {};
  const EndTriangles others_x = plane.put(x, ends_x.others), others_y = plane.put(y, ends_y.others);
  for (const auto& [p, q] : {std::pair(&lying_x, &others_y), std::pair(&others_x, &lying_y),
                             std::pair(&others_x, &others_y)})
    if (auto near = search.first(*p, *q)) return {std::move(near), true};
  return {std::nullopt, true};
}

}  // namespace strake::geometry
