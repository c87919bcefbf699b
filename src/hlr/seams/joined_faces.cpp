// SPDX-License-Identifier: Apache-2.0
#include "hlr/seams/joined_faces.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <vector>

#include "geometry/predicates/exact_normal.hpp"
#include "hlr/view/taxicab.hpp"

namespace strake::hlr {
namespace {

using geometry::ExactNormal;
using geometry::Int128;
using geometry::Vec3d;
using geometry::Vec3l;

/// The cosine of a degree.
constexpr double kCosFlat = 0.9998476951563913;

Vec3d in_doubles(const ExactNormal& n) {
  return {static_cast<double>(n[0]), static_cast<double>(n[1]), static_cast<double>(n[2])};
}

/// A face with what decides how it lies.
struct Wing {
  const SeamFace* face = nullptr;
  ExactNormal normal{};
  Vec3d outward;  ///< the normal, rounded
  /// The line's direction times the way from the line to the farthest corner: at right angles to
  /// the face, by the side of the line on which it lies.
  Vec3d arm;
  double reach = 0;  ///< length of the arm
};

/// Returns nothing for a triangle that lies within the contact distance of the line.
std::optional<Wing> wing_of(const geometry::Segment& line, const SeamFace& face) {
  const auto& [p, q, r] = face.corners;
  Wing wing{.face = &face, .normal = geometry::wide_cross(q - p, r - p), .outward = {}, .arm = {}};
  wing.outward = in_doubles(wing.normal);
  const Vec3l along = line[1] - line[0];
  const Int128 room = Int128{face.contact} * taxicab(along);
  bool wide = false;
  for (const Vec3l& corner : face.corners) {
    const ExactNormal off = geometry::wide_cross(along, corner - line[0]);
    wide = wide || std::ranges::any_of(off, [&](Int128 k) { return magnitude(k) > room; });
    const Vec3d arm = in_doubles(off);
    const double reach = std::sqrt(dot(arm, arm));
    if (reach <= wing.reach) continue;
    wing.arm = arm;
    wing.reach = reach;
  }
  return wide ? std::optional(wing) : std::nullopt;
}

bool lie_in_one_plane(const Wing& a, const Wing& b) {
  const Wing& plane = a.reach >= b.reach ? a : b;
  const Wing& other = a.reach >= b.reach ? b : a;
  const Int128 room = std::max(a.face->contact, b.face->contact) * taxicab(plane.normal);
  return std::ranges::all_of(other.face->corners, [&](const Vec3l& corner) {
    return magnitude(geometry::along(plane.normal, corner - plane.face->corners[0])) <= room;
  });
}

/// Returns the cosine of the angle between two faces round the line: 1 on one side of it, in one
/// plane, and -1 on both.
double cosine(const Wing& a, const Wing& b) { return dot(a.arm, b.arm) / (a.reach * b.reach); }

bool touch(const Wing& a, const Wing& b) {
  return a.face->surface != b.face->surface && a.face->solid && b.face->solid &&
         cosine(a, b) >= kCosFlat && dot(a.outward, b.outward) < 0 && lie_in_one_plane(a, b);
}

bool go_on(const Wing& a, const Wing& b) {
  return a.face->solid == b.face->solid && cosine(a, b) <= -kCosFlat &&
         (!a.face->solid || dot(a.outward, b.outward) > 0) && lie_in_one_plane(a, b);
}

}  // namespace

bool join_flat(const geometry::Segment& line, std::span<const SeamFace> faces) {
  std::vector<Wing> rest;
  for (const SeamFace& face : faces) {
    const std::optional<Wing> wing = wing_of(line, face);
    if (!wing) return false;
    const auto partner =
        std::ranges::find_if(rest, [&](const Wing& other) { return touch(other, *wing); });
    if (partner != rest.end())
      rest.erase(partner);
    else
      rest.push_back(*wing);
  }
  return rest.empty() || (rest.size() == 2 && go_on(rest[0], rest[1]));
}

}  // namespace strake::hlr
