// SPDX-License-Identifier: Apache-2.0
// bench_clash_ship [OBJECTS]...: generated ships, straight and turned, from memory to clashes at
// 25 mm. The classes must be those of the ship's own truth, or an error stands in place of a time.
// At 100 and 300 mm the ship has no truth: there it is the cost of a candidate pair that counts.
// The median of three for each team of 1, 2, 4, ... workers in turn, with the speed-up against one
// and that of as many runs of one worker side by side; all must come to the same result.
#include "strake/generate/ship.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "clocks.hpp"
#include "ship_truth.hpp"
#include "strake/parallel/team.hpp"

namespace {

using namespace strake;

/// Teams of 1, 2, 4, ... workers, and the largest there may be.
std::vector<unsigned> team_sizes() {
  const unsigned largest = parallel::default_workers();
  std::vector<unsigned> sizes;
  for (unsigned n = 1; n < largest; n *= 2) sizes.push_back(n);
  sizes.push_back(largest);
  return sizes;
}

constexpr std::size_t kRuns = 3;
/// Objects of all runs side by side: beyond that they may not fit the memory.
constexpr std::uint64_t kMaxSideBySide = 4'000'000;

struct Timed {
  clash::Report report;
  std::array<double, kRuns> seconds{};

  [[nodiscard]] double median_s() const {
    std::array<double, kRuns> sorted = seconds;
    std::ranges::sort(sorted);
    return sorted[kRuns / 2];
  }
};

Result<clash::Report> run(const model::Scene& scene, const clash::Options& options,
                          unsigned workers) {
  parallel::Team team(workers);
  return clash::detect(scene, clash::one_set(scene), options, {.team = &team, .stop = {}});
}

/// Each team in turn, and that so many times: what else the machine does hits all alike.
Result<std::vector<Timed>> run_in_turn(const model::Scene& scene, const clash::Options& options,
                                       const std::vector<unsigned>& teams) {
  std::vector<Timed> timed(teams.size());
  for (std::size_t r = 0; r < kRuns; ++r)
    for (std::size_t t = 0; t < teams.size(); ++t) {
      bench::Lap lap;
      auto report = run(scene, options, teams[t]);
      timed[t].seconds[r] = lap();
      if (!report) return report.error();
      timed[t].report = std::move(*report);
    }
  return timed;
}

/// The seconds that so many runs of one worker each take side by side: what the cores of this
/// machine leave each other of memory and clock is no fault of a team.
double side_by_side_s(const model::Scene& scene, const clash::Options& options, unsigned runs) {
  std::array<double, kRuns> seconds{};
  for (double& s : seconds) {
    bench::Lap lap;
    std::vector<std::thread> all;
    for (unsigned i = 0; i < runs; ++i) all.emplace_back([&] { (void)run(scene, options, 1); });
    for (std::thread& one : all) one.join();
    s = lap();
  }
  std::ranges::sort(seconds);
  return seconds[kRuns / 2];
}

bool measure(std::uint64_t objects, bool turned, double clearance_mm) {
  parallel::Team team(parallel::default_workers());
  const parallel::Context context{.team = &team, .stop = {}};
  const auto ship = generate::generate_ship({objects, 1, turned}, context);
  if (!ship) return false;
  const clash::Options options{.tolerances = {.clearance_mm = clearance_mm}};
  bench::Lap lap;
  const auto scene = model::make_scene(ship->model, clash::scene_options(options), context);
  if (!scene) return false;
  fmt::print("{:>8} objects{:<8} {:>3.0f} mm: place {:.3f} s by {} workers\n", objects,
             turned ? ", turned" : "", clearance_mm, lap(), team.size());
  const bool known = clearance_mm == generate::Truth::kClearanceMm;
  const std::vector<unsigned> teams = team_sizes();
  const auto runs = run_in_turn(*scene, options, teams);
  if (!runs) return false;
  const double alone_s = runs->front().median_s();
  for (std::size_t t = 0; t < teams.size(); ++t) {
    const clash::Report& report = (*runs)[t].report;
    const std::size_t wrong = known ? bench::wrong_pairs(report, ship->truth) : 0;
    if (wrong > 0 || runs->front().report.hash != report.hash) {
      fmt::print("  ERROR: {} wrong pairs, or not those of one worker\n", wrong);
      return false;
    }
    const double median_s = (*runs)[t].median_s();
    fmt::print(
        "  {:>2} workers: {:>8.3f} s, {:>5.2f}x, {} pairs, {:.2f} us a candidate pair, {} without "
        "a count of places\n",
        teams[t], median_s, alone_s / median_s, report.pairs.size(),
        median_s / static_cast<double>(report.counters.candidate_pairs) * 1e6,
        report.counters.regions_given_up);
  }
  if (const unsigned largest = teams.back(); largest > 1 && objects * largest <= kMaxSideBySide) {
    const double together_s = side_by_side_s(*scene, options, largest);
    fmt::print("  {:>2} runs of one worker side by side: {:.2f}x is what the machine gives\n",
               largest, largest * alone_s / together_s);
  }
  std::fflush(stdout);  // the next may take minutes
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
