// SPDX-License-Identifier: Apache-2.0
#include "geometry/primitive_pairs/mesh_distance.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "geometry/bvh/traversal.hpp"
#include "geometry/numeric/triangle_math.hpp"
#include "geometry/numeric/vector_math.hpp"
#include "geometry/primitive_pairs/solvers/torus_branch_and_bound.hpp"
#include "strake/geometry/primitive_separation.hpp"

namespace strake::geometry::primitive_pairs {
namespace {

constexpr double kUnbounded = std::numeric_limits<double>::infinity();

/// Only what is certainly farther than the nearest pair of points so far is left out, so the answer
/// does not depend on the way.
class MeshDistanceSearch {
 public:
  MeshDistanceSearch(const PrimitiveOperand& primitive, const PartWithBvh& mesh, double cutoff)
      : primitive_(primitive), mesh_(mesh), cutoff_(cutoff) {
    for (const SweptArc& arc : primitive.arcs()) hulls_.push_back(primitive.hull(arc));
    box_ = empty_box<double>();
    for (const ConvexBody& hull : hulls_)
      for (int k = 0; k < 3; ++k) {
        Vec3d n;
        n[k] = 1;
        box_.hi[k] = std::max(box_.hi[k], support(hull.shape, n)[k] + hull.error);
        box_.lo[k] = std::min(box_.lo[k], support(hull.shape, -n)[k] - hull.error);
      }
  }

  PrimitiveMeshDistance run() {
    traverse_nearest_first(
        *mesh_.tree, [&](std::uint32_t i) { return bound(mesh_.tree->nodes()[i]); },
        [&](double lower) { return lower > reach(); }, [&](std::uint32_t t) { offer(t); });
    best_.lower = std::min(best_.lower, best_.upper);
    return best_;
  }

 private:
  [[nodiscard]] double reach() const { return std::min(best_.upper, cutoff_); }

  /// No triangle of the node is nearer.
  [[nodiscard]] double bound(const TriangleBvh::Node& node) const {
    const Box3d box = node.box.as<double>();
    const double apart = std::sqrt(squared_gap(box, box_)) * (1 - 1e-14);
    if (apart > reach()) return apart;
    const ConvexBody block = block_body((box.lo + box.hi) * 0.5, (box.hi - box.lo) * 0.5);
    double least = kUnbounded;
    for (const ConvexBody& hull : hulls_)
      least = std::min(least, gjk_distance(hull, block, reach()).lower);
    return std::max(least, apart);
  }

  void offer(std::uint32_t t) {
    PrimitiveOperand triangle;
    triangle.convex = triangle_body(corners_of(*mesh_.placed.part, t));
    const GjkResult gap = TorusDistanceSearch(primitive_, triangle, reach()).run();
    best_.lower = std::min(best_.lower, gap.lower);
    if (!(gap.upper < best_.upper)) return;
    best_.upper = gap.upper;
    best_.on_primitive = gap.on_a;
    best_.on_mesh = gap.on_b;
  }

  const PrimitiveOperand& primitive_;
  const PartWithBvh& mesh_;
  double cutoff_;
  std::vector<ConvexBody> hulls_;
  Box3d box_;
  PrimitiveMeshDistance best_;
};

}  // namespace

PrimitiveMeshDistance operand_mesh_distance(const PrimitiveOperand& side, const PartWithBvh& mesh,
                                            double cutoff) {
  return MeshDistanceSearch(side, mesh, cutoff).run();
}

}  // namespace strake::geometry::primitive_pairs

namespace strake::geometry {

std::optional<PrimitiveMeshDistance> primitive_mesh_distance(const PlacedPrimitive& primitive,
                                                             const PartWithBvh& mesh,
                                                             double cutoff) {
  primitive_pairs::PrimitiveOperand side;
  if (!side.read(primitive, mesh.placed.origin)) return std::nullopt;
  return primitive_pairs::operand_mesh_distance(side, mesh, cutoff);
}

}  // namespace strake::geometry
