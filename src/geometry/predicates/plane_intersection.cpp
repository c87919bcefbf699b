// SPDX-License-Identifier: Apache-2.0
#include "strake/geometry/plane_intersection.hpp"

#include <array>
#include <cassert>
#include <cstddef>
#include <utility>

#include "geometry/predicates/feature_distance.hpp"
#include "geometry/predicates/line_clip.hpp"
#include "strake/geometry/predicates.hpp"

namespace strake::geometry {
namespace {

/// The largest coordinate of a grid point: kMaxGridMm.
constexpr Int128 kMaxOnGrid = Int128{1} << 50U;

/// The plane normal · (p - on) = 0.
struct NormalPlane {
  Vec3l on;
  Vec3<Int128> normal;

  explicit NormalPlane(const TriangleCorners& t)
      : on(t[0]), normal(cross_exact(t[1] - t[0], t[2] - t[0])) {
    assert(any_axis(normal) >= 0);
  }
  /// Returns how far the plane lies from a grid point along its normal, times the normal's length.
  [[nodiscard]] Int128 offset_from(const Vec3l& p) const {
    return dot(normal, (on - p).as<Int128>());
  }
  [[nodiscard]] bool contains(const RationalPoint& p) const {
    WideInt<5> sum;
    for (int k = 0; k < 3; ++k) {
      const Int192 off = p.numerator[k] - narrow<3>(mul(WideInt<2>(Int128{on[k]}), p.denominator));
      sum = sum + mul(off, WideInt<2>(normal[k]));
    }
    return sum.sign() == 0;
  }
};

/// Returns the axis along which a vector reaches farthest.
int farthest_axis(const Vec3<Int128>& v) {
  int axis = 0;
  for (int k = 1; k < 3; ++k)
    if (feature::magnitude(v[k]) > feature::magnitude(v[axis])) axis = k;
  return axis;
}

/// Returns the line of two planes whose normals have the cross product `direction`, not zero. Along
/// the axis k where that reaches farthest, its point is as far as a's: what is left are two
/// equations, the offset from a's point being (e_k x a.normal) · b's offset / direction_k.
ExactLine line_of_planes(const NormalPlane& a, const NormalPlane& b,
                         const Vec3<Int128>& direction) {
  const int k = farthest_axis(direction);
  Vec3<Int128> axis;
  axis[k] = 1;
  Int128 offset = b.offset_from(a.on), divisor = direction[k];
  if (divisor < 0) {
    offset = -offset;
    divisor = -divisor;
  }
  return {point_along(a.on, cross(axis, a.normal), WideInt<2>(offset), WideInt<2>(divisor)),
          direction};
}

/// Returns what parallel planes have in common.
CommonOfPlanes common_of_parallel(const NormalPlane& a, const NormalPlane& b) {
  return b.offset_from(a.on) == 0 ? CommonOfPlanes::plane : CommonOfPlanes::nothing;
}

using PlaneTriple = std::array<NormalPlane, 3>;

/// Returns the point of three planes whose normals have the determinant `divisor`, not zero.
/// Seen from a point of the first plane that one has no offset, so two of Goldman's terms remain.
WideRationalPoint point_of_planes(const PlaneTriple& p, Int192 divisor) {
  const Vec3l& from = p[0].on;
  const auto term = [&](const NormalPlane& plane, const Vec3<Int128>& across, int k) {
    return mul(plane.offset_from(from), across[k]);
  };
  const Vec3<Int128> across_1 = cross(p[2].normal, p[0].normal),
                     across_2 = cross(p[0].normal, p[1].normal);
  const bool turned = divisor.negative();
  if (turned) divisor = -divisor;
  WideRationalPoint point({}, divisor);
  for (int k = 0; k < 3; ++k) {
    const Int256 moved = term(p[1], across_1, k) + term(p[2], across_2, k);
    point.numerator[k] =
        narrow<4>(mul(WideInt<2>(Int128{from[k]}), divisor)) + (turned ? -moved : moved);
  }
  return point;
}

/// Returns what three planes have in common whose normals lie in one plane.
ThreePlanes common_without_point(const PlaneTriple& p) {
  constexpr std::array<std::array<std::size_t, 3>, 3> kPairsFirst{
      {{0, 1, 2}, {0, 2, 1}, {1, 2, 0}}};
  ThreePlanes r;
  for (const auto& [i, j, third] : kPairsFirst) {
    const Vec3<Int128> direction = cross(p[i].normal, p[j].normal);
    if (any_axis(direction) < 0) continue;
    const ExactLine line = line_of_planes(p[i], p[j], direction);
    if (p[third].contains(line.point)) r = {CommonOfPlanes::line, {}, line};
    return r;
  }
  const bool same = common_of_parallel(p[0], p[1]) == CommonOfPlanes::plane &&
                    common_of_parallel(p[0], p[2]) == CommonOfPlanes::plane;
  if (same) r.common = CommonOfPlanes::plane;
  return r;
}

}  // namespace

TwoPlanes intersect_planes(const TriangleCorners& a, const TriangleCorners& b) {
  const NormalPlane p(a), q(b);
  const Vec3<Int128> direction = cross(p.normal, q.normal);
  if (any_axis(direction) < 0) return {common_of_parallel(p, q), {}};
  return {CommonOfPlanes::line, line_of_planes(p, q, direction)};
}

ThreePlanes intersect_planes(const TriangleCorners& a, const TriangleCorners& b,
                             const TriangleCorners& c) {
  const PlaneTriple p{NormalPlane(a), NormalPlane(b), NormalPlane(c)};
  const Int256 determinant = feature::product(cross(p[0].normal, p[1].normal), p[2].normal);
  if (determinant.sign() == 0) return common_without_point(p);
  return {CommonOfPlanes::point, point_of_planes(p, narrow<3>(determinant)), {}};
}

std::optional<Vec3l> nearest_on_grid(const WideRationalPoint& point) {
  const WideInt<5> largest = mul(WideInt<2>(kMaxOnGrid), point.denominator);
  for (int k = 0; k < 3; ++k) {
    const WideInt<5> at = point.numerator[k];
    if (largest < at || at < -largest) return std::nullopt;
  }
  return point.rounded();
}

}  // namespace strake::geometry
