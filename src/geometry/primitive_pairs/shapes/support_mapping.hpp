// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cmath>
#include <limits>
#include <span>
#include <variant>

#include "geometry/numeric/trig.hpp"
#include "strake/geometry/support_tree.hpp"
#include "strake/geometry/vec.hpp"

namespace strake::geometry::primitive_pairs {

/// Convex point sets given by their support mapping: the point of the set farthest along a
/// direction, computed from + - * / and sqrt alone. All coordinates are grid units about the pair's
/// origin. The affine image of such a set is one again, so a shear or an uneven scale costs
/// nothing.

inline double norm(const Vec3d& v) { return std::sqrt(dot(v, v)); }

/// The rectangle centre ± u ± v, or the ellipse with these conjugate half diameters.
struct CrossSection {
  Vec3d centre, u, v;
};

/// The convex hull of two sections: boxes and pyramids, or cylinders and snouts.
struct Prismoid {
  CrossSection bottom, top;
  bool round = false;
};

/// The unit ball's cap at or above `floor` on the third axis, mapped to centre + x, y, z.
struct EllipsoidCap {
  Vec3d centre, x, y, z;
  double floor = -1;
  double rim = 0;  ///< radius of the unit sphere's cut: sqrt(1 - floor²)
};

/// A section in (distance from the axis, height), at or beyond the axis.
struct Profile {
  bool round = false;
  double centre = 0, radius = 0;                 ///< round: a disc, clipped at the axis
  double pole = 0;                               ///< height at which the disc then meets the axis
  double inner = 0, outer = 0, half_height = 0;  ///< otherwise a rectangle
};

/// The convex hull of a profile swept about the third axis through an arc of at most half a turn.
struct ArcSweep {
  Vec3d centre, x, y, z;
  SinCos from, to;
  Profile profile;
};

struct TriangleShape {
  std::array<Vec3d, 3> corner;
};

/// An axis-aligned box; a point when it has no size.
struct BoxShape {
  Vec3d centre, half;
};

/// The convex hull of vertices, which are given relative to `origin`.
struct VertexHull {
  std::span<const Vec3i> vertices;
  const SupportTree* tree = nullptr;  ///< over them; empty where they are few
  Vec3d origin;
};

using SupportShape =
    std::variant<Prismoid, EllipsoidCap, ArcSweep, TriangleShape, BoxShape, VertexHull>;

namespace detail {

inline Vec3d support(const CrossSection& s, bool round, const Vec3d& n) {
  const double p = dot(n, s.u), q = dot(n, s.v);
  if (!round) return s.centre + (p < 0 ? -s.u : s.u) + (q < 0 ? -s.v : s.v);
  const double length = std::sqrt(p * p + q * q);
  if (!(length > 0)) return s.centre;
  return s.centre + s.u * (p / length) + s.v * (q / length);
}

inline Vec3d support(const Prismoid& s, const Vec3d& n) {
  const Vec3d low = support(s.bottom, s.round, n), high = support(s.top, s.round, n);
  return dot(n, low) > dot(n, high) ? low : high;
}

inline Vec3d support(const EllipsoidCap& s, const Vec3d& n) {
  const Vec3d m{dot(n, s.x), dot(n, s.y), dot(n, s.z)};
  const double length = norm(m);
  if (length > 0 && m.z >= s.floor * length) {
    const double f = 1 / length;
    return s.centre + s.x * (m.x * f) + s.y * (m.y * f) + s.z * (m.z * f);
  }
  const double across = std::sqrt(m.x * m.x + m.y * m.y);
  const double f = across > 0 ? s.rim / across : 0;
  return s.centre + s.x * (m.x * f) + s.y * (m.y * f) + s.z * s.floor;
}

struct ProfileSupport {
  double radius = 0, z = 0;
};

inline ProfileSupport support(const Profile& p, double out, double up) {
  if (!p.round) return {out < 0 ? p.inner : p.outer, up < 0 ? -p.half_height : p.half_height};
  const double length = std::sqrt(out * out + up * up);
  if (!(length > 0)) return {p.centre, 0};
  const double radius = p.centre + p.radius * (out / length);
  if (radius < 0) return {0, up < 0 ? -p.pole : p.pole};
  return {radius, p.radius * (up / length)};
}

inline Vec3d support(const ArcSweep& s, const Vec3d& n) {
  const Vec3d m{dot(n, s.x), dot(n, s.y), dot(n, s.z)};
  const double across = std::sqrt(m.x * m.x + m.y * m.y);
  // The profile lies on one side of the axis, so it reaches farthest where its plane points most
  // towards the direction: there, or else at the nearer end of the arc.
  const bool within = across > 0 && s.from.cos * m.y - s.from.sin * m.x >= 0 &&
                      m.x * s.to.sin - m.y * s.to.cos >= 0;
  SinCos at;
  double out = across;
  if (within) {
    at = {m.y / across, m.x / across};
  } else {
    const double first = m.x * s.from.cos + m.y * s.from.sin;
    const double last = m.x * s.to.cos + m.y * s.to.sin;
    at = first >= last ? s.from : s.to;
    out = first >= last ? first : last;
  }
  const ProfileSupport p = support(s.profile, out, m.z);
  return s.centre + s.x * (p.radius * at.cos) + s.y * (p.radius * at.sin) + s.z * p.z;
}

inline Vec3d support(const TriangleShape& s, const Vec3d& n) {
  const double a = dot(n, s.corner[0]), b = dot(n, s.corner[1]), c = dot(n, s.corner[2]);
  if (a >= b && a >= c) return s.corner[0];
  return b >= c ? s.corner[1] : s.corner[2];
}

inline Vec3d support(const BoxShape& s, const Vec3d& n) {
  return {s.centre.x + (n.x < 0 ? -s.half.x : s.half.x),
          s.centre.y + (n.y < 0 ? -s.half.y : s.half.y),
          s.centre.z + (n.z < 0 ? -s.half.z : s.half.z)};
}

inline Vec3d support(const VertexHull& s, const Vec3d& n) {
  if (!s.tree->empty()) return s.tree->support_along(n).vertex.as<double>() + s.origin;
  Vec3d farthest;
  double largest = -std::numeric_limits<double>::infinity();
  for (const Vec3i& v : s.vertices) {
    const Vec3d p = v.as<double>();
    if (const double along = dot(n, p); along > largest) {
      largest = along;
      farthest = p;
    }
  }
  return farthest + s.origin;
}

}  // namespace detail

/// Returns a point of the set farthest along a direction, which need not be of unit length.
[[nodiscard]] inline Vec3d support(const SupportShape& shape, const Vec3d& n) {
  return std::visit([&](const auto& s) { return detail::support(s, n); }, shape);
}

/// A convex set, and what is known about it beyond its support.
struct ConvexBody {
  SupportShape shape;
  Vec3d middle;       ///< some point in it
  double radius = 0;  ///< no point of it lies farther from the middle
  double reach = 0;   ///< no coordinate that the arithmetic passes through is larger
  /// Bound on the distance of the computed set from the intended one, including a support's own
  /// rounding.
  double error = 0;
  bool flat = false;  ///< without thickness
};

/// Relative rounding error from a coordinate to a support, with a wide margin.
inline constexpr double kSupportRounding = 128 * std::numeric_limits<double>::epsilon();

}  // namespace strake::geometry::primitive_pairs
