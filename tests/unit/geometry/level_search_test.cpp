// SPDX-License-Identifier: Apache-2.0
// Nothing clears a level while a sample is deeper: also where meshes overlap themselves, so that
// their faces have the part on both sides.
#include "geometry/interior_depth/level_search/level_search.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <optional>
#include <random>
#include <utility>
#include <vector>

#include "../../support/nonconvex_bodies.hpp"
#include "geometry/interior_depth/local_depth_maximum.hpp"
#include "geometry/numeric/vector_math.hpp"

namespace strake::geometry {
namespace {

using testing::box_mesh;
using testing::IndexedMesh;
using testing::Subject;
using testing::turned;

class DrawReal {
 public:
  explicit DrawReal(std::uint64_t seed) : random_(seed) {}
  double in(double lo, double hi) {
    return lo + (hi - lo) * static_cast<double>(random_() % 1'000'000) * 1e-6;
  }
  std::int32_t whole(double lo, double hi) { return static_cast<std::int32_t>(in(lo, hi)); }
  Vec3d point(const Box3d& box) {
    Vec3d p;
    for (int k = 0; k < 3; ++k) p[k] = in(box.lo[k], box.hi[k]);
    return on_field_grid(p);
  }

 private:
  std::mt19937_64 random_;
};

/// A box with others in it and through its sides, as one mesh.
IndexedMesh boxes(DrawReal& draw) {
  IndexedMesh all = box_mesh({0, 0, 0}, {100'000, 100'000, 100'000});
  for (int i = 0; i < 10; ++i) {
    Vec3i lo, hi;
    for (int k = 0; k < 3; ++k) {
      lo[k] = draw.whole(-5'000, 80'000);
      hi[k] = lo[k] + draw.whole(5'000, 40'000);
    }
    all.append(box_mesh(lo, hi));
  }
  return all;
}

/// A pyramid whose apex is the origin; its axis leans off x.
IndexedMesh pyramid(double lean, double azimuth, double half, double height) {
  const double c = std::cos(lean), n = std::sin(lean);
  const Vec3d axis{c, n * std::cos(azimuth), n * std::sin(azimuth)}, u = perpendicular_to(axis),
                                                                     v = cross(axis, u);
  IndexedMesh mesh;
  mesh.vertices.push_back({0, 0, 0});
  for (const auto& [x, y] : {std::pair{1, 1}, {-1, 1}, {-1, -1}, {1, -1}}) {
    const Vec3d p = axis * height + u * (x * half) + v * (y * half);
    mesh.vertices.push_back({static_cast<std::int32_t>(std::lround(p.x)),
                             static_cast<std::int32_t>(std::lround(p.y)),
                             static_cast<std::int32_t>(std::lround(p.z))});
  }
  mesh.triangles = {{0, 2, 1}, {0, 3, 2}, {0, 4, 3}, {0, 1, 4}, {1, 2, 3}, {1, 3, 4}};
  return mesh;
}

/// A wide one and slender ones that end beyond its base, as one mesh: faces that cross have the
/// apex in common, and most of each is outside the others.
IndexedMesh pyramids(DrawReal& draw) {
  IndexedMesh all = pyramid(0, 0, draw.in(80'000, 120'000), 100'000);
  for (int i = 0; i < 12; ++i) {
    const double lean = draw.in(0, 0.9), azimuth = draw.in(0, 6.3);
    all.append(pyramid(lean, azimuth, draw.in(5'000, 30'000), draw.in(250'000, 400'000)));
  }
  return all;
}

/// A box about a point, so far to each side.
IndexedMesh about(const Vec3d& p, double least, double most, DrawReal& draw) {
  Vec3i lo, hi;
  for (int k = 0; k < 3; ++k) {
    lo[k] = static_cast<std::int32_t>(p[k]) - draw.whole(least, most);
    hi[k] = static_cast<std::int32_t>(p[k]) + draw.whole(least, most);
  }
  return box_mesh(lo, hi);
}

/// Of boxes about points that are deeper in a part than all that is near them.
template <class Make>
void expect_no_level_clear_below_a_point(const Make& make) {
  int queries = 0;
  for (std::uint64_t seed = 1; seed <= 1500; ++seed) {
    SCOPED_TRACE(seed);
    DrawReal draw(seed);
    const IndexedMesh two = make(draw);
    const Subject a(seed % 2 == 0 ? turned(two) : two);
    const PartWithBvh part = a.treed();
    const FaceKdop planes_of = make_face_kdop(a.part);
    DistanceField of(part, {}, &planes_of);
    of.prepare();
    QueryContext work;
    Vec3d start = draw.point(of.box());
    for (int i = 0; i < 50 && !of.contains(start, work); ++i) start = draw.point(of.box());
    if (!of.contains(start, work)) continue;
    const Vec3d top = on_field_grid(local_depth_maximum(of, of, start, std::nullopt));
    const double depth = of.nearest(top).distance;
    if (!(depth > 1000)) continue;
    const Subject b(about(top, 0.05 * depth, 0.9 * depth, draw));
    const PartWithBvh box = b.treed();
    const FaceKdop planes_in = make_face_kdop(b.part);
    DistanceField in(box, {}, &planes_in);
    in.prepare();
    const std::vector<HalfSpace> hull_of = half_spaces_of(of), hull_in = half_spaces_of(in);
    ++queries;
    for (const double share : {0.5, 0.9, 0.99}) {
      LevelQuery question{.level = share * depth,
                          .known = share * depth * 0.99,
                          .ceiling = 2 * depth,
                          .slack = 1.0 / 1024,
                          .max_cells = 100'000};
      EXPECT_FALSE(search_above_level(of, in, question, {}, work).none) << share;
      question.hull_of = hull_of;
      question.hull_in = hull_in;
      EXPECT_FALSE(search_above_level(of, in, question, {}, work).none) << share << ", with hulls";
    }
  }
  EXPECT_GT(queries, 500);
}

TEST(LevelSearch, ClearsNoLevelBelowAPointWhereBoxesOverlap) {
  expect_no_level_clear_below_a_point(boxes);
}
TEST(LevelSearch, ClearsNoLevelBelowAPointWhereFacesCrossAtACorner) {
  expect_no_level_clear_below_a_point(pyramids);
}

}  // namespace
}  // namespace strake::geometry
