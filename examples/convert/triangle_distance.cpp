// SPDX-License-Identifier: Apache-2.0
#include "triangle_distance.hpp"

#include <algorithm>

namespace convert {
namespace {

Offset operator-(const Offset& a, const Offset& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }

double dot(const Offset& a, const Offset& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }

Offset cross(const Offset& a, const Offset& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

double to_edge(const Offset& a, const Offset& b) {
  const Offset along = b - a;
  const double length = dot(along, along);
  const double t = length > 0 ? std::clamp(-dot(a, along) / length, 0.0, 1.0) : 0.0;
  const Offset nearest{a.x + t * along.x, a.y + t * along.y, a.z + t * along.z};
  return dot(nearest, nearest);
}

}  // namespace

double squared_distance(const Offset& a, const Offset& b, const Offset& c) {
  const Offset normal = cross(b - a, c - a);
  // The foot of the perpendicular is inside when it is on the inner side of all three edges.
  const bool inside =
      dot(cross(a, b), normal) > 0 && dot(cross(b, c), normal) > 0 && dot(cross(c, a), normal) > 0;
  if (inside) {
    const double height = dot(a, normal);
    return height * height / dot(normal, normal);
  }
  return std::min({to_edge(a, b), to_edge(b, c), to_edge(c, a)});
}

}  // namespace convert
