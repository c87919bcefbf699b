// SPDX-License-Identifier: Apache-2.0
// bench_clash_baseline [OBJECTS]: the exact narrow phase beside the source thesis's sphere
// subdivision, on one generated ship at 25 mm, one worker: CPU seconds, and how many of the
// baseline's pairs have the class of the exact one, for larger and larger cell budgets. The exact
// classes must be those of the ship's own truth, or an error stands in place of a time.
#include <fmt/core.h>

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <map>
#include <utility>

#include "clocks.hpp"
#include "ship_truth.hpp"
#include "strake/generate/ship.hpp"

namespace {

using namespace strake;

struct Timed {
  clash::Report report;
  double seconds = 0;
};

Result<Timed> run(const model::Model& model, const clash::Options& options) {
  const auto scene = model::make_scene(model, clash::scene_options(options), {});
  if (!scene) return scene.error();
  const auto sets = clash::one_set(*scene);
  bench::CpuLap lap;
  auto report = clash::detect(*scene, sets, options, {});
  if (!report) return report.error();
  return Timed{std::move(*report), lap()};
}

/// Pairs of either that have the same class in both, and all of them.
std::pair<std::size_t, std::size_t> agreement(const clash::Report& x, const clash::Report& y) {
  std::map<bench::Key, std::pair<clash::Class, clash::Class>> classes;
  for (const clash::Pair& p : x.pairs) classes[bench::key_of(p)].first = p.cls;
  for (const clash::Pair& p : y.pairs) classes[bench::key_of(p)].second = p.cls;
  std::size_t equal = 0;
  for (const auto& [pair, both] : classes) equal += both.first == both.second ? 1 : 0;
  return {equal, classes.size()};
}

bool measure(std::uint64_t objects) {
  const auto ship = generate::generate_ship({objects, 1, false}, {});
  if (!ship) return false;
  clash::Options options{.tolerances = {.clearance_mm = generate::Truth::kClearanceMm},
                         .engine = {.max_regions = 0}};
  const auto exact = run(ship->model, options);
  if (!exact || bench::wrong_pairs(exact->report, ship->truth) > 0) {
    fmt::print("ERROR: the exact classes are not those of the ship\n");
    return false;
  }
  fmt::print("{} objects, {} pairs\n{:<34}{:>10.4f} s\n", objects, exact->report.pairs.size(),
             "exact", exact->seconds);
  options.engine.narrow_phase = clash::NarrowPhase::sphere_subdivision;
  for (const std::uint64_t budget : {100U, 1'000U, 10'000U}) {
    options.engine.max_spheres = budget;
    const auto spheres = run(ship->model, options);
    if (!spheres) return false;
    const auto [equal, all] = agreement(exact->report, spheres->report);
    fmt::print(
        "sphere subdivision, {:>6} spheres  {:>10.4f} s {:>10.1f} x exact, {} of {} classes "
        "equal\n",
        budget, spheres->seconds, spheres->seconds / exact->seconds, equal, all);
  }
  return true;
}

}  // namespace

int main(int argc, char** argv) {
  return measure(argc > 1 ? std::strtoull(argv[1], nullptr, 10) : 300) ? 0 : 1;
}
