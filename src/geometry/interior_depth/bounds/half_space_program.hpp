// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <vector>

#include "geometry/interior_depth/bounds/inscribed_ball.hpp"
#include "geometry/interior_depth/surface_distance/distance_field.hpp"

namespace strake::geometry {

/// Linear programs over the half-spaces of both parts about a centre in their common box.
class HalfSpaceProgram {
 public:
  HalfSpaceProgram(const DepthOperand& a, const DistanceField& fa, const DepthOperand& b,
                   const DistanceField& fb, const std::optional<Box3d>& within)
      : a_(a), b_(b), fa_(fa), fb_(fb), within_(within) {
    const Box3d x = fa.box(), y = fb.box(), search_box = within.value_or(x);
    for (int k = 0; k < 3; ++k) {
      const double lo = std::max({x.lo[k], y.lo[k], search_box.lo[k]});
      const double hi = std::min({x.hi[k], y.hi[k], search_box.hi[k]});
      centre_[k] = std::nearbyint((lo + hi) / 2);
      extent_ = std::max({extent_, x.hi[k] - x.lo[k], y.hi[k] - y.lo[k]});
    }
    extent_ += 1;
  }

  [[nodiscard]] const Vec3d& centre() const { return centre_; }
  [[nodiscard]] double extent() const { return extent_; }

  /// Returns the largest ball in one part's half-spaces (a's where `ball_is_a`) with its centre in
  /// the other's. The result's x is relative to the common origin.
  [[nodiscard]] InscribedBall largest_ball(bool ball_is_a) const {
    std::vector<BallConstraint> rows;
    start(rows, ball_is_a ? a_ : b_, ball_is_a ? fa_ : fb_, 0);
    stay_within(rows);
    append(rows, a_, fa_, ball_is_a ? 1 : 0, 0);
    append(rows, b_, fb_, ball_is_a ? 0 : 1, 0);
    // A body that is not convex may face the other with none of its own planes: the other's planes,
    // reversed, then stand for its faces against them, whichever body holds the ball.
    if (!a_.planes->nearly_convex) append_opposite(rows, a_, b_, fa_, ball_is_a ? 1 : 0);
    if (!b_.planes->nearly_convex) append_opposite(rows, b_, a_, fb_, ball_is_a ? 0 : 1);
    return solve(rows);
  }

  /// Returns the point farthest from both boundaries among those at least `depth` deep in one body.
  [[nodiscard]] InscribedBall centre_of_deepest_ball(bool deep_in_a, double depth) const {
    std::vector<BallConstraint> rows = deep_rows(deep_in_a, depth);
    append(rows, a_, fa_, 1, 0);
    append(rows, b_, fb_, 1, 0);
    return solve(rows);
  }

  /// Returns the same where all points so deep lie on the other's surface, as between walls with
  /// parallel faces: then only the boundaries that they can be away from count.
  [[nodiscard]] InscribedBall centre_on_surface(bool deep_in_a, double depth) const {
    std::vector<BallConstraint> rows = deep_rows(deep_in_a, depth);
    const std::vector<Vec3d> across = surface_normals(deep_in_a, depth);
    append_beside(rows, a_, fa_, across);
    append_beside(rows, b_, fb_, across);
    return solve(rows);
  }

  /// Returns the centre of the points of the intersection that are about as deep in one body as
  /// `from`.
  [[nodiscard]] Vec3d centre_of_deep_points(const Vec3d& from, bool deep_in_a, double depth) const {
    std::vector<BallConstraint> rows = deep_rows(deep_in_a, depth);
    append(rows, deep_in_a ? b_ : a_, deep_in_a ? fb_ : fa_, 0, 0);
    if (!a_.planes->nearly_convex) append_opposite(rows, a_, b_, fa_, 0);
    if (!b_.planes->nearly_convex) append_opposite(rows, b_, a_, fb_, 0);
    for (BallConstraint& row : rows) row.offset -= dot(row.normal, from - centre_);
    return from + to_chebyshev_centre(rows, extent_);
  }

 private:
  [[nodiscard]] std::vector<BallConstraint> deep_rows(bool deep_in_a, double depth) const {
    std::vector<BallConstraint> rows;
    start(rows, a_, fa_, 0);
    stay_within(rows);
    append(rows, deep_in_a ? a_ : b_, deep_in_a ? fa_ : fb_, 0, depth);
    return rows;
  }

  static bool parallel(const Vec3d& n, const Vec3d& m) {
    constexpr double kSquare = 1e-9;
    const Vec3d c = cross(n, m);
    return dot(c, c) < kSquare;
  }

  /// Returns the normals of the one body's planes that lie `depth` inside a reversed plane of the
  /// other.
  [[nodiscard]] std::vector<Vec3d> surface_normals(bool deep_in_a, double depth) const {
    constexpr double kWidth = 4;
    const DepthOperand &ball = deep_in_a ? a_ : b_, &container = deep_in_a ? b_ : a_;
    const DistanceField &f = deep_in_a ? fa_ : fb_, &g = deep_in_a ? fb_ : fa_;
    std::vector<Vec3d> normals;
    for (const FaceKdop::Plane& p : ball.planes->planes)
      for (const FaceKdop::Plane& q : container.planes->planes)
        if (dot(p.normal, q.normal) < 0 && parallel(p.normal, q.normal) &&
            offset(f, p.normal, p.support) + offset(g, q.normal, q.support) < depth + kWidth)
          normals.push_back(p.normal);
    return normals;
  }

  /// Appends planes that a point may be away from; those along the given normals only contain it.
  void append_beside(std::vector<BallConstraint>& rows, const DepthOperand& part,
                     const DistanceField& f, const std::vector<Vec3d>& across) const {
    for (const FaceKdop::Plane& p : part.planes->planes) {
      const bool held =
          std::ranges::any_of(across, [&](const Vec3d& n) { return parallel(n, p.normal); });
      rows.push_back({p.normal, held ? 0.0 : 1.0, offset(f, p.normal, p.support)});
    }
  }

  [[nodiscard]] InscribedBall solve(const std::vector<BallConstraint>& rows) const {
    InscribedBall s = largest_inscribed_ball({rows, extent_});
    s.x = s.x + centre_;
    return s;
  }

  [[nodiscard]] double offset(const DistanceField& f, const Vec3d& n, double support) const {
    const Vec3d c = f.local(centre_);
    const double reach = std::fabs(c.x) + std::fabs(c.y) + std::fabs(c.z);
    return support - dot(n, c) + 8 * std::numeric_limits<double>::epsilon() * reach;
  }

  void start(std::vector<BallConstraint>& rows, const DepthOperand& part, const DistanceField& f,
             double inset) const {
    rows.reserve(4 + 2 * (a_.planes->planes.size() + b_.planes->planes.size()));
    for (std::size_t i = 0; i < 4; ++i) {
      const Vec3d& n = tetrahedral_directions()[i];
      rows.push_back({n, 1, offset(f, n, part.planes->tetrahedral[i]) - inset});
    }
  }

  /// Keeps the centre in the box that counts.
  void stay_within(std::vector<BallConstraint>& rows) const {
    if (!within_) return;
    for (int k = 0; k < 3; ++k) {
      Vec3d n;
      n[k] = 1;
      rows.push_back({n, 0, within_->hi[k] - centre_[k]});
      rows.push_back({-n, 0, centre_[k] - within_->lo[k]});
    }
  }

  void append(std::vector<BallConstraint>& rows, const DepthOperand& part, const DistanceField& f,
              double weight, double inset) const {
    for (const FaceKdop::Plane& p : part.planes->planes)
      rows.push_back({p.normal, weight, offset(f, p.normal, p.support) - inset});
  }

  void append_opposite(std::vector<BallConstraint>& rows, const DepthOperand& part,
                       const DepthOperand& other, const DistanceField& f, double weight) const {
    for (const FaceKdop::Plane& p : other.planes->planes) {
      const Vec3d n = -p.normal;
      const double best = part.planes->vertices.support_along(n).value;
      rows.push_back({n, weight, offset(f, n, best) + kFieldError * extent_});
    }
  }

  const DepthOperand &a_, &b_;
  const DistanceField &fa_, &fb_;
  const std::optional<Box3d>& within_;
  Vec3d centre_;
  double extent_ = 0;
};

}  // namespace strake::geometry
