// SPDX-License-Identifier: Apache-2.0
// bench_clash_ship [OBJECTS]...: generated ships, straight and turned, from memory to clashes at
// 25 mm. The classes must be those of the ship's own truth, or an error stands in place of a time.
#include "strake/generate/ship.hpp"

#include <fmt/core.h>

#include <cstdint>
#include <cstdlib>
#include <map>
#include <utility>
#include <vector>

#include "timed_run.hpp"

namespace {

using namespace strake;

using Key = std::pair<std::uint32_t, std::uint32_t>;

std::size_t wrong_pairs(const clash::Report& report, const generate::Truth& truth) {
  std::map<Key, clash::Class> open;
  for (const generate::TruthPair& p : truth.pairs)
    open[{model::index(p.a), model::index(p.b)}] = p.cls;
  std::size_t wrong = 0;
  for (const clash::Pair& p : report.pairs) {
    const auto at = open.find({model::index(p.a), model::index(p.b)});
    if (at == open.end() || at->second != p.cls) ++wrong;
    if (at != open.end()) open.erase(at);
  }
  return wrong + open.size();
}

bool measure(std::uint64_t objects, bool turned) {
  parallel::Team team(parallel::default_workers());
  const parallel::Context context{.team = &team, .stop = {}};
  const auto ship = generate::generate_ship({objects, 1, turned}, context);
  if (!ship) return false;
  const clash::Options options{.clearance_mm = generate::Truth::kClearanceMm};
  bench::Lap lap;
  const auto scene = model::make_scene(ship->model, clash::scene_options(options), context);
  if (!scene) return false;
  const double scene_s = lap();
  const auto report = clash::detect(*scene, clash::one_set(*scene), options, context);
  const double clash_s = lap();
  const std::size_t wrong = report ? wrong_pairs(*report, ship->truth) : 1;
  if (wrong > 0) {
    fmt::print("{:>8} objects{}  ERROR: {} wrong pairs\n", objects, turned ? ", turned" : "",
               wrong);
    return false;
  }
  fmt::print(
      "{:>8} objects{:<8} {} threads: place {:.3f} s, clash {:.3f} s, {} pairs, {:.2f} us a "
      "candidate pair\n",
      objects, turned ? ", turned" : "", team.size(), scene_s, clash_s, report->pairs.size(),
      clash_s / static_cast<double>(report->counters.candidate_pairs) * 1e6);
  return true;
}

}  // namespace

int main(int argc, char** argv) {
  std::vector<std::uint64_t> sizes;
  for (int i = 1; i < argc; ++i) sizes.push_back(std::strtoull(argv[i], nullptr, 10));
  if (sizes.empty()) sizes = {1'000, 10'000, 100'000};
  bool right = true;
  for (const std::uint64_t objects : sizes)
    for (const bool turned : {false, true}) right = measure(objects, turned) && right;
  return right ? 0 : 1;
}
