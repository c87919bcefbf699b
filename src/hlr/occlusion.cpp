// SPDX-License-Identifier: Apache-2.0
#include "hlr/occlusion.hpp"

namespace strake::hlr {
namespace {

using geometry::Vec3l;

// num / den of an end, in the integer type of the orientations.
template <class T>
struct Ratio {
  T num = 0, den = 1;
};

// x < y for ratios in [0, 1].
inline bool less_ratio(const Ratio<std::int64_t>& x, const Ratio<std::int64_t>& y) {
  return static_cast<Int128>(x.num) * y.den < static_cast<Int128>(y.num) * x.den;
}
inline bool less_ratio(const Ratio<Int128>& x, const Ratio<Int128>& y) {
  return less(Param::of(x.num, x.den), Param::of(y.num, y.den));
}

// Where all orientations of the outline are positive; false when nowhere.
template <class T>
bool clip_outline(const LocalEdge& e, const Corner* corner, std::uint32_t count, Hit& hit) {
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
      hit.sides &= same_way ? kLeft : kRight;
      if (hit.sides == 0) return false;
    } else if (at_a < at_b) {
      const Ratio<T> root{-at_a, at_b - at_a};
      if (at_a < 0 && less_ratio(lo, root)) lo = root;
    } else {
      const Ratio<T> root{at_a, at_a - at_b};
      if (at_b < 0 && less_ratio(root, hi)) hi = root;
    }
  }
  if (!less_ratio(lo, hi)) return false;
  hit.lo = Param::of(lo.num, lo.den);
  hit.hi = Param::of(hi.num, hi.den);
  return true;
}

// Cuts the hit down to where an affine function is positive (closed: or zero throughout).
bool clip_affine(Int128 at_a, Int128 at_b, bool closed, Hit& hit) {
  if (at_a >= 0 && at_b >= 0) return closed || at_a > 0 || at_b > 0;
  if (at_a <= 0 && at_b <= 0) return false;
  if (at_a < at_b) {
    const Param root = Param::of(-at_a, at_b - at_a);
    if (less(hit.lo, root)) hit.lo = root;
  } else {
    const Param root = Param::of(at_a, at_a - at_b);
    if (less(root, hit.hi)) hit.hi = root;
  }
  return less(hit.lo, hit.hi);
}

struct Depth {
  Int128 at_a = 0, at_b = 0;  // normal · (corner - point): positive below the plane
  Int128 size = 0;            // |normal|_1
};

Depth depth_of(const LocalEdge& e, const ShapeView& shape, const Polygon& p) {
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
// everything is integer.
bool clip_limits(const LocalEdge& e, const Depth& depth, Int128 facing, const Vec3l& d, Hit& hit) {
  for (int k = 0; k < 3; ++k) {
    const auto above = [&](const Vec3l& p, Int128 at, std::int64_t limit) {
      return (p[k] - limit) * facing + at * d[k];
    };
    const std::int64_t lo = e.limits->lo[k], hi = e.limits->hi[k];
    if (!clip_affine(above(e.a, depth.at_a, lo), above(e.b, depth.at_b, lo), true, hit) ||
        !clip_affine(-above(e.a, depth.at_a, hi), -above(e.b, depth.at_b, hi), true, hit))
      return false;
  }
  return true;
}

}  // namespace

std::optional<Hit> outlined_stretch(const LocalEdge& edge, const ShapeView& shape,
                                    const Polygon& outline) {
  Hit hit{.lo = Param::zero(), .hi = Param::one(), .sides = kBothSides};
  const Corner* corners = shape.corners.data() + outline.first_corner;
  if (!(edge.narrow ? clip_outline<std::int64_t>(edge, corners, outline.corners, hit)
                    : clip_outline<Int128>(edge, corners, outline.corners, hit)))
    return std::nullopt;
  return hit;
}

std::optional<Hit> hidden_stretch(const LocalEdge& edge, const ShapeView& shape,
                                  const Polygon& polygon, std::int64_t contact) {
  std::optional<Hit> found = outlined_stretch(edge, shape, polygon);
  if (!found) return found;
  Hit& hit = *found;
  const Depth depth = depth_of(edge, shape, polygon);
  const Int128 least = contact * depth.size;
  if (!clip_affine(depth.at_a - least, depth.at_b - least, false, hit)) return std::nullopt;
  if (edge.limits != nullptr) {
    const NormalVector n = shape.normal(polygon);
    if (!clip_limits(edge, depth, along(n, shape.direction), shape.direction, hit))
      return std::nullopt;
  }
  return found;
}

}  // namespace strake::hlr
