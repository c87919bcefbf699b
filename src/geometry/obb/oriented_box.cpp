// SPDX-License-Identifier: Apache-2.0
#include "geometry/obb/oriented_box.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

#include "geometry/numeric/triangle_math.hpp"
#include "geometry/numeric/vector_math.hpp"

namespace strake::geometry {
namespace {

/// The cosine below which two faces count as perpendicular.
constexpr double kSquare = 0.1;

/// The greatest angle error of slivers, radians: thinner ones have no usable normal.
constexpr double kMaxTilt = 0.25;

/// Returns the mean normal of the slivers that the snap alone may have rotated from one of them:
/// the face's normal, which none of them has. The sliver's own where they are few.
Vec3d mean_of_needles(const Part& part, const Vec3d& normal, double tilt) {
  Vec3d sum;
  std::size_t count = 0;
  for (const Triangle& triangle : part.triangles) {
    const Corners t = corners_of(part, triangle);
    const Vec3d n = normal_of(t);
    const double own = std::min(kMaxTilt, snap_angle_error(t, n));
    if (own <= kSliverAngle || !may_be_one_face(n * (1 / length(n)), own, normal, tilt)) continue;
    sum = sum + n;
    ++count;
  }
  return count < kFewestSlivers ? normal : sum * (1 / length(sum));
}

/// Returns the normal of the largest triangle among those that pass, or of the face whose sliver it
/// is.
template <class Pass>
Vec3d largest_face(const Part& part, Pass&& pass) {
  Vec3d best;
  double largest = 0;
  const Triangle* of = nullptr;
  for (const Triangle& t : part.triangles) {
    const Vec3d n = normal_of(corners_of(part, t));
    const double squared = dot(n, n);
    if (squared > largest && pass(n, squared)) {
      largest = squared;
      best = n;
      of = &t;
    }
  }
  if (of == nullptr) return {};
  const Vec3d normal = best * (1 / std::sqrt(largest));
  const double tilt = std::min(kMaxTilt, snap_angle_error(corners_of(part, *of), best));
  // Small parts have no such faces, and there are too many of them to test.
  if (part.vertices.size() < kManyVertices || tilt <= kSliverAngle) return normal;
  return mean_of_needles(part, normal, tilt);
}

/// Returns the normals of the largest face, of the largest about perpendicular to it, and one
/// perpendicular to both.
std::array<Vec3d, 3> largest_faces(const Part& part) {
  std::array<Vec3d, 3> axis;
  const Vec3d x = largest_face(part, [](const Vec3d&, double) { return true; });
  axis[0] = dot(x, x) > 0 ? x : Vec3d{1, 0, 0};
  const Vec3d y = largest_face(part, [&](const Vec3d& n, double squared) {
    const double along = dot(n, axis[0]);
    return along * along < kSquare * kSquare * squared;
  });
  axis[1] = dot(y, y) > 0 ? y : perpendicular_to(axis[0]);
  const Vec3d z = cross(axis[0], axis[1]);
  axis[2] = z * (1 / std::sqrt(dot(z, z)));
  return axis;
}

std::array<Vec3d, 3> at_right_angles(const std::array<Vec3d, 3>& axis) {
  return {axis[0], cross(axis[2], axis[0]), axis[2]};
}

/// `vertices`: those of the part, or empty.
ProjectionInterval range_along(const Part& part, const SupportTree& vertices, const Vec3d& n) {
  if (!vertices.empty())
    return {-vertices.support_along(-n).value, vertices.support_along(n).value};
  ProjectionInterval r;
  for (const Vec3i& v : part.vertices) r.include(dot(n, v.as<double>()));
  return r;
}

double magnitude(const Box3i& box) {
  double sum = 0;
  for (int k = 0; k < 3; ++k)
    sum += std::max(std::fabs(static_cast<double>(box.lo[k])),
                    std::fabs(static_cast<double>(box.hi[k])));
  return sum;
}

/// One of two parts in the other's frame.
struct FaceBeside {
  const PartWithObb& of;
  const PartWithObb& other;
  Vec3d shift;          ///< takes the other's coordinates into those of `of`
  double out = 1;       ///< -1: the normal of the gap goes from the other to `of`
  double rounding = 0;  ///< error bound of the arithmetic of a gap
};

/// Keeps the gap along an axis of the frame, by the extent of the other part along it, where it is
/// wider. Axes are unit vectors but for rounding, so the gap is reduced slightly.
void widen(SeparationBound& widest, const FaceBeside& pair, std::size_t axis, double lo,
           double hi) {
  const OrientedBox& f = *pair.of.frame;
  const double above = lo - f.hi[axis], below = f.lo[axis] - hi;
  const double gap = std::max(above, below);
  const double certain = gap - std::fabs(gap) * 1e-14 - pair.rounding;
  if (!(certain > widest.lower)) return;
  widest = {certain, f.axis[axis] * (above >= below ? pair.out : -pair.out)};
}

/// Widens by the box of the other part.
void widen_by_box(SeparationBound& widest, const FaceBeside& pair) {
  const OrientedBox &f = *pair.of.frame, &g = *pair.other.frame;
  const Vec3d centre = g.centre + pair.shift;
  for (std::size_t i = 0; i < 3; ++i) {
    const double at = dot(f.axis[i], centre);
    double half = 0;
    for (const Vec3d& e : g.edge) half += std::fabs(dot(f.axis[i], e));
    widen(widest, pair, i, at - half, at + half);
  }
}

/// Widens by the vertices of the other part.
void widen_by_vertices(SeparationBound& widest, const FaceBeside& pair, double cutoff) {
  for (std::size_t i = 0; i < 3 && widest.lower < cutoff; ++i) {
    const Vec3d& n = pair.of.frame->axis[i];
    const ProjectionInterval r =
        range_along(*pair.other.placed.part, pair.other.frame->vertices, n);
    const double base = dot(n, pair.shift);
    widen(widest, pair, i, r.lo + base, r.hi + base);
  }
}

}  // namespace

OrientedBox make_oriented_box(const Part& part, const parallel::Context& context) {
  OrientedBox frame;
  if (part.vertices.size() >= kManyVertices) frame.vertices = SupportTree(part.vertices, context);
  frame.axis = largest_faces(part);
  for (std::size_t i = 0; i < 3; ++i) {
    const ProjectionInterval r = range_along(part, frame.vertices, frame.axis[i]);
    frame.lo[i] = r.lo;
    frame.hi[i] = r.hi;
  }
  const std::array<Vec3d, 3> square = orthonormal_axes(frame);
  for (std::size_t i = 0; i < 3; ++i) {
    const ProjectionInterval r = range_along(part, frame.vertices, square[i]);
    frame.centre = frame.centre + square[i] * ((r.lo + r.hi) / 2);
    frame.edge[i] = square[i] * ((r.hi - r.lo) / 2);
  }
  return frame;
}

std::array<Vec3d, 3> orthonormal_axes(const OrientedBox& frame) {
  return at_right_angles(frame.axis);
}

std::array<Vec3d, 3> orthonormal_axes(const Part& part) {
  return at_right_angles(largest_faces(part));
}

SeparationBound oriented_box_separation(const PartWithObb& a, const PartWithObb& b, double cutoff) {
  const Vec3d shift = (b.placed.origin - a.placed.origin).as<double>();
  const double reach = std::fabs(shift.x) + std::fabs(shift.y) + std::fabs(shift.z) +
                       magnitude(a.placed.part->box) + magnitude(b.placed.part->box);
  const double rounding = 16 * std::numeric_limits<double>::epsilon() * reach;
  const FaceBeside from_a{a, b, shift, -1, rounding}, from_b{b, a, -shift, 1, rounding};
  // The boxes' own rounding is far below the fraction of a unit that they must gain.
  SeparationBound boxes;
  for (const FaceBeside* pair : {&from_a, &from_b}) {
    widen_by_box(boxes, *pair);
    if (boxes.lower >= cutoff + 1) return boxes;
  }
  SeparationBound gap;
  for (const FaceBeside* pair : {&from_a, &from_b}) widen_by_vertices(gap, *pair, cutoff);
  return gap;
}

}  // namespace strake::geometry
