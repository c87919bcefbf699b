// SPDX-License-Identifier: Apache-2.0
// A body whose flat faces are cut into more triangles, slivers among them, is drawn as before.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "strake/hlr/hlr.hpp"
#include "support/drawn_lengths.hpp"
#include "support/near_closed.hpp"
#include "support/rounds.hpp"

namespace strake {
namespace {

using geometry::Triangle;
using geometry::TriangleMesh;
using geometry::Vec3d;
using geometry::Vec3l;

/// How far the third corner of a triangle is off a side, mm.
double height_over(const TriangleMesh& mesh, std::size_t number, std::size_t side) {
  const Triangle t = mesh.triangles[number];
  const Vec3d a = mesh.vertices[t[side]], way = mesh.vertices[t[(side + 1) % 3]] - a,
              area = cross(way, mesh.vertices[t[(side + 2) % 3]] - a);
  return std::sqrt(dot(area, area) / dot(way, way));
}

/// Whether a triangle is as narrow as that above one of its sides.
bool is_narrow(const TriangleMesh& mesh, std::size_t number) {
  constexpr double kNarrowMm = 1;
  return height_over(mesh, number, 0) < kNarrowMm || height_over(mesh, number, 1) < kNarrowMm ||
         height_over(mesh, number, 2) < kNarrowMm;
}

/// Cuts a side at a drawn point, and the triangle beyond it there too.
void cut_side(TriangleMesh& mesh, std::size_t number, std::size_t side, test::Draw& draw) {
  const std::uint32_t a = mesh.triangles[number][side], c = mesh.triangles[number][(side + 1) % 3];
  const auto b = static_cast<std::uint32_t>(mesh.vertices.size());
  mesh.vertices.push_back(mesh.vertices[a] +
                          (mesh.vertices[c] - mesh.vertices[a]) * draw.between(0.05, 0.95));
  const std::size_t count = mesh.triangles.size();
  for (std::size_t i = 0; i < count; ++i)
    for (std::size_t k = 0; k < 3; ++k) {
      const Triangle t = mesh.triangles[i];
      const std::uint32_t from = t[k], to = t[(k + 1) % 3], top = t[(k + 2) % 3];
      if (std::minmax(from, to) != std::minmax(a, c)) continue;
      mesh.triangles[i] = {from, b, top};
      mesh.triangles.push_back({b, to, top});
      break;
    }
}

/// Cuts a triangle at a point so far off one of its sides, mm.
void cut_beside(TriangleMesh& mesh, std::size_t number, std::size_t side, double off,
                test::Draw& draw) {
  const Triangle t = mesh.triangles[number];
  const std::uint32_t a = t[side], c = t[(side + 1) % 3], top = t[(side + 2) % 3];
  const Vec3d way = mesh.vertices[c] - mesh.vertices[a], up = mesh.vertices[top] - mesh.vertices[a];
  const double part = draw.between(0.05, 0.95);
  const double height = height_over(mesh, number, side);
  const auto b = static_cast<std::uint32_t>(mesh.vertices.size());
  mesh.vertices.push_back(mesh.vertices[a] + way * (part * (1 - off / height)) +
                          up * (off / height));
  mesh.triangles[number] = {a, c, b};
  mesh.triangles.push_back({c, top, b});
  mesh.triangles.push_back({top, a, b});
}

/// Whether two drawings show as much of each kind in each state, but for specks.
::testing::AssertionResult have_equal_lengths(const test::DrawnLengths& is,
                                              const test::DrawnLengths& was) {
  const auto length_in = [](const test::DrawnLengths& drawn, const auto& what) {
    const auto at = drawn.lengths.find(what);
    return at == drawn.lengths.end() ? 0.0 : at->second;
  };
  for (const test::DrawnLengths* const drawn : {&is, &was})
    for (const auto& [what, length] : drawn->lengths) {
      const double now = length_in(is, what), before = length_in(was, what);
      if (std::fabs(now - before) > 0.0001 * before + 200)
        return ::testing::AssertionFailure()
               << "kind " << static_cast<int>(what.first) << " state "
               << static_cast<int>(what.second) << ": " << now << " um of lines, before " << before;
    }
  return ::testing::AssertionSuccess();
}

// Where a face is seen all but edge-on, a corner that was rounded beyond its rim may still hide a
// stretch of that: of one body in a hundred no more.
TEST(RefinedBodies, LookAsBefore) {
  const std::uint64_t bodies = test::rounds(200U, 10'000U);
  std::string unlike;
  std::uint64_t others = 0;
  for (std::uint64_t seed = 1; seed <= bodies; ++seed) {
    test::Draw draw(seed);
    TriangleMesh plain = test::drawn_body(draw).mesh, cut = plain;
    for (std::uint64_t i = 2 + draw.below(30); i > 0; --i) {
      const auto number = static_cast<std::size_t>(draw.below(cut.triangles.size()));
      const auto side = static_cast<std::size_t>(draw.below(3));
      if (is_narrow(cut, number)) continue;
      if (draw.one_in(2))
        cut_side(cut, number, side, draw);
      else
        cut_beside(cut, number, side, 0.001 * std::exp(draw.between(0, 5)), draw);
    }
    const auto turn = draw.rotation();
    for (TriangleMesh* const mesh : {&plain, &cut}) test::place_mesh(*mesh, turn, {10, 20, 30});
    const Vec3l direction{draw.whole(-50, 50), draw.whole(-50, 50), 60};
    const auto alike = have_equal_lengths(test::drawn_lengths(cut, 0, direction),
                                          test::drawn_lengths(plain, 0, direction));
    if (alike) continue;
    ++others;
    unlike += "seed " + std::to_string(seed) + ": " + alike.message() + '\n';
  }
  EXPECT_LE(others * 100, bodies) << unlike;
}

/// A flat sheet cut into strips along it, so wide: each wound as it says.
TriangleMesh strips(const std::vector<std::pair<double, bool>>& widths) {
  constexpr double kLength = 100;
  TriangleMesh mesh;
  double y = 0;
  mesh.vertices = {{0, y, 0}, {kLength, y, 0}};
  for (const auto& [width, turned] : widths) {
    y += width;
    const auto a = static_cast<std::uint32_t>(mesh.vertices.size());
    mesh.vertices.push_back({0, y, 0});
    mesh.vertices.push_back({kLength, y, 0});
    for (Triangle t : {Triangle{a - 2, a - 1, a + 1}, Triangle{a - 2, a + 1, a}}) {
      if (turned) std::swap(t[1], t[2]);
      mesh.triangles.push_back(t);
    }
  }
  return mesh;
}

// Which way the strips of a sheet are wound means nothing, slivers among them.
TEST(RefinedBodies, TurnedSliversOfASheetLeaveNoLines) {
  test::Draw draw(5);
  for (const double width : {0.002, 0.01, 0.1})
    for (int i = 0; i < 20; ++i) {
      TriangleMesh sheet = strips({{50, draw.one_in(2)},
                                   {width, draw.one_in(2)},
                                   {width, draw.one_in(2)},
                                   {50, draw.one_in(2)}});
      test::place_mesh(sheet, draw.rotation(), {10, 20, 30});
      const Vec3l direction{draw.whole(-50, 50), draw.whole(-50, 50), 60};
      for (const auto& [what, length] : test::drawn_lengths(sheet, 0, direction).lengths)
        EXPECT_EQ(what.first, hlr::EdgeKind::boundary) << width << ": " << length;
    }
}

}  // namespace
}  // namespace strake
