// SPDX-License-Identifier: Apache-2.0
// bench_clash_ship [OBJECTS]...: generated ships, straight and turned, from memory to clashes at
// 25 mm. The classes must be those of the ship's own truth, or an error stands in place of a time.
// At 100 and 300 mm the ship has no truth: there it is the cost of a candidate pair that counts.
// The median of three for each team of 1, 2, 4, ... workers, with the speed-up against one; all of
// them must come to the same result.
#include "strake/generate/ship.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <utility>
#include <vector>

#include "clocks.hpp"
#include "ship_truth.hpp"
#include "strake/parallel/team.hpp"

namespace {

using namespace strake;

/// Teams of 1, 2, 4, ... workers, and the largest there may be.
std::vector<unsigned> team_sizes() {
  const unsigned most = parallel::default_workers();
  std::vector<unsigned> sizes;
  for (unsigned n = 1; n < most; n *= 2) sizes.push_back(n);
  sizes.push_back(most);
  return sizes;
}

struct Timed {
  clash::Report report;
  double median_s = 0;
};

Result<Timed> timed(const model::Scene& scene, const clash::Options& options, unsigned workers) {
  parallel::Team team(workers);
  Timed result;
  std::array<double, 3> seconds{};
  for (double& s : seconds) {
    bench::Lap lap;
    auto report = clash::detect(scene, clash::one_set(scene), options, {.team = &team, .stop = {}});
    s = lap();
    if (!report) return report.error();
    result.report = std::move(*report);
  }
  std::ranges::sort(seconds);
  result.median_s = seconds[1];
  return result;
}

bool measure(std::uint64_t objects, bool turned, double clearance_mm) {
  parallel::Team team(parallel::default_workers());
  const parallel::Context context{.team = &team, .stop = {}};
  const auto ship = generate::generate_ship({objects, 1, turned}, context);
  if (!ship) return false;
  const clash::Options options{.clearance_mm = clearance_mm};
  bench::Lap lap;
  const auto scene = model::make_scene(ship->model, clash::scene_options(options), context);
  if (!scene) return false;
  fmt::print("{:>8} objects{:<8} {:>3.0f} mm: place {:.3f} s by {} workers\n", objects,
             turned ? ", turned" : "", clearance_mm, lap(), team.size());
  const bool known = clearance_mm == generate::Truth::kClearanceMm;
  double alone_s = 0;
  std::string hash;
  for (const unsigned workers : team_sizes()) {
    const auto run = timed(*scene, options, workers);
    if (!run) return false;
    const clash::Report& report = run->report;
    const std::size_t wrong = known ? bench::wrong_pairs(report, ship->truth) : 0;
    if (wrong > 0 || (!hash.empty() && hash != report.hash)) {
      fmt::print("  ERROR: {} wrong pairs, or not those of one worker\n", wrong);
      return false;
    }
    hash = report.hash;
    if (workers == 1) alone_s = run->median_s;
    fmt::print(
        "  {:>2} workers: {:>8.3f} s, {:>5.2f}x, {} pairs, {:.2f} us a candidate pair, {} without "
        "a count of places\n",
        workers, run->median_s, alone_s / run->median_s, report.pairs.size(),
        run->median_s / static_cast<double>(report.counters.candidate_pairs) * 1e6,
        report.counters.regions_given_up);
    std::fflush(stdout);  // the next may take minutes
  }
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
