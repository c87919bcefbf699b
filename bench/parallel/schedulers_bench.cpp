// SPDX-License-Identifier: Apache-2.0
// The schedules beside oneTBB, OpenMP and std::execution::par on items of known cost: every
// contender once in each of many rounds, in an order that chance decides, compared round by round,
// every result checked. Before each there is a pause (the workers of some go on looking for work
// for milliseconds and take a core from whoever comes next) and a run that is not timed: where
// threads wake up is the kernel's lottery, on a virtual machine often on the core that is busy
// already. One of them is there twice: what it seems to take more than itself, or less, is how well
// the machine can be measured on that day.
//
//     bench_schedulers [ROUNDS [TABLE.md PLOT.svg]]
#include <fmt/core.h>
#include <tbb/blocked_range.h>
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <execution>
#include <fstream>
#include <functional>
#include <numeric>
#include <random>
#include <string>
#include <thread>
#include <vector>

#include "clocks.hpp"
#include "parallel/items.hpp"
#include "strake/parallel/backends/tbb.hpp"
#include "strake/parallel/for_each.hpp"
#include "strake/parallel/host_executor.hpp"
#include "strake/parallel/order.hpp"
#include "strake/parallel/team.hpp"

namespace strake::bench {
namespace {

using parallel::for_each;
using parallel::Region;
using parallel::Schedule;
using parallel::Team;

constexpr unsigned kSeed = 11;
/// The rule of the guide: no slower than so many times the best of the others.
constexpr double kRule = 1.05;
constexpr const char* kTwice = "oneTBB, auto";
constexpr std::chrono::milliseconds kPause(10);

/// Items, and how a user of each library would share them out.
struct Set {
  std::string name;
  Case items;
  std::size_t grain = 1;      ///< items that a worker takes at once, for all who ask
  bool longest_first = true;  ///< whether costs are known and unequal
  int rounds = 1;             ///< for each round requested: more where one is short
};

std::vector<Set> make_sets() {
  std::vector<Set> sets;
  sets.push_back({"equal", make_case(std::vector<std::uint32_t>(20'000, 5'000)), 16, false});
  const std::vector<std::uint32_t> heavy = heavy_tailed(20'000, kSeed);
  sets.push_back({"heavy anywhere", make_case(heavy)});
  std::vector<std::uint32_t> sorted = heavy;
  std::sort(sorted.rbegin(), sorted.rend());
  sets.push_back({"heavy first", make_case(sorted)});
  std::ranges::reverse(sorted);
  sets.push_back({"heavy last", make_case(sorted)});
  // Half of all the work in one item, the last: with two workers there is just one good way.
  std::vector<std::uint32_t> giant(20'000, 2'000);
  giant.back() = 40'000'000;
  sets.push_back({"one giant", make_case(giant)});
  sets.push_back(
      {"a million tiny", make_case(std::vector<std::uint32_t>(1'000'000, 20)), 1024, false, 9});
  return sets;
}

using Out = std::vector<std::uint64_t>;

/// One way to run all items of a set. What a body is stays known to the compiler in each.
struct Contender {
  std::string name;
  bool ours = false;  ///< as the guide says one should, for this set
  std::function<void(const Set&, Out&)> run;
  std::vector<double> seconds = {};  ///< by round
};

double median(std::vector<double> values) {
  std::ranges::sort(values);
  return values[values.size() / 2];
}

/// How many times the other's time it takes: the median over rounds of what both took in one, so
/// that what slows the whole machine for a while slows both.
double times_of(const Contender& one, const Contender& other) {
  std::vector<double> ratios;
  for (std::size_t i = 0; i < one.seconds.size(); ++i)
    ratios.push_back(one.seconds[i] / other.seconds[i]);
  return median(std::move(ratios));
}

auto body_of(const Set& set, Out& out) {
  return [&set, &out](std::size_t i) { out[i] = work(i, set.items.rounds[i]); };
}

class SideBySide {
 public:
  explicit SideBySide(int rounds)
      : rounds_(rounds),
        team_(parallel::default_workers()),
        limit_(tbb::global_control::max_allowed_parallelism, team_.size()),
        arena_(static_cast<int>(team_.size())),
        in_arena_(team_.size(), parallel::in_arena(arena_)) {}

  bool run() {
    fmt::print("{} workers, medians of {} rounds or more, each with every contender once\n",
               team_.size(), rounds_);
    for (const Set& set : make_sets()) compare(set);
    return good_;
  }

  [[nodiscard]] const std::string& table() const { return table_; }
  [[nodiscard]] std::string plot() const;

 private:
  static constexpr double kTop = 30, kRow = 17, kLeft = 230, kScale = 150;

  struct Bar {
    std::string set, name;
    double speed_up = 0;
    bool ours = false;
  };

  Status ours(const Set& set, Out& out, Region region, parallel::Executor* workers) {
    region.n = out.size();
    std::vector<std::uint32_t> order;
    if (region.schedule == Schedule::dynamic && set.longest_first) {
      // Part of what it costs.
      order =
          parallel::longest_first(out.size(), [&](std::size_t i) { return set.items.rounds[i]; });
      region.order = order;
    }
    return for_each({.team = workers}, region, body_of(set, out));
  }

  [[nodiscard]] std::vector<Contender> contenders() {
    std::vector<Contender> all;
    const auto add = [&](const char* name, bool recommended, auto run) {
      all.push_back({name, recommended, run});
    };
    const auto must = [this](const Status& status) { good_ = good_ && status; };
    add("sequential", false, [](const Set& set, Out& out) {
      const auto body = body_of(set, out);
      for (std::size_t i = 0; i < out.size(); ++i) body(i);
    });
    add("strake, by the guide", true, [this, must](const Set& set, Out& out) {
      must(ours(set, out, {.name = "s", .grain = set.grain}, &team_));
    });
    add("strake, on a oneTBB arena", false, [this, must](const Set& set, Out& out) {
      must(ours(set, out, {.name = "s", .grain = set.grain}, &in_arena_));
    });
    add("strake, order as it comes", false, [this, must](const Set& set, Out& out) {
      must(for_each({.team = &team_}, {.name = "s", .n = out.size(), .grain = set.grain},
                    body_of(set, out)));
    });
    add("strake, static", false, [this, must](const Set& set, Out& out) {
      must(ours(set, out, {.name = "s", .schedule = Schedule::static_blocks}, &team_));
    });
    add_others(all);
    all.push_back({"oneTBB, auto, again", false, tbb_auto});
    return all;
  }

  static void tbb_auto(const Set& set, Out& out) {
    tbb::parallel_for(std::size_t{0}, out.size(), body_of(set, out));
  }

  void add_others(std::vector<Contender>& all) const {
    const auto threads = static_cast<int>(team_.size());
    all.push_back({kTwice, false, tbb_auto});
    all.push_back({"oneTBB, simple", false, [](const Set& set, Out& out) {
                     const auto body = body_of(set, out);
                     tbb::parallel_for(
                         tbb::blocked_range<std::size_t>(0, out.size(), set.grain),
                         [&](const tbb::blocked_range<std::size_t>& range) {
                           for (std::size_t i = range.begin(); i < range.end(); ++i) body(i);
                         },
                         tbb::simple_partitioner());
                   }});
    all.push_back({"OpenMP, dynamic", false, [threads](const Set& set, Out& out) {
                     const auto body = body_of(set, out);
                     const auto chunk = static_cast<int>(set.grain);
#pragma omp parallel for schedule(dynamic, chunk) num_threads(threads)
                     for (std::size_t i = 0; i < out.size(); ++i) body(i);
                   }});
    all.push_back({"OpenMP, guided", false, [threads](const Set& set, Out& out) {
                     const auto body = body_of(set, out);
#pragma omp parallel for schedule(guided) num_threads(threads)
                     for (std::size_t i = 0; i < out.size(); ++i) body(i);
                   }});
    all.push_back({"std::execution::par", false, [](const Set& set, Out& out) {
                     const auto body = body_of(set, out);
                     const std::uint64_t* const first = out.data();
                     std::for_each(std::execution::par, out.begin(), out.end(),
                                   [&](const std::uint64_t& slot) {
                                     body(static_cast<std::size_t>(&slot - first));
                                   });
                   }});
  }

  void compare(const Set& set) {
    std::vector<Contender> all = contenders();
    Out out(set.items.expected.size()), spare(out);
    std::vector<std::size_t> turns(all.size());
    std::iota(turns.begin(), turns.end(), std::size_t{0});
    std::mt19937 random(kSeed);
    for (int round = 0; round < rounds_ * set.rounds; ++round) {
      std::ranges::shuffle(turns, random);
      for (const std::size_t turn : turns) {
        Contender& one = all[turn];
        std::ranges::fill(out, 0);
        std::this_thread::sleep_for(kPause);
        one.run(set, spare);
        Lap lap;
        one.run(set, out);
        one.seconds.push_back(lap());
        if (out == set.items.expected) continue;
        fmt::print("{}: WRONG RESULT\n", one.name);
        good_ = false;
      }
    }
    print_times(set, all);
  }

  void print_times(const Set& set, std::vector<Contender>& all) {
    const Contender again = std::move(all.back());
    all.pop_back();
    const auto& rounds = set.items.rounds;
    const double total = std::accumulate(rounds.begin(), rounds.end(), 0.0);
    const double longest = *std::ranges::max_element(rounds);
    const double bound = total / std::max(total / team_.size(), longest);
    const double alone = median(all.front().seconds);
    fmt::print("{}: {} items, {:.1f} ms by one worker; no schedule gains more than {:.2f}\n",
               set.name, rounds.size(), alone * 1e3, bound);
    const Contender& guide = *std::ranges::find_if(all, &Contender::ours);
    double ratio = 0;
    std::string who;
    for (const Contender& one : all) {
      const double taken = median(one.seconds), speed_up = alone / taken;
      fmt::print("  {:<28}{:8.2f} ms{:8.2f} times\n", one.name, taken * 1e3, speed_up);
      bars_.push_back({set.name, one.name, speed_up, one.ours});
      if (one.name.starts_with("strake") || &one == all.data()) continue;
      if (const double times = times_of(guide, one); times > ratio) {
        ratio = times;
        who = one.name;
      }
    }
    const double twice = times_of(again, *std::ranges::find(all, kTwice, &Contender::name));
    fmt::print("  {} takes {:.2f} times its own time\n", kTwice, twice);
    fmt::print("  best of the others: {}; by the guide {:.2f} times its time in the same round{}\n",
               who, ratio, ratio <= kRule ? "" : ": MORE THAN THE RULE ALLOWS");
    row(set, bound, all, fmt::format("{:.2f} | {}, {:.2f}", twice, who, ratio));
  }

  void row(const Set& set, double bound, const std::vector<Contender>& all,
           const std::string& verdict) {
    if (table_.empty()) {
      table_ = "| items | bound |";
      std::string rule = "\n|---|---|";
      for (const Contender& one : all) {
        if (&one == all.data()) continue;
        table_ += " " + one.name + " |";
        rule += "---|";
      }
      table_ += " the same twice | best of the others, ours in times of its time |" + rule;
      table_ += "---|---|\n";
    }
    table_ += fmt::format("| {} | {:.2f} |", set.name, bound);
    const double alone = median(all.front().seconds);
    for (const Contender& one : all)
      if (&one != all.data()) table_ += fmt::format(" {:.2f} |", alone / median(one.seconds));
    table_ += fmt::format(" {} |\n", verdict);
  }

  int rounds_;
  Team team_;
  tbb::global_control limit_;
  tbb::task_arena arena_;
  parallel::HostExecutor in_arena_;
  bool good_ = true;
  std::string table_;
  std::vector<Bar> bars_;
};

/// Bars of speed-up, set by set.
std::string SideBySide::plot() const {
  std::string svg;
  double y = kTop;
  std::string set;
  for (const Bar& bar : bars_) {
    if (bar.name == "sequential") continue;
    if (bar.set != set) {
      set = bar.set;
      y += kRow * 1.5;
      svg += fmt::format("<text x=\"8\" y=\"{:.1f}\" font-weight=\"bold\">{}</text>\n", y, set);
      y += 6;
    }
    svg += fmt::format(
        "<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{:.1f}\" fill=\"{}\"/>"
        "<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"end\">{}</text>"
        "<text x=\"{:.1f}\" y=\"{:.1f}\">{:.2f}</text>\n",
        kLeft, y, bar.speed_up * kScale, kRow - 4,
        bar.ours                         ? "#0072b2"
        : bar.name.starts_with("strake") ? "#56b4e9"
                                         : "#999",
        kLeft - 6, y + kRow - 6, bar.name, kLeft + bar.speed_up * kScale + 5, y + kRow - 6,
        bar.speed_up);
    y += kRow;
  }
  const double width = kLeft + kScale * team_.size() + 80, height = y + 20;
  return fmt::format(
             "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0:.0f}\" height=\"{1:.0f}\" "
             "viewBox=\"0 0 {0:.0f} {1:.0f}\" font-family=\"sans-serif\" font-size=\"12\">\n"
             "<rect width=\"100%\" height=\"100%\" fill=\"#fff\"/>\n"
             "<text x=\"8\" y=\"20\" font-size=\"14\">Times faster than one worker, {2} workers"
             "</text>\n",
             width, height, team_.size()) +
         svg + "</svg>\n";
}

int run(int argc, char** argv) {
  const int rounds = argc > 1 ? std::max(1, std::atoi(argv[1])) : 15;
  SideBySide bench(rounds);
  const bool good = bench.run();
  if (argc > 2) std::ofstream(argv[2]) << bench.table();
  if (argc > 3) std::ofstream(argv[3]) << bench.plot();
  return good ? 0 : 1;
}

}  // namespace
}  // namespace strake::bench

int main(int argc, char** argv) { return strake::bench::run(argc, argv); }
