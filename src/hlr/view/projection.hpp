// SPDX-License-Identifier: Apache-2.0
// Coordinates of a view: its exact projection, viewer, axes and rotations on paper.
#pragma once

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <optional>

#include "geometry/predicates/exact_normal.hpp"
#include "strake/geometry/vec.hpp"
#include "strake/geometry/wide_int.hpp"
#include "strake/hlr/hlr.hpp"

namespace strake::hlr {

/// A projected point: (u, v) on paper, w towards the viewer. It is linear in the model's
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
class ViewProjection {
 public:
  explicit ViewProjection(const geometry::Vec3l& d) : d_(d) {
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

using geometry::along;
using geometry::ExactNormal;
using geometry::Int128;
using geometry::triangle_normal;
using geometry::wide_cross;

[[nodiscard]] constexpr bool is_zero(const ExactNormal& n) {
  return n[0] == 0 && n[1] == 0 && n[2] == 0;
}

/// The viewer of a shape: at infinity in a direction, or at a point in the shape's coordinates.
struct Viewer {
  geometry::Vec3l direction;
  std::optional<geometry::Vec3l> eye = std::nullopt;

  /// Returns a value that is positive where a face with this normal through `on` looks towards the
  /// viewer; with an eye, the height of the eye over its plane. For the normal of one triangle.
  [[nodiscard]] constexpr Int128 facing(const ExactNormal& normal,
                                        const geometry::Vec3l& on) const {
    return along(normal, eye ? *eye - on : direction);
  }
  /// Returns whether facing() is positive, for the sum of any number of normals.
  [[nodiscard]] constexpr bool is_towards(const ExactNormal& normal,
                                          const geometry::Vec3l& on) const {
    if (!eye) return along(normal, direction) > 0;
    const geometry::Vec3l to = *eye - on;
    return geometry::mul(normal[0], to.x) + geometry::mul(normal[1], to.y) +
               geometry::mul(normal[2], to.z) >
           geometry::Int256(0);
  }
  /// Returns whether a segment is a point on paper.
  [[nodiscard]] constexpr bool projects_to_point(const geometry::Vec3l& a,
                                                 const geometry::Vec3l& b) const {
    return is_zero(wide_cross(b - a, eye ? *eye - a : direction));
  }
  /// Returns the viewer in the coordinates of a body that is placed at an offset.
  [[nodiscard]] constexpr Viewer at_offset(const geometry::Vec3l& offset) const {
    return eye ? Viewer{direction, *eye - offset} : *this;
  }
};

/// Unit vectors of a view: to the right and up on paper, and towards the viewer.
struct ViewAxes {
  geometry::Vec3d right, up, toward;
};

/// Returns the axes of a view. Where its upward direction does not show on paper another one is up.
[[nodiscard]] ViewAxes axes_of(const View& view);

/// Returns a direction without common factors.
[[nodiscard]] geometry::Vec3l in_lowest_terms(const geometry::Vec3l& d);

/// A rotation of the paper that turns (c, s) into the first axis and scales by its length. Parts
/// that run askew to the paper's own axes, as pipes do in isometric views, have tight boxes in it.
struct PaperRotation {
  /// The largest |c| and |s|.
  static constexpr std::int64_t kMax = 64;

  std::int64_t c = 1, s = 0;

  [[nodiscard]] bool is_none() const { return s == 0; }
  /// Turns a point within 2^54 on paper.
  [[nodiscard]] ViewPoint operator()(const ViewPoint& p) const {
    return {c * p.u + s * p.v, c * p.v - s * p.u, p.w};
  }
};

}  // namespace strake::hlr
