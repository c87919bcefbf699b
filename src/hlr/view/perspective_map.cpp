// SPDX-License-Identifier: Apache-2.0
#include "hlr/view/perspective_map.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace strake::hlr {
namespace {

using geometry::Vec3d;
using geometry::Vec3l;

/// The relative error of the products and sums that make a coordinate: a few roundings of 2^-53
/// each.
constexpr double kRounding = 2e-15;
/// A point whose depth is below this fraction of its distance counts as beside the eye, not before
/// it.
constexpr double kGrazing = 1e-6;
/// A point beside the eye must be off its axes by this fraction of its distance for a side to be
/// known: kSideways / kGrazing lies far beyond the rim.
constexpr double kSideways = 1e-3;
constexpr double kSteep = 1e4;

double size_of(const Vec3d& p) {
  return std::max({std::fabs(p.x), std::fabs(p.y), std::fabs(p.z)});
}

std::int64_t grid_below(double x) {
  return static_cast<std::int64_t>(
      std::floor(std::clamp(x, -PerspectiveMap::kPaperLimit, PerspectiveMap::kPaperLimit)));
}
std::int64_t grid_above(double x) {
  return static_cast<std::int64_t>(
      std::ceil(std::clamp(x, -PerspectiveMap::kPaperLimit, PerspectiveMap::kPaperLimit)));
}

struct Range {
  double lo = PerspectiveMap::kPaperLimit, hi = -PerspectiveMap::kPaperLimit;
  void include(double x, double error_bound) {
    lo = std::min(lo, x - error_bound);
    hi = std::max(hi, x + error_bound);
  }
};

/// A corner: x and y along the paper, z before the eye.
struct Ray {
  double x = 0, y = 0, z = 0, size = 0;
};

/// Opens a range to infinity on the side on which the hull of points before and not before the eye
/// passes beside the eye.
void open_towards(double across, double size, Range& range) {
  if (!(across < -kSideways * size)) range.hi = PerspectiveMap::kPaperLimit;
  if (!(across > kSideways * size)) range.lo = -PerspectiveMap::kPaperLimit;
}

}  // namespace

PerspectiveSegment::PerspectiveSegment(const PerspectivePoint& a, const PerspectivePoint& b,
                                       double from, double to)
    : a_(a), b_(b), from_(from), to_(to) {
  const double ratio = std::max(a.depth / b.depth, b.depth / a.depth);
  const double length = std::fabs(b.u - a.u) + std::fabs(b.v - a.v) + std::fabs(b.w - a.w);
  error_bound_ =
      std::max(a.error_bound, b.error_bound) + length * kRounding * (1 + ratio) / (to - from);
}

// At fraction s of the edge x/z is (x0 + s·dx) / (z0 + s·dz).
double PerspectiveSegment::fraction(double t) const {
  const double s = std::clamp((t - from_) / (to_ - from_), 0.0, 1.0);
  const double near_b = s * b_.depth, near_a = (1 - s) * a_.depth;
  return near_b / (near_a + near_b);
}

double PerspectiveSegment::parameter(double fraction) const {
  const double near_b = fraction * a_.depth, near_a = (1 - fraction) * b_.depth;
  return from_ + (to_ - from_) * (near_b / (near_a + near_b));
}

bool PerspectiveSegment::is_steep() const {
  return std::max(a_.depth, b_.depth) > kSteep * std::min(a_.depth, b_.depth) ||
         to_ - from_ < 1 / kSteep;
}

SegmentQuery PerspectiveSegment::make_query(double from, double to) const {
  SegmentQuery s{.au = a_.u, .av = a_.v, .du = b_.u - a_.u, .dv = b_.v - a_.v};
  const double p = fraction(from), q = fraction(to);
  const auto range = [&](double start, double step, double& least, double& largest) {
    const double slack = error_bound_ + 1e-12 * (std::fabs(start) + std::fabs(step));
    least = start + std::min(step * p, step * q) - slack;
    largest = start + std::max(step * p, step * q) + slack;
  };
  double w1 = 0;
  range(a_.u, s.du, s.u0, s.u1);
  range(a_.v, s.dv, s.v0, s.v1);
  range(a_.w, b_.w - a_.w, s.w0, w1);
  s.beside = 2 * error_bound_ * (std::fabs(s.du) + std::fabs(s.dv));
  return s;
}

ViewBox PerspectiveSegment::box() const {
  ViewBox box;
  for (const PerspectivePoint& p : {a_, b_}) {
    box.include(ViewPoint{grid_below(p.u - error_bound_), grid_below(p.v - error_bound_),
                          grid_below(p.w - error_bound_)});
    box.include(ViewPoint{grid_above(p.u + error_bound_), grid_above(p.v + error_bound_),
                          grid_above(p.w + error_bound_)});
  }
  return box;
}

std::optional<PerspectivePoint> PerspectiveMap::at(const Vec3d& p, double size) const {
  const double x = dot(axes_.right, p), y = dot(axes_.up, p), z = -dot(axes_.toward, p);
  if (!(z > kGrazing * size_of(p)) || !(z > 1e-9 * size)) return std::nullopt;
  const double scale = kUnit / z, u = x * scale, v = y * scale;
  const double w = nearest_ * scale;
  const double fraction = kRounding * size / z;
  return PerspectivePoint{u, v, w, z,
                          1 + fraction * (kUnit + std::fabs(u) + std::fabs(v) + std::fabs(w))};
}

std::optional<PerspectivePoint> PerspectiveMap::at(const Vec3l& p) const {
  const auto d = p.as<double>();
  return at(d, size_of(d));
}

std::optional<PerspectiveSegment> PerspectiveMap::segment(const Vec3l& a, const Vec3l& b,
                                                          double from, double to) const {
  const auto p = a.as<double>(), q = b.as<double>();
  const double size = size_of(p) + size_of(q);
  if (!(from < to)) return std::nullopt;
  const auto first = at(p + (q - p) * from, size), last = at(p + (q - p) * to, size);
  if (!first || !last) return std::nullopt;
  return PerspectiveSegment(*first, *last, from, to);
}

ViewBox PerspectiveMap::box_of(std::span<const Vec3l> corners) const {
  Range u, v, w;
  std::vector<Ray> before, beside;
  for (const Vec3l& corner : corners) {
    const auto p = corner.as<double>();
    if (const auto mapped = at(corner)) {
      u.include(mapped->u, mapped->error_bound);
      v.include(mapped->v, mapped->error_bound);
      w.include(mapped->w, mapped->error_bound);
    }
    const Ray ray{dot(axes_.right, p), dot(axes_.up, p), -dot(axes_.toward, p), size_of(p)};
    (ray.z > kGrazing * ray.size ? before : beside).push_back(ray);
  }
  const bool all_behind = before.empty() && std::ranges::all_of(beside, [](const Ray& r) {
                            return r.z < -kGrazing * r.size;
                          });
  if (corners.empty() || all_behind) return {};
  if (before.empty()) {
    u = v = w = {-kPaperLimit, kPaperLimit};
  } else if (!beside.empty()) {
    for (const Ray& i : before)
      for (const Ray& j : beside) {
        const double behind = std::max(0.0, -j.z);
        const double size = i.z * j.size + behind * i.size;
        open_towards(i.z * j.x + behind * i.x, size, u);
        open_towards(i.z * j.y + behind * i.y, size, v);
      }
    // For points nearly beside the eye the signs above say little.
    if (std::ranges::any_of(beside, [](const Ray& r) { return r.z >= -kGrazing * r.size; }))
      for (const Ray& j : beside) {
        open_towards(j.x, j.size, u);
        open_towards(j.y, j.size, v);
      }
    w.hi = kPaperLimit;
  }
  return {{grid_below(u.lo), grid_below(v.lo), grid_below(w.lo)},
          {grid_above(u.hi), grid_above(v.hi), grid_above(w.hi)}};
}

}  // namespace strake::hlr
