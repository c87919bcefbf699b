// SPDX-License-Identifier: Apache-2.0
// What planes leave of parts: volumes, outlines and caps of bodies that are known.
#include "geometry/plane_section/plane_section.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "support/lattice_scene.hpp"

namespace strake::geometry {
namespace {

using test::HandPart;

Part box(const Vec3i& lo, const Vec3i& hi) { return test::make_part(test::hand_box(lo, hi)); }

double length(const std::vector<SectionLine>& lines) {
  double sum = 0;
  for (const SectionLine& line : lines) {
    const Vec3d v = (line.at[1] - line.at[0]).as<double>();
    sum += std::sqrt(dot(v, v));
  }
  return sum;
}

/// The area that an oriented rim surrounds, by its vector area along the normal.
double area(const PartSection& cut, std::uint32_t plane, const Vec3l& normal) {
  const Vec3d n = normal.as<double>();
  const Vec3d unit = n * (1 / std::sqrt(dot(n, n)));
  double twice = 0;
  for (const Segment& s : cap_boundary(cut, plane))
    twice += dot(cross(s[0].as<double>(), s[1].as<double>()), unit);
  return twice / 2;
}

/// A prism of the given outline (counter-clockwise), or the hole that it makes.
void add_prism(HandPart& part, const std::vector<Vec3i>& outline, std::int32_t height, bool hole) {
  const auto first = static_cast<std::uint32_t>(part.vertices.size());
  const auto n = static_cast<std::uint32_t>(outline.size());
  for (const std::int32_t z : {0, height})
    for (const Vec3i& v : outline) part.vertices.push_back({v.x, v.y, v.z + z});
  const auto add = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    if (hole) std::swap(b, c);
    part.triangles.push_back({first + a, first + b, first + c});
  };
  for (std::uint32_t i = 0; i < n; ++i) {
    const std::uint32_t j = (i + 1) % n;
    add(i, j, j + n);
    add(i, j + n, i + n);
    if (i == 0 || j == 0) continue;
    add(0, j, i);
    add(n, i + n, j + n);
  }
}

std::vector<Vec3i> circle(std::uint32_t sides, double radius, std::int32_t z = 0) {
  std::vector<Vec3i> points;
  for (std::uint32_t i = 0; i < sides; ++i) {
    const double turn = 2 * std::acos(-1.0) * i / sides;
    points.push_back({static_cast<std::int32_t>(std::lround(radius * std::cos(turn))),
                      static_cast<std::int32_t>(std::lround(radius * std::sin(turn))), z});
  }
  return points;
}

TEST(PlaneSection, BoxIsABoxOfItsRestAndItsOutlineFourLines) {
  const CutPlane plane{{0, 0, 1}, 300};
  const PartSection half = cut(box({0, 0, 0}, {1000, 2000, 500}), {&plane, 1});
  EXPECT_EQ(half.part.kind, PartKind::solid);
  EXPECT_EQ(half.part.volume, 1000.0 * 2000 * 300);
  EXPECT_EQ(half.part.box, (Box3i{{0, 0, 0}, {1000, 2000, 300}}));
  EXPECT_EQ(half.lines.size(), 4U);  // the diagonals of the sides draw no line of their own
  EXPECT_EQ(length(half.lines), 6000);
  EXPECT_EQ(area(half, 0, plane.normal), 2e6);
  EXPECT_EQ(half.rounded, 0U);
}

TEST(PlaneSection, FaceInThePlaneIsTheCutAndWhatStandsOnItGoes) {
  const CutPlane plane{{0, 0, 1}, 500};
  const PartSection below = cut(box({0, 0, 0}, {1000, 2000, 500}), {&plane, 1});
  EXPECT_EQ(below.part.volume, 1e9);
  EXPECT_EQ(below.lines.size(), 4U);
  EXPECT_EQ(area(below, 0, plane.normal), 2e6);
  const PartSection above = cut(box({0, 0, 500}, {1000, 2000, 900}), {&plane, 1});
  EXPECT_TRUE(above.part.triangles.empty());
  EXPECT_TRUE(above.lines.empty());
  // The other way round the same faces are the other boxes' lower ones.
  const CutPlane turned{{0, 0, -1}, -500};
  EXPECT_TRUE(cut(box({0, 0, 0}, {1000, 2000, 500}), {&turned, 1}).part.triangles.empty());
  EXPECT_EQ(cut(box({0, 0, 500}, {1000, 2000, 900}), {&turned, 1}).lines.size(), 4U);
}

TEST(PlaneSection, ThroughAnEdgeAndThroughAVertex) {
  // Diagonally through two edges of a cube.
  const CutPlane diagonal{{1, 1, 0}, 1000};
  const PartSection half = cut(box({0, 0, 0}, {1000, 1000, 1000}), {&diagonal, 1});
  EXPECT_EQ(half.part.volume, 5e8);
  EXPECT_EQ(half.lines.size(), 4U);
  EXPECT_NEAR(length(half.lines), 2000 + 2000 * std::sqrt(2.0), 1e-6);
  EXPECT_NEAR(area(half, 0, diagonal.normal), 1e6 * std::sqrt(2.0), 1e-3);
  // A hexagon round the middle, and a triangle through three vertices.
  const CutPlane middle{{1, 1, 1}, 1500}, corner{{1, 1, 1}, 1000};
  EXPECT_EQ(cut(box({0, 0, 0}, {1000, 1000, 1000}), {&middle, 1}).lines.size(), 6U);
  const PartSection tip = cut(box({0, 0, 0}, {1000, 1000, 1000}), {&corner, 1});
  EXPECT_NEAR(tip.part.volume, 1e9 / 6, 1);
  EXPECT_EQ(tip.lines.size(), 3U);
  // Planes that only touch.
  const CutPlane touching{{1, 1, 1}, 3000}, at_origin{{-1, -1, -1}, 0};
  EXPECT_EQ(cut(box({0, 0, 0}, {1000, 1000, 1000}), {&touching, 1}).part.volume, 1e9);
  EXPECT_TRUE(cut(box({0, 0, 0}, {1000, 1000, 1000}), {&touching, 1}).lines.empty());
  EXPECT_EQ(cut(box({0, 0, 0}, {1000, 1000, 1000}), {&at_origin, 1}).part.volume, 1e9);
}

TEST(PlaneSection, PipeHasTwoOutlinesAndTheAreaOfItsWall) {
  constexpr std::uint32_t kSides = 48;
  HandPart pipe;
  add_prism(pipe, circle(kSides, 100000), 400000, false);
  add_prism(pipe, circle(kSides, 80000), 400000, true);
  const Part part = test::make_part(pipe);
  ASSERT_EQ(part.kind, PartKind::solid);
  const CutPlane plane{{0, 0, 1}, 123456};
  const PartSection ring = cut(part, {&plane, 1});
  const double angle = 2 * std::acos(-1.0) / kSides;
  EXPECT_NEAR(length(ring.lines), kSides * 2 * std::sin(angle / 2) * 180000, 2 * kSides);
  EXPECT_NEAR(area(ring, 0, plane.normal), kSides * std::sin(angle) / 2 * (1e10 - 6.4e9), 1e6);
  EXPECT_EQ(ring.lines.size(), 2 * kSides);
  // Along the axis: two walls.
  const CutPlane lengthwise{{0, 1, 0}, 0};
  const PartSection walls = cut(part, {&lengthwise, 1});
  EXPECT_NEAR(area(walls, 0, lengthwise.normal), 2 * 20000.0 * 400000, 1e4);
  EXPECT_EQ(walls.open_ends, 0U);
}

TEST(PlaneSection, WhatOverlapsItselfIsFilledOnceWhereItIsDouble) {
  // Two prisms that cross in one part: the winding number in common is two.
  HandPart crossed;
  add_prism(crossed, {{0, 0, 0}, {3000, 0, 0}, {3000, 1000, 0}, {0, 1000, 0}}, 5000, false);
  add_prism(crossed, {{1000, -1000, 0}, {2000, -1000, 0}, {2000, 2000, 0}, {1000, 2000, 0}}, 5000,
            false);
  const Part part = test::make_part(crossed);
  const CutPlane plane{{0, 0, 1}, 2500};
  const PartSection both = cut(part, {&plane, 1});
  EXPECT_EQ(both.not_filled, 0U);
  EXPECT_EQ(area(both, 0, plane.normal), 3e6 + 3e6 - 1e6);
}

TEST(PlaneSection, TwoPlanesCutEachOthersCaps) {
  const std::array<CutPlane, 2> planes{CutPlane{{0, 0, 1}, 600}, CutPlane{{1, 0, 0}, 400}};
  const PartSection corner = cut(box({0, 0, 0}, {1000, 1000, 1000}), planes);
  EXPECT_EQ(corner.part.volume, 400.0 * 1000 * 600);
  EXPECT_EQ(area(corner, 0, planes[0].normal), 400.0 * 1000);
  EXPECT_EQ(area(corner, 1, planes[1].normal), 600.0 * 1000);
}

TEST(PlaneSection, SheetsAreCutToLinesAndTheirLooseEndsCounted) {
  HandPart sheet;
  sheet.vertices = {{0, 0, 0}, {1000, 0, 0}, {1000, 0, 1000}, {0, 0, 1000}};
  sheet.triangles = {{0, 1, 2}, {0, 2, 3}};
  const CutPlane plane{{0, 0, 1}, 400};
  const PartSection left = cut(test::make_part(sheet), {&plane, 1});
  EXPECT_EQ(left.part.kind, PartKind::sheet);
  EXPECT_EQ(left.lines.size(), 1U);
  EXPECT_EQ(length(left.lines), 1000);
  EXPECT_EQ(left.open_ends, 2U);
  EXPECT_TRUE(cap_boundary(left, 0).empty());
}

TEST(PlaneSection, SolidThatDoesNotCloseIsCountedNotFilled) {
  Part part = box({0, 0, 0}, {1000, 1000, 1000});
  std::vector<Triangle> triangles = part.triangles.to_vector();
  triangles.pop_back();
  part.triangles = triangles;
  const CutPlane plane{{0, 0, 1}, 400};
  const PartSection left = cut(part, {&plane, 1});
  EXPECT_EQ(left.not_filled, 1U);
  EXPECT_FALSE(left.lines.empty());
}

TEST(PlaneSection, WiresAreCutWhereTheyPass) {
  HandPart wire;
  wire.chains = {{{0, 0, 0}, {0, 0, 1000}, {500, 0, 1000}, {500, 0, 0}}};
  const CutPlane plane{{0, 0, 1}, 300};
  const PartSection left = cut(test::make_part(wire), {&plane, 1});
  EXPECT_EQ(left.part.chain_first, (std::vector<std::uint32_t>{0, 2, 4}));
  EXPECT_EQ(left.part.vertices[1], (Vec3i{0, 0, 300}));
}

/// Both sides of a plane together are the whole.
TEST(PlaneSection, HalvesOfLatticeBodiesAddUp) {
  std::size_t solids = 0;
  for (std::uint64_t seed = 1; seed <= 400; ++seed) {
    const test::LatticeOptions options{.objects = 3, .unit = 1000, .steps = 3};
    const test::SceneBuilder scene = test::lattice_scene(seed, options);
    test::Random random(seed);
    const hlr::Section s = test::random_section(random, options);
    const CutPlane plane{s.normal, dot(s.normal, s.point)}, turned{-s.normal, -plane.offset};
    for (const model::GridShape& shape : scene.scene().shapes)
      for (const Part& part : shape.parts) {
        if (part.kind != PartKind::solid || part.flags.non_manifold) continue;
        const PartSection below = cut(part, {&plane, 1}), above = cut(part, {&turned, 1});
        // Lattice parts come without their volume: a plane far away makes it.
        const CutPlane beyond{{0, 0, 1}, 1 << 20};
        const double whole = cut(part, {&beyond, 1}).part.volume;
        ASSERT_NEAR(below.part.volume + above.part.volume, whole, 3e-3 * std::abs(whole) + 3e7)
            << "seed " << seed;
        // A face in the plane is the cut on one side of it and not on the other.
        const bool flush = std::ranges::any_of(part.triangles, [&](const Triangle& t) {
          return std::ranges::all_of(t, [&](std::uint32_t v) {
            return plane.height(part.vertices[v].as<std::int64_t>()) == 0;
          });
        });
        if (flush) continue;
        ASSERT_NEAR(area(below, 0, plane.normal), area(above, 0, turned.normal), 2e4)
            << "seed " << seed;
        ASSERT_EQ(below.not_filled + above.not_filled, 0U);
        ++solids;
      }
  }
  EXPECT_GT(solids, 500U);
}

}  // namespace
}  // namespace strake::geometry
