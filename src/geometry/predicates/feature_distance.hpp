// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>

#include "strake/geometry/grid_shapes.hpp"
#include "strake/geometry/predicates.hpp"
#include "strake/geometry/rational.hpp"
#include "strake/geometry/vec.hpp"
#include "strake/geometry/wide_int.hpp"

namespace strake::geometry {

/// The exact distance of two features, with the positions of their nearest points.
struct FeatureDistance {
  SquaredDistance squared;
  /// The direction of the distance, where it is short enough (else zero), and the width along it.
  Vec3<Int128> direction{};
  Int128 width = 0;
  /// Parameters of the nearest points along the edges, over the distance's denominator; for a face,
  /// the offset of the other's point along its normal (vertex_face: `direction`).
  Int256 at_a, at_b;
};

/// Exact tests of a pair of features, a's first; each is false when the nearest points of the
/// features' lines or planes do not lie strictly inside the features.
namespace feature {

[[nodiscard]] constexpr Int256 product(const Vec3<Int128>& u, const Vec3<Int128>& v) {
  return mul(u.x, v.x) + mul(u.y, v.y) + mul(u.z, v.z);
}
[[nodiscard]] constexpr Int256 norm(const Vec3<Int128>& v) { return product(v, v); }
[[nodiscard]] constexpr Int128 magnitude(Int128 v) { return v < 0 ? -v : v; }

[[nodiscard]] inline FeatureDistance vertex_vertex(const Vec3l& p, const Vec3l& q) {
  const Vec3<Int128> d = (q - p).as<Int128>();
  return {{Int256(dot(d, d)), Int192(Int128{1})}, d, dot(d, d), {}, {}};
}

/// Whether the coordinates of two vectors are so small that the component of the one perpendicular
/// to the other can be multiplied with any difference of vertices of a pair: 2^87 · 3 · 2^32.
[[nodiscard]] constexpr bool both_short(const Vec3l& d, const Vec3l& e) {
  constexpr std::int64_t kShort = std::int64_t{1} << 28;
  for (int k = 0; k < 3; ++k)
    if (d[k] > kShort || d[k] < -kShort || e[k] > kShort || e[k] < -kShort) return false;
  return true;
}

[[nodiscard]] inline bool vertex_edge(const Vec3l& p, const Vec3l& from, const Vec3l& to,
                                      FeatureDistance& r) {
  const Vec3l e = to - from, d = p - from;
  const Int128 along = dot(e.as<Int128>(), d.as<Int128>());
  const Int128 length = dot(e.as<Int128>(), e.as<Int128>());
  if (along <= 0 || along >= length) return false;
  r = {{norm(cross_exact(d, e)), Int192(length)}, {}, 0, {}, Int256(along)};
  if (both_short(d, e)) {
    r.direction = d.as<Int128>() * length - e.as<Int128>() * along;
    r.width = dot(r.direction, d.as<Int128>());
  }
  return true;
}

[[nodiscard]] inline bool vertex_face(const Vec3l& p, const TriangleCorners& t,
                                      FeatureDistance& r) {
  const Vec3<Int128> n = cross_exact(t[1] - t[0], t[2] - t[0]);
  for (std::size_t i = 0; i < 3; ++i)
    if (product(cross_exact(t[i == 2 ? 0 : i + 1] - t[i], p - t[i]), n).sign() <= 0) return false;
  const Int128 height = dot(n, (p - t[0]).as<Int128>());
  r = {{mul(height, height), narrow<3>(norm(n))}, n, magnitude(height), {}, Int256(height)};
  return true;
}

[[nodiscard]] inline bool edge_edge(const Vec3l& p, const Vec3l& to_p, const Vec3l& q,
                                    const Vec3l& to_q, FeatureDistance& r) {
  const Vec3l e = to_p - p, f = to_q - q, d = q - p;
  const Vec3<Int128> c = cross_exact(e, f);
  const Int256 length = norm(c);
  if (length.sign() == 0) return false;
  const Int256 s = product(cross_exact(d, f), c), t = product(cross_exact(d, e), c);
  if (s.sign() <= 0 || t.sign() <= 0 || s >= length || t >= length) return false;
  const Int128 height = dot(c, d.as<Int128>());
  r = {{mul(height, height), narrow<3>(length)}, c, magnitude(height), s, t};
  return true;
}

/// Whether an edge pierces a face from one side to the other.
[[nodiscard]] inline bool edge_face(const Vec3l& from, const Vec3l& to, const TriangleCorners& t,
                                    FeatureDistance& r) {
  const Vec3<Int128> n = cross_exact(t[1] - t[0], t[2] - t[0]);
  const Int128 before = dot(n, (from - t[0]).as<Int128>());
  const Int128 after = dot(n, (to - t[0]).as<Int128>());
  if (before == 0 || after == 0 || (before < 0) == (after < 0)) return false;
  const int facing = before > 0 ? -1 : 1;
  for (std::size_t i = 0; i < 3; ++i)
    if (orient3d(from, to, t[i], t[i == 2 ? 0 : i + 1]) != facing) return false;
  const Int128 whole = magnitude(before) + magnitude(after);
  r = {{Int256{}, Int192(whole)}, {}, 0, Int256(magnitude(before)), {}};
  return true;
}

}  // namespace feature
}  // namespace strake::geometry
