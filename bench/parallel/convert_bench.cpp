// SPDX-License-Identifier: Apache-2.0
// The conversions of docs/patterns/convert.md: the sequential program, what it became on one thread
// and on a team, and how evenly the team was busy. Runs take turns, so that other work on the
// machine meets all alike; each result is compared with the sequential one.
#include <fmt/core.h>

#include <algorithm>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

#include "bounding_box.hpp"
#include "clearance.hpp"
#include "clocks.hpp"
#include "mass.hpp"
#include "strake/parallel/report.hpp"
#include "strake/parallel/team.hpp"

namespace strake::bench {
namespace {

using parallel::Context;
using parallel::RegionReport;
using parallel::RunReport;
using parallel::Team;

constexpr int kRounds = 9;

/// Of one program, over all rounds.
struct Times {
  std::vector<double> wall, cpu;

  template <class Run>
  auto measure(Run&& run) {
    Lap wall_lap;
    CpuLap cpu_lap;
    auto result = run();
    wall.push_back(wall_lap());
    cpu.push_back(cpu_lap());
    return result;
  }
};

double median(std::vector<double> values) {
  std::ranges::sort(values);
  return values[values.size() / 2];
}

/// Of one run of the team, in CPU seconds: what a machine busy with other things spoils least.
struct Shares {
  double before = 0;    ///< the sequential program in the same round
  double apart = 0;     ///< outside regions
  double busiest = 0;   ///< of the busiest worker of each region
  double least = 0;     ///< what no schedule could make less of the latter
  double balance = 1;   ///< of the region that took the most
  std::string longest;  ///< its name
};

Shares shares(const std::vector<RegionReport>& regions, double cpu) {
  Shares all;
  all.apart = cpu;
  double maximum = 0;
  for (const RegionReport& r : regions) {
    const double busy = r.total_busy_s(), workers = static_cast<double>(r.busy_s.size());
    all.apart -= busy;
    all.busiest += std::ranges::max(r.busy_s);
    all.least += busy / (r.bound() * workers);
    if (busy < maximum) continue;
    maximum = busy;
    all.balance = r.load_balance();
    all.longest = r.name;
  }
  return all;
}

class Bench {
 public:
  explicit Bench(unsigned workers) : team_(workers) {}

  bool run() {
    fmt::print("{} workers, medians of {} runs that took turns\n", team_.size(), kRounds);
    bounding_box();
    clearance();
    mass();
    return good_;
  }

 private:
  /// `before()` and `after(context)` give the same by same_bytes.
  template <class Before, class After>
  void compare(const std::string& name, Before&& before, After&& after) {
    const auto expected = before();
    const auto check = [&](const auto& result) {
      if (result && same_bytes(*result, expected)) return;
      fmt::print("  {}: WRONG RESULT\n", name);
      good_ = false;
    };
    Times sequential, alone, together;
    std::vector<Shares> reported;
    for (int round = 0; round < kRounds; ++round) {
      sequential.measure(before);
      check(alone.measure([&] { return after({}); }));
      check(together.measure([&] { return after({.team = &team_}); }));
      RunReport report;
      CpuLap lap;
      const auto result = after({.team = &team_, .report = &report});
      reported.push_back(shares(report.regions(), lap()));
      reported.back().before = sequential.cpu.back();
      check(result);
    }
    fmt::print("{}\n", name);
    const auto row = [&](const std::string& what, const Times& times) {
      fmt::print("  {:<22}{:>9.1f} ms wall {:>9.1f} ms CPU {:>6.2f} times\n", what,
                 median(times.wall) * 1e3, median(times.cpu) * 1e3,
                 median(sequential.wall) / median(times.wall));
    };
    row("before", sequential);
    row("after, one thread", alone);
    row("after, the team", together);
    print_shares(reported);
  }

  static void print_shares(const std::vector<Shares>& reported) {
    const auto middle = [&](auto&& of) {
      std::vector<double> values;
      for (const Shares& one : reported) values.push_back(of(one));
      return median(std::move(values));
    };
    const double gain = middle([](const Shares& s) { return s.before / (s.apart + s.busiest); });
    const double bound = middle([](const Shares& s) { return s.before / (s.apart + s.least); });
    const double balance = middle([](const Shares& s) { return s.balance; });
    const double apart = middle([](const Shares& s) { return s.apart; });
    fmt::print("  on cores of its own {:.2f} times, by CPU time; no schedule could pass {:.2f}\n",
               gain, bound);
    fmt::print("  load balance of '{}' {:.3f}; {:.1f} ms outside regions\n",
               reported.front().longest, balance, apart * 1e3);
  }

  static void print_model(const convert::Model& model) {
    std::size_t largest = 0;
    for (const convert::Part& part : model) largest = std::max(largest, part.triangles.size());
    const std::size_t all = convert::triangles_of(model);
    fmt::print("{} parts, {} triangles; parts as items could gain {:.2f} at most\n", model.size(),
               all, static_cast<double>(all) / static_cast<double>(largest));
  }

  void bounding_box() {
    const convert::Model model = convert::make_model(40'000, 1000);
    print_model(model);
    std::vector<std::uint32_t> all(model.size());
    std::iota(all.begin(), all.end(), 0U);
    compare(
        "bounding box",
        [&] {
          convert::before::forget_boxes();
          return std::vector{convert::before::extent_of(model, all)};
        },
        [&](const Context& context) -> Result<std::vector<convert::Extent>> {
          const auto boxes = convert::after::boxes_of(model, context);
          if (!boxes) return boxes.error();
          const auto extent = convert::after::extent_of(*boxes, all, context);
          if (!extent) return extent.error();
          return std::vector{*extent};
        });
  }

  void clearance() {
    const convert::Model model = convert::make_model(20'000, 200);
    const std::vector<convert::Valve> valves = convert::make_valves(400);
    print_model(model);
    compare(
        "clearance query",
        [&] {
          convert::before::forget_boxes();
          return convert::before::clearances(model, valves);
        },
        [&](const Context& context) -> Result<convert::Clearances> {
          const auto boxes = convert::after::boxes_of(model, context);
          if (!boxes) return boxes.error();
          return convert::after::clearances(model, *boxes, valves, context);
        });
  }

  void mass() {
    const convert::Model model = convert::make_model(40'000, 1000);
    compare(
        "mass properties", [&] { return convert::before::masses(model); },
        [&](const Context& context) { return convert::after::masses(model, context); });
  }

  Team team_;
  bool good_ = true;
};

}  // namespace
}  // namespace strake::bench

int main() { return strake::bench::Bench(strake::parallel::default_workers()).run() ? 0 : 1; }
