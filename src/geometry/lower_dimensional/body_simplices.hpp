// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <limits>
#include <span>
#include <vector>

#include "geometry/numeric/vector_math.hpp"
#include "geometry/primitive_pairs/solvers/primitive_operand.hpp"
#include "strake/geometry/closest.hpp"
#include "strake/geometry/lower_dimensional_body.hpp"

namespace strake::geometry::lower_dimensional {

/// A point, segment or triangle about some origin.
struct BodySimplex {
  std::array<Vec3l, 3> corner;
  std::size_t count = 1;
  Box3d box;

  [[nodiscard]] std::span<const Vec3l> corners() const { return {corner.data(), count}; }
  /// Returns the simplex as a flat convex body: the last corner is repeated.
  [[nodiscard]] primitive_pairs::PrimitiveOperand side() const {
    std::array<Vec3d, 3> c;
    for (std::size_t i = 0; i < 3; ++i) c[i] = corner[std::min(i, count - 1)].as<double>();
    return primitive_pairs::PrimitiveOperand::of(primitive_pairs::triangle_body(c));
  }
};

struct BodySimplices {
  std::vector<BodySimplex> simplices;
  std::vector<primitive_pairs::PrimitiveOperand> arcs;

  BodySimplices(const LowerDimensionalBody& body, const Vec3l& about) {
    const Vec3l shift = body.origin - about;
    const auto at = [&](std::uint32_t v) { return body.vertices[v].as<std::int64_t>() + shift; };
    const auto add = [&](std::initializer_list<std::uint32_t> vertices) {
      BodySimplex piece;
      piece.count = 0;
      piece.box = empty_box<double>();
      for (const std::uint32_t v : vertices) {
        piece.corner[piece.count++] = at(v);
        piece.box.include(at(v).as<double>());
      }
      simplices.push_back(piece);
    };
    for (const std::uint32_t p : body.points) add({p});
    for (const auto& s : body.segments) add({s[0], s[1]});
    for (const Triangle& t : body.triangles) add({t[0], t[1], t[2]});
    for (const CircularArc& arc : body.arcs)
      if (const auto line = primitive_pairs::Torus::of(arc, about))
        arcs.push_back(primitive_pairs::PrimitiveOperand::of(*line));
  }
};

/// The minimum of exact squared distances; the first among equals.
class ExactMinDistance {
 public:
  /// Whether a squared distance is certainly above the minimum: a margin covers the rounding of
  /// squares.
  [[nodiscard]] bool beyond(double squared) const { return squared > reach_; }
  [[nodiscard]] bool touching() const { return any_ && best_.squared.zero(); }

  void offer(std::span<const Vec3l> a, std::span<const Vec3l> b) {
    const ClosestPoints c = closest_points(a, b);
    if (any_ && !(c.squared < best_.squared)) return;
    any_ = true;
    best_ = c;
    const double d = c.squared.distance();
    reach_ = d * d * (1 + 1e-12);
  }
  [[nodiscard]] bool any() const { return any_; }
  [[nodiscard]] const ClosestPoints& best() const { return best_; }

 private:
  bool any_ = false;
  ClosestPoints best_;
  double reach_ = std::numeric_limits<double>::infinity();
};

/// The minimum of several distances, each within a bracket.
struct MinDistanceBracket {
  double lower = std::numeric_limits<double>::infinity(), upper = lower;
  Vec3d on_a, on_b;

  void add(double low, double high, const Vec3d& p, const Vec3d& q) {
    lower = std::min(lower, low);
    if (!(high < upper)) return;
    upper = high;
    on_a = p;
    on_b = q;
  }
  void add(const ExactMinDistance& exact) {
    if (!exact.any()) return;
    // The root of a rational, rounded.
    constexpr double kRounding = 0x1p-52;
    const double d = exact.best().squared.distance();
    add(d * (1 - kRounding), d * (1 + kRounding), exact.best().on_a.value(),
        exact.best().on_b.value());
  }
};

}  // namespace strake::geometry::lower_dimensional
