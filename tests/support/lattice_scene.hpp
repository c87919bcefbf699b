// SPDX-License-Identifier: Apache-2.0
// Seeded scenes on a tiny lattice, where nearly everything is degenerate: coplanar, touching,
// collinear, T-joined, interpenetrating, doubled.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "strake/geometry/vec.hpp"
#include "strake/hlr/hlr.hpp"
#include "support/scene_builder.hpp"

namespace strake::test {

/// A small generator (splitmix64) that is the same on every machine.
class Random {
 public:
  explicit Random(std::uint64_t seed) : state_(seed) {}
  std::uint64_t next() {
    std::uint64_t z = (state_ += 0x9e3779b97f4a7c15U);
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9U;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebU;
    return z ^ (z >> 31);
  }
  /// In [0, n).
  std::uint32_t below(std::uint32_t n) { return static_cast<std::uint32_t>(next() % n); }
  bool one_in(std::uint32_t n) { return below(n) == 0; }

 private:
  std::uint64_t state_;
};

struct LatticeOptions {
  std::uint32_t objects = 4;
  std::int32_t unit = 1;    ///< grid units per lattice step
  std::uint32_t steps = 3;  ///< coordinates are 0 .. steps lattice steps
  /// Applied to every part when it is made; what is random does not depend on it.
  std::function<void(HandPart&)> edit{};
};

[[nodiscard]] SceneBuilder lattice_scene(std::uint64_t seed, const LatticeOptions& options);

/// Named directions, diagonals and skew ones; any index gives one.
[[nodiscard]] geometry::Vec3l direction_of(std::uint32_t index);
inline constexpr std::uint32_t kDirections = 16;

/// Limits that cut the lattice, now and then with faces on lattice planes; sometimes none.
[[nodiscard]] std::optional<geometry::Box3l> random_limits(Random& random,
                                                           const LatticeOptions& options);

/// A view from a point of the lattice or around it, now and then from afar, at another of its
/// points: most of what is before the eye lies in the window.
[[nodiscard]] hlr::View random_perspective(Random& random, const LatticeOptions& options);

/// A plane that cuts the lattice, often through lattice points and now and then in a lattice plane.
[[nodiscard]] hlr::Section random_section(Random& random, const LatticeOptions& options);

}  // namespace strake::test
