// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "clash/pairs/classify.hpp"
#include "geometry/obb/oriented_box.hpp"
#include "strake/geometry/depth.hpp"

namespace strake::clash {

/// One side of a pair of parts.
struct PairOperand {
  geometry::PartWithBvh treed;
  const geometry::OrientedBox* frame = nullptr;
  const geometry::FaceKdop* planes = nullptr;  ///< for evaluate_depth()
  /// What the part's primitive is placed by; null: its triangles speak for it.
  const geometry::Placement* placement = nullptr;
};

/// What a pair of parts is judged by, grid units.
struct PairTolerances {
  double touch_overlap = 1000, touch_gap = 1000, clearance = 0;
  double contact_distance = 3;
  double snap = 0;  ///< how far the snap may have moved the two against each other
  double step = 0;  ///< of numbers so coarse that what is a step apart may touch; else 0
  bool thickness_cap = true;
};

/// Where a separation is measured: from on_a to on_b is the way that a would have to move for the
/// two points to coincide. Apart, they are the closest points; otherwise one is the deepest point
/// of the common part, the other the nearest point of the skin that it is measured to.
struct Witness {
  geometry::Vec3d on_a = {}, on_b = {};  ///< grid units relative to a's origin
  /// Unit: the way along which a moves away from b, or out of b; zero where there is none, as
  /// between parts that touch and sheets that cross.
  geometry::Vec3d away = {};
  bool interiors_meet = false;
  bool deep_in_a = false;  ///< interiors meet: the skin is a's and on_b the deepest point

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

/// The same while it is worked on.
struct NarrowWork {
  geometry::QueryContext pair;
  std::uint64_t depth_cells = 0;
};

/// What is known of a pair before anybody looks at it exactly.
struct PriorBounds {
  geometry::SeparationBound gap{0, {}};  ///< of gap_between()
  bool separated =
      false;  ///< a coordinate plane lies between, as evaluate_axis_plane_contact() found
  bool known_not_flush = false;  ///< evaluate_face_contact() has found that they are not flush
};

/// What one exact look at a pair decides, and what is left to ask.
struct PairEvaluation {
  enum class Next : std::uint8_t { nothing, distance, depth };
  PartPairResult answer;            ///< where nothing is left to ask
  geometry::MeetingResult meeting;  ///< in canonical order of the two
  Next next = Next::nothing;
};

}  // namespace strake::clash
