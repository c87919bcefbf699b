// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "hlr/frame.hpp"

namespace strake::hlr {

/// A frame on paper with an axis along (c, s), and as many times larger as that is long: what runs
/// askew to the paper's own axes, as pipes do in isometric views, has boxes in it that fit.
struct Turn {
  /// Of both components.
  static constexpr std::int64_t kMost = 64;

  std::int64_t c = 1, s = 0;

  [[nodiscard]] bool is_none() const { return s == 0; }
  /// For points within 2^54 on paper.
  [[nodiscard]] ViewPoint operator()(const ViewPoint& p) const {
    return {c * p.u + s * p.v, c * p.v - s * p.u, p.w};
  }
};

}  // namespace strake::hlr
