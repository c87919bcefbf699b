// SPDX-License-Identifier: Apache-2.0
// A body stays a solid whatever the snap to the grid does to its triangles, and what lies in it is
// hit as deep as the definition says: primitives of extreme proportions, and meshes with triangles
// of no area.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "geometry/primitives/tessellate.hpp"
#include "strake/clash/clash.hpp"
#include "strake/geometry/grid.hpp"
#include "support/body_depth.hpp"
#include "support/clash_model.hpp"
#include "support/rounds.hpp"
#include "support/slender_primitives.hpp"
#include "support/slivers.hpp"
#include "support/true_surface.hpp"

namespace strake::clash {
namespace {

using geometry::Mat3d;
using geometry::PartKind;
using geometry::Placement;
using geometry::Primitive;
using geometry::SnoutPrimitive;
using geometry::Vec3d;
using test::ClashModel;
using test::PrimitiveDraw;

/// Thinner bodies may lose their volume to the grid, mm.
constexpr double kThinnest = 0.02;
constexpr std::size_t kTries = 60;
/// What the frames and the snap of the probe leave, mm.
constexpr double kSlack = 2e-3;

Options options_of(bool zero_tolerances) {
  Options options;
  options.tolerances.clearance_mm = 1;
  if (zero_tolerances) options.tolerances.touch_gap_mm = options.tolerances.touch_overlap_mm = 0;
  return options;
}

/// A point well within a primitive, and how deep it is: between two points of its skin.
struct Inner {
  Vec3d at;
  double depth = 0;
};
Inner inner_point(const Primitive& primitive, std::mt19937_64& random) {
  Inner best;
  const std::vector<Vec3d> skin = test::surface_points(primitive, kTries, random);
  for (std::size_t i = 0; i < kTries * 8; ++i) {
    const Vec3d p = (skin[random() % kTries] + skin[random() % kTries]) * 0.5;
    const double depth = test::depth_in(primitive, p);
    if (depth > best.depth) best = {p, depth};
  }
  return best;
}

/// The pair of a body with a cube of the given half side in it.
void expect_hit(const ClashModel& body, const Vec3d& at, double half, double depth,
                const Options& options) {
  ClashModel m = body;
  const Vec3d corner{half, half, half};
  m.box("probe", at - corner, at + corner);
  const Report report = m.detect(options);
  ASSERT_EQ(report.pairs.size(), 1U) << "the probe was missed";
  const Pair& p = report.pairs[0];
  EXPECT_LE(p.d_lower_mm, -depth + kSlack);
  EXPECT_GE(p.d_upper_mm, -depth - half * std::sqrt(3.0) - kSlack);
  if (depth > 2) {
    EXPECT_EQ(name(p.cls), name(Class::hit));
  }
}

void expect_solid(const ClashModel& m, const Options& options) {
  const model::Scene scene = make_scene(m.model, scene_options(options), {}).value();
  ASSERT_EQ(scene.shapes.size(), 1U);
  ASSERT_EQ(scene.shapes[0].parts.size(), 1U);
  EXPECT_EQ(scene.shapes[0].parts[0].kind, PartKind::solid);
  EXPECT_FALSE(scene.shapes[0].parts[0].flags.inverted);
}

void check_primitive(const Primitive& primitive, const Mat3d& linear, std::uint64_t seed) {
  ClashModel m;
  m.object("body").body(primitive, {linear, {}});
  std::mt19937_64 random(seed);
  const Inner inner = inner_point(primitive, random);
  for (const bool zero_tolerances : {false, true}) {
    SCOPED_TRACE(zero_tolerances ? "no tolerances" : "default tolerances");
    const Options options = options_of(zero_tolerances);
    expect_solid(m, options);
    if (inner.depth < kThinnest / 4) continue;
    const double half = std::min(inner.depth / 4, 0.5);
    expect_hit(m, linear * inner.at, half, inner.depth, options);
  }
}

SnoutPrimitive snout(double bottom, double top, double height, double offset_x = 0) {
  SnoutPrimitive s;
  s.bottom_radius = bottom;
  s.top_radius = top;
  s.height = height;
  s.offset_x = offset_x;
  return s;
}

TEST(SlenderSolids, ConesTankRoofsAndNeedles) {
  const std::vector<Primitive> bodies{snout(2000, 1, 3000),
                                      snout(1000, 0.5, 50),
                                      snout(10, 3000, 1000),
                                      snout(3000, 20, 500),
                                      snout(0.13, 240.3, 1),
                                      snout(0.1, 40.37, 0.1),
                                      snout(0.4, 472.4, 6.3, 1.57945),
                                      geometry::SphericalDishPrimitive{0.1, 25},
                                      geometry::EllipticalDishPrimitive{0.04, 900},
                                      geometry::CircularTorusPrimitive{0.15, 0.15, 3.2},
                                      geometry::RectangularTorusPrimitive{0.1, 0.16, 300, 3.14},
                                      geometry::RectangularTorusPrimitive{0, 0.08, 0.9, 5.8}};
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    SCOPED_TRACE("body " + std::to_string(i));
    PrimitiveDraw draw(i);
    const Mat3d quarter{{Vec3d{0, 0, -1}, Vec3d{-1, 0, 0}, Vec3d{0, 1, 0}}};
    for (const Mat3d& linear : {Mat3d{}, quarter, draw.turn()})
      check_primitive(bodies[i], linear, i);
  }
}

TEST(SlenderSolids, PrimitivesOfAnyProportions) {
  std::uint64_t checked = 0;
  for (std::uint64_t seed = 1; seed <= test::rounds(90U, 6'000U); ++seed) {
    PrimitiveDraw draw(seed);
    test::SlenderDraw slender(draw, 2 * kThinnest, test::rounds(300.0, 3000.0));
    const Primitive primitive = slender.of_kind(seed % test::SlenderDraw::kKinds);
    const Mat3d linear = draw.one_in(2) ? Mat3d{} : draw.turn();
    const auto made = tessellate(primitive, linear, 1);
    std::mt19937_64 random(seed);
    // A leaning body may be far thinner than its lengths.
    if (!made.fault.empty() || inner_point(primitive, random).depth < kThinnest / 4) continue;
    SCOPED_TRACE("seed " + std::to_string(seed) + ' ' + std::string(kind_name(primitive)));
    check_primitive(primitive, linear, seed);
    ++checked;
  }
  EXPECT_GT(checked, test::rounds(90U, 6'000U) * 3 / 4);
}

/// A triangle mesh with some sides of its triangles cut at random and sealed with triangles of no
/// area, these in turn as well. Nothing of its surface changes.
geometry::GridMesh with_slivers(geometry::GridMesh mesh, std::mt19937_64& random) {
  for (std::size_t cuts = 4 + random() % 20; cuts > 0; --cuts) {
    const std::size_t t = random() % 3 == 0 ? mesh.triangles.size() - 1 - random() % 2
                                            : random() % mesh.triangles.size();
    const std::size_t side = random() % 3;
    const auto& corner = mesh.triangles[t];
    const auto b =
        test::grid_point_between(mesh.vertices[corner[side]], mesh.vertices[corner[(side + 1) % 3]],
                                 static_cast<std::int64_t>(1 + random() % 7), 8);
    if (b) (void)test::split_and_seal(mesh, t, side, *b);
  }
  return mesh;
}

/// Coordinates are multiples of a high power of two, so that edges have points of the grid.
geometry::GridMesh lattice_body(std::uint64_t seed) {
  PrimitiveDraw draw(seed);
  if (draw.one_in(3)) return test::grid_box({0, 0, 0}, {1 << 20, 1 << 19, 1 << 18});
  const auto made = tessellate(draw.convex(draw.below(PrimitiveDraw::kConvexKinds), 200), {}, 5);
  geometry::GridMesh mesh;
  for (const Vec3d& v : made.mesh.vertices) {
    geometry::Vec3i on;
    for (int k = 0; k < 3; ++k) on[k] = static_cast<std::int32_t>(std::lround(v[k])) * (1 << 12);
    mesh.vertices.push_back(on);
  }
  mesh.triangles = made.mesh.triangles;
  return mesh;
}

geometry::TriangleMesh in_mm(const geometry::GridMesh& mesh) {
  geometry::TriangleMesh m;
  for (const geometry::Vec3i& v : mesh.vertices) m.vertices.push_back(to_mm(v.as<std::int64_t>()));
  m.triangles = mesh.triangles;
  return m;
}

TEST(SlenderSolids, MeshesWithTrianglesOfNoArea) {
  std::uint64_t checked = 0;
  for (std::uint64_t seed = 1; seed <= test::rounds(300U, 30'000U); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    std::mt19937_64 random(seed);
    const geometry::GridMesh plain = lattice_body(seed);
    const geometry::RepairedMesh want = repair_mesh(plain);
    if (want.parts.size() != 1 || want.parts[0].kind != PartKind::solid) continue;
    const geometry::GridMesh slivers = with_slivers(plain, random);
    const geometry::RepairedMesh got = repair_mesh(slivers);
    ASSERT_EQ(got.parts.size(), 1U);
    EXPECT_EQ(got.parts[0].kind, PartKind::solid);
    EXPECT_EQ(got.parts[0].volume, want.parts[0].volume);
    EXPECT_NEAR(got.parts[0].area, want.parts[0].area, 1e-9 * want.parts[0].area);
    EXPECT_EQ(got.parts[0].flags.non_manifold, want.parts[0].flags.non_manifold);
    ++checked;
    if (seed % 4 != 0) continue;
    // The same answer about another body, wherever it stands.
    PrimitiveDraw draw(seed);
    const double size = 0.7 * draw.between(1, 100);
    const Vec3d at = draw.point(300), half{size, size, size};
    std::array<std::vector<Pair>, 2> pairs;
    for (std::size_t i = 0; i < 2; ++i) {
      ClashModel m;
      m.object("body").body(in_mm(i == 0 ? plain : slivers));
      m.box("probe", at - half, at + half);
      pairs[i] = m.detect({.tolerances = {.clearance_mm = 1e4}}).pairs;
    }
    ASSERT_EQ(pairs[0].size(), pairs[1].size());
    for (std::size_t i = 0; i < pairs[0].size(); ++i) {
      const Pair &p = pairs[0][i], &q = pairs[1][i];
      EXPECT_EQ(name(p.cls), name(q.cls));
      EXPECT_EQ(name(p.relation), name(q.relation));
      EXPECT_LE(p.d_lower_mm, q.d_upper_mm);
      EXPECT_LE(q.d_lower_mm, p.d_upper_mm);
    }
  }
  EXPECT_GT(checked, test::rounds(300U, 30'000U) * 3 / 4);
}

}  // namespace
}  // namespace strake::clash
