// SPDX-License-Identifier: Apache-2.0
// How bench_patterns compares the ways of a page.
#pragma once

#include <fmt/core.h>

#include <algorithm>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "clocks.hpp"
#include "parallel/items.hpp"
#include "strake/core/result.hpp"
#include "strake/parallel/context.hpp"
#include "strake/parallel/team.hpp"

namespace strake::bench {

/// A number that stands for a result: equal results, equal numbers. Cheap, as it is in the times.
using Digest = std::uint64_t;

template <class Values>
Digest digest(const Values& values) {
  Digest all = 0, odd = 1;
  for (const auto& value : values) {
    all += static_cast<Digest>(value) * odd;
    odd += 2;
  }
  return all;
}

/// Runs what must succeed; a failure shows as a wrong result.
inline Digest checked(const Status& status, const std::function<Digest()>& result) {
  return status ? result() : 0;
}

struct Way {
  std::string name;
  std::function<Digest()> run;
  std::vector<double> seconds = {};

  [[nodiscard]] double median() {
    std::ranges::sort(seconds);
    return seconds[seconds.size() / 2];
  }
};

class Pages {
 public:
  explicit Pages(int rounds)
      : rounds_(rounds), team_(parallel::default_workers()), us_of_round_(measured_round_us()) {}

 protected:
  [[nodiscard]] parallel::Context all() { return {.team = &team_}; }

  /// Microseconds that so many rounds of work() take here.
  [[nodiscard]] double us(double rounds) const { return rounds * us_of_round_; }

  /// Every way once in each round; their results must be the same.
  void compare(const std::string& page, std::vector<Way> ways) {
    std::optional<Digest> expected;
    for (int round = 0; round < rounds_; ++round)
      for (Way& way : ways) {
        Lap lap;
        const Digest result = way.run();
        way.seconds.push_back(lap());
        if (!expected) expected = result;
        if (result == *expected) continue;
        fmt::print("{}, {}: WRONG RESULT\n", page, way.name);
        good_ = false;
      }
    fmt::print("{}\n", page);
    const double first = ways.front().median();
    for (Way& way : ways)
      fmt::print("  {:<58}{:10.3f} ms{:8.2f} times\n", way.name, way.median() * 1e3,
                 first / way.median());
  }

  int rounds_;
  parallel::Team team_;
  double us_of_round_;
  bool good_ = true;
};

/// The pages on loops, and those on what items share and who watches them. False: a wrong result.
bool loop_pages(int rounds);
bool sharing_pages(int rounds);

}  // namespace strake::bench
