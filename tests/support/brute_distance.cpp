// SPDX-License-Identifier: Apache-2.0
#include "support/brute_distance.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <variant>

namespace strake::test {
namespace {

using geometry::Box3d;
using geometry::Vec3d;

double clamp01(double t) { return t < 0 ? 0 : t > 1 ? 1 : t; }

double point_segment(const Vec3d& p, const Vec3d& a, const Vec3d& b) {
  const Vec3d d = b - a;
  const double t = clamp01(dot(p - a, d) / dot(d, d));
  const Vec3d q = p - (a + d * t);
  return dot(q, q);
}

double point_triangle(const Vec3d& p, const WorldTriangle& t) {
  const Vec3d n = cross(t[1] - t[0], t[2] - t[0]);
  bool within = true;
  for (std::size_t k = 0; k < 3; ++k)
    within = within && dot(cross(t[(k + 1) % 3] - t[k], p - t[k]), n) >= 0;
  if (within) {
    const double h = dot(p - t[0], n);
    return h * h / dot(n, n);
  }
  return std::min(
      {point_segment(p, t[0], t[1]), point_segment(p, t[1], t[2]), point_segment(p, t[2], t[0])});
}

/// Squared distance of segments a-b and c-d where the nearest points are inner ones; else infinity
/// (the end points are looked at elsewhere).
double segment_segment(const Vec3d& a, const Vec3d& b, const Vec3d& c, const Vec3d& d) {
  const Vec3d u = b - a, v = d - c, w = a - c;
  const double uu = dot(u, u), uv = dot(u, v), vv = dot(v, v), uw = dot(u, w), vw = dot(v, w);
  const double det = uu * vv - uv * uv;
  if (det <= 1e-12 * uu * vv) return 1e300;
  const double s = (uv * vw - vv * uw) / det, t = (uu * vw - uv * uw) / det;
  if (s < 0 || s > 1 || t < 0 || t > 1) return 1e300;
  const Vec3d gap = w + u * s - v * t;
  return dot(gap, gap);
}

bool pierces(const Vec3d& p, const Vec3d& q, const WorldTriangle& t) {
  const Vec3d n = cross(t[1] - t[0], t[2] - t[0]);
  const double hp = dot(p - t[0], n), hq = dot(q - t[0], n);
  if (hp * hq > 0 || hp == hq) return false;
  const Vec3d x = p + (q - p) * (hp / (hp - hq));
  for (std::size_t k = 0; k < 3; ++k)
    if (dot(cross(t[(k + 1) % 3] - t[k], x - t[k]), n) < 0) return false;
  return true;
}

Box3d box_of(const WorldTriangle& t) {
  Box3d box{t[0], t[0]};
  box.include(t[1]);
  box.include(t[2]);
  return box;
}

bool within(const Box3d& a, const Box3d& b, double reach) {
  for (int k = 0; k < 3; ++k)
    if (a.lo[k] - b.hi[k] > reach || b.lo[k] - a.hi[k] > reach) return false;
  return true;
}

}  // namespace

WorldObject world_object(const model::Model& model, const model::Object& object) {
  WorldObject result;
  for (std::uint32_t i = 0; i < object.body_count; ++i) {
    const model::Body& body = model.bodies[object.first_body + i];
    const auto* mesh = std::get_if<geometry::TriangleMesh>(&model.shapes[model::index(body.shape)]);
    if (mesh == nullptr) continue;
    for (const geometry::Triangle& t : mesh->triangles) {
      const WorldTriangle triangle{body.placement * mesh->vertices[t[0]],
                                   body.placement * mesh->vertices[t[1]],
                                   body.placement * mesh->vertices[t[2]]};
      result.triangles.push_back(triangle);
      result.box.include(box_of(triangle));
    }
  }
  return result;
}

std::vector<std::array<std::uint32_t, 2>> near_boxes(const std::vector<WorldObject>& objects,
                                                     double reach) {
  std::vector<std::uint32_t> order(objects.size());
  std::iota(order.begin(), order.end(), 0U);
  std::erase_if(order, [&](std::uint32_t i) { return objects[i].triangles.empty(); });
  std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
    return objects[a].box.lo.x < objects[b].box.lo.x;
  });
  std::vector<std::array<std::uint32_t, 2>> pairs;
  for (std::size_t i = 0; i < order.size(); ++i)
    for (std::size_t j = i + 1; j < order.size(); ++j) {
      const Box3d &a = objects[order[i]].box, &b = objects[order[j]].box;
      if (b.lo.x > a.hi.x + reach) break;
      if (within(a, b, reach))
        pairs.push_back({std::min(order[i], order[j]), std::max(order[i], order[j])});
    }
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

double triangle_distance(const WorldTriangle& a, const WorldTriangle& b) {
  double best = 1e300;
  for (std::size_t i = 0; i < 3; ++i) {
    if (pierces(a[i], a[(i + 1) % 3], b) || pierces(b[i], b[(i + 1) % 3], a)) return 0;
    best = std::min({best, point_triangle(a[i], b), point_triangle(b[i], a)});
    for (std::size_t j = 0; j < 3; ++j)
      best = std::min(best, segment_segment(a[i], a[(i + 1) % 3], b[j], b[(j + 1) % 3]));
  }
  return std::sqrt(best);
}

double surface_distance(const WorldObject& a, const WorldObject& b, double reach) {
  double best = reach;
  for (const WorldTriangle& s : a.triangles) {
    const Box3d box = box_of(s);
    if (!within(box, b.box, best)) continue;
    for (const WorldTriangle& t : b.triangles)
      if (within(box, box_of(t), best)) best = std::min(best, triangle_distance(s, t));
    if (best == 0) break;
  }
  return best;
}

bool inside(const WorldObject& object, const Vec3d& point) {
  // Signed crossings of a ray whose direction shares no plane with plausible geometry.
  const Vec3d far = point + Vec3d{87431.13, 51237.71, 39119.37};
  int winding = 0;
  for (const WorldTriangle& t : object.triangles)
    if (pierces(point, far, t))
      winding += dot(cross(t[1] - t[0], t[2] - t[0]), far - point) > 0 ? 1 : -1;
  return winding != 0;
}

double point_distance(const WorldObject& object, const Vec3d& point) {
  double best = 1e300;
  for (const WorldTriangle& t : object.triangles) best = std::min(best, point_triangle(point, t));
  return std::sqrt(best);
}

double sampled_depth(const WorldObject& a, const WorldObject& b, int steps) {
  const Box3d common = a.box.common(b.box);
  for (int k = 0; k < 3; ++k)
    if (common.lo[k] >= common.hi[k]) return 0;
  const auto depth_at = [&](const Vec3d& p) {
    if (!inside(a, p) || !inside(b, p)) return 0.0;
    return std::max(point_distance(a, p), point_distance(b, p));
  };
  const Vec3d size = common.hi - common.lo;
  double best = 0;
  Vec3d at = common.lo;
  const auto consider = [&](const Vec3d& p) {
    for (int k = 0; k < 3; ++k)
      if (p[k] <= common.lo[k] || p[k] >= common.hi[k]) return;
    const double depth = depth_at(p);
    if (depth > best) best = depth, at = p;
  };
  for (int i = 0; i < steps; ++i)
    for (int j = 0; j < steps; ++j)
      for (int k = 0; k < steps; ++k)
        consider(common.lo + Vec3d{size.x * (i + 0.5) / steps, size.y * (j + 0.5) / steps,
                                   size.z * (k + 0.5) / steps});
  for (double scale = 0.5 / steps; best > 0 && scale > 1e-4; scale *= 0.5) {
    const Vec3d centre = at;
    for (int k = -1; k <= 1; ++k)
      for (int j = -1; j <= 1; ++j)
        for (int i = -1; i <= 1; ++i)
          consider(centre + Vec3d{size.x * scale * i, size.y * scale * j, size.z * scale * k});
  }
  return best;
}

}  // namespace strake::test
