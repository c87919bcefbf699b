// SPDX-License-Identifier: Apache-2.0
// Exact parameters on an edge, the intervals that polygons hide, and the sweep that turns them into
// states.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "hlr/occluders/projected_shape.hpp"
#include "strake/geometry/vec.hpp"
#include "strake/geometry/wide_int.hpp"
#include "strake/hlr/hlr.hpp"

namespace strake::hlr {

/// Returns the nearest double. Most values fit 64 bits, which convert far faster.
[[nodiscard]] inline double rounded(geometry::Int128 x) {
  const auto low = static_cast<std::int64_t>(x);
  return low == x ? static_cast<double>(low) : static_cast<double>(x);
}

/// An exact parameter in [0, 1] on an edge, num / den (den > 0, not reduced), with its double.
struct RationalParam {
  geometry::Int128 num = 0, den = 1;
  double value = 0;

  [[nodiscard]] static RationalParam of(geometry::Int128 num, geometry::Int128 den) {
    return {num, den, rounded(num) / rounded(den)};
  }
  [[nodiscard]] static RationalParam zero() { return {}; }
  [[nodiscard]] static RationalParam one() { return {1, 1, 1}; }
};

/// Returns whether a denominator, and with it the numerator, fits 63 bits: then products fit 126.
[[nodiscard]] inline bool fits_64_bits(geometry::Int128 den) {
  return static_cast<std::int64_t>(den) == den;
}

/// Returns -1, 0 or 1, exactly. Each double is off by at most 3.1·2^-53, so a difference of 2^-50
/// decides.
[[nodiscard]] inline int compare(const RationalParam& x, const RationalParam& y) {
  constexpr double kCertain = 8.9e-16;
  const double difference = x.value - y.value;
  if (difference > kCertain) return 1;
  if (difference < -kCertain) return -1;
  if (x.num == y.num && x.den == y.den) return 0;
  // Most ends are those of edges and equal for that reason.
  if (x.num == 0 || y.num == 0) return x.num != 0 ? 1 : y.num != 0 ? -1 : 0;
  const auto order = [](const auto& left, const auto& right) {
    return left < right ? -1 : right < left ? 1 : 0;
  };
  if (fits_64_bits(x.den) && fits_64_bits(y.den)) return order(x.num * y.den, y.num * x.den);
  return order(geometry::mul(x.num, y.den), geometry::mul(y.num, x.den));
}
[[nodiscard]] inline bool less(const RationalParam& x, const RationalParam& y) {
  return compare(x, y) < 0;
}

/// Returns floor(delta·t + 1/2), exactly: the same for every fraction that stands for the same t.
[[nodiscard]] inline std::int64_t rounded_offset(std::int64_t delta, const RationalParam& t) {
  const double guess = t.value * static_cast<double>(delta) + 0.5;
  const double margin = std::fabs(static_cast<double>(delta)) * 1e-15 + 1e-9;
  const double low = std::floor(guess - margin);
  if (low == std::floor(guess + margin)) return static_cast<std::int64_t>(low);
  // k is right when (2k - 1)·den <= 2·delta·num < (2k + 1)·den.
  auto k = static_cast<std::int64_t>(low);
  const auto twice = geometry::mul(geometry::Int128{2} * delta, t.num);
  while (!(twice < geometry::mul(geometry::Int128{2} * k + 1, t.den))) ++k;
  return k;
}

/// Grid units, in the measure of a contact distance. An edge of a part whose ends are no deeper
/// than this under the plane of one of its faces lies in that plane, as both were rounded.
inline constexpr std::int64_t kLyingInPlane = 2;

enum EdgeSide : std::uint8_t { kLeft = 1, kRight = 2, kBothSides = 3 };

/// An interval of an edge that something hides, on one side of the edge or on both.
struct OcclusionInterval {
  RationalParam lo, hi;
  std::uint8_t sides = 0;
  bool self = false;
};

/// An edge in the coordinates of the shape that may hide it.
struct LocalEdge {
  geometry::Vec3l a, b;
  ViewPoint va, vb;                         ///< orthographic
  ViewBox box;                              ///< see open_box(); in perspective, of the drawn part
  std::int64_t nearest = 0;                 ///< the greater product of an end with the direction
  const geometry::Box3l* limits = nullptr;  ///< limits in the same coordinates; null where none cut
  bool narrow = false;  ///< 64-bit integers suffice for orientations of this edge and shape
};

/// Returns whether orientations of points within ±reach can be formed in 64 bits.
[[nodiscard]] constexpr bool fits_narrow(std::int64_t reach) {
  return reach < (std::int64_t{1} << 29);
}

/// Returns the closed interval of the edge that a polygon hides, by the two-sided rule: where
/// points a hair left or right of the edge lie strictly under its open inside, deeper than
/// `contact` in the sense of docs/hlr.md. Nothing for an edge of which neither end is deeper than
/// `lying`: it lies in the polygon's plane. Exact. Requires may_be_hidden_by(edge, polygon.box).
[[nodiscard]] std::optional<OcclusionInterval> occluded_by_polygon(const LocalEdge& edge,
                                                                   const ProjectedShape& shape,
                                                                   const OccluderPolygon& polygon,
                                                                   std::int64_t contact,
                                                                   std::int64_t lying);

/// Returns the interval of an edge that lies under an outline (OccluderPart::outline), for an edge
/// deep under it.
[[nodiscard]] std::optional<OcclusionInterval> clip_to_outline(const LocalEdge& edge,
                                                               const ProjectedShape& shape,
                                                               const OccluderPolygon& outline);

/// Returns false when the boxes alone show that nothing in `box` hides any of the edge.
[[nodiscard]] inline bool may_be_hidden_by(const LocalEdge& e, const ViewBox& box) {
  return e.box.hi.u >= box.lo.u && e.box.lo.u <= box.hi.u && e.box.hi.v >= box.lo.v &&
         e.box.lo.v <= box.hi.v && e.box.lo.w < box.hi.w;
}

/// A part of an edge.
struct ParamRange {
  RationalParam lo = RationalParam::zero(), hi = RationalParam::one();

  [[nodiscard]] bool empty() const { return !less(lo, hi); }
};

/// The part of an edge that is still undecided: everything outside it is hidden on both sides. What
/// hides one side alone, as a plate of which the outline runs along the edge, counts for that side.
class OpenRange {
 public:
  OpenRange() = default;
  OpenRange(const RationalParam& lo, const RationalParam& hi)
      : left_{lo, hi}, right_{lo, hi}, hull_{lo, hi} {}

  [[nodiscard]] const RationalParam& lo() const { return hull_.lo; }
  [[nodiscard]] const RationalParam& hi() const { return hull_.hi; }
  [[nodiscard]] bool empty() const { return hull_.empty(); }

  /// Returns whether anything is undecided on one side.
  [[nodiscard]] bool is_open(EdgeSide side) const {
    return side == kLeft ? !left_.empty() : !right_.empty();
  }

  /// Returns what of it lies in a part.
  [[nodiscard]] OpenRange within(const ParamRange& part) const;

  /// Removes what an interval at either end hides; true when that changed a side.
  bool shrink(const OcclusionInterval& interval);
  /// Shrinks by the newest interval and then by those before it, until nothing changes.
  bool shrink_all(std::span<const OcclusionInterval> intervals);

 private:
  void update_hull();

  ParamRange left_, right_;  ///< what is undecided on each side of the edge
  ParamRange hull_;          ///< of both
};

/// An interval of an edge in one state.
struct VisibilityInterval {
  RationalParam lo, hi;
  State state = State::visible;
};

/// Sweeps over the occlusion intervals of an edge.
class IntervalSweep {
 public:
  /// Turns them into the states of docs/hlr.md along [lo, hi]: neighbours differ, none is empty.
  void run(std::span<const OcclusionInterval> intervals, const RationalParam& lo,
           const RationalParam& hi, std::vector<VisibilityInterval>& out);

  /// Appends what intervals of the own object hide together: ascending, none meets another that
  /// hides the same sides.
  void unite(std::span<const OcclusionInterval> intervals, std::vector<OcclusionInterval>& out);

 private:
  struct Event {
    const RationalParam* at = nullptr;
    std::uint8_t sides = 0;
    bool self = false, begins = false;
  };
  void sort_events();
  void count(const Event& event);
  [[nodiscard]] State state() const;

  std::vector<Event> events_;
  std::uint32_t self_[2] = {0, 0}, all_[2] = {0, 0};
};

}  // namespace strake::hlr
