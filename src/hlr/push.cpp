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
#include <span>
#include <utility>
#include <vector>

#include "hlr/asked_edge.hpp"
#include "hlr/gatherer.hpp"
#include "hlr/job.hpp"
#include "hlr/piece_maker.hpp"
#include "hlr/stretches.hpp"
#include "hlr/view_tree.hpp"
#include "hlr/world.hpp"
#include "strake/parallel/collect.hpp"
#include "strake/parallel/for_each.hpp"
#include "strake/parallel/item_locks.hpp"
#include "strake/parallel/marks.hpp"

namespace strake::hlr {
namespace {

/// An edge under others, and what has been published of it.
struct Under {
  AskedEdge edge;
  Param lo = Param::zero(), hi = Param::one();
  OpenRange open;
  std::vector<Hit> hits;
  bool asked = false;

  void add(const Hit& hit) {
    if (open.empty()) return;
    hits.push_back(hit);
    open.shrink_all(hits);
  }
};

/// The edges of an object. What its own faces hide of them is known from the start.
struct UnderObject {
  std::vector<Under> edges;
  /// By edge: nothing is left of it to be hidden. Read without the lock: a worker that does not
  /// know yet tests in vain.
  parallel::Marks done;
  ViewBox box;
};

/// A double no greater.
double below(std::int64_t value) {
  const auto near = static_cast<double>(value);
  return near - std::fabs(near) * 1e-15 - 1;
}

class Pusher {
 public:
  Pusher(const World& world, std::vector<UnderObject>& objects, const ViewTree& tree,
         parallel::ItemLocks& locks)
      : world_(world), objects_(objects), tree_(tree), locks_(locks), gatherer_(world) {}

  Work run(std::uint32_t over) {
    const Placed& placed = world_.placed[over];
    if (!placed.opaque || placed.view->box.empty()) return {};
    const ViewBox box = placed.view->box.moved(placed.at);
    LooseSegment query;
    query.u0 = below(box.lo.u);
    query.u1 = -below(-box.hi.u);
    query.v0 = below(box.lo.v);
    query.v1 = -below(-box.hi.v);
    query.w0 = below(-box.hi.w);
    tree_.walk(query, [&](std::uint32_t under) {
      if (under != placed.object) publish(over, under);
      return true;
    });
    return std::exchange(gatherer_.work, {});
  }

 private:
  void publish(std::uint32_t over, std::uint32_t under) {
    UnderObject& object = objects_[under];
    const std::uint32_t over_object = world_.placed[over].object;
    found_.clear();
    for (std::uint32_t e = 0; e < object.edges.size(); ++e) {
      if (object.done.is_set(e)) continue;
      const Under& edge = object.edges[e];
      if (edge.edge.other->object == over_object) continue;
      for (const Hit& hit : gatherer_.hits_of_body(edge.edge, over, edge.lo, edge.hi))
        found_.emplace_back(e, hit);
    }
    if (found_.empty()) return;
    const auto held = locks_.hold(under);
    for (const auto& [e, hit] : found_) {
      Under& edge = object.edges[e];
      edge.add(hit);
      if (edge.open.empty()) object.done.set(e);
    }
  }

  const World& world_;
  std::vector<UnderObject>& objects_;
  const ViewTree& tree_;
  parallel::ItemLocks& locks_;
  Gatherer gatherer_;
  std::vector<std::pair<std::uint32_t, Hit>> found_;
};

/// The edges of an object in their order, with what its own faces hide.
UnderObject local_step(const World& world, std::uint32_t object, Gatherer& gatherer,
                       PieceMaker& maker) {
  UnderObject result;
  const auto add = [&](const AskedEdge& edge) {
    ++gatherer.work.edges;
    Under under;
    under.edge = edge;
    under.asked = maker.begin(edge);
    if (under.asked) {
      under.lo = maker.lo();
      under.hi = maker.hi();
      under.open = OpenRange(under.lo, under.hi);
      const auto hits = gatherer.own_hits(edge, under.lo, under.hi);
      under.hits.assign(hits.begin(), hits.end());
      if (!hits.empty()) under.open.shrink_all(hits);
      result.box.include(gatherer.box());
    }
    result.edges.push_back(std::move(under));
  };
  const auto& first = world.job.scene->first_body;
  for (std::uint32_t b = first[object]; b < first[object + 1]; ++b) {
    if (world.placed[b].view == nullptr) continue;
    for (const EdgeView& e : world.placed[b].view->edges) add(AskedEdge(world, b, e));
  }
  for (const Line& line : world.job.lines.of(object)) add(AskedEdge(world, line));
  result.done = parallel::Marks(result.edges.size());
  for (std::size_t e = 0; e < result.edges.size(); ++e)
    if (!result.edges[e].asked || result.edges[e].open.empty()) result.done.set(e);
  return result;
}

/// Over the objects' boxes turned round: what is farthest comes first, so that a query finds those
/// that reach down below it.
ViewTree tree_of(const std::vector<UnderObject>& objects) {
  std::vector<ViewBox> boxes(objects.size());
  for (std::size_t o = 0; o < objects.size(); ++o) {
    if (objects[o].box.empty()) continue;
    boxes[o] = objects[o].box;
    boxes[o].lo.w = -objects[o].box.hi.w;
    boxes[o].hi.w = -objects[o].box.lo.w;
  }
  return ViewTree(boxes);
}

/// Bodies that may hide, the nearest first; of equal depth the lower number, so that the order is
/// total.
std::vector<std::uint32_t> nearest_first(const World& world) {
  std::vector<std::uint32_t> order(world.placed.size());
  std::iota(order.begin(), order.end(), 0U);
  const auto depth = [&](std::uint32_t b) {
    const Placed& placed = world.placed[b];
    return placed.view == nullptr || placed.view->box.empty()
               ? std::numeric_limits<std::int64_t>::min()
               : placed.view->box.hi.w + placed.at.w;
  };
  std::ranges::sort(order, [&](std::uint32_t a, std::uint32_t b) {
    const std::int64_t at_a = depth(a), at_b = depth(b);
    return at_a != at_b ? at_a > at_b : a < b;
  });
  return order;
}

}  // namespace

Status solve_push(const Job& job, const parallel::Context& context, Drawing& drawing) {
  const Result<World> made = make_world(job, context);
  if (!made) return made.error();
  const World& world = *made;
  const SpeckRule rule(job);
  std::vector<UnderObject> objects(job.drawn.size());
  std::vector<Work> work(objects.size() + world.placed.size());
  struct Local {
    Gatherer gatherer;
    PieceMaker maker;
  };
  const Status local = parallel::for_each_with(
      context, {.name = "push: local step", .n = objects.size()},
      [&] { return Local{Gatherer(world), PieceMaker(world, rule)}; },
      [&](Local& own, std::size_t o) {
        if (!job.drawn[o]) return;
        objects[o] = local_step(world, static_cast<std::uint32_t>(o), own.gatherer, own.maker);
        work[o] = std::exchange(own.gatherer.work, {});
      });
  if (!local) return local;
  if (job.options.stage == Stage::global) {
    const ViewTree tree = tree_of(objects);
    parallel::ItemLocks locks(objects.size());
    const std::vector<std::uint32_t> order = nearest_first(world);
    const Status global = parallel::for_each_with(
        context, {.name = "push: global step", .n = order.size(), .order = order},
        [&] { return Pusher(world, objects, tree, locks); },
        [&](Pusher& pusher, std::size_t body) {
          work[objects.size() + body] = pusher.run(static_cast<std::uint32_t>(body));
        });
    if (!global) return global;
  }
  Result<std::vector<Piece>> pieces = parallel::collect_with<Piece>(
      context, {.name = "push: pieces", .n = objects.size()},
      [&] { return PieceMaker(world, rule); },
      [&](PieceMaker& maker, std::size_t o, std::vector<Piece>& out) {
        for (std::uint32_t e = 0; e < objects[o].edges.size(); ++e) {
          const Under& under = objects[o].edges[e];
          static_cast<void>(maker.begin(under.edge));
          const PieceMaker::Absent absent = maker.finish(e, under.hits, out);
          work[o].specks += absent.specks;
          if (absent.left_out) ++drawing.left_out[o];
        }
      });
  if (!pieces) return pieces.error();
  drawing.pieces = std::move(pieces).value();
  for (const Work& w : work) add(drawing.counters, w);
  return {};
}

}  // namespace strake::hlr
