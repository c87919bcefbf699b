// SPDX-License-Identifier: Apache-2.0
#include "geometry/depth/cell_skin.hpp"

#include <algorithm>
#include <cstddef>
#include <limits>

#include "geometry/box.hpp"

namespace strake::geometry {
namespace {

/// Triangles near a simplex beyond which its skin is not looked at: too large a simplex.
constexpr std::size_t kMostNear = 96;

/// The cosine of normals that count as one.
constexpr double kSameNormal = 1 - 1e-9;

using Points = std::array<Vec3d, 4>;

/// The outward planes of a simplex's faces; none for a face without area.
std::vector<HalfSpace> faces_of(const Points& corners) {
  std::vector<HalfSpace> faces;
  for (std::size_t i = 0; i < 4; ++i) {
    const Vec3d &p = corners[(i + 1) % 4], &q = corners[(i + 2) % 4], &r = corners[(i + 3) % 4];
    Vec3d n = cross(q - p, r - p);
    const double size = length(n);
    if (!(size > 0)) continue;
    n = n * ((dot(n, corners[i] - p) > 0 ? -1 : 1) / size);
    faces.push_back({n, dot(n, p)});
  }
  return faces;
}

}  // namespace

std::optional<HalfSpace> plane_of(const DepthField& field, std::uint32_t triangle) {
  const PreparedTriangle t = field.triangle(triangle);
  if (!(t.size > 0)) return std::nullopt;
  return HalfSpace{t.unit, dot(t.unit, field.common(t.corners[0]))};
}

bool on_one_side(std::span<const Vec3d> points, const HalfSpace& plane, double by) {
  double lowest = std::numeric_limits<double>::infinity(), highest = -lowest;
  for (const Vec3d& p : points) {
    const double height = dot(plane.normal, p) - plane.offset;
    lowest = std::min(lowest, height);
    highest = std::max(highest, height);
  }
  return lowest > by || highest < -by;
}

std::optional<std::vector<std::uint32_t>> triangles_in(const DepthField& field, const Box3d& box) {
  std::vector<std::uint32_t> found, stack;
  const Box3d local{field.local(box.lo), field.local(box.hi)};
  const auto& nodes = field.tree().nodes();
  if (!nodes.empty()) stack.push_back(0);
  while (!stack.empty()) {
    const PartTree::Node& node = nodes[stack.back()];
    stack.pop_back();
    if (!node.box.as<double>().meets(local)) continue;
    if (node.count == 0) {
      stack.push_back(node.first);
      stack.push_back(node.first + 1);
      continue;
    }
    for (std::uint32_t i = node.first; i < node.first + node.count; ++i) {
      const std::uint32_t t = field.tree().order()[i];
      if (!box_of(field.placed(t)).meets(box)) continue;
      if (found.size() == kMostNear) return std::nullopt;
      found.push_back(t);
    }
  }
  return found;
}

Skin::Skin(const DepthField& field, const Simplex& s, double slack)
    : field_(field),
      slack_(slack),
      corners_{s.corner[0].at, s.corner[1].at, s.corner[2].at, s.corner[3].at},
      faces_(faces_of(corners_)) {
  const auto in_box = triangles_in(field, box_of(corners_).inflated(2 * slack));
  complete_ = in_box.has_value();
  if (!complete_) return;
  for (const std::uint32_t t : *in_box)
    if (const Corners c = field.placed(t); !apart(t, c)) near_.push_back({t, c});
}

std::vector<HalfSpace> Skin::cuts(std::span<const Vec3d> outside) const {
  std::vector<HalfSpace> planes;
  if (!complete_) return planes;
  for (const Near& near : near_) {
    const auto plane = cut(near.triangle, outside);
    const auto same = [&](const HalfSpace& h) {
      return dot(h.normal, plane->normal) > kSameNormal;
    };
    if (plane && std::none_of(planes.begin(), planes.end(), same)) planes.push_back(*plane);
  }
  return planes;
}

/// Above the plane of a triangle the simplex is convex: without skin there, all of it is where one
/// point of it is.
std::optional<HalfSpace> Skin::cut(std::uint32_t triangle, std::span<const Vec3d> outside) const {
  const auto own = plane_of(field_, triangle);
  if (!own) return std::nullopt;
  const auto some_above = [&](double offset) {
    return std::any_of(outside.begin(), outside.end(),
                       [&](const Vec3d& p) { return dot(own->normal, p) > offset; });
  };
  if (!some_above(own->offset)) return std::nullopt;
  double top = own->offset;
  for (const Near& near : near_) {
    for (const Vec3d& p : near.corners) top = std::max(top, dot(own->normal, p));
    if (top > own->offset + kSnapLift) return std::nullopt;
  }
  top += slack_;
  return some_above(top) ? std::optional(HalfSpace{own->normal, top}) : std::nullopt;
}

/// A face of the simplex has all of the triangle beyond it, or the other way round.
bool Skin::apart(std::uint32_t triangle) const { return apart(triangle, field_.placed(triangle)); }

bool Skin::apart(std::uint32_t triangle, const Corners& c) const {
  const bool beyond = std::any_of(faces_.begin(), faces_.end(), [&](const HalfSpace& f) {
    return std::all_of(c.begin(), c.end(),
                       [&](const Vec3d& p) { return dot(f.normal, p) > f.offset + 2 * slack_; });
  });
  if (beyond) return true;
  const auto plane = plane_of(field_, triangle);
  return plane && on_one_side(corners_, *plane, 2 * slack_);
}

}  // namespace strake::geometry
