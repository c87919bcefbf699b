// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "clash/pairs/pair_result.hpp"
#include "strake/geometry/primitive_separation.hpp"

/// Evaluates one pair of parts: by closed forms, planes, exact intersection, distance and depth.
namespace strake::clash {

/// Returns the depth of two parts whose interiors meet, of whatever kinds; its point and the goal's
/// are relative to a's origin. Both parts have planes, unless both are sheets.
[[nodiscard]] geometry::Depth depth_of(const PairOperand& a, const PairOperand& b,
                                       const geometry::DepthOptions& goal, NarrowWork& work);

/// A result in closed form; its point is relative to the origin of the part that was called a.
struct ClosedForm {
  geometry::PrimitiveSeparation separation;
  geometry::Vec3d point;
  /// It is nearer to a touch than the form can tell, so that the triangles decide on which side of
  /// it.
  bool tie = false;
};

/// Returns the closed form of two primitives whose triangles are not their true surfaces, if there
/// is one; `cutoff` as in geometry::primitive_separation().
[[nodiscard]] std::optional<ClosedForm> closed_form(const PairOperand& a, const PairOperand& b,
                                                    double cutoff);

/// Returns the relation that a closed form shows; `band` is δ in grid units.
[[nodiscard]] Relation relation_of(const geometry::PrimitiveSeparation& s, double band);

/// Evaluates two parts in canonical order; the functions below give them in any order.
class PairEvaluator {
 public:
  /// All arguments must outlive this.
  PairEvaluator(const PairOperand& a, const PairOperand& b, const PairTolerances& options,
                NarrowWork& work);

  [[nodiscard]] PartPairResult closed_form_result(const ClosedForm& form) const;

  /// Returns the result for parts that touch at a point, relative to a's origin.
  [[nodiscard]] PartPairResult flush(const geometry::Vec3d& point);

  /// Returns the result for parts that lie face to face across the gap; `decided`: whether it is
  /// certain that they do not.
  [[nodiscard]] std::optional<PartPairResult> face_contact(const geometry::SeparationBound& gap,
                                                           bool& decided);

  [[nodiscard]] PairEvaluation evaluation(const PriorBounds& known);

  [[nodiscard]] PartPairResult distance(double reach);

  [[nodiscard]] PartPairResult depth(const PairEvaluation& evaluation, const PriorBounds& known);

 private:
  double measure_gap(double limit, PartPairResult& answer);
  void narrow_bracket(const SignedSeparation& meshes, geometry::PrimitiveSeparation& form) const;
  [[nodiscard]] bool give_same_class(double lower, double upper) const;
  bool measure_gap_to_mesh(double reach, PartPairResult& answer);
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

/// Returns the result for two primitives that have a closed form: about their true surfaces, so
/// without sag. It is absent where they are within a micrometre of a touch: whether the triangles
/// touch is decided exactly, by evaluate_axis_plane_contact() and evaluate_intersection(), before
/// the closed form is used again.
[[nodiscard]] std::optional<PartPairResult> evaluate_closed_form(const PairOperand& a,
                                                                 const PairOperand& b,
                                                                 const PairTolerances& options);

/// Returns the result for a pair that touches in a coordinate plane between its boxes, if it does;
/// it needs no trees. `separated` tells whether there is such a plane; then evaluate_intersection()
/// need not test whether interiors meet.
[[nodiscard]] std::optional<PartPairResult> evaluate_axis_plane_contact(
    const PairOperand& a, const PairOperand& b, const PairTolerances& options, bool& separated);

/// Returns a certain lower bound on the signed separation of two framed parts as they are on the
/// grid, grid units. It is the same whichever is called a, its normal that of their canonical
/// order. If it is not below reach_with_sag(), the pair is NO_HIT.
[[nodiscard]] geometry::SeparationBound separation_lower_bound(const PairOperand& a,
                                                               const PairOperand& b,
                                                               const PairTolerances& options);

/// Returns the result for a pair that lies face to face within the contact distance, however it is
/// rotated; it needs no trees. `gap` is that of separation_lower_bound(). `decided` tells whether
/// it is certain that there is no such contact; then evaluate_intersection() need not test again.
[[nodiscard]] std::optional<PartPairResult> evaluate_face_contact(
    const PairOperand& a, const PairOperand& b, const PairTolerances& options,
    const geometry::SeparationBound& gap, bool& decided, NarrowWork& work);

/// Returns class, relation, separation and witness of two parts, but for the distance of those that
/// are apart and the depth of those whose interiors meet. Swapping the parts mirrors the relation
/// and moves the witness to the other origin; every other bit of the result stays the same.
[[nodiscard]] PairEvaluation evaluate_intersection(const PairOperand& a, const PairOperand& b,
                                                   const PairTolerances& options,
                                                   const PriorBounds& known, NarrowWork& work);

/// Returns the result for a pair that is apart, if it is nearer than `reach` and than any
/// threshold; otherwise it is NO_HIT.
[[nodiscard]] PartPairResult evaluate_distance(const PairOperand& a, const PairOperand& b,
                                               const PairTolerances& options, double reach,
                                               NarrowWork& work);

/// Returns the result for a pair that needs its depth.
[[nodiscard]] PartPairResult evaluate_depth(const PairOperand& a, const PairOperand& b,
                                            const PairEvaluation& evaluation,
                                            const PriorBounds& known, const PairTolerances& options,
                                            NarrowWork& work);

}  // namespace strake::clash
