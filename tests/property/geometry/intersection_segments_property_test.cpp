// SPDX-License-Identifier: Apache-2.0
// What the search for crossing lines leaves out changes none of them: against every pair of
// triangles, on bodies that are flush, flush askew, a unit off, nested and properly crossing.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "geometry/bvh/pair_local_part.hpp"
#include "geometry/intersect/intersection_lines.hpp"
#include "geometry/intersect/separating_plane.hpp"
#include "geometry/obb/oriented_box.hpp"
#include "strake/geometry/intersect.hpp"
#include "strake/geometry/triangle_contact.hpp"
#include "support/draw.hpp"
#include "support/lattice_solids.hpp"
#include "support/rounds.hpp"
#include "support/tube_mesh.hpp"

namespace strake::geometry {
namespace {

using testing::IndexedMesh;
using testing::Subject;

constexpr std::uint64_t kSeeds = test::rounds<std::uint64_t>(1'500, 100'000);

using Lines = std::vector<Segment>;

struct Bodies {
  IndexedMesh a, b;
  std::string recipe;
};

IndexedMesh turned(IndexedMesh mesh, const Mat3d& by) {
  for (Vec3i& v : mesh.vertices) {
    const Vec3d p = by * v.as<double>();
    for (int k = 0; k < 3; ++k) v[k] = static_cast<std::int32_t>(std::lround(p[k]));
  }
  return mesh;
}

IndexedMesh moved(IndexedMesh mesh, const Vec3i& by) {
  for (Vec3i& v : mesh.vertices) v = v + by;
  return mesh;
}

/// Tubes in each other, flush or with play, of equal lengths or not; now and then one stands out
/// through the wall of the other or is a box in its bore.
Bodies tubes(test::Draw& draw) {
  const auto sides = static_cast<std::uint32_t>(draw.whole(3, 13));
  const auto corner = [](double x, double y, double z) {
    return Vec3i{static_cast<std::int32_t>(std::lround(x)),
                 static_cast<std::int32_t>(std::lround(y)),
                 static_cast<std::int32_t>(std::lround(z))};
  };
  const auto tube = [&](double outer, double inner, double z0, double z1) {
    return test::tube<IndexedMesh>(sides, outer, inner, z0, z1, corner);
  };
  const std::array<double, 4> fits{5'700, 5'700, 5'690, 5'200};
  const double bore = fits[draw.below(fits.size())];
  const double from = draw.one_in(2) ? 0 : draw.whole(-9, 9) * 1'000.0;
  const double to = draw.one_in(2) ? 20'000 : draw.whole(12, 30) * 1'000.0;
  Bodies made{tube(5'700, 5'000, 0, 20'000), tube(10'700, bore, from, to), "tubes"};
  if (draw.one_in(4)) made.a = testing::box_mesh({-900, -900, 0}, {900, 900, 20'000});
  if (draw.one_in(6))
    for (Vec3i& v : made.a.vertices) std::swap(v.x, v.z);
  return made;
}

/// Solids, now and then sheets.
Bodies on_lattice(std::uint64_t seed) {
  std::mt19937_64 rng{seed};
  const testing::LatticePair pair = testing::random_pair(rng);
  const testing::LatticeMap scale{{Vec3i{1000, 0, 0}, {0, 1000, 0}, {0, 0, 1000}}, {}};
  Bodies made{mapped(pair.a.mesh, scale), mapped(pair.b.mesh, scale), pair.recipe};
  if (rng() % 4 == 0) made.a = mapped(testing::random_sheet(rng), scale);
  if (rng() % 4 == 0) made.b = mapped(testing::random_sheet(rng), scale);
  return made;
}

Bodies bodies(std::uint64_t seed) {
  test::Draw draw(seed);
  Bodies made = draw.one_in(2) ? tubes(draw) : on_lattice(seed);
  if (!draw.one_in(4)) {
    const Mat3d by = draw.rotation();
    made.a = turned(std::move(made.a), by);
    made.b = turned(std::move(made.b), by);
    made.recipe += " askew";
  }
  if (draw.one_in(2))
    made.b = moved(std::move(made.b), {draw.whole(-1, 2), draw.whole(-1, 2), draw.whole(-1, 2)});
  return made;
}

struct SegmentQuery {
  const Subject& a;
  const Subject& b;
  OrientedBox frame_a, frame_b;

  SegmentQuery(const Subject& x, const Subject& y)
      : a(x), b(y), frame_a(make_oriented_box(x.part)), frame_b(make_oriented_box(y.part)) {}

  [[nodiscard]] Lines quick(std::int64_t flush, QueryContext& work) const {
    return part_intersection_lines({a.treed().placed, &frame_a, &a.tree},
                                   {b.treed().placed, &frame_b, &b.tree}, flush, work);
  }
  [[nodiscard]] Lines of_all(std::int64_t flush, QueryContext& work) const {
    return part_intersection_lines_brute_force(a.treed().placed, b.treed().placed, flush, work);
  }
  [[nodiscard]] bool parted() const {
    return oriented_box_separation({a.treed().placed, &frame_a}, {b.treed().placed, &frame_b},
                                   1e-300)
               .lower > 0;
  }
  [[nodiscard]] bool on_one_side() const {
    const PairLocalPart x(a.treed(), {}), y(b.treed(), b.origin - a.origin);
    return lies_on_one_side(x, y) || lies_on_one_side(y, x);
  }
  [[nodiscard]] bool meet_at_all() const {
    QueryContext work;
    return meet(a.treed(), b.treed(), work).boundaries_meet;
  }
};

TEST(IntersectionSegmentsTest, LeavesOutNothingThatCrosses) {
  std::size_t lines = 0, parted = 0, flush_on_one_side = 0;
  std::uint64_t visited = 0, all = 0;
  for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
    const Bodies made = bodies(seed);
    SCOPED_TRACE("seed " + std::to_string(seed) + " " + made.recipe);
    // Of another origin, at the same place.
    const Subject a(made.a), b(moved(made.b, {-3, 5, -7}), {3, -5, 7});
    const SegmentQuery query(a, b);
    for (const std::int64_t flush : {0, 3}) {
      QueryContext quick, slow;
      const Lines expected = query.of_all(flush, slow);
      ASSERT_EQ(query.quick(flush, quick), expected) << "faces that touch within " << flush;
      lines += expected.size();
      visited += quick.triangle_pairs;
      all += slow.triangle_pairs;
      if (query.parted()) {
        ++parted;
        ASSERT_TRUE(expected.empty()) << "a plane parts them";
      }
      if (query.on_one_side()) {
        if (query.meet_at_all()) ++flush_on_one_side;
        ASSERT_TRUE(expected.empty()) << "each face has the other on one side";
      }
    }
  }
  EXPECT_GT(lines, kSeeds);
  EXPECT_GT(parted, kSeeds / 50);
  EXPECT_GT(flush_on_one_side, kSeeds / 50);
  EXPECT_LT(visited * 8, all);
}

/// Parts of so many triangles are walked by their trees.
TEST(IntersectionSegmentsTest, LargePartsAreWalked) {
  for (const bool askew : {false, true}) {
    std::array<IndexedMesh, 2> meshes{testing::box_mesh({0, 0, 0}, {6'400, 6'400, 6'400}),
                                      testing::box_mesh({3'200, 3'200, -640}, {9'600, 640, 9'600})};
    for (IndexedMesh& mesh : meshes) {
      for (int i = 0; i < 4; ++i) mesh = testing::subdivided(mesh);
      if (askew) mesh = turned(std::move(mesh), test::Draw(1).rotation());
    }
    const Subject a(meshes[0]), b(meshes[1]);
    ASSERT_TRUE(needs_bvhs(a.part, b.part));
    const SegmentQuery query(a, b);
    QueryContext quick, slow;
    const Lines expected = query.of_all(3, slow);
    EXPECT_FALSE(expected.empty());
    EXPECT_EQ(query.quick(3, quick), expected);
    EXPECT_LT(quick.triangle_pairs * 100, slow.triangle_pairs);
  }
}

TEST(IntersectionSegmentsTest, TubesThatFitCostNoPairOfTriangles) {
  const auto tube = [](double outer, double inner) {
    return test::tube<IndexedMesh>(24, outer, inner, 0, 6'000'000,
                                   [](double x, double y, double z) {
                                     return Vec3i{static_cast<std::int32_t>(std::lround(x)),
                                                  static_cast<std::int32_t>(std::lround(y)),
                                                  static_cast<std::int32_t>(std::lround(z))};
                                   });
  };
  const Subject pipe(tube(57'000, 50'000)), insulation(tube(107'000, 57'000));
  QueryContext work;
  EXPECT_TRUE(SegmentQuery(pipe, insulation).quick(3, work).empty());
  EXPECT_TRUE(SegmentQuery(insulation, pipe).quick(3, work).empty());
  EXPECT_EQ(work.triangle_pairs, 0U);
}

/// Against the edges of both triangles, each asked where it meets the other triangle.
TEST(IntersectionSegmentsTest, EndsOfWhatTwoTrianglesHaveInCommon) {
  std::size_t crossing = 0;
  for (std::uint64_t seed = 1; seed <= 20 * kSeeds; ++seed) {
    test::Draw draw(seed);
    // From a lattice, where corners lie in planes, to the edge of the range.
    const std::int64_t unit = std::int64_t{1} << draw.below(29);
    const auto triangle = [&] {
      std::array<Vec3l, 3> t;
      for (Vec3l& p : t)
        for (int k = 0; k < 3; ++k) p[k] = unit * draw.whole(-3, 4) + draw.whole(-1, 2);
      return t;
    };
    const std::array<Vec3l, 3> s = triangle(), t = triangle();
    const auto has_area = [](const std::array<Vec3l, 3>& c) {
      return !(cross_exact(c[1] - c[0], c[2] - c[0]) == Vec3<Int128>{});
    };
    if (!has_area(s) || !has_area(t)) continue;
    const ExactTriangle a(s), b(t);
    const TriangleContact c = contact(a, b);
    if (c.touch != Touch::segment || c.coplanar || c.edge_a >= 0 || c.edge_b >= 0) continue;
    ++crossing;
    SCOPED_TRACE(seed);
    std::vector<RationalPoint> expected;
    for (const auto& [of, in] : {std::pair(&s, &t), std::pair(&t, &s)})
      for (std::size_t i = 0; i < 3; ++i) {
        const GridLine edge{(*of)[i], (*of)[(i + 1) % 3]};
        const LineInTriangle hit = intersect(edge, *in);
        if (hit.at.touch != Touch::point) continue;
        const RationalPoint end = point_at(edge, hit.at.first);
        ASSERT_EQ(rounded_at(edge, hit.at.first), end.rounded());
        if (expected.empty() || !(end == expected.front())) expected.push_back(end);
      }
    for (const EdgeAtPlane& end : segment_ends(a, b, c)) {
      const auto& of = end.of_b ? t : s;
      const GridLine edge{of[static_cast<std::size_t>(end.from)],
                          of[static_cast<std::size_t>(end.to)]};
      const LineInPlane hit = intersect_plane(edge, end.of_b ? s : t);
      ASSERT_EQ(hit.at.touch, Touch::point);
      const RationalPoint at = point_at(edge, hit.at.first);
      ASSERT_TRUE(std::ranges::any_of(expected, [&](const RationalPoint& p) { return p == at; }));
    }
    ASSERT_GE(expected.size(), 2U);
  }
  EXPECT_GT(crossing, kSeeds);
}

/// Halves are rounded away from zero, and no double is near enough to tell what is next to one.
TEST(IntersectionSegmentsTest, RoundedPointsOnLines) {
  constexpr std::int64_t kFar = std::int64_t{1} << 31U;
  const GridLine line{{-3, 4, 0}, {kFar - 3, 4 - kFar, 1}};
  for (const Int128 den : {Int128{2}, Int128{kFar}, Int128{kFar} * kFar * kFar})
    for (int step = -2; step <= 2; ++step) {
      const Rational at{den / 2 + step, den};
      EXPECT_EQ(rounded_at(line, at), point_at(line, at).rounded());
    }
}

}  // namespace
}  // namespace strake::geometry
