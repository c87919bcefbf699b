// SPDX-License-Identifier: Apache-2.0
// How long it takes to tell what changed from one model to another.
//
//     bench_project_compare [objects]   a generated ship and the same with every thousandth object
//                                       moved; default 1,000,000 objects
//
// "compare" is match_files() and compare() of two models in memory, with one worker and with as
// many as there are cores; "renamed" the same where the file has another name, so that all ids and
// places are looked at. Changes other than those that were made are an error instead of a time.
#include <fmt/core.h>

#include <cstdlib>
#include <string>
#include <string_view>
#include <utility>

#include "clocks.hpp"
#include "strake/generate/ship.hpp"
#include "strake/parallel/team.hpp"
#include "strake/project/update.hpp"

namespace {

using namespace strake;

constexpr std::size_t kMovedOfEvery = 1000;

/// Compares and prints the time; whether the changes are the right ones.
bool run(std::string_view what, const model::Model& then, const model::Model& now,
         std::size_t moved, const parallel::Context& context) {
  bench::Clock clock;
  Result<report::FileMatches> files = project::match_files(then, now, {}, context);
  if (!files) return false;
  const Result<project::Changes> changes = project::compare(then, now, std::move(*files), context);
  const std::string time = clock.text();
  if (!changes || changes->count(project::ChangeKind::moved) != moved ||
      changes->objects.size() != moved) {
    fmt::print("{}: not the changes that were made\n", what);
    return false;
  }
  fmt::print("{:<24} {}\n", what, time);
  return true;
}

}  // namespace

int main(int argc, char** argv) {
  generate::ShipOptions options;
  options.objects = argc > 1 ? std::strtoull(argv[1], nullptr, 10) : 1'000'000;
  parallel::Team team(parallel::default_workers());
  const parallel::Context all{.team = &team};
  const Result<generate::Ship> ship = generate::generate_ship(options, all);
  if (!ship) {
    fmt::print("{}\n", ship.error().text());
    return EXIT_FAILURE;
  }
  model::Model now = ship->model;
  std::size_t moved = 0;
  for (std::size_t o = 0; o < now.objects.size(); o += kMovedOfEvery, ++moved)
    for (std::uint32_t b = 0; b < now.objects[o].body_count; ++b)
      now.bodies[now.objects[o].first_body + b].placement.translation.x += 5;
  bool right = run("compare, one worker", ship->model, now, moved, {});
  right = run("compare", ship->model, now, moved, all) && right;
  now.files.front().label = "renamed.glb";
  right = run("renamed", ship->model, now, moved, all) && right;
  return right ? EXIT_SUCCESS : EXIT_FAILURE;
}
