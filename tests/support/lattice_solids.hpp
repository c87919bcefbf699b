// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <random>
#include <string>
#include <vector>

#include "support/part_builder.hpp"

namespace strake::testing {

using Tetrahedron = std::array<geometry::Vec3i, 4>;

/// A body known twice over: as an outward surface, and as tetrahedra with disjoint interiors.
struct LatticeSolid {
  IndexedMesh mesh;
  std::vector<Tetrahedron> pieces;
};

struct LatticePair {
  LatticeSolid a, b;
  std::string recipe;  ///< how it was made, for the message of a failing test
};

/// An integer affine map x -> (row_i · x) + offset_i.
struct LatticeMap {
  std::array<geometry::Vec3i, 3> row{geometry::Vec3i{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  geometry::Vec3i offset;

  [[nodiscard]] geometry::Vec3i operator()(const geometry::Vec3i& p) const;
  /// Sign of the determinant: -1 mirrors, 0 flattens.
  [[nodiscard]] int orientation() const;
};

/// The image of a body; a mirroring map keeps it outward.
[[nodiscard]] LatticeSolid mapped(const LatticeSolid& solid, const LatticeMap& map);
[[nodiscard]] IndexedMesh mapped(const IndexedMesh& mesh, const LatticeMap& map);

/// One of the 48 symmetries of the axes, 0..47.
[[nodiscard]] LatticeMap axis_symmetry(int index);

/// The surface of a set of tetrahedra that meet face to face.
[[nodiscard]] IndexedMesh surface_of(const std::vector<Tetrahedron>& pieces);

/// Two bodies on a small lattice in a seeded random relation: boxes, tetrahedra, notched and hollow
/// blocks, clusters of tetrahedra; touching, nested, equal, fitted into each other.
[[nodiscard]] LatticePair random_pair(std::mt19937_64& rng);

/// A random open surface of lattice triangles, without overlaps of its own.
[[nodiscard]] IndexedMesh random_sheet(std::mt19937_64& rng);

/// Each triangle split into four; every coordinate must be even.
[[nodiscard]] IndexedMesh subdivided(const IndexedMesh& mesh);

/// The same triangles in another order, corners rotated, vertices renumbered.
[[nodiscard]] IndexedMesh shuffled(const IndexedMesh& mesh, std::mt19937_64& rng);

}  // namespace strake::testing
