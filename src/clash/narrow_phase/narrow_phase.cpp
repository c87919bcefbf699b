// SPDX-License-Identifier: Apache-2.0
// Decision 0035 says who is told of what lies within an open surface.
#include "clash/narrow_phase/narrow_phase.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "clash/narrow_phase/pair_evaluator.hpp"
#include "clash/narrow_phase/pair_tolerances.hpp"
#include "clash/narrow_phase/sphere_subdivision.hpp"
#include "clash/narrow_phase/wire_clash.hpp"
#include "geometry/distance/winding_number.hpp"
#include "geometry/mesh_repair/face_holes.hpp"
#include "strake/parallel/for_each.hpp"

namespace strake::clash {
namespace {

bool is_too_large(const ScenePart& a, const ScenePart& b) {
  return !geometry::fits_pair(a.placed, b.placed);
}

class ExactNarrowPhase {
 public:
  ExactNarrowPhase(const StageInputs& stage, const EvaluatedPairs& evaluated,
                   std::vector<Candidate>& candidates)
      : stage_(stage),
        work_(stage.work),
        cache_(stage.cache),
        evaluated_(evaluated),
        candidates_(candidates) {}

  Status run() {
    if (const Status s = evaluate_simple_pairs(); !s) return s;
    if (const Status s = separate_distant_pairs(); !s) return s;
    if (const Status s = evaluate_intersections(); !s) return s;
    if (const Status s = depths(); !s) return s;
    return distances();
  }

 private:
  /// Evaluates closed forms and contacts in coordinate planes, which are most pairs and need no
  /// trees.
  Status evaluate_simple_pairs() {
    return parallel::for_each(
        work_.context(), {.name = "simple pairs", .n = work_.size(), .grain = PairTasks::kGrain},
        [&](std::size_t i) {
          const ScenePart &a = work_.a(i), &b = work_.b(i);
          Candidate& c = candidates_[i];
          c.too_large = is_too_large(a, b);
          if (c.too_large) return;
          if (has_wire(*a.placed.part, *b.placed.part)) return;
          const PairOperand x = cache_.bare(a), y = cache_.bare(b);
          const PairTolerances options = stage_.pair_tolerances.of(a, b);
          auto answer = evaluate_closed_form(x, y, options);
          if (!answer) answer = evaluate_axis_plane_contact(x, y, options, c.known.separated);
          c.done = answer.has_value();
          if (c.done) c.evaluation.answer = *answer;
        });
  }

  [[nodiscard]] Result<std::vector<std::size_t>> open_cases(std::string_view name) const {
    return work_.filter(
        name, [&](std::size_t i) { return !candidates_[i].done && !candidates_[i].too_large; });
  }

  /// Separates rotated parts: their boxes along the coordinate axes overlap far more often than the
  /// bodies do.
  Status separate_distant_pairs() {
    const auto unsettled = open_cases("unsettled pairs");
    if (!unsettled) return unsettled.error();
    if (const Status s = cache_.ensure_frames(work_.parts_of(*unsettled), work_.context()); !s)
      return s;
    const Status status = work_.for_each_of(
        *unsettled, "oriented boxes", PairTasks::kGrain,
        [&](std::size_t i, const ScenePart& a, const ScenePart& b) {
          const PairTolerances options = stage_.pair_tolerances.of(a, b);
          Candidate& c = candidates_[i];
          const PairOperand x = cache_.framed(a), y = cache_.framed(b);
          const geometry::SeparationBound gap = separation_lower_bound(x, y, options);
          c.known.gap = gap;
          c.done = gap.lower >= reach_with_sag(*a.placed.part, *b.placed.part, options);
          if (c.done || has_wire(*a.placed.part, *b.placed.part)) return;
          const auto flush = with_cost(c, work_.context(), [&](NarrowWork& work) {
            return evaluate_face_contact(x, y, options, gap, c.known.known_not_flush, work);
          });
          c.done = flush.has_value();
          if (flush) c.evaluation.answer = *flush;
        });
    if (!status) return status;
    auto open = open_cases("open pairs");
    if (!open) return open.error();
    open_ = std::move(*open);
    return {};
  }

  Status evaluate_intersections() {
    if (const Status s = cache_.ensure_trees(work_.parts_of(open_), work_.context()); !s) return s;
    return work_.for_each_of(open_, "narrow phase", PairTasks::kGrain,
                             [&](std::size_t i, const ScenePart& a, const ScenePart& b) {
                               Candidate& c = candidates_[i];
                               const PairOperand x = cache_.treed(a), y = cache_.treed(b);
                               const PairTolerances options = stage_.pair_tolerances.of(a, b);
                               c.evaluation = with_cost(c, work_.context(), [&](NarrowWork& work) {
                                 if (!has_wire(*a.placed.part, *b.placed.part))
                                   return evaluate_intersection(x, y, options, c.known, work);
                                 PairEvaluation evaluation;
                                 evaluation.answer = evaluate_wire(x, y, options, work);
                                 return evaluation;
                               });
                             });
  }

  Status depths() {
    std::vector<std::size_t> deep;
    for (const std::size_t i : open_)
      if (candidates_[i].evaluation.next == PairEvaluation::Next::depth) deep.push_back(i);
    if (const Status s = cache_.ensure_planes(work_.parts_of(deep), work_.context()); !s) return s;
    return work_.for_each_of(
        deep, "depth", 1, [&](std::size_t i, const ScenePart& a, const ScenePart& b) {
          Candidate& c = candidates_[i];
          c.evaluation.answer = with_cost(c, work_.context(), [&](NarrowWork& work) {
            return evaluate_depth(cache_.planed(a), cache_.planed(b), c.evaluation, c.known,
                                  stage_.pair_tolerances.of(a, b), work);
          });
        });
  }

  /// A unique pair whose distance, up to `far`, may affect the result of a pair of objects.
  struct DistanceRequest {
    std::uint32_t number = 0;
    double far = 0;
  };

  /// Computes how far apart the others are; where two objects meet, only as far as it could matter.
  Status distances() {
    const auto wanted = parallel::collect<DistanceRequest>(
        work_.context(),
        {.name = "distances wanted", .n = stage_.objects.size(), .grain = PairTasks::kBlock},
        [&](std::size_t k, std::vector<DistanceRequest>& out) {
          collect_distance_requests(k, out);
        });
    if (!wanted) return wanted.error();
    std::vector<double> reach(candidates_.size(), 0);
    for (const DistanceRequest& w : *wanted) reach[w.number] = std::max(reach[w.number], w.far);
    std::vector<std::size_t> apart;
    for (std::size_t i = 0; i < reach.size(); ++i)
      if (reach[i] > 0) apart.push_back(i);
    return work_.for_each_of(
        apart, "distance", PairTasks::kGrain,
        [&](std::size_t i, const ScenePart& a, const ScenePart& b) {
          Candidate& c = candidates_[i];
          c.evaluation.answer = with_cost(c, work_.context(), [&](NarrowWork& work) {
            return evaluate_distance(cache_.treed(a), cache_.treed(b),
                                     stage_.pair_tolerances.of(a, b), reach[i], work);
          });
        });
  }

  /// Collects how far the distances of one pair of objects' parts may affect its result. Parts that
  /// meet are more severe than parts that are apart, unless the sag of those hides that they meet
  /// too. Whether regions are listed makes no difference: the result is the same without them.
  void collect_distance_requests(std::size_t objects, std::vector<DistanceRequest>& wanted) const {
    const std::size_t first = stage_.objects.begin(objects), end = stage_.objects.end(objects);
    bool meeting = false;
    // Where a rule may allow the worst of them, each of the others counts, and where pairs are
    // reported for parts that are apart.
    const bool all = stage_.options.reporting.relations.contains(Relation::separate) ||
                     stage_.rules.may_allow(evaluated_.a(first).object, evaluated_.b(first).object);
    for (std::size_t i = first; i < end && !all; ++i) {
      const PartPairResult& answer = evaluated_.of(i).evaluation.answer;
      meeting = meeting || answer.classification.cls == Class::hit ||
                (answer.classification.cls >= Class::contact && answer.separation.d <= 0);
    }
    for (std::size_t i = first; i < end; ++i) {
      if (evaluated_.of(i).evaluation.next != PairEvaluation::Next::distance) continue;
      double far = std::numeric_limits<double>::infinity();
      if (meeting) {
        const ScenePart &a = evaluated_.a(i), &b = evaluated_.b(i);
        const double sag = a.placed.part->sag + b.placed.part->sag;
        // Parts so near may be a contact elsewhere, or as deep as the worst.
        const PairTolerances options = stage_.pair_tolerances.of(a, b);
        far = sag + std::max(options.touch_gap, options.step) + kSnapMargin;
      }
      wanted.push_back({evaluated_.unique_pairs.of[i], far});
    }
  }

  const StageInputs& stage_;
  const PairTasks& work_;
  AccelerationCache& cache_;
  const EvaluatedPairs& evaluated_;
  std::vector<Candidate>& candidates_;
  std::vector<std::size_t> open_;  ///< unique pairs that need trees
};

}  // namespace

Status run_exact_narrow_phase(const StageInputs& stage, const EvaluatedPairs& evaluated,
                              std::vector<Candidate>& candidates) {
  return ExactNarrowPhase(stage, evaluated, candidates).run();
}

Status run_sphere_narrow_phase(const StageInputs& stage, std::vector<Candidate>& candidates) {
  std::vector<std::size_t> open;
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    candidates[i].too_large = is_too_large(stage.work.a(i), stage.work.b(i));
    if (!candidates[i].too_large) open.push_back(i);
  }
  const Status trees_made =
      stage.cache.ensure_trees(stage.work.parts_of(open), stage.work.context());
  if (!trees_made) return trees_made;
  return stage.work.for_each_of(
      open, "sphere subdivision", 1, [&](std::size_t i, const ScenePart& a, const ScenePart& b) {
        Candidate& c = candidates[i];
        c.evaluation.answer = with_cost(c, stage.work.context(), [&](NarrowWork& work) {
          return evaluate_by_spheres(stage.cache.treed(a), stage.cache.treed(b),
                                     stage.pair_tolerances.of(a, b),
                                     stage.options.engine.max_spheres, work);
        });
      });
}

namespace {

using geometry::PartKind;
using geometry::Vec3d;
using geometry::WindingNumber;

/// Whether a part of `within` may lie within `around`; not all of it must, as it may reach out
/// through the gap.
bool may_enclose(const ScenePart& around, const ScenePart& within) {
  const geometry::Part &a = *around.placed.part, &b = *within.placed.part;
  return a.kind == PartKind::sheet && b.kind != PartKind::wire &&
         !a.box.as<std::int64_t>()
              .moved(around.placed.origin)
              .common(b.box.as<std::int64_t>().moved(within.placed.origin))
              .empty();
}

/// Returns about eight corners of a part, of those in the box of the other, in its coordinates.
/// Every second corner of a box, in the order of coordinates, may lie on the floor.
std::vector<Vec3d> corners_in_box(const ScenePart& around, const ScenePart& within) {
  constexpr std::size_t kSampledCorners = 8;
  const geometry::Vec3l shift = within.placed.origin - around.placed.origin;
  const geometry::Box3l box = around.placed.part->box.as<std::int64_t>();
  std::vector<Vec3d> corners;
  for (const geometry::Vec3i& v : within.placed.part->vertices) {
    const geometry::Vec3l at = v.as<std::int64_t>() + shift;
    if (box.contains({at, at})) corners.push_back(at.as<double>());
  }
  const std::size_t step = (corners.size() / kSampledCorners) | 1U;
  std::vector<Vec3d> samples;
  for (std::size_t v = 0; v < corners.size(); v += step) samples.push_back(corners[v]);
  return samples;
}

/// Whether there are such corners.
bool has_corner_in_box(const ScenePart& around, const ScenePart& within) {
  const geometry::Vec3l shift = within.placed.origin - around.placed.origin;
  const geometry::Box3l box = around.placed.part->box.as<std::int64_t>();
  return std::ranges::any_of(within.placed.part->vertices, [&](const geometry::Vec3i& v) {
    const geometry::Vec3l at = v.as<std::int64_t>() + shift;
    return box.contains({at, at});
  });
}

/// Whether a corner of a part lies within, and not on the surface: then points a little to either
/// side of it are within, too.
bool lies_within(const WindingNumber& winding, const ScenePart& around, const ScenePart& within) {
  constexpr double kLittle = 16;
  const geometry::Box3d box = within.placed.part->box.as<double>().moved(
      (within.placed.origin - around.placed.origin).as<double>());
  const Vec3d middle = (box.lo + box.hi) * 0.5;
  return std::ranges::any_of(corners_in_box(around, within), [&](const Vec3d& corner) {
    const Vec3d way = middle - corner;
    const double length = std::sqrt(dot(way, way));
    const Vec3d off = length > 0 ? way * (kLittle / length) : Vec3d{};
    return winding.surrounds(corner + off) && winding.surrounds(corner - off);
  });
}

/// A surface with how open it is, and how open it may be.
struct EnclosingSurface {
  WindingNumber winding;
  double openness = 1, max_openness = 0;
};

/// The share of the directions within a surface that may lead out on average, if it is to be meant
/// as a body: where surfaces are apart, where it lacks pieces of flat faces alone, and where they
/// touch, which is reported already, but not as what it may be.
constexpr double kMaxOut = 0.05, kMaxOutOfFaces = 0.25, kMaxOutOfContact = 0.01;

bool may_be_hit(const Candidate& c) {
  const Classification& j = c.evaluation.answer.classification;
  return !c.too_large &&
         (j.cls < Class::contact || (j.cls == Class::contact && j.severest < Class::hit));
}

}  // namespace

Status mark_enclosed(const StageInputs& stage, std::vector<Candidate>& candidates) {
  const PairTasks& work = stage.work;
  const auto enclosable = work.filter("pairs within open surfaces", [&](std::size_t i) {
    return may_be_hit(candidates[i]) &&
           (may_enclose(work.a(i), work.b(i)) || may_enclose(work.b(i), work.a(i)));
  });
  if (!enclosable) return enclosable.error();
  if (enclosable->empty()) return {};
  std::vector<const geometry::Part*> parts(work.parts_of({}).size(), nullptr);
  for (const std::size_t i : *enclosable) {
    const ScenePart &a = work.a(i), &b = work.b(i);
    // A surface of which nobody will ask is not measured.
    if (may_enclose(a, b) && has_corner_in_box(a, b)) parts[a.unique] = a.placed.part;
    if (may_enclose(b, a) && has_corner_in_box(b, a)) parts[b.unique] = b.placed.part;
  }
  std::vector<std::optional<EnclosingSurface>> around(parts.size());
  const Status made =
      parallel::for_each(work.context(), {.name = "winding numbers", .n = parts.size(), .grain = 1},
                         [&](std::size_t p) {
                           if (parts[p] == nullptr) return;
                           WindingNumber winding(*parts[p]);
                           const double max_openness =
                               geometry::has_incomplete_faces(*parts[p]) ? kMaxOutOfFaces : kMaxOut;
                           const double openness = winding.openness(max_openness);
                           if (openness <= max_openness)
                             around[p] = {std::move(winding), openness, max_openness};
                         });
  if (!made) return made.error();
  return work.for_each_of(
      *enclosable, "pairs within open surfaces", PairTasks::kGrain,
      [&](std::size_t i, const ScenePart& a, const ScenePart& b) {
        Classification& classification = candidates[i].evaluation.answer.classification;
        const bool touch = classification.cls == Class::contact;
        const auto within = [&](const ScenePart& skin, const ScenePart& part) {
          const auto& of = around[skin.unique];
          return of && of->openness <= (touch ? kMaxOutOfContact : of->max_openness) &&
                 may_enclose(skin, part) && lies_within(of->winding, skin, part);
        };
        if (!within(a, b) && !within(b, a)) return;
        if (touch) {
          classification.severest = Class::hit;
          classification.flags |= kUncertain;
        } else {
          candidates[i].in_open = true;
        }
      });
}

}  // namespace strake::clash
