// SPDX-License-Identifier: Apache-2.0
// bench_clash_ship [OBJECTS]...: generated ships, straight and turned, from memory to clashes at
// 25 mm. The classes must be those of the ship's own truth, or an error stands in place of a time.
// At 100 and 300 mm the ship has no truth: there it is the cost of a candidate pair that counts.
#include "strake/generate/ship.hpp"

#include <fmt/core.h>

#include <cstdint>
#include <cstdlib>
#include <vector>

#include "clocks.hpp"
#include "ship_truth.hpp"
#include "strake/parallel/team.hpp"

namespace {

using namespace strake;

bool measure(std::uint64_t objects, bool turned, double clearance_mm) {
  parallel::Team team(parallel::default_workers());
  const parallel::Context context{.team = &team, .stop = {}};
  const auto ship = generate::generate_ship({objects, 1, turned}, context);
  if (!ship) return false;
  const clash::Options options{.clearance_mm = clearance_mm};
  bench::Lap lap;
  const auto scene = model::make_scene(ship->model, clash::scene_options(options), context);
  if (!scene) return false;
  const double scene_s = lap();
  const auto report = clash::detect(*scene, clash::one_set(*scene), options, context);
  const double clash_s = lap();
  if (!report) return false;
  const bool known = clearance_mm == generate::Truth::kClearanceMm;
  const std::size_t wrong = known ? bench::wrong_pairs(*report, ship->truth) : 0;
  if (wrong > 0) {
    fmt::print("{:>8} objects{}  ERROR: {} wrong pairs\n", objects, turned ? ", turned" : "",
               wrong);
    return false;
  }
  fmt::print(
      "{:>8} objects{:<8} {:>3.0f} mm {} threads: place {:.3f} s, clash {:.3f} s, {} pairs, {:.2f} "
      "us "
      "a candidate pair, {} without a count of places\n",
      objects, turned ? ", turned" : "", clearance_mm, team.size(), scene_s, clash_s,
      report->pairs.size(), clash_s / static_cast<double>(report->counters.candidate_pairs) * 1e6,
      report->counters.regions_given_up);
  return true;
}

}  // namespace

int main(int argc, char** argv) {
  std::vector<std::uint64_t> sizes;
  for (int i = 1; i < argc; ++i) sizes.push_back(std::strtoull(argv[i], nullptr, 10));
  if (sizes.empty()) sizes = {1'000, 10'000, 100'000};
  bool right = true;
  for (const std::uint64_t objects : sizes)
    for (const bool turned : {false, true})
      for (const double clearance_mm : {generate::Truth::kClearanceMm, 100.0, 300.0})
        right = measure(objects, turned, clearance_mm) && right;
  return right ? 0 : 1;
}
