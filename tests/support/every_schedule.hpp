// SPDX-License-Identifier: Apache-2.0
// One region under every team, schedule, chunk and order.
#pragma once

#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <numeric>
#include <vector>

#include "strake/parallel/region.hpp"
#include "strake/parallel/team.hpp"

namespace strake::test {

inline constexpr std::size_t kEverywhereItems = 4500;  // 64 workers have shares

inline void everywhere(
    std::size_t grain,
    const std::function<void(const parallel::Context&, const parallel::Region&)>& test) {
  using parallel::Region;
  using parallel::Schedule;
  constexpr std::size_t kItems = kEverywhereItems;
  std::vector<std::uint32_t> backwards((kItems + grain - 1) / grain);
  std::iota(backwards.rbegin(), backwards.rend(), 0U);
  for (const unsigned threads : {1U, 2U, 3U, 16U, 64U}) {
    parallel::Team team(threads);
    for (const Schedule schedule : {Schedule::dynamic, Schedule::static_blocks})
      for (const std::size_t chunk : {1U, 9U})
        for (const bool ordered : {false, true}) {
          SCOPED_TRACE(::testing::Message() << "threads " << threads << ", chunk " << chunk
                                            << ", static " << static_cast<int>(schedule)
                                            << ", backwards " << ordered << ", grain " << grain);
          Region region{
              .name = "failing", .n = kItems, .schedule = schedule, .grain = grain, .chunk = chunk};
          if (ordered) region.order = backwards;
          test({.team = &team}, region);
        }
  }
  test({}, {.name = "failing", .n = kItems, .grain = grain});
}

}  // namespace strake::test
