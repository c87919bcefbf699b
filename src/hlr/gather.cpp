// SPDX-License-Identifier: Apache-2.0
// The engine: every edge gathers what hides it, front to back, and stops when nothing of it is
// left to be seen. No edge writes to another, so there are no locks and no order to wait for.
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "hlr/asked_edge.hpp"
#include "hlr/gatherer.hpp"
#include "hlr/job.hpp"
#include "hlr/piece_maker.hpp"
#include "hlr/world.hpp"
#include "strake/parallel/collect.hpp"
#include "strake/parallel/for_each.hpp"

namespace strake::hlr {
namespace {

/// Draws the edges of items; for one worker.
class Drawer {
 public:
  Drawer(const World& world, const SpeckRule& rule)
      : world_(world), gatherer_(world), maker_(world, rule) {}

  Work run(const Item& item, std::vector<Piece>& out) {
    gatherer_.start(item);
    const auto lines = world_.job.lines.of(world_.placed[item.body].object);
    for (std::uint32_t i = item.first; i < item.last; ++i)
      draw(item.lines ? AskedEdge(world_, lines[i])
                      : AskedEdge(world_, item.body, world_.placed[item.body].view->edges[i]),
           item.number + (i - item.first), out);
    return std::exchange(gatherer_.work, {});
  }

 private:
  void draw(const AskedEdge& edge, std::uint32_t number, std::vector<Piece>& out) {
    ++gatherer_.work.edges;
    std::span<const Hit> hits;
    if (maker_.begin(edge)) hits = gatherer_.hits(edge, maker_.lo(), maker_.hi());
    const PieceMaker::Absent absent = maker_.finish(number, hits, out);
    gatherer_.work.specks += absent.specks;
    if (absent.left_out) ++gatherer_.work.left_out;
  }

  const World& world_;
  Gatherer gatherer_;
  PieceMaker maker_;
};

/// What a body's own faces hide of some of its edges.
void run_on_itself(const World& world, Gatherer& gatherer, const Item& item, OwnHits& out) {
  const auto& edges = world.placed[item.body].view->edges;
  for (std::uint32_t i = item.first; i < item.last; ++i) {
    out.first.push_back(static_cast<std::uint32_t>(out.hits.size()));
    const auto hits = gatherer.hits_of_own_body(AskedEdge(world, item.body, edges[i]));
    out.hits.insert(out.hits.end(), hits.begin(), hits.end());
  }
}

/// Works out once what the faces of shared shapes hide of their own edges.
Status share_own_hits(World& world, const parallel::Context& context, Counters& counters) {
  const std::vector<Item> items = own_items(world);
  struct Part {
    OwnHits hits;
    Work work;
  };
  std::vector<Part> parts(items.size());
  const Status done = parallel::for_each_with(
      context, {.name = "hidden lines: shapes on themselves", .n = items.size()},
      [&] { return Gatherer(world); },
      [&](Gatherer& gatherer, std::size_t i) {
        run_on_itself(world, gatherer, items[i], parts[i].hits);
        parts[i].work = std::exchange(gatherer.work, {});
      });
  if (!done) return done;
  world.own_hits.resize(world.views.size());
  for (std::size_t i = 0; i < items.size(); ++i) {
    OwnHits& all = world.own_hits[world.job.seen.of[items[i].body]];
    if (!all.first.empty()) all.first.pop_back();
    const auto base = static_cast<std::uint32_t>(all.hits.size());
    for (const std::uint32_t first : parts[i].hits.first) all.first.push_back(base + first);
    all.hits.insert(all.hits.end(), parts[i].hits.hits.begin(), parts[i].hits.hits.end());
    all.first.push_back(static_cast<std::uint32_t>(all.hits.size()));
    add(counters, parts[i].work);
  }
  return {};
}

}  // namespace

Status solve_gather(const Job& job, const parallel::Context& context, Drawing& drawing) {
  Result<World> made = make_world(job, context);
  if (!made) return made.error();
  if (const Status status = share_own_hits(*made, context, drawing.counters); !status)
    return status;
  const World& world = *made;
  const SpeckRule rule(job);
  std::vector<Work> work(world.items.size());
  Result<std::vector<Piece>> pieces = parallel::collect_with<Piece>(
      context, {.name = "hidden lines: edges", .n = world.items.size()},
      [&] { return Drawer(world, rule); },
      [&](Drawer& drawer, std::size_t i, std::vector<Piece>& out) {
        work[i] = drawer.run(world.items[i], out);
      });
  if (!pieces) return pieces.error();
  drawing.pieces = std::move(pieces).value();
  for (std::size_t i = 0; i < work.size(); ++i) {
    add(drawing.counters, work[i]);
    if (work[i].left_out > 0)
      drawing.left_out[world.placed[world.items[i].body].object] +=
          static_cast<std::uint32_t>(work[i].left_out);
  }
  return {};
}

}  // namespace strake::hlr
