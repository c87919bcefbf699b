// SPDX-License-Identifier: Apache-2.0
// The scheduler loop against its targets (docs/patterns/README.md) and beside oneTBB, OpenMP and
// std::execution::par in the same run. Every result is compared with the sequential one: a wrong
// one is reported instead of a time and makes the program fail.
#include <fmt/core.h>
#include <tbb/blocked_range.h>
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <execution>
#include <functional>
#include <limits>
#include <numeric>
#include <random>
#include <string>
#include <thread>
#include <vector>

#include "parallel/items.hpp"
#include "strake/parallel/backends/openmp.hpp"
#include "strake/parallel/backends/tbb.hpp"
#include "strake/parallel/for_each.hpp"
#include "strake/parallel/host_executor.hpp"
#include "strake/parallel/order.hpp"
#include "strake/parallel/report.hpp"
#include "strake/parallel/team.hpp"

namespace strake::bench {
namespace {

using parallel::Context;
using parallel::for_each;
using parallel::Region;
using parallel::Schedule;
using parallel::Team;

constexpr int kRepeats = 7;

double now_s() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

/// The least of several runs: other work on the machine only ever adds.
double best_s(const std::function<void()>& run) {
  double best = std::numeric_limits<double>::infinity();
  for (int i = 0; i < kRepeats; ++i) {
    const double start = now_s();
    run();
    best = std::min(best, now_s() - start);
  }
  return best;
}

class Bench {
 public:
  explicit Bench(unsigned workers)
      : team_(workers), limit_(tbb::global_control::max_allowed_parallelism, workers) {}

  bool run() {
    fmt::print("{} workers, best of {} runs\n", team_.size(), kRepeats);
    dispatch();
    empty_region();
    heavy_balance();
    cancel();
    return good_;
  }

 private:
  void line(const std::string& name, double value, const std::string& unit,
            const std::string& target = "") {
    fmt::print("  {:<44}{:>10.2f} {:<8}{}\n", name, value, unit, target);
  }

  /// Runs a filled-in loop and checks what it wrote.
  template <class Loop>
  double checked(const std::string& name, const Case& one, Loop&& loop) {
    std::vector<std::uint64_t> out(one.expected.size());
    const double seconds = best_s([&] {
      std::fill(out.begin(), out.end(), 0);
      loop([&](std::size_t i) { out[i] = work(i, one.rounds[i]); });
    });
    if (out == one.expected) return seconds;
    fmt::print("  {:<44}     WRONG RESULT\n", name);
    good_ = false;
    return std::numeric_limits<double>::quiet_NaN();
  }

  template <class Body>
  void ours(const Region& region, Body&& body, bool sequential = false) {
    if (!for_each({.team = sequential ? nullptr : &team_}, region, body)) good_ = false;
  }

  /// Items that cost next to nothing: what remains is the loop.
  void dispatch() {
    constexpr std::size_t kItems = 2'000'000;
    const Case one = make_case(std::vector<std::uint32_t>(kItems, 0));
    fmt::print("cost per trivial item, wall time\n");
    const auto row = [&](const std::string& name, const std::string& target, auto&& loop) {
      line(name, checked(name, one, loop) / kItems * 1e9, "ns", target);
    };
    row("plain loop", "", [&](auto body) {
      for (std::size_t i = 0; i < kItems; ++i) body(i);
    });
    row("strake sequential", "target: plain + 2",
        [&](auto body) { ours({.name = "d", .n = kItems}, body, true); });
    row("strake static", "", [&](auto body) {
      ours({.name = "d", .n = kItems, .schedule = Schedule::static_blocks}, body);
    });
    row("strake dynamic, one by one", "target: 15",
        [&](auto body) { ours({.name = "d", .n = kItems}, body); });
    row("strake dynamic, blocks of 64", "",
        [&](auto body) { ours({.name = "d", .n = kItems, .grain = 64}, body); });
    others(row, kItems);
  }

  template <class Row>
  void others(Row&& row, std::size_t n) {
    row("oneTBB auto", "", [&](auto body) { tbb::parallel_for(std::size_t{0}, n, body); });
    row("oneTBB grain 1", "", [&](auto body) {
      tbb::parallel_for(
          tbb::blocked_range<std::size_t>(0, n, 1),
          [&](const tbb::blocked_range<std::size_t>& r) {
            for (std::size_t i = r.begin(); i < r.end(); ++i) body(i);
          },
          tbb::simple_partitioner());
    });
    const auto threads = static_cast<int>(team_.size());
    row("OpenMP dynamic", "", [&](auto body) {
#pragma omp parallel for schedule(dynamic, 1) num_threads(threads)
      for (std::size_t i = 0; i < n; ++i) body(i);
    });
    row("OpenMP guided", "", [&](auto body) {
#pragma omp parallel for schedule(guided) num_threads(threads)
      for (std::size_t i = 0; i < n; ++i) body(i);
    });
    std::vector<std::size_t> indices(n);
    std::iota(indices.begin(), indices.end(), std::size_t{0});
    row("std::execution::par", "", [&](auto body) {
      std::for_each(std::execution::par, indices.begin(), indices.end(), body);
    });
  }

  void empty_region() {
    constexpr int kRegions = 2000;
    fmt::print("a region with nothing in it\n");
    tbb::task_arena arena(static_cast<int>(team_.size()));
    parallel::HostExecutor in_tbb(team_.size(), parallel::in_arena(arena));
    parallel::HostExecutor openmp(team_.size(), parallel::by_openmp());
    const auto row = [&](const std::string& name, parallel::Executor& workers,
                         const std::string& target) {
      const double seconds = best_s([&] {
        for (int i = 0; i < kRegions; ++i) workers.run([](parallel::Seat) {});
      });
      line(name, seconds / kRegions * 1e6, "us", target);
    };
    row("strake team", team_, "target: 10");
    row("strake on an arena of oneTBB", in_tbb, "");
    row("strake on OpenMP", openmp, "");
  }

  /// CPU time of the workers on items as plant models have them, the longest first. What that
  /// gains beside others is reported by bench_schedulers.
  void heavy_balance() {
    const Case one = make_case(heavy_tailed(20'000, 11));
    balance(one, parallel::longest_first(one.rounds.size(),
                                         [&](std::size_t i) { return one.rounds[i]; }));
  }

  void balance(const Case& one, std::span<const std::uint32_t> order) {
    parallel::RunReport report;
    std::vector<std::uint64_t> out(one.expected.size());
    const auto status = for_each({.team = &team_, .report = &report},
                                 {.name = "balance", .n = out.size(), .order = order},
                                 [&](std::size_t i) { out[i] = work(i, one.rounds[i]); });
    if (!status || out != one.expected) good_ = false;
    line("load balance of heavy-tailed items, CPU time", report.regions().front().load_balance(),
         "", "target: 0.95");
  }

  /// From the stop request to the end of the region, items of some tens of microseconds.
  void cancel() {
    constexpr std::uint32_t kRounds = 20'000;
    constexpr int kCancels = 1000;
    const double item_us = kRounds * measured_round_us();
    fmt::print("from a stop request to the end of the region, items of {:.0f} us\n", item_us);
    std::vector<double> latencies;
    for (int i = 0; i < kCancels; ++i) {
      std::stop_source source;
      std::atomic<double> requested{0};
      std::atomic<std::uint64_t> sink{0};
      std::thread outside([&] {
        std::this_thread::sleep_for(std::chrono::milliseconds(2));
        requested = now_s();
        source.request_stop();
      });
      const Status status = for_each({.team = &team_, .stop = source.get_token()},
                                     {.name = "cancel", .n = 100'000'000},
                                     [&](std::size_t k) { sink += work(k, kRounds) & 1U; });
      latencies.push_back(now_s() - requested);
      outside.join();
      if (status || status.error().code != ErrorCode::cancelled) good_ = false;
    }
    std::sort(latencies.begin(), latencies.end());
    line("strake, median", latencies[latencies.size() / 2] * 1e6, "us",
         fmt::format("target: {:.0f}, the item and 50", item_us + 50));
    line("strake, 99 of 100", latencies[latencies.size() * 99 / 100] * 1e6, "us");
    line("strake, worst of 1,000", latencies.back() * 1e6, "us");
  }

  Team team_;
  tbb::global_control limit_;
  bool good_ = true;
};

}  // namespace
}  // namespace strake::bench

int main() { return strake::bench::Bench(strake::parallel::default_workers()).run() ? 0 : 1; }
