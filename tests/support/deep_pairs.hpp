// SPDX-License-Identifier: Apache-2.0
// Pairs of the kinds that plants and buildings are made of, whose depth is hard to find: pipes in
// insulation, crossing profiles, pipes in line, fine convex bodies, springs.
#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "strake/geometry/depth.hpp"
#include "strake/geometry/part_pair.hpp"
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

/// A pair as the narrow phase requests its depth.
class DeepPairTest {
 public:
  explicit DeepPairTest(const DeepPair& pair);

  /// Whether the two have interior in common.
  [[nodiscard]] bool meets() const { return meets_; }
  /// Of a pair that meets; all is worked out anew.
  [[nodiscard]] geometry::Depth depth() const;

 private:
  testing::Subject a_, b_;
  geometry::FaceKdop of_a_, of_b_;
  geometry::DepthOptions goal_;
  bool meets_ = false;
};

/// How wide the bracket of a depth may be, grid units: 0.05 mm or 1 %.
[[nodiscard]] inline double tolerance(double depth) { return std::max(50.0, 0.01 * depth); }

/// A depth by definition of two bodies in grid units: what is deepest among many points of both,
/// each moved uphill by random steps. No more than the supremum, and seldom less.
[[nodiscard]] double sampled_depth(const testing::IndexedMesh& a, const testing::IndexedMesh& b,
                                   std::uint64_t seed, int starts);

}  // namespace strake::test
