// SPDX-License-Identifier: Apache-2.0
#include "model/scene/instancing.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <set>
#include <utility>
#include <vector>

#include "model/scene/grid_shape.hpp"
#include "support/meshes.hpp"

namespace strake::model {
namespace {

using geometry::TriangleMesh;
using geometry::Vec3d;

GridShape on_grid(TriangleMesh mesh) {
  return GridShapeBuilder().make(Shape(std::move(mesh)), {}, {}).shape;
}

/// A box of which each face is split along the other diagonal where `diagonals` has its bit.
TriangleMesh box_split(const Vec3d& at, unsigned diagonals) {
  TriangleMesh mesh = test::box_mesh(at, at + Vec3d{1, 2, 3});
  for (std::size_t face = 0; face < 6; ++face) {
    if ((diagonals >> face & 1U) == 0) continue;
    // Of (a, b, c) and (a, c, d).
    auto &first = mesh.triangles[2 * face], &second = mesh.triangles[2 * face + 1];
    const std::uint32_t a = first[0], b = first[1], c = first[2], d = second[2];
    first = {a, b, d};
    second = {b, c, d};
  }
  return mesh;
}

TEST(Instancing, HashesAreTheSameWhereverAMeshStands) {
  const std::uint64_t hash = translation_invariant_hash(on_grid(box_split({0, 0, 0}, 5)));
  EXPECT_EQ(translation_invariant_hash(on_grid(box_split({-3e8, 0.001, 7e8}, 5))), hash);
  // A triangle without area is left out, but moves the middle that the vertices are relative to.
  TriangleMesh mesh = box_split({10, 0, 0}, 5);
  mesh.vertices.push_back({1000, 0, 0});
  mesh.triangles.push_back({8, 8, 0});
  const GridShape moved = on_grid(mesh);
  EXPECT_NE(translation_between(on_grid(box_split({10, 0, 0}, 5)), moved), geometry::Vec3l{});
  EXPECT_EQ(translation_invariant_hash(moved), hash);
}

// Otherwise each is compared with all before it: an exporter that splits the faces of a part anew
// at every place makes thousands of them.
TEST(Instancing, HashesDistinguishTrianglesAndSagsOfTheSameVertices) {
  std::set<std::uint64_t> hashes;
  for (const double sag : {0.0, 0.25, 0.5})
    for (unsigned diagonals = 0; diagonals < 64; ++diagonals) {
      TriangleMesh mesh = box_split({1, 2, 3}, diagonals);
      mesh.sag_mm = sag;
      const GridShape shape = on_grid(std::move(mesh));
      ASSERT_EQ(shape.parts.size(), 1U);
      ASSERT_EQ(shape.parts[0].kind, geometry::PartKind::solid);
      hashes.insert(translation_invariant_hash(shape));
    }
  EXPECT_EQ(hashes.size(), 3U * 64U);
}

}  // namespace
}  // namespace strake::model
