// SPDX-License-Identifier: Apache-2.0
#include "hlr/loops.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdlib>
#include <string_view>
#include <utility>

#include "hlr/edge_on.hpp"
#include "hlr/shape_loop.hpp"
#include "strake/geometry/part_edges.hpp"
#include "strake/parallel/for_each.hpp"
#include "strake/parallel/slots.hpp"

namespace strake::hlr {
namespace {

using geometry::Part;
using geometry::Triangle;
using geometry::Vec3i;
using geometry::Vec3l;

struct Place {
  std::int64_t u = 0, v = 0;
};

struct OnPaper {
  const std::vector<ViewPoint>& points;
  Place operator()(std::uint32_t v) const { return {points[v].u, points[v].v}; }
};

/// Without one coordinate, so that what runs counter-clockwise to a side does so here.
struct InPlane {
  const Part& part;
  int u, v;
  Place operator()(std::uint32_t i) const { return {part.vertices[i][u], part.vertices[i][v]}; }
};

}  // namespace

Status PartSight::project(const Frame& frame, const parallel::Context& context) {
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
    points[v] = frame(part.vertices[v].as<std::int64_t>());
  });
}

std::int64_t PartSight::farthest() const {
  std::int64_t least = INT64_MAX;
  for (const ViewPoint& p : points) least = std::min(least, p.w);
  for (const Vec3l& r : rays) least = std::min(least, dot(r, viewer.direction));
  return least;
}

Status PartSight::find_planes(const parallel::Context& context) {
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

std::array<std::int64_t, 3> PartSight::towards_viewer(std::uint32_t t) const {
  const auto& n = planes[t].n;
  return planes[t].facing < 0 ? std::array{-n[0], -n[1], -n[2]} : n;
}

bool Loops::find_outline(std::span<const std::uint32_t> triangles) {
  next_.resize(seen_.part.vertices.size(), geometry::kNoFace);
  const bool one = triangles.size() == 2 ? outline_of_pair(triangles[0], triangles[1])
                                         : triangles.size() > 2 && outline(triangles);
  return one && is_convex_face(triangles[0]);
}

bool Loops::find_contour() {
  if (!close_contour()) return false;
  return seen_.viewer.eye ? is_convex_cone() : is_convex_loop(OnPaper{seen_.points});
}

void Loops::take_triangle(std::uint32_t t) {
  const Triangle& i = seen_.part.triangles[t];
  loop_.assign(i.begin(), i.end());
  if (seen_.planes[t].facing < 0) std::swap(loop_[1], loop_[2]);
}

// The edges between faces towards the viewer and the others, as one loop (certified convex
// parts: every edge has two triangles).
bool Loops::close_contour() {
  next_.assign(seen_.part.vertices.size(), geometry::kNoFace);
  std::size_t count = 0;
  std::uint32_t from = geometry::kNoFace;
  for (std::size_t k = 0; k + 1 < seen_.part.edges.size(); ++k) {
    const geometry::PartEdge& e = seen_.part.edges[k];
    std::uint32_t s = seen_.part.edge_triangles[e.first_triangle];
    const std::uint32_t t = seen_.part.edge_triangles[e.first_triangle + 1];
    if ((seen_.planes[s].facing > 0) == (seen_.planes[t].facing > 0)) continue;
    if (seen_.planes[t].facing > 0) s = t;
    const bool along_edge = geometry::runs_along(seen_.part.triangles[s], e.v0, e.v1);
    from = along_edge ? e.v0 : e.v1;
    if (next_[from] != geometry::kNoFace) return false;
    next_[from] = along_edge ? e.v1 : e.v0;
    ++count;
  }
  loop_.clear();
  for (std::uint32_t v = from; v != geometry::kNoFace && loop_.size() < count; v = next_[v])
    loop_.push_back(v);
  return count >= 3 && loop_.size() == count && next_[loop_.back()] == from;
}

// As outline(), for two triangles that share an edge: without sorting.
bool Loops::outline_of_pair(std::uint32_t s, std::uint32_t t) {
  const Triangle &i = seen_.part.triangles[s], &j = seen_.part.triangles[t];
  for (std::size_t k = 0; k < 3; ++k) {
    const std::uint32_t a = i[k], b = i[(k + 1) % 3], c = i[(k + 2) % 3];
    for (std::size_t m = 0; m < 3; ++m) {
      if (j[m] != b || j[(m + 1) % 3] != a) continue;
      loop_ = {a, j[(m + 2) % 3], b, c};
      if (seen_.planes[s].facing < 0) std::reverse(loop_.begin(), loop_.end());
      return loop_[0] != loop_[2] && loop_[1] != loop_[3];
    }
  }
  return false;
}

// The single closed outline of a group, counter-clockwise to the viewer; false if there are
// more loops or one that touches itself.
bool Loops::outline(std::span<const std::uint32_t> triangles) {
  directed_.clear();
  const bool front = seen_.planes[triangles[0]].facing > 0;
  for (const std::uint32_t t : triangles)
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t a = seen_.part.triangles[t][k], b = seen_.part.triangles[t][(k + 1) % 3];
      directed_.push_back(front ? std::array{a, b} : std::array{b, a});
    }
  std::sort(directed_.begin(), directed_.end());
  std::size_t kept = 0;
  std::uint32_t from = geometry::kNoFace;
  bool simple = true;
  touched_.clear();
  for (const auto& e : directed_) {
    if (std::binary_search(directed_.begin(), directed_.end(), std::array{e[1], e[0]})) continue;
    simple = simple && next_[e[0]] == geometry::kNoFace;
    next_[e[0]] = e[1];
    touched_.push_back(e[0]);
    from = e[0];
    ++kept;
  }
  loop_.clear();
  if (simple && kept >= 3)
    for (std::uint32_t v = from; loop_.size() < kept && v != geometry::kNoFace;) {
      loop_.push_back(v);
      v = next_[v];
      if (v == from) break;
    }
  for (const std::uint32_t v : touched_) next_[v] = geometry::kNoFace;
  return simple && kept >= 3 && loop_.size() == kept;
}

// A flat loop is as convex on its plane as on paper.
bool Loops::is_convex_face(std::uint32_t t) {
  if (!seen_.viewer.eye) return is_convex_loop(OnPaper{seen_.points});
  const auto n = seen_.towards_viewer(t);
  std::size_t k = 0;
  for (std::size_t i = 1; i < 3; ++i)
    if (std::abs(n[i]) > std::abs(n[k])) k = i;
  const int i = static_cast<int>((k + 1) % 3), j = static_cast<int>((k + 2) % 3);
  return is_convex_loop(n[k] > 0 ? InPlane{seen_.part, i, j} : InPlane{seen_.part, j, i});
}

// Drops corners on straight runs; true when the rest turns left everywhere, and once round.
template <class At>
bool Loops::is_convex_loop(const At& at) {
  const auto turn = [&](std::uint32_t i, std::uint32_t j, std::uint32_t k) {
    const Place p = at(i), q = at(j), r = at(k);
    return static_cast<Int128>(q.u - p.u) * (r.v - q.v) -
           static_cast<Int128>(q.v - p.v) * (r.u - q.u);
  };
  if (!drop_straight_runs(turn)) return false;
  const auto rising = [&](std::uint32_t i, std::uint32_t j) {
    const Place p = at(i), q = at(j);
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

// The same for the contour of a certified convex part, which goes once round the cone from an eye
// outside it.
bool Loops::is_convex_cone() {
  return drop_straight_runs([&](std::uint32_t i, std::uint32_t j, std::uint32_t k) {
    return -along(wide_cross(seen_.rays[i], seen_.rays[j]), seen_.rays[k]);
  });
}

template <class Turn>
bool Loops::drop_straight_runs(const Turn& turn) {
  corners_.clear();
  const std::size_t n = loop_.size();
  for (std::size_t i = 0; i < n; ++i) {
    const Int128 left = turn(loop_[(i + n - 1) % n], loop_[i], loop_[(i + 1) % n]);
    if (left < 0) return false;
    if (left > 0) corners_.push_back(loop_[i]);
  }
  loop_.swap(corners_);
  return loop_.size() >= 3;
}

}  // namespace strake::hlr
