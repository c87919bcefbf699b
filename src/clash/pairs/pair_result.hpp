// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "clash/pairs/classify.hpp"
#include "geometry/obb/oriented_box.hpp"
#include "strake/geometry/depth.hpp"

/// The operands, tolerances and results of one pair of parts.
namespace strake::clash {

/// One side of a pair of parts.
struct PairOperand {
  geometry::PartWithBvh treed;
  const geometry::OrientedBox* frame = nullptr;
  const geometry::FaceKdop* planes = nullptr;  ///< needed by evaluate_depth()
  /// The placement of the part's primitive; null if its triangles are its true surface.
  const geometry::Placement* placement = nullptr;
};

/// The tolerances of a pair of parts, grid units.
struct PairTolerances {
  double touch_overlap = 1000, touch_gap = 1000, clearance = 0;
  double contact_distance = 3;
  double snap = 0;  ///< how far the snap may have moved the two against each other
  double step = 0;  ///< if numbers are so coarse that what is a step apart may touch
  bool thickness_cap = true;
};

/// Where a separation is measured: a move of a from on_a to on_b makes the two points coincide. Of
/// parts that are apart they are the closest points; otherwise one is the deepest point of the
/// common part, the other the nearest point of the surface that it is measured to.
struct Witness {
  geometry::Vec3d on_a = {}, on_b = {};  ///< grid units relative to a's origin
  /// The unit vector along which a moves away from b, or out of b; zero where there is none, as
  /// between parts that touch and sheets that cross.
  geometry::Vec3d away = {};
  bool interiors_meet = false;
  bool deep_in_a = false;  ///< if interiors meet: the surface is a's, on_b the deepest point

  [[nodiscard]] geometry::Vec3d point() const {
    if (interiors_meet) return deep_in_a ? on_b : on_a;
    return (on_a + on_b) * 0.5;
  }
};

struct PartPairResult {
  Classification classification;
  Relation relation = Relation::separate;
  SignedSeparation separation;
  Witness witness;
};

/// What a pair of parts has cost.
struct NarrowCost {
  geometry::QueryStats pair;
  std::uint64_t depth_cells = 0;

  template <class Work>
  void add(const Work& more) {
    pair += more.pair;
    depth_cells += more.depth_cells;
  }
};

/// The cost of a pair while it is evaluated.
struct NarrowWork {
  geometry::QueryContext pair;
  std::uint64_t depth_cells = 0;
};

/// What is known of a pair before it is evaluated exactly.
struct PriorBounds {
  geometry::SeparationBound gap{0, {}};  ///< from separation_lower_bound()
  bool separated = false;        ///< evaluate_axis_plane_contact() found a coordinate plane between
  bool known_not_flush = false;  ///< evaluate_face_contact() found that no faces are coplanar
};

/// What one exact evaluation of a pair decides, and what is left to compute.
struct PairEvaluation {
  enum class Next : std::uint8_t { nothing, distance, depth };
  PartPairResult answer;            ///< complete where nothing is left to compute
  geometry::MeetingResult meeting;  ///< in canonical order of the two
  Next next = Next::nothing;
};

}  // namespace strake::clash
