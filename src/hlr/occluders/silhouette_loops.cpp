// SPDX-License-Identifier: Apache-2.0
// The certificate of convexity, outlines of coplanar triangles and silhouettes of convex parts.
#include "hlr/occluders/silhouette_loops.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <string_view>
#include <utility>

#include "hlr/edges/edge_on.hpp"
#include "hlr/edges/element_loop.hpp"
#include "strake/geometry/part.hpp"
#include "strake/parallel/for_each.hpp"
#include "strake/parallel/slots.hpp"

namespace strake::hlr {
namespace {

using geometry::Part;
using geometry::Triangle;
using geometry::Vec3d;
using geometry::Vec3i;
using geometry::Vec3l;

/// The ray from the middle, the sum of `count` points over their number, through the centre of
/// triangle 0. The cone of the corners of the triangle by which it leaves holds the ray's
/// direction.
bool ray_meets_once(const Part& part, const Vec3l& sum, std::int64_t count) {
  const Triangle& first = part.triangles[0];
  const auto from_middle = [&](std::uint32_t v) {
    const Vec3l q = part.vertices[v].as<std::int64_t>() * count - sum;
    return q.as<double>();
  };
  const Vec3d ray = from_middle(first[0]) + from_middle(first[1]) + from_middle(first[2]);
  std::size_t intervals = 0;
  for (const Triangle& t : part.triangles) {
    const Vec3d a = from_middle(t[0]), b = from_middle(t[1]), c = from_middle(t[2]);
    // Doubt counts as a hit: the certificate is refused, never forged.
    const double size = (std::abs(ray.x) + std::abs(ray.y) + std::abs(ray.z)) * 1e-9;
    const auto within = [&](const Vec3d& p, const Vec3d& q) {
      const Vec3d n = cross(p, q);
      return dot(n, ray) >= -size * (std::abs(n.x) + std::abs(n.y) + std::abs(n.z));
    };
    if (within(a, b) && within(b, c) && within(c, a)) ++intervals;
  }
  return intervals == 1;
}

}  // namespace

bool bounds_convex_body(const Part& part, std::span<const TrianglePlane> planes) {
  Vec3l sum{0, 0, 0};
  for (const Vec3i& v : part.vertices) sum = sum + v.as<std::int64_t>();
  const auto count = static_cast<std::int64_t>(part.vertices.size());
  if (count < 4 || count > (1 << 20)) return false;
  // All heights are taken times the number of vertices, so that the middle is integer.
  const auto inside = [&](const std::array<std::int64_t, 3>& n, const Vec3i& v) {
    const Vec3l q = v.as<std::int64_t>() * count - sum;
    return static_cast<Int128>(n[0]) * q.x + static_cast<Int128>(n[1]) * q.y +
               static_cast<Int128>(n[2]) * q.z >
           0;
  };
  for (std::size_t t = 0; t < planes.size(); ++t)
    if (!inside(planes[t].n, part.vertices[part.triangles[t][0]])) return false;
  return ray_meets_once(part, sum, count);
}

namespace {

struct LoopPoint {
  std::int64_t u = 0, v = 0;
};

struct OnPaper {
  const std::vector<ViewPoint>& points;
  LoopPoint operator()(std::uint32_t v) const { return {points[v].u, points[v].v}; }
};

/// A projection that drops one coordinate and keeps the orientation to a side.
struct InPlane {
  const Part& part;
  int u, v;
  LoopPoint operator()(std::uint32_t i) const { return {part.vertices[i][u], part.vertices[i][v]}; }
};

}  // namespace

Status ProjectedPart::project(const ViewProjection& projection, const parallel::Context& context) {
  const std::size_t count = part.vertices.size();
  constexpr std::string_view kName = "hidden lines: vertices on paper";
  if (viewer.eye) {
    auto made = parallel::slots<Vec3l>(count, context);
    if (!made) return made.error();
    rays = std::move(*made);
    return parallel::for_each(context, over_elements(kName, count), [&](std::size_t v) {
      rays[v] = part.vertices[v].as<std::int64_t>() - *viewer.eye;
    });
  }
  auto made = parallel::slots<ViewPoint>(count, context);
  if (!made) return made.error();
  points = std::move(*made);
  return parallel::for_each(context, over_elements(kName, count), [&](std::size_t v) {
    points[v] = projection(part.vertices[v].as<std::int64_t>());
  });
}

std::int64_t ProjectedPart::farthest() const {
  std::int64_t least = INT64_MAX;
  for (const ViewPoint& p : points) least = std::min(least, p.w);
  for (const Vec3l& r : rays) least = std::min(least, dot(r, viewer.direction));
  return least;
}

Status ProjectedPart::find_planes(const parallel::Context& context) {
  auto made = parallel::slots<TrianglePlane>(part.triangles.size(), context);
  if (!made) return made.error();
  planes = std::move(*made);
  return parallel::for_each(
      context, over_elements("hidden lines: planes", planes.size()), [&](std::size_t t) {
        const Triangle& i = part.triangles[t];
        const Vec3l p = part.vertices[i[0]].as<std::int64_t>();
        const Vec3l n = cross(part.vertices[i[1]].as<std::int64_t>() - p,
                              part.vertices[i[2]].as<std::int64_t>() - p);
        planes[t].n = {n.x, n.y, n.z};
        planes[t].facing = viewer.facing({n.x, n.y, n.z}, p);
        planes[t].edge_on =
            find_edge_on && may_be_edge_on(part, static_cast<std::uint32_t>(t), viewer.direction);
      });
}

std::array<std::int64_t, 3> ProjectedPart::towards_viewer(std::uint32_t t) const {
  const auto& n = planes[t].n;
  return planes[t].facing < 0 ? std::array{-n[0], -n[1], -n[2]} : n;
}

bool SilhouetteLoops::find_outline(std::span<const std::uint32_t> triangles) {
  next_.resize(projected_.part.vertices.size(), geometry::kNoIndex);
  const bool one = triangles.size() == 2 ? outline_of_pair(triangles[0], triangles[1])
                                         : triangles.size() > 2 && outline(triangles);
  return one && is_convex_face(triangles[0]);
}

bool SilhouetteLoops::find_silhouette() {
  if (!close_silhouette()) return false;
  return projected_.viewer.eye ? is_convex_cone() : is_convex_loop(OnPaper{projected_.points});
}

void SilhouetteLoops::take_triangle(std::uint32_t t) {
  const Triangle& i = projected_.part.triangles[t];
  loop_.assign(i.begin(), i.end());
  if (projected_.planes[t].facing < 0) std::swap(loop_[1], loop_[2]);
}

// Joins the edges between faces towards the viewer and the others to one loop (certified convex
// parts: every edge has two triangles).
bool SilhouetteLoops::close_silhouette() {
  next_.assign(projected_.part.vertices.size(), geometry::kNoIndex);
  std::size_t count = 0;
  std::uint32_t from = geometry::kNoIndex;
  for (std::size_t k = 0; k + 1 < projected_.part.edges.size(); ++k) {
    const geometry::PartEdge& e = projected_.part.edges[k];
    std::uint32_t s = projected_.part.edge_triangles[e.first_triangle];
    const std::uint32_t t = projected_.part.edge_triangles[e.first_triangle + 1];
    if ((projected_.planes[s].facing > 0) == (projected_.planes[t].facing > 0)) continue;
    if (projected_.planes[t].facing > 0) s = t;
    const bool along_edge = geometry::has_directed_edge(projected_.part.triangles[s], e.v0, e.v1);
    from = along_edge ? e.v0 : e.v1;
    if (next_[from] != geometry::kNoIndex) return false;
    next_[from] = along_edge ? e.v1 : e.v0;
    ++count;
  }
  loop_.clear();
  for (std::uint32_t v = from; v != geometry::kNoIndex && loop_.size() < count; v = next_[v])
    loop_.push_back(v);
  return count >= 3 && loop_.size() == count && next_[loop_.back()] == from;
}

// Does the work of outline() for two triangles that share an edge, without sorting.
bool SilhouetteLoops::outline_of_pair(std::uint32_t s, std::uint32_t t) {
  const Triangle &i = projected_.part.triangles[s], &j = projected_.part.triangles[t];
  for (std::size_t k = 0; k < 3; ++k) {
    const std::uint32_t a = i[k], b = i[(k + 1) % 3], c = i[(k + 2) % 3];
    for (std::size_t m = 0; m < 3; ++m) {
      if (j[m] != b || j[(m + 1) % 3] != a) continue;
      loop_ = {a, j[(m + 2) % 3], b, c};
      if (projected_.planes[s].facing < 0) std::reverse(loop_.begin(), loop_.end());
      return loop_[0] != loop_[2] && loop_[1] != loop_[3];
    }
  }
  return false;
}

// Finds the single closed outline of a group, counter-clockwise to the viewer; false if there are
// more loops or one that touches itself.
bool SilhouetteLoops::outline(std::span<const std::uint32_t> triangles) {
  directed_.clear();
  const bool front = projected_.planes[triangles[0]].facing > 0;
  for (const std::uint32_t t : triangles)
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t a = projected_.part.triangles[t][k],
                          b = projected_.part.triangles[t][(k + 1) % 3];
      directed_.push_back(front ? std::array{a, b} : std::array{b, a});
    }
  std::sort(directed_.begin(), directed_.end());
  std::size_t kept = 0;
  std::uint32_t from = geometry::kNoIndex;
  bool simple = true;
  touched_.clear();
  for (const auto& e : directed_) {
    if (std::binary_search(directed_.begin(), directed_.end(), std::array{e[1], e[0]})) continue;
    simple = simple && next_[e[0]] == geometry::kNoIndex;
    next_[e[0]] = e[1];
    touched_.push_back(e[0]);
    from = e[0];
    ++kept;
  }
  loop_.clear();
  if (simple && kept >= 3)
    for (std::uint32_t v = from; loop_.size() < kept && v != geometry::kNoIndex;) {
      loop_.push_back(v);
      v = next_[v];
      if (v == from) break;
    }
  for (const std::uint32_t v : touched_) next_[v] = geometry::kNoIndex;
  return simple && kept >= 3 && loop_.size() == kept;
}

// A flat loop is as convex on its plane as on paper.
bool SilhouetteLoops::is_convex_face(std::uint32_t t) {
  if (!projected_.viewer.eye) return is_convex_loop(OnPaper{projected_.points});
  const auto n = projected_.towards_viewer(t);
  std::size_t k = 0;
  for (std::size_t i = 1; i < 3; ++i)
    if (std::abs(n[i]) > std::abs(n[k])) k = i;
  const int i = static_cast<int>((k + 1) % 3), j = static_cast<int>((k + 2) % 3);
  return is_convex_loop(n[k] > 0 ? InPlane{projected_.part, i, j} : InPlane{projected_.part, j, i});
}

// Drops corners on straight runs; true when the rest turns left everywhere, and once round.
template <class At>
bool SilhouetteLoops::is_convex_loop(const At& at) {
  const auto orientation = [&](std::uint32_t i, std::uint32_t j, std::uint32_t k) {
    const LoopPoint p = at(i), q = at(j), r = at(k);
    return static_cast<Int128>(q.u - p.u) * (r.v - q.v) -
           static_cast<Int128>(q.v - p.v) * (r.u - q.u);
  };
  if (!drop_straight_runs(orientation)) return false;
  const auto rising = [&](std::uint32_t i, std::uint32_t j) {
    const LoopPoint p = at(i), q = at(j);
    return q.v > p.v || (q.v == p.v && q.u > p.u);
  };
  const std::size_t m = loop_.size();
  std::size_t ascents = 0;
  bool before = rising(loop_[m - 1], loop_[0]);
  for (std::size_t i = 0; i < m; ++i) {
    const bool now = rising(loop_[i], loop_[(i + 1) % m]);
    if (now && !before) ++ascents;
    before = now;
  }
  return ascents == 1;
}

// Tests the silhouette of a certified convex part likewise: it goes once round the cone from an eye
// outside the part.
bool SilhouetteLoops::is_convex_cone() {
  return drop_straight_runs([&](std::uint32_t i, std::uint32_t j, std::uint32_t k) {
    return -along(wide_cross(projected_.rays[i], projected_.rays[j]), projected_.rays[k]);
  });
}

template <class Orientation>
bool SilhouetteLoops::drop_straight_runs(const Orientation& orientation) {
  corners_.clear();
  const std::size_t n = loop_.size();
  for (std::size_t i = 0; i < n; ++i) {
    const Int128 left = orientation(loop_[(i + n - 1) % n], loop_[i], loop_[(i + 1) % n]);
    if (left < 0) return false;
    if (left > 0) corners_.push_back(loop_[i]);
  }
  loop_.swap(corners_);
  return loop_.size() >= 3;
}

}  // namespace strake::hlr
