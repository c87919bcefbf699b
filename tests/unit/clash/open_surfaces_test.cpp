// SPDX-License-Identifier: Apache-2.0
// What lies within a surface that nearly encloses it is not lost in silence; what lies in a tank is
// no clash.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <string_view>

#include "strake/geometry/winding_number.hpp"
#include "support/clash_model.hpp"
#include "support/near_closed.hpp"
#include "support/rounds.hpp"

namespace strake {
namespace {

using geometry::TriangleMesh;
using geometry::Vec3d;
using test::ClashModel;
using test::Draw;

constexpr std::string_view kInOpen = "pair-in-open-surface";

/// The mesh without the triangles that a test picks.
template <class Pick>
TriangleMesh without(TriangleMesh mesh, const Pick& pick) {
  std::erase_if(mesh.triangles, [&](const geometry::Triangle& t) { return pick(mesh, t); });
  return mesh;
}

TriangleMesh lidless(double x, double y, double z) {
  return without(test::closed_box(x, y, z).mesh, [&](const TriangleMesh& m, const auto& t) {
    return std::ranges::all_of(t, [&](std::uint32_t v) { return m.vertices[v].z > 0; });
  });
}

/// The box whose lid stands `gap` off.
TriangleMesh lid_off(double x, double y, double z, double gap) {
  TriangleMesh mesh = lidless(x, y, z);
  const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
  const double h = z / 2 + gap;
  for (const Vec3d& v : {Vec3d{-x / 2, -y / 2, h}, Vec3d{x / 2, -y / 2, h}, Vec3d{x / 2, y / 2, h},
                         Vec3d{-x / 2, y / 2, h}})
    mesh.vertices.push_back(v);
  mesh.triangles.push_back({first, first + 1, first + 2});
  mesh.triangles.push_back({first, first + 2, first + 3});
  return mesh;
}

TriangleMesh cube_at(const Vec3d& centre, double half) {
  const Vec3d by{half, half, half};
  return test::box_mesh(centre - by, centre + by);
}

/// What a run with the two in either order says; the same, and the same where both are turned.
bool told(const TriangleMesh& around, const TriangleMesh& within) {
  Draw draw(11);
  bool first = false;
  for (int i = 0; i < 4; ++i) {
    TriangleMesh a = around, b = within;
    if (i > 1) {
      const auto turn = draw.rotation();
      for (TriangleMesh* const mesh : {&a, &b}) test::place_mesh(*mesh, turn, {1e4, -2e4, 3e4});
    }
    ClashModel m;
    if (i % 2 == 0)
      m.object("a").body(a).object("b").body(b);
    else
      m.object("b").body(b).object("a").body(a);
    const clash::Report report = m.detect();
    const bool is_told = !report.not_compared.empty();
    if (i == 0) first = is_told;
    EXPECT_EQ(is_told, first);
    EXPECT_EQ(report.diagnostics.count(kInOpen), is_told ? 1U : 0U);
    EXPECT_EQ(report.diagnostics.skipped(), is_told ? 1U : 0U);
    if (!is_told) continue;
    EXPECT_EQ(report.not_compared.size(), 1U);
    EXPECT_EQ(report.not_compared[0].code, kInOpen);
    EXPECT_TRUE(report.not_compared[0].b.has_value());
    EXPECT_TRUE(report.pairs.empty());
  }
  return first;
}

TEST(OpenSurfaces, ALidThatStandsOff) {
  for (const double gap : {0.05, 0.5, 3.0})
    for (const double size : {600.0, 2000.0}) {
      const TriangleMesh box = lid_off(1000, size, 800, gap);
      EXPECT_TRUE(told(box, cube_at({0, 0, 0}, 100)));
      EXPECT_TRUE(told(box, cube_at({300, 100, -250}, 50)));
      EXPECT_FALSE(told(box, cube_at({0, 0, 900}, 50)));
      EXPECT_FALSE(told(box, cube_at({900, 0, 0}, 50)));
    }
}

TEST(OpenSurfaces, AFacetTooFew) {
  for (const std::uint32_t sectors : {24U, 48U, 100U}) {
    const test::ClosedBody body = test::closed_cylinder(200, 600, sectors);
    for (std::size_t t = 0; t < body.mesh.triangles.size(); t += 7) {
      TriangleMesh mesh = body.mesh;
      mesh.triangles.erase(mesh.triangles.begin() + static_cast<std::ptrdiff_t>(t));
      EXPECT_TRUE(told(mesh, cube_at({0, 0, 300}, 60)));
      EXPECT_FALSE(told(mesh, cube_at({0, 0, 700}, 60)));
    }
  }
}

TEST(OpenSurfaces, TanksTraysAndDecksAreMeant) {
  for (const double depth : {100.0, 500.0, 1000.0, 3000.0})
    for (const double height : {-0.4, 0.0, 0.3})
      EXPECT_FALSE(told(lidless(1000, 1000, depth), cube_at({0, 0, height * depth}, 20)));
}

TEST(OpenSurfaces, AHitIsTold) {
  ClashModel m;
  m.object("a")
      .body(lid_off(1000, 1000, 1000, 1))
      .body(test::box_mesh({-50, -50, -50}, {50, 50, 50}));
  m.object("b").body(cube_at({0, 0, 0}, 30));
  const clash::Report report = m.detect();
  ASSERT_EQ(report.pairs.size(), 1U);
  EXPECT_EQ(report.pairs[0].cls, clash::Class::hit);
  EXPECT_TRUE(report.not_compared.empty());
}

// Against the sum over all triangles, each by its own solid angle.
TEST(WindingNumber, IsThatOfAllTriangles) {
  for (std::uint64_t seed = 1; seed <= test::rounds(20U, 500U); ++seed) {
    SCOPED_TRACE(seed);
    Draw draw(seed);
    TriangleMesh mesh = test::sphere_mesh(500, 12);
    for (int i = 0; i < 40; ++i)
      mesh.triangles.erase(mesh.triangles.begin() +
                           static_cast<std::ptrdiff_t>(draw.below(mesh.triangles.size())));
    geometry::Part part;
    for (const Vec3d& v : mesh.vertices) part.vertices.push_back(v.as<std::int32_t>());
    part.triangles = mesh.triangles;
    const geometry::WindingNumber winding(part);
    for (int i = 0; i < 20; ++i) {
      const Vec3d at{draw.between(-900, 900), draw.between(-900, 900), draw.between(-900, 900)};
      double filled = 0;
      for (const geometry::Triangle& t : mesh.triangles) {
        const auto corner = [&](std::size_t k) { return part.vertices[t[k]].as<double>() - at; };
        const Vec3d a = corner(0), b = corner(1), c = corner(2);
        const double x = std::sqrt(dot(a, a)), y = std::sqrt(dot(b, b)), z = std::sqrt(dot(c, c));
        filled += std::atan2(dot(a, cross(b, c)),
                             x * y * z + dot(a, b) * z + dot(b, c) * x + dot(c, a) * y) /
                  (2 * std::numbers::pi);
      }
      EXPECT_NEAR(winding.at(at), filled, 0.02);
    }
  }
}

}  // namespace
}  // namespace strake
