// SPDX-License-Identifier: Apache-2.0
#include "clash/narrow_phase/pair_evaluator.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>

#include "clash/narrow_phase/canonical_order.hpp"
#include "clash/narrow_phase/pair_tolerances.hpp"
#include "clash/narrow_phase/relation.hpp"
#include "clash/narrow_phase/witness.hpp"
#include "geometry/distance/hull_distance.hpp"
#include "geometry/distance/slab_proximity.hpp"
#include "geometry/intersect/coplanar_faces.hpp"
#include "strake/geometry/grid.hpp"

namespace strake::clash {

using geometry::DepthOperand;
using geometry::DepthOptions;
using geometry::Meeting;
using geometry::MeetingResult;
using geometry::Part;
using geometry::PartKind;
using geometry::Vec3d;

geometry::Depth depth_of(const PairOperand& a, const PairOperand& b, const DepthOptions& goal,
                         NarrowWork& work) {
  const bool sheet_a = a.treed.placed.part->kind == PartKind::sheet;
  const bool sheet_b = b.treed.placed.part->kind == PartKind::sheet;
  if (sheet_a && sheet_b) return geometry::sheet_crossing_depth(a.treed, b.treed, goal, work.pair);
  const DepthOperand x{a.treed, a.planes}, y{b.treed, b.planes};
  if (sheet_a) return geometry::sheet_in_solid_depth(x, y, goal, work.pair);
  if (sheet_b) {
    const Vec3d shift = (b.treed.placed.origin - a.treed.placed.origin).as<double>();
    DepthOptions of_sheet = goal;
    if (goal.within) of_sheet.within = {goal.within->lo - shift, goal.within->hi - shift};
    if (goal.belongs) of_sheet.belongs = [&](const Vec3d& p) { return goal.belongs(p + shift); };
    geometry::Depth depth = geometry::sheet_in_solid_depth(y, x, of_sheet, work.pair);
    depth.point = depth.point + shift;
    return depth;
  }
  return geometry::solid_depth(x, y, goal, work.pair);
}

std::optional<ClosedForm> closed_form(const PairOperand& a, const PairOperand& b, double cutoff) {
  const Part &x = *a.treed.placed.part, &y = *b.treed.placed.part;
  const auto &p = x.primitive, &q = y.primitive;
  if (!p || !q || a.placement == nullptr || b.placement == nullptr) return std::nullopt;
  // Triangles that are the true surface are compared exactly.
  if (!(x.sag + y.sag > 0)) return std::nullopt;
  const auto s = geometry::primitive_separation({&*p, a.placement}, {&*q, b.placement}, cutoff + 1);
  const auto centre = geometry::snap(a.placement->translation);
  if (!s || !centre) return std::nullopt;
  if (s->sheet_a != (x.kind == PartKind::sheet) || s->sheet_b != (y.kind == PartKind::sheet))
    return std::nullopt;
  return ClosedForm{*s, s->point + (*centre - a.treed.placed.origin).as<double>(),
                    !(s->lower > 1 || s->upper < -1)};
}

Relation relation_of(const geometry::PrimitiveSeparation& s, double band) {
  const bool sheet = s.sheet_a || s.sheet_b;
  if (s.difference <= band) return Relation::duplicate;
  if (std::fabs(s.d) <= band) return Relation::abut_outside;
  if (s.d > 0) return Relation::separate;
  if (s.a_inside_b > band) return Relation::a_in_b;
  if (s.b_inside_a > band) return Relation::b_in_a;
  if (sheet) return Relation::cross;
  return std::max(s.a_inside_b, s.b_inside_a) >= -band ? Relation::abut_inside
                                                       : Relation::interfere;
}

namespace {

/// The depth of an interior that is known to be met without a measured depth: less than any grid
/// can resolve.
constexpr double kMinDepth = 1e-6;

/// Grid units by which a distance may be left open where it decides nothing: what the snap makes of
/// two rotated flat faces.
constexpr double kSnapSlack = 4;

/// Grid units: a distance of more than this is not 0, whatever the rounding.
constexpr double kMinGap = 1.0 / 1024;

geometry::PartWithObb framed(const PairOperand& part) { return {part.treed.placed, part.frame}; }

SignedSeparation separated_by(double distance) {
  // The distance is the rounded root of a rounded square: off by less than two ulp.
  constexpr double kEps = 2 * std::numeric_limits<double>::epsilon();
  return {.d = distance, .lower = distance * (1 - kEps), .upper = distance * (1 + kEps)};
}

}  // namespace

PairEvaluator::PairEvaluator(const PairOperand& a, const PairOperand& b,
                             const PairTolerances& options, NarrowWork& work)
    : part_a_(a),
      part_b_(b),
      a_(a.treed),
      b_(b.treed),
      options_(options),
      work_(work),
      thresholds_(thresholds(*a.treed.placed.part, *b.treed.placed.part, options)) {}

PartPairResult PairEvaluator::closed_form_result(const ClosedForm& form) const {
  const geometry::PrimitiveSeparation& s = form.separation;
  PartPairResult answer;
  answer.separation = {.d = s.d,
                       .lower = s.lower,
                       .upper = s.upper,
                       .sag = 0,
                       .interiors_meet = s.upper < 0,
                       .depth_complete = s.depth_complete};
  answer.witness = witness_of(s, form.point);
  answer.relation = relation_of(s, options_.contact_distance);
  conclude(answer, 0);
  return answer;
}

PartPairResult PairEvaluator::flush(const Vec3d& point) {
  PartPairResult answer;
  MeetingResult meeting;
  meeting.point = point;
  touching(meeting, answer);
  conclude_touching(answer);
  return answer;
}

std::optional<PartPairResult> PairEvaluator::face_contact(const geometry::SeparationBound& gap,
                                                          bool& decided) {
  decided = true;
  if (!may_be_flush(gap.lower)) return std::nullopt;
  const auto found = geometry::slab_proximity(a_.placed, b_.placed, gap.normal,
                                              options_.contact_distance, work_.pair);
  decided = found.decided;
  if (!found.near) return std::nullopt;
  std::optional<PartPairResult> answer(std::in_place);
  nearly_touching(*found.near, gap, *answer);
  return answer;
}

PairEvaluation PairEvaluator::evaluation(const PriorBounds& known) {
  PairEvaluation evaluation;
  if (!known.known_not_flush && may_be_flush(known.gap.lower))
    if (const auto near =
            geometry::find_pair_within(a_, b_, options_.contact_distance, work_.pair)) {
      nearly_touching(*near, known.gap, evaluation.answer);
      return evaluation;
    }
  if (!known.separated && !(known.gap.lower > 0) && !hulls_part())
    evaluation.meeting = equal_solids() ? meeting_of_equals() : geometry::meet(a_, b_, work_.pair);
  if (evaluation.meeting.meeting == Meeting::touching) {
    touching(evaluation.meeting, evaluation.answer);
    conclude_touching(evaluation.answer);
    return evaluation;
  }
  if (const auto form = closed_form(part_a_, part_b_, reach_of(options_))) {
    evaluation.answer = closed_form_result(*form);
    return evaluation;
  }
  if (evaluation.meeting.meeting == Meeting::apart)
    evaluation.next = PairEvaluation::Next::distance;
  else
    evaluation.next = PairEvaluation::Next::depth;
  return evaluation;
}

/// Whether the two are separated by a plane that is no face of either, as between pipes that cross.
bool PairEvaluator::hulls_part() const {
  return geometry::convex_hull_separation(framed(part_a_), framed(part_b_), kMinGap).lower > 0;
}

PartPairResult PairEvaluator::distance(double reach) {
  PartPairResult answer;
  conclude(answer, measure_gap(reach, answer));
  return answer;
}

PartPairResult PairEvaluator::depth(const PairEvaluation& evaluation, const PriorBounds& known) {
  PartPairResult answer;
  interpenetrating(evaluation.meeting, known.gap.lower, answer);
  conclude(answer);
  return answer;
}

/// Measures parts that are apart; returns the sag that the result has to count with.
double PairEvaluator::measure_gap(double limit, PartPairResult& answer) {
  // What a weld moved out of reach is reported: see classify().
  const double reach = std::min(limit + 1, reach_of(options_) + thresholds_.weld);
  const double parting = reach + sag();
  const auto hulls = geometry::convex_hull_separation(framed(part_a_), framed(part_b_), parting);
  if (hulls.lower >= parting) {
    answer.separation = separated_by(std::numeric_limits<double>::infinity());
    return sag();
  }
  if (measure_gap_to_mesh(reach, answer))
    return a_.placed.part->primitive ? b_.placed.part->sag : a_.placed.part->sag;
  const auto way = hulls.lower > 0 ? std::optional(hulls.normal) : std::nullopt;
  auto near = geometry::find_closest_pair(a_, b_, reach, work_.pair, kSnapSlack, way);
  if (near && !give_same_class(near->lower, near->distance))
    near = geometry::find_closest_pair(a_, b_, reach, work_.pair, 0, way);
  if (!near) {
    answer.separation = separated_by(std::numeric_limits<double>::infinity());
    return sag();
  }
  answer.separation = separated_by(near->distance);
  answer.separation.lower = std::min(near->lower, answer.separation.lower);
  answer.witness = witness_of_gap(*near);
  answer.relation = near->distance <= options_.contact_distance
                        ? relation_of_contact(a_, b_, {}, options_.contact_distance, work_.pair)
                        : Relation::separate;
  return sag();
}

/// Narrows the bracket of true surfaces by that of their triangles.
void PairEvaluator::narrow_bracket(const SignedSeparation& meshes,
                                   geometry::PrimitiveSeparation& s) const {
  const double lower = std::max(s.lower, meshes.lower - sag());
  const double upper = std::min(s.upper, meshes.upper + sag());
  if (!(lower <= upper)) return;
  s.lower = lower;
  s.upper = upper;
  s.d = std::clamp(s.d, lower, upper);
  if (!(lower > 0)) s.d = std::min(s.d, 0.0);
}

/// Whether any distance in a bracket gives the same result.
bool PairEvaluator::give_same_class(double lower, double upper) const {
  const double band = options_.contact_distance;
  if (lower == upper) return true;
  if (lower <= band && band < upper) return false;
  const auto of = [&](double d) {
    SignedSeparation s = separated_by(d);
    s.sag = sag();
    s.moved = options_.snap + options_.step;
    return classify(s, thresholds_);
  };
  return of(lower) == of(upper);
}

/// Evaluates a primitive beside a mesh by its true surface; returns false where that is not
/// certainly clear of the mesh, and the sag of its triangles has to be counted.
bool PairEvaluator::measure_gap_to_mesh(double reach, PartPairResult& answer) {
  const bool a_is_primitive = a_.placed.part->primitive.has_value();
  const PairOperand &p = a_is_primitive ? part_a_ : part_b_,
                    &m = a_is_primitive ? part_b_ : part_a_;
  const Part& part = *p.treed.placed.part;
  if (!part.primitive || m.treed.placed.part->primitive || p.placement == nullptr ||
      part.kind != PartKind::solid || !(part.sag > 0))
    return false;
  const auto gap =
      geometry::primitive_mesh_distance({&*part.primitive, p.placement}, m.treed, reach);
  if (!gap || !(gap->lower > 0)) return false;
  const double upper = gap->lower >= reach ? gap->lower : gap->upper;
  const Vec3d shift = (m.treed.placed.origin - a_.placed.origin).as<double>();
  geometry::ClosestPair near;
  near.distance = (gap->lower + upper) / 2;
  near.on_a = (a_is_primitive ? gap->on_primitive : gap->on_mesh) + shift;
  near.on_b = (a_is_primitive ? gap->on_mesh : gap->on_primitive) + shift;
  answer.separation = {.d = near.distance, .lower = gap->lower, .upper = upper};
  answer.witness = witness_of_gap(near);
  answer.relation =
      near.distance <= options_.contact_distance ? Relation::abut_outside : Relation::separate;
  return true;
}

/// Whether the parts have the same triangles in the same place: copies are common, and traversing
/// all their contacts says no more.
bool PairEvaluator::equal_solids() const {
  const Part &x = *a_.placed.part, &y = *b_.placed.part;
  return x.kind == PartKind::solid && y.kind == PartKind::solid &&
         a_.placed.origin == b_.placed.origin &&
         (&x == &y || (x.vertices == y.vertices && x.triangles == y.triangles));
}

MeetingResult PairEvaluator::meeting_of_equals() const {
  const Part& part = *a_.placed.part;
  return {.meeting = Meeting::crossing,
          .boundaries_meet = true,
          .a_within_b = true,
          .b_within_a = true,
          .point = part.vertices[part.triangles[0][0]].as<double>(),
          .triangle_a = 0,
          .triangle_b = 0};
}

void PairEvaluator::touching(const MeetingResult& meeting, PartPairResult& answer) {
  answer.witness = witness_of_touch(meeting.point);
  answer.relation = relation_of_contact(a_, b_, meeting, options_.contact_distance, work_.pair);
}

/// Coplanar faces of a rotated model are what the snap has made of them: a little apart, touching,
/// a little deep, or all of it here and there. Within the contact distance that says nothing about
/// the source, and it is one class and one relation: two triangles so near decide it.
bool PairEvaluator::may_be_flush(double gap) const {
  const Part &x = *a_.placed.part, &y = *b_.placed.part;
  const double band = options_.contact_distance;
  if (gap > band || -gap > std::min(band, thresholds_.overlap) || thresholds_.gap < band ||
      x.kind != PartKind::solid || y.kind != PartKind::solid)
    return false;
  // Slivers as thin as the band may be duplicates.
  return std::min(x.thickness(), y.thickness()) >= 4 * band;
}

/// Two triangles so near say nothing of the others, which may cross: the two are apart only where
/// the gap is certain. True surfaces that are known better than the triangles take precedence.
void PairEvaluator::nearly_touching(const geometry::ClosestPair& near,
                                    const geometry::SeparationBound& gap,
                                    PartPairResult& answer) const {
  SignedSeparation meshes = separated_by(near.distance);
  meshes.lower = std::min(gap.lower, meshes.lower);
  if (auto form = closed_form(part_a_, part_b_, reach_of(options_))) {
    narrow_bracket(meshes, form->separation);
    answer = closed_form_result(*form);
    answer.relation = Relation::abut_outside;
    return;
  }
  const bool apart = meshes.lower - sag() > 0;
  if (!apart) meshes.d = std::min(gap.lower, 0.0);
  answer.separation = meshes;
  answer.witness = apart ? witness_of_gap(near)
                         : witness_of_slab((near.on_a + near.on_b) * 0.5, gap.normal, meshes.d);
  answer.relation = Relation::abut_outside;
  conclude(answer);
}

/// Whether moves within a contact distance that is more than may overlap separate two sheets, so
/// that it cannot be known whether they cross.
bool PairEvaluator::may_touch(DepthOptions goal) {
  if (options_.contact_distance <= goal.apart_within) return false;
  if (goal.known_upper <= options_.contact_distance) return true;
  goal.apart_within = options_.contact_distance;
  return depth_of(part_a_, part_b_, goal, work_).upper == 0;
}

void PairEvaluator::interpenetrating(const MeetingResult& meeting, double gap,
                                     PartPairResult& answer) {
  DepthOptions goal;
  goal.known_upper =
      -std::max(gap, geometry::kdop_separation({a_, part_a_.planes}, {b_, part_b_.planes}));
  goal.threshold = thresholds_.overlap;
  // Sheets that moves within the contact distance separate touch: rotated sheets that lie on each
  // other pass to and fro after the snap along lines that mean nothing.
  const bool sheets =
      a_.placed.part->kind == PartKind::sheet && b_.placed.part->kind == PartKind::sheet;
  goal.apart_within = apart_within(*a_.placed.part, *b_.placed.part, options_);
  if (sheets && goal.known_upper <= goal.apart_within) {
    touching(meeting, answer);
    return;
  }
  goal.triangle_a = meeting.triangle_a;
  goal.triangle_b = meeting.triangle_b;
  goal.meeting_point = meeting.point;
  geometry::Depth depth = depth_of(part_a_, part_b_, goal, work_);
  work_.depth_cells += depth.cells;
  if (sheets && depth.upper == 0) {
    touching(meeting, answer);
    return;
  }
  if (sheets && may_touch(goal)) depth.lower = 0;
  if (!(depth.value > 0)) {
    depth.value = kMinDepth;
    depth.point = meeting.point;
  }
  // A move that separates the two bounds the depth of a sheet in a solid as well.
  if (!sheets) depth.upper = std::min(depth.upper, goal.known_upper);
  depth.upper = std::max(depth.upper, depth.value);
  answer.separation = {.d = -depth.value,
                       .lower = -depth.upper,
                       .upper = -depth.lower,
                       .interiors_meet = true,
                       .depth_complete = depth.complete};
  answer.witness = witness_of_depth(a_, b_, depth.point);
  answer.relation = relation_of({a_, part_a_.planes}, {b_, part_b_.planes}, meeting, depth,
                                options_.contact_distance, work_.pair);
}

double PairEvaluator::sag() const { return a_.placed.part->sag + b_.placed.part->sag; }

/// Concludes for parts that touch as tessellated: the true surfaces, where they are known, say how
/// far from that they are, and where. Triangles of a concave surface stand out of it.
void PairEvaluator::conclude_touching(PartPairResult& answer) const {
  const auto form = closed_form(part_a_, part_b_, reach_of(options_));
  if (!form) return conclude(answer);
  const geometry::PrimitiveSeparation& s = form->separation;
  answer.witness = witness_of_touch(form->point);
  conclude(answer, std::min(sag(), std::max(std::fabs(s.lower), std::fabs(s.upper))));
}

void PairEvaluator::conclude(PartPairResult& answer, double sag) const {
  answer.separation.sag = sag;
  answer.separation.moved = options_.snap + options_.step;
  answer.classification = classify(answer.separation, thresholds_);
  answer.classification.flags |= part_flags(*a_.placed.part, *b_.placed.part);
}

std::optional<PartPairResult> evaluate_closed_form(const PairOperand& a, const PairOperand& b,
                                                   const PairTolerances& options) {
  const auto evaluate_ordered = [&](const PairOperand& x,
                                    const PairOperand& y) -> std::optional<PartPairResult> {
    const auto form = closed_form(x, y, reach_of(options));
    if (!form || form->tie) return std::nullopt;
    NarrowWork work;
    return PairEvaluator(x, y, options, work).closed_form_result(*form);
  };
  return evaluate_in_canonical_order(a, b, evaluate_ordered);
}

std::optional<PartPairResult> evaluate_axis_plane_contact(const PairOperand& a,
                                                          const PairOperand& b,
                                                          const PairTolerances& options,
                                                          bool& separated) {
  const auto evaluate_ordered = [&](const PairOperand& x,
                                    const PairOperand& y) -> std::optional<PartPairResult> {
    const auto contact = geometry::find_coplanar_contact(x.treed.placed, y.treed.placed);
    separated = contact.separated;
    if (!contact.touching) return std::nullopt;
    if (may_be_one_sheet(x.treed, y.treed, options.contact_distance)) {
      // The trees decide how much of them lies on the other.
      separated = false;
      return std::nullopt;
    }
    NarrowWork work;
    return PairEvaluator(x, y, options, work).flush(contact.point);
  };
  return evaluate_in_canonical_order(a, b, evaluate_ordered);
}

geometry::SeparationBound separation_lower_bound(const PairOperand& a, const PairOperand& b,
                                                 const PairTolerances& options) {
  const bool ordered = in_canonical_order(a.treed, b.treed);
  const PairOperand &x = ordered ? a : b, &y = ordered ? b : a;
  return geometry::oriented_box_separation(
      {x.treed.placed, x.frame}, {y.treed.placed, y.frame},
      reach_with_sag(*x.treed.placed.part, *y.treed.placed.part, options));
}

std::optional<PartPairResult> evaluate_face_contact(const PairOperand& a, const PairOperand& b,
                                                    const PairTolerances& options,
                                                    const geometry::SeparationBound& gap,
                                                    bool& decided, NarrowWork& work) {
  return evaluate_in_canonical_order(a, b, [&](const PairOperand& x, const PairOperand& y) {
    return PairEvaluator(x, y, options, work).face_contact(gap, decided);
  });
}

PairEvaluation evaluate_intersection(const PairOperand& a, const PairOperand& b,
                                     const PairTolerances& options, const PriorBounds& known,
                                     NarrowWork& work) {
  return evaluate_in_canonical_order(a, b, [&](const PairOperand& x, const PairOperand& y) {
    return PairEvaluator(x, y, options, work).evaluation(known);
  });
}

PartPairResult evaluate_distance(const PairOperand& a, const PairOperand& b,
                                 const PairTolerances& options, double reach, NarrowWork& work) {
  return evaluate_in_canonical_order(a, b, [&](const PairOperand& x, const PairOperand& y) {
    return PairEvaluator(x, y, options, work).distance(reach);
  });
}

PartPairResult evaluate_depth(const PairOperand& a, const PairOperand& b,
                              const PairEvaluation& evaluation, const PriorBounds& known,
                              const PairTolerances& options, NarrowWork& work) {
  return evaluate_in_canonical_order(a, b, [&](const PairOperand& x, const PairOperand& y) {
    return PairEvaluator(x, y, options, work).depth(evaluation, known);
  });
}

}  // namespace strake::clash
