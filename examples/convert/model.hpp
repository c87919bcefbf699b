// SPDX-License-Identifier: Apache-2.0
// The model that the conversions work on: closed meshes with integer coordinates, a few giants
// among many small ones. Lengths are millimetres.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace convert {

struct Point {
  std::int32_t x = 0, y = 0, z = 0;
};

struct Part {
  std::vector<Point> points;
  std::vector<std::array<std::uint32_t, 3>> triangles;  ///< counter-clockwise from outside
};

using Model = std::vector<Part>;

/// Coordinates lie within [-kReach, kReach].
inline constexpr std::int32_t kReach = 1 << 17;

/// `small` parts of 12 to 96 triangles, every 97th without any, as broken imports are, and one of
/// them open; among them three giants of about 4·cells², 2·cells² and cells² triangles.
Model make_model(std::size_t small, std::uint32_t cells);

[[nodiscard]] std::size_t triangles_of(const Model& model);

/// A valve needs free space: nothing may come nearer to it than `clearance`.
struct Valve {
  Point at;
  std::int32_t clearance = 0;
};

/// Every fourth of them above one of the giants.
std::vector<Valve> make_valves(std::size_t count);

}  // namespace convert
