// SPDX-License-Identifier: Apache-2.0
#include "support/sheet_crossing_path.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <map>
#include <utility>

namespace strake::test {
namespace {

using geometry::Triangle;
using geometry::TriangleMesh;
using geometry::Vec3d;

using Corners = std::array<Vec3d, 3>;

double length(const Vec3d& v) { return std::sqrt(dot(v, v)); }
double clamped(double t) { return std::clamp(t, 0.0, 1.0); }

double distance(const Vec3d& p, const PathSegment& s) {
  const Vec3d along = s[1] - s[0];
  const double t = clamped(dot(p - s[0], along) / dot(along, along));
  return length(p - (s[0] + along * t));
}

/// Of two segments: that of ends, or of the two lines where these are nearest within both.
double distance(const PathSegment& s, const PathSegment& t) {
  double least =
      std::min({distance(s[0], t), distance(s[1], t), distance(t[0], s), distance(t[1], s)});
  const Vec3d d = s[1] - s[0], e = t[1] - t[0], r = s[0] - t[0], n = cross(d, e);
  const double nn = dot(n, n);
  if (!(nn > 0)) return least;
  const double u = dot(cross(e, r), n) / nn, v = dot(cross(d, r), n) / nn;
  if (u >= 0 && u <= 1 && v >= 0 && v <= 1)
    least = std::min(least, std::fabs(dot(r, n)) / std::sqrt(nn));
  return least;
}

Corners corners(const TriangleMesh& mesh, const Triangle& t) {
  return {mesh.vertices[t[0]], mesh.vertices[t[1]], mesh.vertices[t[2]]};
}

double distance(const Vec3d& p, const Corners& t) {
  const Vec3d n = cross(t[1] - t[0], t[2] - t[0]);
  bool over = true;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < 3; ++i) {
    const Vec3d &from = t[i], &to = t[(i + 1) % 3];
    over = over && dot(cross(to - from, p - from), n) >= 0;
    least = std::min(least, distance(p, PathSegment{from, to}));
  }
  return over ? std::min(least, std::fabs(dot(n, p - t[0])) / length(n)) : least;
}

/// Whether the boxes of two sets of points come within a distance of each other.
template <class Some, class Others>
bool boxes_near(const Some& some, const Others& others, double distance) {
  for (int axis = 0; axis < 3; ++axis) {
    const auto range = [&](const auto& points) {
      double low = points[0][axis], high = low;
      for (const Vec3d& p : points) {
        low = std::min(low, p[axis]);
        high = std::max(high, p[axis]);
      }
      return std::pair(low, high);
    };
    const auto [low, high] = range(some);
    const auto [other_low, other_high] = range(others);
    if (low - distance > other_high || other_low - distance > high) return false;
  }
  return true;
}

/// Whether a segment pierces a triangle; of general position.
bool pierces(const PathSegment& s, const Corners& t) {
  const auto volume = [](const Vec3d& a, const Vec3d& b, const Vec3d& c, const Vec3d& d) {
    return dot(cross(b - a, c - a), d - a);
  };
  if ((volume(t[0], t[1], t[2], s[0]) > 0) == (volume(t[0], t[1], t[2], s[1]) > 0)) return false;
  const bool first = volume(s[0], s[1], t[0], t[1]) > 0;
  return (volume(s[0], s[1], t[1], t[2]) > 0) == first &&
         (volume(s[0], s[1], t[2], t[0]) > 0) == first;
}

}  // namespace

std::vector<PathSegment> rim_of(const TriangleMesh& mesh) {
  using Key = std::array<std::int64_t, 3>;
  const auto key = [&](std::uint32_t v) {
    const Vec3d& p = mesh.vertices[v];
    return Key{std::llround(p.x * 1e6), std::llround(p.y * 1e6), std::llround(p.z * 1e6)};
  };
  std::map<std::pair<Key, Key>, std::pair<int, PathSegment>> edges;
  for (const Triangle& t : mesh.triangles)
    for (std::size_t i = 0; i < 3; ++i) {
      const std::uint32_t u = t[i], v = t[(i + 1) % 3];
      auto& edge = edges[std::minmax(key(u), key(v))];
      ++edge.first;
      edge.second = {mesh.vertices[u], mesh.vertices[v]};
    }
  std::vector<PathSegment> rim;
  for (const auto& [ends, edge] : edges)
    if (edge.first == 1) rim.push_back(edge.second);
  return rim;
}

bool passes_through(const std::vector<Vec3d>& path, const TriangleMesh& sheet,
                    const std::vector<PathSegment>& rims, double off, double margin) {
  const Vec3d nudge{0.00017, 0.00011, 0.00013};
  std::vector<Corners> triangles;
  for (const Triangle& t : sheet.triangles) triangles.push_back(corners(sheet, t));
  // Whether a stretch without a point near a rim, with an even or odd number of crossings before,
  // began off the sheet.
  std::array<bool, 2> began{false, false};
  bool odd = false;
  for (std::size_t i = 0; i < path.size(); ++i) {
    if (i > 0) {
      const PathSegment s{path[i - 1], path[i]}, nudged{s[0] + nudge, s[1] + nudge};
      if (std::ranges::any_of(rims, [&](const PathSegment& r) {
            return boxes_near(s, r, margin) && distance(s, r) < margin;
          }))
        began = {false, false};
      for (const Corners& t : triangles)
        if (boxes_near(nudged, t, 0) && pierces(nudged, t)) odd = !odd;
    }
    const std::array<Vec3d, 1> here{path[i]};
    if (std::ranges::any_of(triangles, [&](const Corners& t) {
          return boxes_near(here, t, off) && distance(path[i], t) < off;
        }))
      continue;
    if (began[odd ? 0 : 1]) return true;
    began[odd ? 1 : 0] = true;
  }
  return false;
}

}  // namespace strake::test
