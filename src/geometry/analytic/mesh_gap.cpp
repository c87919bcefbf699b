// SPDX-License-Identifier: Apache-2.0
#include "geometry/analytic/mesh_gap.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "geometry/analytic/torus_gap.hpp"
#include "geometry/box.hpp"
#include "geometry/corners.hpp"
#include "geometry/tree_walk.hpp"
#include "strake/geometry/analytic_pair.hpp"

namespace strake::geometry::analytic {
namespace {

constexpr double kNever = std::numeric_limits<double>::infinity();

/// Only what is certainly farther than the nearest pair of points so far is left out, so the answer
/// does not depend on the way.
class Search {
 public:
  Search(const PairSide& primitive, const TreedPart& mesh, double enough)
      : primitive_(primitive), mesh_(mesh), enough_(enough) {
    for (const Arc& arc : primitive.arcs()) hulls_.push_back(primitive.hull(arc));
    box_ = empty_box<double>();
    for (const ConvexBody& hull : hulls_)
      for (int k = 0; k < 3; ++k) {
        Vec3d n;
        n[k] = 1;
        box_.hi[k] = std::max(box_.hi[k], support(hull.shape, n)[k] + hull.error);
        box_.lo[k] = std::min(box_.lo[k], support(hull.shape, -n)[k] - hull.error);
      }
  }

  AnalyticGap run() {
    walk_nearer_first(
        *mesh_.tree, [&](std::uint32_t i) { return bound(mesh_.tree->nodes()[i]); },
        [&](double lower) { return lower > reach(); }, [&](std::uint32_t t) { offer(t); });
    best_.lower = std::min(best_.lower, best_.upper);
    return best_;
  }

 private:
  [[nodiscard]] double reach() const { return std::min(best_.upper, enough_); }

  /// No triangle of the node is nearer.
  [[nodiscard]] double bound(const PartTree::Node& node) const {
    const Box3d box = node.box.as<double>();
    const double apart = std::sqrt(squared_gap(box, box_)) * (1 - 1e-14);
    if (apart > reach()) return apart;
    const ConvexBody block = block_body((box.lo + box.hi) * 0.5, (box.hi - box.lo) * 0.5);
    double least = kNever;
    for (const ConvexBody& hull : hulls_)
      least = std::min(least, convex_gap(hull, block, reach()).lower);
    return std::max(least, apart);
  }

  void offer(std::uint32_t t) {
    PairSide triangle;
    triangle.convex = triangle_body(corners_of(*mesh_.placed.part, t));
    const ConvexGap gap = GapSearch(primitive_, triangle, reach()).run();
    best_.lower = std::min(best_.lower, gap.lower);
    if (!(gap.upper < best_.upper)) return;
    best_.upper = gap.upper;
    best_.on_primitive = gap.on_a;
    best_.on_mesh = gap.on_b;
  }

  const PairSide& primitive_;
  const TreedPart& mesh_;
  double enough_;
  std::vector<ConvexBody> hulls_;
  Box3d box_;
  AnalyticGap best_;
};

}  // namespace

AnalyticGap mesh_gap(const PairSide& side, const TreedPart& mesh, double enough) {
  return Search(side, mesh, enough).run();
}

}  // namespace strake::geometry::analytic

namespace strake::geometry {

std::optional<AnalyticGap> analytic_gap(const PlacedPrimitive& primitive, const TreedPart& mesh,
                                        double enough) {
  analytic::PairSide side;
  if (!side.read(primitive, mesh.placed.origin)) return std::nullopt;
  return analytic::mesh_gap(side, mesh, enough);
}

}  // namespace strake::geometry
