// SPDX-License-Identifier: Apache-2.0
// How faces are cut into triangles is not seen: corners on the edges of others draw no lines.
#include "support/t_junctions.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <map>
#include <utility>

#include "strake/hlr/hlr.hpp"
#include "support/clash_model.hpp"
#include "support/grid_bodies.hpp"

namespace strake {
namespace {

using geometry::GridMesh;
using geometry::Vec3d;
using geometry::Vec3i;
using geometry::Vec3l;

using Lengths = std::map<std::pair<hlr::EdgeKind, hlr::State>, double>;

Lengths drawn(const GridMesh& mesh, const Vec3l& direction) {
  geometry::TriangleMesh mm;
  for (const Vec3i& v : mesh.vertices) mm.vertices.push_back(v.as<double>() * 1e-3);
  mm.triangles = mesh.triangles;
  mm.faces = mesh.faces;
  test::ClashModel m;
  m.object("a").body(mm).box("b", {2000, -9000, 1000}, {2500, -8000, 1500});
  const model::Scene scene = make_scene(m.model, {}, {}).value();
  const hlr::View view{.direction = direction, .limits = {}};
  Lengths lengths;
  const auto drawing = hlr::draw(scene, {}, view, {}, {});
  EXPECT_TRUE(drawing.has_value());
  if (!drawing) return lengths;
  for (const hlr::EdgePiece& p : drawing->pieces) {
    const auto way = (p.b - p.a).as<double>();
    lengths[{p.kind, p.state}] += std::sqrt(dot(way, way));
  }
  return lengths;
}

void expect_same_lines(const GridMesh& whole, const GridMesh& cut) {
  for (const Vec3l& direction : {Vec3l{1, -1, 1}, Vec3l{0, 0, 1}, Vec3l{3, -7, 2}}) {
    const Lengths a = drawn(whole, direction), b = drawn(cut, direction);
    ASSERT_EQ(a.size(), b.size());
    for (const auto& [what, length] : a) EXPECT_NEAR(b.at(what), length, 1000);
  }
}

TEST(TJunctionDrawings, ASolidLooksLikeItself) {
  for (std::uint64_t seed = 1; seed <= 30; ++seed) {
    SCOPED_TRACE(seed);
    test::Draw draw(seed);
    GridMesh mesh = test::grid_stair(5'040'000);
    test::split_sides(mesh, 60, draw);
    expect_same_lines(test::grid_stair(5'040'000), mesh);
  }
}

TEST(TJunctionDrawings, SoDoFacesAndWhatIsOpen) {
  for (std::uint64_t seed = 1; seed <= 30; ++seed) {
    SCOPED_TRACE(seed);
    test::Draw draw(seed);
    GridMesh whole = test::grid_stair(5'040'000);
    for (std::uint32_t t = 0; t < whole.triangles.size(); ++t) whole.faces.push_back(t / 2);
    if (seed % 2 == 0) {
      whole.triangles.resize(whole.triangles.size() - 4);
      whole.faces.resize(whole.triangles.size());
    }
    GridMesh mesh = whole;
    test::split_sides(mesh, 60, draw);
    expect_same_lines(whole, mesh);
  }
}

}  // namespace
}  // namespace strake
