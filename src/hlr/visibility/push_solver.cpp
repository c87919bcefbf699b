// SPDX-License-Identifier: Apache-2.0
// The baseline of the benchmarks, after the scheme of the source thesis (D. Sanz Villafruela): each
// body publishes what it hides into the edges of the objects under it, each of which is locked
// while it is written. The union of what hides an edge does not depend on who comes first, so the
// pieces are those of the engine; how many faces are tested does depend on it.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numeric>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "hlr/prepare/view_job.hpp"
#include "hlr/view/view_bvh.hpp"
#include "hlr/visibility/edge_piece_builder.hpp"
#include "hlr/visibility/gather_solver.hpp"
#include "hlr/visibility/visibility_intervals.hpp"
#include "hlr/visibility/visibility_scene.hpp"
#include "strake/hlr/steps.hpp"
#include "strake/parallel/collect.hpp"
#include "strake/parallel/for_each.hpp"
#include "strake/parallel/item_locks.hpp"
#include "strake/parallel/marks.hpp"
#include "strake/parallel/report.hpp"

namespace strake::hlr {
namespace {

/// An edge under occluders, and the intervals published into it.
struct TargetEdge {
  EdgeQuery edge;
  RationalParam lo = RationalParam::zero(), hi = RationalParam::one();
  OpenRange open;
  std::vector<OcclusionInterval> intervals;
  bool needs_intervals = false;

  void add(const OcclusionInterval& interval) {
    if (open.empty()) return;
    intervals.push_back(interval);
    open.shrink_all(intervals);
  }
};

/// The edges of an object. What its own faces hide of them is known from the start.
struct TargetObject {
  std::vector<TargetEdge> edges;
  /// By edge: whether nothing of it is left to be hidden. It is read without the lock: a worker
  /// that does not see it yet tests in vain.
  parallel::Marks done;
  ViewBox box;
};

/// Returns a double that is no greater.
double rounded_down(std::int64_t value) {
  const auto near = static_cast<double>(value);
  return near - std::fabs(near) * 1e-15 - 1;
}

class Pusher {
 public:
  Pusher(const VisibilityScene& visibility, std::vector<TargetObject>& objects, const ViewBvh& tree,
         parallel::ItemLocks& locks)
      : visibility_(visibility),
        objects_(objects),
        tree_(tree),
        locks_(locks),
        gatherer_(visibility) {}

  SolverWork run(std::uint32_t over) {
    const BodyInstance& placed = visibility_.placed[over];
    if (!placed.opaque || placed.shape->box.empty()) return {};
    const ViewBox box = placed.shape->box.moved(placed.at);
    SegmentQuery query;
    query.u0 = rounded_down(box.lo.u);
    query.u1 = -rounded_down(-box.hi.u);
    query.v0 = rounded_down(box.lo.v);
    query.v1 = -rounded_down(-box.hi.v);
    query.w0 = rounded_down(-box.hi.w);
    tree_.traverse(query, [&](std::uint32_t under) {
      if (under != placed.object) publish(over, under);
      return true;
    });
    return std::exchange(gatherer_.work, {});
  }

 private:
  void publish(std::uint32_t over, std::uint32_t under) {
    TargetObject& object = objects_[under];
    const std::uint32_t over_object = visibility_.placed[over].object;
    found_.clear();
    for (std::uint32_t e = 0; e < object.edges.size(); ++e) {
      if (object.done.is_set(e)) continue;
      const TargetEdge& edge = object.edges[e];
      if (edge.edge.other->object == over_object) continue;
      for (const OcclusionInterval& interval :
           gatherer_.intervals_of_body(edge.edge, over, edge.lo, edge.hi))
        found_.emplace_back(e, interval);
    }
    if (found_.empty()) return;
    const auto held = locks_.hold(under);
    for (const auto& [e, interval] : found_) {
      TargetEdge& edge = object.edges[e];
      edge.add(interval);
      if (edge.open.empty()) object.done.set(e);
    }
  }

  const VisibilityScene& visibility_;
  std::vector<TargetObject>& objects_;
  const ViewBvh& tree_;
  parallel::ItemLocks& locks_;
  OccluderGatherer gatherer_;
  std::vector<std::pair<std::uint32_t, OcclusionInterval>> found_;
};

/// Returns the edges of an object in their order, with the intervals that its own faces hide.
TargetObject local_step(const VisibilityScene& visibility, std::uint32_t object,
                        OccluderGatherer& gatherer, EdgePieceBuilder& builder) {
  TargetObject result;
  const auto add = [&](const EdgeQuery& edge) {
    ++gatherer.work.edges;
    TargetEdge under;
    under.edge = edge;
    under.needs_intervals = builder.begin(edge);
    if (under.needs_intervals) {
      under.lo = builder.lo();
      under.hi = builder.hi();
      under.open = OpenRange(under.lo, under.hi);
      const auto intervals = gatherer.self_occlusion(edge, under.lo, under.hi);
      under.intervals.assign(intervals.begin(), intervals.end());
      if (!intervals.empty()) under.open.shrink_all(intervals);
      result.box.include(gatherer.box());
    }
    result.edges.push_back(std::move(under));
  };
  const auto& first = visibility.job.scene->first_body;
  for (std::uint32_t b = first[object]; b < first[object + 1]; ++b) {
    if (visibility.placed[b].shape == nullptr) continue;
    for (const ProjectedEdge& e : visibility.placed[b].shape->edges)
      add(EdgeQuery(visibility, b, e));
  }
  for (const Line& line : visibility.job.lines.of(object)) add(EdgeQuery(visibility, line));
  result.done = parallel::Marks(result.edges.size());
  for (std::size_t e = 0; e < result.edges.size(); ++e)
    if (!result.edges[e].needs_intervals || result.edges[e].open.empty()) result.done.set(e);
  return result;
}

/// Builds a hierarchy over the objects' boxes with the depth reversed: the farthest comes first, so
/// that a query finds the boxes that reach below it.
ViewBvh tree_of(const std::vector<TargetObject>& objects) {
  std::vector<ViewBox> boxes(objects.size());
  for (std::size_t o = 0; o < objects.size(); ++o) {
    if (objects[o].box.empty()) continue;
    boxes[o] = objects[o].box;
    boxes[o].lo.w = -objects[o].box.hi.w;
    boxes[o].hi.w = -objects[o].box.lo.w;
  }
  return ViewBvh(boxes);
}

/// Returns the bodies that may hide, the nearest first; of equal depth the lower number, so that
/// the order is total.
std::vector<std::uint32_t> nearest_first(const VisibilityScene& visibility) {
  std::vector<std::uint32_t> order(visibility.placed.size());
  std::iota(order.begin(), order.end(), 0U);
  const auto depth = [&](std::uint32_t b) {
    const BodyInstance& placed = visibility.placed[b];
    return placed.shape == nullptr || placed.shape->box.empty()
               ? std::numeric_limits<std::int64_t>::min()
               : placed.shape->box.hi.w + placed.at.w;
  };
  std::ranges::sort(order, [&](std::uint32_t a, std::uint32_t b) {
    const std::int64_t at_a = depth(a), at_b = depth(b);
    return at_a != at_b ? at_a > at_b : a < b;
  });
  return order;
}

}  // namespace

Result<SpeckedObjects> solve_push(const ViewJob& job, const parallel::Context& context,
                                  Drawing& drawing) {
  const Result<VisibilityScene> made = make_visibility_scene(job, context);
  if (!made) return made.error();
  const VisibilityScene& visibility = *made;
  const Result<SpeckRule> made_rule = SpeckRule::of(job, context);
  if (!made_rule) return made_rule.error();
  const SpeckRule& rule = *made_rule;
  std::vector<TargetObject> objects(job.drawn.size());
  std::vector<SolverWork> work(objects.size() + visibility.placed.size());
  struct Local {
    OccluderGatherer gatherer;
    EdgePieceBuilder builder;
  };
  std::optional<parallel::StageTimer> timer(std::in_place, context.report, kLocalStep);
  const Status local = parallel::for_each_with(
      context, {.name = "push: local step", .n = objects.size()},
      [&] { return Local{OccluderGatherer(visibility), EdgePieceBuilder(visibility, rule)}; },
      [&](Local& own, std::size_t o) {
        if (!job.drawn[o]) return;
        objects[o] =
            local_step(visibility, static_cast<std::uint32_t>(o), own.gatherer, own.builder);
        work[o] = std::exchange(own.gatherer.work, {});
      });
  if (!local) return local.error();
  timer.reset();
  if (job.options.stage == Stage::global) {
    timer.emplace(context.report, kGlobalStep);
    const ViewBvh tree = tree_of(objects);
    parallel::ItemLocks locks(objects.size());
    const std::vector<std::uint32_t> order = nearest_first(visibility);
    const Status global = parallel::for_each_with(
        context, {.name = "push: global step", .n = order.size(), .order = order},
        [&] { return Pusher(visibility, objects, tree, locks); },
        [&](Pusher& pusher, std::size_t body) {
          work[objects.size() + body] = pusher.run(static_cast<std::uint32_t>(body));
        });
    if (!global) return global.error();
    timer.reset();
  }
  Result<std::vector<EdgePiece>> pieces = parallel::collect_with<EdgePiece>(
      context, {.name = "push: pieces", .n = objects.size()},
      [&] { return EdgePieceBuilder(visibility, rule); },
      [&](EdgePieceBuilder& builder, std::size_t o, std::vector<EdgePiece>& out) {
        for (std::uint32_t e = 0; e < objects[o].edges.size(); ++e) {
          const TargetEdge& under = objects[o].edges[e];
          static_cast<void>(builder.begin(under.edge));
          const EdgePieceBuilder::Outcome outcome = builder.finish(e, under.intervals, out);
          work[o].specks += outcome.specks;
          if (outcome.left_out.hidden) ++drawing.left_out[o];
          if (outcome.left_out.clipped > 0) drawing.clipped_left_out[o] += outcome.left_out.clipped;
          if (outcome.specked) work[o].specked = true;
        }
      });
  if (!pieces) return pieces.error();
  drawing.pieces = std::move(pieces).value();
  for (const SolverWork& w : work) add(drawing.counters, w);
  SpeckedObjects specked(objects.size());
  for (std::size_t o = 0; o < objects.size(); ++o) {
    add(drawing.counted[o], work[o]);
    specked[o] = work[o].specked ? 1 : 0;
  }
  return specked;
}

}  // namespace strake::hlr
