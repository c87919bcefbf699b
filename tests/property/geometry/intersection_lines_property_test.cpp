// SPDX-License-Identifier: Apache-2.0
// Lines along which two skins pass through each other, against the triangles themselves: each line
// lies on both skins, and where two triangles cross with their insides there is a line.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "geometry/intersect/intersection_lines.hpp"
#include "geometry/obb/oriented_box.hpp"
#include "strake/geometry/closest.hpp"
#include "strake/geometry/intersect.hpp"
#include "strake/geometry/triangle_contact.hpp"
#include "support/lattice_solids.hpp"
#include "support/rounds.hpp"

namespace strake::geometry {
namespace {

using testing::Subject;

constexpr std::uint64_t kSeeds = test::rounds<std::uint64_t>(300, 20'000);
/// What rounding the ends may take a line away from where it should be: half a unit an axis.
constexpr double kRounding = 0.87;

using Lines = std::vector<Segment>;

TriangleCorners corners(const Subject& s, std::uint32_t t) {
  const Part& part = *s.treed().placed.part;
  TriangleCorners c;
  for (std::size_t k = 0; k < 3; ++k)
    c[k] = part.vertices[part.triangles[t][k]].as<std::int64_t>() + s.treed().placed.origin;
  return c;
}

std::size_t triangles(const Subject& s) { return s.treed().placed.part->triangles.size(); }

double distance(const Vec3d& p, const Segment& s) {
  const Vec3d a = s[0].as<double>(), along = s[1].as<double>() - a, off = p - a;
  const double t = std::clamp(dot(along, off) / dot(along, along), 0.0, 1.0);
  const Vec3d rest = off - along * t;
  return std::sqrt(dot(rest, rest));
}

/// All of a line: a chord of a skin with caves may leave it in the middle.
bool lies_on(const Segment& line, const Subject& s) {
  constexpr int kParts = 4;
  for (int i = 0; i <= kParts; ++i) {
    Vec3l p;
    for (int k = 0; k < 3; ++k) p[k] = line[0][k] + (line[1][k] - line[0][k]) * i / kParts;
    double least = 1e300;
    for (std::uint32_t t = 0; t < triangles(s); ++t)
      least = std::min(least, closest_points(p, corners(s, t)).squared.distance());
    if (least > kRounding + 1) return false;
  }
  return true;
}

/// The middle of what two triangles have in common, where they cross with their insides and far.
std::optional<Vec3d> middle_of_crossing(const TriangleCorners& x, const TriangleCorners& y) {
  const TriangleContact c = contact(ExactTriangle(x), ExactTriangle(y));
  if (c.touch != Touch::segment || c.coplanar || c.edge_a >= 0 || c.edge_b >= 0)
    return std::nullopt;
  std::vector<Vec3d> ends;
  for (const auto& [of, in] : {std::pair(&x, &y), std::pair(&y, &x)})
    for (std::size_t i = 0; i < 3; ++i) {
      const GridLine edge{(*of)[i], (*of)[(i + 1) % 3]};
      const LineInTriangle hit = intersect(edge, *in);
      if (hit.at.touch == Touch::point) ends.push_back(point_at(edge, hit.at.first).value());
    }
  Vec3d lo = ends.front(), hi = ends.front();
  for (const Vec3d& p : ends) {
    lo = std::min(lo, p);
    hi = std::max(hi, p);
  }
  if (dot(hi - lo, hi - lo) < 16) return std::nullopt;
  return (lo + hi) * 0.5;
}

Lines lines_of(const Subject& a, const Subject& b, std::int64_t flush = 0) {
  QueryContext work;
  const OrientedBox frame_a = make_oriented_box(a.part), frame_b = make_oriented_box(b.part);
  return part_intersection_lines({a.treed().placed, &frame_a, &a.tree},
                                 {b.treed().placed, &frame_b, &b.tree}, flush, work);
}

TEST(IntersectionLinesTest, AreThoseOfTheTriangles) {
  std::size_t crossing = 0, apart = 0, lines_found = 0;
  for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
    std::mt19937_64 rng{seed};
    const testing::LatticePair pair = testing::random_pair(rng);
    SCOPED_TRACE("seed " + std::to_string(seed) + " " + pair.recipe);
    const testing::LatticeMap scale{{Vec3i{1000, 0, 0}, {0, 1000, 0}, {0, 0, 1000}}, {}};
    const testing::IndexedMesh ma = mapped(pair.a.mesh, scale), mb = mapped(pair.b.mesh, scale);
    const Subject a(ma), b(mb);
    const Lines lines = lines_of(a, b);
    for (const Segment& line : lines) {
      ASSERT_LT(line[0], line[1]);
      ASSERT_TRUE(lies_on(line, a) && lies_on(line, b))
          << line[0].x << ' ' << line[0].y << ' ' << line[0].z << " to " << line[1].x << ' '
          << line[1].y << ' ' << line[1].z;
    }
    for (std::uint32_t t = 0; t < triangles(a); ++t)
      for (std::uint32_t u = 0; u < triangles(b); ++u) {
        const auto middle = middle_of_crossing(corners(a, t), corners(b, u));
        if (!middle) continue;
        ++crossing;
        ASSERT_TRUE(std::ranges::any_of(
            lines, [&](const Segment& line) { return distance(*middle, line) <= kRounding; }));
      }
    QueryContext work;
    const Meeting meeting = meet(a.treed(), b.treed(), work).meeting;
    if (meeting == Meeting::apart || meeting == Meeting::touching) {
      ++apart;
      ASSERT_TRUE(lines.empty());
    }
    ASSERT_EQ(lines_of(b, a), lines) << "exchanged";
    const Subject other(testing::shuffled(testing::subdivided(ma), rng));
    ASSERT_EQ(lines_of(other, b), lines) << "cut into other triangles";
    lines_found += lines.size();
  }
  EXPECT_GT(crossing, kSeeds / 2);
  EXPECT_GT(apart, kSeeds / 10);
  EXPECT_GT(lines_found, kSeeds);
}

/// Two plates askew by a few units that cross along a line across their faces.
TEST(IntersectionLinesTest, FacesThatAreMeantToTouchDoNotCross) {
  const auto plate = [](std::int32_t lift) {
    testing::IndexedMesh mesh = testing::box_mesh({0, 0, 0}, {10'000, 10'000, 500});
    for (Vec3i& v : mesh.vertices)
      if (v.x > 0) v.z += lift;
    return mesh;
  };
  testing::IndexedMesh upper = plate(0);
  for (Vec3i& v : upper.vertices) v.z += 499;
  const Subject a(plate(2)), b(upper);
  EXPECT_FALSE(lines_of(a, b).empty());
  for (const Segment& line : lines_of(a, b, 3)) {
    // What is left runs along the rim.
    const bool along_x = line[0].x == line[1].x && (line[0].x == 0 || line[0].x == 10'000);
    const bool along_y = line[0].y == line[1].y && (line[0].y == 0 || line[0].y == 10'000);
    EXPECT_TRUE(along_x || along_y);
  }
}

}  // namespace
}  // namespace strake::geometry
