// SPDX-License-Identifier: Apache-2.0
// bench_clash_incremental [OBJECTS]...: generated ships of which nothing, one object, or one in a
// thousand moved since the run before, at a clearance of 25 mm. A run that follows the change must
// come to the result of a full one; the share of the full time is what it costs, with and without
// the signatures that tell what changed. Loading and placing are not counted.
#include "strake/clash/incremental.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <utility>
#include <vector>

#include "clocks.hpp"
#include "strake/generate/ship.hpp"
#include "strake/parallel/team.hpp"

namespace {

using namespace strake;

constexpr std::size_t kRuns = 3;

clash::Options options_of_run() {
  clash::Options options;
  options.tolerances.clearance_mm = 25;
  options.engine.keep_for_changes = true;
  return options;
}

/// Moves every `step`-th object by 20 mm, beginning in the middle.
void move_objects(model::Model& model, std::size_t step) {
  for (std::size_t o = std::min(step, model.objects.size()) / 2; o < model.objects.size();
       o += step) {
    const model::Object& object = model.objects[o];
    for (std::uint32_t b = object.first_body; b < object.first_body + object.body_count; ++b)
      model.bodies[b].placement.translation.x += 20;
  }
}

/// A test over one scene.
struct Run {
  const model::Scene& scene;
  clash::Options options = options_of_run();
  clash::Sets sets = clash::one_set(scene);

  [[nodiscard]] Result<clash::Signatures> signatures(const parallel::Context& context) const {
    return clash::signatures(scene, sets, options, {}, context);
  }
};

std::vector<std::uint32_t> mapped(const clash::Signatures& before, const clash::Signatures& now) {
  std::vector<std::uint32_t> map(before.objects.size(), model::kNoObject);
  for (std::uint32_t o = 0; o < map.size(); ++o)
    if (before.objects[o] == now.objects[o]) map[o] = o;
  return map;
}

/// The least of some times: what else the machine does only adds.
template <class Work>
double min_s(const Work& work) {
  double least = 1e9;
  for (std::size_t r = 0; r < kRuns; ++r) least = std::min(least, work());
  return least;
}

bool measure_change(const clash::Report& earlier, const clash::Signatures& before,
                    const model::Scene& scene, const std::string& what, double full_s,
                    const parallel::Context& context) {
  const Run run{scene};
  bench::Lap lap;
  const auto now = run.signatures(context);
  if (!now) return false;
  const double signatures_s = lap();
  const std::vector<std::uint32_t> map = mapped(before, *now);
  clash::Report followed;
  bool good = true;
  const double follow_s = min_s([&] {
    clash::EarlierRun copy{earlier, map};
    (void)lap();
    auto report = clash::detect_changes(scene, run.sets, run.options, {}, std::move(copy), context);
    const double seconds = lap();
    good = good && report.has_value();
    if (report) followed = std::move(*report);
    return seconds;
  });
  const auto full = clash::detect(scene, run.sets, run.options, {}, context);
  if (!good || !full || full->hash != followed.hash ||
      full->pairs.size() != followed.pairs.size()) {
    fmt::print("  ERROR: {}: not the result of a full run\n", what);
    return false;
  }
  const double budget_s = full_s * (followed.counters.part_pairs == 0 ? 0.005 : 0.01) + 0.05;
  fmt::print(
      "  {:<16} {:>9.2f} ms, {:>6.3f} % of a full run, and {:.2f} ms of signatures (budget of one "
      "object {:.1f} ms); {} pairs of parts tested, {} by a full run\n",
      what, follow_s * 1e3, 100 * follow_s / full_s, signatures_s * 1e3, budget_s * 1e3,
      followed.counters.part_pairs, full->counters.part_pairs);
  return true;
}

bool measure(std::uint64_t objects) {
  parallel::Team team(parallel::default_workers());
  const parallel::Context context{.team = &team, .stop = {}};
  const auto ship = generate::generate_ship({objects, 1, false}, context);
  if (!ship) return false;
  const model::SceneOptions placing = clash::scene_options(options_of_run());
  const auto scene = model::make_scene(ship->model, placing, context);
  if (!scene) return false;
  const Run run{*scene};
  clash::Report earlier;
  const double full_s = min_s([&] {
    bench::Lap lap;
    auto report = clash::detect(*scene, run.sets, run.options, {}, context);
    const double seconds = lap();
    if (report) earlier = std::move(*report);
    return seconds;
  });
  const auto before = run.signatures(context);
  if (!before) return false;
  fmt::print("{:>8} objects, {} workers: {:.3f} s in full, {} pairs\n", objects, team.size(),
             full_s, earlier.pairs.size());
  struct Edit {
    const char* what;
    std::size_t step;  ///< 0: nothing moves
  };
  bool good = true;
  for (const Edit& edit : {Edit{"nothing moved", 0}, Edit{"one moved", ship->model.objects.size()},
                           Edit{"1 in 1000 moved", 1000}}) {
    model::Model model = ship->model;
    if (edit.step > 0) move_objects(model, edit.step);
    const auto edited = model::make_scene(model, placing, context);
    good = edited && measure_change(earlier, *before, *edited, edit.what, full_s, context) && good;
  }
  std::fflush(stdout);  // the next may take minutes
  return good;
}

}  // namespace

int main(int argc, char** argv) {
  std::vector<std::uint64_t> sizes;
  for (int i = 1; i < argc; ++i) sizes.push_back(std::strtoull(argv[i], nullptr, 10));
  if (sizes.empty()) sizes = {100'000};
  bool right = true;
  for (const std::uint64_t objects : sizes) right = measure(objects) && right;
  return right ? 0 : 1;
}
