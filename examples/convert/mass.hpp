// SPDX-License-Identifier: Apache-2.0
// Volume, first and second moments of closed meshes with integer coordinates, exactly: integers
// have no rounding, so no order of additions can show in a sum.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "model.hpp"
#include "same_bytes.hpp"
#include "strake/core/result.hpp"
#include "strake/parallel/context.hpp"

namespace convert {

__extension__ typedef __int128 Int128;

/// Sums over triangles. A triangle and the origin span a tetrahedron of signed volume; those of a
/// closed mesh add up to the body. With coordinates below 2^17 in magnitude (kReach) the largest
/// term is below 2^92, so 2^35 triangles fit.
struct Sums {
  Int128 volume_6 = 0;                  ///< six times the volume, mm³
  std::array<Int128, 3> moment_24{};    ///< 24 times the integrals of x, y, z, mm⁴
  std::array<Int128, 6> second_120{};   ///< 120 times those of xx, yy, zz, yz, zx, xy, mm⁵
  std::array<Int128, 3> area_vector{};  ///< zero for a closed mesh; twice mm²

  void add(const Point& a, const Point& b, const Point& c);
  void add(const Sums& other);
  [[nodiscard]] bool is_closed() const { return area_vector == std::array<Int128, 3>{}; }
};

struct Masses {
  std::vector<Sums> of_part;
  std::vector<std::uint32_t> open;  ///< parts that are not closed: left out of the total
  Sums total;
};

inline bool same_bytes(const Masses& a, const Masses& b) {
  return same_bytes(a.of_part, b.of_part) && same_bytes(a.open, b.open) &&
         same_bytes(std::vector<Sums>{a.total}, std::vector<Sums>{b.total});
}

/// A decimal number.
std::string text(Int128 value);

namespace before {
Masses masses(const Model& model);
}  // namespace before

namespace after {
strake::Result<Masses> masses(const Model& model, const strake::parallel::Context& context);
}  // namespace after

}  // namespace convert
