// SPDX-License-Identifier: Apache-2.0
// Seeded pairs of closed bodies for laws and for comparisons with other programs, and what Strake
// says of them.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "strake/clash/clash.hpp"
#include "support/part_builder.hpp"

namespace strake::test {

/// How a pair was placed; what the two then are to each other is for the tests to ask.
enum class Aim : std::uint8_t { separated, touching, crossing, contained };
inline constexpr int kAims = 4;
/// Along the axes, turned by rationals so that every touch stays one, or in general position.
enum class Pose : std::uint8_t { aligned, turned, askew };
inline constexpr int kPoses = 3;

/// Two bodies in one frame, grid units: meshes of lattice cells and tetrahedra, and tessellated
/// primitives of every kind.
struct SolidPair {
  testing::IndexedMesh a, b;
  Aim aim = Aim::separated;
  Pose pose = Pose::aligned;
  std::string recipe;  ///< for the message of a failing test

  /// Largest extent of the two together, mm.
  [[nodiscard]] double size_mm() const;
};
[[nodiscard]] SolidPair draw_solid_pair(std::uint64_t seed);

/// A mesh of grid coordinates in millimetres: the snap takes it back as it was.
[[nodiscard]] geometry::TriangleMesh in_mm(const testing::IndexedMesh& mesh);

/// Touch tolerances of zero, so that class and relation are the exact ones, and no pair is NO_HIT.
[[nodiscard]] clash::Options exact_options();

/// Strake's answer by exact_options(), so that class and relation are the exact ones.
struct StrakeAnswer {
  clash::Class cls = clash::Class::no_hit;
  clash::Relation relation = clash::Relation::separate;
  double d_mm = 0, d_lower_mm = 0, d_upper_mm = 0;
  bool surfaces_meet = false;
  double squared_distance = 0;  ///< of the surfaces, grid units²: the exact rational rounded

  [[nodiscard]] bool nested() const {
    return relation == clash::Relation::a_in_b || relation == clash::Relation::b_in_a;
  }
  [[nodiscard]] double surface_distance_mm() const;
};
/// Nothing where a body is not one solid part: then the relation is that of some part.
[[nodiscard]] std::optional<StrakeAnswer> strake_answer(const SolidPair& pair);

}  // namespace strake::test
