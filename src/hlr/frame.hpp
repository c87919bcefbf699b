// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstdint>
#include <cstdlib>

#include "strake/geometry/vec.hpp"

namespace strake::hlr {

/// A place as the view sees it: (u, v) on paper, w towards the viewer. Linear in the model's
/// coordinates and integer, so offsets add and 2D orientations are exact.
struct ViewPoint {
  std::int64_t u = 0, v = 0, w = 0;

  friend constexpr ViewPoint operator+(const ViewPoint& a, const ViewPoint& b) {
    return {a.u + b.u, a.v + b.v, a.w + b.w};
  }
  friend constexpr ViewPoint operator-(const ViewPoint& a, const ViewPoint& b) {
    return {a.u - b.u, a.v - b.v, a.w - b.w};
  }
};

/// A closed box of view coordinates.
struct ViewBox {
  ViewPoint lo{INT64_MAX, INT64_MAX, INT64_MAX}, hi{INT64_MIN, INT64_MIN, INT64_MIN};

  [[nodiscard]] bool empty() const { return lo.u > hi.u; }
  void include(const ViewPoint& p) {
    lo = {std::min(lo.u, p.u), std::min(lo.v, p.v), std::min(lo.w, p.w)};
    hi = {std::max(hi.u, p.u), std::max(hi.v, p.v), std::max(hi.w, p.w)};
  }
  void include(const ViewBox& b) {
    if (b.empty()) return;
    include(b.lo);
    include(b.hi);
  }
  [[nodiscard]] ViewBox moved(const ViewPoint& by) const { return {lo + by, hi + by}; }
};

/// The projection along an integer direction. A model axis k with a large component of d is
/// eliminated: u and v are p_i·d_k - p_k·d_i for the other two, so a model axis stays an axis of
/// paper wherever it can (which keeps boxes tight), and cross(q-p, r-p) = |d_k|·det(q-p, r-p, d).
class Frame {
 public:
  explicit Frame(const geometry::Vec3l& d) : d_(d) {
    for (int k = 0; k < 3; ++k)
      if (std::abs(d[k]) >= std::abs(d[k_])) k_ = k;
    i_ = (k_ + 1) % 3;
    j_ = (k_ + 2) % 3;
    sign_ = d[k_] < 0 ? -1 : 1;
  }

  [[nodiscard]] ViewPoint operator()(const geometry::Vec3l& p) const {
    return {sign_ * (p[i_] * d_[k_] - p[k_] * d_[i_]), p[j_] * d_[k_] - p[k_] * d_[j_],
            geometry::dot(p, d_)};
  }
  [[nodiscard]] const geometry::Vec3l& direction() const { return d_; }

 private:
  geometry::Vec3l d_;
  int i_ = 0, j_ = 1, k_ = 2;
  std::int64_t sign_ = 1;
};

}  // namespace strake::hlr
