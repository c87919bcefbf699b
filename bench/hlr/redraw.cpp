// SPDX-License-Identifier: Apache-2.0
// bench_hlr_redraw [OBJECTS [THREADS [CASE]]]: what a drawing of a generated ship costs in
// full, when one object moved and when nothing changed, for several views. Objects are taken from
// all over the ship, and the dearest is told beside the usual one. A drawing that is not equal to
// the full one reports an error instead of times.
#include <fmt/core.h>

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

#include "clocks.hpp"
#include "strake/generate/ship.hpp"
#include "strake/hlr/incremental.hpp"
#include "strake/model/scene.hpp"
#include "strake/parallel/team.hpp"

namespace {

using namespace strake;

constexpr std::size_t kMoves = 9;

struct Case {
  std::string name;
  hlr::View view;
  hlr::Options options;
};

bool equal(const hlr::Drawing& a, const hlr::Drawing& b) {
  return a.left_out == b.left_out && a.counted == b.counted && a.origin == b.origin &&
         a.account.fates == b.account.fates &&
         std::ranges::equal(a.pieces, b.pieces, [](const auto& p, const auto& q) {
           return p.object == q.object && p.edge == q.edge && p.state == q.state && p.a == q.a &&
                  p.b == q.b;
         });
}

geometry::Box3l box_of(const model::Scene& scene) {
  geometry::Box3l box = geometry::empty_box<std::int64_t>();
  for (const model::GridBody& body : scene.bodies)
    if (const auto& shape = scene.shapes[body.grid_shape]; !shape.box.empty())
      box.include(body.box(shape));
  return box;
}

std::vector<Case> cases_of(const model::Scene& scene) {
  const geometry::Box3l box = box_of(scene);
  geometry::Box3l deck = box;
  deck.hi.z = box.lo.z + (box.hi.z - box.lo.z) / 3;
  deck.lo.z = box.lo.z + (box.hi.z - box.lo.z) / 5;
  const geometry::Vec3l size = box.hi - box.lo;
  const geometry::Vec3l target{box.lo.x + size.x / 2, box.lo.y + size.y / 2, box.lo.z + size.z / 2};
  const geometry::Vec3l toward{size.x / 1024, -size.x / 1024, size.x / 2048};
  hlr::View perspective{.direction = toward};
  perspective.perspective = {.eye = target + toward * 700, .target = target};
  const hlr::Options all;
  hlr::Options visible_only;
  visible_only.hidden = visible_only.clipped = false;
  // One by one: of a list of them GCC 12 warns that some may be destroyed before they are made.
  std::vector<Case> cases;
  const auto add = [&](const char* name, const hlr::View& view, const hlr::Options& options) {
    cases.push_back({name, view, options});
  };
  add("plan", {.direction = {0, 0, 1}}, all);
  add("plan, what is seen", {.direction = {0, 0, 1}}, visible_only);
  add("deck, what is seen", {.direction = {0, 0, 1}, .limits = deck}, visible_only);
  add("front", {.direction = {0, -1, 0}}, all);
  add("isometric", {.direction = {1, -1, 1}}, all);
  add("isometric, what is seen", {.direction = {1, -1, 1}}, visible_only);
  add("perspective, what is seen", perspective, visible_only);
  return cases;
}

void move(model::Scene& scene, std::uint32_t object, std::int64_t by) {
  for (std::uint32_t b = scene.first_body[object]; b < scene.first_body[object + 1]; ++b)
    scene.bodies[b].origin.x += by;
}

/// Returns a copy with room for more pieces, as one has who reads a stored drawing.
hlr::Drawing stored(const hlr::Drawing& drawing) {
  hlr::Drawing copy = drawing;
  copy.pieces.reserve(drawing.pieces.size() + drawing.pieces.size() / 64 + 4096);
  return copy;
}

struct Moved {
  double seconds = 0;
  std::uint32_t object = 0;
  std::uint64_t objects = 0, edges = 0;
  bool in_full = false;
};

/// Moves one object and draws again; an error where the drawing is not the full one.
bool draw_moved(model::Scene& scene, const Case& one, const hlr::Drawing& drawing,
                const std::vector<geometry::Box3l>& boxes, const parallel::Context& context,
                bool check, Moved& moved) {
  std::vector<std::uint32_t> now(boxes.size());
  std::iota(now.begin(), now.end(), 0U);
  now[moved.object] = model::kNoObject;
  move(scene, moved.object, 7000);
  hlr::EarlierDrawing earlier{stored(drawing), now, boxes};
  bench::Lap lap;
  const auto redrawn =
      hlr::draw_changes(scene, {}, one.view, one.options, std::move(earlier), context).value();
  moved.seconds = lap();
  moved.objects = redrawn.objects_solved;
  moved.edges = redrawn.edges_solved;
  moved.in_full = redrawn.in_full;
  const bool good = !check || equal(hlr::draw(scene, {}, one.view, one.options, context).value(),
                                    redrawn.drawing);
  move(scene, moved.object, -7000);
  return good;
}

void run(model::Scene& scene, const Case& one, const parallel::Context& context) {
  bench::Lap lap;
  const auto drawing = hlr::draw(scene, {}, one.view, one.options, context).value();
  const double full = lap();
  const auto signatures = hlr::signatures(scene, {}, one.view, one.options, context).value();
  const double hashes = lap();
  std::vector<std::uint32_t> same(signatures.boxes.size());
  std::iota(same.begin(), same.end(), 0U);
  hlr::EarlierDrawing earlier{stored(drawing), same, signatures.boxes};
  lap();
  const auto nothing =
      hlr::draw_changes(scene, {}, one.view, one.options, std::move(earlier), context).value();
  const double unchanged = lap();
  if (!equal(nothing.drawing, drawing)) return fmt::print("ERROR: {}: nothing changed\n", one.name);
  std::vector<Moved> moves(kMoves);
  for (std::size_t i = 0; i < kMoves; ++i) {
    moves[i].object = static_cast<std::uint32_t>((2 * i + 1) * same.size() / (2 * kMoves));
    if (!draw_moved(scene, one, drawing, signatures.boxes, context, i == 0, moves[i]))
      return fmt::print("ERROR: {}: object {} moved\n", one.name, moves[i].object);
  }
  std::ranges::sort(moves, {}, &Moved::seconds);
  const Moved &usual = moves[kMoves / 2], &dearest = moves.back();
  fmt::print(
      "{:<28}{:>8.3f} s full, {} pieces; signatures {:.1f} ms; unchanged {:.1f} ms; one moved "
      "{:.1f} ms "
      "({} objects, {} edges{}), at most {:.1f} ms ({} objects, {} edges{}); target {:.1f} ms\n",
      one.name, full, drawing.pieces.size(), hashes * 1e3, unchanged * 1e3, usual.seconds * 1e3,
      usual.objects, usual.edges, usual.in_full ? ", in full" : "", dearest.seconds * 1e3,
      dearest.objects, dearest.edges, dearest.in_full ? ", in full" : "", 30 * full + 50);
}

}  // namespace

int main(int argc, char** argv) {
  std::setvbuf(stdout, nullptr, _IOLBF, BUFSIZ);  // each line as it comes, into files and pipes too
  const std::uint64_t objects = argc > 1 ? std::strtoull(argv[1], nullptr, 10) : 100'000;
  const auto threads = argc > 2 ? static_cast<unsigned>(std::strtoul(argv[2], nullptr, 10)) : 2U;
  parallel::Team team(threads);
  const parallel::Context context{.team = &team};
  const auto ship = generate::generate_ship({.objects = objects}, context).value();
  model::Scene scene = model::make_scene(ship.model, {}, context).value();
  fmt::print("{} objects, {} threads\n", objects, threads);
  for (const Case& one : cases_of(scene))
    if (argc < 4 || one.name == argv[3]) run(scene, one, context);
  return 0;
}
