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
#include <utility>

#include "geometry/distance/winding_number.hpp"
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
bool reported(const TriangleMesh& around, const TriangleMesh& within) {
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
    const bool is_reported = !report.not_compared.empty();
    if (i == 0) first = is_reported;
    EXPECT_EQ(is_reported, first);
    EXPECT_EQ(report.diagnostics.count(kInOpen), is_reported ? 1U : 0U);
    EXPECT_EQ(report.diagnostics.skipped(), is_reported ? 1U : 0U);
    if (!is_reported) continue;
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
      EXPECT_TRUE(reported(box, cube_at({0, 0, 0}, 100)));
      EXPECT_TRUE(reported(box, cube_at({300, 100, -250}, 50)));
      EXPECT_FALSE(reported(box, cube_at({0, 0, 900}, 50)));
      EXPECT_FALSE(reported(box, cube_at({900, 0, 0}, 50)));
    }
}

TEST(OpenSurfaces, AFacetTooFew) {
  for (const std::uint32_t sectors : {24U, 48U, 100U}) {
    const test::ClosedBody body = test::closed_cylinder(200, 600, sectors);
    for (std::size_t t = 0; t < body.mesh.triangles.size(); t += 7) {
      TriangleMesh mesh = body.mesh;
      mesh.triangles.erase(mesh.triangles.begin() + static_cast<std::ptrdiff_t>(t));
      EXPECT_TRUE(reported(mesh, cube_at({0, 0, 300}, 60)));
      EXPECT_FALSE(reported(mesh, cube_at({0, 0, 700}, 60)));
    }
  }
}

// Half a side of a box is a triangle that its file lost, however much leads out; so are a window,
// and two triangles of two sides.
TEST(OpenSurfaces, APieceOfAFaceTooFew) {
  for (const Vec3d& size : {Vec3d{400, 400, 400}, Vec3d{900, 500, 200}, Vec3d{300, 300, 1500}}) {
    const TriangleMesh box = test::closed_box(size.x, size.y, size.z).mesh;
    for (std::size_t t = 0; t < box.triangles.size(); ++t) {
      TriangleMesh mesh = box;
      mesh.triangles.erase(mesh.triangles.begin() + static_cast<std::ptrdiff_t>(t));
      EXPECT_TRUE(reported(mesh, cube_at({0, 0, 0}, 30))) << t;
      EXPECT_FALSE(reported(mesh, cube_at({0, 0, 900}, 30))) << t;
    }
  }
  for (const std::uint32_t sectors : {3U, 4U, 6U, 12U}) {
    const test::ClosedBody body = test::closed_cylinder(200, 600, sectors);
    for (std::size_t t = 0; t < body.mesh.triangles.size(); ++t) {
      TriangleMesh mesh = body.mesh;
      mesh.triangles.erase(mesh.triangles.begin() + static_cast<std::ptrdiff_t>(t));
      EXPECT_TRUE(reported(mesh, cube_at({0, 0, 300}, 20))) << sectors << ' ' << t;
    }
  }
}

/// A tank without a lid, with a flange round its mouth, outwards or inwards.
TriangleMesh flanged(double x, double y, double z, double flange) {
  TriangleMesh mesh = lidless(x, y, z);
  const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
  for (const double by : {0.0, flange})
    for (const auto& [sx, sy] :
         {std::pair(-1, -1), std::pair(1, -1), std::pair(1, 1), std::pair(-1, 1)})
      mesh.vertices.push_back({sx * (x / 2 + by), sy * (y / 2 + by), z / 2});
  for (std::uint32_t i = 0; i < 4; ++i) {
    const std::uint32_t j = (i + 1) % 4, a = first + i, b = first + j, c = first + 4 + j,
                        d = first + 4 + i;
    mesh.triangles.push_back({a, d, c});
    mesh.triangles.push_back({a, c, b});
  }
  return mesh;
}

TEST(OpenSurfaces, TanksWithFlangesAreMeant) {
  for (const double flange : {20.0, 80.0, -20.0, -80.0}) {
    EXPECT_FALSE(reported(flanged(1000, 1000, 1000, flange), cube_at({0, 0, -200}, 100))) << flange;
    EXPECT_FALSE(reported(flanged(1500, 700, 900, flange), cube_at({0, 0, -200}, 100))) << flange;
  }
}

TEST(OpenSurfaces, TanksTraysAndDecksAreMeant) {
  for (const double depth : {100.0, 500.0, 1000.0, 3000.0})
    for (const double height : {-0.4, 0.0, 0.3})
      EXPECT_FALSE(reported(lidless(1000, 1000, depth), cube_at({0, 0, height * depth}, 20)));
}

/// A box of `cells` by as many squares a side, without one triangle of `left_out`.
TriangleMesh tank(double size, std::uint32_t cells, std::size_t left_out) {
  TriangleMesh mesh;
  const auto corner = [&](int axis, double across, double u, double v) {
    Vec3d p;
    p[axis] = across * size;
    p[(axis + 1) % 3] = u * size;
    p[(axis + 2) % 3] = v * size;
    mesh.vertices.push_back(p);
    return static_cast<std::uint32_t>(mesh.vertices.size() - 1);
  };
  for (int axis = 0; axis < 3; ++axis)
    for (const double across : {0.0, 1.0})
      for (std::uint32_t i = 0; i < cells; ++i)
        for (std::uint32_t j = 0; j < cells; ++j) {
          const double u = 1.0 * i / cells, v = 1.0 * j / cells, w = 1.0 / cells;
          const std::uint32_t p = corner(axis, across, u, v), q = corner(axis, across, u + w, v);
          const std::uint32_t r = corner(axis, across, u + w, v + w);
          const std::uint32_t s = corner(axis, across, u, v + w);
          const bool out = across > 0;
          mesh.triangles.push_back(out ? geometry::Triangle{p, q, r} : geometry::Triangle{p, r, q});
          mesh.triangles.push_back(out ? geometry::Triangle{p, r, s} : geometry::Triangle{p, s, r});
        }
  mesh.triangles.erase(mesh.triangles.begin() + static_cast<std::ptrdiff_t>(left_out));
  return mesh;
}

void add_quad(TriangleMesh& mesh, const Vec3d& a, const Vec3d& b, const Vec3d& c, const Vec3d& d) {
  const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
  for (const Vec3d& v : {a, b, c, d}) mesh.vertices.push_back(v);
  mesh.triangles.push_back({first, first + 1, first + 2});
  mesh.triangles.push_back({first, first + 2, first + 3});
}

void turn_some(TriangleMesh& mesh, double share, Draw& draw) {
  for (geometry::Triangle& t : mesh.triangles)
    if (draw.between(0, 1) < share) std::swap(t[1], t[2]);
}

// What stands in a tank, on it or beside it, and triangles that face the wrong way.
TEST(OpenSurfaces, WhatASkinHasBesidesMakesNoDifference) {
  for (std::uint64_t seed = 1; seed <= test::rounds(4U, 40U); ++seed) {
    SCOPED_TRACE(seed);
    Draw draw(seed);
    const double s = draw.between(400, 3000);
    const auto cells = static_cast<std::uint32_t>(4 + draw.below(5));
    for (int kind = 0; kind < 6; ++kind) {
      SCOPED_TRACE(kind);
      TriangleMesh mesh = tank(s, cells, static_cast<std::size_t>(draw.below(12 * cells * cells)));
      const double h = draw.between(0.6, 0.9) * s;
      if (kind == 1)
        add_quad(mesh, {0.2 * s, 0.2 * s, h}, {0.8 * s, 0.2 * s, h}, {0.8 * s, 0.8 * s, h},
                 {0.2 * s, 0.8 * s, h});
      if (kind == 2) add_quad(mesh, {s, 0, 0}, {s, s, 0}, {1.9 * s, s, 0}, {1.9 * s, 0, 0});
      if (kind == 3)
        add_quad(mesh, {1.3 * s, 0, 0}, {2.5 * s, 0, 0}, {2.5 * s, s, 0}, {1.3 * s, s, 0});
      if (kind == 4) add_quad(mesh, {s / 2, 0, 0}, {s / 2, s, 0}, {s / 2, s, s}, {s / 2, 0, s});
      turn_some(mesh,
                kind == 0   ? 0.05
                : kind == 5 ? 0.5
                            : 0.1 * static_cast<double>(draw.below(2)),
                draw);
      EXPECT_TRUE(reported(mesh, cube_at({0.25 * s, 0.4 * s, 0.3 * s}, 0.1 * s)));
      EXPECT_FALSE(reported(mesh, cube_at({1.2 * s, 0.4 * s, 0.3 * s}, 0.05 * s)));
    }
  }
}

// The bore of a tube is not within, whichever way its triangles face.
TEST(OpenSurfaces, WhatIsInABoreIsOutside) {
  for (std::uint64_t seed = 1; seed <= test::rounds(4U, 40U); ++seed) {
    SCOPED_TRACE(seed);
    Draw draw(seed);
    TriangleMesh mesh = test::closed_tube(500, 200, 1500, 24).mesh;
    mesh.triangles.erase(mesh.triangles.begin() +
                         static_cast<std::ptrdiff_t>(draw.below(mesh.triangles.size())));
    turn_some(mesh, 0.1 * static_cast<double>(draw.below(3)), draw);
    EXPECT_FALSE(reported(mesh, cube_at({0, 0, draw.between(-500, 500)}, 30)));
  }
}

// A rod that reaches out through the gap, by little or by much.
TEST(OpenSurfaces, ARodThroughTheGap) {
  TriangleMesh mesh = tank(1000, 6, 0);
  std::erase_if(mesh.triangles, [&](const geometry::Triangle& t) {
    return std::ranges::all_of(t, [&](std::uint32_t v) {
      const Vec3d& p = mesh.vertices[v];
      return p.z > 999 && p.x > 300 && p.x < 520 && p.y > 300 && p.y < 520;
    });
  });
  for (const double top : {900.0, 999.0, 1001.0, 1400.0, 9000.0})
    EXPECT_TRUE(reported(mesh, test::box_mesh({380, 380, 200}, {440, 440, top})));
  EXPECT_FALSE(reported(mesh, test::box_mesh({380, 380, 1002}, {440, 440, 1400})));
}

/// What is said of a box that stands on the floor of a tank, or on its lid.
clash::Pair standing(const TriangleMesh& around, double floor) {
  ClashModel m;
  m.object("a").body(around).object("b").body(
      test::box_mesh({400, 400, floor}, {600, 600, floor + 200}));
  const clash::Report report = m.detect();
  EXPECT_TRUE(report.not_compared.empty());
  EXPECT_EQ(report.pairs.size(), 1U);
  return report.pairs.empty() ? clash::Pair{} : report.pairs[0];
}

// A touch is reported in any case; in what is nearly closed, that it may be more.
TEST(OpenSurfaces, WhatStandsOnTheFloorMayBeAHit) {
  for (const std::size_t left_out : {5U, 100U, 300U}) {
    const TriangleMesh mesh = tank(1000, 6, left_out);
    for (const double off : {0.0, 0.2, 0.9}) {
      const clash::Pair in = standing(mesh, off), on = standing(mesh, 1000 + off);
      for (const clash::Pair* const p : {&in, &on}) EXPECT_EQ(p->cls, clash::Class::contact);
      EXPECT_EQ(in.severest, clash::Class::hit);
      EXPECT_NE(in.flags & clash::kUncertain, 0);
      EXPECT_EQ(on.severest, clash::Class::contact);
      EXPECT_EQ(on.flags & clash::kUncertain, 0);
    }
  }
  TriangleMesh open = lidless(1000, 1000, 1000);
  test::place_mesh(open, {}, {500, 500, 500});
  EXPECT_EQ(standing(open, 0).severest, clash::Class::contact);
}

TEST(OpenSurfaces, AHitIsReported) {
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
