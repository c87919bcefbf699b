// SPDX-License-Identifier: Apache-2.0
// Which parts come too near to which valves, and how near.
#pragma once

#include <cstdint>
#include <vector>

#include "bounding_box.hpp"
#include "model.hpp"
#include "same_bytes.hpp"
#include "strake/core/result.hpp"
#include "strake/parallel/context.hpp"

namespace convert {

struct TooNear {
  std::uint32_t valve = 0, part = 0;
  double distance = 0;  ///< millimetres
};

struct Clearances {
  std::vector<TooNear> too_near;       ///< by valve, then part
  std::uint64_t triangles_tested = 0;  ///< what it cost
};

inline bool same_bytes(const Clearances& a, const Clearances& b) {
  return same_bytes(a.too_near, b.too_near) && a.triangles_tested == b.triangles_tested;
}

/// Whether a box comes nearer to the valve, along each axis, than its clearance.
bool comes_near(const Box& box, const Valve& valve);

namespace before {
Clearances clearances(const Model& model, const std::vector<Valve>& valves);
}  // namespace before

namespace after {
/// `boxes`: of the parts, see boxes_of.
strake::Result<Clearances> clearances(const Model& model, const std::vector<Box>& boxes,
                                      const std::vector<Valve>& valves,
                                      const strake::parallel::Context& context);
}  // namespace after

}  // namespace convert
