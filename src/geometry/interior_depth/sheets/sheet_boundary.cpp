// SPDX-License-Identifier: Apache-2.0
#include "geometry/interior_depth/sheets/sheet_boundary.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>

#include "core/parting.hpp"
#include "geometry/interior_depth/surface_distance/nearest_triangle.hpp"
#include "geometry/numeric/vector_math.hpp"
#include "strake/geometry/part.hpp"
#include "strake/geometry/predicates.hpp"

namespace strake::geometry {
namespace {

/// Whether two triangles with a common edge lie on different sides of it and do not overlap.
bool go_on(const Part& part, const PartEdge& edge, std::uint32_t t, std::uint32_t u) {
  const auto at = [&](std::uint32_t v) { return part.vertices[v].as<std::int64_t>(); };
  const Vec3l from = at(edge.v0), to = at(edge.v1);
  const Vec3l p = at(opposite_vertex(part.triangles[t], edge)),
              q = at(opposite_vertex(part.triangles[u], edge));
  if (orient3d(from, to, p, q) != 0) return true;
  return dot(cross_exact(to - from, p - from).as<double>(),
             cross_exact(to - from, q - from).as<double>()) < 0;
}

/// Whether the triangles round an edge do not cancel in direction. Two that do not may be those of
/// one face that is wound to and fro.
bool ends_at(const Part& part, std::uint32_t number) {
  const PartEdge& edge = part.edges[number];
  const std::span<const std::uint32_t> round = incident_triangles(part, number);
  int balance = 0;
  for (const std::uint32_t t : round)
    balance += has_directed_edge(part.triangles[t], edge.v0, edge.v1) ? 1 : -1;
  return balance != 0 && !(round.size() == 2 && go_on(part, edge, round[0], round[1]));
}

}  // namespace

std::vector<std::array<Vec3d, 2>> boundary_edges(const Part& part) {
  std::vector<std::array<Vec3d, 2>> curve;
  for (std::uint32_t e = 0; e + 1 < part.edges.size(); ++e)
    if (ends_at(part, e))
      curve.push_back({part.vertices[part.edges[e].v0].as<double>(),
                       part.vertices[part.edges[e].v1].as<double>()});
  return curve;
}

namespace {

// Between 1 and 16 ships show no difference (decision 0073).
constexpr std::uint32_t kLeaf = 4;
/// Levels of a tree over as many segments as a number has room for.
constexpr std::size_t kMaxLevels = 33;
/// Relative rounding error of the distance to a box: a node is pruned only beyond that.
constexpr double kBoundaryRounding = 0x1p-40;
/// Maximum average number of additional pieces per segment.
constexpr double kMaxBoundaryPieces = 8;
/// Grid units: rounding error of where a segment is split.
constexpr double kMargin = 1.0 / 1024;

}  // namespace

SegmentBvh::SegmentBvh(std::vector<Segment> segments) : segments_(std::move(segments)) {
  if (segments_.empty()) return;
  std::vector<SegmentPiece> pieces = cut();
  order_.reserve(pieces.size());
  nodes_.emplace_back();
  build(0, pieces);
}

/// A long segment's box is in the way of everything; those of its pieces are not.
std::vector<SegmentBvh::SegmentPiece> SegmentBvh::cut() const {
  Box3d all = empty_box<double>();
  double total = 0;
  for (const Segment& s : segments_) {
    for (const Vec3d& end : s) all.include(end);
    total += length(s[1] - s[0]);
  }
  const auto n = static_cast<double>(segments_.size());
  const Vec3d size = all.hi - all.lo;
  const double room = std::max({size.x, size.y, size.z}) / std::cbrt(n);
  const double step = std::max(room, total / (kMaxBoundaryPieces * n));
  std::vector<SegmentPiece> pieces;
  for (std::uint32_t i = 0; i < segments_.size(); ++i) {
    const auto& [from, to] = segments_[i];
    const double parts = std::max(1.0, std::ceil(length(to - from) / std::max(step, 1.0)));
    for (double k = 0; k < parts; ++k) {
      Box3d box = empty_box<double>();
      box.include(from + (to - from) * (k / parts));
      box.include(from + (to - from) * ((k + 1) / parts));
      pieces.push_back({box.inflated(kMargin), i, static_cast<std::uint32_t>(pieces.size())});
    }
  }
  return pieces;
}

void SegmentBvh::build(std::uint32_t node, std::span<SegmentPiece> pieces) {
  Box3d box = empty_box<double>();
  for (const SegmentPiece& piece : pieces) box.include(piece.box);
  nodes_[node].box = box;
  if (pieces.size() <= kLeaf) {
    nodes_[node].first = static_cast<std::uint32_t>(order_.size());
    nodes_[node].count = static_cast<std::uint32_t>(pieces.size());
    std::ranges::sort(pieces, {}, &SegmentPiece::number);
    for (const SegmentPiece& piece : pieces) order_.push_back(piece.segment);
    return;
  }
  const Vec3d size = box.hi - box.lo;
  const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
  part_at(pieces, pieces.size() / 2, [axis](const SegmentPiece& x, const SegmentPiece& y) {
    const double of_x = x.box.lo[axis] + x.box.hi[axis], of_y = y.box.lo[axis] + y.box.hi[axis];
    return of_x != of_y ? of_x < of_y : x.number < y.number;
  });
  const auto left = static_cast<std::uint32_t>(nodes_.size());
  nodes_[node].first = left;
  nodes_.resize(nodes_.size() + 2);
  build(left, pieces.first(pieces.size() / 2));
  build(left + 1, pieces.subspan(pieces.size() / 2));
}

SegmentBvh::NearestSegment SegmentBvh::nearest(const Vec3d& p, double limit, double cutoff) const {
  NearestSegment best{.distance = limit};
  std::array<std::pair<double, std::uint32_t>, kMaxLevels + 1> stack;
  std::size_t size = 0;
  if (!nodes_.empty()) stack[size++] = {squared_gap(p, nodes_[0].box), 0};
  while (size > 0 && best.distance > cutoff) {
    const auto [gap, index] = stack[--size];
    if (gap * (1 - kBoundaryRounding) > best.distance * best.distance) continue;
    const Node& node = nodes_[index];
    if (node.count != 0) {
      for (std::uint32_t i = node.first; i < node.first + node.count; ++i) {
        const auto& [from, to] = segments_[order_[i]];
        const double d = length(p - nearest_on_segment(p, from, to));
        if (d < best.distance) best = {d, order_[i]};
      }
      continue;
    }
    std::pair near{squared_gap(p, nodes_[node.first].box), node.first};
    std::pair far{squared_gap(p, nodes_[node.first + 1].box), node.first + 1};
    if (far.first < near.first) std::swap(near, far);
    stack[size++] = far;
    stack[size++] = near;
  }
  return best;
}

}  // namespace strake::geometry
