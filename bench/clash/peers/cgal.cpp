// SPDX-License-Identifier: Apache-2.0
#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/AABB_triangle_primitive.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/box_intersection_d.h>
#include <CGAL/version_macros.h>

#include <algorithm>
#include <deque>
#include <utility>

#include "clocks.hpp"
#include "peers/peer.hpp"
#include "strake/parallel/collect.hpp"
#include "strake/parallel/for_each.hpp"

namespace strake::bench {
namespace {

using geometry::IndexPair;
using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Triangles = std::vector<Kernel::Triangle_3>;
using Primitive = CGAL::AABB_triangle_primitive<Kernel, Triangles::const_iterator>;
using Tree = CGAL::AABB_tree<CGAL::AABB_traits<Kernel, Primitive>>;
using Box = CGAL::Box_intersection_d::Box_with_info_d<double, 3, std::uint32_t>;

Triangles triangles_of(const PeerObject& o) {
  const auto point = [&](std::uint32_t v) {
    return Kernel::Point_3(o.points[v].x, o.points[v].y, o.points[v].z);
  };
  Triangles all;
  for (const auto& t : o.triangles) all.emplace_back(point(t[0]), point(t[1]), point(t[2]));
  return all;
}

CGAL::Bbox_3 box_of(const geometry::Box3d& b) {
  return {b.lo.x, b.lo.y, b.lo.z, b.hi.x, b.hi.y, b.hi.z};
}

}  // namespace

PeerAnswer cgal_overlaps(std::span<const PeerObject> objects, const parallel::Context& context) {
  PeerAnswer answer;
  Lap lap;
  CpuLap cpu;
  std::vector<Triangles> triangles(objects.size());
  std::deque<Tree> trees(objects.size());
  (void)parallel::for_each(context, {.name = "trees", .n = objects.size(), .grain = 16},
                           [&](std::size_t i) {
                             triangles[i] = triangles_of(objects[i]);
                             trees[i].insert(triangles[i].begin(), triangles[i].end());
                             trees[i].build();
                           });
  answer.build_s = cpu();
  std::vector<Box> boxes;
  for (std::uint32_t i = 0; i < objects.size(); ++i)
    if (!objects[i].triangles.empty()) boxes.emplace_back(box_of(objects[i].box), i);
  std::vector<IndexPair> candidates;
  CGAL::box_self_intersection_d(boxes.begin(), boxes.end(), [&](const Box& a, const Box& b) {
    candidates.push_back({std::min(a.info(), b.info()), std::max(a.info(), b.info())});
  });
  std::sort(candidates.begin(), candidates.end());
  answer.pairs = parallel::collect<IndexPair>(
                     context, {.name = "pairs", .n = candidates.size(), .grain = 64},
                     [&](std::size_t i, std::vector<IndexPair>& out) {
                       std::uint32_t few = candidates[i].first, many = candidates[i].second;
                       if (triangles[few].size() > triangles[many].size()) std::swap(few, many);
                       const CGAL::Bbox_3 limit = box_of(objects[many].box);
                       for (const auto& t : triangles[few])
                         if (CGAL::do_overlap(t.bbox(), limit) && trees[many].do_intersect(t)) {
                           out.push_back(candidates[i]);
                           return;
                         }
                     })
                     .value();
  answer.query_s = cpu();
  answer.wall_s = lap();
  answer.version = "CGAL " CGAL_VERSION_STR;
  return answer;
}

}  // namespace strake::bench
