// SPDX-License-Identifier: Apache-2.0
// Pairs of the kinds that plants and buildings are made of, whose depth is hard to find: pipes in
// insulation, crossing profiles, pipes in line, fine convex bodies, springs.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "strake/geometry/vec.hpp"
#include "support/part_builder.hpp"

namespace strake::test {

enum class DeepKind : std::uint8_t {
  insulation,
  sections,
  in_line,
  round_convex,
  springs,
  slivers
};
inline constexpr int kDeepKinds = 6;
[[nodiscard]] const char* name(DeepKind kind);

/// A closed body; millimetres.
struct DeepBody {
  std::vector<geometry::Vec3d> points;
  std::vector<geometry::Triangle> triangles;
};

struct DeepPair {
  DeepBody a, b;
  std::string recipe;           ///< for the message of a failing test
  std::optional<double> depth;  ///< millimetres, where a closed form says it
};

/// The same pair for the same seed.
[[nodiscard]] DeepPair draw_deep_pair(DeepKind kind, std::uint64_t seed);

/// Both of a pair turned together by some rotation.
[[nodiscard]] DeepPair turned_together(const DeepPair& pair, std::uint64_t seed);

/// In grid units.
[[nodiscard]] testing::IndexedMesh snapped(const DeepBody& body);

/// A depth by definition of two bodies in grid units: what is deepest among many points of both,
/// each moved uphill by random steps. No more than the supremum, and seldom less.
[[nodiscard]] double sampled_depth(const testing::IndexedMesh& a, const testing::IndexedMesh& b,
                                   std::uint64_t seed, int starts);

}  // namespace strake::test
