// SPDX-License-Identifier: Apache-2.0
#include "geometry/parting/near_areas.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "geometry/axis_rays.hpp"
#include "geometry/corner_index.hpp"
#include "geometry/near_walk.hpp"
#include "strake/geometry/part_edges.hpp"

namespace strake::geometry {
namespace {

/// Steps of the walk for each triangle. Sheets that lie on each other all over take about 20.
constexpr std::uint64_t kLeastSteps = 4096, kStepsPerTriangle = 256;

/// Whether a triangle lies within a distance of another's plane.
bool lies_along(const TriangleCorners& t, const TriangleCorners& other, double distance) {
  const ExactPlane plane(other[0], other[1], other[2]);
  const Vec3d& n = plane.normal();
  const double reach = distance * std::sqrt(dot(n, n));
  return std::ranges::all_of(
      t, [&](const Vec3l& p) { return std::fabs(dot(n, (p - other[0]).as<double>())) <= reach; });
}

class Gatherer {
 public:
  Gatherer(const PartView& a, const PartView& b, bool of_b, double distance, PairWork& work)
      : a_(a), b_(b), of_b_(of_b), own_(of_b ? b : a), distance_(distance), work_(work) {
    found_.number.assign(own_.part().triangles.size(), NearAreas::kNone);
  }

  std::optional<NearAreas> run() {
    if (!walk()) return std::nullopt;
    std::ranges::sort(found_.triangles, {}, &NearTriangle::triangle);
    for (std::uint32_t i = 0; i < found_.triangles.size(); ++i)
      found_.number[found_.triangles[i].triangle] = i;
    join();
    return std::move(found_);
  }

 private:
  bool walk() {
    const double reach = distance_ * distance_;
    const std::uint64_t most =
        kLeastSteps + kStepsPerTriangle * (a_.part().triangles.size() + b_.part().triangles.size());
    NearWalk walk(a_, b_, work_, reach);
    walk.start(reach);
    return walk.run(
               reach,
               [&](const NearTriangles& near) {
                 add(near);
                 return true;
               },
               most) == WalkEnd::done;
  }

  void add(const NearTriangles& near) {
    const std::uint32_t t = of_b_ ? near.b : near.a;
    std::uint32_t& number = found_.number[t];
    if (number == NearAreas::kNone) {
      number = static_cast<std::uint32_t>(found_.triangles.size());
      found_.triangles.push_back({.triangle = t});
    }
    NearTriangle& known = found_.triangles[number];
    if (known.along) return;
    const TriangleCorners s = a_.corners(near.a), u = b_.corners(near.b);
    known.along = lies_along(s, u, distance_) || lies_along(u, s, distance_);
  }

  void join() {
    SidedSets sets(found_.triangles.size());
    std::vector<bool> twisted(found_.triangles.size(), false);
    for (std::uint32_t i = 0; i < found_.triangles.size(); ++i)
      for (int edge = 0; edge < 3; ++edge) join(i, edge, sets, twisted);
    found_.two_sided.assign(found_.triangles.size(), true);
    for (std::uint32_t i = 0; i < found_.triangles.size(); ++i) {
      const SidedSets::Root root = sets.find(i);
      found_.triangles[i].area = root.root;
      found_.triangles[i].swapped = root.swapped;
      if (twisted[i]) found_.two_sided[root.root] = false;
    }
  }

  void join(std::uint32_t i, int edge, SidedSets& sets, std::vector<bool>& twisted) const {
    const Part& part = own_.part();
    const std::uint32_t t = found_.triangles[i].triangle;
    const Triangle& corner = part.triangles[t];
    const std::uint32_t u = corner[at(edge)], v = corner[at(next_corner(edge))];
    for (const std::uint32_t other : star(part, t, edge)) {
      const std::uint32_t j = found_.number[other];
      if (other <= t || j == NearAreas::kNone) continue;
      // Neighbours that face the same way run along their edge in opposite directions.
      if (!sets.join(i, j, runs_along(part.triangles[other], u, v))) twisted[i] = true;
    }
  }

  const PartView &a_, &b_;
  bool of_b_;
  const PartView& own_;
  double distance_;
  PairWork& work_;
  NearAreas found_;
};

}  // namespace

std::optional<NearAreas> near_areas(const PartView& a, const PartView& b, bool of_b,
                                    double distance, PairWork& work) {
  return Gatherer(a, b, of_b, distance, work).run();
}

}  // namespace strake::geometry
