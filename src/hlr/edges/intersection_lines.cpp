// SPDX-License-Identifier: Apache-2.0
#include "hlr/edges/intersection_lines.hpp"

#include <algorithm>
#include <cstddef>
#include <limits>
#include <numeric>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>

#include "geometry/bvh/scene_bvh.hpp"
#include "geometry/intersect/intersection_lines.hpp"
#include "geometry/obb/oriented_box.hpp"
#include "hlr/edges/element_loop.hpp"
#include "hlr/edges/joint_lines.hpp"
#include "strake/geometry/triangle_bvh.hpp"
#include "strake/parallel/allowance.hpp"
#include "strake/parallel/collect.hpp"
#include "strake/parallel/count_fill.hpp"
#include "strake/parallel/distinct.hpp"
#include "strake/parallel/order.hpp"
#include "strake/parallel/precomputed.hpp"
#include "strake/parallel/transform.hpp"

namespace strake::hlr {
namespace {

using geometry::IndexPair;
using geometry::Segment;
using geometry::Vec3l;
using parallel::Region;

// Only shares the work out: between 256 and 4096 no difference can be seen (decision 0073).
constexpr std::size_t kGrain = 1024;
/// The most intersection lines, and more of them for each triangle: many times what models have,
/// and in proportion to the file, where triangles that all cross each other have the square.
constexpr std::uint64_t kMaxLines = 1000000, kMaxLinesOfTriangle = 100;

/// A part that has faces, with its place.
struct PlacedSurface {
  geometry::PlacedPart placed;
  std::uint32_t unique = 0;  ///< its number among the parts of all shapes
  std::uint32_t body = 0;
  std::int64_t contact = 0;
};

struct SurfaceList {
  std::vector<const geometry::Part*> unique;  ///< parts of all shapes
  std::vector<PlacedSurface> placed;          ///< by body
};

geometry::Box3l box_of(const geometry::Part& part, const model::GridBody& body) {
  return part.box.as<std::int64_t>().moved(body.origin);
}

Result<SurfaceList> list_surfaces(const model::Scene& scene, const std::vector<bool>& drawn,
                                  const std::vector<std::int64_t>& contact,
                                  const IntersectionRule& rule, const parallel::Context& context) {
  // A line lies in the boxes of both of its parts, rounded as it is.
  const auto shows = [&](const geometry::Box3l& box) { return !rule.shows || rule.shows(box); };
  SurfaceList surfaces;
  std::vector<std::uint32_t> first;
  for (const model::GridShape& shape : scene.shapes) {
    first.push_back(static_cast<std::uint32_t>(surfaces.unique.size()));
    for (const geometry::Part& part : shape.parts) surfaces.unique.push_back(&part);
  }
  auto placed = parallel::collect<PlacedSurface>(
      context, {.name = "intersections: surfaces", .n = scene.bodies.size(), .grain = kGrain},
      [&](std::size_t b, std::vector<PlacedSurface>& out) {
        const model::GridBody& body = scene.bodies[b];
        if (!drawn[model::index(body.object)]) return;
        const model::GridShape& shape = scene.shapes[body.grid_shape];
        if (shape.box.empty() || !shows(body.box(shape))) return;
        std::uint32_t number = first[body.grid_shape];
        for (const geometry::Part& part : shape.parts) {
          if (!part.triangles.empty() && shows(box_of(part, body)))
            out.push_back(
                {{&part, body.origin}, number, static_cast<std::uint32_t>(b), contact[b]});
          ++number;
        }
      });
  if (!placed) return placed.error();
  surfaces.placed = std::move(*placed);
  return surfaces;
}

/// Groups of parts that are paired as one: of many equal parts at one place that do not cross each
/// other, one stands for all, as n of them would be n²/2 pairs with nothing to find.
struct Stacks {
  std::vector<std::uint32_t> first;    ///< first member by stack, and the end
  std::vector<std::uint32_t> members;  ///< ascending within each

  [[nodiscard]] std::size_t size() const { return first.size() - 1; }
  [[nodiscard]] std::span<const std::uint32_t> of(std::size_t stack) const {
    return std::span(members).subspan(first[stack], first[stack + 1] - first[stack]);
  }
};

/// The intersection lines of a pair, in the coordinates of its first part.
struct PairIntersection {
  std::vector<Segment> lines;
  std::uint64_t tests = 0;
};

class IntersectionSearch {
 public:
  IntersectionSearch(const model::Scene& scene, const SurfaceList& surfaces,
                     const IntersectionRule& rule, const parallel::Context& context)
      : scene_(scene), surfaces_(surfaces), rule_(rule), context_(context) {}

  Result<IntersectionLines> run() {
    if (const Status s = pair_up(); !s) return s.error();
    if (const Status s = leave_out_parted(); !s) return s.error();
    const auto kinds = parallel::distinct(
        context_, "intersections: equal pairs", pairs_.size(),
        [&](std::size_t i) { return hash(i); },
        [&](std::size_t i, std::size_t j) { return same(i, j); });
    if (!kinds) return kinds.error();
    const auto found = find_lines(kinds->first);
    if (!found) return found.error();
    auto placed = place(*kinds, *found);
    if (!placed) return placed.error();
    IntersectionLines crossings{std::move(*placed), found->size() + stacked_.pairs, stacked_.tests,
                                pairs_.size() + stacked_.pairs};
    for (const PairIntersection& one : *found) crossings.tests += one.tests;
    return crossings;
  }

 private:
  [[nodiscard]] const PlacedSurface& a(std::size_t i) const {
    return surfaces_.placed[pairs_[i].first];
  }
  [[nodiscard]] const PlacedSurface& b(std::size_t i) const {
    return surfaces_.placed[pairs_[i].second];
  }
  [[nodiscard]] Vec3l offset(std::size_t i) const {
    return b(i).placed.origin - a(i).placed.origin;
  }
  [[nodiscard]] std::int64_t contact(std::size_t i) const {
    return std::max(a(i).contact, b(i).contact);
  }
  [[nodiscard]] model::ObjectId object(const PlacedSurface& surface) const {
    return scene_.bodies[surface.body].object;
  }
  [[nodiscard]] bool is_joint(const PlacedSurface& x, const PlacedSurface& y) const {
    return x.placed.part->primitive && y.placed.part->primitive && object(x) == object(y);
  }
  /// Returns whether the parts of a pair are primitives of one object.
  [[nodiscard]] bool is_joint(std::size_t i) const { return is_joint(a(i), b(i)); }
  [[nodiscard]] std::uint64_t hash(std::size_t i) const {
    std::uint64_t h = parallel::mixed(0, (std::uint64_t{a(i).unique} << 32U) | b(i).unique);
    const Vec3l at = offset(i);
    for (int k = 0; k < 3; ++k) h = parallel::mixed(h, static_cast<std::uint64_t>(at[k]));
    h = parallel::mixed(h, static_cast<std::uint64_t>(contact(i)));
    return parallel::mixed(h, is_joint(i) ? 1 : 0);
  }
  [[nodiscard]] bool same(std::size_t i, std::size_t j) const {
    return a(i).unique == a(j).unique && b(i).unique == b(j).unique && offset(i) == offset(j) &&
           contact(i) == contact(j) && is_joint(i) == is_joint(j);
  }

  /// Returns whether the lines that are drawn with the object of a part are wanted.
  [[nodiscard]] bool is_to_solve(std::size_t i) const {
    return rule_.to_solve.empty() || rule_.to_solve[model::index(object(surfaces_.placed[i]))];
  }

  /// Returns a number that is equal for parts that are not to be paired, as far as each alone
  /// decides that.
  [[nodiscard]] std::uint32_t owner(std::size_t i) const {
    const PlacedSurface& surface = surfaces_.placed[i];
    const bool alone = rule_.which == Intersections::parts ||
                       (rule_.which == Intersections::primitives && surface.placed.part->primitive);
    return alone ? static_cast<std::uint32_t>(scene_.model->objects.size() + i)
                 : model::index(object(surface));
  }

  /// Returns an owner unlike all others.
  [[nodiscard]] std::uint32_t owner_of_stack(std::size_t stack) const {
    return static_cast<std::uint32_t>(scene_.model->objects.size() + surfaces_.placed.size() +
                                      stack);
  }

  /// Returns whether two parts with different owners are to be intersected.
  [[nodiscard]] bool is_requested(const PlacedSurface& x, const PlacedSurface& y) const {
    return rule_.which != Intersections::primitives || object(x) != object(y) || is_joint(x, y);
  }

  /// Returns, by kind of equal parts at one place, whether they are many that do not cross each
  /// other.
  Result<std::vector<bool>> find_quiet(const parallel::Distinct& kinds) {
    // Fewer parts are no more work as pairs. 250, 500 and 1,000 cylinders at one place took 274,
    // 651 and 1,724 million instructions as pairs, and take 191, 375 and 747.
    constexpr std::uint32_t kMany = 8;
    std::vector<std::uint32_t> count(kinds.first.size()), second(kinds.first.size());
    for (std::uint32_t i = 0; i < kinds.of.size(); ++i) {
      const std::uint32_t kind = kinds.of[i];
      ++count[kind];
      // Joints have a subset of the lines that other pairs have.
      if (!is_joint(surfaces_.placed[kinds.first[kind]], surfaces_.placed[i])) second[kind] = i;
    }
    std::vector<bool> quiet(kinds.first.size());
    std::vector<std::uint32_t> requested;
    pairs_.clear();
    for (std::uint32_t kind = 0; kind < count.size(); ++kind) {
      if (count[kind] < kMany || second[kind] <= kinds.first[kind]) continue;
      requested.push_back(kind);
      pairs_.push_back({kinds.first[kind], second[kind]});
    }
    if (requested.empty()) return quiet;
    if (const Status s = make_frames(); !s) return s.error();
    std::vector<std::uint32_t> all(pairs_.size());
    std::iota(all.begin(), all.end(), 0U);
    const auto found = find_lines(all);
    if (!found) return found.error();
    for (std::size_t k = 0; k < requested.size(); ++k) {
      quiet[requested[k]] = (*found)[k].lines.empty();
      if (!(*found)[k].lines.empty()) continue;
      ++stacked_.pairs;
      stacked_.tests += (*found)[k].tests;
    }
    return quiet;
  }

  Result<Stacks> stack_up() {
    const std::vector<PlacedSurface>& surfaces = surfaces_.placed;
    const auto kinds = parallel::distinct(
        context_, "intersections: parts at one place", surfaces.size(),
        [&](std::size_t i) {
          std::uint64_t h =
              parallel::mixed(surfaces[i].unique, static_cast<std::uint64_t>(surfaces[i].contact));
          for (int k = 0; k < 3; ++k)
            h = parallel::mixed(h, static_cast<std::uint64_t>(surfaces[i].placed.origin[k]));
          return h;
        },
        [&](std::size_t i, std::size_t j) {
          return surfaces[i].unique == surfaces[j].unique &&
                 surfaces[i].contact == surfaces[j].contact &&
                 surfaces[i].placed.origin == surfaces[j].placed.origin;
        });
    if (!kinds) return kinds.error();
    const auto quiet = find_quiet(*kinds);
    if (!quiet) return quiet.error();
    std::vector<std::uint32_t> stack(surfaces.size());
    Stacks stacks;
    std::uint32_t count = 0;
    for (std::uint32_t i = 0; i < surfaces.size(); ++i) {
      const std::uint32_t kind = kinds->of[i], first = kinds->first[kind];
      stack[i] = (*quiet)[kind] && first != i ? stack[first] : count++;
    }
    stacks.first.resize(count + 1);
    for (const std::uint32_t s : stack) ++stacks.first[s + 1];
    std::partial_sum(stacks.first.begin(), stacks.first.end(), stacks.first.begin());
    stacks.members.resize(surfaces.size());
    std::vector<std::uint32_t> next = stacks.first;
    for (std::uint32_t i = 0; i < surfaces.size(); ++i) stacks.members[next[stack[i]]++] = i;
    return stacks;
  }

  Status pair_up() {
    const Result<Stacks> stacks = stack_up();
    if (!stacks) return stacks.error();
    const auto items = parallel::transform(
        context_, {.name = "intersections: boxes", .n = stacks->size(), .grain = kGrain},
        [&](std::size_t s) {
          const std::uint32_t i = stacks->of(s).front();
          const PlacedSurface& surface = surfaces_.placed[i];
          const geometry::Box3l box = surface.placed.part->box.as<std::int64_t>();
          return geometry::BoxItem{
              .box = box.moved(surface.placed.origin),
              .owner = stacks->of(s).size() == 1 ? owner(i) : owner_of_stack(s)};
        });
    if (!items) return items.error();
    const auto tree = geometry::SceneBvh::build(*items, context_);
    if (!tree) return tree.error();
    const auto met = geometry::overlapping_box_pairs(*tree, context_);
    if (!met) return met.error();
    auto pairs = parallel::collect<IndexPair>(
        context_, {.name = "intersections: pairs", .n = met->size(), .grain = kGrain},
        [&](std::size_t i, std::vector<IndexPair>& out) {
          const IndexPair& pair = (*met)[i];
          if (only_touch((*items)[pair.first].box, (*items)[pair.second].box)) return;
          for (const std::uint32_t x : stacks->of(pair.first))
            for (const std::uint32_t y : stacks->of(pair.second))
              if (owner(x) != owner(y) && is_requested(surfaces_.placed[x], surfaces_.placed[y]) &&
                  is_to_solve(std::min(x, y)))
                out.push_back({std::min(x, y), std::max(x, y)});
        });
    if (!pairs) return pairs.error();
    pairs_ = std::move(*pairs);
    if (stacks->size() < surfaces_.placed.size()) std::ranges::sort(pairs_);
    return {};
  }

  /// Returns whether a plane along two axes separates the boxes: then their contents cannot pass
  /// through each other. Most boxes that meet in a ship are so.
  static bool only_touch(const geometry::Box3l& a, const geometry::Box3l& b) {
    for (int k = 0; k < 3; ++k)
      if (a.hi[k] <= b.lo[k] || b.hi[k] <= a.lo[k]) return true;
    return false;
  }

  /// Returns, by unique part, make(part) for each part of the pairs with is_needed(first, second).
  template <class IsNeeded, class Make>
  auto for_parts(std::string_view name, IsNeeded&& is_needed, Make&& make) const {
    using T = std::invoke_result_t<Make&, const geometry::Part&>;
    std::vector<bool> requested(surfaces_.unique.size());
    for (std::size_t i = 0; i < pairs_.size(); ++i)
      if (is_needed(*a(i).placed.part, *b(i).placed.part))
        requested[a(i).unique] = requested[b(i).unique] = true;
    parallel::Precomputed<T> made(surfaces_.unique.size());
    const Status status = made.fill_by_weight(
        context_, {.name = name}, kBigShape, parallel::keys_of(requested),
        [&](std::size_t u) { return surfaces_.unique[u]->triangles.size(); },
        [&](std::size_t u) { return make(*surfaces_.unique[u]); });
    return status ? Result(std::move(made)) : Result<parallel::Precomputed<T>>(status.error());
  }

  Status make_frames() {
    auto frames = for_parts(
        "intersections: frames", [](const auto&...) { return true; },
        [&](const geometry::Part& part) { return geometry::make_oriented_box(part, context_); });
    if (!frames) return frames.error();
    frames_ = std::move(*frames);
    return {};
  }

  /// Drops the pairs that a plane along a face of either part separates. Where a model stands askew
  /// these are nearly all whose boxes meet.
  Status leave_out_parted() {
    if (const Status s = make_frames(); !s) return s;
    auto left = parallel::collect<IndexPair>(
        context_, {.name = "intersections: oriented boxes", .n = pairs_.size(), .grain = kGrain},
        [&](std::size_t i, std::vector<IndexPair>& out) {
          // No plane separates equal parts in one place: of many equal objects all pairs are so.
          if (a(i).unique == b(i).unique && a(i).placed.origin == b(i).placed.origin)
            return out.push_back(pairs_[i]);
          const geometry::PartWithObb x{a(i).placed, frames_.find(a(i).unique)};
          const geometry::PartWithObb y{b(i).placed, frames_.find(b(i).unique)};
          constexpr double kEnough = std::numeric_limits<double>::min();
          if (!(oriented_box_separation(x, y, kEnough).lower > 0)) out.push_back(pairs_[i]);
        });
    if (!left) return left.error();
    pairs_ = std::move(*left);
    return {};
  }

  /// Finds the lines of some pairs.
  Result<std::vector<PairIntersection>> find_lines(const std::vector<std::uint32_t>& some) const {
    const auto trees = for_parts(
        "intersections: trees", geometry::needs_bvhs,
        [&](const geometry::Part& part) { return geometry::TriangleBvh(part, context_); });
    if (!trees) return trees.error();
    const auto whole = [&](const PlacedSurface& surface) {
      return geometry::PartWithObb{surface.placed, frames_.find(surface.unique),
                                   trees->find(surface.unique)};
    };
    const auto order = parallel::longest_first(some.size(), [&](std::size_t k) {
      return a(some[k]).placed.part->triangles.size() + b(some[k]).placed.part->triangles.size();
    });
    const std::uint64_t limit = max_lines();
    parallel::Allowance allowance(limit);
    return parallel::transform(
        context_, {.name = "intersections: lines", .n = some.size(), .order = order},
        [&](std::size_t k) -> Result<PairIntersection> {
          const std::size_t i = some[k];
          geometry::QueryContext work;
          auto lines =
              part_intersection_lines_up_to(limit, whole(a(i)), whole(b(i)), contact(i), work);
          if (!lines || !allowance.take(lines->size())) return too_many(limit);
          if (!is_joint(i)) return PairIntersection{std::move(*lines), work.triangle_pairs};
          auto edges =
              joint_lines(a(i).placed, b(i).placed, contact(i), rule_.cos_sharp, std::move(*lines));
          if (!edges) return edges.error();
          return PairIntersection{std::move(*edges), work.triangle_pairs};
        });
  }

  static Error too_many(std::uint64_t limit) {
    return {ErrorCode::input,
            "parts cross each other along more than " + std::to_string(limit) + " lines",
            {},
            "draw fewer objects at a time, or leave these lines out (--intersections off)"};
  }

  [[nodiscard]] std::uint64_t max_lines() const {
    std::uint64_t triangles = 0;
    for (const PlacedSurface& surface : surfaces_.placed)
      triangles += surface.placed.part->triangles.size();
    return kMaxLines + kMaxLinesOfTriangle * triangles;
  }

  /// Places the lines by pair, and so by object of the first part.
  Result<std::vector<IntersectionLine>> place(const parallel::Distinct& kinds,
                                              const std::vector<PairIntersection>& found) const {
    // Equal pairs that stand in many places count each time.
    std::uint64_t lines = 0;
    for (const std::uint32_t kind : kinds.of) lines += found[kind].lines.size();
    if (lines > max_lines()) return too_many(max_lines());
    auto placed = parallel::count_fill<IntersectionLine>(
        context_, {.name = "intersections: places", .n = pairs_.size(), .grain = kGrain},
        [&](std::size_t i) { return found[kinds.of[i]].lines.size(); },
        [&](std::size_t i, std::span<IntersectionLine> out) {
          const std::vector<Segment>& own = found[kinds.of[i]].lines;
          for (std::size_t k = 0; k < own.size(); ++k)
            out[k] = {own[k][0] + a(i).placed.origin, own[k][1] + a(i).placed.origin, a(i).body,
                      b(i).body};
        });
    if (!placed) return placed.error();
    return std::move(placed->values);
  }

  const model::Scene& scene_;
  const SurfaceList& surfaces_;
  const IntersectionRule& rule_;
  const parallel::Context& context_;
  struct {
    std::uint64_t pairs = 0, tests = 0;
  } stacked_;  ///< counts for equal parts at one place, of which there are no pairs
  std::vector<IndexPair> pairs_;
  parallel::Precomputed<geometry::OrientedBox> frames_;  ///< by unique part
};

}  // namespace

Result<IntersectionLines> find_intersection_lines(const model::Scene& scene,
                                                  const std::vector<bool>& drawn,
                                                  const std::vector<std::int64_t>& contact,
                                                  const IntersectionRule& rule,
                                                  const parallel::Context& context) {
  if (rule.which == Intersections::off) return IntersectionLines{};
  const Result<SurfaceList> surfaces = list_surfaces(scene, drawn, contact, rule, context);
  if (!surfaces) return surfaces.error();
  return IntersectionSearch(scene, *surfaces, rule, context).run();
}

}  // namespace strake::hlr
