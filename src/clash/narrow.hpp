// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>

#include "clash/classify.hpp"
#include "strake/geometry/depth.hpp"
#include "strake/geometry/part_frame.hpp"

namespace strake::clash {

/// One side of a pair of parts.
struct NarrowPart {
  geometry::TreedPart treed;
  const geometry::PartFrame* frame = nullptr;
  const geometry::SupportPlanes* planes = nullptr;  ///< for judge_distance() and judge_depth()
  /// What the part's primitive is placed by; null: its triangles speak for it.
  const geometry::Placement* placement = nullptr;
};

/// What a pair of parts is judged by, grid units.
struct NarrowOptions {
  double touch_overlap = 1000, touch_gap = 1000, clearance = 0;
  double contact_distance = 3;
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

struct PartAnswer {
  Judgement judgement;
  Relation relation = Relation::separate;
  Separation separation;
  Witness witness;
};

/// What a pair of parts has cost.
struct NarrowCost {
  geometry::PairCost pair;
  std::uint64_t depth_cells = 0;

  template <class Work>
  void add(const Work& more) {
    pair += more.pair;
    depth_cells += more.depth_cells;
  }
};

/// The same while it is worked on.
struct NarrowWork {
  geometry::PairWork pair;
  std::uint64_t depth_cells = 0;
};

/// t_o' of the pair: docs/clash.md, "Classes".
[[nodiscard]] Thresholds thresholds(const geometry::Part& a, const geometry::Part& b,
                                    const NarrowOptions& options);

/// An order of parts by what they are and where they stand relative to each other, so that the
/// pair is worked on the same way round whichever is called a.
[[nodiscard]] bool in_canonical_order(const geometry::TreedPart& a, const geometry::TreedPart& b);

/// An answer about (b, a) becomes one about (a, b).
void turn(PartAnswer& answer, const NarrowPart& a, const NarrowPart& b);

/// The flags of a pair that come from its parts.
[[nodiscard]] std::uint16_t part_flags(const geometry::Part& a, const geometry::Part& b);

/// The depth of two parts whose interiors meet, of whatever kinds; its point and the goal's are
/// relative to a's origin. Both have planes, but for two sheets.
[[nodiscard]] geometry::Depth depth_of(const NarrowPart& a, const NarrowPart& b,
                                       const geometry::DepthGoal& goal, NarrowWork& work);

/// The answer for two primitives that have a closed form: about their true surfaces, so without
/// sag. None where they are within a micrometre of a touch: whether the triangles touch is decided
/// exactly, by judge_flush() and look_at(), before the closed form is asked again.
[[nodiscard]] std::optional<PartAnswer> judge_analytic(const NarrowPart& a, const NarrowPart& b,
                                                       const NarrowOptions& options);

/// The answer for a pair that touches in a coordinate plane between its boxes, if it does: wants no
/// trees. `separated` tells whether there is such a plane, then look_at() need not ask whether
/// interiors meet.
[[nodiscard]] std::optional<PartAnswer> judge_flush(const NarrowPart& a, const NarrowPart& b,
                                                    const NarrowOptions& options, bool& separated);

/// What one exact look at a pair decides, and what is left to ask.
struct FirstLook {
  enum class Next : std::uint8_t { nothing, distance, depth };
  PartAnswer answer;                ///< where nothing is left to ask
  geometry::MeetingResult meeting;  ///< in canonical order of the two
  double gap = 0;                   ///< a certain lower bound on their signed separation
  Next next = Next::nothing;
};

/// A certain lower bound on the signed separation of two framed parts as they are on the grid, grid
/// units; the same whichever is called a. Not below parting_gap(): the pair is NO_HIT.
[[nodiscard]] double gap_between(const NarrowPart& a, const NarrowPart& b,
                                 const NarrowOptions& options);

/// How far apart is too far for any class, grid units.
[[nodiscard]] double reach_of(const NarrowOptions& options);

/// The same for triangles: true surfaces may stand out of them by the sag of both.
[[nodiscard]] double parting_gap(const geometry::Part& a, const geometry::Part& b,
                                 const NarrowOptions& options);

/// Class, relation, separation and witness of two parts, but for the distance of those that are
/// apart and the depth of those whose interiors meet. Swapping the parts mirrors the relation and
/// moves the witness to the other origin; every other bit of an answer stays the same.
/// `gap` is that of gap_between(); `separated` what judge_flush() found. Depth that the gap alone
/// shows to be that of a tie is given too.
[[nodiscard]] FirstLook look_at(const NarrowPart& a, const NarrowPart& b,
                                const NarrowOptions& options, double gap, bool separated,
                                NarrowWork& work);

/// The answer for a pair that is apart, if nearer than `reach` and than anybody asked; otherwise
/// it is NO_HIT.
[[nodiscard]] PartAnswer judge_distance(const NarrowPart& a, const NarrowPart& b,
                                        const NarrowOptions& options, double reach,
                                        NarrowWork& work);

/// The answer for a pair that needs its depth.
[[nodiscard]] PartAnswer judge_depth(const NarrowPart& a, const NarrowPart& b,
                                     const FirstLook& look, const NarrowOptions& options,
                                     NarrowWork& work);

}  // namespace strake::clash
