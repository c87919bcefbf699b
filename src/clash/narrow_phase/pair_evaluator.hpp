// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "clash/pairs/pair_result.hpp"
#include "strake/geometry/primitive_separation.hpp"

namespace strake::clash {

/// The depth of two parts whose interiors meet, of whatever kinds; its point and the goal's are
/// relative to a's origin. Both have planes, but for two sheets.
[[nodiscard]] geometry::Depth depth_of(const PairOperand& a, const PairOperand& b,
                                       const geometry::DepthOptions& goal, NarrowWork& work);

/// A closed form, its point relative to the origin of the part that was called a.
struct ClosedForm {
  geometry::PrimitiveSeparation separation;
  geometry::Vec3d point;
  /// Nearer to a touch than the form can tell: which side of it is for the triangles to say.
  bool tie = false;
};

/// That of two primitives whose triangles are not their true surfaces, if there is one; `enough` as
/// in geometry::primitive_separation().
[[nodiscard]] std::optional<ClosedForm> closed_form(const PairOperand& a, const PairOperand& b,
                                                    double enough);

/// The relation that it shows; `band` is δ in grid units.
[[nodiscard]] Relation relation_of(const geometry::PrimitiveSeparation& s, double band);

/// Two parts in canonical order, and what is said of them: narrow.hpp.
class PairEvaluator {
 public:
  /// All must outlive this.
  PairEvaluator(const PairOperand& a, const PairOperand& b, const PairTolerances& options,
                NarrowWork& work);

  [[nodiscard]] PartPairResult analytic(const ClosedForm& form) const;

  /// Of those that touch at a point, relative to a's origin.
  [[nodiscard]] PartPairResult flush(const geometry::Vec3d& point);

  /// Of those that lie face to face across the gap; `asked`: whether none is certain.
  [[nodiscard]] std::optional<PartPairResult> face_contact(const geometry::SeparationBound& gap,
                                                           bool& asked);

  [[nodiscard]] PairEvaluation evaluation(const PriorBounds& known);

  [[nodiscard]] PartPairResult distance(double reach);

  [[nodiscard]] PartPairResult depth(const PairEvaluation& evaluation, const PriorBounds& known);

 private:
  double apart(double limit, PartPairResult& answer);
  void within(const SignedSeparation& meshes, geometry::PrimitiveSeparation& form) const;
  [[nodiscard]] bool all_one(double lower, double upper) const;
  bool apart_from_mesh(double reach, PartPairResult& answer);
  [[nodiscard]] bool hulls_part() const;
  [[nodiscard]] bool equal_solids() const;
  [[nodiscard]] geometry::MeetingResult meeting_of_equals() const;
  void touching(const geometry::MeetingResult& meeting, PartPairResult& answer);
  void conclude_touching(PartPairResult& answer) const;
  [[nodiscard]] bool may_be_flush(double gap) const;
  void nearly_touching(const geometry::ClosestPair& near, const geometry::SeparationBound& gap,
                       PartPairResult& answer) const;
  [[nodiscard]] bool may_touch(geometry::DepthOptions goal);
  void interpenetrating(const geometry::MeetingResult& meeting, double gap, PartPairResult& answer);
  [[nodiscard]] double sag() const;
  void conclude(PartPairResult& answer) const { conclude(answer, sag()); }
  void conclude(PartPairResult& answer, double sag) const;

  const PairOperand &part_a_, &part_b_;
  const geometry::PartWithBvh &a_, &b_;
  const PairTolerances& options_;
  NarrowWork& work_;
  Thresholds thresholds_;
};

/// The answer for two primitives that have a closed form: about their true surfaces, so without
/// sag. None where they are within a micrometre of a touch: whether the triangles touch is decided
/// exactly, by evaluate_axis_plane_contact() and evaluate_intersection(), before the closed form is
/// asked again.
[[nodiscard]] std::optional<PartPairResult> evaluate_closed_form(const PairOperand& a,
                                                                 const PairOperand& b,
                                                                 const PairTolerances& options);

/// The answer for a pair that touches in a coordinate plane between its boxes, if it does: wants no
/// trees. `separated` tells whether there is such a plane, then evaluate_intersection() need not
/// ask whether interiors meet.
[[nodiscard]] std::optional<PartPairResult> evaluate_axis_plane_contact(
    const PairOperand& a, const PairOperand& b, const PairTolerances& options, bool& separated);

/// A certain lower bound on the signed separation of two framed parts as they are on the grid, grid
/// units; the same whichever is called a, its normal that of their canonical order. Not below
/// reach_with_sag(): the pair is NO_HIT.
[[nodiscard]] geometry::SeparationBound separation_lower_bound(const PairOperand& a,
                                                               const PairOperand& b,
                                                               const PairTolerances& options);

/// The answer for a pair that lies face to face within the contact distance, however it stands:
/// wants no trees. `gap` is that of separation_lower_bound(). `asked` tells whether none is the
/// answer, then evaluate_intersection() need not ask again.
[[nodiscard]] std::optional<PartPairResult> evaluate_face_contact(
    const PairOperand& a, const PairOperand& b, const PairTolerances& options,
    const geometry::SeparationBound& gap, bool& asked, NarrowWork& work);

/// Class, relation, separation and witness of two parts, but for the distance of those that are
/// apart and the depth of those whose interiors meet. Swapping the parts mirrors the relation and
/// moves the witness to the other origin; every other bit of an answer stays the same.
[[nodiscard]] PairEvaluation evaluate_intersection(const PairOperand& a, const PairOperand& b,
                                                   const PairTolerances& options,
                                                   const PriorBounds& known, NarrowWork& work);

/// The answer for a pair that is apart, if nearer than `reach` and than anybody asked; otherwise
/// it is NO_HIT.
[[nodiscard]] PartPairResult evaluate_distance(const PairOperand& a, const PairOperand& b,
                                               const PairTolerances& options, double reach,
                                               NarrowWork& work);

/// The answer for a pair that needs its depth.
[[nodiscard]] PartPairResult evaluate_depth(const PairOperand& a, const PairOperand& b,
                                            const PairEvaluation& evaluation,
                                            const PriorBounds& known, const PairTolerances& options,
                                            NarrowWork& work);

}  // namespace strake::clash
