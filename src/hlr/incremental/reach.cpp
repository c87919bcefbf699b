// SPDX-License-Identifier: Apache-2.0
#include "hlr/incremental/reach.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>

#include "hlr/incremental/partial_scene.hpp"
#include "hlr/incremental/solid_boxes.hpp"
#include "strake/hlr/incremental.hpp"
#include "strake/parallel/collect.hpp"
#include "strake/parallel/precomputed.hpp"
#include "strake/parallel/transform.hpp"

namespace strake::hlr {
namespace {

using geometry::Box3l;

// Only shares the work out: between 256 and 4096 no difference can be seen (decision 0073).
constexpr std::size_t kObjectsAtOnce = 1024;
/// Where more than this share of the bodies is needed, all are as quick.
constexpr double kMaxShare = 0.5;
/// What a change means for an object, as far as it is known before its lines are.
enum class ChangeImpact : std::uint8_t {
  none,
  maybe,  ///< something that changed lies over its box
  sure,
};

/// The edges and lines of an object, as queries for what may hide them.
struct ObjectEdges {
  std::uint32_t object = 0;
  bool reached = false;  ///< by what changed
  std::vector<SegmentQuery> queries;
};

/// An object that crosses one whose lines are found anew, and where on paper it may.
struct Crossing {
  std::uint32_t object = 0;
  ViewBox box;
};

class ReachSearch {
 public:
  ReachSearch(const ChangedView& changed, const parallel::Context& context)
      : changed_(changed),
        context_(context),
        paper_(changed.view, changed.whole.box),
        crosses_(changed.options.intersections != Intersections::off),
        hides_(changed.options.stage == Stage::global),
        boxes_(changed_boxes()),
        changes_(boxes_),
        over_changes_(projected_boxes()) {}

  Result<ChangeReach> run() {
    ChangeReach reach;
    if (!std::ranges::all_of(boxes_, [&](const Box3l& box) { return paper_.reaches(box); })) {
      reach.reaches_most = true;
      return reach;
    }
    const auto impacts = find_impacts();
    if (!impacts) return impacts.error();
    std::vector<bool> candidates(impacts->size());
    for (std::size_t o = 0; o < candidates.size(); ++o)
      candidates[o] = (*impacts)[o] != ChangeImpact::none;
    if (reach.reaches_most = is_most(candidates); reach.reaches_most) return reach;
    const auto edges = find_edges(candidates);
    if (!edges) return edges.error();
    reach.to_solve.resize(candidates.size());
    for (const ObjectEdges& one : *edges)
      reach.to_solve[one.object] = one.reached || (*impacts)[one.object] == ChangeImpact::sure;
    if (const Status status = find_needed(*edges, reach); !status) return status.error();
    reach.reaches_most = is_most(reach.needed);
    return reach;
  }

 private:
  [[nodiscard]] bool is_changed(std::size_t object) const {
    return changed_.comparison.before[object] == model::kNoObject;
  }

  [[nodiscard]] std::vector<Box3l> changed_boxes() const {
    std::vector<Box3l> boxes;
    for (const Box3l& box : changed_.comparison.left)
      if (!box.empty()) boxes.push_back(box);
    for (std::size_t o = 0; changed_.comparison.changed > 0 && o < changed_.boxes.size(); ++o)
      if (is_changed(o) && !changed_.boxes[o].empty()) boxes.push_back(changed_.boxes[o]);
    return boxes;
  }

  [[nodiscard]] std::vector<ViewBox> projected_boxes() const {
    std::vector<ViewBox> on_paper;
    for (const Box3l& box : boxes_)
      on_paper.push_back(paper_.reaches(box) ? paper_.box_of(box) : ViewBox());
    return on_paper;
  }

  [[nodiscard]] bool is_under_changes(const SegmentQuery& query) const {
    bool any = false;
    over_changes_.traverse(query, [&](std::uint32_t) {
      any = true;
      return false;
    });
    return any;
  }

  [[nodiscard]] ChangeImpact impact_of(std::size_t o) const {
    const Box3l& box = changed_.boxes[o];
    if (!changed_.draws(o)) return ChangeImpact::none;
    if (is_changed(o) || (crosses_ && changes_.any_meets(box))) return ChangeImpact::sure;
    if (!hides_ || box.empty()) return ChangeImpact::none;
    const ViewBox on_paper = paper_.box_of(box.inflated(kRounded));
    return !on_paper.empty() && is_under_changes(anything_in(on_paper)) ? ChangeImpact::maybe
                                                                        : ChangeImpact::none;
  }

  [[nodiscard]] Result<std::vector<ChangeImpact>> find_impacts() const {
    return parallel::transform(
        context_,
        {.name = "what changes concern", .n = changed_.boxes.size(), .grain = kObjectsAtOnce},
        [&](std::size_t o) { return impact_of(o); });
  }

  [[nodiscard]] bool is_most(const std::vector<bool>& objects) const {
    std::size_t bodies = 0;
    for (std::size_t o = 0; o < objects.size(); ++o)
      if (objects[o]) bodies += changed_.scene.first_body[o + 1] - changed_.scene.first_body[o];
    return static_cast<double>(bodies) >
           kMaxShare * static_cast<double>(changed_.scene.bodies.size());
  }

  /// Finds the edges and lines of some objects. The lines are those that these objects alone make:
  /// where another one is missing, neither it nor its lines lie under what changed.
  Result<std::vector<ObjectEdges>> find_edges(const std::vector<bool>& objects) const {
    if (!hides_) return edges_that_nothing_hides(objects);
    const PartialScene part = scene_of(changed_.scene, objects);
    WholeView whole = changed_.whole;
    whole.tessellation = part.plan(changed_.tessellation);
    whole.to_solve = objects;
    const Result<ViewJob> job =
        prepare_view({part.scene, objects, changed_.view, changed_.options, &whole}, context_);
    if (!job) return job.error();
    const std::vector<std::uint32_t> numbers = parallel::keys_of(objects);
    return parallel::transform(context_, {.name = "edges near changes", .n = numbers.size()},
                               [&](std::size_t i) { return edges_of(*job, numbers[i]); });
  }

  static Result<std::vector<ObjectEdges>> edges_that_nothing_hides(
      const std::vector<bool>& objects) {
    std::vector<ObjectEdges> all;
    for (const std::uint32_t object : parallel::keys_of(objects))
      all.push_back({.object = object, .queries = {}});
    return all;
  }

  [[nodiscard]] Result<ObjectEdges> edges_of(const ViewJob& job, std::uint32_t object) const {
    ObjectEdges all{.object = object, .queries = {}};
    const auto add = [&](const geometry::Vec3l& a, const geometry::Vec3l& b) {
      const auto query = paper_.edge(a, b);
      if (!query) return;
      all.reached = all.reached || is_under_changes(*query);
      all.queries.push_back(*query);
    };
    const auto& first_body = job.scene->first_body;
    for (std::uint32_t b = first_body[object]; b < first_body[object + 1]; ++b) {
      const model::GridBody& body = job.scene->bodies[b];
      const auto edges = sectioned_edges(job.sectioned_shape_of(b), job.features_of(body), {});
      if (!edges) return edges.error();
      for (const FeatureEdge& e : *edges)
        add(e.a.as<std::int64_t>() + body.origin, e.b.as<std::int64_t>() + body.origin);
    }
    for (const Line& line : job.lines.of(object)) add(line.a, line.b);
    return all;
  }

  /// Finds what crosses the objects that are requested and is drawn after them.
  [[nodiscard]] Result<std::vector<Crossing>> find_crossings(const ChangeReach& reach) const {
    if (!crosses_) return std::vector<Crossing>{};
    const std::vector<std::uint32_t> numbers = parallel::keys_of(reach.to_solve);
    std::vector<Box3l> boxes;
    for (const std::uint32_t object : numbers) boxes.push_back(changed_.boxes[object]);
    const SolidBoxes to_solve(std::move(boxes));
    return parallel::collect<Crossing>(
        context_,
        {.name = "what crosses changes", .n = changed_.boxes.size(), .grain = kObjectsAtOnce},
        [&](std::size_t o, std::vector<Crossing>& out) {
          const auto object = static_cast<std::uint32_t>(o);
          const Box3l& box = changed_.boxes[o];
          to_solve.for_each_that_meets(box, [&](std::uint32_t i) {
            if (numbers[i] < object)
              out.push_back(
                  {object,
                   paper_.box_of(box.common(changed_.boxes[numbers[i]]).inflated(kRounded))});
            return true;
          });
        });
  }

  [[nodiscard]] bool may_hide(const OccludeeTree& to_solve, std::size_t object) const {
    const Box3l& box = changed_.boxes[object];
    if (box.empty()) return false;
    const auto& perspective = changed_.view.perspective;
    // What the eye lies in is reported.
    if (perspective && box.contains({perspective->eye, perspective->eye})) return true;
    return hides_ && to_solve.may_be_hidden_by(paper_.box_of(box));
  }

  Status find_needed(const std::vector<ObjectEdges>& edges, ChangeReach& reach) const {
    reach.needed = reach.to_solve;
    const auto crossings = find_crossings(reach);
    if (!crossings) return crossings.error();
    std::vector<SegmentQuery> queries;
    for (const Crossing& crossing : *crossings) {
      reach.needed[crossing.object] = true;
      if (!crossing.box.empty()) queries.push_back(anything_in(crossing.box));
    }
    for (const ObjectEdges& one : edges)
      if (reach.to_solve[one.object])
        queries.insert(queries.end(), one.queries.begin(), one.queries.end());
    const OccludeeTree to_solve(std::move(queries));
    const auto hiding = parallel::collect<std::uint32_t>(
        context_,
        {.name = "what hides changes", .n = changed_.boxes.size(), .grain = kObjectsAtOnce},
        [&](std::size_t o, std::vector<std::uint32_t>& out) {
          if (!reach.needed[o] && may_hide(to_solve, o))
            out.push_back(static_cast<std::uint32_t>(o));
        });
    if (!hiding) return hiding.error();
    for (const std::uint32_t object : *hiding) reach.needed[object] = true;
    return {};
  }

  const ChangedView& changed_;
  const parallel::Context& context_;
  BoundsProjection paper_;
  bool crosses_, hides_;
  std::vector<Box3l> boxes_;  ///< of what changed, as it was and as it is
  SolidBoxes changes_;        ///< the same
  ViewBvh over_changes_;      ///< the same on paper
};

}  // namespace

Result<ChangeReach> find_reach(const ChangedView& changed, const parallel::Context& context) {
  return ReachSearch(changed, context).run();
}

}  // namespace strake::hlr
