// SPDX-License-Identifier: Apache-2.0
// The interval of an edge that a polygon or an outline hides, and the sweep over all of them.
#include "hlr/visibility/visibility_intervals.hpp"

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

namespace strake::hlr {
namespace {

using geometry::Vec3d;
using geometry::Vec3l;

// The parameter num / den of an end, in the integer type of the orientations.
template <class T>
struct Ratio {
  T num = 0, den = 1;
};

// Returns x < y for ratios in [0, 1].
inline bool less_ratio(const Ratio<std::int64_t>& x, const Ratio<std::int64_t>& y) {
  return static_cast<Int128>(x.num) * y.den < static_cast<Int128>(y.num) * x.den;
}
inline bool less_ratio(const Ratio<Int128>& x, const Ratio<Int128>& y) {
  return less(RationalParam::of(x.num, x.den), RationalParam::of(y.num, y.den));
}

// Finds the interval where all orientations of the outline are positive; false when there is none.
template <class T>
bool clip_outline(const LocalEdge& e, const PaperCorner* corner, std::uint32_t count,
                  OcclusionInterval& interval) {
  const T au = static_cast<T>(e.va.u), av = static_cast<T>(e.va.v);
  const T bu = static_cast<T>(e.vb.u), bv = static_cast<T>(e.vb.v);
  Ratio<T> lo{0, 1}, hi{1, 1};
  T pu = static_cast<T>(corner[count - 1].u), pv = static_cast<T>(corner[count - 1].v);
  for (std::uint32_t i = 0; i < count; ++i) {
    const T qu = static_cast<T>(corner[i].u), qv = static_cast<T>(corner[i].v);
    const T su = qu - pu, sv = qv - pv;
    const T at_a = su * (av - pv) - sv * (au - pu);
    const T at_b = su * (bv - pv) - sv * (bu - pu);
    pu = qu;
    pv = qv;
    if (at_a > 0 && at_b > 0) continue;
    if (at_a <= 0 && at_b <= 0) {
      if (at_a != 0 || at_b != 0) return false;
      // The edge runs along the outline: the inside lies on the left of either.
      const bool same_way = su * (bu - au) + sv * (bv - av) > 0;
      interval.sides &= same_way ? kLeft : kRight;
      if (interval.sides == 0) return false;
    } else if (at_a < at_b) {
      const Ratio<T> root{-at_a, at_b - at_a};
      if (at_a < 0 && less_ratio(lo, root)) lo = root;
    } else {
      const Ratio<T> root{at_a, at_a - at_b};
      if (at_b < 0 && less_ratio(root, hi)) hi = root;
    }
  }
  if (!less_ratio(lo, hi)) return false;
  interval.lo = RationalParam::of(lo.num, lo.den);
  interval.hi = RationalParam::of(hi.num, hi.den);
  return true;
}

// A value in doubles, with a bound of its error.
struct Rough {
  double value = 0, error = 0;

  [[nodiscard]] bool surely_positive() const { return value > error; }
  [[nodiscard]] bool surely_negative() const { return value < -error; }
};

// Returns -det(q, r, p). Each product is rounded a few times, by 2^-53 of its size.
Rough rough_turn(const Vec3d& q, const Vec3d& r, const Vec3d& p) {
  const auto size = [](const Vec3d& v) { return std::fabs(v.x) + std::fabs(v.y) + std::fabs(v.z); };
  return {-dot(cross(q, r), p), 1e-15 * size(q) * size(r) * size(p)};
}

// Clips by the cone from the eye through the corners; all is relative to the eye. The turn of a
// point, -det(q, r, p), is linear in the point, and so affine along the edge.
bool clip_cone(const Vec3l& a, const Vec3l& b, std::span<const Vec3l> corner,
               OcclusionInterval& interval) {
  const auto da = a.as<double>(), db = b.as<double>();
  RationalParam lo = RationalParam::zero(), hi = RationalParam::one();
  Vec3l q = corner.back();
  for (const Vec3l& r : corner) {
    const Vec3l p = std::exchange(q, r);
    const Rough near_a = rough_turn(p.as<double>(), r.as<double>(), da);
    const Rough near_b = rough_turn(p.as<double>(), r.as<double>(), db);
    if (near_a.surely_positive() && near_b.surely_positive()) continue;
    if (near_a.surely_negative() && near_b.surely_negative()) return false;
    const ExactNormal side = wide_cross(p, r);
    const Int128 at_a = -along(side, a), at_b = -along(side, b);
    if (at_a > 0 && at_b > 0) continue;
    if (at_a <= 0 && at_b <= 0) {
      if (at_a != 0 || at_b != 0) return false;
      // The edge runs along the outline: the inside lies on the left of either.
      const ExactNormal own = wide_cross(a, b);
      const std::size_t k = own[0] != 0 ? 0 : own[1] != 0 ? 1 : 2;
      interval.sides &= (side[k] > 0) == (own[k] > 0) ? kLeft : kRight;
      if (interval.sides == 0) return false;
    } else if (at_a < at_b) {
      const RationalParam root = RationalParam::of(-at_a, at_b - at_a);
      if (at_a < 0 && less(lo, root)) lo = root;
    } else {
      const RationalParam root = RationalParam::of(at_a, at_a - at_b);
      if (at_b < 0 && less(root, hi)) hi = root;
    }
  }
  interval.lo = lo;
  interval.hi = hi;
  return less(lo, hi);
}

// Clips the interval to where an affine function is positive (closed: or zero throughout).
bool clip_affine(Int128 at_a, Int128 at_b, bool closed, OcclusionInterval& interval) {
  if (at_a >= 0 && at_b >= 0) return closed || at_a > 0 || at_b > 0;
  if (at_a <= 0 && at_b <= 0) return false;
  if (at_a < at_b) {
    const RationalParam root = RationalParam::of(-at_a, at_b - at_a);
    if (less(interval.lo, root)) interval.lo = root;
  } else {
    const RationalParam root = RationalParam::of(at_a, at_a - at_b);
    if (less(root, interval.hi)) interval.hi = root;
  }
  return less(interval.lo, interval.hi);
}

struct Depth {
  Int128 at_a = 0, at_b = 0;  // normal · (corner - point): positive below the plane
  Int128 size = 0;            // |normal|_1
};

Depth depth_of(const LocalEdge& e, const ProjectedShape& shape, const OccluderPolygon& p) {
  const Vec3l at = p.at.as<std::int64_t>();
  const Vec3l a = at - e.a, b = at - e.b;
  const auto magnitude = [](auto x) { return x < 0 ? -x : x; };
  const auto fill = [&](const auto& n) {
    Depth d;
    for (int k = 0; k < 3; ++k) {
      const auto& c = n[static_cast<std::size_t>(k)];
      d.at_a += static_cast<Int128>(c) * a[k];
      d.at_b += static_cast<Int128>(c) * b[k];
      d.size += magnitude(c);
    }
    return d;
  };
  return p.wide < 0 ? fill(p.normal) : fill(shape.wide_normals[static_cast<std::size_t>(p.wide)]);
}

// A hiding point outside the limits does not hide. It is p + (depth / facing)·d; times `facing`
// everything is integer. With an eye at e it is p + (depth / (facing + depth))·(e - p), and its
// distance from a limit, times that positive sum, is again affine.
bool clip_limits(const LocalEdge& e, const Depth& depth, Int128 facing, const Viewer& viewer,
                 OcclusionInterval& interval) {
  for (int k = 0; k < 3; ++k) {
    const auto above = [&](const Vec3l& p, Int128 at, std::int64_t limit) {
      const std::int64_t way = viewer.eye ? (*viewer.eye)[k] - limit : viewer.direction[k];
      return (p[k] - limit) * facing + at * way;
    };
    const std::int64_t lo = e.limits->lo[k], hi = e.limits->hi[k];
    if (!clip_affine(above(e.a, depth.at_a, lo), above(e.b, depth.at_b, lo), true, interval) ||
        !clip_affine(-above(e.a, depth.at_a, hi), -above(e.b, depth.at_b, hi), true, interval))
      return false;
  }
  return true;
}

}  // namespace

std::optional<OcclusionInterval> clip_to_outline(const LocalEdge& edge, const ProjectedShape& shape,
                                                 const OccluderPolygon& outline) {
  OcclusionInterval interval{
      .lo = RationalParam::zero(), .hi = RationalParam::one(), .sides = kBothSides};
  if (shape.viewer.eye) {
    const Vec3l& eye = *shape.viewer.eye;
    const auto rays = std::span(shape.rays).subspan(outline.first_corner, outline.corners);
    if (!clip_cone(edge.a - eye, edge.b - eye, rays, interval)) return std::nullopt;
    return interval;
  }
  const PaperCorner* corners = shape.corners.data() + outline.first_corner;
  if (!(edge.narrow ? clip_outline<std::int64_t>(edge, corners, outline.corners, interval)
                    : clip_outline<Int128>(edge, corners, outline.corners, interval)))
    return std::nullopt;
  return interval;
}

std::optional<OcclusionInterval> occluded_by_polygon(const LocalEdge& edge,
                                                     const ProjectedShape& shape,
                                                     const OccluderPolygon& polygon,
                                                     std::int64_t contact, std::int64_t lying) {
  // The plane is tested first: it costs less than the outline, and half of all edges lie above it.
  const Depth depth = depth_of(edge, shape, polygon);
  const Int128 least = contact * depth.size;
  const Int128 beside = std::max(least, lying * depth.size);
  if (depth.at_a <= beside && depth.at_b <= beside) return std::nullopt;
  std::optional<OcclusionInterval> found = clip_to_outline(edge, shape, polygon);
  if (!found) return found;
  OcclusionInterval& interval = *found;
  if (!clip_affine(depth.at_a - least, depth.at_b - least, false, interval)) return std::nullopt;
  if (edge.limits != nullptr) {
    const Int128 facing = shape.viewer.facing(shape.normal(polygon), polygon.at.as<std::int64_t>());
    if (!clip_limits(edge, depth, facing, shape.viewer, interval)) return std::nullopt;
  }
  return found;
}

namespace {

// With more intervals than this, going through them all for each new one would cost more than it
// saves.
constexpr std::size_t kScanBack = 48;

void append(std::vector<VisibilityInterval>& out, std::size_t first, const RationalParam& lo,
            const RationalParam& hi, State state) {
  if (out.size() > first && out.back().state == state)
    out.back().hi = hi;
  else
    out.push_back({lo, hi, state});
}

// Removes an interval at either end of a range; true when that changed the range.
bool shrink_range(const OcclusionInterval& interval, ParamRange& range) {
  bool changed = false;
  if (!less(range.lo, interval.lo) && less(range.lo, interval.hi)) {
    range.lo = interval.hi;
    changed = true;
  }
  if (!less(interval.hi, range.hi) && less(interval.lo, range.hi)) {
    range.hi = interval.lo;
    changed = true;
  }
  return changed;
}

// Returns what two ranges have in common.
ParamRange common(const ParamRange& x, const ParamRange& y) {
  return {less(x.lo, y.lo) ? y.lo : x.lo, less(x.hi, y.hi) ? x.hi : y.hi};
}

}  // namespace

bool OpenRange::shrink(const OcclusionInterval& interval) {
  bool changed = false;
  if ((interval.sides & kLeft) != 0 && !left_.empty()) changed = shrink_range(interval, left_);
  if ((interval.sides & kRight) != 0 && !right_.empty())
    changed = shrink_range(interval, right_) || changed;
  if (changed) update_hull();
  return changed;
}

OpenRange OpenRange::within(const ParamRange& part) const {
  OpenRange open;
  open.left_ = common(left_, part);
  open.right_ = common(right_, part);
  open.update_hull();
  return open;
}

void OpenRange::update_hull() {
  if (left_.empty()) {
    hull_ = right_;
  } else if (right_.empty()) {
    hull_ = left_;
  } else {
    hull_.lo = less(left_.lo, right_.lo) ? left_.lo : right_.lo;
    hull_.hi = less(left_.hi, right_.hi) ? right_.hi : left_.hi;
  }
}

bool OpenRange::shrink_all(std::span<const OcclusionInterval> intervals) {
  if (intervals.empty() || !shrink(intervals.back())) return false;
  if (intervals.size() > kScanBack) intervals = intervals.last(kScanBack);
  for (bool again = true; again && !empty();) {
    again = false;
    for (const OcclusionInterval& interval : intervals) again = shrink(interval) || again;
  }
  return true;
}

void IntervalSweep::sort_events() {
  // Ends at one parameter may come in any order: nothing lies between them.
  std::sort(events_.begin(), events_.end(),
            [](const Event& x, const Event& y) { return less(*x.at, *y.at); });
}

void IntervalSweep::count(const Event& event) {
  for (unsigned side = 0; side < 2; ++side) {
    if ((event.sides >> side & 1U) == 0) continue;
    if (event.begins) {
      ++all_[side];
      if (event.self) ++self_[side];
    } else {
      --all_[side];
      if (event.self) --self_[side];
    }
  }
}

State IntervalSweep::state() const {
  if (self_[0] > 0 && self_[1] > 0) return State::hidden_by_self;
  return all_[0] > 0 && all_[1] > 0 ? State::hidden_by_other : State::visible;
}

void IntervalSweep::run(std::span<const OcclusionInterval> intervals, const RationalParam& lo,
                        const RationalParam& hi, std::vector<VisibilityInterval>& out) {
  const std::size_t first = out.size();
  bool hidden = false;  // all of it is hidden, by others at least
  for (const OcclusionInterval& interval : intervals) {
    if (interval.sides != kBothSides || less(lo, interval.lo) || less(interval.hi, hi)) continue;
    if (interval.self) return append(out, first, lo, hi, State::hidden_by_self);
    hidden = true;
  }
  for (unsigned side = 0; side < 2; ++side) {
    self_[side] = 0;
    all_[side] = hidden ? 1 : 0;
  }
  events_.clear();
  for (const OcclusionInterval& interval : intervals) {
    if (hidden && !interval.self) continue;  // what else hides it does not matter
    events_.push_back({&interval.lo, interval.sides, interval.self, true});
    events_.push_back({&interval.hi, interval.sides, interval.self, false});
  }
  sort_events();
  const RationalParam* from = &lo;
  for (const Event& event : events_) {
    if (!less(*event.at, hi)) break;
    if (less(*from, *event.at)) {
      append(out, first, *from, *event.at, state());
      from = event.at;
    }
    count(event);
  }
  append(out, first, *from, hi, state());
}

void IntervalSweep::unite(std::span<const OcclusionInterval> intervals,
                          std::vector<OcclusionInterval>& out) {
  events_.clear();
  for (unsigned side = 0; side < 2; ++side) self_[side] = all_[side] = 0;
  for (const OcclusionInterval& interval : intervals) {
    events_.push_back({&interval.lo, interval.sides, true, true});
    events_.push_back({&interval.hi, interval.sides, true, false});
  }
  sort_events();
  const std::size_t first = out.size();
  const RationalParam* from = nullptr;
  for (const Event& event : events_) {
    const auto sides =
        static_cast<std::uint8_t>((self_[0] > 0 ? kLeft : 0) | (self_[1] > 0 ? kRight : 0));
    if (sides != 0 && less(*from, *event.at)) {
      if (out.size() > first && out.back().sides == sides && !less(out.back().hi, *from))
        out.back().hi = *event.at;
      else
        out.push_back({*from, *event.at, sides, true});
    }
    from = event.at;
    count(event);
  }
}

}  // namespace strake::hlr
